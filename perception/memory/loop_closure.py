"""Recognizing a room: is the robot in a room that is known already (loop closure, Concepts, section 3.6)?

A candidate must lie where the layout, as uncertain as it is, allows it, must have the shape that is seen, and must have
its doors where they are seen. Above all, the door that the robot came through must not be one that leads elsewhere: the
twin of an office has its own.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from perception.crossing import match_of
from perception.geometry.planar import Pose2, planar_covariance, wrap
from perception.geometry.polygon import shared_area
from perception.localization.doorways import Doorway, DoorwayModel, doorway_model
from perception.localization.global_localization import GlobalLocalizationSettings, KnownRoom, Sight, hypotheses
from perception.localization.room_model import RoomModel, room_model
from perception.memory.dual_doors import DualDoorSettings, place_in, root_pose
from perception.memory.registration import register_outline
from scene_graph.nodes import ROOT_ID, DoorNode, DoorState, ObjectNode, RoomNode
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class LoopClosureSettings:
    """What a known room must stand up to."""

    drift_m: float = 0.15
    """Errors of the layout that its own covariance does not know of, one standard deviation. Chosen."""
    drift_rad: float = 0.04
    """The same of headings."""
    gate: float = 16.0
    """Chi-square of the way from where the layout has it: four standard deviations."""
    explained: float = 0.75
    """Least share of the scan on its walls, as of a pose that is believed (``localization.fitness``)."""
    passed: float = 0.03
    """Largest share behind them."""
    margin: float = 5.0
    """By which logarithm of the odds one candidate must beat another room. Chosen: 150 to one."""
    overlap: float = 0.5
    """Shared area from which two rooms cannot both be there. Chosen: half of both together."""
    touch: float = 0.1
    """And from which their shapes are compared. Chosen: more than a thin wall that lies wrong."""
    door_m: float = 0.45
    """Farthest that a door, or a piece of furniture, is from itself: three times the drift."""
    misfit_m: float = 0.12
    """Farthest that a corner is from itself once one outline is laid on the other. Chosen."""
    entrance_m: float = 0.5
    """Farthest that the door which the robot came through is from where the layout has it."""
    entrance_wider_m: float = 0.6
    """And how much wider its doorway may seem for that."""
    localization: GlobalLocalizationSettings = field(default_factory=lambda: GlobalLocalizationSettings(tries=6))
    """Fewer tries per room than for a lost robot: there is a guess."""
    dual: DualDoorSettings = field(default_factory=DualDoorSettings)


@dataclass(frozen=True, kw_only=True)
class Recognized:
    """The known room that the robot is in, and where in it."""

    room_id: str
    T_room_base: Pose2


@dataclass(frozen=True, kw_only=True)
class SameRoom:
    """The older of two rooms that are one, and how the newer one's frame lies in it."""

    room_id: str
    T_old_new: Pose2


def recognize(
    snapshot: Snapshot,
    T_near_base: Pose2,
    sight: Sight,
    door: DoorNode,
    settings: LoopClosureSettings = LoopClosureSettings(),
) -> Recognized | None:
    """The known room that ``sight`` shows behind ``door``, which the robot came through; ``None`` when it is a new one.

    ``T_near_base``: where the robot is, in the room that it came from. Two rooms that both could be it are not decided
    between.
    """
    near = door.rooms[0]
    found: list[tuple[float, Recognized]] = []
    for room in snapshot.of_type(RoomNode):
        model = room_model(snapshot, room.id)
        if model is None or room.id == near:
            continue
        guess = root_pose(snapshot, room.id).inverse() @ root_pose(snapshot, near) @ T_near_base
        std_m, std_rad = _drift(snapshot, near, room.id, settings)
        if model.depth_m(guess.position_m) < -np.sqrt(settings.gate) * std_m:
            continue
        doors = _with_entrance(snapshot, model, door, guess @ T_near_base.inverse(), settings)
        for one in hypotheses([sight], [KnownRoom(room=model, doors=doors)], settings.localization):
            surprise = _surprise(guess, one.T_room_base, std_m, std_rad)
            fits = one.fit.explained >= settings.explained and one.fit.passed <= settings.passed and one.conditioned
            T_room_near = one.T_room_base @ T_near_base.inverse()
            possible = one.doorways.strange == 0 and leads_nowhere_else(snapshot, model, door, T_room_near, settings)
            if fits and possible and surprise < settings.gate:
                place = Recognized(room_id=room.id, T_room_base=one.T_room_base)
                found.append((one.evidence - surprise / 2.0, place))
    found.sort(key=lambda item: -item[0])
    rivals = [score for score, place in found if place.room_id != found[0][1].room_id]
    if not found or (rivals and found[0][0] - rivals[0] < settings.margin):
        return None
    return found[0][1]


def same_room(
    snapshot: Snapshot,
    room_id: str,
    door: DoorNode | None = None,
    settings: LoopClosureSettings = LoopClosureSettings(),
) -> SameRoom | None:
    """An older room that a newly measured one, entered through ``door``, turns out to be.

    Two rooms cannot take the same place. Where the layout has them only touch, they are one if one outline can be laid
    on the other within what the layout may be off, and doors and furniture agree.
    """
    new = room_model(snapshot, room_id)
    if new is None:
        return None
    for room in snapshot.of_type(RoomNode):
        old = room_model(snapshot, room.id)
        if old is None or room.id == room_id or (door is not None and room.id == door.rooms[0]):
            continue
        T_old_new = root_pose(snapshot, room.id).inverse() @ root_pose(snapshot, room_id)
        shared = overlap(old, T_old_new.apply(new.polygon))
        if shared < settings.touch:
            continue
        laid = register_outline(old.polygon, new.polygon, T_old_new, most_m=settings.misfit_m)
        std_m, std_rad = _drift(snapshot, room_id, room.id, settings)
        near_by = laid is not None and _surprise(T_old_new, laid, std_m, std_rad) < settings.gate
        place = laid if laid is not None and near_by else T_old_new
        if not (near_by or shared > settings.overlap):
            continue
        if _agree(snapshot, old, new, place, settings) and _entered(snapshot, old, room_id, door, place, settings):
            return SameRoom(room_id=room.id, T_old_new=place)
    return None


def leads_nowhere_else(
    snapshot: Snapshot,
    room: RoomModel,
    door: DoorNode,
    T_room_near: Pose2,
    settings: LoopClosureSettings = LoopClosureSettings(),
) -> bool:
    """Whether ``door``, seen from ``room``, is not at a door that is known to lead to another one.

    ``T_room_near``: where the room that ``door`` was found from would be.
    """
    T_room_door = T_room_near @ Pose2.from_se3(snapshot.transform(door.rooms[0], door.id))
    for other in snapshot.of_type(DoorNode):
        if other.rooms[0] == room.room_id and match_of(snapshot, other.id) not in (None, door.id):
            T_room_other = Pose2.from_se3(snapshot.transform(room.room_id, other.id))
            between = T_room_other.inverse() @ T_room_door
            facing = abs(wrap(between.yaw_rad - np.pi)) < np.pi / 6.0
            if facing and abs(between.x_m) < settings.door_m and abs(between.y_m) < 2.0 * settings.door_m:
                return False
    return True


def _with_entrance(
    snapshot: Snapshot, room: RoomModel, door: DoorNode, T_room_near: Pose2, settings: LoopClosureSettings
) -> DoorwayModel:
    """The doors of a room with the one that the robot would have come through, which nobody may have seen from it."""
    doors = doorway_model(snapshot, room)
    T_room_door = T_room_near @ Pose2.from_se3(snapshot.transform(door.rooms[0], door.id))
    place = place_in(room, T_room_door, settings.dual, slack_m=settings.entrance_m)
    if place is None:
        return doors
    width_m = door.width_m + settings.entrance_wider_m
    entrance = Doorway(wall=place.wall, center_m=place.station_m, width_m=width_m, state=DoorState.UNKNOWN)
    return replace(doors, doorways=(*doors.doorways, entrance))


def _drift(snapshot: Snapshot, first: str, second: str, settings: LoopClosureSettings) -> tuple[float, float]:
    """How far the layout may have two rooms off each other, standard deviations in meters and radians."""
    covariances = [planar_covariance(snapshot.transform_with_covariance(ROOT_ID, room)[1]) for room in (first, second)]
    variance = np.sum(covariances, axis=0)
    std_m = float(np.sqrt(max(variance[0, 0], variance[1, 1]) + settings.drift_m**2))
    return std_m, float(np.sqrt(variance[2, 2] + settings.drift_rad**2))


def _surprise(expected: Pose2, found: Pose2, std_m: float, std_rad: float) -> float:
    """Chi-square of a pose that was found elsewhere than expected."""
    turned = wrap(found.yaw_rad - expected.yaw_rad)
    return float((expected.distance_m(found) / std_m) ** 2 + (turned / std_rad) ** 2)


def _entered(
    snapshot: Snapshot,
    old: RoomModel,
    room_id: str,
    door: DoorNode | None,
    T_old_new: Pose2,
    settings: LoopClosureSettings,
) -> bool:
    """Whether the robot can have come into ``old`` through ``door``."""
    if door is None:
        return True
    T_new_near = root_pose(snapshot, room_id).inverse() @ root_pose(snapshot, door.rooms[0])
    return leads_nowhere_else(snapshot, old, door, T_old_new @ T_new_near, settings)


def _agree(snapshot: Snapshot, old: RoomModel, new: RoomModel, T_old_new: Pose2, settings: LoopClosureSettings) -> bool:
    """Whether most doors of the new room are doors of the old one, and some furniture too, where both have any."""
    doors = _places(snapshot, old.room_id, DoorNode), _places(snapshot, new.room_id, DoorNode)
    things = _places(snapshot, old.room_id, ObjectNode), _places(snapshot, new.room_id, ObjectNode)
    for theirs, ours in (doors, things):
        alike = [
            any(
                label == other and float(np.linalg.norm(T_old_new.apply(point) - place)) < settings.door_m
                for other, place in theirs
            )
            for label, point in ours
        ]
        if theirs and ours and 2 * sum(alike) < len(alike):
            return False
    return True


def _places(snapshot: Snapshot, room_id: str, kind: type[DoorNode | ObjectNode]) -> list[tuple[str, Array]]:
    """Label and position (2,) in the room of its permanent doors, or of the furniture that stands in it."""
    found: list[tuple[str, Array]] = []
    for node in snapshot.of_type(kind):
        if isinstance(node, DoorNode):
            counts, label = node.rooms[0] == room_id and not node.provisional, "door"
        else:
            counts, label = node.support and snapshot.room_of(node.id) == room_id, node.label
        if counts:
            x_m, y_m, _ = snapshot.position(node.id, room_id)
            found.append((label, np.array([float(x_m), float(y_m)])))
    return found


def overlap(room: RoomModel, polygon: Array) -> float:
    """Shared area of a room and a polygon in its frame, over the area of both together; by sampling."""
    area, other, shared = shared_area(room.polygon, polygon)
    return shared / max(area + other - shared, 1)
