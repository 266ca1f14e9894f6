"""Whether the graph took notice of a change that was made behind the robot's back, and what else it changed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from evaluations.perception.inventory import GraphThing, TrueThing
from evaluations.perception.matching import Matching, match_things, off_m
from evaluations.perception.recognition import share
from scene_graph.nodes import UNKNOWN_LABEL


@dataclass(frozen=True, kw_only=True)
class ChangeTolerances:
    """How far off a change may be noticed."""

    place_m: float = 0.3
    """A thing is at its new place for the graph if its node is so near, and has left the old one if none is."""
    stirred_m: float = 0.05
    """What truly moved farther than this may move in the graph too, whoever was asked to."""
    shifted_m: float = 0.3
    """A node that moved so far although its thing did not is a false alarm."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Moment:
    """The house and the graph at one time, and which node is which thing."""

    true: tuple[TrueThing, ...]
    graph: tuple[GraphThing, ...]
    matching: Matching

    @classmethod
    def of(cls, true: Sequence[TrueThing], graph: Sequence[GraphThing]) -> Moment:
        """Match what is there with what the graph holds now."""
        return cls(true=tuple(true), graph=tuple(graph), matching=match_things(true, graph))

    def thing(self, name: str) -> TrueThing | None:
        """The true thing of this identifier, if there is one."""
        return next((thing for thing in self.true if thing.id == name), None)

    def node(self, name: str) -> GraphThing | None:
        """The node of this identifier, if it is held to be present."""
        return next((node for node in self.graph if node.id == name), None)

    def accuracy(self, rooms: Mapping[str, str]) -> tuple[float | None, float | None]:
        """Share of the true things of the found ``rooms`` that the graph has right, and of nodes that are right.

        A node that stands for a thing and claims no name is neither right nor wrong.
        """
        asked = [thing for thing in self.true if thing.room in rooms]
        right = sum(thing.id in self.matching.named for thing in asked)
        claims = [n for n in self.graph if n.label != UNKNOWN_LABEL or n.id not in self.matching.misnamed.values()]
        return share(right, len(asked)), share(len(self.matching.named), len(claims))


def detected(
    kind: str, thing: str, before: Moment, after: Moment, tolerances: ChangeTolerances = ChangeTolerances()
) -> dict[str, bool | None]:
    """What the graph made of one change. ``kept``: whether a moved thing kept its node; None where that means nothing.

    ``noticed``: that it is gone from where it was, and stands where it is now, under whatever name; ``named``: under
    its own name.
    """
    left = kind == "add" or _left(thing, before, after, tolerances.place_m)
    node = after.node(after.matching.node_of.get(thing, ""))
    now = after.thing(thing)
    there = node is not None and now is not None and off_m(now, node) <= tolerances.place_m
    if kind == "remove":
        return {"noticed": left, "named": left, "kept": None}
    known = before.matching.node_of.get(thing)
    return {
        "noticed": left and there,
        "named": left and there and thing in after.matching.named,
        "kept": node is not None and node.id == known if kind == "move" else None,
    }


def false_alarms(
    before: Moment, after: Moment, tolerances: ChangeTolerances = ChangeTolerances()
) -> list[dict[str, str]]:
    """Nodes that changed without cause: gone, shifted or renamed though their thing stands as it did, or made up."""
    stirred = _stirred(before, after, tolerances.stirred_m)
    alarms = []
    for thing, name in before.matching.node_of.items():
        if thing in stirred:
            continue
        was, now = before.node(name), after.node(name)
        if was is None:
            continue
        if now is None:
            if thing not in after.matching.node_of:
                alarms.append({"node": name, "of": thing, "how": "gone"})
        elif float(np.linalg.norm(now.position_m - was.position_m)) > tolerances.shifted_m:
            alarms.append({"node": name, "of": thing, "how": "shifted"})
        elif thing in before.matching.named and now.label != was.label:
            alarms.append({"node": name, "of": thing, "how": "renamed"})
    known = {node.id for node in before.graph}
    again = {**after.matching.duplicates, **dict.fromkeys(after.matching.invented, "")}
    alarms += [
        {"node": name, "of": thing, "how": "made up"}
        for name, thing in again.items()
        if name not in known and thing not in stirred
    ]
    return alarms


def summarize(runs: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Figures over all changes of all houses."""
    changes = [change for run in runs for change in run["changes"]]
    kinds = sorted({change["kind"] for change in changes})
    of_kind = {kind: [change for change in changes if change["kind"] == kind] for kind in kinds}
    alarms = [alarm for change in changes for alarm in change["false_alarms"]]
    return {
        "changes": len(changes),
        "detected": share(sum(change["noticed"] for change in changes), len(changes)),
        "kinds": {kind: _of_kind(rows) for kind, rows in of_kind.items()},
        "false_alarms_per_change": len(alarms) / len(changes) if changes else None,
        "false_alarms_by_kind": {
            how: sum(alarm["how"] == how for alarm in alarms) for how in sorted({alarm["how"] for alarm in alarms})
        },
        "true_things_right": _mean(changes, "true_things_right"),
        "nodes_right": _mean(changes, "nodes_right"),
        "not_made": sum(run["not_made"] for run in runs),
    }


def _of_kind(rows: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    moved = [row for row in rows if row["kept"] is not None]
    return {
        "made": len(rows),
        "detected": share(sum(row["noticed"] for row in rows), len(rows)),
        "named": share(sum(row["named"] for row in rows), len(rows)),
        "identity_kept": share(sum(row["kept"] for row in moved), len(moved)),
        "looked": share(sum(row["looked"] for row in rows), len(rows)),
        "false_alarms": sum(len(row["false_alarms"]) for row in rows),
    }


def _left(thing: str, before: Moment, after: Moment, place_m: float) -> bool:
    """Whether the node that stood for the thing where it was no longer says so, and no new one does."""
    was, old = before.thing(thing), before.node(before.matching.node_of.get(thing, ""))
    if was is None or old is None:
        return True
    others = {name for other, name in after.matching.node_of.items() if other != thing}
    still = after.node(old.id)
    if still is not None and off_m(was, still) <= place_m and still.id not in others:
        return False
    known = {node.id for node in before.graph}
    return not any(
        node.id not in known and node.id not in others and node.label == old.label and off_m(was, node) <= place_m
        for node in after.graph
    )


def _stirred(before: Moment, after: Moment, stirred_m: float) -> set[str]:
    """Things that came, went or moved in truth."""
    places = {thing.id: thing.position_m for thing in before.true}
    now = {thing.id: thing.position_m for thing in after.true}
    moved = {name for name in places.keys() & now.keys() if float(np.linalg.norm(now[name] - places[name])) > stirred_m}
    return moved | (places.keys() ^ now.keys())


def _mean(changes: Sequence[Mapping[str, Any]], figure: str) -> float | None:
    values = [change[figure] for change in changes if change[figure] is not None]
    return float(np.mean(values)) if values else None
