"""Multi-ring LiDAR of the simulated robot (design, section 5)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from simulation.robot.description import LidarDescription
from simulation.robot.raycast import Prisms, cast


class Lidar:
    """Measures true ranges. ``elevations_rad`` (rings,) and ``azimuths_rad`` (azimuths,) are those of its rays."""

    def __init__(self, description: LidarDescription) -> None:
        self.elevations_rad, self.azimuths_rad = description.elevations_rad, description.azimuths_rad
        self._range_m = description.range_m
        below, behind_rad = self.elevations_rad < description.mast_below_rad, math.pi - description.mast_half_width_rad
        self._hidden = below[:, None] & (np.abs(self.azimuths_rad) > behind_rad)

    def scan_ranges(
        self, scenes: Sequence[Prisms], position_m: tuple[float, float, float], yaw_rad: float
    ) -> NDArray[np.float32]:
        """(rings, azimuths) of one revolution, ``inf`` for no return and behind the robot's own mast."""
        horizontal_m = cast(scenes, position_m, self.azimuths_rad + yaw_rad, np.tan(self.elevations_rad))
        ranges_m = (horizontal_m / np.cos(self.elevations_rad)[:, None]).astype(np.float32)
        ranges_m[(ranges_m < self._range_m[0]) | (ranges_m > self._range_m[1]) | self._hidden] = np.inf
        return np.asarray(ranges_m, dtype=np.float32)
