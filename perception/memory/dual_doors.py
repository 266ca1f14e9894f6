"""Doors as dual objects: one physical door with coordinates in two rooms (Concepts, section 3.6)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.crossing import match_of
from perception.geometry.planar import Pose2, wrap
from perception.localization.room_model import RoomModel
from scene_graph.nodes import ROOT_ID, DoorNode
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class DualDoorSettings:
    """When two sides of a wall are of one door."""

    thickest_wall_m: float = 0.6
    """Between its two faces. Chosen: thicker than walls of houses are."""
    parallel_rad: float = float(np.deg2rad(12.0))
    """Between these faces: errors of the layout's headings."""
    slack_m: float = 0.15
    """Errors of the layout where a door is looked for in the other room."""
    thicker_m: float = 0.1
    """By which a wall may seem thicker than the thickest: errors of the layout."""
    aside_m: float = 0.2
    """Between the middles of the two sides, along the wall: errors of the layout."""
    wider_m: float = 0.15
    """Between their widths: errors of their posts, before all are measured."""


@dataclass(frozen=True, kw_only=True)
class SeenFrom:
    """A door's place in the other room.

    The wall's index, the station of its center from the wall's start, and how thick the wall between the two faces is.
    Meters.
    """

    wall: int
    station_m: float
    thickness_m: float


def place_in(
    room: RoomModel,
    T_room_door: Pose2,
    settings: DualDoorSettings = DualDoorSettings(),
    *,
    slack_m: float | None = None,
) -> SeenFrom | None:
    """Where in ``room`` a door of the neighboring room must be, given its frame in ``room``.

    The door's frame has y pointing into its own room; seen from here, the gap is in the wall whose normal points the
    other way, at most a wall's thickness away. ``slack_m``: error that the layout may have, if it
    is not the usual one.
    """
    slack_m = settings.slack_m if slack_m is None else slack_m
    through = -T_room_door.rotation()[:, 1]
    best: SeenFrom | None = None
    for wall in range(len(room.polygon)):
        start, end = room.polygon[wall], room.polygon[(wall + 1) % len(room.polygon)]
        length_m = float(np.linalg.norm(end - start))
        along = (end - start) / length_m
        normal = np.array([-along[1], along[0]])
        if float(normal @ through) < np.cos(settings.parallel_rad):
            continue
        thickness_m = -float(normal @ (T_room_door.position_m - start))
        station_m = float(along @ (T_room_door.position_m - start))
        fits = -slack_m < thickness_m < settings.thickest_wall_m + slack_m and -slack_m < station_m < length_m + slack_m
        if fits and (best is None or abs(thickness_m) < abs(best.thickness_m)):
            best = SeenFrom(wall=wall, station_m=station_m, thickness_m=thickness_m)
    return best


def same_door(
    T_root_first: Pose2,
    T_root_second: Pose2,
    widths_m: tuple[float, float],
    settings: DualDoorSettings = DualDoorSettings(),
) -> bool:
    """Whether two doors, each known from its own room, can be the two sides of one gap."""
    facing = abs(wrap(T_root_first.yaw_rad - T_root_second.yaw_rad + np.pi)) < settings.parallel_rad
    between = T_root_first.inverse() @ T_root_second
    across = -settings.slack_m < -between.y_m < settings.thickest_wall_m + settings.thicker_m
    alike = abs(between.x_m) < settings.aside_m and abs(widths_m[0] - widths_m[1]) < settings.wider_m
    return bool(facing and across and alike)


def root_pose(snapshot: Snapshot, frame: str) -> Pose2:
    """Pose of a frame in the root."""
    return Pose2.from_se3(snapshot.transform(ROOT_ID, frame))


def unmatched_doors(snapshot: Snapshot) -> list[DoorNode]:
    """Permanent doors known from one side only."""
    doors = snapshot.of_type(DoorNode)
    return [door for door in doors if not door.provisional and match_of(snapshot, door.id) is None]


def through_door(snapshot: Snapshot, door_id: str, other_id: str) -> Pose2:
    """``T_room_other``: the far room's frame in the near room's, by laying the two frames of one door on each other.

    The door's frames share the gap's middle and turn their backs on each other; only the wall's thickness is taken from
    the layout.
    """
    near, far = snapshot.door(door_id).rooms[0], snapshot.door(other_id).rooms[0]
    between = root_pose(snapshot, door_id).inverse() @ root_pose(snapshot, other_id)
    T_near_door = Pose2.from_se3(snapshot.transform(near, door_id))
    T_far_other = Pose2.from_se3(snapshot.transform(far, other_id))
    return T_near_door @ back_to_back(-between.y_m) @ T_far_other.inverse()


def back_to_back(thickness_m: float) -> Pose2:
    """``T_door_other`` of the two faces of one gap in a wall of this thickness."""
    return Pose2(0.0, -thickness_m, np.pi)
