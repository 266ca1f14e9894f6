"""RGB-D camera on the pan-tilt head, rendered on the CPU."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pybullet as p
from numpy.typing import NDArray

from perception.ports import Intrinsics
from scene_graph.geometry.se3 import SE3
from simulation.robot.robot import Joints
from simulation.robot.robot_urdf import HEAD_X_M
from skills.ports import ArmGeometry

WIDTH, HEIGHT = 320, 240
HORIZONTAL_FOV_RAD = math.radians(60.0)
NEAR_M, FAR_M = 0.05, 30.0
DEPTH_RANGE_M = (0.2, 8.0)
BODY_MASK = (1 << 24) - 1
_R_HEAD_OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])

_FOCAL_PX = WIDTH / 2 / math.tan(HORIZONTAL_FOV_RAD / 2)
INTRINSICS = Intrinsics(fx=_FOCAL_PX, fy=_FOCAL_PX, cx=(WIDTH - 1) / 2, cy=(HEIGHT - 1) / 2, width=WIDTH, height=HEIGHT)


@dataclass(frozen=True, kw_only=True, eq=False)
class Picture:
    """What the renderer gives: ``rgb`` (H, W, 3) uint8, ``depth_m`` (H, W) along the axis, ``bodies`` (H, W) or -1."""

    rgb: NDArray[np.uint8]
    depth_m: NDArray[np.float32]
    bodies: NDArray[np.int32]


def T_base_camera(joints: Joints, geometry: ArmGeometry) -> SE3:
    """Optical frame in the base, from pan and tilt."""
    cos_pan, sin_pan = math.cos(joints.pan_rad), math.sin(joints.pan_rad)
    cos_tilt, sin_tilt = math.cos(joints.tilt_rad), math.sin(joints.tilt_rad)
    pan = np.array([[cos_pan, -sin_pan, 0.0], [sin_pan, cos_pan, 0.0], [0.0, 0.0, 1.0]])
    tilt = np.array([[cos_tilt, 0.0, -sin_tilt], [0.0, 1.0, 0.0], [sin_tilt, 0.0, cos_tilt]])
    return SE3.from_rotation(pan @ tilt @ _R_HEAD_OPTICAL, (HEAD_X_M, 0.0, geometry.camera_height_m))


def render(T_world_camera: SE3, client: int) -> Picture:
    """Render from the optical frame's pose in house coordinates."""
    rotation, eye = T_world_camera.rotation(), T_world_camera.translation_m
    view = p.computeViewMatrix(eye.tolist(), (eye + rotation[:, 2]).tolist(), (-rotation[:, 1]).tolist())
    fov_deg = math.degrees(2 * math.atan(HEIGHT / 2 / _FOCAL_PX))
    projection = p.computeProjectionMatrixFOV(fov_deg, WIDTH / HEIGHT, NEAR_M, FAR_M)
    _, _, rgba, buffer, segmentation = p.getCameraImage(
        WIDTH,
        HEIGHT,
        view,
        projection,
        lightDirection=[0.4, 0.3, 1.0],
        shadow=0,
        renderer=p.ER_TINY_RENDERER,
        physicsClientId=client,
    )
    buffer = np.asarray(buffer, dtype=np.float64).reshape(HEIGHT, WIDTH)
    depth_m = FAR_M * NEAR_M / (FAR_M - (FAR_M - NEAR_M) * buffer)
    depth_m[(depth_m < DEPTH_RANGE_M[0]) | (depth_m > DEPTH_RANGE_M[1])] = 0.0
    bodies = np.asarray(segmentation, dtype=np.int64).reshape(HEIGHT, WIDTH)
    bodies = np.where(bodies >= 0, bodies & BODY_MASK, -1)
    return Picture(
        rgb=np.ascontiguousarray(np.asarray(rgba, dtype=np.uint8).reshape(HEIGHT, WIDTH, 4)[:, :, :3]),
        depth_m=depth_m.astype(np.float32),
        bodies=bodies.astype(np.int32),
    )
