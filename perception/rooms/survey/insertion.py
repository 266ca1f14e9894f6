"""The edits of the room concept: propose a visit, withdraw it, insert the measured room (Concepts, figure 3)."""

from __future__ import annotations

from perception.crossing import move_robot
from perception.geometry.planar import Pose2, diagonal_covariance, planar_covariance, spatial_covariance
from perception.rooms.survey.instance import InstanceSettings, MeasuredRoom, room_elements
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus, Priority, RtEdge
from scene_graph.memory import Transaction
from scene_graph.nodes import ROBOT_ID, ROOT_ID, RoomNode, RoomStatus

ROOM_AGENT = "room_concept"
_UNMEASURED = diagonal_covariance(0.3, 0.3, 0.1)
"""Of a place to measure from, which nothing is told by: it only says that nobody has measured it."""


def propose_visit(tx: Transaction, room_id: str, *, parent: str, T_parent_place: Pose2, stamp_s: float) -> None:
    """A temporary room at the place to measure from, and the wish to go there."""
    if room_id not in tx.snapshot:
        tx.put(RoomNode(id=room_id, confidence=0.5, status=RoomStatus.TEMPORARY))
    tx.put(
        RtEdge(
            source=parent,
            target=room_id,
            T_source_target=T_parent_place.to_se3(),
            covariance=spatial_covariance(_UNMEASURED),
            stamp_s=stamp_s,
        ),
        HasIntentionEdge(
            source=ROBOT_ID,
            target=room_id,
            agent=ROOM_AGENT,
            action=IntentionAction.VISIT,
            status=IntentionStatus.PROPOSED,
            priority=Priority.MEASURE_ROOM,
            proposed_s=stamp_s,
        ),
    )


def withdraw(tx: Transaction) -> None:
    """Remove the temporary room with the wish to visit it."""
    for edge in tx.snapshot.intentions():
        if edge.agent != ROOM_AGENT:
            continue
        room = tx.snapshot.get(edge.target)
        temporary = isinstance(room, RoomNode) and room.status is RoomStatus.TEMPORARY
        tx.remove(edge.target if temporary else edge.key)


def insert_room(
    tx: Transaction,
    room: MeasuredRoom,
    room_id: str,
    *,
    status: RoomStatus,
    height_m: float,
    stamp_s: float,
    settings: InstanceSettings = InstanceSettings(),
) -> None:
    """The room with its walls and corners hangs from the root, and the robot from the room."""
    snapshot = tx.snapshot
    edge = snapshot.parent(ROBOT_ID)
    if edge is None:
        raise LookupError("the robot hangs from nothing")
    withdraw(tx)
    T_root_parent, parent_covariance = snapshot.transform_with_covariance(ROOT_ID, edge.source)
    T_parent_room = room.T_parent_room
    adjoint = T_parent_room.inverse().adjoint()
    covariance = adjoint @ planar_covariance(parent_covariance) @ adjoint.T + room.covariance
    tx.put(*room_elements(room, room_id, status=status, height_m=height_m, stamp_s=stamp_s, settings=settings))
    tx.put(
        RtEdge(
            source=ROOT_ID,
            target=room_id,
            T_source_target=(Pose2.from_se3(T_root_parent) @ T_parent_room).to_se3(),
            covariance=spatial_covariance(covariance),
            stamp_s=stamp_s,
        )
    )
    move_robot(tx, room_id, room.T_room_base, stamp_s)
