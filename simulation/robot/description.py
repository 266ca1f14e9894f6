"""The default robot in numbers: what its URDF, its limits, its camera and its LiDAR are made from.

It is made up, not measured: chosen to be about as large, strong and fast as mobile manipulators for homes.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.ports import Intrinsics
from skills.ports import ArmGeometry, ArmTarget, BodyLimits


@dataclass(frozen=True, kw_only=True)
class CameraDescription:
    """The RGB-D camera on the pan-tilt head."""

    width_px: int = 320
    height_px: int = 240
    """Small, so that two cores render several frames a second."""
    horizontal_fov_rad: float = math.radians(60.0)
    """As depth cameras have it: 58 to 69 degrees."""
    clip_m: tuple[float, float] = (0.05, 30.0)
    """What is nearer or farther is not drawn."""
    depth_range_m: tuple[float, float] = (0.2, 8.0)
    """Beyond, depth is unknown, as with real depth cameras."""

    @property
    def focal_px(self) -> float:
        """Focal length, the same along both axes."""
        return self.width_px / 2 / math.tan(self.horizontal_fov_rad / 2)

    @property
    def vertical_fov_rad(self) -> float:
        """Angle of view from the lower to the upper edge."""
        return 2 * math.atan(self.height_px / 2 / self.focal_px)

    @property
    def intrinsics(self) -> Intrinsics:
        """As the sensor port tells them."""
        return Intrinsics(
            fx=self.focal_px,
            fy=self.focal_px,
            cx=(self.width_px - 1) / 2,
            cy=(self.height_px - 1) / 2,
            width=self.width_px,
            height=self.height_px,
        )


@dataclass(frozen=True, kw_only=True)
class LidarDescription:
    """The LiDAR on top of the mast (design, section 5)."""

    elevations_deg: tuple[float, ...] = (-60, -48, -38, -29, -21, -14, -7, -1.5, 2, 4, 6.5, 10, 15, 22, 31, 42)
    """Sixteen rings, as real ones have: those below see the floor around the base, those above whole walls."""
    azimuths: int = 900
    """Rays of a ring, 0.4 degrees apart."""
    range_m: tuple[float, float] = (0.15, 30.0)
    """As small LiDARs with rings have it."""
    mast_half_width_rad: float = math.radians(40.0)
    mast_below_rad: float = math.radians(-35.0)
    """Rays that end on the robot itself: the mast stands behind and below the sensor."""

    @property
    def elevations_rad(self) -> NDArray[np.float64]:
        """(rings,)"""
        return np.radians(self.elevations_deg)

    @property
    def azimuths_rad(self) -> NDArray[np.float64]:
        """(azimuths,) from -pi on."""
        return np.arange(self.azimuths, dtype=np.float64) * (math.tau / self.azimuths) - math.pi


@dataclass(frozen=True, kw_only=True)
class Motor:
    """What drives a joint: newtons and meters per second, or newton meters and radians per second."""

    force: float
    speed: float


def _motors() -> Mapping[str, Motor]:
    return {
        "lift": Motor(force=300.0, speed=0.25),
        "extension": Motor(force=120.0, speed=0.25),
        "wrist_pitch": Motor(force=25.0, speed=1.5),
        "wrist_roll": Motor(force=15.0, speed=1.5),
        "pan": Motor(force=5.0, speed=2.0),
        "tilt": Motor(force=5.0, speed=2.0),
    }


@dataclass(frozen=True, kw_only=True)
class RobotDescription:
    """The whole robot. Lengths in meters; boxes along x, y and z of the base frame."""

    limits: BodyLimits = field(default_factory=BodyLimits)
    geometry: ArmGeometry = field(default_factory=ArmGeometry)
    camera: CameraDescription = field(default_factory=CameraDescription)
    lidar: LidarDescription = field(default_factory=LidarDescription)
    motors: Mapping[str, Motor] = field(default_factory=_motors)
    """By the name of the joint; chosen: slow, as beside people, and with force for whatever the hand can take."""
    base_force_n: float = 400.0
    base_torque_nm: float = 150.0
    """Chosen: over ten times what the limits' acceleration needs, so that the base follows them whatever it carries."""
    finger_speed_mps: float = 0.08
    """Chosen: open or closed in under a second."""
    usual_effort_n: float = 15.0
    """Force of each finger before anything is commanded."""
    base_radius_m: float = 0.25
    base_height_m: float = 0.22
    base_clearance_m: float = 0.02
    base_mass_kg: float = 40.0
    mast_m: tuple[float, float, float] = (0.08, 0.12, 1.30)
    mast_x_m: float = -0.10
    head_x_m: float = 0.05
    """Where the camera's axis of pan stands."""
    finger_m: tuple[float, float, float] = (0.10, 0.012, 0.03)
    """Length, thickness and height of a finger."""
    finger_behind_m: float = 0.03
    """The middle of a finger lies so far behind the point between the finger pads."""
    graspable_m: float = 0.09
    """What is no wider can be grasped: as far as the hand opens, less 15 mm of play on either side."""
    stow: ArmTarget = field(
        default_factory=lambda: ArmTarget(lift_m=0.75, extension_m=0.0, wrist_pitch_rad=-math.pi / 2)
    )
    """How the arm stands at the start."""
    tilt_at_start_rad: float = -0.35
    """The floor two or three meters ahead is in the middle of the picture."""
