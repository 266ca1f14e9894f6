"""Measurements as messages of a recording."""

from __future__ import annotations

import base64
from collections.abc import Iterator
from dataclasses import asdict
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.recording import topics
from app.recording.moment import Moment
from perception.pictures import png_of
from perception.ports import JointState, LidarScan, RgbdFrame
from perception.sensing import scan_points_base
from scene_graph.documents.interchange import to_json
from scene_graph.geometry.se3 import SE3
from skills.ports import BodyState

Message = dict[str, Any]

MAP, BASE, CAMERA = "map", "base", "camera"
"""Names of frames."""
_FLOAT32 = 7
"""Number of the type in Foxglove's PackedElementField."""
_NS_PER_S = 1_000_000_000


def nanoseconds(stamp_s: float) -> int:
    """Time of a record; the format knows none before zero."""
    return max(0, round(stamp_s * _NS_PER_S))


def messages_of(moment: Moment, *, with_points: bool) -> Iterator[tuple[str, Message]]:
    """Topic and content of everything that a moment holds; the body comes last and completes it.

    ``with_points``: also tell the scan as a point cloud, for people to look at.
    """
    if moment.odometry is not None:
        yield topics.ODOMETRY, asdict(moment.odometry)
    if moment.scan is not None:
        yield topics.LIDAR, _scan(moment.scan)
        if with_points:
            yield topics.POINTS, _points(moment.scan)
    if moment.joints is not None:
        yield topics.JOINTS, _joints(moment.joints)
    if moment.T_map_base is not None:
        yield topics.TRANSFORMS, _placed(MAP, BASE, moment.T_map_base, moment.now_s)
    if moment.frame is not None:
        yield from _frame(moment.frame)
    if moment.building is not None:
        yield topics.GRAPH, to_json(moment.building, stamp_s=moment.now_s)
    yield topics.BODY, {"now_s": moment.now_s, **_body(moment.body)}


def _scan(scan: LidarScan) -> Message:
    return {
        "stamp_s": scan.stamp_s,
        "rings": len(scan.elevations_rad),
        "ranges_m": _packed(scan.ranges_m, "<f4"),
        "elevations_rad": _packed(scan.elevations_rad, "<f8"),
        "azimuths_rad": _packed(scan.azimuths_rad, "<f8"),
        "T_base_lidar": _transform(scan.T_base_lidar),
    }


def _points(scan: LidarScan) -> Message:
    return {
        "timestamp": _time(scan.stamp_s),
        "frame_id": BASE,
        "pose": {"position": {"x": 0.0, "y": 0.0, "z": 0.0}, "orientation": {"x": 0.0, "y": 0.0, "z": 0.0, "w": 1.0}},
        "point_stride": 12,
        "fields": [{"name": name, "offset": 4 * index, "type": _FLOAT32} for index, name in enumerate("xyz")],
        "data": _packed(scan_points_base(scan), "<f4"),
    }


def _frame(frame: RgbdFrame) -> Iterator[tuple[str, Message]]:
    """The images first; what completes them last."""
    lens, header = frame.intrinsics, {"timestamp": _time(frame.stamp_s), "frame_id": CAMERA}
    size = {"width": lens.width, "height": lens.height}
    yield topics.TRANSFORMS, _placed(BASE, CAMERA, frame.T_base_camera, frame.stamp_s)
    matrix = [lens.fx, 0.0, lens.cx, 0.0, lens.fy, lens.cy, 0.0, 0.0, 1.0]
    projection = [lens.fx, 0.0, lens.cx, 0.0, 0.0, lens.fy, lens.cy, 0.0, 0.0, 0.0, 1.0, 0.0]
    identity = [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
    undistorted = {"distortion_model": "", "D": [], "K": matrix, "R": identity, "P": projection}
    yield topics.CALIBRATION, {**header, **size, **undistorted}
    yield topics.COLOR, {**header, "format": "png", "data": _base64(png_of(frame.rgb))}
    depth = {"encoding": "32FC1", "step": 4 * lens.width, "data": _packed(frame.depth_m, "<f4")}
    yield topics.DEPTH, {**header, **size, **depth}
    yield (
        topics.FRAME,
        {"stamp_s": frame.stamp_s, "intrinsics": asdict(lens), "T_base_camera": _transform(frame.T_base_camera)},
    )


def _joints(joints: JointState) -> Message:
    told = {name: getattr(joints, name) for name in joints.__dataclass_fields__}
    return {**told, "T_base_gripper": _transform(joints.T_base_gripper)}


def _body(body: BodyState) -> Message:
    told = {name: getattr(body, name) for name in body.__dataclass_fields__ if name != "arm"}
    return {**told, **asdict(body.arm), "T_base_gripper": _transform(body.T_base_gripper)}


def _placed(parent: str, child: str, T_parent_child: SE3, stamp_s: float) -> Message:
    return {
        "timestamp": _time(stamp_s),
        "parent_frame_id": parent,
        "child_frame_id": child,
        "translation": dict(zip("xyz", T_parent_child.translation_m.tolist(), strict=True)),
        "rotation": dict(zip("wxyz", T_parent_child.quat_wxyz.tolist(), strict=True)),
    }


def _transform(transform: SE3) -> Message:
    return {"quat_wxyz": transform.quat_wxyz.tolist(), "translation_m": transform.translation_m.tolist()}


def _time(stamp_s: float) -> Message:
    sec, nsec = divmod(nanoseconds(stamp_s), _NS_PER_S)
    return {"sec": sec, "nsec": nsec}


def _packed(numbers: NDArray[Any], kind: str) -> str:
    return _base64(np.ascontiguousarray(numbers, dtype=kind).tobytes())


def _base64(data: bytes) -> str:
    return base64.b64encode(data).decode("ascii")
