"""RGB-D camera on the pan-tilt head, rendered on the CPU."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pybullet as p
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3
from simulation.robot.description import CameraDescription, RobotDescription
from simulation.robot.robot import Joints

BODY_MASK = (1 << 24) - 1
"""PyBullet packs a body's number into the lower bits of the segmentation, and the link into the others."""
_R_HEAD_OPTICAL = np.array([[0.0, 0.0, 1.0], [-1.0, 0.0, 0.0], [0.0, -1.0, 0.0]])


@dataclass(frozen=True, kw_only=True, eq=False)
class Picture:
    """What the renderer gives: ``rgb`` (H, W, 3) uint8, ``depth_m`` (H, W) along the axis, ``bodies`` (H, W) or -1."""

    rgb: NDArray[np.uint8]
    depth_m: NDArray[np.float32]
    bodies: NDArray[np.int32]


def T_base_camera(joints: Joints, robot: RobotDescription) -> SE3:
    """Optical frame in the base, from pan and tilt."""
    cos_pan, sin_pan = math.cos(joints.pan_rad), math.sin(joints.pan_rad)
    cos_tilt, sin_tilt = math.cos(joints.tilt_rad), math.sin(joints.tilt_rad)
    pan = np.array([[cos_pan, -sin_pan, 0.0], [sin_pan, cos_pan, 0.0], [0.0, 0.0, 1.0]])
    tilt = np.array([[cos_tilt, 0.0, -sin_tilt], [0.0, 1.0, 0.0], [sin_tilt, 0.0, cos_tilt]])
    return SE3.from_rotation(pan @ tilt @ _R_HEAD_OPTICAL, (robot.head_x_m, 0.0, robot.geometry.camera_height_m))


def render(T_world_camera: SE3, client: int, camera: CameraDescription) -> Picture:
    """Render from the optical frame's pose in house coordinates."""
    width, height, (near_m, far_m) = camera.width_px, camera.height_px, camera.clip_m
    rotation, eye = T_world_camera.rotation(), T_world_camera.translation_m
    view = p.computeViewMatrix(eye.tolist(), (eye + rotation[:, 2]).tolist(), (-rotation[:, 1]).tolist())
    projection = p.computeProjectionMatrixFOV(math.degrees(camera.vertical_fov_rad), width / height, near_m, far_m)
    _, _, rgba, buffer, segmentation = p.getCameraImage(
        width,
        height,
        view,
        projection,
        lightDirection=[0.4, 0.3, 1.0],
        shadow=0,
        renderer=p.ER_TINY_RENDERER,
        physicsClientId=client,
    )
    buffer = np.asarray(buffer, dtype=np.float64).reshape(height, width)
    depth_m = far_m * near_m / (far_m - (far_m - near_m) * buffer)
    depth_m[(depth_m < camera.depth_range_m[0]) | (depth_m > camera.depth_range_m[1])] = 0.0
    bodies = np.asarray(segmentation, dtype=np.int64).reshape(height, width)
    bodies = np.where(bodies >= 0, bodies & BODY_MASK, -1)
    return Picture(
        rgb=np.ascontiguousarray(np.asarray(rgba, dtype=np.uint8).reshape(height, width, 4)[:, :, :3]),
        depth_m=depth_m.astype(np.float32),
        bodies=bodies.astype(np.int32),
    )
