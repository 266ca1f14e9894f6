"""One room with everything in it, cut out of a snapshot."""

from __future__ import annotations

from dataclasses import dataclass

from scene_graph.edges import Edge, EdgeKey, EdgeType
from scene_graph.nodes import ROBOT_ID, CrossingStatus, DoorNode, Node, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot


@dataclass(frozen=True, kw_only=True)
class RoomParts:
    """A room, its walls, corners, doors, objects, persons and affordances, and every edge at any of them.

    ``edges`` include those that leave the room: ``rt`` from the root, ``match`` and ``connects`` to the neighbors,
    relations to things next door, intentions.
    """

    room_id: str
    nodes: tuple[Node, ...]
    edges: tuple[Edge, ...]


def cut_room(snapshot: Snapshot, room_id: str) -> RoomParts:
    """The parts of a room, the room first, then what hangs from it in the order in which it was hung there.

    Raises:
        NodeNotFound, WrongNodeType: it is no room of the snapshot.
    """
    snapshot.room(room_id)
    ids = list(dict.fromkeys((*_below(snapshot, room_id), *_belonging(snapshot, room_id))))
    edges: dict[EdgeKey, Edge] = {edge.key: edge for node_id in ids for edge in snapshot.edges_at(node_id)}
    return RoomParts(
        room_id=room_id, nodes=tuple(snapshot.node(node_id) for node_id in ids), edges=tuple(edges.values())
    )


def unfinished(node: Node) -> bool:
    """Whether a room is still being measured, or a door still to be looked at or crossed."""
    match node:
        case RoomNode():
            return node.status is RoomStatus.TEMPORARY
        case DoorNode():
            return node.provisional or node.crossing is CrossingStatus.UNCROSSED
        case _:
            return False


def keeps_in_use(snapshot: Snapshot, room_id: str) -> str | None:
    """What would be torn from a room if it were cut out: the robot in it, a thing in the hand, a room hung from it."""
    inside = {edge.source for edge in snapshot.edges_to(room_id, EdgeType.IN)}
    in_hand = set(snapshot.children(ROBOT_ID))
    for frame in _below(snapshot, room_id):
        for child in snapshot.children(frame):
            if child == ROBOT_ID or isinstance(snapshot.get(child), RoomNode):
                return child
    return next(iter(sorted(inside & {ROBOT_ID, *in_hand})), None)


def _below(snapshot: Snapshot, frame: str) -> list[str]:
    """A frame and those below it, owners before their affordances; the robot and rooms of their own are left out."""
    found = [frame, *(edge.target for edge in snapshot.edges_from(frame, EdgeType.HAS))]
    for child in snapshot.children(frame):
        if child != ROBOT_ID and not isinstance(snapshot.get(child), RoomNode):
            found += _below(snapshot, child)
    return found


def _belonging(snapshot: Snapshot, room_id: str) -> list[str]:
    """What is in the room though it hangs from the root."""
    members = (edge.source for edge in snapshot.edges_to(room_id, EdgeType.IN))
    return [
        found
        for member in members
        if (parent := snapshot.parent(member)) is not None
        and parent.source not in (room_id, ROBOT_ID)
        and snapshot.room_of(parent.source) is None
        and member != ROBOT_ID
        for found in _below(snapshot, member)
    ]
