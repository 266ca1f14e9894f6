"""The edits of long-term memory: joining two rooms by a door, removing a room that was another one."""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from perception.crossing import cross_affordance, match_key
from perception.doors.insertion import DoorNodeSettings, door_label, free_door_id, hang
from perception.doors.posts import MeasuredGap
from perception.geometry.planar import Pose2
from perception.localization.room_model import RoomModel
from perception.memory.dual_doors import SeenFrom
from perception.rooms.survey.instance import wall_elements
from scene_graph.edges import ConnectsEdge, EdgeType, HasEdge, MatchEdge
from scene_graph.identifiers import wall_id_of
from scene_graph.memory import Transaction
from scene_graph.nodes import AffordanceKind, AffordanceNode, CrossingStatus, DoorNode
from scene_graph.snapshot import Snapshot


@dataclass(frozen=True, kw_only=True)
class JoiningSettings:
    """How sure is what a passage says about its two rooms."""

    walked_std_m: float = 0.012
    """Of the way through a door that was driven: odometry over a meter and the poses on either side."""
    unwalked_std_m: float = 0.05
    """The same where the layout alone has it. Chosen."""
    predicted_confidence: float = 0.7
    """Of a door, and of a wall, known from its other side only: less than of one whose post is measured."""
    predicted_wall_std_m: float = 0.1
    """Of a wall that only its door tells of: how thick walls differ."""
    doors: DoorNodeSettings = field(default_factory=DoorNodeSettings)


def put_dual(
    tx: Transaction,
    door: DoorNode,
    room: RoomModel,
    place: SeenFrom,
    stamp_s: float,
    settings: JoiningSettings = JoiningSettings(),
) -> DoorNode:
    """The far side of ``door`` in ``room``, where it was predicted; the door concept will measure it.

    Where the room's wall there has not been seen, the door is what tells of it.
    """
    door_id = free_door_id(tx.snapshot, room.room_id, place.wall)
    length_m = float(np.linalg.norm(np.roll(room.polygon, -1, axis=0)[place.wall] - room.polygon[place.wall]))
    center_m = float(np.clip(place.station_m, door.width_m / 2.0, length_m - door.width_m / 2.0))
    wall_id = wall_id_of(room.room_id, place.wall)
    if wall_id not in tx.snapshot:
        doubt = {"std_m": settings.predicted_wall_std_m, "confidence": settings.predicted_confidence}
        tx.put(*wall_elements(room.polygon, room.room_id, place.wall, stamp_s=stamp_s, **doubt))
    gap = MeasuredGap(center_m=center_m, width_m=door.width_m, std_m=settings.doors.predicted_std_m, posts=0)
    dual = DoorNode(
        id=door_id,
        label=door_label(door.width_m, settings.doors),
        confidence=settings.predicted_confidence,
        rooms=(room.room_id, None),
        width_m=door.width_m,
        height_m=door.height_m,
        state=door.state,
        provisional=False,
    )
    affordance_id = cross_affordance(door_id)
    tx.put(
        dual,
        hang(door_id, wall_id, length_m, gap, stamp_s),
        AffordanceNode(id=affordance_id, kind=AffordanceKind.CROSS, target=door_id),
        HasEdge(source=door_id, target=affordance_id),
    )
    return dual


def join(
    tx: Transaction,
    first: DoorNode,
    second: DoorNode,
    T_near_far: Pose2,
    *,
    std_m: float = JoiningSettings.walked_std_m,
) -> None:
    """Two door nodes are one physical door, and its two rooms are known.

    ``T_near_far``: how the room of ``second`` lies in that of ``first`` by what was driven between them, with the
    standard deviation of its translation; it gives the thickness of the wall, each time that the rooms are laid out.
    """
    for door, other in ((first, second), (second, first)):
        near, far = door.rooms[0], other.rooms[0]
        tx.put(
            replace(door, rooms=(near, far), crossing=CrossingStatus.CROSSED, crossing_reason=""),
            ConnectsEdge(source=door.id, target=near),
            ConnectsEdge(source=door.id, target=far),
        )
    key = match_key(first.id, second.id)
    walked = T_near_far if key.source == first.id else T_near_far.inverse()
    tx.put(walked_match(MatchEdge(source=key.source, target=key.target), walked, std_m))


def walked_match(match: MatchEdge, T_source_target: Pose2, std_m: float) -> MatchEdge:
    """The match, with the target's room in the source's as it was driven."""
    walked = (T_source_target.x_m, T_source_target.y_m, T_source_target.yaw_rad)
    return replace(match, walked=walked, walked_std_m=std_m)


def remove_room(tx: Transaction, room_id: str) -> None:
    """Remove a room with everything that hangs from it; the robot must hang elsewhere already."""
    for node_id in _hanging(tx.snapshot, room_id):
        tx.remove(node_id)


def _hanging(snapshot: Snapshot, node_id: str) -> list[str]:
    """The node and all below it in the tree of frames, affordances included, leaves first; never the robot."""
    below: list[str] = []
    for child in snapshot.children(node_id):
        if child != "robot":
            below += _hanging(snapshot, child)
    below += [edge.target for edge in snapshot.edges_from(node_id, EdgeType.HAS)]
    return [*below, node_id]
