"""The last check before a velocity is sent: will the base, braking as hard as it may, stay clear of every point?

A dynamic window reduced to one arc (Fox, Burgard, Thrun 1997, admissible velocities): the commanded arc is slowed down
until its stopping distance is free. A disc that turns in place sweeps nothing, so turning is always admissible.
"""

from __future__ import annotations

import numpy as np

from skills.geometry import Points
from skills.navigation.settings import SafetySettings
from skills.ports import BodyLimits


def admissible(
    linear_mps: float,
    angular_radps: float,
    points_base: Points,
    radius_m: float,
    limits: BodyLimits,
    settings: SafetySettings = SafetySettings(),
) -> tuple[float, float]:
    """The command, slowed down as far as needed; zero linear speed when no forward arc is free.

    ``points_base``: obstacle points (N, 2), base frame. ``radius_m``: what must stay free around the axis. Where the
    robot is already closer than that, it may move so that it does not get closer.
    """
    near = points_base[np.hypot(*points_base.T) < settings.far_m] if len(points_base) else points_base
    if linear_mps == 0.0 or not len(near):
        return linear_mps, angular_radps
    here_m = float(np.hypot(*near.T).min())
    floor_m = min(radius_m, here_m - settings.closer_m)
    for share in settings.shares:
        if _arc_clearance_m(share * linear_mps, share * angular_radps, near, limits, settings) >= floor_m:
            return share * linear_mps, share * angular_radps
    return 0.0, angular_radps


def retreat(
    points_base: Points, radius_m: float, limits: BodyLimits, settings: SafetySettings = SafetySettings()
) -> float:
    """Linear velocity that leads away backwards where a point is closer than ``radius_m``; zero where none does."""
    if not len(points_base) or (here_m := float(np.hypot(*points_base.T).min())) >= radius_m:
        return 0.0
    back_mps = -settings.retreat_mps
    return back_mps if _arc_clearance_m(back_mps, 0.0, points_base, limits, settings) >= here_m else 0.0


def _arc_clearance_m(
    linear: float, angular: float, points: Points, limits: BodyLimits, settings: SafetySettings
) -> float:
    """Least distance between the axis and any point while driving on for the reaction time and then braking."""
    horizon_s = settings.reaction_s + abs(linear) / (2 * limits.linear_mps2)
    t = np.linspace(0.0, horizon_s, settings.steps)
    if abs(angular) < 1e-3:
        x, y = linear * t, np.zeros_like(t)
    else:
        x, y = linear / angular * np.sin(angular * t), linear / angular * (1 - np.cos(angular * t))
    return float(np.hypot(points[:, 0, None] - x, points[:, 1, None] - y).min())
