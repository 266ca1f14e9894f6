"""Raw proximity for obstacle avoidance, from the newest LiDAR revolution and camera frame; an adapter between two
siblings.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from perception.lidar.range_noise import calmed
from perception.objects.seeing.projection import back_project
from perception.ports import LidarScan
from perception.sensing import SensorBuffer, ray_directions_base, scan_points_between
from skills.ports import NO_FLOOR, FloorReturns


@dataclass(frozen=True, kw_only=True)
class RangeSettings:
    """Which returns are obstacles."""

    robot_height_m: float = 1.75
    """What is higher does not meet the robot: its LiDAR stands 1.6 m high."""
    reach_m: float = 6.0
    """What is farther is of no use to who avoids it: ten seconds away."""
    floor_reach_m: float = 2.6
    """Rays that should meet the floor beyond this tell its height badly."""
    floor_m: float = 0.06
    """Returns below this height are floor: three standard deviations of range noise at a steep ring."""
    seen_step_px: int = 3
    """Of the camera's pixels one of so many counts, along rows and columns."""
    seen_reach_m: float = 2.0
    """Beyond the arm's reach the camera is not asked."""


class ScanRanges:
    """``RangeSource`` over a sensor buffer. Computes once per scan."""

    def __init__(self, buffer: SensorBuffer, settings: RangeSettings = RangeSettings()) -> None:
        self._buffer, self._settings = buffer, settings
        self._stamp_s = self._floor_stamp_s = -np.inf
        self._floor = NO_FLOOR
        self._points: NDArray[np.float64] = np.zeros((0, 3))

    def points_base(self) -> NDArray[np.float64]:
        """(N, 3) points between floor and the robot's height, base frame at the scan's stamp."""
        scan, settings = self._buffer.scan, self._settings
        if scan is not None and scan.stamp_s != self._stamp_s:
            ranges_m = calmed(scan.ranges_m.astype(np.float64)).astype(np.float32)
            points = scan_points_between(replace(scan, ranges_m=ranges_m), settings.floor_m, settings.robot_height_m)
            self._points = points[np.hypot(points[:, 0], points[:, 1]) < settings.reach_m]
            self._stamp_s = scan.stamp_s
        return self._points

    def floor_base(self) -> FloorReturns:
        """Rays of the newest scan that should have met the floor nearby, and ended near it."""
        scan = self._buffer.scan
        if scan is not None and scan.stamp_s != self._floor_stamp_s:
            self._floor, self._floor_stamp_s = _floor_returns(scan, self._settings), scan.stamp_s
        return self._floor

    def seen_base(self) -> NDArray[np.float64]:
        """Points within the arm's reach that the newest camera frame shows, one of every few pixels."""
        frame = self._buffer.frame
        if frame is None:
            return np.zeros((0, 3))
        step, (height, width) = self._settings.seen_step_px, frame.depth_m.shape
        v, u = np.mgrid[0:height:step, 0:width:step]
        depth_m = frame.depth_m[v, u].astype(np.float64)
        known = (depth_m > 0.0) & (depth_m < self._settings.seen_reach_m)
        points = back_project(u[known], v[known], depth_m[known], frame.intrinsics)
        return np.asarray(frame.T_base_camera.apply(points))


def _floor_returns(scan: LidarScan, settings: RangeSettings) -> FloorReturns:
    directions, origin = ray_directions_base(scan), scan.T_base_lidar.translation_m
    steep = directions[..., 2] < -origin[2] / np.hypot(origin[2], settings.floor_reach_m)
    directions, ranges_m = directions[steep], scan.ranges_m[steep].astype(np.float64)
    with np.errstate(invalid="ignore"):
        near = np.abs(origin[2] + ranges_m * directions[:, 2]) < settings.floor_m
    directions = directions[near]
    return FloorReturns(
        spots_m=(origin - directions * (origin[2] / directions[:, 2:]))[:, :2],
        points_m=origin + directions * ranges_m[near][:, None],
    )
