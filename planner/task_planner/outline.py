"""The graph as a model reads it: an indented outline, pruned to what a request may be about.

Rooms, in them furniture, on it things. Names are quoted as JSON strings: they are data. Identifiers are plain.
"""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import pairwise

from planner.grounding.matching import is_first_of_pair
from planner.language.lexicon.spelling import closest
from planner.language.lexicon.vocabulary import coarser_labels, kind_labels, normal, singular, words_for
from planner.naming import name_of
from planner.task_planner.settings import OutlineSettings
from scene_graph.identifiers import natural_key
from scene_graph.nodes import DoorNode, DoorState, ObjectNode, ObjectState, PersonNode, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

MAX_IDENTIFIERS = 250
"""Values that servers take in the enumeration of a schema."""
_WORD = re.compile(r"\w+")


@dataclass(frozen=True, kw_only=True)
class Outline:
    """Text, the identifiers in it that goals may use, and how many objects were left out."""

    text: str
    identifiers: tuple[str, ...]
    left_out: int


def outline(
    snapshot: Snapshot,
    request: str,
    *,
    mentioned: Sequence[str] = (),
    before: str = "",
    settings: OutlineSettings = OutlineSettings(),
) -> Outline:
    """The part of the graph that ``request`` may be about: what it names or ``mentioned`` identifiers, what is on that,
    what was spoken of ``before``, furniture, then the rest.
    """
    rooms = [room for room in snapshot.of_type(RoomNode) if room.status is not RoomStatus.TEMPORARY]
    objects = _chosen(snapshot, request, mentioned, before, settings)
    used = {snapshot.room_of(node.id) for node in objects} | {snapshot.current_room}
    rooms = sorted(rooms, key=lambda room: (room.id not in used, natural_key(room.id)))[: settings.most_rooms]
    people = list(snapshot.of_type(PersonNode))[:20]
    lines = [_robot_line(snapshot)]
    for room in sorted(rooms, key=lambda room: natural_key(room.id)):
        here = " (the robot is here)" if room.id == snapshot.current_room else ""
        lines.append(f"{room.id} {_quoted(room.label)}{here}")
        lines += [
            f"  {person.id} person {_quoted(person.name)}"
            for person in people
            if snapshot.room_of(person.id) == room.id
        ]
        lines += _tree(snapshot, objects, room.id)
    doors, door_lines = _doors(snapshot, {room.id for room in rooms})
    everything = [*(room.id for room in rooms), *(p.id for p in people), *(node.id for node in objects), *doors]
    left_out = len(snapshot.of_type(ObjectNode)) - len(objects)
    if left_out:
        door_lines.append(f"{left_out} more objects are known that the request does not seem to be about")
    return Outline(
        text="\n".join(lines + door_lines), identifiers=tuple(everything[:MAX_IDENTIFIERS]), left_out=left_out
    )


def _chosen(
    snapshot: Snapshot, request: str, mentioned: Sequence[str], before: str, settings: OutlineSettings
) -> list[ObjectNode]:
    """At most ``most_objects``: what the request means best or mentioned, what that stands on, what else has a name in
    the request, what is on or in what it names, what was spoken of before, furniture, and the rest.
    """
    objects = snapshot.of_type(ObjectNode)
    labels = {normal(node.label) for node in objects}
    words, words_before = _words(request, labels), _words(before, labels)
    named = [node for node in objects if node.id in mentioned or _is_named(node, words)]
    meant = _meant(named, words, snapshot) | set(mentioned)
    held = snapshot.robot.holding if snapshot.robot is not None else None
    below = {support for i in meant if i in snapshot and (support := snapshot.support_of(i)) is not None}
    others = {node.id for node in named}
    there = _at(meant | _rooms(words, snapshot), objects, snapshot, settings.most_there)

    def rank(node: ObjectNode) -> tuple[int, object]:
        tiers = (
            node.id in meant or node.id == held,
            node.id in below,
            node.id in others,
            node.id in there,
            _is_named(node, words_before),
            _is_furniture(node),
        )
        return next((tier for tier, fits in enumerate(tiers) if fits), len(tiers)), natural_key(node.id)

    return sorted(sorted(objects, key=rank)[: settings.most_objects], key=lambda node: natural_key(node.id))


def _at(places: Collection[str], objects: Sequence[ObjectNode], snapshot: Snapshot, most: int) -> set[str]:
    """What is on or in ``places``, at most so many; what may be carried from rooms comes last."""
    on = [node.id for node in objects if snapshot.support_of(node.id) in places]
    around = [node.id for node in objects if node.graspable and snapshot.room_of(node.id) in places]
    return set((*sorted(on, key=natural_key), *sorted(around, key=natural_key))[:most])


def _rooms(words: frozenset[str], snapshot: Snapshot) -> set[str]:
    return {room.id for room in snapshot.of_type(RoomNode) if normal(room.label) in words or room.id in words}


def _meant(named: Sequence[ObjectNode], words: frozenset[str], snapshot: Snapshot) -> set[str]:
    """Of each kind of thing those whose color or room is in the request too; all of a kind where none is."""
    rooms = _rooms(words, snapshot)
    told = {node.id for node in named if node.id in words or not words.isdisjoint(_colors(node))}
    told |= {node.id for node in named if snapshot.room_of(node.id) in rooms}
    kinds = {node.label for node in named if node.id in told}
    return {node.id for node in named if node.id in told or node.label not in kinds}


def _colors(node: ObjectNode) -> set[str]:
    return {normal(color) for color in (node.color, *node.accents)}


def _is_furniture(node: ObjectNode) -> bool:
    return node.support and not node.graspable


def _words(request: str, labels: Collection[str]) -> frozenset[str]:
    """The request's words and what they may mean, one that is spelled almost like a label among them."""
    tokens = _WORD.findall(request.lower())
    pairs = [" ".join(pair) for pair in pairwise(tokens)]
    words: set[str] = set()
    for token in (*tokens, *pairs):
        meanings = words_for(token) | kind_labels(token) | coarser_labels(token) | {singular(token)}
        slip = closest(token, labels) if not meanings & set(labels) else None
        words |= meanings | ({slip} if slip is not None else set())
    return frozenset(words)


def _is_named(node: ObjectNode, words: frozenset[str]) -> bool:
    label = normal(node.label)
    kinds = {singular(normal(category)) for category in node.categories}
    return not words.isdisjoint({label, *label.split(), node.id, normal(node.name), *kinds})


def _tree(snapshot: Snapshot, objects: Sequence[ObjectNode], room: str) -> list[str]:
    here = [node for node in objects if snapshot.room_of(node.id) == room]
    ids = {node.id for node in here}
    lines: list[str] = []

    def add(node: ObjectNode, depth: int) -> None:
        lines.append(f"{'  ' * depth}{_object_line(node)}")
        for other in here:
            if snapshot.support_of(other.id) == node.id and other.id != node.id and depth < 6:
                add(other, depth + 1)

    for node in here:
        if snapshot.support_of(node.id) not in ids:
            add(node, 1)
    return lines


def _object_line(node: ObjectNode) -> str:
    marks = [_quoted(node.name)] if node.name else []
    marks += [" and ".join((node.color, *node.accents))] if node.color else []
    marks += ["furniture"] if _is_furniture(node) else []
    marks += ["fixed"] if not node.support and not node.graspable else []
    marks += ["not where it was"] if node.state is ObjectState.MISSING else []
    return " ".join([node.id, _quoted(node.label), *marks])


def _robot_line(snapshot: Snapshot) -> str:
    held = snapshot.robot.holding if snapshot.robot is not None else None
    return f"robot holding {held}" if held is not None else "robot holding nothing"


def _doors(snapshot: Snapshot, rooms: set[str]) -> tuple[list[str], list[str]]:
    """Identifiers of physical doors between known rooms, and a line for each that is closed."""
    ids, lines = [], []
    for door in snapshot.of_type(DoorNode):
        if door.rooms[1] is None or not {*door.rooms} <= rooms or not is_first_of_pair(snapshot, door):
            continue
        ids.append(door.id)
        if door.state is DoorState.CLOSED:
            lines.append(f"{door.id} {name_of(door.id, snapshot)} is closed")
    return ids, lines


def _quoted(name: str) -> str:
    return json.dumps(name[:60], ensure_ascii=False)
