"""How far dead reckoning may be off."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2

Array = NDArray[np.float64]


def odometry_covariance(moved: Pose2) -> Array:
    """(3, 3) covariance of a dead-reckoned motion: two percent of the way and of the turn, plus a floor."""
    way_m = math.hypot(moved.x_m, moved.y_m)
    along = 0.02 * way_m + 5e-4
    turn = 0.02 * abs(moved.yaw_rad) + 0.01 * way_m + 2e-4
    return np.diag([along**2, along**2, turn**2])
