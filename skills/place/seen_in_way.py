"""What the depth camera sees where the arm would go, known by name or not: the graph may not have it yet."""

from __future__ import annotations

from math import atan2, cos, hypot, sin

import numpy as np

from skills.action import RobotContext
from skills.arm.arm_way import clear_over_m
from skills.arm.held import above_bottom_m, held_radius_m, held_size_m, highest_underside_m
from skills.geometry import Points
from skills.place.place_spot import Spot


class Seen:
    """What the camera sees before the robot, itself left out, against the ways of the arm straight from here.

    Args:
        context: what is held, and the newest picture.
        target: what it is put down for.
    """

    def __init__(self, context: RobotContext, target: str) -> None:
        self._context, self._target, self._radius_m = context, target, held_radius_m(context)
        settings = self._settings = context.settings.place.put_down
        points, hand = context.seen_base(), context.body.T_base_gripper
        from_hand_m = np.hypot(points[:, 0] - hand.x_m, points[:, 1] - hand.y_m)
        far = (points[:, 0] > settings.seen_from_m) & (from_hand_m > self._radius_m + settings.own_m)
        self._points: Points = points[far]

    def is_in_way_to(self, spot: Spot) -> bool:
        """Whether something is seen where what the hand holds would pass, or stand: brought over a spot that lies open
        from above, or in below the board above it.
        """
        settings = self._settings
        if spot.inside or len(self._points) < settings.least_points:
            return False
        seen, radius_m = self._points, self._radius_m
        x_m, y_m, surface_z_m = spot.anchor.in_base(self._context)
        away_m, turn_rad = hypot(x_m, y_m), atan2(y_m, x_m)
        along = seen[:, 0] * cos(turn_rad) + seen[:, 1] * sin(turn_rad)
        across = seen[:, 1] * cos(turn_rad) - seen[:, 0] * sin(turn_rad)
        low_m, high_m = self._between_m(spot, away_m, surface_z_m)
        half_m = max(radius_m, settings.arm_half_width_m) - settings.deep_m
        passing = (np.abs(across) < half_m) & (along < away_m) & (seen[:, 2] > low_m)
        there = np.hypot(along - away_m, across) < radius_m - settings.deep_m
        standing = there & (seen[:, 2] > surface_z_m + settings.over_m)
        met = (passing | standing) & (seen[:, 2] < high_m)
        return bool(np.count_nonzero(met) >= settings.least_points)

    def _between_m(self, spot: Spot, away_m: float, surface_z_m: float) -> tuple[float, float]:
        """Between which heights over the floor the hand, and what it holds, get to a spot."""
        context, settings = self._context, self._settings
        high_m = max(held_size_m(context)[2], above_bottom_m(context) + settings.hand_height_m)
        if spot.is_covered:
            return surface_z_m + settings.over_m, surface_z_m + min(high_m, spot.surface.free_m - settings.over_m)
        over_m = clear_over_m(context, away_m, self._target, held_radius_m=self._radius_m)
        underside_m = min(max(surface_z_m + settings.hover_m, over_m), highest_underside_m(context))
        return underside_m + settings.deep_m, underside_m + high_m

    def shows(self, spot: Spot) -> bool:
        """Whether the surface is seen at a spot; true where there is no camera."""
        if not len(self._points):
            return True
        x_m, y_m, surface_z_m = spot.anchor.in_base(self._context)
        near = np.hypot(self._points[:, 0] - x_m, self._points[:, 1] - y_m) < self._radius_m
        level = np.abs(self._points[:, 2] - surface_z_m) < self._settings.over_m
        return bool(np.count_nonzero(near & level) >= self._settings.least_points)
