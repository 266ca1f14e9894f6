"""What the depth camera sees where the arm would go, known by name or not: the graph may not have it yet."""

from __future__ import annotations

from math import atan2, cos, hypot, sin

import numpy as np

from skills.action import RobotContext
from skills.arm.arm_way import clear_over_m
from skills.arm.spot_reach import above_bottom_m, held_height_m, held_radius_m, highest_underside_m
from skills.geometry import Points
from skills.place.place_spot import Spot
from skills.place.put_down import HOVER_M

NEAREST_M = 0.42
"""Nearer to the base's axis what is seen may be the hand, drawn in, and what it holds."""
OWN_M = 0.1
"""So near to what is held, or to the hand, it is the robot itself that is seen."""
DEEP_M = 0.015
"""What reaches less far into the way counts for nothing: it is a little off, as everything that is measured."""
OVER_M = 0.03
"""What is lower over the surface is the surface."""
HAND_HEIGHT_M, ARM_HALF_M = 0.15, 0.05
LEAST_POINTS = 15


class Seen:
    """What the camera sees before the robot, itself left out, against the ways of the arm straight from here.

    Args:
        context: what is held, and the newest picture.
        target: what it is put down for.
    """

    def __init__(self, context: RobotContext, target: str) -> None:
        self._context, self._target, self._radius_m = context, target, held_radius_m(context)
        points, hand = context.seen_base(), context.body.T_base_gripper
        from_hand_m = np.hypot(points[:, 0] - hand.x_m, points[:, 1] - hand.y_m)
        self._points: Points = points[(points[:, 0] > NEAREST_M) & (from_hand_m > self._radius_m + OWN_M)]

    def is_in_way_to(self, spot: Spot) -> bool:
        """Whether something is seen where what the hand holds would pass, or stand: brought over a spot that lies open
        from above, or in below the board above it.
        """
        if spot.inside or len(self._points) < LEAST_POINTS:
            return False
        seen, radius_m = self._points, self._radius_m
        x_m, y_m, surface_z_m = spot.anchor.in_base(self._context)
        away_m, turn_rad = hypot(x_m, y_m), atan2(y_m, x_m)
        along = seen[:, 0] * cos(turn_rad) + seen[:, 1] * sin(turn_rad)
        across = seen[:, 1] * cos(turn_rad) - seen[:, 0] * sin(turn_rad)
        low_m, high_m = self._between_m(spot, away_m, surface_z_m)
        half_m = max(radius_m, ARM_HALF_M) - DEEP_M
        passing = (np.abs(across) < half_m) & (along < away_m) & (seen[:, 2] > low_m)
        standing = (np.hypot(along - away_m, across) < radius_m - DEEP_M) & (seen[:, 2] > surface_z_m + OVER_M)
        met = (passing | standing) & (seen[:, 2] < high_m)
        return bool(np.count_nonzero(met) >= LEAST_POINTS)

    def _between_m(self, spot: Spot, away_m: float, surface_z_m: float) -> tuple[float, float]:
        """Between which heights over the floor the hand, and what it holds, get to a spot."""
        context = self._context
        high_m = max(held_height_m(context), above_bottom_m(context) + HAND_HEIGHT_M)
        if spot.is_covered:
            return surface_z_m + OVER_M, surface_z_m + min(high_m, spot.free_m - OVER_M)
        over_m = clear_over_m(context, away_m, self._target, held_radius_m=self._radius_m)
        underside_m = min(max(surface_z_m + HOVER_M, over_m), highest_underside_m(context))
        return underside_m + DEEP_M, underside_m + high_m

    def shows(self, spot: Spot) -> bool:
        """Whether the surface is seen at a spot; true where there is no camera."""
        if not len(self._points):
            return True
        x_m, y_m, surface_z_m = spot.anchor.in_base(self._context)
        near = np.hypot(self._points[:, 0] - x_m, self._points[:, 1] - y_m) < self._radius_m
        return bool(np.count_nonzero(near & (np.abs(self._points[:, 2] - surface_z_m) < OVER_M)) >= LEAST_POINTS)
