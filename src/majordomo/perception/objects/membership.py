"""Which room a thing belongs to: exactly one, by the polygons of the robot's room and of the rooms behind its doors."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from majordomo.scene_graph.errors import FramesNotConnected
from majordomo.scene_graph.nodes import DoorNode, Point2, RoomNode, RoomStatus
from majordomo.scene_graph.se3 import SE3
from majordomo.scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]
_FACE_M = 0.06
"""How far inside a wall's face a point may be measured and still be of the wall."""
_NEAR_FACE_M = 0.04
"""The same for points of furniture in front of it, which would lose depth."""
_WALL_M = 0.5
"""What is farther behind a wall's face than this is seen past the wall, through a door, and stands in another room."""
_FLOOR_M = 0.04
MARGIN_M = 0.15
"""How far outside the inner face of a wall the center of a thing may be measured and still belong to the room."""


def outside_distance_m(polygon_m: tuple[Point2, ...], point: Array) -> float:
    """Signed distance of a point (2,) from a simple polygon: negative inside, positive outside."""
    return float(outside_distances_m(polygon_m, np.asarray(point, dtype=np.float64)[None])[0])


def outside_distances_m(polygon_m: tuple[Point2, ...], points: Array) -> Array:
    """(N,) the same for points (N, 2)."""
    corners = np.asarray(polygon_m, dtype=np.float64)
    ends = np.roll(corners, -1, axis=0)
    sides = ends - corners
    lengths = np.maximum((sides**2).sum(axis=1), 1e-12)
    away = points[:, None] - corners
    along = np.clip((away * sides).sum(axis=2) / lengths, 0.0, 1.0)
    distances = np.linalg.norm(away - along[:, :, None] * sides, axis=2).min(axis=1)
    straddles = (corners[:, 1] > points[:, None, 1]) != (ends[:, 1] > points[:, None, 1])
    rise = np.where(straddles, ends[:, 1] - corners[:, 1], 1.0)
    crossing_x = corners[:, 0] + away[:, :, 1] / rise * sides[:, 0]
    inside = np.count_nonzero(straddles & (points[:, None, 0] < crossing_x), axis=1) % 2 == 1
    return np.asarray(np.where(inside, -distances, distances))


class Surroundings:
    """The robot's room and its neighbors, with their polygons, at one revision.

    Attributes:
        room: the robot's room.
        T_here_room: room -> ``T_here_room`` for the robot's room and each neighbor.
    """

    def __init__(self, snapshot: Snapshot, room: str) -> None:
        self.room = room
        self.T_here_room: dict[str, SE3] = {room: SE3.identity()}
        self._polygons: dict[str, tuple[Point2, ...]] = {room: snapshot.room(room).polygon_m}
        for neighbor in _neighbors(snapshot, room):
            try:
                self.T_here_room[neighbor] = snapshot.transform(room, neighbor)
            except FramesNotConnected:
                continue
            self._polygons[neighbor] = snapshot.room(neighbor).polygon_m

    def room_of(self, point_here: Array) -> str | None:
        """The room that a point (3,) in the robot's room frame lies in, or ``None`` for one in no known room.

        A point in two polygons is the robot's room's; one in a wall is of the room it is nearest to.
        """
        distances = {
            room: outside_distance_m(polygon, self.T_here_room[room].inverse().apply(point_here)[:2])
            for room, polygon in self._polygons.items()
            if polygon
        }
        if self.room not in distances or distances[self.room] <= 0.0:
            return self.room
        nearest = min(distances, key=lambda room: (distances[room], room))
        return nearest if distances[nearest] <= MARGIN_M else None

    def in_walls(self, points_here: Array) -> float:
        """Share of points (N, 3) in the robot's room frame that lie on the faces of walls or in them."""
        depth_m = self._depth_m(points_here)
        return float(np.mean((depth_m > -_FACE_M) & (depth_m < _WALL_M))) if len(points_here) else 0.0

    def of_building(self, points_here: Array) -> NDArray[np.bool_]:
        """Which of the points (N, 3) in the robot's room frame lie on the floor, or on a wall's face or in the wall."""
        depth_m = self._depth_m(points_here)
        return (points_here[:, 2] < _FLOOR_M) | ((depth_m > -_NEAR_FACE_M) & (depth_m < _WALL_M))

    def _depth_m(self, points_here: Array) -> Array:
        """(N,) how far behind the nearest inner face, negative in front of it, ``-inf`` where no room is known."""
        depths_m = [
            outside_distances_m(polygon, self.T_here_room[room].inverse().apply(points_here)[:, :2])
            for room, polygon in self._polygons.items()
            if polygon
        ]
        return np.asarray(np.min(depths_m, axis=0)) if depths_m else np.full(len(points_here), -np.inf)

    def settled_room(self, room: str, point_room: Array) -> str:
        """The room of a thing so far held to be in ``room`` at ``point_room`` (3,): changed only for a point clearly
        outside.
        """
        polygon = self._polygons[room]
        if not polygon or outside_distance_m(polygon, point_room[:2]) <= MARGIN_M:
            return room
        return self.room_of(self.T_here_room[room].apply(point_room)) or room


def _neighbors(snapshot: Snapshot, room: str) -> list[str]:
    found: dict[str, None] = {}
    for door in snapshot.of_type(DoorNode):
        pair = door.rooms
        other = pair[1] if pair[0] == room else pair[0]
        if room in pair and other is not None and other != room:
            node = snapshot.get(other)
            if isinstance(node, RoomNode) and node.status is not RoomStatus.TEMPORARY and node.polygon_m:
                found[other] = None
    return list(found)
