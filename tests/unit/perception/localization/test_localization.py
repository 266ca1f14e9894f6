"""Alignment, the sliding window and the energy optimizer."""

from __future__ import annotations

import asyncio
import math
from dataclasses import dataclass, field

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perception.geometry.planar import Pose2, diagonal_covariance, planar_covariance, spatial_covariance, wrap
from perception.geometry.polygon import distance_to_outline, inside
from perception.geometry.walls import Walls
from perception.lidar.corners import corners_of, detect_lines
from perception.lidar.slice import OutlineSlicer
from perception.localization.alignment import align, log_between
from perception.localization.energy_optimizer import EnergyOptimizer
from perception.localization.landmarks import match_corners
from perception.localization.motion_model import odometry_covariance
from perception.sensing import Sensing, SensorBuffer
from scene_graph.edges import EdgeKey, EdgeType, InEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, ROOT_ID, RoomNode, RoomStatus, WallNode
from unit.perception.exploring_robot import HousePort
from unit.perception.lidar_house import Array, Box, House, cast, l_shape, rectangle

ROOM = rectangle(6.0, 4.0, x=-3.0, y=-2.0)
poses = st.builds(Pose2, st.floats(-20, 20), st.floats(-20, 20), st.floats(-3.1, 3.1))
WIDE = diagonal_covariance(0.1, 0.1, 0.05)


@given(poses, poses, poses)
def test_composition_is_associative_and_inverse_undoes(a: Pose2, b: Pose2, c: Pose2) -> None:
    left, right = (a @ b) @ c, a @ (b @ c)
    assert left.distance_m(right) < 1e-9
    assert abs(wrap(left.yaw_rad - right.yaw_rad)) < 1e-9
    assert (a @ a.inverse()).distance_m(Pose2.identity()) < 1e-9


@given(poses, poses)
def test_planar_composition_agrees_with_se3(a: Pose2, b: Pose2) -> None:
    assert (a @ b).to_se3().is_close(a.to_se3() @ b.to_se3(), 1e-9)


@given(poses, st.floats(-1e-4, 1e-4), st.floats(-1e-4, 1e-4), st.floats(-1e-4, 1e-4))
def test_the_adjoint_carries_a_small_motion_from_right_to_left(pose: Pose2, x: float, y: float, yaw: float) -> None:
    left = pose.adjoint() @ np.array([x, y, yaw])
    moved, expected = pose @ Pose2(x, y, yaw), Pose2(*left) @ pose
    assert moved.distance_m(expected) < 1e-6


@given(st.floats(-3.5, 3.5), st.floats(-2.5, 2.5))
def test_inside_an_l_shape_agrees_with_its_two_rectangles(x: float, y: float) -> None:
    point = np.array([x + 2.0, y + 2.0])
    expected = (0 < point[0] < 6 and 0 < point[1] < 2.5) or (0 < point[0] < 3 and 0 < point[1] < 5)
    if distance_to_outline(l_shape(), point) > 1e-6:
        assert inside(l_shape(), point) == expected


@given(
    st.floats(-2.0, 2.0), st.floats(-1.2, 1.2), st.floats(-3.1, 3.1),
    st.floats(-0.1, 0.1), st.floats(-0.1, 0.1), st.floats(-0.04, 0.04),
)  # fmt: skip
@settings(max_examples=25)
def test_alignment_recovers_the_pose_from_a_wrong_guess(
    x: float, y: float, yaw: float, dx: float, dy: float, dyaw: float
) -> None:
    truth = Pose2(x, y, yaw)
    scan = OutlineSlicer().cut(cast(House(rooms={"a": ROOM}), truth, np.random.default_rng(0)))
    found = align(scan.points_base, Walls.of_polygon(ROOM), truth @ Pose2(dx, dy, dyaw), WIDE)
    assert found is not None
    assert found.pose.distance_m(truth) < 0.006
    assert abs(wrap(found.pose.yaw_rad - yaw)) < 0.002
    assert found.conditioned


def test_two_parallel_walls_leave_the_way_along_them_uncertain() -> None:
    corridor = rectangle(60.0, 2.0, x=-30.0, y=-1.0)
    scan = OutlineSlicer().cut(cast(House(rooms={"a": corridor}), Pose2(0.0, 0.2, 0.0), np.random.default_rng(0)))
    found = align(scan.points_base, Walls.of_polygon(corridor), Pose2(0.0, 0.2, 0.0), WIDE)
    assert found is not None
    assert not found.conditioned
    assert found.information[1, 1] > 1e4 * found.information[0, 0]


def test_only_corners_within_the_gate_are_matched() -> None:
    pose = Pose2(0.5, -0.3, 0.4)
    seen = corners_of(
        detect_lines(OutlineSlicer().cut(cast(House(rooms={"a": ROOM}), pose, np.random.default_rng(0))).points_base)
    )
    sharp = diagonal_covariance(0.01, 0.01, 0.003)
    assert [match.index for match in match_corners(ROOM, seen, pose, sharp)] == [0, 1, 2, 3]
    assert match_corners(ROOM, seen, pose @ Pose2(0.3, 0.3, 0.0), sharp) == []


def standing_room(memory: WorkingMemory, polygon: Array, T_room_base: Pose2) -> None:
    """The least graph in which the robot can localize: a permanent room with its walls."""
    with memory.edit("test", 0.0) as tx:
        tx.put(RoomNode(id="room_1", polygon_m=tuple(map(tuple, polygon.tolist())), status=RoomStatus.PERMANENT))
        tx.put(RtEdge(source=ROOT_ID, target="room_1", T_source_target=SE3.identity()))
        for k in range(len(polygon)):
            tx.put(WallNode(id=f"wall_1_{k}", parent_room="room_1", normal=(0.0, 1.0), offset_m=0.0, length_m=1.0))
            tx.put(RtEdge(source="room_1", target=f"wall_1_{k}", T_source_target=SE3.identity()))
        tx.remove(EdgeKey(EdgeType.RT, ROOT_ID, ROBOT_ID))
        covariance = spatial_covariance(diagonal_covariance(0.01, 0.01, 0.005))
        tx.put(RtEdge(source="room_1", target=ROBOT_ID, T_source_target=T_room_base.to_se3(), covariance=covariance))
        tx.put(InEdge(source=ROBOT_ID, target="room_1"))


@dataclass(kw_only=True)
class Drive:
    """A robot that drives circles, and how far its belief is off."""

    memory: WorkingMemory
    port: HousePort
    errors_m: list[float] = field(default_factory=list)
    errors_rad: list[float] = field(default_factory=list)
    stds_m: list[float] = field(default_factory=list)

    def run(self, steps: int, forward_m: float = 0.04, turn_rad: float = 0.05) -> Drive:
        asyncio.run(self._run(steps, forward_m, turn_rad))
        return self

    async def _run(self, steps: int, forward_m: float, turn_rad: float) -> None:
        buffer = SensorBuffer(self.port)
        agents = [Sensing(buffer), EnergyOptimizer(self.memory, buffer)]
        await agents[0].step(self.port.stamp_s)
        for _ in range(steps):
            self.port.stamp_s = round(self.port.stamp_s + 0.1, 3)
            self.port.move(forward_m, turn_rad)
            for agent in agents:
                await agent.step(self.port.stamp_s)
            edge = self.memory.snapshot().parent(ROBOT_ID)
            assert edge is not None
            believed = Pose2.from_se3(edge.T_source_target)
            self.errors_m.append(believed.distance_m(self.port.pose))
            self.errors_rad.append(abs(wrap(believed.yaw_rad - self.port.pose.yaw_rad)))
            self.stds_m.append(math.sqrt(np.trace(planar_covariance(edge.covariance)[:2, :2])))


def drive(polygon: Array, start: Pose2, *, known: bool = True, seed: int = 0, **house: object) -> Drive:
    memory = WorkingMemory()
    if known:
        standing_room(memory, polygon, start)
    truth = House(rooms={"a": polygon}, **house)  # type: ignore[arg-type]
    return Drive(memory=memory, port=HousePort(house=truth, pose=start, rng=np.random.default_rng(seed)))


@pytest.mark.parametrize("seed", range(3))
def test_while_driving_the_pose_stays_within_twenty_millimeters(seed: int) -> None:
    driven = drive(ROOM, Pose2(-0.5, -0.8, 0.0), seed=seed).run(150)
    assert max(driven.errors_m) < 0.02
    assert max(driven.errors_rad) < 0.006


def test_furniture_does_not_disturb_localization() -> None:
    boxes = [Box(center=(2.0, 1.2), size=(1.2, 0.6, 1.9)), Box(center=(-2.0, 1.6), size=(1.5, 0.5, 1.95))]
    assert max(drive(ROOM, Pose2(-0.5, -0.8, 0.0), boxes=boxes).run(120).errors_m) < 0.02


def test_in_a_large_hall_the_pose_stays_within_twenty_millimeters() -> None:
    hall = rectangle(24.0, 18.0, x=-12.0, y=-9.0)
    assert max(drive(hall, Pose2(-4.0, 2.0, 1.0)).run(100).errors_m) < 0.02


def test_a_wrong_start_within_its_covariance_is_corrected() -> None:
    driven = drive(ROOM, Pose2(-0.5, -0.8, 0.0))
    edge = driven.memory.snapshot().parent(ROBOT_ID)
    assert edge is not None
    with driven.memory.edit("test", 0.0) as tx:
        wrong = (Pose2.from_se3(edge.T_source_target) @ Pose2(0.12, -0.1, 0.05)).to_se3()
        covariance = spatial_covariance(diagonal_covariance(0.1, 0.1, 0.05))
        tx.put(RtEdge(source="room_1", target=ROBOT_ID, T_source_target=wrong, covariance=covariance))
    assert driven.run(5).errors_m[-1] < 0.02


def test_without_a_room_the_robot_dead_reckons_and_grows_uncertain() -> None:
    driven = drive(ROOM, Pose2.identity(), known=False).run(60)
    assert driven.memory.snapshot().current_room is None
    assert all(after > before for before, after in zip(driven.stds_m[1:], driven.stds_m[2:], strict=False))
    assert driven.errors_m[-1] < 3.0 * driven.stds_m[-1]


def test_the_reported_covariance_is_neither_boastful_nor_useless() -> None:
    driven = drive(ROOM, Pose2(-0.5, -0.8, 0.0)).run(150)
    settled = slice(20, None)
    assert np.mean(driven.errors_m[settled]) < 2.0 * np.mean(driven.stds_m[settled])
    assert max(driven.stds_m[settled]) < 0.02


def test_odometry_covariance_grows_with_way_and_turn() -> None:
    still, far, round_ = (odometry_covariance(Pose2(x, 0.0, yaw)) for x, yaw in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0)))
    assert far[0, 0] > still[0, 0]
    assert round_[2, 2] > still[2, 2]
    assert np.allclose(log_between(Pose2(1, 2, 0.3), Pose2(1, 2, 0.3)), 0.0)
