"""The sensor port: what a robot's driver gives to perception (design, section 5).

Base frame: origin on the floor at the center of rotation, x forward, y left, z up. A driver for a real robot implements
``SensorPort`` and, for its motors, ``skills.ports.BodyPort``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3


@dataclass(frozen=True, kw_only=True)
class Odometry:
    """Dead-reckoned pose of the base in the odometry frame (where the driver started), with its velocity."""

    stamp_s: float
    x_m: float
    y_m: float
    yaw_rad: float
    linear_mps: float
    angular_radps: float


@dataclass(frozen=True, kw_only=True, eq=False)
class LidarScan:
    """One revolution of a multi-ring LiDAR.

    ``ranges_m``: (rings, azimuths) float32, ``inf`` where nothing returned. ``elevations_rad``: (rings,), up positive.
    ``azimuths_rad``: (azimuths,), counter-clockwise from the sensor's x. ``T_base_lidar`` maps sensor into base.
    """

    stamp_s: float
    ranges_m: NDArray[np.float32]
    elevations_rad: NDArray[np.float64]
    azimuths_rad: NDArray[np.float64]
    T_base_lidar: SE3


@dataclass(frozen=True, kw_only=True)
class Intrinsics:
    """Pinhole camera: focal lengths and principal point in pixels, image size in pixels."""

    fx: float
    fy: float
    cx: float
    cy: float
    width: int
    height: int


@dataclass(frozen=True, kw_only=True, eq=False)
class RgbdFrame:
    """Registered color and depth.

    ``rgb``: (H, W, 3) uint8. ``depth_m``: (H, W) float32 along the optical axis, 0 where unknown. ``T_base_camera``
    maps the optical frame (x right, y down, z forward) into the base at the time of the frame.
    """

    stamp_s: float
    rgb: NDArray[np.uint8]
    depth_m: NDArray[np.float32]
    intrinsics: Intrinsics
    T_base_camera: SE3


@dataclass(frozen=True, kw_only=True)
class JointState:
    """Arm, camera and gripper as measured.

    ``finger_contacts``: whether the left and the right finger pad feel something. ``T_base_gripper``: frame between the
    finger pads, x along the approach direction (out of the hand), y along the closing direction.
    """

    stamp_s: float
    lift_m: float
    extension_m: float
    wrist_pitch_rad: float
    wrist_roll_rad: float
    gripper_opening_m: float
    pan_rad: float
    tilt_rad: float
    finger_contacts: tuple[bool, bool]
    T_base_gripper: SE3


@dataclass(frozen=True, kw_only=True)
class RobotShape:
    """The robot's body as obstacles meet it: an upright cylinder about the center of rotation, in meters."""

    footprint_radius_m: float = 0.28
    height_m: float = 1.7


class SensorPort(Protocol):
    """Newest measurement of each sensor; a call may wait for one, and raises ``SensorSilent`` when none comes."""

    async def odometry(self) -> Odometry:
        """Newest odometry."""
        ...

    async def scan(self) -> LidarScan:
        """Newest LiDAR revolution."""
        ...

    async def frame(self) -> RgbdFrame:
        """Newest color and depth image."""
        ...

    async def joints(self) -> JointState:
        """Newest joint and gripper state."""
        ...
