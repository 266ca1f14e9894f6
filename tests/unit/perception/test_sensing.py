"""Sensor buffer and the agent that fills it."""

from __future__ import annotations

import asyncio
import itertools
import math
import sys
import threading
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.errors import OdometryUnavailable, SensorSilent
from perception.geometry.planar import Pose2
from perception.ports import Intrinsics, JointState, Odometry, RgbdFrame
from perception.sensing import Filming, Sensing, SensorBuffer, scan_points_base
from scene_graph.geometry.se3 import SE3
from unit.perception.exploring_robot import HousePort
from unit.perception.lidar_house import House, cast, rectangle

ROOM = House(rooms={"a": rectangle(4.0, 3.0)})


def sample(stamp_s: float, x_m: float = 0.0, yaw_rad: float = 0.0, linear_mps: float = 0.0) -> Odometry:
    return Odometry(stamp_s=stamp_s, x_m=x_m, y_m=0.0, yaw_rad=yaw_rad, linear_mps=linear_mps, angular_radps=0.0)


def buffer_with(*samples: Odometry) -> SensorBuffer:
    buffer = SensorBuffer(port())
    for one in samples:
        buffer.add_odometry(one)
    return buffer


def port() -> HousePort:
    return HousePort(house=ROOM, pose=Pose2(1.0, 1.0, 0.0), rng=np.random.default_rng(0), sigma_m=0.0)


@given(st.floats(0.0, 1.0))
def test_odometry_between_two_samples_lies_between_them(fraction: float) -> None:
    buffer = buffer_with(sample(1.0, x_m=2.0, yaw_rad=0.2), sample(2.0, x_m=4.0, yaw_rad=0.6))
    pose = buffer.odometry_at(1.0 + fraction)
    assert pose.x_m == pytest.approx(2.0 + 2.0 * fraction)
    assert pose.yaw_rad == pytest.approx(0.2 + 0.4 * fraction)


def test_yaw_is_interpolated_the_short_way_round() -> None:
    buffer = buffer_with(sample(0.0, yaw_rad=math.pi - 0.1), sample(1.0, yaw_rad=-math.pi + 0.1))
    assert abs(buffer.odometry_at(0.5).yaw_rad) == pytest.approx(math.pi)


def test_the_newest_velocity_carries_on_for_half_a_second_only() -> None:
    buffer = buffer_with(sample(0.0), sample(1.0, x_m=1.0, linear_mps=2.0))
    assert buffer.odometry_at(1.25).x_m == pytest.approx(1.5)
    with pytest.raises(OdometryUnavailable, match=r"available: 0\.00 s to 1\.00 s"):
        buffer.odometry_at(1.6)


def test_no_odometry_yet_is_an_error_that_says_so() -> None:
    with pytest.raises(OdometryUnavailable, match="none has arrived yet"):
        buffer_with().odometry_at(0.0)


def test_odometry_near_stays_within_what_is_recorded() -> None:
    buffer = buffer_with(sample(1.0, x_m=1.0), sample(2.0, x_m=2.0))
    assert buffer.odometry_near(-5.0).x_m == pytest.approx(1.0)
    assert buffer.odometry_near(99.0).x_m == pytest.approx(2.0)


def test_points_of_a_scan_lie_on_the_walls_or_the_floor() -> None:
    pose = Pose2(1.3, 0.8, 0.7)
    points = scan_points_base(cast(ROOM, pose, np.random.default_rng(0), sigma_m=0.0))
    placed = pose.apply(points[:, :2])
    from_wall = np.minimum(np.minimum(placed[:, 0], 4.0 - placed[:, 0]), np.minimum(placed[:, 1], 3.0 - placed[:, 1]))
    assert np.minimum(np.abs(from_wall), np.abs(points[:, 2])).max() < 1e-5


class HalfDeaf(HousePort):
    """A robot whose LiDAR and camera can be switched off."""

    deaf = blind = False

    async def scan(self):  # type: ignore[no-untyped-def]
        if self.deaf:
            raise SensorSilent("scan", 0.5)
        return await super().scan()

    async def frame(self) -> RgbdFrame:
        if self.blind:
            raise SensorSilent("frame", 0.5)
        return gray_frame(self.stamp_s)


def gray_frame(stamp_s: float) -> RgbdFrame:
    return RgbdFrame(
        stamp_s=stamp_s,
        rgb=np.full((3, 4, 3), 128, dtype=np.uint8),
        depth_m=np.ones((3, 4), dtype=np.float32),
        intrinsics=Intrinsics(fx=4.0, fy=4.0, cx=1.5, cy=1.0, width=4, height=3),
        T_base_camera=SE3.identity(),
    )


def test_a_silent_sensor_is_marked_until_it_is_back_and_its_last_data_stay() -> None:
    robot = HalfDeaf(house=ROOM, pose=Pose2(1.0, 1.0, 0.0), rng=np.random.default_rng(0))
    buffer = SensorBuffer(robot)
    agent = Sensing(buffer)
    asyncio.run(agent.step(0.0))
    before = buffer.scan
    robot.deaf = True
    asyncio.run(agent.step(0.1))
    asyncio.run(agent.step(0.2))
    assert buffer.silent == {"scan": 0.1}
    assert buffer.scan is before
    robot.deaf = False
    asyncio.run(agent.step(0.3))
    assert buffer.silent == {}
    assert buffer.scan is not before


def test_the_camera_is_left_to_its_own_agent() -> None:
    robot = HalfDeaf(house=ROOM, pose=Pose2(1.0, 1.0, 0.0), rng=np.random.default_rng(0))
    buffer = SensorBuffer(robot)
    asyncio.run(Sensing(buffer).step(0.0))
    assert (buffer.frame, buffer.frames) == (None, 0)
    asyncio.run(Filming(buffer).step(0.0))
    assert buffer.frame is not None
    assert buffer.frames == 1


def test_a_blind_camera_is_marked_and_its_last_frame_stays() -> None:
    robot = HalfDeaf(house=ROOM, pose=Pose2(1.0, 1.0, 0.0), rng=np.random.default_rng(0))
    buffer = SensorBuffer(robot)
    asyncio.run(Filming(buffer).step(0.0))
    before, robot.blind = buffer.frame, True
    asyncio.run(Filming(buffer).step(0.2))
    assert buffer.silent == {"frame": 0.2}
    assert buffer.frame is before


def test_a_measurement_that_comes_twice_counts_once() -> None:
    buffer = buffer_with()
    for stamp_s in (0.0, 0.2, 0.2, 0.4):
        buffer.add_frame(gray_frame(stamp_s))
        buffer.add_scan(cast(ROOM, Pose2(1.0, 1.0, 0.0), np.random.default_rng(0), stamp_s=stamp_s))
    assert (buffer.frames, buffer.scans) == (3, 3)


def test_the_joints_of_a_frame_are_those_measured_nearest_to_it_and_not_the_newest() -> None:
    buffer = SensorBuffer(port())
    assert buffer.joints_at(1.0) is None
    for stamp_s in (0.9, 1.0, 1.1, 1.4):
        buffer.add_joints(
            JointState(
                stamp_s=stamp_s, lift_m=stamp_s, extension_m=0.0, wrist_pitch_rad=0.0, wrist_roll_rad=0.0,
                gripper_opening_m=0.1, pan_rad=0.0, tilt_rad=0.0, finger_contacts=(False, False),
                T_base_gripper=SE3.identity(),
            )
        )  # fmt: skip
    assert [buffer.joints_at(stamp_s).lift_m for stamp_s in (0.0, 1.04, 1.2, 9.0)] == [0.9, 1.0, 1.1, 1.4]
    assert buffer.joints.lift_m == 1.4


def test_the_past_may_be_asked_for_in_another_thread_while_measurements_come_in() -> None:
    buffer, done = buffer_with(sample(0.0)), threading.Event()
    joints = JointState(
        stamp_s=0.0, lift_m=0.5, extension_m=0.0, wrist_pitch_rad=0.0, wrist_roll_rad=0.0, gripper_opening_m=0.0,
        pan_rad=0.0, tilt_rad=0.0, finger_contacts=(False, False), T_base_gripper=SE3.identity(),
    )  # fmt: skip

    def measure() -> None:
        for number in itertools.count(1):
            buffer.add_joints(replace(joints, stamp_s=number / 100.0))
            buffer.add_odometry(sample(number / 100.0, x_m=number / 100.0))
            if done.is_set():
                return

    buffer.add_joints(joints)
    interval_s = sys.getswitchinterval()
    sys.setswitchinterval(1e-6)
    measuring = threading.Thread(target=measure)
    measuring.start()
    try:
        for _ in range(2000):
            stamp_s = buffer.odometry[-1].stamp_s - 0.005
            assert buffer.joints_at(stamp_s) is not None
            assert buffer.odometry_near(stamp_s).x_m <= buffer.odometry[-1].x_m
    finally:
        done.set()
        measuring.join()
        sys.setswitchinterval(interval_s)
