"""A recording of a robot that stands in a room and films a wall, as long as is asked for."""

from __future__ import annotations

import numpy as np

from evaluations.service.replay import CAMERA_HZ, LIDAR_HZ, CompactFrame, Recording
from perception.geometry.planar import Pose2
from perception.ports import Intrinsics, JointState, Odometry, RgbdFrame
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from unit.perception.lidar_house import House, cast, rectangle

ROOM = House(rooms={"a": rectangle(4.0, 3.0)})
BEGIN_S = 100.0


def recording(seconds: float) -> Recording:
    rng = np.random.default_rng(0)
    stamps_s = BEGIN_S + np.arange(round(seconds * LIDAR_HZ)) / LIDAR_HZ
    frame_stamps_s = BEGIN_S + np.arange(round(seconds * CAMERA_HZ)) / CAMERA_HZ
    return Recording(
        building=WorkingMemory().building(),
        odometry=[
            Odometry(stamp_s=float(stamp_s), x_m=0.0, y_m=0.0, yaw_rad=0.0, linear_mps=0.0, angular_radps=0.0)
            for stamp_s in stamps_s
        ],
        scans=[cast(ROOM, Pose2(1.0, 1.0, 0.0), rng, stamp_s=float(stamp_s)) for stamp_s in stamps_s],
        joints=[joints(float(stamp_s)) for stamp_s in stamps_s],
        frames=[CompactFrame.of(frame(float(stamp_s))) for stamp_s in frame_stamps_s],
    )


def joints(stamp_s: float) -> JointState:
    return JointState(
        stamp_s=stamp_s,
        lift_m=0.6,
        extension_m=0.0,
        wrist_pitch_rad=0.0,
        wrist_roll_rad=0.0,
        gripper_opening_m=0.1,
        pan_rad=0.0,
        tilt_rad=0.0,
        finger_contacts=(False, False),
        T_base_gripper=SE3.identity(),
    )


def frame(stamp_s: float) -> RgbdFrame:
    return RgbdFrame(
        stamp_s=stamp_s,
        rgb=np.full((240, 320, 3), 128, dtype=np.uint8),
        depth_m=np.linspace(0.0, 8.0, 240 * 320, dtype=np.float32).reshape(240, 320),
        intrinsics=Intrinsics(fx=277.0, fy=277.0, cx=159.5, cy=119.5, width=320, height=240),
        T_base_camera=SE3.identity(),
    )
