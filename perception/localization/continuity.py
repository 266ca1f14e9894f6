"""Do two scans, one soon after the other, show the same place? If not, somebody has carried the robot.

This needs no map, so it also tells where no room stands yet, and between rooms that look the same.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from perception.localization.global_localization import Sight


@dataclass(frozen=True, kw_only=True)
class ContinuitySettings:
    """When a return counts as seen before."""

    near_m: float = 0.15
    """From a return of the view before, and four standard deviations of the ranges. Chosen: what
    odometry may be off in between, and the spacing of returns."""
    fewest_returns: int = 60
    """With fewer of a wall in either view nothing is told. Chosen: a fifteenth of a revolution."""


def continuity(before: Sight, now: Sight, settings: ContinuitySettings = ContinuitySettings()) -> float:
    """Share of the wall returns of ``now`` that lie where ``before`` had some, the odometry between them believed."""
    if min(len(before.outline.points_base), len(now.outline.points_base)) < settings.fewest_returns:
        return 1.0
    moved = now.T_odom_base.inverse() @ before.T_odom_base
    distance_m, _ = cKDTree(moved.apply(before.outline.points_base)).query(now.outline.points_base)
    return float((np.asarray(distance_m) < settings.near_m + 4.0 * now.outline.noise_m).mean())
