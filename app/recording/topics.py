"""Topics of a recording and the schemas of their messages, all JSON.

Those named ``foxglove.…`` are Foxglove's, so that its viewer shows them; bytes are in base64. The others are ours and
hold every number as it was measured; replaying reads them, and of Foxglove's the two images.
"""

from __future__ import annotations

from typing import Any

ODOMETRY, JOINTS, BODY = "/odometry", "/joints", "/body"
LIDAR, POINTS = "/lidar", "/lidar/points"
FRAME, COLOR, DEPTH, CALIBRATION = "/camera/frame", "/camera/color", "/camera/depth", "/camera/calibration"
TRANSFORMS, GRAPH = "/tf", "/graph"

NEEDED = (ODOMETRY, LIDAR, JOINTS, BODY)
"""Without these topics nothing can be replayed."""
PROFILE = "majordomo"
"""Name of the metadata record that says how the recording was made."""

_NUMBER: dict[str, Any] = {"type": "number"}
_INTEGER: dict[str, Any] = {"type": "integer"}
_TEXT: dict[str, Any] = {"type": "string"}
_BYTES: dict[str, Any] = {"type": "string", "contentEncoding": "base64"}
_FLAG: dict[str, Any] = {"type": "boolean"}


def _object(**properties: Any) -> dict[str, Any]:
    return {"type": "object", "properties": properties}


def _list(items: dict[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": items}


_TIME = _object(sec=_INTEGER, nsec=_INTEGER)
_VECTOR3 = _object(x=_NUMBER, y=_NUMBER, z=_NUMBER)
_QUATERNION = _object(x=_NUMBER, y=_NUMBER, z=_NUMBER, w=_NUMBER)
_TRANSFORM = _object(quat_wxyz=_list(_NUMBER), translation_m=_list(_NUMBER))
_STAMPED = {"stamp_s": _NUMBER}
_ARM = {"lift_m": _NUMBER, "extension_m": _NUMBER, "wrist_pitch_rad": _NUMBER, "wrist_roll_rad": _NUMBER}
_HAND = {"gripper_opening_m": _NUMBER, "finger_contacts": _list(_FLAG), "T_base_gripper": _TRANSFORM}
_HEAD = {"pan_rad": _NUMBER, "tilt_rad": _NUMBER}

SCHEMAS: dict[str, tuple[str, dict[str, Any]]] = {
    ODOMETRY: (
        "majordomo.Odometry",
        _object(**_STAMPED, x_m=_NUMBER, y_m=_NUMBER, yaw_rad=_NUMBER, linear_mps=_NUMBER, angular_radps=_NUMBER),
    ),
    JOINTS: ("majordomo.JointState", _object(**_STAMPED, **_ARM, **_HAND, **_HEAD)),
    BODY: (
        "majordomo.BodyState",
        _object(
            now_s=_NUMBER,
            **_STAMPED,
            **_ARM,
            **_HAND,
            **_HEAD,
            linear_mps=_NUMBER,
            angular_radps=_NUMBER,
            bumped=_FLAG,
            stopped=_FLAG,
        ),
    ),
    LIDAR: (
        "majordomo.LidarScan",
        _object(**_STAMPED, ranges_m=_BYTES, elevations_rad=_BYTES, azimuths_rad=_BYTES, T_base_lidar=_TRANSFORM),
    ),
    POINTS: (
        "foxglove.PointCloud",
        _object(
            timestamp=_TIME,
            frame_id=_TEXT,
            pose=_object(position=_VECTOR3, orientation=_QUATERNION),
            point_stride=_INTEGER,
            fields=_list(_object(name=_TEXT, offset=_INTEGER, type=_INTEGER)),
            data=_BYTES,
        ),
    ),
    FRAME: (
        "majordomo.RgbdFrame",
        _object(
            **_STAMPED,
            intrinsics=_object(fx=_NUMBER, fy=_NUMBER, cx=_NUMBER, cy=_NUMBER, width=_INTEGER, height=_INTEGER),
            T_base_camera=_TRANSFORM,
        ),
    ),
    COLOR: ("foxglove.CompressedImage", _object(timestamp=_TIME, frame_id=_TEXT, data=_BYTES, format=_TEXT)),
    DEPTH: (
        "foxglove.RawImage",
        _object(
            timestamp=_TIME,
            frame_id=_TEXT,
            width=_INTEGER,
            height=_INTEGER,
            encoding=_TEXT,
            step=_INTEGER,
            data=_BYTES,
        ),
    ),
    CALIBRATION: (
        "foxglove.CameraCalibration",
        _object(
            timestamp=_TIME,
            frame_id=_TEXT,
            width=_INTEGER,
            height=_INTEGER,
            distortion_model=_TEXT,
            D=_list(_NUMBER),
            K=_list(_NUMBER),
            R=_list(_NUMBER),
            P=_list(_NUMBER),
        ),
    ),
    TRANSFORMS: (
        "foxglove.FrameTransform",
        _object(
            timestamp=_TIME,
            parent_frame_id=_TEXT,
            child_frame_id=_TEXT,
            translation=_VECTOR3,
            rotation=_QUATERNION,
        ),
    ),
    GRAPH: (
        "majordomo.SceneGraph",
        _object(revision=_INTEGER, stamp_s=_NUMBER, nodes=_list(_object()), edges=_list(_object())),
    ),
}
"""Of each topic, name and JSON schema of its messages."""
