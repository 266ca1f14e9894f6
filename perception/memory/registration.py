"""Laying one outline on another: the rigid motion that brings corner to corner."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, wrap

Array = NDArray[np.float64]


def register_outline(polygon: Array, other: Array, guess: Pose2, *, most_m: float) -> Pose2 | None:
    """The motion that lays ``other`` (N, 2) on ``polygon`` (N, 2) with no corner off by more than ``most_m``.

    Of several, as a rectangle has, the one nearest to ``guess``; ``None`` when the shapes differ. Least squares over
    corners taken in order, from each one in turn (Kabsch 1976, in the plane).
    """
    if polygon.shape != other.shape:
        return None
    ways: list[tuple[float, Pose2]] = []
    for shift in range(len(other)):
        turned = np.roll(other, shift, axis=0)
        motion = _motion(turned, polygon)
        if float(np.linalg.norm(motion.apply(turned) - polygon, axis=1).max()) <= most_m:
            middle = other.mean(axis=0)
            way_m = float(np.linalg.norm(motion.apply(middle) - guess.apply(middle)))
            ways.append((way_m + abs(wrap(motion.yaw_rad - guess.yaw_rad)), motion))
    return min(ways, key=lambda way: way[0])[1] if ways else None


def _motion(points: Array, goals: Array) -> Pose2:
    """The rigid motion that brings ``points`` (N, 2) nearest to ``goals`` (N, 2)."""
    center, goal = points.mean(axis=0), goals.mean(axis=0)
    cross = (points - center).T @ (goals - goal)
    yaw_rad = float(np.arctan2(cross[0, 1] - cross[1, 0], cross[0, 0] + cross[1, 1]))
    shift = goal - Pose2(0.0, 0.0, yaw_rad).apply(center)
    return Pose2(float(shift[0]), float(shift[1]), yaw_rad)
