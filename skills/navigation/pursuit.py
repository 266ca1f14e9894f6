"""Regulated pure pursuit: follow a path smoothly, slow near obstacles and the goal, turn in place when far off heading.

After Macenski et al., "Regulated Pure Pursuit for Robot Path Tracking" (2023): curvature of the arc to a point ahead on
the path (eq. 1), speed scaled by curvature and by clearance.
"""

from __future__ import annotations

from math import copysign, cos, hypot, sin, sqrt

import numpy as np

from skills.geometry import Point2, Pose2, wrap_rad
from skills.navigation.settings import PursuitSettings
from skills.ports import BodyLimits


class Pursuit:
    """Velocity commands along one path; remembers whether it is turning in place."""

    def __init__(self, limits: BodyLimits, settings: PursuitSettings = PursuitSettings()) -> None:
        self._settings = settings
        self._limits = limits
        self.turning = False

    def velocity(
        self, pose: Pose2, path: tuple[Point2, ...], clearance_m: float, speed_mps: float
    ) -> tuple[float, float]:
        """Linear and angular velocity at ``pose``; ``clearance_m`` to the nearest obstacle, ``speed_mps`` as
        measured.
        """
        settings, limits = self._settings, self._limits
        short, far = settings.look_ahead_m
        ahead, remaining_m = point_ahead(path, pose.point, min(max(short, 0.9 * abs(speed_mps)), far))
        error = wrap_rad(pose.bearing_rad(ahead) - pose.yaw_rad)
        self.turning = abs(error) > (settings.aligned_rad if self.turning else settings.turn_in_place_rad)
        if self.turning:
            return 0.0, turn_rate(error, limits, settings.turn)
        curvature = 2 * sin(error) / max(pose.distance_m(ahead), 0.1)
        low, high = settings.clearance_m
        open_share = min(max((clearance_m - low) / (high - low), 0.0), 1.0)
        cruise = settings.cruise * limits.linear_mps
        speed = settings.creep_mps + (cruise - settings.creep_mps) * max(open_share, 0.25)
        speed = min(speed, settings.turn * limits.angular_radps / max(abs(curvature), 1e-3))
        speed = min(speed, sqrt(2 * settings.brake * limits.linear_mps2 * remaining_m) + 0.02) * max(cos(error), 0.0)
        return speed, speed * curvature + 0.3 * error


def turn_rate(error_rad: float, limits: BodyLimits, share: float = 0.8) -> float:
    """Angular velocity that closes a heading error: proportional, within what can still be braked, never too slow to
    move.
    """
    if abs(error_rad) < 1e-3:
        return 0.0
    rate = min(2.0 * abs(error_rad), sqrt(0.8 * limits.angular_radps2 * abs(error_rad)), share * limits.angular_radps)
    return copysign(max(rate, 0.02), error_rad)


def point_ahead(path: tuple[Point2, ...], point: Point2, distance_m: float) -> tuple[Point2, float]:
    """The point ``distance_m`` further along ``path`` than its nearest point to ``point``, and the length left from
    there.

    The second value counts from the nearest point.
    """
    nodes = np.array(path)
    steps = np.diff(nodes, axis=0)
    lengths = np.hypot(*steps.T)
    squared = np.maximum(lengths**2, 1e-12)
    t = np.clip(((np.array(point) - nodes[:-1]) * steps).sum(axis=1) / squared, 0.0, 1.0)
    offsets = np.hypot(*(nodes[:-1] + t[:, None] * steps - point).T)
    best = int(np.argmin(offsets))
    along = float(np.concatenate([[0.0], np.cumsum(lengths)])[best] + t[best] * lengths[best])
    total = float(lengths.sum())
    return _at(nodes, lengths, min(along + distance_m, total)), total - along


def deviation_m(path: tuple[Point2, ...], point: Point2) -> float:
    """Distance from ``point`` to the nearest point of ``path``."""
    nearest, _ = point_ahead(path, point, 0.0)
    return hypot(nearest[0] - point[0], nearest[1] - point[1])


def _at(nodes: np.ndarray, lengths: np.ndarray, along_m: float) -> Point2:
    ends = np.concatenate([[0.0], np.cumsum(lengths)])
    x, y = (float(np.interp(along_m, ends, nodes[:, axis])) for axis in (0, 1))
    return x, y
