"""A driver over rosbridge, in front of a simulated robot: it measures what the robot measures, and drives it."""

from __future__ import annotations

import asyncio
import contextlib
import time

import numpy as np
import pytest

from app.runtime import Runtime
from app.settings import ClockMode, Settings
from app.stacks.robot_registry import RobotMisfit, start_robot
from drivers.rosbridge.errors import RobotNotReached
from drivers.rosbridge.profile import read_profile
from drivers.rosbridge.robot import DriverSettings, RosbridgeRobot
from examples.rosbridge.simulated_robot import Rosbridge
from guide import ROOT, free_ports
from perception.errors import SensorSilent
from simulation.process.client import SimulatedRobot
from skills.errors import BodySilent
from skills.ports import ArmTarget

pytestmark = pytest.mark.anyio
EXAMPLE = ROOT / "examples" / "rosbridge" / "robot.toml"
LIMIT_S = 20.0


@pytest.fixture(scope="module")
def anyio_backend():
    return "asyncio"


@pytest.fixture(scope="module")
async def simulated():
    robot = await SimulatedRobot.start("flat", mode="real")
    yield robot
    await robot.close()


@pytest.fixture
async def bridge(simulated):
    bridge = Rosbridge(simulated)
    async with bridge.serving() as bridge.url:
        yield bridge
    simulated.release_stop()
    await simulated.drive(0.0, 0.0)


@pytest.fixture
async def robot(bridge):
    robot = await RosbridgeRobot.reach(profile_at(bridge.url))
    yield robot
    await robot.close()


def profile_at(url, **changes):
    patient = {"silent_after_s": 4.0}  # this machine may be busy otherwise
    return read_profile(EXAMPLE).model_copy(update={"url": url} | patient | changes)


async def until(condition, limit_s=LIMIT_S):
    """Wait for something that happens outside this process."""
    deadline = time.monotonic() + limit_s
    while not await condition():
        assert time.monotonic() < deadline, "it did not happen"
        await asyncio.sleep(0.02)


async def is_seen(robot):
    with contextlib.suppress(SensorSilent):
        await robot.frame()
        return True
    return False


def speeds(bridge):
    return [message["linear"]["x"] for topic, message in bridge.commands if topic == "/cmd_vel"]


async def test_everything_that_is_measured_comes_out_as_the_robot_measured_it(robot, simulated):
    there, here = await simulated.scan(), await robot.scan()
    heard = np.isfinite(there.ranges_m).any(axis=1)
    assert heard.sum() >= len(heard) - 1, "a ring that sees nothing is left out: here the one above all walls"
    np.testing.assert_allclose(here.elevations_rad, there.elevations_rad[heard], atol=2e-5)
    np.testing.assert_allclose(here.azimuths_rad, there.azimuths_rad, atol=2e-5)
    assert here.T_base_lidar.is_close(there.T_base_lidar)
    ranges_m = there.ranges_m[heard]
    both = np.isfinite(here.ranges_m) & np.isfinite(ranges_m)
    assert both.sum() > 0.99 * np.isfinite(ranges_m).sum()
    assert np.median(np.abs(here.ranges_m[both] - ranges_m[both])) < 0.04, "two scans of a LiDAR of 20 mm noise"
    await until(lambda: is_seen(robot))
    there, here = await simulated.frame(), await robot.frame()
    assert here.intrinsics == there.intrinsics
    assert here.T_base_camera.is_close(there.T_base_camera, tol=1e-3)
    np.testing.assert_array_equal(here.rgb, there.rgb)
    seen = (here.depth_m > 0) & (there.depth_m > 0)
    assert np.median(np.abs(here.depth_m - there.depth_m)[seen]) < 0.05
    there, here = await simulated.state(), await robot.state()
    assert here.arm.lift_m == pytest.approx(there.arm.lift_m, abs=1e-3)
    assert here.gripper_opening_m == pytest.approx(there.gripper_opening_m, abs=1e-3)
    assert here.T_base_gripper.is_close(there.T_base_gripper, tol=2e-3)
    assert (here.pan_rad, here.tilt_rad) == pytest.approx((there.pan_rad, there.tilt_rad), abs=1e-3)
    for measured in (await robot.odometry(), await robot.scan(), await robot.joints(), await robot.frame()):
        assert 0.0 <= robot.now_s - measured.stamp_s < 1.0, "all stamped by one clock, that of the driver"


async def test_it_drives_no_faster_than_the_profile_lets_it_and_stands_when_nobody_goes_on_asking(robot, bridge):
    before = await robot.odometry()
    for _ in range(20):
        await robot.drive(0.0, 9.0)
        await asyncio.sleep(0.05)
    turned = await robot.odometry()
    assert abs(turned.yaw_rad - before.yaw_rad) > 0.05
    told = [message["angular"]["z"] for topic, message in bridge.commands if topic == "/cmd_vel"]
    assert max(told) == pytest.approx(1.2), "the limit of the profile"
    await until(lambda: stands(robot))
    await until(lambda: said_last(bridge, 0.0))
    count = len(bridge.commands)
    await asyncio.sleep(0.7)
    bridge.commands, count = [], len(bridge.commands) - count
    await asyncio.sleep(0.3)
    assert not bridge.commands, "then others may drive it"


async def complains(runtime, of):
    return runtime.views.status.document()["perception"] == of


async def stands(robot):
    return abs((await robot.odometry()).angular_radps) < 0.01


async def said_last(bridge, value):
    return bool(speeds(bridge)) and bridge.commands[-1][1]["angular"]["z"] == value


async def test_a_stop_is_told_at_once_holds_arm_and_base_and_lasts_until_it_is_released(robot, bridge):
    await robot.move_arm(ArmTarget(lift_m=1.2, extension_m=0.0, wrist_pitch_rad=-1.57))
    await robot.drive(0.0, 1.0)
    await asyncio.sleep(0.3)
    bridge.commands.clear()
    robot.stop()
    stopped = time.monotonic()
    await until(lambda: was_told(bridge, "/arm_controller/joint_trajectory"))
    assert time.monotonic() - stopped < 0.5, "at once, as far as a busy machine tells"
    told = [(m["linear"]["x"], m["angular"]["z"]) for topic, m in bridge.commands if topic == "/cmd_vel"]
    stood = told.index((0.0, 0.0))
    assert set(told[stood:]) == {(0.0, 0.0)}
    assert stood <= 2, "no more comes before than what was on its way"
    await robot.drive(0.0, 1.0)
    await robot.move_arm(ArmTarget(lift_m=0.3, extension_m=0.0))
    await until(lambda: arm_rests(robot))
    assert (await robot.state()).stopped
    assert 0.5 < (await robot.state()).arm.lift_m < 1.15, "neither where it was going nor where it is wanted now"
    assert set(speeds(bridge)) == {0.0}
    robot.release_stop()
    await robot.move_arm(ArmTarget(lift_m=0.75, extension_m=0.0, wrist_pitch_rad=-1.57))
    await until(lambda: arm_is_at(robot, 0.75))


async def was_told(bridge, topic):
    return topic in [name for name, _ in bridge.commands]


async def was_told_to_stand(bridge):
    return speeds(bridge)[-1:] == [0.0]


async def arm_rests(robot):
    before_m, before_s = (await robot.state()).arm.lift_m, (await robot.state()).stamp_s
    await asyncio.sleep(0.4)
    state = await robot.state()
    return state.stamp_s > before_s + 0.1 and abs(state.arm.lift_m - before_m) < 0.002


async def arm_is_at(robot, lift_m):
    return abs((await robot.state()).arm.lift_m - lift_m) < 0.01


async def test_fingers_close_by_an_action_with_an_effort_and_are_told_once(robot, bridge):
    for _ in range(5):
        await robot.grip(0.02, 7.0)
    await until(lambda: is_open(robot, 0.02))
    goals = [goal for name, goal in bridge.commands if name == "/gripper_controller/gripper_cmd"]
    assert goals == [{"command": {"position": 0.02, "max_effort": 7.0}}]
    await robot.grip(9.0)
    await until(lambda: is_open(robot, 0.12))


async def is_open(robot, opening_m):
    return abs((await robot.state()).gripper_opening_m - opening_m) < 0.01


async def test_when_the_connection_is_lost_nothing_is_done_and_back_again_the_robot_first_stands(robot, bridge):
    await robot.drive(0.0, 1.0)
    await bridge.hang_up()
    bridge.commands.clear()
    await until(lambda: is_lost(robot))
    with pytest.raises(BodySilent, match="connection"):
        await robot.drive(0.0, 1.0)
    await until(lambda: is_back(robot))
    assert speeds(bridge)[0] == 0.0
    await until(lambda: was_told(bridge, "/arm_controller/joint_trajectory"))
    turning = [message["angular"]["z"] for topic, message in bridge.commands if topic == "/cmd_vel"]
    assert set(turning) == {0.0}, "what was asked before is forgotten"
    bridge.commands.clear()
    await robot.drive(0.0, 1.0)
    await until(lambda: was_told(bridge, "/cmd_vel"))


async def is_lost(robot):
    try:
        await robot.state()
    except BodySilent:
        return True
    return False


async def is_back(robot):
    return not await is_lost(robot)


async def test_a_stop_while_the_connection_is_lost_holds_when_it_is_back(robot, bridge):
    await bridge.hang_up()
    robot.stop()
    await until(lambda: is_back(robot))
    assert (await robot.state()).stopped
    bridge.commands.clear()
    await robot.drive(0.0, 1.0)
    await asyncio.sleep(0.3)
    assert speeds(bridge)
    assert {message["angular"]["z"] for topic, message in bridge.commands if topic == "/cmd_vel"} == {0.0}


async def test_the_robots_clock_may_be_set_under_way(robot, bridge):
    await until(lambda: is_seen(robot))
    before_s = robot.now_s
    bridge.lag_s = 7200.0
    await asyncio.sleep(0.5)
    await until(lambda: is_seen(robot))
    scan = await robot.scan()
    assert before_s < scan.stamp_s <= robot.now_s < before_s + LIMIT_S


async def test_a_sensor_that_falls_silent_is_named_while_the_others_go_on(robot, bridge):
    bridge.silent.add("/lidar/points")
    await until(lambda: is_blind(robot))
    assert (await robot.state()).stamp_s > robot.now_s - 4.0
    bridge.silent.clear()
    await until(lambda: sees(robot))


async def is_blind(robot):
    try:
        await robot.scan()
    except SensorSilent as silence:
        return silence.sensor == "scan"
    return False


async def sees(robot):
    return not await is_blind(robot)


async def test_where_no_robot_is_or_not_all_of_one_that_is_said(bridge):
    [port] = free_ports(1)
    with pytest.raises(RobotNotReached, match=rf"127\.0\.0\.1:{port}: no rosbridge answers there: ConnectionRefused"):
        await RosbridgeRobot.reach(profile_at(f"ws://127.0.0.1:{port}"), settings=DriverSettings(start_limit_s=1.0))
    elsewhere = profile_at(bridge.url, odometry="/wheel_odometry")
    with pytest.raises(RobotNotReached, match="nothing came on /wheel_odometry"):
        await RosbridgeRobot.reach(elsewhere, settings=DriverSettings(start_limit_s=1.5))
    wrong = profile_at(bridge.url, base_frame="base_footprint")
    with pytest.raises(RobotNotReached, match="/odom"):
        await RosbridgeRobot.reach(wrong, settings=DriverSettings(start_limit_s=1.5))


async def test_what_only_a_simulator_has_is_refused_for_a_real_robot():
    settings = Settings(robot="rosbridge:robot.toml")
    for change in ({"clock": ClockMode.LOCKSTEP}, {"simulation_api": True}, {"speed": 2.0}):
        with pytest.raises(RobotMisfit):
            await start_robot(settings.model_copy(update=change))


@pytest.mark.slow
async def test_a_service_drives_the_robot_and_finds_its_room(bridge, tmp_path):
    profile = tmp_path / "robot.toml"
    patient = f'silent_after_s = 4.0  # this machine may be busy otherwise\nurl = "{bridge.url}"'
    profile.write_text(EXAMPLE.read_text().replace('url = "ws://127.0.0.1:9090"', patient))
    settings = Settings(robot=f"rosbridge:{profile}", camera=False, data=tmp_path, port=0)
    runtime = Runtime(settings)
    async with runtime.running(), asyncio.timeout(150.0):
        while runtime.memory.snapshot().current_room is None or max(speeds(bridge), default=0.0) <= 0.05:
            await runtime.wait_for_change()
        status = runtime.views.status.document()
        assert (status["robot"]["localized"], status["simulator"]) == (True, "running"), "something that moves"
        bridge.silent.update({"/odom", "/joint_states", "/lidar/points"})
        await until(lambda: complains(runtime, "silent: joints, odometry, scan"))
        bridge.silent.clear()
        await until(lambda: complains(runtime, None))
        runtime.orders.stop()
        bridge.commands.clear()
        await until(lambda: was_told_to_stand(bridge))  # what was on its way has come before
        bridge.commands.clear()
        await until(lambda: was_told(bridge, "/cmd_vel"))
        assert set(speeds(bridge)) == {0.0}
