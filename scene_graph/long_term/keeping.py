"""What of a building is worth keeping when the robot is switched off, and how it is taken up again.

Kept is what is true without the robot: rooms that stand, doors that were looked at, things, persons, names. Wishes,
rooms and doors still being measured, and the robot itself are not. Times are those of the robot's clock, which starts
anew with the robot, so they are shifted: what was seen a day ago is a day old.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from scene_graph.checks.invariants import check
from scene_graph.edges import Edge, HasIntentionEdge, InEdge, IntentionAction, IntentionStatus, RelationEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.long_term.room_files import StoredBuilding
from scene_graph.long_term.room_parts import RoomParts, cut_room
from scene_graph.nodes import (
    ROBOT_ID,
    ROOT_ID,
    CrossingStatus,
    DoorNode,
    Node,
    ObjectNode,
    ObjectState,
    PersonNode,
    RobotNode,
    RoomNode,
    RoomStatus,
    RootNode,
)
from scene_graph.snapshot import Snapshot

_ENDED = frozenset({IntentionStatus.DONE, IntentionStatus.FAILED})


@dataclass(frozen=True, kw_only=True)
class KeepingSettings:
    """What is believed of a building while the robot is off."""

    lost_existence: float = 0.12
    """Probability that a thing is where the hand had it, once the robot has been off. Chosen: as for one that slipped
    away, so that it is recognized elsewhere the sooner.
    """


@dataclass(frozen=True, kw_only=True)
class TakenUp:
    """A building as it is known at a new start.

    Attributes:
        rooms: sound rooms whose edges lead nowhere but to each other and to ``shared``.
        shared: nodes of the building as a whole.
        dropped: rooms that contradict the rest, with the reason.
    """

    rooms: tuple[RoomParts, ...]
    shared: tuple[Node, ...]
    dropped: tuple[tuple[str, str], ...]


def rooms_to_keep(building: Snapshot, *, settings: KeepingSettings = KeepingSettings()) -> tuple[RoomParts, ...]:
    """All rooms that stand; what the robot holds is kept as missing in its room."""
    settled = _with_empty_hand(building, settings)
    rooms = [room for room in settled.of_type(RoomNode) if room.status is not RoomStatus.TEMPORARY]
    return tuple(_kept(cut_room(settled, room.id)) for room in rooms)


def take_up(stored: StoredBuilding, *, now_s: float, elapsed_s: float) -> TakenUp:
    """The stored building at robot time ``now_s``, ``elapsed_s`` seconds after it was written."""
    shift_s = now_s - stored.stamp_s - elapsed_s
    shifts_s = {
        room: now_s - written.stamp_s - max(0.0, elapsed_s - (written.saved_s - stored.saved_s))
        for room, written in stored.strays.items()
    }
    shared = tuple(_shifted(node, shift_s) for node in stored.shared)
    rooms, dropped = _without_doubles(stored.rooms)
    while True:
        connected = _connected(rooms, shared)
        whole = tuple(_shifted_room(parts, shifts_s.get(parts.room_id, shift_s)) for parts in connected)
        flaws = _flaws(whole, shared)
        if not flaws:
            return TakenUp(rooms=whole, shared=shared, dropped=tuple(dropped))
        dropped += flaws.items()
        rooms = [parts for parts in rooms if parts.room_id not in flaws]


def held_in(building: Snapshot) -> str | None:
    """What the robot has in its hand."""
    return building.robot.holding if building.robot is not None else None


def _with_empty_hand(building: Snapshot, settings: KeepingSettings) -> Snapshot:
    robot, room = building.robot, building.current_room
    held = building.get(robot.holding) if robot is not None and robot.holding is not None else None
    if robot is None or not isinstance(held, ObjectNode) or room is None:
        return building
    place = RtEdge(source=room, target=held.id, T_source_target=building.transform(room, held.id))
    old = [edge.key for edge in (*building.edges_to(held.id), *building.edges_from(held.id))]
    existence = min(held.existence, settings.lost_existence)
    return building.evolve(
        put_nodes={
            held.id: replace(held, state=ObjectState.MISSING, existence=existence),
            robot.id: replace(robot, holding=None),
        },
        put_edges={edge.key: edge for edge in (place, InEdge(source=held.id, target=room))},
        removed_edges=old,
        revision=building.revision,
        stamp_s=building.stamp_s,
    )


def _kept(parts: RoomParts) -> RoomParts:
    nodes = [_at_rest(node) for node in parts.nodes if not (isinstance(node, DoorNode) and node.provisional)]
    gone = {node.id for node in parts.nodes} - {node.id for node in nodes}
    edges = [edge for edge in parts.edges if not gone & {edge.key.source, edge.key.target} and _lasts(edge)]
    return replace(parts, nodes=tuple(nodes), edges=tuple(edges))


def _at_rest(node: Node) -> Node:
    """Without what only holds while the robot is under way."""
    if isinstance(node, DoorNode) and node.crossing is CrossingStatus.UNCROSSED:
        return replace(node, crossing_reason="")
    return node


def _lasts(edge: Edge) -> bool:
    """Whether an edge says something about the building; that a room was looked around in is such a thing."""
    if isinstance(edge, HasIntentionEdge):
        return edge.action is IntentionAction.LOOK and edge.status in _ENDED and edge.target != ROBOT_ID
    return ROBOT_ID not in (edge.key.source, edge.key.target)


def _without_doubles(rooms: Sequence[RoomParts]) -> tuple[list[RoomParts], list[tuple[str, str]]]:
    """Rooms that share no node with an earlier one, and the others."""
    counts: Counter[str] = Counter()
    sound: list[RoomParts] = []
    dropped: list[tuple[str, str]] = []
    for parts in rooms:
        double = next((node.id for node in parts.nodes if counts[node.id]), None)
        if double is not None:
            dropped.append((parts.room_id, f"{double} is also in another room"))
            continue
        counts.update(node.id for node in parts.nodes)
        sound.append(parts)
    return sound, dropped


def _connected(rooms: Sequence[RoomParts], shared: Iterable[Node]) -> Iterator[RoomParts]:
    """The rooms, without edges to what is not there; a door to a room that is not there has yet to be crossed."""
    known = {ROOT_ID, ROBOT_ID, *(node.id for node in shared), *(node.id for parts in rooms for node in parts.nodes)}
    for parts in rooms:
        edges = tuple(edge for edge in parts.edges if {edge.key.source, edge.key.target} <= known)
        yield replace(parts, nodes=tuple(_reopened(node, known) for node in parts.nodes), edges=edges)


def _reopened(node: Node, known: Container[str]) -> Node:
    if isinstance(node, DoorNode) and node.rooms[1] is not None and node.rooms[1] not in known:
        return replace(node, rooms=(node.rooms[0], None), crossing=CrossingStatus.UNCROSSED)
    return node


def _flaws(rooms: Sequence[RoomParts], shared: Sequence[Node]) -> dict[str, str]:
    """Rooms that break an invariant of the graph, with the first reason of each."""
    home = {node.id: parts.room_id for parts in rooms for node in parts.nodes}
    start = RtEdge(source=ROOT_ID, target=ROBOT_ID, T_source_target=SE3.identity())
    nodes = [RootNode(), RobotNode(), *shared, *(node for parts in rooms for node in parts.nodes)]
    whole = Snapshot.of(nodes, [start, *(edge for parts in rooms for edge in parts.edges)])
    found: dict[str, str] = {}
    for violation in check(whole):
        guilty = [home[word] for word in violation.subject.split() if word in home]
        for room in guilty or [parts.room_id for parts in rooms]:
            found.setdefault(room, violation.message)
    return found


def _shifted_room(parts: RoomParts, shift_s: float) -> RoomParts:
    return replace(
        parts,
        nodes=tuple(_shifted(node, shift_s) for node in parts.nodes),
        edges=tuple(_shifted_edge(edge, shift_s) for edge in parts.edges),
    )


def _shifted(node: Node, shift_s: float) -> Node:
    match node:
        case ObjectNode():
            inspected_s = None if node.inspected_s is None else node.inspected_s + shift_s
            first_s, last_s = node.first_seen_s + shift_s, node.last_seen_s + shift_s
            return replace(node, first_seen_s=first_s, last_seen_s=last_s, inspected_s=inspected_s)
        case PersonNode():
            return replace(node, last_seen_s=node.last_seen_s + shift_s)
        case _:
            return node


def _shifted_edge(edge: Edge, shift_s: float) -> Edge:
    match edge:
        case RtEdge() | RelationEdge():
            return replace(edge, stamp_s=edge.stamp_s + shift_s)
        case HasIntentionEdge():
            return replace(edge, proposed_s=edge.proposed_s + shift_s)
        case _:
            return edge
