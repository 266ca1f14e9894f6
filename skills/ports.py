"""The body port: what a robot's driver does for skills (design, section 5), and the body's limits.

Base frame as in the sensor port: origin on the floor at the center of rotation, x forward, y left, z up. The default
robot's arm reaches forward along x: a lift on the mast, a telescope, a wrist that pitches (0 level, -pi/2 straight
down) and rolls about the hand's own axis, and two parallel fingers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3


@dataclass(frozen=True, kw_only=True)
class BodyLimits:
    """Hard limits, enforced in the driver; nothing above the port can lift them."""

    linear_mps: float = 0.6
    linear_mps2: float = 0.8
    angular_radps: float = 1.2
    angular_radps2: float = 2.5
    lift_m: tuple[float, float] = (0.05, 1.30)
    extension_m: tuple[float, float] = (0.0, 0.80)
    wrist_pitch_rad: tuple[float, float] = (-1.5708, 0.5)
    wrist_roll_rad: tuple[float, float] = (-1.5708, 1.5708)
    gripper_opening_m: tuple[float, float] = (0.0, 0.12)
    gripper_effort_n: tuple[float, float] = (0.0, 40.0)
    pan_rad: tuple[float, float] = (-2.9, 2.9)
    tilt_rad: tuple[float, float] = (-1.4, 0.5)
    footprint_radius_m: float = 0.28
    command_timeout_s: float = 0.5


@dataclass(frozen=True, kw_only=True)
class ArmGeometry:
    """Where the hand is: wrist pivot at (``wrist_x_m`` + extension, 0, lift) in the base frame, finger pads at
    ``hand_length_m`` from it along the hand. Camera and LiDAR heights are where the mast carries them;
    ``camera_x_m`` is how far before the axis the camera is, ``height_m`` the height of the whole robot.

    The hand: ``hand_half_width_m`` is half the width of palm and open fingers, ``palm_half_m`` half of the palm's sides
    along the direction in which the fingers close and across; ``palm_to_pads_m`` from its face to the pads' center,
    ``pads_to_tips_m`` from there to the finger tips. ``finger_m`` is how thick a finger is, ``finger_half_height_m``
    half of how high it is when the hand is level. ``arm_half_m``: half of how high the arm behind the hand is.
    """

    wrist_x_m: float = 0.10
    hand_length_m: float = 0.18
    camera_height_m: float = 1.40
    camera_x_m: float = 0.05
    lidar_height_m: float = 1.60
    height_m: float = 1.75
    hand_half_width_m: float = 0.09
    palm_half_m: tuple[float, float] = (0.08, 0.02)
    palm_to_pads_m: float = 0.07
    pads_to_tips_m: float = 0.02
    finger_m: float = 0.012
    finger_half_height_m: float = 0.015
    arm_half_m: float = 0.03


@dataclass(frozen=True, kw_only=True)
class ArmTarget:
    """Joint targets of the arm. ``lift_m``: height of the telescope's axis above the floor. ``extension_m``: 0
    retracted.
    """

    lift_m: float
    extension_m: float
    wrist_pitch_rad: float = 0.0
    wrist_roll_rad: float = 0.0


@dataclass(frozen=True, kw_only=True)
class BodyState:
    """The body as measured. ``T_base_gripper``: frame between the finger pads, x out of the hand, y the closing
    direction.
    """

    stamp_s: float
    linear_mps: float
    angular_radps: float
    arm: ArmTarget
    gripper_opening_m: float
    finger_contacts: tuple[bool, bool]
    pan_rad: float
    tilt_rad: float
    bumped: bool
    stopped: bool
    T_base_gripper: SE3


class BodyPort(Protocol):
    """Commands; each returns at once, motion follows. A drive command lapses after ``command_timeout_s`` (dead man)."""

    @property
    def limits(self) -> BodyLimits: ...

    @property
    def geometry(self) -> ArmGeometry: ...

    async def state(self) -> BodyState: ...

    async def drive(self, linear_mps: float, angular_radps: float) -> None: ...

    async def look(self, pan_rad: float, tilt_rad: float) -> None: ...

    async def move_arm(self, target: ArmTarget) -> None: ...

    async def grip(self, opening_m: float, effort_n: float = 15.0) -> None:
        """Close or open the fingers towards ``opening_m`` with at most ``effort_n`` per finger."""
        ...

    def stop(self) -> None:
        """Latch the software stop: base and arm stand still, the gripper keeps its grip. Never blocks."""
        ...

    def release_stop(self) -> None:
        """Lift the latched stop; nothing moves until the next command."""
        ...


@dataclass(frozen=True, kw_only=True, eq=False)
class FloorReturns:
    """Rays of one scan that should have met the floor, base frame, and did not end far from it.

    ``spots_m``: (N, 2), where they would have met it. ``points_m``: (N, 3), where they ended.
    """

    spots_m: NDArray[np.float64]
    points_m: NDArray[np.float64]

    def where(self, chosen: NDArray[np.bool_]) -> FloorReturns:
        """Those that are ``chosen``, (N,)."""
        return FloorReturns(spots_m=self.spots_m[chosen], points_m=self.points_m[chosen])


NO_FLOOR = FloorReturns(spots_m=np.zeros((0, 2)), points_m=np.zeros((0, 3)))


class RangeSource(Protocol):
    """Raw proximity for obstacle avoidance: no beliefs, only what the ranging sensors hit last."""

    def points_base(self) -> NDArray[np.float64]:
        """(N, 3) points in the base frame of the newest scan, floor and ceiling excluded."""
        ...

    def floor_base(self) -> FloorReturns:
        """What the newest scan says about the floor around the base."""
        ...

    def seen_base(self) -> NDArray[np.float64]:
        """(N, 3) points in the base frame that the depth camera saw last, the robot's own arm included; none without
        one.
        """
        ...
