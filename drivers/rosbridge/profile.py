"""What a robot behind rosbridge is called and made of: one TOML file, the profile."""

from __future__ import annotations

import tomllib
from math import cos, sin
from pathlib import Path
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from drivers.rosbridge.errors import BadProfile
from scene_graph.geometry.se3 import SE3
from skills.ports import ArmGeometry, BodyLimits

Range = tuple[float, float]
Positive = Annotated[float, Field(gt=0)]


class _Table(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid")


class Lidar(_Table):
    """``azimuths``: rays of a revolution, where the cloud does not say (unorganized, with a field ``ring``)."""

    topic: str
    type: Literal["sensor_msgs/PointCloud2", "sensor_msgs/LaserScan"] = "sensor_msgs/PointCloud2"
    azimuths: int = Field(default=900, ge=4)


class Camera(_Table):
    """Color and registered depth, both compressed, and what the lens does."""

    color: str
    depth: str
    info: str


class Arm(_Table):
    """Joints as ``/joint_states`` names them, and the trajectory controller that moves them. Meters and radians a
    second: the speed at which it is told to move.
    """

    topic: str
    lift: str
    extension: str
    wrist_pitch: str
    wrist_roll: str
    linear_mps: Positive = 0.25
    angular_radps: Positive = 1.5


class Head(_Table):
    """Pan and tilt of the camera."""

    topic: str
    pan: str
    tilt: str
    angular_radps: Positive = 2.0


class Gripper(_Table):
    """``fingers``: joints whose positions add up to the gap in meters. ``contact_effort``: from which effort of its
    joint on a finger feels something.
    """

    action: str
    fingers: tuple[str, str]
    contact_effort: Positive = 2.0


class Mount(_Table):
    """Where a frame is on the base, if ``/tf_static`` does not say: meters, radians about x, y, z in this order."""

    xyz: tuple[float, float, float]
    rpy: tuple[float, float, float] = (0.0, 0.0, 0.0)

    @property
    def transform(self) -> SE3:
        """``T_base_frame``."""
        roll, pitch, yaw = (0.5 * angle_rad for angle_rad in self.rpy)
        turn = SE3((cos(yaw), 0, 0, sin(yaw))) @ SE3((cos(pitch), 0, sin(pitch), 0)) @ SE3((cos(roll), sin(roll), 0, 0))
        return SE3(turn.quat_wxyz, self.xyz)


class Limits(_Table):
    """The body's limits where they differ from the default robot's; the driver enforces them."""

    linear_mps: Positive = 0.6
    linear_mps2: Positive = 0.8
    angular_radps: Positive = 1.2
    angular_radps2: Positive = 2.5
    lift_m: Range = (0.05, 1.30)
    extension_m: Range = (0.0, 0.80)
    wrist_pitch_rad: Range = (-1.5708, 0.5)
    wrist_roll_rad: Range = (-1.5708, 1.5708)
    gripper_opening_m: Range = (0.0, 0.12)
    pan_rad: Range = (-2.9, 2.9)
    tilt_rad: Range = (-1.4, 0.5)
    footprint_radius_m: Positive = 0.28
    command_timeout_s: Positive = 0.5


class Geometry(_Table):
    """The arm's dimensions where they differ from the default robot's, in meters."""

    wrist_x_m: float = 0.10
    hand_length_m: Positive = 0.18
    camera_height_m: Positive = 1.40
    camera_x_m: float = 0.05
    lidar_height_m: Positive = 1.60
    height_m: Positive = 1.75
    hand_half_width_m: Positive = 0.09
    palm_half_m: tuple[Positive, Positive] = (0.08, 0.02)
    palm_to_pads_m: Positive = 0.07
    pads_to_tips_m: Positive = 0.02
    finger_m: Positive = 0.012
    finger_half_height_m: Positive = 0.015
    arm_half_m: Positive = 0.03


class Profile(_Table):
    """One robot. ``ros``: 1 writes times and actions otherwise than 2. ``silent_after_s``: age from which a sensor's
    newest data is no news any more.
    """

    ros: Literal[1, 2] = 2
    url: str = Field(default="ws://127.0.0.1:9090", pattern="^wss?://")
    base_frame: str = "base_link"
    odometry: str = "/odom"
    joints: str = "/joint_states"
    drive: str = "/cmd_vel"
    drive_type: Literal["geometry_msgs/Twist", "geometry_msgs/TwistStamped"] = "geometry_msgs/Twist"
    bumper: str | None = None
    lidar: Lidar
    camera: Camera | None = None
    arm: Arm | None = None
    head: Head | None = None
    gripper: Gripper | None = None
    mounts: dict[str, Mount] = Field(default_factory=dict)
    limits: Limits = Limits()
    geometry: Geometry = Geometry()
    silent_after_s: Positive = 1.0

    @property
    def joint_names(self) -> tuple[str, ...]:
        """All joints that are of interest."""
        arm, head, gripper = self.arm, self.head, self.gripper
        return (
            *((arm.lift, arm.extension, arm.wrist_pitch, arm.wrist_roll) if arm is not None else ()),
            *((head.pan, head.tilt) if head is not None else ()),
            *(gripper.fingers if gripper is not None else ()),
        )

    @property
    def body_limits(self) -> BodyLimits:
        """The same as the body port says it; without an arm nothing is in reach."""
        limits = BodyLimits(**self.limits.model_dump())
        if self.arm is not None:
            return limits
        return BodyLimits(**self.limits.model_dump(exclude={"extension_m"}), extension_m=(0.0, 0.0))

    @property
    def arm_geometry(self) -> ArmGeometry:
        """The same as the body port says it."""
        return ArmGeometry(**self.geometry.model_dump())


def read_profile(path: Path) -> Profile:
    """The profile in a TOML file.

    Raises:
        BadProfile: it cannot be read, or a field is missing, unknown or impossible.
    """
    try:
        with path.expanduser().open("rb") as file:
            return Profile.model_validate(tomllib.load(file))
    except OSError as error:
        raise BadProfile(path, error.strerror or str(error)) from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise BadProfile(path, f"this is no TOML: {error}") from error
    except ValidationError as error:
        first = error.errors()[0]
        field = ".".join(str(part) for part in first["loc"])
        raise BadProfile(path, f"{field}: {first['msg']}") from error
