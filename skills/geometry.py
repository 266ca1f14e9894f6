"""Plane geometry for navigation and placing: poses, boxes, polygons. Meters and radians."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import atan2, ceil, cos, hypot, sin

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3

Point2 = tuple[float, float]
Points = NDArray[np.float64]


@dataclass(frozen=True)
class Pose2:
    """A pose in the plane; ``yaw_rad`` counter-clockwise from x."""

    x_m: float
    y_m: float
    yaw_rad: float = 0.0

    @classmethod
    def of(cls, pose: SE3) -> Pose2:
        """The planar part of ``pose``."""
        return cls(pose.x_m, pose.y_m, pose.yaw_rad)

    @property
    def point(self) -> Point2:
        """Position alone."""
        return (self.x_m, self.y_m)

    def distance_m(self, point: Point2) -> float:
        """Straight distance to ``point``."""
        return hypot(point[0] - self.x_m, point[1] - self.y_m)

    def bearing_rad(self, point: Point2) -> float:
        """Direction from here to ``point``, from the x axis of the frame (not of this pose)."""
        return atan2(point[1] - self.y_m, point[0] - self.x_m)

    def apply(self, points: Points) -> Points:
        """``points`` (N, 2) in this pose's frame -> (N, 2) in the frame the pose is given in."""
        c, s = cos(self.yaw_rad), sin(self.yaw_rad)
        return np.asarray(points @ np.array([[c, s], [-s, c]]) + (self.x_m, self.y_m))

    def inverse_apply(self, points: Points) -> Points:
        """``points`` (N, 2) in the frame the pose is given in -> (N, 2) in this pose's frame."""
        c, s = cos(self.yaw_rad), sin(self.yaw_rad)
        return np.asarray((points - (self.x_m, self.y_m)) @ np.array([[c, -s], [s, c]]))

    def advanced(self, linear_m: float, angular_rad: float) -> Pose2:
        """Where a body ends up that moves on an arc of this length and turn."""
        middle = self.yaw_rad + angular_rad / 2
        return Pose2(self.x_m + linear_m * cos(middle), self.y_m + linear_m * sin(middle), self.yaw_rad + angular_rad)


@dataclass(frozen=True)
class Box2:
    """An oriented rectangle: its center's pose and full extents along its own x and y."""

    pose: Pose2
    size_x_m: float
    size_y_m: float

    def distance_m(self, points: Points) -> Points:
        """Distance (N,) from ``points`` (N, 2) to the rectangle; 0 inside."""
        local = np.abs(self.pose.inverse_apply(points)) - (self.size_x_m / 2, self.size_y_m / 2)
        return np.asarray(np.hypot(*np.maximum(local, 0.0).T))

    def grown(self, margin_m: float) -> Box2:
        """The rectangle with every side moved outward by ``margin_m``."""
        return Box2(self.pose, max(self.size_x_m + 2 * margin_m, 0.0), max(self.size_y_m + 2 * margin_m, 0.0))

    def contains(self, points: Points) -> NDArray[np.bool_]:
        """Whether each of ``points`` (N, 2) lies inside, (N,)."""
        local = np.abs(self.pose.inverse_apply(points))
        return np.asarray((local[:, 0] <= self.size_x_m / 2) & (local[:, 1] <= self.size_y_m / 2))

    def corners(self) -> Points:
        """Corners (4, 2), counter-clockwise."""
        x, y = self.size_x_m / 2, self.size_y_m / 2
        return self.pose.apply(np.array([[x, y], [-x, y], [-x, -y], [x, -y]]))

    def outline(self, step_m: float) -> Points:
        """Points (N, 2) along all four sides, at most ``step_m`` apart."""
        corners = self.corners()
        sides = zip(corners, np.roll(corners, -1, axis=0), strict=True)
        return np.concatenate([np.linspace(a, b, ceil(float(np.hypot(*(b - a))) / step_m) + 1) for a, b in sides])


def inside_polygon(polygon: Sequence[Point2], points: Points) -> NDArray[np.bool_]:
    """Whether each of ``points`` (N, 2) lies inside the simple ``polygon`` (even-odd rule), (N,)."""
    inside = np.zeros(len(points), dtype=bool)
    x, y = points[:, 0], points[:, 1]
    for (x0, y0), (x1, y1) in zip(polygon, [*polygon[1:], polygon[0]], strict=True):
        if y0 == y1:
            continue
        crosses = (y0 > y) != (y1 > y)
        with np.errstate(over="ignore", invalid="ignore"):  # beside sides of almost no height, which do not count
            inside ^= crosses & (x < x0 + (y - y0) * (x1 - x0) / (y1 - y0))
    return inside


def boundary_distance_m(polygon: Sequence[Point2], point: Point2) -> float:
    """Distance from ``point`` to the nearest side of ``polygon``, inside as outside."""
    start = np.array(polygon)
    side, offset = np.roll(start, -1, axis=0) - start, np.array(point) - start
    length2 = np.maximum((side**2).sum(axis=1), 1e-12)
    along = np.clip((offset * side).sum(axis=1) / length2, 0.0, 1.0)
    return float(np.hypot(*(offset - along[:, None] * side).T).min())


def wrap_rad(angle: float) -> float:
    """``angle`` brought to (-pi, pi]."""
    return atan2(sin(angle), cos(angle))
