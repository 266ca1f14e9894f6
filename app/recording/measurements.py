"""Messages of a recording as measurements; what comes from a file is checked on the way in."""

from __future__ import annotations

import base64
import binascii
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, BeforeValidator, ConfigDict, Field

from perception.pictures import picture_of
from perception.ports import Intrinsics, JointState, LidarScan, Odometry, RgbdFrame
from scene_graph.geometry.se3 import SE3
from skills.ports import ArmTarget, BodyState


def _bytes(text: object) -> bytes:
    if not isinstance(text, str):
        raise ValueError("bytes in base64 are expected")  # noqa: TRY004 - the validator reports ValueErrors
    try:
        return base64.b64decode(text, validate=True)
    except binascii.Error as error:
        raise ValueError(f"no base64: {error}") from error


Bytes = Annotated[bytes, BeforeValidator(_bytes)]
Quad = tuple[float, float, float, float]
Triple = tuple[float, float, float]


class _Message(BaseModel):
    model_config = ConfigDict(extra="ignore", allow_inf_nan=False, frozen=True)


class _Transform(_Message):
    quat_wxyz: Quad
    translation_m: Triple

    @property
    def se3(self) -> SE3:
        return SE3(self.quat_wxyz, self.translation_m)


class OdometryMessage(_Message):
    """``/odometry``."""

    stamp_s: float
    x_m: float
    y_m: float
    yaw_rad: float
    linear_mps: float
    angular_radps: float

    @property
    def measurement(self) -> Odometry:
        """As the port gave it."""
        return Odometry(**self.model_dump())


class LidarMessage(_Message):
    """``/lidar``."""

    stamp_s: float
    ranges_m: Bytes
    elevations_rad: Bytes
    azimuths_rad: Bytes
    T_base_lidar: _Transform

    @property
    def measurement(self) -> LidarScan:
        """As the port gave it.

        Raises:
            ValueError: there are not as many ranges as rings and azimuths say.
        """
        elevations, azimuths = _numbers(self.elevations_rad, "<f8"), _numbers(self.azimuths_rad, "<f8")
        ranges = _numbers(self.ranges_m, "<f4").reshape(len(elevations), len(azimuths))
        return LidarScan(
            stamp_s=self.stamp_s,
            ranges_m=ranges,
            elevations_rad=elevations,
            azimuths_rad=azimuths,
            T_base_lidar=self.T_base_lidar.se3,
        )


class _Intrinsics(_Message):
    fx: float
    fy: float
    cx: float
    cy: float
    width: Annotated[int, Field(ge=1)]
    height: Annotated[int, Field(ge=1)]


class ImageMessage(_Message):
    """``/camera/color`` and ``/camera/depth``."""

    data: Bytes


class FrameMessage(_Message):
    """``/camera/frame``; the images come in messages of their own."""

    stamp_s: float
    intrinsics: _Intrinsics
    T_base_camera: _Transform

    def measurement(self, color: ImageMessage, depth: ImageMessage) -> RgbdFrame:
        """As the port gave it.

        Raises:
            ValueError: an image has another size than the frame says.
            NoPicture: the color image cannot be read.
        """
        shape = (self.intrinsics.height, self.intrinsics.width)
        rgb = picture_of(color.data)
        if rgb.shape[:2] != shape:
            raise ValueError(f"the color image is {rgb.shape[1]} x {rgb.shape[0]}, not {shape[1]} x {shape[0]}")
        return RgbdFrame(
            stamp_s=self.stamp_s,
            rgb=rgb,
            depth_m=_numbers(depth.data, "<f4").reshape(shape),
            intrinsics=Intrinsics(**self.intrinsics.model_dump()),
            T_base_camera=self.T_base_camera.se3,
        )


class _Arm(_Message):
    stamp_s: float
    lift_m: float
    extension_m: float
    wrist_pitch_rad: float
    wrist_roll_rad: float
    gripper_opening_m: float
    pan_rad: float
    tilt_rad: float
    finger_contacts: tuple[bool, bool]
    T_base_gripper: _Transform


class JointsMessage(_Arm):
    """``/joints``."""

    @property
    def measurement(self) -> JointState:
        """As the port gave it."""
        return JointState(**{**_fields(self), "T_base_gripper": self.T_base_gripper.se3})


class BodyMessage(_Arm):
    """``/body``; ``now_s``: robot time at which all before it in the file was known."""

    now_s: float
    linear_mps: float
    angular_radps: float
    bumped: bool
    stopped: bool

    @property
    def measurement(self) -> BodyState:
        """As the port gave it."""
        told = _fields(self)
        arm = ArmTarget(**{name: told.pop(name) for name in ArmTarget.__dataclass_fields__})
        del told["now_s"]
        return BodyState(**{**told, "arm": arm, "T_base_gripper": self.T_base_gripper.se3})


def _fields(message: BaseModel) -> dict[str, Any]:
    return {name: getattr(message, name) for name in type(message).model_fields}


def _numbers(data: bytes, kind: str) -> NDArray[Any]:
    return np.frombuffer(data, dtype=kind).astype(np.dtype(kind).newbyteorder("="))
