"""The simulator's process through its client: same seed same data, death and restart, stop, pace."""

from __future__ import annotations

import json
import math
import os
import signal
import time

import numpy as np
import pytest

from simulation.errors import DisturbError, HouseError, SimulatorDied
from simulation.process.client import SimulatedRobot
from skills.arm.kinematics import arm_target
from skills.ports import ArmTarget

pytestmark = pytest.mark.anyio


@pytest.fixture
def anyio_backend():
    return "asyncio"


@pytest.fixture
async def robot():
    robot = await SimulatedRobot.start("flat", seed=3)
    yield robot
    await robot.close()


async def experience():
    """Everything a robot senses on a short drive."""
    robot = await SimulatedRobot.start("flat", seed=5)
    felt = []
    await robot.look(0.5, -0.4)
    await robot.move_arm(ArmTarget(lift_m=0.9, extension_m=0.2))
    for _ in range(10):
        await robot.drive(0.3, 0.2)
        await robot.advance(0.1)
        frame = await robot.frame()
        felt += [await robot.odometry(), await robot.state(), (await robot.scan()).ranges_m.tobytes()]
        felt += [frame.depth_m.tobytes(), frame.rgb.tobytes(), await robot.truth()]
    await robot.close()
    return felt


async def test_the_same_seed_and_commands_give_the_same_data_bit_for_bit():
    assert await experience() == await experience()


async def test_what_the_robot_drives_into_is_counted_and_named(robot):
    assert (await robot.truth())["touched"] == []
    while not (truth := await robot.truth())["collisions"]:
        assert truth["stamp_s"] < 60.0
        await robot.drive(0.3, 0.0)
        await robot.advance(0.1)
    things = {entry["id"] for entry in truth["objects"]} | {"wall", "door", "user"}
    assert len(truth["touched"]) == truth["collisions"]
    assert set(truth["touched"]) <= things


async def test_a_killed_simulator_is_told_from_a_slow_one_and_can_be_restarted(robot):
    await robot.advance(0.5)
    os.kill(robot.pid, signal.SIGKILL)
    with pytest.raises(SimulatorDied):
        await robot.scan()
    assert not robot.alive
    await robot.restart()
    assert robot.alive
    assert (await robot.odometry()).stamp_s == 0.0


async def test_the_stop_does_not_wait_for_a_request_in_progress():
    robot = await SimulatedRobot.start("flat", seed=0, mode="real")
    await robot.drive(0.3, 0.0)
    robot.stop()
    started = time.monotonic()
    while time.monotonic() - started < 0.3:
        state = await robot.state()
    assert state.stopped
    assert (state.linear_mps, state.angular_radps) == pytest.approx((0.0, 0.0), abs=1e-2)
    await robot.drive(0.3, 0.0)
    robot.release_stop()
    assert not (await robot.state()).stopped
    await robot.close()


async def test_in_real_mode_time_follows_the_wall_clock_or_falls_behind_but_never_runs_ahead():
    robot = await SimulatedRobot.start("flat", seed=0, mode="real")
    before_s, wall_s = (await robot.odometry()).stamp_s, time.monotonic()
    while time.monotonic() - wall_s < 1.0:
        await robot.state()
    passed_s, wall_passed_s = (await robot.odometry()).stamp_s - before_s, time.monotonic() - wall_s
    assert 0.3 * wall_passed_s < passed_s < wall_passed_s + 0.1
    await robot.close()


async def test_a_disturbance_that_cannot_happen_is_refused_and_the_simulator_lives_on(robot):
    with pytest.raises(DisturbError):
        await robot.disturb({"do": "move", "id": "unicorn", "to": {"on": "table_1"}})
    with pytest.raises(DisturbError):
        await robot.disturb({"do": "levitate"})
    await robot.disturb({"do": "close_door", "id": "d1"})
    assert {"id": "d1", "state": "closed"} in (await robot.truth())["doors"]


async def test_a_faulty_house_is_told_before_anything_starts(tmp_path):
    path = tmp_path / "house.json"
    path.write_text("{}")
    with pytest.raises(HouseError):
        await SimulatedRobot.start(str(path))


async def test_depth_and_pose_of_the_camera_agree_with_where_the_furniture_stands(robot):
    await robot.disturb({"do": "move", "id": "robot", "to": {"pose": [1.6, 1.6, 1.5708]}})
    await robot.look(0.0, -0.45)
    await robot.advance(1.0)
    frame = await robot.frame()
    height, width = frame.depth_m.shape
    v, u = np.mgrid[0:height, 0:width]
    k = frame.intrinsics
    camera = np.stack(((u - k.cx) / k.fx * frame.depth_m, (v - k.cy) / k.fy * frame.depth_m, frame.depth_m), -1)
    base = frame.T_base_camera.apply(camera.reshape(-1, 3))
    ahead = base[(np.abs(base[:, 1]) < 0.4) & (base[:, 0] > 1.15) & (base[:, 0] < 1.65)]
    top = ahead[np.abs(ahead[:, 2] - 0.75) < 0.05]
    assert len(top) > 500, "the table's top, 0.75 m high and 1.07 to 1.77 m ahead"
    assert np.median(top[:, 2]) == pytest.approx(0.75, abs=0.01)


@pytest.mark.parametrize(("aside_m", "turned_rad"), [(-0.0112, -0.147), (-0.0135, -0.176)])
async def test_what_was_let_go_does_not_cling_to_a_finger(tmp_path, aside_m, turned_rad):
    """A banana that was taken where it bends was carried away by an open finger."""
    room = {"id": "a", "label": "bathroom", "polygon": [[-2, -2], [2, -2], [2, 2], [-2, 2]]}
    machine = {"id": "washer", "category": "washing_machine", "pose": [0.9, 0.0, 0.0], "size": [0.57, 0.64, 0.91]}
    banana = {"id": "banana", "category": "banana", "size": [0.18, 0.04, 0.04], "on": "washer"}
    banana["offset"] = [-0.2 + aside_m, 0.003 if aside_m > -0.0125 else -0.0033]
    house = {"name": "t", "rooms": [room], "doors": [], "furniture": [machine], "objects": [banana], "people": []}
    path = tmp_path / "house.json"
    path.write_text(json.dumps(house | {"robot": {"pose": [0.0, 0.0, 0.0]}}))
    robot = await SimulatedRobot.start(str(path), seed=0)

    async def reach(x_m, z_m, seconds):
        target = arm_target(x_m, z_m, -math.pi / 2, turned_rad, robot.geometry, robot.limits)
        for _ in range(round(seconds / 0.1)):
            await robot.move_arm(target)
            await robot.advance(0.1)

    try:
        await robot.grip(0.09)
        for x_m, z_m, seconds in ((0.2, 1.05, 4.0), (0.7, 1.05, 4.0), (0.7, 0.935, 2.0)):
            await reach(x_m, z_m, seconds)
        await robot.grip(0.0)
        await robot.advance(1.0)
        for x_m, z_m, seconds in ((0.7, 1.06, 2.0), (0.35, 1.06, 4.0), (0.7, 1.06, 4.0)):
            await reach(x_m, z_m, seconds)
        for k in range(8):
            await reach(0.7, 0.955 - 0.002 * k, 0.5)
        await robot.grip((await robot.state()).gripper_opening_m + 0.06)
        await robot.advance(3.0)
        await reach(0.7, 1.05, 2.0)
        assert (await robot.state()).finger_contacts == (False, False)
    finally:
        await robot.close()
