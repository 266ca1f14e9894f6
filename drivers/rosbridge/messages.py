"""ROS messages as rosbridge writes them in JSON, of ROS 1 and 2, and what they mean here.

Whatever a message lacks or has in another shape is a ``BadMessage``: nothing is guessed. rosbridge writes byte arrays
in base64, and what is no finite number as null.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Self

from pydantic import Base64Bytes, BaseModel, BeforeValidator, ConfigDict, Field, ValidationError

from drivers.rosbridge.errors import BadMessage
from perception.ports import Intrinsics, Odometry
from scene_graph.geometry.se3 import SE3


class Message(BaseModel):
    """Base of all messages; fields that are of no use here are left out."""

    model_config = ConfigDict(frozen=True, extra="ignore", populate_by_name=True)

    @classmethod
    def read(cls, topic: str, message: Mapping[str, Any]) -> Self:
        """The message of a topic.

        Raises:
            BadMessage: it is none of this type; names topic and field.
        """
        try:
            return cls.model_validate(message)
        except ValidationError as error:
            first = error.errors()[0]
            where = ".".join(str(part) for part in first["loc"])
            raise BadMessage(f"{topic}: {where}: {first['msg']}") from error


def _seconds(stamp: Any) -> Any:
    """ROS 2 says ``sec`` and ``nanosec``, ROS 1 ``secs`` and ``nsecs``."""
    if not isinstance(stamp, Mapping):
        return stamp
    whole, rest = stamp.get("sec", stamp.get("secs")), stamp.get("nanosec", stamp.get("nsecs"))
    return None if whole is None or rest is None else float(whole) + 1e-9 * float(rest)


Stamp = Annotated[float, BeforeValidator(_seconds), Field(allow_inf_nan=False)]
Number = Annotated[float, Field(allow_inf_nan=False)]


class Header(Message):
    """When, in seconds of the robot's clock, and where."""

    stamp: Stamp
    frame_id: str = ""


class Vector(Message):
    """Meters, or meters and radians a second."""

    x: Number
    y: Number
    z: Number


class Quaternion(Message):
    """A turn."""

    x: Number
    y: Number
    z: Number
    w: Number

    @property
    def wxyz(self) -> tuple[float, float, float, float]:
        return self.w, self.x, self.y, self.z


class _Pose(Message):
    position: Vector
    orientation: Quaternion


class _PoseWithCovariance(Message):
    pose: _Pose


class _Twist(Message):
    linear: Vector
    angular: Vector


class _TwistWithCovariance(Message):
    twist: _Twist


class OdometryMessage(Message):
    """``nav_msgs/Odometry``."""

    header: Header
    child_frame_id: str = ""
    pose: _PoseWithCovariance
    twist: _TwistWithCovariance

    def odometry(self, stamp_s: float) -> Odometry:
        """The same in the plane, at ``stamp_s`` of our time."""
        pose, twist = self.pose.pose, self.twist.twist
        return Odometry(
            stamp_s=stamp_s,
            x_m=pose.position.x,
            y_m=pose.position.y,
            yaw_rad=SE3(pose.orientation.wxyz).yaw_rad,
            linear_mps=twist.linear.x,
            angular_radps=twist.angular.z,
        )


class JointStateMessage(Message):
    """``sensor_msgs/JointState``; drivers may tell of some joints in one message and of others in the next."""

    header: Header
    name: list[str]
    position: list[Number]
    effort: list[float | None] = Field(default_factory=list)


class _Transform(Message):
    translation: Vector
    rotation: Quaternion


class TransformStamped(Message):
    """``geometry_msgs/TransformStamped``."""

    header: Header
    child_frame_id: str
    transform: _Transform

    @property
    def T_parent_child(self) -> SE3:
        """Maps child coordinates into the parent's."""
        shift = self.transform.translation
        return SE3(self.transform.rotation.wxyz, (shift.x, shift.y, shift.z))


class TransformsMessage(Message):
    """``tf2_msgs/TFMessage``."""

    transforms: list[TransformStamped]


class LaserScanMessage(Message):
    """``sensor_msgs/LaserScan``: one ring, level with its frame."""

    header: Header
    angle_min: Number
    angle_increment: Number
    range_min: Number
    range_max: Number
    ranges: list[float | None]


class PointField(Message):
    """Where in a point one of its values stands, and of which type it is (``sensor_msgs/PointField``)."""

    name: str
    offset: int = Field(ge=0)
    datatype: int


class PointCloudMessage(Message):
    """``sensor_msgs/PointCloud2``."""

    header: Header
    height: int = Field(ge=1)
    width: int = Field(ge=0)
    fields: list[PointField]
    is_bigendian: bool = False
    point_step: int = Field(ge=1)
    row_step: int = Field(ge=0)
    data: Base64Bytes


class CompressedImageMessage(Message):
    """``sensor_msgs/CompressedImage``."""

    header: Header
    format: str = ""
    data: Base64Bytes


class CameraInfoMessage(Message):
    """``sensor_msgs/CameraInfo``; ROS 1 writes the matrix with a capital."""

    width: int = Field(ge=1)
    height: int = Field(ge=1)
    k: list[Number] = Field(min_length=9, max_length=9)

    @classmethod
    def read(cls, topic: str, message: Mapping[str, Any]) -> Self:
        """The message of a topic.

        Raises:
            BadMessage: it is none of this type, or the camera has not been calibrated.
        """
        info = super().read(topic, {**message, "k": message.get("k", message.get("K"))})
        if info.k[0] <= 0 or info.k[4] <= 0:
            raise BadMessage(f"{topic}: k: its focal lengths are not positive: is the camera calibrated?")
        return info

    @property
    def intrinsics(self) -> Intrinsics:
        """The same in our words."""
        fx, _, cx, _, fy, cy, *_ = self.k
        return Intrinsics(fx=fx, fy=fy, cx=cx, cy=cy, width=self.width, height=self.height)


class BoolMessage(Message):
    """``std_msgs/Bool``."""

    data: bool


@dataclass(kw_only=True)
class Joints:
    """Newest position and effort of each joint, from however many messages, and when the newest came."""

    stamp_s: float = -math.inf
    position: dict[str, float] = field(default_factory=dict)
    effort: dict[str, float] = field(default_factory=dict)

    def take(self, message: JointStateMessage, stamp_s: float) -> None:
        """Take in what a message says."""
        self.stamp_s = max(self.stamp_s, stamp_s)
        self.position.update(zip(message.name, message.position, strict=False))
        self.effort.update((name, value or 0.0) for name, value in zip(message.name, message.effort, strict=False))


def twist(linear_mps: float, angular_radps: float) -> dict[str, Any]:
    """``geometry_msgs/Twist`` of a base that drives forward and turns."""
    return {"linear": {"x": linear_mps, "y": 0.0, "z": 0.0}, "angular": {"x": 0.0, "y": 0.0, "z": angular_radps}}


def time_message(seconds: float, ros: int) -> dict[str, int]:
    """A time or duration as this version of ROS writes it."""
    whole_s, rest_s = divmod(seconds, 1.0)
    names = ("secs", "nsecs") if ros == 1 else ("sec", "nanosec")
    return dict(zip(names, (int(whole_s), int(rest_s * 1e9)), strict=True))


def trajectory(joints: Mapping[str, float], duration_s: float, ros: int) -> dict[str, Any]:
    """``trajectory_msgs/JointTrajectory`` to one point, from now on, in ``duration_s``."""
    point = {"positions": list(joints.values()), "time_from_start": time_message(duration_s, ros)}
    at_once = {"stamp": time_message(0.0, ros), "frame_id": ""}
    return {"header": at_once, "joint_names": list(joints), "points": [point]}
