"""Nodes, steps and goals in a person's words."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Collection, Sequence

from planner.goals import Goal, Predicate
from planner.plan import Step
from scene_graph.nodes import UNKNOWN_LABEL, DoorNode, ObjectNode, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.furniture.kinds import is_container

_NUMBERED = frozenset({"room", "region", "door", "wall", "corner"})
"""What has no name but its number."""
MOST_LISTED = 5
"""More than this are counted, not named: nobody listens to the end of such a list."""
IDENTIFIER = re.compile(r"[a-z][a-z0-9_]*_\d+(?:_pre)?\b")


def plain_name(node: ObjectNode) -> str:
    """What an object is called, without article or place: "blue bottle", "yellow thing" where its kind is not known."""
    kind = "thing" if node.label == UNKNOWN_LABEL else node.label
    return " ".join(f"{node.color} {node.name or kind}".split()).replace("_", " ")


def bare_name(node: ObjectNode) -> str:
    """What an object is called, without its place: "the blue bottle", or by the name that somebody gave it."""
    return node.name or f"the {plain_name(node)}"


def name_of(node_id: str, snapshot: Snapshot) -> str:
    """What a person would call a node: "the blue bottle", "the table in the kitchen", "the hall", "Anna"."""
    node = snapshot.get(node_id)
    if isinstance(node, ObjectNode):
        name = bare_name(node)
        room = snapshot.room_of(node_id)
        fixed = node.support and not node.graspable
        return f"{name} in {name_of(room, snapshot)}" if fixed and room is not None else name
    if isinstance(node, PersonNode):
        return node.name or "the person"
    if isinstance(node, RoomNode):
        return f"the {node.label}".replace("_", " ") if node.label else node.id.replace("_", " ")
    if isinstance(node, DoorNode):
        return _door_name(node, snapshot)
    kind, _, number = node_id.rpartition("_")
    if node is not None or not number.isdigit() or kind in _NUMBERED:
        return node_id.replace("_", " ")
    return "a thing that I had no name for" if kind == UNKNOWN_LABEL else f"the {kind}".replace("_", " ")


def humanize(text: str, snapshot: Snapshot, *, meant: Collection[str] = ()) -> str:
    """A sentence with the graph's identifiers replaced by names, starting with a capital.

    ``meant``: identifiers that are replaced though they are in the graph no longer.
    """

    def said(word: str) -> str:
        return name_of(word, snapshot) if word in snapshot or word in meant else word

    sentence = IDENTIFIER.sub(lambda found: said(found.group()), text)
    return sentence[:1].upper() + sentence[1:]


def whereabouts(object_id: str, snapshot: Snapshot) -> str:
    """Where the graph says that an object is: "on the table in the kitchen", "in the kitchen", "in my gripper"."""
    if snapshot.robot is not None and snapshot.robot.holding == object_id:
        return "in my gripper"
    if object_id not in snapshot:
        return "at a place I do not know"
    support, room = snapshot.support_of(object_id), snapshot.room_of(object_id)
    if support is not None:
        return at(support, snapshot)
    return f"in {name_of(room, snapshot)}" if room is not None else "at a place I do not know"


def at(place_id: str, snapshot: Snapshot) -> str:
    """A place with its preposition: "on the desk in the office", "in the box", "with Anna", "in the hall"."""
    node = snapshot.get(place_id)
    name = name_of(place_id, snapshot)
    if isinstance(node, PersonNode):
        return f"with {name}"
    if isinstance(node, ObjectNode):
        return f"{'in' if is_container(node.label) else 'on'} {name}"
    return f"in {name}" if isinstance(node, RoomNode) else f"at {name}"


def step_phrase(step: Step, snapshot: Snapshot) -> str:
    """A step as an infinitive: "pick up the blue bottle"."""
    names = [name_of(arg, snapshot) for arg in step.args]
    match step.skill, names:
        case "GOTO", [place]:
            return f"go to {place}"
        case "PICK", [thing]:
            return f"pick up {thing}"
        case "PLACE", [thing, _]:
            return f"put {thing} {at(step.args[1], snapshot)}"
        case _:
            return f"{step.skill.lower()} {', '.join(names)}".strip()


def goal_phrase(goal: Goal, snapshot: Snapshot) -> str:
    """A goal as something that is so: "the blue bottle is on the desk in the office"."""
    first, last = (name_of(arg, snapshot) for arg in (goal.args[0], goal.args[-1]))
    match goal.predicate:
        case Predicate.ON | Predicate.IN:
            return f"{first} is {at(goal.args[1], snapshot)}"
        case Predicate.NEAR:
            return f"{first} is near {last}"
        case Predicate.HOLDING:
            return f"I hold {first}"
        case Predicate.ROBOT_AT:
            in_room = isinstance(snapshot.get(goal.args[0]), RoomNode)
            return f"I am {'in' if in_room else 'at'} {first}"
        case Predicate.GIVEN:
            return f"{last} has {first}"
        case Predicate.OPEN:
            return f"{first} is open"
        case Predicate.FOUND:
            return f"{first} is {whereabouts(goal.args[0], snapshot)}"


def aim_phrase(goal: Goal, snapshot: Snapshot) -> str:
    """A goal as an infinitive: "bring the blue bottle to the desk in the office"."""
    first, last = (name_of(arg, snapshot) for arg in (goal.args[0], goal.args[-1]))
    match goal.predicate:
        case Predicate.ON | Predicate.IN:
            return f"put {first} {at(goal.args[1], snapshot)}"
        case Predicate.NEAR:
            return f"put {first} near {last}"
        case Predicate.HOLDING:
            return f"pick up {first}"
        case Predicate.ROBOT_AT:
            return f"go to {first}"
        case Predicate.GIVEN:
            return f"give {first} to {last}"
        case Predicate.FOUND:
            return f"find {first}"
        case Predicate.OPEN:
            return f"open {first}"


def places_phrase(place_ids: Sequence[str], snapshot: Snapshot) -> str:
    """Places to look at: "the desk and the shelf in the office", or of many, how many there are and in which rooms: "12
    places in the kitchen, the bedrooms and the hall".
    """
    if len(place_ids) <= MOST_LISTED:
        return listed([name_of(place, snapshot) for place in place_ids])
    rooms = dict.fromkeys(snapshot.room_of(place) for place in place_ids if place in snapshot)
    names = Counter(name_of(room, snapshot) for room in rooms if room is not None)
    within = listed([name if count == 1 else f"{name}s" for name, count in names.items()])
    return f"{len(place_ids)} places in {within}" if within else f"{len(place_ids)} places"


def listed(phrases: list[str]) -> str:
    """Phrases as a list in a sentence: "a, b and c"."""
    if len(phrases) < 2:
        return "".join(phrases)
    return f"{', '.join(phrases[:-1])} and {phrases[-1]}"


def capital(text: str) -> str:
    """With a capital first letter; the rest as it is."""
    return text[:1].upper() + text[1:]


def _door_name(door: DoorNode, snapshot: Snapshot) -> str:
    near, far = door.rooms
    if far is None:
        return f"the unexplored door of {name_of(near, snapshot)}"
    return f"the door between {name_of(near, snapshot)} and {name_of(far, snapshot)}"
