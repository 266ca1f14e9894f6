"""Which room a thing belongs to: exactly one, by the polygons of the robot's room and of the rooms behind its doors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene_graph.errors import FramesNotConnected
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorNode, Point2, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class MembershipSettings:
    """How far walls reach for what is measured near them."""

    face_m: float = 0.06
    """How far inside a wall's face a point may be measured and still be of the wall."""
    near_face_m: float = 0.04
    """The same for points of furniture in front of it, which would lose depth."""
    wall_m: float = 0.5
    """What is farther behind a wall's face than this is seen past the wall, through a door, and stands in another room.
    """
    floor_m: float = 0.04
    """How high over the floor a point may be measured and still be of the floor."""
    margin_m: float = 0.15
    """How far outside the inner face of a wall the center of a thing may be measured and still belong to the room."""


class Outline:
    """A simple polygon, ready to be asked for distances.

    ``polygon_m``: (S, 2) corners in order.
    """

    def __init__(self, polygon_m: tuple[Point2, ...]) -> None:
        corners = np.asarray(polygon_m, dtype=np.float64)
        sides = np.roll(corners, -1, axis=0) - corners
        self._x, self._y = corners.T
        self._dx, self._dy = sides.T
        self._end_y = np.roll(self._y, -1)
        self._squared = np.maximum((sides**2).sum(axis=1), 1e-12)

    def outside_m(self, points: Array) -> Array:
        """(N,) signed distance of points (N, 2): negative inside, positive outside."""
        y = points[:, 1:2]
        away_x, away_y = points[:, 0:1] - self._x, y - self._y
        along = np.clip((away_x * self._dx + away_y * self._dy) / self._squared, 0.0, 1.0)
        squared = (away_x - along * self._dx) ** 2 + (away_y - along * self._dy) ** 2
        distances = np.sqrt(squared.min(axis=1))
        straddles = (self._y > y) != (self._end_y > y)
        left = straddles & ((away_x * self._dy < away_y * self._dx) == (self._dy > 0.0))
        inside = np.count_nonzero(left, axis=1) % 2 == 1
        return np.asarray(np.where(inside, -distances, distances))


class Surroundings:
    """The robot's room and its neighbors, with their polygons, at one revision.

    Attributes:
        room: the robot's room.
        T_here_room: room -> ``T_here_room`` for the robot's room and each neighbor.
    """

    def __init__(self, snapshot: Snapshot, room: str, settings: MembershipSettings = MembershipSettings()) -> None:
        self.room, self._settings = room, settings
        self.T_here_room: dict[str, SE3] = {room: SE3.identity()}
        self._outlines: dict[str, Outline] = {}
        self._T_room_here: dict[str, SE3] = {}
        for other in (room, *_neighbors(snapshot, room)):
            try:
                self.T_here_room[other] = SE3.identity() if other == room else snapshot.transform(room, other)
            except FramesNotConnected:
                continue
            polygon_m = snapshot.room(other).polygon_m
            if polygon_m:
                self._outlines[other] = Outline(polygon_m)
                self._T_room_here[other] = self.T_here_room[other].inverse()

    def room_of(self, point_here: Array) -> str | None:
        """The room that a point (3,) in the robot's room frame lies in, or ``None`` for one in no known room.

        A point in two polygons is the robot's room's; one in a wall is of the room it is nearest to.
        """
        here = point_here[None]
        if self.room not in self._outlines or self._outside_m(self.room, here)[0] <= 0.0:
            return self.room
        distances = {room: self._outside_m(room, here)[0] for room in self._outlines}
        nearest = min(distances, key=lambda room: (distances[room], room))
        return nearest if distances[nearest] <= self._settings.margin_m else None

    def in_walls(self, points_here: Array) -> float:
        """Share of points (N, 3) in the robot's room frame that lie on the faces of walls or in them."""
        return float(np.mean(self._at_walls(points_here, self._settings.face_m))) if len(points_here) else 0.0

    def of_building(self, points_here: Array) -> NDArray[np.bool_]:
        """Which of the points (N, 3) in the robot's room frame lie on the floor, or on a wall's face or in the wall."""
        building = points_here[:, 2] < self._settings.floor_m
        building[~building] = self._at_walls(points_here[~building], self._settings.near_face_m)
        return building

    def _at_walls(self, points_here: Array, face_m: float) -> NDArray[np.bool_]:
        """(N,) whether a point is in the wall of the room it is deepest in, or at most ``face_m`` in front of it."""
        at_walls = np.zeros(len(points_here), dtype=bool)
        if not self._outlines:
            return at_walls
        left = np.arange(len(points_here))
        depth_m = np.full(len(points_here), np.inf)
        for room in self._outlines:
            depth_m[left] = np.minimum(depth_m[left], self._outside_m(room, points_here[left]))
            left = left[depth_m[left] > -face_m]  # what is clearly in one room is in no wall, wherever others are
        at_walls[left] = depth_m[left] < self._settings.wall_m
        return at_walls

    def _outside_m(self, room: str, points_here: Array) -> Array:
        """(N,) how far points (N, 3) in the robot's room frame are outside of a room, negative inside."""
        return self._outlines[room].outside_m(self._T_room_here[room].apply(points_here)[:, :2])

    def settled_room(self, room: str, point_room: Array) -> str:
        """The room of a thing so far held to be in ``room`` at ``point_room`` (3,): changed only for a point clearly
        outside.
        """
        outline = self._outlines.get(room)
        if outline is None or outline.outside_m(point_room[None, :2])[0] <= self._settings.margin_m:
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
