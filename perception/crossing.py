"""How agents tell each other through the graph what nobody can explain yet: doors, rooms, where the robot is.

Between "the robot went through" and "the room behind it stands", a door carries ``BEING_CROSSED`` as its crossing
reason. The room concept measures while it does; the door concept proposes nothing; long-term memory replaces it by the
outcome. A robot that is lost is not ``localized``; a room that is believed no longer is temporary again, though it has
an outline, and the room concept measures it anew.
"""

from __future__ import annotations

from dataclasses import replace

from perception.geometry.planar import Pose2, diagonal_covariance, spatial_covariance
from scene_graph.edges import EdgeKey, EdgeType, InEdge, IntentionAction, IntentionStatus, RtEdge
from scene_graph.memory import Transaction
from scene_graph.nodes import ROBOT_ID, ROOT_ID, CrossingStatus, DoorNode, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

BEING_CROSSED = "being crossed"
CLOSED_REASON = "closed"
OUTDOORS = "nothing behind it looks like a room"
DOOR_AGENT = "door_concept"


def door_being_crossed(snapshot: Snapshot) -> DoorNode | None:
    """The door whose far side the robot is on without knowing it, if any."""
    return next((door for door in snapshot.of_type(DoorNode) if is_being_crossed(door)), None)


def nothing_left(snapshot: Snapshot) -> bool:
    """Whether every door is crossed or given up, every room stands, and nobody but tasks wants the robot.

    The agent that looks around in rooms asks for it by an intention, so an open one keeps the building unexplored.
    """
    rooms, doors = snapshot.of_type(RoomNode), snapshot.of_type(DoorNode)
    return (
        len(rooms) > 0
        and all(room.status is not RoomStatus.TEMPORARY for room in rooms)
        and all(not door.provisional and door.crossing is not CrossingStatus.UNCROSSED for door in doors)
        and not any(edge.is_open and edge.explores for edge in snapshot.intentions())
    )


def is_being_crossed(door: DoorNode) -> bool:
    """Whether the robot is behind this door without knowing where that is."""
    return door.crossing is CrossingStatus.UNCROSSED and door.crossing_reason == BEING_CROSSED


def mark_being_crossed(door: DoorNode) -> DoorNode:
    """The door, while the robot is behind it without knowing where that is."""
    return replace(door, crossing_reason=BEING_CROSSED)


def given_up(door: DoorNode, reason: str) -> DoorNode:
    """The door, no longer to be explored."""
    return replace(door, crossing=CrossingStatus.GIVEN_UP, crossing_reason=reason)


def uncrossed(door: DoorNode) -> DoorNode:
    """The door, to be explored again."""
    return replace(door, crossing=CrossingStatus.UNCROSSED, crossing_reason="")


def cross_affordance(door_id: str) -> str:
    """Identifier of the affordance to cross a permanent door."""
    return "aff_cross_" + door_id.removeprefix("door_")


def match_of(snapshot: Snapshot, door_id: str) -> str | None:
    """The same physical door as known from its other room, if it is."""
    for edge in (*snapshot.edges_from(door_id, EdgeType.MATCH), *snapshot.edges_to(door_id, EdgeType.MATCH)):
        return edge.target if edge.source == door_id else edge.source
    return None


def match_key(first: str, second: str) -> EdgeKey:
    """Key of the match edge between two doors."""
    source, target = sorted((first, second))
    return EdgeKey(EdgeType.MATCH, source, target)


def move_robot(tx: Transaction, room_id: str, T_room_base: Pose2, stamp_s: float, std: float = 0.005) -> None:
    """Hang the robot from a room, and say that it is in it."""
    for edge in (*tx.snapshot.edges_to(ROBOT_ID, EdgeType.RT), *tx.snapshot.edges_from(ROBOT_ID, EdgeType.IN)):
        tx.remove(edge.key)
    tx.put(
        RtEdge(
            source=room_id,
            target=ROBOT_ID,
            T_source_target=T_room_base.to_se3(),
            covariance=spatial_covariance(diagonal_covariance(std, std, std / 3.0)),
            stamp_s=stamp_s,
        ),
        InEdge(source=ROBOT_ID, target=room_id),
    )


def lose_robot(tx: Transaction, std: float = 1.0) -> None:
    """Say that nobody knows where the robot is: it is in no room, and hangs from the root by the last guess.

    Whoever restores a building in which the robot may stand anywhere says it in the same way; the relocalization agent
    then finds the place. ``std``: meters and radians, how far off the guess may be, as far as a covariance can say it.
    """
    snapshot = tx.snapshot
    robot, edge = snapshot.robot, snapshot.parent(ROBOT_ID)
    if robot is None or edge is None:
        raise LookupError("the robot hangs from nothing")
    guess = Pose2.from_se3(snapshot.transform(ROOT_ID, ROBOT_ID))
    for old in (*snapshot.edges_to(ROBOT_ID, EdgeType.RT), *snapshot.edges_from(ROBOT_ID, EdgeType.IN)):
        tx.remove(old.key)
    for done in snapshot.intentions(IntentionStatus.DONE):
        if done.action is IntentionAction.CROSS:  # where it led to, nobody can tell now
            tx.remove(done.key)
    door = door_being_crossed(snapshot)
    if door is not None:
        tx.put(uncrossed(door))
    tx.put(
        replace(robot, localized=False, confidence=0.0),
        RtEdge(
            source=ROOT_ID,
            target=ROBOT_ID,
            T_source_target=guess.to_se3(),
            covariance=spatial_covariance(diagonal_covariance(std, std, std)),
            stamp_s=edge.stamp_s,
        ),
    )


def find_robot(tx: Transaction, room_id: str, T_room_base: Pose2, stamp_s: float, std: float = 0.02) -> None:
    """Say where the robot is after it was lost."""
    robot = tx.snapshot.robot
    if robot is None:
        raise LookupError("there is no robot")
    tx.put(replace(robot, localized=True, confidence=1.0))
    move_robot(tx, room_id, T_room_base, stamp_s, std)


def is_lost(snapshot: Snapshot) -> bool:
    """Whether the robot does not know where it is."""
    robot = snapshot.robot
    return robot is not None and not robot.localized


def in_doubt(snapshot: Snapshot) -> bool:
    """Whether what is seen now should not be believed to be where the robot believes to be."""
    robot = snapshot.robot
    return robot is None or not robot.localized or robot.confidence < 1.0


def taken_back(snapshot: Snapshot) -> RoomNode | None:
    """The room that the robot is in, when it was taken back and waits to be measured again."""
    edge = snapshot.parent(ROBOT_ID)
    room = snapshot.get(edge.source) if edge is not None else None
    if isinstance(room, RoomNode) and room.status is RoomStatus.TEMPORARY and room.polygon_m:
        return room
    return None


def take_back(tx: Transaction, room_id: str) -> None:
    """Believe a room's outline no longer; its walls stay in the graph until they are replaced."""
    tx.put(replace(tx.snapshot.room(room_id), status=RoomStatus.TEMPORARY))
