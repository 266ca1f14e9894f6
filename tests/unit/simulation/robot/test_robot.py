"""The robot's body: limits, dead man, stop, and a grip by friction that holds while driving."""

from __future__ import annotations

import math

import numpy as np
import pybullet as p
import pytest

from simulation.robot.description import RobotDescription
from simulation.robot.robot import RobotBody, T_base_gripper
from simulation.world.physics import PhysicsSettings
from skills.ports import ArmTarget

TABLE_M = 0.75
UPRIGHT_DEG = 2.0
STEP_S, BASE_RADIUS_M = PhysicsSettings().step_s, RobotDescription().base_radius_m


@pytest.fixture
def client():
    client = p.connect(p.DIRECT)
    p.setGravity(0, 0, -9.81, physicsClientId=client)
    p.setPhysicsEngineParameter(fixedTimeStep=STEP_S, numSolverIterations=60, physicsClientId=client)
    half = [0.3, 0.5, TABLE_M / 2]
    p.createMultiBody(0, p.createCollisionShape(p.GEOM_PLANE, physicsClientId=client), physicsClientId=client)
    shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=half, physicsClientId=client)
    p.createMultiBody(0, shape, -1, [0.85, 0, TABLE_M / 2], physicsClientId=client)
    yield client
    p.disconnect(client)


def run(robot, client, seconds, drive=None, *, stopped=False):
    for _ in range(round(seconds / STEP_S)):
        if drive is not None:
            robot.command_drive(*drive)
        robot.advance(STEP_S, stopped=stopped)
        p.stepSimulation(physicsClientId=client)


THINGS = {
    "bottle": ({"shapeType": p.GEOM_CYLINDER, "radius": 0.035, "height": 0.22}, 0.22, 0.3, 0.15),
    "bottle at its neck": ({"shapeType": p.GEOM_CYLINDER, "radius": 0.014, "height": 0.24}, 0.24, 0.3, 0.21),
    "ball": ({"shapeType": p.GEOM_SPHERE, "radius": 0.04}, 0.08, 0.15, 0.04),
    "cube": ({"shapeType": p.GEOM_BOX, "halfExtents": [0.025] * 3}, 0.05, 0.1, 0.025),
    "book": ({"shapeType": p.GEOM_BOX, "halfExtents": [0.1, 0.035, 0.015]}, 0.03, 0.3, 0.022),
}


@pytest.mark.parametrize("name", THINGS)
def test_what_the_fingers_hold_by_friction_stays_while_the_base_drives_and_turns_at_its_limits(client, name):
    shape, height, mass, grip_at = THINGS[name]
    thing = p.createMultiBody(
        mass,
        p.createCollisionShape(**shape, physicsClientId=client),
        -1,
        [0.68, 0, TABLE_M + height / 2 + 0.001],
        physicsClientId=client,
    )
    p.changeDynamics(
        thing, -1, lateralFriction=0.9, spinningFriction=0.004, rollingFriction=0.002, physicsClientId=client
    )
    robot = RobotBody(client, (0.0, 0.0, 0.0))
    lift = TABLE_M + grip_at + robot.geometry.hand_length_m
    down = {"extension_m": 0.58, "wrist_pitch_rad": -math.pi / 2}
    robot.command_arm(ArmTarget(lift_m=lift + 0.25, **down))
    run(robot, client, 4.0)
    robot.command_arm(ArmTarget(lift_m=lift, **down))
    run(robot, client, 2.0)
    robot.command_grip(0.0, 15.0)
    run(robot, client, 1.5)
    left, right = robot.finger_bodies()
    assert left == right == {thing}
    robot.command_arm(ArmTarget(lift_m=lift + 0.2, **down))
    run(robot, client, 1.5)
    robot.command_arm(ArmTarget(lift_m=lift + 0.2, extension_m=0.0, wrist_pitch_rad=-math.pi / 2))
    run(robot, client, 3.0)
    for drive in ((-0.6, 0.0), (-0.6, 1.2), (0.6, -1.2), *[(0.0, 1.2)] * 4, (0.0, 0.0)):
        run(robot, client, 1.0, drive)
    left, right = robot.finger_bodies()
    assert left == right == {thing}
    x, y, yaw = robot.pose
    hand = T_base_gripper(robot.joints(), robot.geometry)
    expected = np.array([x + hand.x_m * math.cos(yaw), y + hand.x_m * math.sin(yaw)])
    position, attitude = p.getBasePositionAndOrientation(thing, physicsClientId=client)
    assert np.linalg.norm(np.array(position[:2]) - expected) < 0.015
    upright = p.getMatrixFromQuaternion(attitude)[8]
    assert name == "ball" or math.degrees(math.acos(min(upright, 1.0))) < UPRIGHT_DEG


def test_speed_and_acceleration_stay_within_the_limits_whatever_is_commanded(client):
    robot = RobotBody(client, (-5.0, 0.0, 0.5))
    speeds = []
    for _ in range(240):
        run(robot, client, STEP_S, (99.0, 99.0))
        speeds.append(robot.velocity)
    linear, angular = np.array(speeds).T
    assert linear.max() <= robot.limits.linear_mps + 1e-3
    assert angular.max() <= robot.limits.angular_radps + 1e-3
    assert np.diff(linear).max() <= robot.limits.linear_mps2 * STEP_S + 1e-3


@pytest.mark.parametrize("wrong", [1e9, -1e9, math.inf, -math.inf, math.nan])
def test_no_command_takes_base_arm_camera_or_fingers_beyond_their_limits(client, wrong):
    robot = RobotBody(client, (-5.0, 0.0, 0.0))
    limits = robot.limits
    robot.command_arm(ArmTarget(lift_m=wrong, extension_m=wrong, wrist_pitch_rad=wrong, wrist_roll_rad=wrong))
    robot.command_look(wrong, wrong)
    robot.command_grip(wrong, wrong)
    for _ in range(60):
        run(robot, client, STEP_S, (wrong, wrong))
        linear, angular = robot.velocity
        assert abs(linear) <= limits.linear_mps + 1e-3
        assert abs(angular) <= limits.angular_radps + 1e-3
    assert all(low <= robot._targets[name] <= high for name, (low, high) in _ranges(limits).items())
    assert limits.gripper_opening_m[0] <= robot._opening_m <= limits.gripper_opening_m[1]


def _ranges(limits):
    return {
        "lift": limits.lift_m,
        "extension": limits.extension_m,
        "wrist_pitch": limits.wrist_pitch_rad,
        "wrist_roll": limits.wrist_roll_rad,
        "pan": limits.pan_rad,
        "tilt": limits.tilt_rad,
    }


def test_a_drive_command_lapses_and_the_base_stops(client):
    robot = RobotBody(client, (-5.0, 0.0, 0.0))
    run(robot, client, 1.5, (0.6, 0.0))
    run(robot, client, robot.limits.command_timeout_s + 1.0)
    assert robot.velocity == pytest.approx((0.0, 0.0), abs=1e-3)


def test_the_stop_stills_base_and_arm_within_a_tenth_of_a_second(client):
    robot = RobotBody(client, (-5.0, 0.0, 0.0))
    robot.command_arm(ArmTarget(lift_m=1.2, extension_m=0.6))
    run(robot, client, 0.8, (0.6, 0.5))
    run(robot, client, 0.1, stopped=True)
    before = (robot.pose, robot.joints())
    assert robot.velocity == pytest.approx((0.0, 0.0), abs=5e-3)
    run(robot, client, 1.0, stopped=True)
    assert robot.pose == pytest.approx(before[0], abs=2e-3)
    assert robot.joints().lift_m == pytest.approx(before[1].lift_m, abs=5e-3)
    assert robot.joints().extension_m == pytest.approx(before[1].extension_m, abs=5e-3)


def test_the_base_does_not_go_through_what_stands_in_its_way(client):
    robot = RobotBody(client, (-0.2, 0.0, 0.0))
    run(robot, client, 3.0, (0.6, 0.0))
    assert robot.pose[0] < 0.55 - 0.25 + 0.02


def test_what_the_robot_comes_close_to_is_not_touched_before_it_is(client):
    along = np.array([math.cos(2.1), math.sin(2.1)])
    left = np.array([-along[1], along[0]])
    shape = p.createCollisionShape(p.GEOM_BOX, halfExtents=[0.8, 0.17, 1.37], physicsClientId=client)
    turn = p.getQuaternionFromEuler([0.0, 0.0, 2.1])
    wall = p.createMultiBody(0, shape, -1, [*(1.4 * along + 0.17 * left), 1.37], turn, physicsClientId=client)
    robot = RobotBody(client, (*(0.01 - BASE_RADIUS_M) * left, 2.1))
    told_m, gap_m = 0.0, 1.0
    while wall not in {body for body, _ in robot.bodies_touched()}:
        if p.getContactPoints(robot.body_id, wall, physicsClientId=client):
            told_m = max(told_m, gap_m)
        run(robot, client, STEP_S, (0.1, 0.0))
        ahead_m, beside_m = 0.6 - np.dot(robot.pose[:2], along), -np.dot(robot.pose[:2], left)
        gap_m = math.hypot(ahead_m, beside_m) - BASE_RADIUS_M
        assert gap_m > -0.01
    assert gap_m < 0.002
    assert told_m > 0.02, "the physics no longer tells of what is merely near"
