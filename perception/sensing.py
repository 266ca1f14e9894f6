"""The newest measurements of the robot, kept where every perception agent finds them.

``Sensing`` and ``Filming`` are the only agents that talk to the sensor port, each at its own rate. What a step of any
other agent sees is therefore one consistent set of measurements, and a sensor that fails is marked in one place.
"""

from __future__ import annotations

import logging
from bisect import bisect_left
from collections import deque
from collections.abc import Awaitable, Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from perception.errors import OdometryUnavailable, SensorSilent
from perception.ports import JointState, LidarScan, Odometry, RgbdFrame, SensorPort
from scene_graph.geometry.se3 import SE3, wrap_angle

logger = logging.getLogger(__name__)

Measurement = TypeVar("Measurement")


@dataclass(frozen=True, kw_only=True)
class SensingSettings:
    """How often sensors are asked, and what is kept."""

    period_s: float = 0.1
    """Between measurements: a LiDAR turns ten times a second."""
    odometry: int = 600
    """Kept, a minute at this rate: longer than any measurement waits."""
    joints: int = 50
    """Measurements of the joints that are kept: some seconds, as a frame may be as late."""
    extrapolation_s: float = 0.5
    """Longest that the base is taken to go on as it did. Chosen: longer, and it may have stopped."""


def ray_directions_base(scan: LidarScan) -> NDArray[np.float64]:
    """(rings, azimuths, 3) unit vectors of all rays in the base frame; they start at ``scan.T_base_lidar``'s origin.

    Read-only: successive scans of one sensor share them.
    """
    key = (scan.elevations_rad.tobytes(), scan.azimuths_rad.tobytes(), scan.T_base_lidar.quat_wxyz.tobytes())
    return _ray_directions(*key)


@lru_cache(maxsize=4)
def _ray_directions(elevations: bytes, azimuths: bytes, quaternion: bytes) -> NDArray[np.float64]:
    elevations_rad, azimuths_rad = np.frombuffer(elevations), np.frombuffer(azimuths)
    cos_elevation = np.cos(elevations_rad)[:, None]
    directions_lidar = np.stack(
        np.broadcast_arrays(
            cos_elevation * np.cos(azimuths_rad), cos_elevation * np.sin(azimuths_rad), np.sin(elevations_rad)[:, None]
        ),
        axis=-1,
    )
    directions = directions_lidar @ SE3(np.frombuffer(quaternion)).rotation().T
    directions.flags.writeable = False
    return np.asarray(directions, dtype=np.float64)


def scan_points_base(scan: LidarScan) -> NDArray[np.float64]:
    """(N, 3) points of all rays that returned, base frame at ``scan.stamp_s``."""
    returned = np.isfinite(scan.ranges_m)
    directions = ray_directions_base(scan)[returned]
    points = directions * scan.ranges_m[returned].astype(np.float64)[:, None] + scan.T_base_lidar.translation_m
    return np.asarray(points, dtype=np.float64)


def scan_points_between(scan: LidarScan, low_m: float, high_m: float) -> NDArray[np.float64]:
    """(N, 3) points of the rays that returned between two heights above the floor, base frame at ``scan.stamp_s``."""
    directions, origin = ray_directions_base(scan), scan.T_base_lidar.translation_m
    ranges_m = scan.ranges_m.astype(np.float64)
    with np.errstate(invalid="ignore"):
        height_m = origin[2] + ranges_m * directions[..., 2]
    between = (height_m > low_m) & (height_m < high_m)
    return np.asarray(directions[between] * ranges_m[between][:, None] + origin, dtype=np.float64)


class SensorBuffer:
    """Newest measurement of each sensor, a short history of odometry, and which sensors are silent.

    What is asked of it by time may be asked from another thread while measurements come in.

    Attributes:
        odometry: recent odometry, oldest first.
        scan, frame: newest of each, ``None`` until the first arrives. frame_before: the one before ``frame``.
        scans, frames: how many LiDAR revolutions and camera frames arrived so far.
        silent: sensor name -> time in seconds since which it has been silent.
    """

    def __init__(self, port: SensorPort, settings: SensingSettings = SensingSettings()) -> None:
        self.port, self._settings = port, settings
        self.odometry: deque[Odometry] = deque(maxlen=settings.odometry)
        self.scan: LidarScan | None = None
        self.scans = 0
        self.frame: RgbdFrame | None = None
        self.frame_before: RgbdFrame | None = None
        self.frames = 0
        self._joints: deque[JointState] = deque(maxlen=settings.joints)
        self.silent: dict[str, float] = {}

    def add_odometry(self, sample: Odometry) -> None:
        """Append ``sample`` unless its time has been recorded already."""
        if not self.odometry or sample.stamp_s > self.odometry[-1].stamp_s:
            self.odometry.append(sample)

    def add_scan(self, scan: LidarScan) -> None:
        """Take in a revolution; the same one twice counts once."""
        self.scans += self.scan is None or scan.stamp_s > self.scan.stamp_s
        self.scan = scan

    def add_frame(self, frame: RgbdFrame) -> None:
        """Take in a camera frame; the same one twice counts once."""
        if self.frame is None or frame.stamp_s > self.frame.stamp_s:
            self.frames += 1
            self.frame_before = self.frame
        self.frame = frame

    def add_joints(self, joints: JointState) -> None:
        """Take in a measurement of the joints."""
        self._joints.append(joints)

    @property
    def joints(self) -> JointState | None:
        """The newest measurement, ``None`` until the first arrives."""
        return self._joints[-1] if self._joints else None

    def joints_at(self, stamp_s: float) -> JointState | None:
        """The measurement that was taken nearest to ``stamp_s``, if there is any."""
        return min(self._joints.copy(), key=lambda joints: abs(joints.stamp_s - stamp_s), default=None)

    def frame_after(self, stamp_s: float) -> RgbdFrame | None:
        """Of the newest two frames the older that is newer than ``stamp_s``, if any: who is late by one misses none."""
        kept = (self.frame_before, self.frame)
        return next((frame for frame in kept if frame is not None and frame.stamp_s > stamp_s), None)

    def odometry_at(self, stamp_s: float) -> SE3:
        """Pose of the base in the odometry frame at ``stamp_s``.

        Interpolates linearly between samples and extrapolates with the newest velocity for a little while.

        Raises:
            OdometryUnavailable: no sample yet, or ``stamp_s`` lies outside the recorded span.
        """
        return _pose_at(self.odometry.copy(), stamp_s, self._settings.extrapolation_s)

    def odometry_near(self, stamp_s: float) -> SE3:
        """As ``odometry_at``, at the recorded time nearest to ``stamp_s``.

        Raises:
            OdometryUnavailable: no sample yet.
        """
        samples = self.odometry.copy()
        if not samples:
            raise OdometryUnavailable(stamp_s, None)
        nearest_s = min(max(stamp_s, samples[0].stamp_s), samples[-1].stamp_s)
        return _pose_at(samples, nearest_s, self._settings.extrapolation_s)


def _pose_at(samples: deque[Odometry], stamp_s: float, extrapolation_s: float) -> SE3:
    """Between the samples nearest to ``stamp_s``, or a little after the newest."""
    if not samples:
        raise OdometryUnavailable(stamp_s, None)
    oldest, newest = samples[0], samples[-1]
    if stamp_s < oldest.stamp_s - 1e-6 or stamp_s > newest.stamp_s + extrapolation_s:
        raise OdometryUnavailable(stamp_s, (oldest.stamp_s, newest.stamp_s))
    if stamp_s >= newest.stamp_s:
        x_m, y_m, yaw_rad = _extrapolate(newest, stamp_s - newest.stamp_s)
    else:
        index = max(1, bisect_left(samples, stamp_s, key=lambda sample: sample.stamp_s))
        x_m, y_m, yaw_rad = _interpolate(samples[index - 1], samples[index], stamp_s)
    return SE3.from_xyz_yaw(x_m, y_m, 0.0, yaw_rad)


def _extrapolate(sample: Odometry, duration_s: float) -> tuple[float, float, float]:
    """Drive on along a circle with the velocity of ``sample``."""
    turned_rad = sample.angular_radps * duration_s
    heading_rad = sample.yaw_rad + turned_rad / 2.0
    driven_m = sample.linear_mps * duration_s
    return (
        sample.x_m + driven_m * float(np.cos(heading_rad)),
        sample.y_m + driven_m * float(np.sin(heading_rad)),
        sample.yaw_rad + turned_rad,
    )


def _interpolate(before: Odometry, after: Odometry, stamp_s: float) -> tuple[float, float, float]:
    fraction = (stamp_s - before.stamp_s) / (after.stamp_s - before.stamp_s)
    fraction = min(max(fraction, 0.0), 1.0)
    return (
        before.x_m + fraction * (after.x_m - before.x_m),
        before.y_m + fraction * (after.y_m - before.y_m),
        before.yaw_rad + fraction * float(wrap_angle(after.yaw_rad - before.yaw_rad)),
    )


class Sensing:
    """Agent that fetches odometry, LiDAR and joints each step."""

    name = "sensing"

    def __init__(self, buffer: SensorBuffer, *, period_s: float = SensingSettings.period_s) -> None:
        self.period_s = period_s
        self._buffer = buffer

    async def step(self, stamp_s: float) -> None:
        """Fetch all three."""
        buffer, port = self._buffer, self._buffer.port
        odometry = await _fetched("odometry", port.odometry, buffer, stamp_s)
        if odometry is not None:
            buffer.add_odometry(odometry)
        scan = await _fetched("scan", port.scan, buffer, stamp_s)
        if scan is not None:
            buffer.add_scan(scan)
        joints = await _fetched("joints", port.joints, buffer, stamp_s)
        if joints is not None:
            buffer.add_joints(joints)


class Filming:
    """Agent that fetches a camera frame each step. Without it the camera is left alone (``--no-camera``)."""

    name = "filming"

    def __init__(self, buffer: SensorBuffer, *, period_s: float = 0.2) -> None:
        self.period_s = period_s
        self._buffer = buffer

    async def step(self, stamp_s: float) -> None:
        """Fetch a frame."""
        frame = await _fetched("frame", self._buffer.port.frame, self._buffer, stamp_s)
        if frame is not None:
            self._buffer.add_frame(frame)


async def _fetched(
    sensor: str, read: Callable[[], Awaitable[Measurement]], buffer: SensorBuffer, stamp_s: float
) -> Measurement | None:
    """A measurement, ``None`` from a silent sensor, which is marked in ``buffer`` until it is back."""
    try:
        measurement = await read()
    except SensorSilent as problem:
        if sensor not in buffer.silent:
            logger.warning("%s", problem, extra={"sensor": sensor})
        buffer.silent.setdefault(sensor, stamp_s)
        return None
    if buffer.silent.pop(sensor, None) is not None:
        logger.info("sensor '%s' is back", sensor, extra={"sensor": sensor})
    return measurement
