"""Where the robot stands to reach something."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, cos, pi, sin

import numpy as np
import pytest

from skills.anchor import Anchor
from skills.arm.approach import ApproachForReach
from skills.arm.arm_way import passing_over, routes_around
from skills.arm.kinematics import gripper_pose
from skills.arm.settings import ReachSettings
from skills.doubles import BoxWorld, FakeBody, Rehearsal
from skills.failures import FailureCode
from skills.geometry import Box2, Pose2
from skills.navigation.pose import bearing_rad

pytestmark = pytest.mark.anyio


REACH = ReachSettings()


async def test_where_something_stands_before_a_thing_the_arm_comes_from_another_side(kitchen, carry_out):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    bottle = rehearsal.memory.snapshot().position("bottle_1", "room_1")
    x_m, y_m = 0.6 * bottle[:2] + 0.4 * np.array(rehearsal.body.pose.point)
    built[0].thing("can_1", (float(x_m), float(y_m), 0.82), (0.07, 0.07, 0.13), on="table_1", graspable=True)
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    base = np.array(rehearsal.body.pose.point)
    context = await rehearsal.prepare()
    assert passing_over(context, bottle, 0.8, base[None, :], {"bottle_1", "table_1"}) == 0.0


@pytest.mark.parametrize("beside", [False, True])
async def test_a_tall_thing_is_taken_level_from_another_side_rather_than_from_above(kitchen, beside, carry_out):
    """Hanging from the hand it is lifted onto nothing high: a bottle could not be put on a cabinet."""
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat.bottle("bottle_2", 0.6, 1.0)) or flat)
    if beside:  # so far off that the arm passes, but not surely the hand
        built[0].thing("box_1", (0.7, 1.0, 0.85), (0.04, 0.2, 0.2), on="table_1", graspable=True)
    rehearsal.body.pose = Pose2(0.6, 0.4, pi / 2)
    assert await carry_out(rehearsal, ("PICK", "bottle_2")) is None
    assert abs(rehearsal.body.arm.wrist_pitch_rad) < 0.1
    assert bool(rehearsal.body.pose.x_m < 0.3) is beside


@pytest.mark.parametrize("crowded", [False, True])
async def test_to_what_only_a_hand_from_above_gets_the_robot_comes_near_enough_for_that(flat, crowded):
    built = flat().table().bottle("bottle_1", 1.0, 1.0)
    for k in range(4 if crowded else 0):
        x_m, y_m = 1.0 + 0.1 * cos(pi / 4 + k * pi / 2), 1.0 + 0.1 * sin(pi / 4 + k * pi / 2)
        built.thing(f"can_{k}", (x_m, y_m, 0.815), (0.05, 0.05, 0.13), on="table_1", graspable=True)
    context = await Rehearsal(memory=built.memory).prepare()
    action = ApproachForReach(context, "bottle_1", Anchor("bottle_1"))
    routes = routes_around(context, (0.0, 0.0), [(1.0, 1.0)])
    away_m = [np.hypot(goal.point[0] - 1.0, goal.point[1] - 1.0) for goal in action._goals_around(routes)]
    assert bool(max(away_m) > 0.95) is not crowded


@pytest.mark.parametrize("high_m", [0.12, 0.24])
async def test_what_the_lift_does_not_bring_over_a_bottle_is_not_taken_across_it(flat, high_m):
    built = flat().thing("counter_1", (1.0, 1.2, 0.43), (1.2, 0.8, 0.86), support=True)
    built.thing("ball_1", (1.0, 1.1, 0.9), (0.08, 0.08, 0.08), on="counter_1", graspable=True)
    built.thing("bottle_1", (1.0, 0.9, 0.86 + high_m / 2), (0.07, 0.07, high_m), on="counter_1", graspable=True)
    rehearsal = Rehearsal(memory=built.memory, body=FakeBody(pose=Pose2(1.0, 0.35, pi / 2)))
    context = await rehearsal.prepare()
    action = ApproachForReach(context, "ball_1", Anchor("ball_1"))
    assert action._reaches_from_here(REACH.barred_cost_m) is (high_m < 0.2)
    goals = action._goals_around(routes_around(context, (1.0, 0.35), [(1.0, 1.1)]))
    sides_rad = [abs(atan2(goal.point[0] - 1.0, 1.1 - goal.point[1])) for goal in goals]
    assert bool(min(sides_rad) < 0.1) is (high_m < 0.2)
    assert min(sides_rad) < pi / 4


async def test_what_the_lift_only_brings_level_to_a_thing_that_others_bar_is_left(flat):
    """A tall bottle on a high counter, with others all around it, was pushed at."""
    built = flat().thing("counter_1", (1.0, 1.2, 0.485), (1.2, 0.8, 0.97), support=True)
    built.thing("bottle_1", (1.0, 1.1, 1.09), (0.07, 0.07, 0.24), on="counter_1", graspable=True)
    for k in range(6):
        x_m, y_m = 1.0 + 0.16 * cos(k * pi / 3), 1.1 + 0.16 * sin(k * pi / 3)
        built.thing(f"can_{k}", (x_m, y_m, 1.035), (0.07, 0.07, 0.13), on="counter_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody(pose=Pose2(1.0, 0.35, pi / 2))).prepare()
    action = ApproachForReach(context, "bottle_1", Anchor("bottle_1"))
    assert action._goals_around(routes_around(context, (1.0, 0.35), [(1.0, 1.1)])) == []


async def test_what_is_too_high_for_a_hand_from_above_is_taken_from_the_side_that_fits_between_the_fingers(
    flat, onlooker, fingers, carry_out
):
    built = flat().thing("counter_1", (1.0, 1.2, 0.5), (0.5, 0.5, 1.0), support=True)
    built.thing("bear_1", (1.0, 1.2, 1.1), (0.14, 0.07, 0.2), on="counter_1", graspable=True)
    body = FakeBody(pose=Pose2(1.0, 0.3, 1.57), grasped_width_m=fingers(built.memory))
    world = BoxWorld(boxes=(Box2(Pose2(1.0, 1.2), 0.5, 0.5),), heights_m=(0.3, 0.6))
    rehearsal = Rehearsal(memory=built.memory, body=body, world=world, observe=onlooker)
    assert await carry_out(rehearsal, ("GOTO", "bear_1"), ("PICK", "bear_1")) is None
    assert abs(rehearsal.body.pose.y_m - 1.2) < 0.3


async def test_from_where_the_arm_was_stopped_it_is_not_reached_again_while_there_is_another_side(
    kitchen, onlooker, carry_out
):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    bottle, sides = np.array((1.0, 0.95)), []

    def stop_the_arm(r):
        onlooker(r)
        side = bearing_rad(context, "bottle_1")
        hand = gripper_pose(r.body.arm, r.body.geometry)
        near = np.hypot(*(r.body.pose.apply(np.array([[hand.x_m, hand.y_m]]))[0] - bottle)) < 0.1
        if near and abs(np.angle(np.exp(1j * (side - (sides or [side])[0])))) < 0.3:
            sides.append(side)
            r.body.arm = replace(r.body.arm, lift_m=max(r.body.arm.lift_m, 1.2))

    rehearsal.observe = stop_the_arm
    assert (await carry_out(rehearsal, ("PICK", "bottle_1"))).code is FailureCode.UNREACHABLE
    assert sides
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
