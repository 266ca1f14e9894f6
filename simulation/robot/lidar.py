"""Multi-ring LiDAR of the simulated robot (design, section 5)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from simulation.robot.raycast import Prisms, cast

ELEVATIONS_RAD = np.radians([-60, -48, -38, -29, -21, -14, -7, -1.5, 2, 4, 6.5, 10, 15, 22, 31, 42])
AZIMUTHS_RAD = np.arange(900, dtype=np.float64) * (math.tau / 900) - math.pi
MIN_RANGE_M, MAX_RANGE_M = 0.15, 30.0
_MAST_HALF_WIDTH_RAD = math.radians(40.0)
_MAST_BELOW_RAD = math.radians(-35.0)


def scan_ranges(
    scenes: Sequence[Prisms], position_m: tuple[float, float, float], yaw_rad: float
) -> NDArray[np.float32]:
    """True ranges (rings, azimuths) of one revolution, ``inf`` for no return and behind the robot's own mast."""
    horizontal_m = cast(scenes, position_m, AZIMUTHS_RAD + yaw_rad, np.tan(ELEVATIONS_RAD))
    ranges_m = (horizontal_m / np.cos(ELEVATIONS_RAD)[:, None]).astype(np.float32)
    ranges_m[(ranges_m < MIN_RANGE_M) | (ranges_m > MAX_RANGE_M) | _HIDDEN] = np.inf
    return np.asarray(ranges_m, dtype=np.float32)


_HIDDEN = (ELEVATIONS_RAD[:, None] < _MAST_BELOW_RAD) & (np.abs(AZIMUTHS_RAD) > math.pi - _MAST_HALF_WIDTH_RAD)
"""Rays that end on the robot itself: the mast stands behind and below the sensor."""
