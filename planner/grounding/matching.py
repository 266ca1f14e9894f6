"""Which nodes a noun could name: by identifier, taught name, label, synonym, head noun, kind or coarser name, in that
order.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator
from difflib import get_close_matches

from planner.language.lexicon.vocabulary import (
    ANYTHING,
    FURNITURE,
    NO_KIND_OF_THEIRS,
    PERSON_WORDS,
    ROOM_WORDS,
    coarser_labels,
    is_known,
    is_room_label,
    kind_labels,
    normal,
    singular,
    words_for,
)
from scene_graph.edges import EdgeType
from scene_graph.identifiers import natural_key
from scene_graph.nodes import DoorNode, ObjectNode, PersonNode, RegionNode, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

Place = RoomNode | ObjectNode | PersonNode | DoorNode
_COARSER = 5


def nodes_of(snapshot: Snapshot) -> Iterator[Place]:
    """Everything a person may speak of, in natural order: objects, rooms that stand, persons, one node a door."""
    yield from snapshot.of_type(ObjectNode)
    yield from (room for room in snapshot.of_type(RoomNode) if room.status is not RoomStatus.TEMPORARY)
    yield from snapshot.of_type(PersonNode)
    yield from (door for door in snapshot.of_type(DoorNode) if is_first_of_pair(snapshot, door))


def is_first_of_pair(snapshot: Snapshot, door: DoorNode) -> bool:
    """Whether this node stands for its physical door: the lower identifier of a matched pair."""
    return not snapshot.edges_to(door.id, EdgeType.MATCH)


def nouns_of(snapshot: Snapshot) -> frozenset[str]:
    """Labels and taught names of the graph; what the lexer must recognize as nouns."""
    objects = snapshot.of_type(ObjectNode)
    said = {(node.label, node.name, node.categories) for node in objects}
    places = {node.label for node in nodes_of(snapshot) if isinstance(node, RoomNode | DoorNode)}
    places |= {region.label for region in snapshot.of_type(RegionNode)}
    return frozenset(places | {word for label, name, categories in said for word in (label, name, *categories)})


class Names:
    """What may be spoken of on one graph, grouped by what reads alike, so that each group is looked at once."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._groups: dict[Hashable, list[Place]] = {}
        for node in nodes_of(snapshot):
            self._groups.setdefault(_reads(node), []).append(node)
        self._found: dict[tuple[str, bool], list[tuple[int, str]]] = {}

    def named(self, head: str, number: int | None, *, widely: bool, fixed: bool = False) -> tuple[str, ...]:
        """Identifiers of the nodes that ``head`` (*remote control*) may name.

        ``widely``: every way of naming counts, as in *how many cups*; else the closest way that names anything decides,
        so that *mug* prefers what is labeled mug to what is labeled cup; a coarser name counts only if no other way
        names anything. ``fixed``: *things* and *objects* may be any,
        not only those that can be carried.
        """
        if head in self._snapshot:
            return (head,)
        ranked = self._ranked(head, fixed=fixed)
        if number is not None:
            ranked = [(rank, i) for rank, i in ranked if i.rpartition("_")[2] == str(number)]
        closest = min((rank for rank, _ in ranked), default=0)
        kept = [i for rank, i in ranked if rank == closest or (widely and rank < _COARSER)]
        regions = self._snapshot.of_type(RegionNode)
        kept += [region.id for region in regions if region.label and normal(region.label) == head]
        return tuple(sorted(kept, key=natural_key))

    def _ranked(self, head: str, *, fixed: bool) -> list[tuple[int, str]]:
        key = (head, fixed)
        if key not in self._found:
            ranks = ((_rank(head, nodes[0], fixed=fixed), nodes) for nodes in self._groups.values())
            self._found[key] = [(rank, node.id) for rank, nodes in ranks if rank is not None for node in nodes]
        return self._found[key]


def _reads(node: Place) -> Hashable:
    """Nodes with the same value here are named by the same words."""
    if isinstance(node, ObjectNode):
        return (node.label, node.name, node.categories, node.graspable, node.support)
    if isinstance(node, RoomNode):
        return (RoomNode, node.label)
    return DoorNode if isinstance(node, DoorNode) else node.id


def similar(head: str, snapshot: Snapshot) -> tuple[str, ...]:
    """Labels of the graph that are spelled like ``head``."""
    labels = sorted({normal(node.label) for node in nodes_of(snapshot) if node.label} | _names(snapshot))
    return tuple(get_close_matches(singular(head), labels, n=2, cutoff=0.7))


def _names(snapshot: Snapshot) -> set[str]:
    return {normal(node.name) for node in nodes_of(snapshot) if isinstance(node, ObjectNode | PersonNode) and node.name}


def _rank(head: str, node: Place, *, fixed: bool) -> int | None:
    """How closely ``head`` names ``node``: 0 name, 1 label, 2 synonym, 3 last word, 4 kind, 5 coarser name,
    None not at all.
    """
    forms = {head, singular(head)}
    label = normal(node.label)
    if isinstance(node, ObjectNode | PersonNode) and node.name and normal(node.name) in {head, f"my {head}"}:
        return 0
    if isinstance(node, PersonNode):
        return 0 if forms & set(normal(node.name or "").split()) else 1 if forms & PERSON_WORDS else None
    if isinstance(node, DoorNode):
        return 1 if "door" in forms else None
    if isinstance(node, RoomNode) and forms & ROOM_WORDS:
        return 4
    if not label:
        return None
    if label in forms or singular(label) in forms:
        return 1
    if isinstance(node, RoomNode) and _is_own_name(label) and head == f"{own_name(label)} {_sort_of_own_name(label)}":
        return 1
    if isinstance(node, RoomNode) and _is_sort(label) and label.rpartition(" ")[2] == head:
        return 2
    if label in words_for(head):
        return 3 if isinstance(node, RoomNode) else 2
    if (
        label.rpartition(" ")[2] in forms
        and label not in NO_KIND_OF_THEIRS
        and (isinstance(node, ObjectNode) or _is_own_name(label) or _is_sort(label))
    ):
        return 3
    if isinstance(node, RoomNode) and _sort_of_own_name(label) in forms:
        return 3
    return _rank_as_kind(head, node, fixed=fixed) if isinstance(node, ObjectNode) else None


def _rank_as_kind(head: str, node: ObjectNode, *, fixed: bool) -> int | None:
    """How closely ``head`` names the kind of thing that ``node`` is, or one of its kind by a closer name."""
    if _is_kind({head, singular(head)}, node, fixed=fixed):
        return 4
    return _COARSER if normal(node.label) in coarser_labels(head) else None


def _is_own_name(room_label: str) -> bool:
    """Whether a room of two words or more ends in a name of its own, as *meeting room Oslo* does."""
    last = room_label.rpartition(" ")[2]
    return " " in room_label and not is_known(last) and not last.isdecimal()


def own_name(room_label: str) -> str:
    """*Oslo* of *meeting room Oslo*; empty of others."""
    return room_label.rpartition(" ")[2] if _is_own_name(room_label) else ""


def _sort_of_own_name(room_label: str) -> str:
    """*Meeting room* of *meeting room Oslo*, *classroom* of *classroom 12*; empty of others."""
    sort, _, last = room_label.rpartition(" ")
    named = last.isdecimal() or (_is_own_name(room_label) and (is_room_label(sort) or sort.endswith("room")))
    return sort if named else ""


def _is_sort(room_label: str) -> bool:
    """Whether a room of two words is a sort of what its last word says: *the main corridor* is a corridor."""
    last = room_label.rpartition(" ")[2]
    return " " in room_label and is_room_label(last) and last not in ROOM_WORDS


def _is_kind(forms: Iterable[str], node: ObjectNode, *, fixed: bool) -> bool:
    label = normal(node.label)
    categories = {singular(normal(category)) for category in node.categories}
    for form in forms:
        if form in ANYTHING and (node.graspable or fixed):
            return True
        if form in FURNITURE and node.support and not node.graspable:
            return True
        if form in categories or label in kind_labels(form):
            return True
    return False
