"""The walls of a room as points, and obstacle points explained by them: the ranges' noise must not narrow a room."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from scene_graph.errors import FramesNotConnected
from scene_graph.nodes import ROBOT_ID, DoorNode, DoorState, RoomNode, RoomStatus, WallNode
from scene_graph.snapshot import Snapshot
from skills.geometry import Box2, Points, Pose2, boundary_distance_m, inside_polygon
from skills.obstacles.settings import MapSettings

MIN_CORNERS = 3


@dataclass(frozen=True, kw_only=True, eq=False)
class Walls:
    """Points (N, 2) along the walls of a room, door gaps left out; none where no room stands."""

    points: Points
    tree: cKDTree | None
    skin_m: float = MapSettings.skin_m

    @classmethod
    def of(cls, snapshot: Snapshot, frame: str, settings: MapSettings = MapSettings()) -> Walls:
        """The walls of the room ``frame``, in its frame; none where a part of them was guessed."""
        room = whole_room(snapshot, frame)
        if room is None:
            return cls(points=np.zeros((0, 2)), tree=None)
        corners = np.array(room.polygon_m)
        sides = zip(corners, np.roll(corners, -1, axis=0), strict=True)
        points = np.concatenate(
            [np.linspace(a, b, int(np.hypot(*(b - a)) / settings.wall_step_m) + 2) for a, b in sides]
        )
        for gap in door_gaps(snapshot, frame, settings):
            points = points[~gap.contains(points)]
        return cls(points=points, tree=cKDTree(points) if len(points) else None, skin_m=settings.skin_m)

    @classmethod
    def known(cls, snapshot: Snapshot, frame: str, settings: MapSettings = MapSettings()) -> Walls:
        """As ``of``; of a room that was not seen whole, the walls that are known, to which an arm must keep."""
        if whole_room(snapshot, frame) is not None:
            return cls.of(snapshot, frame, settings)
        lines = [
            Pose2.of(snapshot.transform(frame, wall.id)).apply(_along(wall.length_m, settings))
            for wall in snapshot.of_type(WallNode)
            if wall.parent_room == frame
        ]
        points = np.concatenate(lines) if lines else np.zeros((0, 2))
        for gap in door_gaps(snapshot, frame, settings):
            points = points[~gap.contains(points)]
        return cls(points=points, tree=cKDTree(points) if len(points) else None, skin_m=settings.skin_m)

    def explain(self, points: Points) -> Points:
        """``points`` (N, 2) without those that are a known wall, and the walls themselves."""
        if self.tree is None or not len(points):
            return points
        far, _ = self.tree.query(points, distance_upper_bound=self.skin_m)
        return np.concatenate([points[np.isinf(far)], self.points])


def _along(length_m: float, settings: MapSettings) -> Points:
    """Points (N, 2) along a wall, in its frame."""
    x_m = np.linspace(-length_m / 2, length_m / 2, int(length_m / settings.wall_step_m) + 2)
    return np.stack([x_m, np.zeros_like(x_m)], axis=1)


def whole_room(snapshot: Snapshot, frame: str) -> RoomNode | None:
    """The room ``frame`` if it was seen whole; the outline of any other is partly guessed."""
    room = snapshot.get(frame)
    if isinstance(room, RoomNode) and room.status is RoomStatus.PERMANENT and len(room.polygon_m) >= MIN_CORNERS:
        return room
    return None


def door_gaps(snapshot: Snapshot, room: str, settings: MapSettings = MapSettings()) -> list[Box2]:
    """Passages through the walls of ``room`` that are not closed, in its frame, a little deeper than the wall."""
    gaps = []
    for door in snapshot.of_type(DoorNode):
        if door.rooms[0] == room and door.state is not DoorState.CLOSED:
            pose = Pose2.of(snapshot.transform(room, door.id))
            x_m, y_m = pose.apply(np.array([[0.0, settings.door_middle_m - settings.door_depth_m]]))[0]
            gaps.append(Box2(Pose2(float(x_m), float(y_m), pose.yaw_rad), door.width_m, 2 * settings.door_depth_m))
    return gaps


def robot_beyond_m(snapshot: Snapshot, settings: MapSettings = MapSettings()) -> float:
    """How far the robot is beyond the walls of the room that it hangs from: outdoors, or where nothing is measured yet.

    0 inside, in the gap of a door that is not closed, and where the room was not seen whole.
    """
    room = whole_room(snapshot, snapshot.current_room or "")
    if room is None:
        return 0.0
    try:
        x_m, y_m, _ = (float(value) for value in snapshot.position(ROBOT_ID, room.id))
    except FramesNotConnected:
        return 0.0
    at = np.array([[x_m, y_m]])
    if inside_polygon(room.polygon_m, at)[0] or any(
        gap.contains(at)[0] for gap in door_gaps(snapshot, room.id, settings)
    ):
        return 0.0
    beyond_m = boundary_distance_m(room.polygon_m, (x_m, y_m))
    return beyond_m if beyond_m > settings.beyond_m else 0.0
