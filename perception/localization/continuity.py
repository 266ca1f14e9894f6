"""Do two scans, one soon after the other, show the same place? If not, somebody has carried the robot.

This needs no map, so it also tells where no room stands yet, and between rooms that look the same.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from perception.localization.global_localization import Sight

_NEAR_M = 0.15
_FEWEST_RETURNS = 60


def continuity(before: Sight, now: Sight) -> float:
    """Share of the wall returns of ``now`` that lie where ``before`` had some, the odometry between them believed."""
    if min(len(before.outline.points_base), len(now.outline.points_base)) < _FEWEST_RETURNS:
        return 1.0
    moved = now.T_odom_base.inverse() @ before.T_odom_base
    distance_m, _ = cKDTree(moved.apply(before.outline.points_base)).query(now.outline.points_base)
    return float((np.asarray(distance_m) < _NEAR_M + 4.0 * now.outline.noise_m).mean())
