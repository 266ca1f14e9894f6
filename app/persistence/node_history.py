"""What became of each node: found, moved, renamed, missed, seen again."""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

Record = Mapping[str, Any]
Records = Mapping[str, Record]
Kind = Literal["known", "found", "gone", "moved", "room", "place", "state", "label", "name", "seen_again"]
Value = str | list[float] | None

WATCHED = frozenset({"room", "door", "object", "person", "region"})
"""Types whose history is kept; walls, corners and affordances come and go with their rooms."""
ENTRIES = 64
"""Of one node: so many are kept."""
CARRYING = frozenset({"on", "in"})


@dataclass(frozen=True, kw_only=True)
class Entry:
    """One thing that became of a node. ``before`` and ``after``: a word, an identifier, or (x, y, z) in the map."""

    stamp_s: float
    kind: Kind
    before: Value = None
    after: Value = None

    def document(self) -> dict[str, Any]:
        """As the interface shows it."""
        return {"stamp_s": round(self.stamp_s, 3), "kind": self.kind, "before": self.before, "after": self.after}


@dataclass(kw_only=True)
class Past:
    """Entries of one node, oldest first, and what was noted of it last.

    Attributes:
        entries: at most ``ENTRIES``; ``dropped``: how many older ones there were.
        told: what the newest entries say of it. ``last_seen_s``: robot time. ``is_gone``: no longer in the graph.
    """

    entries: deque[Entry] = field(default_factory=lambda: deque(maxlen=ENTRIES))
    dropped: int = 0
    told: dict[str, Value] = field(default_factory=dict)
    last_seen_s: float | None = None
    is_gone: bool = False

    def add(self, entry: Entry) -> None:
        """Note one more."""
        self.dropped += len(self.entries) == ENTRIES
        self.entries.append(entry)

    def copied(self, shift_s: float = 0.0) -> Past:
        """The same by a clock that is ``shift_s`` ahead."""
        moved = (replace(entry, stamp_s=entry.stamp_s + shift_s) for entry in self.entries)
        seen_s = None if self.last_seen_s is None else self.last_seen_s + shift_s
        return replace(self, entries=deque(moved, maxlen=ENTRIES), told=dict(self.told), last_seen_s=seen_s)


@dataclass(frozen=True, kw_only=True)
class Pasts:
    """What outlives the service: of every node its past, and since when (robot time) it is written down."""

    since_s: float | None = None
    nodes: Mapping[str, Past] = field(default_factory=dict)

    def copied(self, shift_s: float = 0.0) -> Pasts:
        """The same by a clock that is ``shift_s`` ahead."""
        since_s = None if self.since_s is None else self.since_s + shift_s
        return Pasts(since_s=since_s, nodes={name: past.copied(shift_s) for name, past in self.nodes.items()})


@dataclass(frozen=True, kw_only=True)
class HistorySettings:
    """What is worth a note."""

    nodes: int = 2000
    """So many nodes have a history; chosen."""
    step_m: Mapping[str, float] = field(default_factory=lambda: {"object": 0.1, "person": 0.5})
    """From where it was noted last, a thing of a type must be so far away to count as moved: less is better knowledge,
    not motion.
    """
    unseen_s: float = 60.0
    """After so long without a sight, the next one is noted."""


class NodeHistory:
    """Histories of at most so many nodes, of each the newest entries.

    When full, those of nodes that are gone are forgotten first. Notes of one thread may be copied by another.
    """

    def __init__(self, before: Pasts | None = None, *, settings: HistorySettings = HistorySettings()) -> None:
        """``before``: what is known from earlier, by the clock that goes on now; without, it begins here."""
        before = (before or Pasts()).copied()
        self._settings = settings
        self._pasts: dict[str, Past] = dict(before.nodes)
        self._since_s = before.since_s
        self._begun = False
        self._noting = threading.Lock()

    def pasts(self) -> Pasts:
        """A copy of what is to outlive the service."""
        with self._noting:
            return Pasts(since_s=self._since_s, nodes=self._pasts).copied()

    def note(self, nodes: Records, edges: Records, stamp_s: float, *, changed: Collection[str] | None = None) -> None:
        """Take in the nodes and edges of the scene in the map frame as they are at ``stamp_s``.

        ``changed``: the nodes that were written or removed, or of which an edge was; without, and the first time, all
        are looked through.
        """
        with self._noting:
            first, self._begun = not self._begun, True
            everything = first or changed is None
            self._take_in(nodes, edges, stamp_s, None if everything else changed, first=first)

    def _take_in(
        self, nodes: Records, edges: Records, stamp_s: float, changed: Collection[str] | None, *, first: bool
    ) -> None:
        changed = nodes.keys() | self._pasts.keys() if changed is None else changed
        self._since_s = stamp_s if self._since_s is None else self._since_s
        places = dict(_places(edges, changed))
        for node_id in changed:
            node, past = nodes.get(node_id), self._pasts.get(node_id)
            if node is not None and node["type"] in WATCHED:
                self._note(node_id, node, places.get(node_id), stamp_s, first=first)
            elif node is None and past is not None and not past.is_gone:
                past.is_gone = True
                past.add(Entry(stamp_s=stamp_s, kind="gone"))
        self._forget()

    def document(self, node_id: str, *, exists: bool = False) -> dict[str, Any] | None:
        """What is kept of a node; ``None`` if nothing is, unless it ``exists``."""
        past = self._pasts.get(node_id, Past() if exists else None)
        if past is None:
            return None
        entries = [entry.document() for entry in past.entries]
        return {"node": node_id, "since_s": self._since_s, "entries": entries, "dropped": past.dropped}

    def _note(self, node_id: str, node: Record, place: str | None, stamp_s: float, *, first: bool) -> None:
        past = self._pasts.setdefault(node_id, Past())
        if not past.told or past.is_gone:
            past.add(Entry(stamp_s=stamp_s, kind="known" if first else "found", after=node["position_m"]))
            past.told, past.is_gone = {"moved": node["position_m"], **_facts(node, place)}, False
        else:
            for kind, before, after in _changes(node, place, past.told, self._settings.step_m):
                past.add(Entry(stamp_s=stamp_s, kind=kind, before=before, after=after))
                past.told[kind] = after
        seen_s = node.get("last_seen_s")
        if seen_s is not None and past.last_seen_s is not None and seen_s - past.last_seen_s > self._settings.unseen_s:
            past.add(Entry(stamp_s=seen_s, kind="seen_again"))
        past.last_seen_s = seen_s

    def _forget(self) -> None:
        if len(self._pasts) <= self._settings.nodes:
            return
        order = sorted(self._pasts, key=lambda node_id: not self._pasts[node_id].is_gone)
        for node_id in order[: len(self._pasts) - self._settings.nodes]:
            del self._pasts[node_id]


def _places(edges: Records, things: Collection[str]) -> Iterator[tuple[str, str]]:
    """What each of the things lies on or in, as far as that is sure."""
    for edge in edges.values():
        if (
            edge["source"] in things
            and edge["type"] == "relation"
            and edge["label"] in CARRYING
            and edge["probability"] >= 0.5
        ):
            yield edge["source"], f"{edge['label']} {edge['target']}"


def _facts(node: Record, place: str | None) -> dict[str, Value]:
    name = node.get("name") or node.get("attributes", {}).get("name") or None
    state = node.get("state") or node.get("status") or None
    room = node["room"] if node["type"] in {"object", "person"} else None
    return {"room": room, "place": place, "state": state, "label": node["label"] or None, "name": name}


def _changes(
    node: Record, place: str | None, told: Mapping[str, Value], steps_m: Mapping[str, float]
) -> Iterator[tuple[Any, Value, Value]]:
    """What is no longer as it was noted last; what the robot carries moves with it."""
    for kind, value in _facts(node, place).items():
        if value != told.get(kind):
            yield kind, told.get(kind), value
    step_m, before, now = steps_m.get(node["type"]), told["moved"], node["position_m"]
    if (
        step_m is not None
        and node.get("state") != "held"
        and isinstance(before, list)
        and math.dist(before, now) >= step_m
    ):
        yield "moved", before, now
