"""PICK with a body that moves perfectly and perception that is played."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import pi

import numpy as np
import pytest

from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState
from skills.arm.finger_room import fingers_met
from skills.arm.settings import ApproachSettings
from skills.doubles import BoxWorld, FakeBody, Rehearsal
from skills.facts import read_state
from skills.failures import FailureCode
from skills.geometry import Box2, Pose2
from skills.navigation.pose import bearing_rad
from skills.registry import load_registry

pytestmark = pytest.mark.anyio


SKILLS = load_registry([])


async def test_a_bottle_is_fetched_from_one_table_to_the_other(kitchen, carry_out):
    rehearsal = kitchen()
    steps = (("GOTO", "bottle_1"), ("PICK", "bottle_1"), ("GOTO", "table_2"), ("PLACE", "bottle_1", "table_2"))
    assert await carry_out(rehearsal, *steps) is None
    snapshot = rehearsal.memory.snapshot()
    assert snapshot.support_of("bottle_1") == "table_2"
    assert snapshot.robot.holding is None
    assert rehearsal.body.arm.extension_m == pytest.approx(0.0, abs=0.01)
    assert rehearsal.least_clearance_m > 0.28


async def test_the_state_read_after_goto_allows_pick(kitchen, carry_out):
    rehearsal = kitchen()
    rehearsal.body.pose = Pose2(-1.0, 1.0)
    assert await carry_out(rehearsal, ("GOTO", "bottle_1")) is None
    state = read_state(rehearsal.memory.snapshot())
    assert SKILLS["PICK"].conditions(state, ("bottle_1",)) == []
    assert await carry_out(rehearsal, ("GOTO", "table_2")) is None
    state = read_state(rehearsal.memory.snapshot())
    assert SKILLS["PICK"].conditions(state, ("bottle_1",)) != []
    assert state.is_at("table_2")


async def test_an_object_that_perception_misses_is_gone(kitchen, onlooker, carry_out):
    rehearsal = kitchen()

    def vanish(r):
        onlooker(r)
        node = r.memory.snapshot().object("bottle_1")
        if r.body.stamp_s > 1.0 and node.state is ObjectState.PRESENT:
            with r.memory.edit("objects", r.body.stamp_s) as tx:
                tx.put(replace(node, state=ObjectState.MISSING))

    rehearsal.observe = vanish
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.OBJECT_GONE


async def test_an_object_that_is_not_seen_again_is_gone_and_looked_at_from_another_side_next_time(
    kitchen, onlooker, carry_out
):
    onlooker.blind_to.add("bottle_1")
    rehearsal = kitchen()
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.OBJECT_GONE
    assert "not seen for 8 s" in failure.message
    context = await rehearsal.prepare()
    first_rad = bearing_rad(context, "bottle_1")
    onlooker.blind_to.clear()
    assert await rehearsal.run(SKILLS["PICK"].actions(context, ["bottle_1"])[:5], 900.0) is None
    assert abs(np.angle(np.exp(1j * (bearing_rad(context, "bottle_1") - first_rad)))) > ApproachSettings().stopped_rad


@pytest.mark.parametrize(("place", "code"), [((1.1, 1.05), None), ((-1.5, -1.3), FailureCode.OBJECT_MOVED)])
async def test_a_moved_object_is_followed_within_reach_and_told_beyond(kitchen, onlooker, place, code):
    rehearsal = kitchen()
    rehearsal.body.pose = Pose2(-0.5, 0.3)
    rehearsal.memory.snapshot()
    context = await rehearsal.prepare()
    actions = SKILLS["PICK"].actions(context, ["bottle_1"])
    assert await rehearsal.run(actions[:3]) is None
    with rehearsal.memory.edit("objects", 0.0) as tx:
        tx.put(RtEdge(source="room_1", target="bottle_1", T_source_target=SE3.from_xyz_yaw(*place, 0.87, 0.0)))
    failure = await rehearsal.run(actions[3:], 900.0)
    assert (failure.code if failure else None) is code


async def test_an_object_out_of_reach_in_the_middle_of_a_wide_table_is_told(flat, onlooker, fingers, carry_out):
    built = flat().thing("table_1", (0.0, 1.2, 0.375), (3.0, 2.2, 0.75), support=True).bottle("bottle_1", 0.0, 1.2)
    world = BoxWorld(boxes=(Box2(Pose2(0.0, 1.2), 3.0, 2.2),), heights_m=(0.3, 0.6))
    body = FakeBody(pose=Pose2(0.0, -1.0), grasped_width_m=fingers(built.memory))
    rehearsal = Rehearsal(memory=built.memory, body=body, world=world, observe=onlooker)
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.UNREACHABLE
    assert "places tried" in failure.evidence.observation


async def test_an_object_not_in_the_arms_plane_is_not_reached_for(kitchen):
    rehearsal = kitchen()
    rehearsal.body.pose = Pose2(0.9, 0.35, 1.2)
    context = await rehearsal.prepare()
    reach = SKILLS["PICK"].actions(context, ["bottle_1"])[5]
    failure = await rehearsal.run([reach])
    assert failure.code is FailureCode.UNREACHABLE
    assert "beside the arm's plane" in failure.message


async def test_with_something_in_the_hand_the_base_speeds_up_slowly(kitchen, carry_out):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    speeds = []
    onlooker = rehearsal.observe

    def measure(r):
        onlooker(r)
        speeds.append(r.body.velocity[0])

    rehearsal.observe = measure
    assert await carry_out(rehearsal, ("GOTO", "table_2")) is None
    gains = [b - a for a, b in pairwise(speeds)]
    assert max(gains) / rehearsal.dt_s < 0.5
    assert max(speeds) <= 0.6 * rehearsal.body.limits.linear_mps + 1e-9


@pytest.mark.parametrize(("gap_m", "code"), [(0.165, FailureCode.UNREACHABLE), (0.24, None)])
async def test_between_boxes_on_a_board_that_leave_no_room_for_the_hand_it_does_not_even_begin(
    flat, onlooker, fingers, gap_m, code, carry_out
):
    built = flat().thing("shelf_1", (1.0, 2.3, 0.8), (0.9, 0.35, 1.6), support=True, surfaces_m=(0.4, 0.8, 1.2))
    built.thing("glass_1", (1.0, 2.35, 0.87), (0.07, 0.07, 0.14), on="shelf_1", graspable=True)
    for name, side in (("box_1", -1), ("box_2", 1)):
        x_m = 1.0 + side * (gap_m / 2 + 0.05)
        built.thing(name, (x_m, 2.25, 0.85), (0.1, 0.08, 0.1), on="shelf_1", graspable=True)
    body = FakeBody(pose=Pose2(1.0, 1.0, 1.5), grasped_width_m=fingers(built.memory))
    rehearsal, farthest_m = Rehearsal(memory=built.memory, body=body, observe=onlooker), []

    def measure(r):
        onlooker(r)
        farthest_m.append(r.body.arm.extension_m)

    rehearsal.observe = measure
    failure = await carry_out(rehearsal, ("PICK", "glass_1"))
    assert (failure.code if failure else None) is code
    assert (max(farthest_m) > 0.1) is (code is None)


@pytest.mark.parametrize(
    ("beside", "along", "across"),
    [((0.0, 0.09), 0, 1), ((0.09, 0.0), 1, 0), ((0.0, 0.2), 0, 0)],
)
async def test_a_finger_does_not_come_down_on_a_neighbor(flat, beside, along, across):
    built = flat().thing("table_1", (0.9, 0.0, 0.375), (1.2, 0.8, 0.75), support=True)
    built.thing("can_1", (0.6, 0.0, 0.81), (0.066, 0.066, 0.12), on="table_1", graspable=True)
    built.thing("cup_1", (0.6 + beside[0], beside[1], 0.8), (0.06, 0.06, 0.1), on="table_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody()).prepare()
    met = fingers_met(context, "can_1")
    assert (met(0.0, 0.06), met(pi / 2, 0.06)) == (along, across)


async def test_who_stands_at_a_thing_is_the_reason_why_nothing_gets_there(kitchen, carry_out):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    bottle = rehearsal.memory.snapshot().position("bottle_1", "room_1")
    built[0].person(bottle[0] + 0.2, bottle[1])
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.PERSON_IN_WAY
    assert failure.evidence.nodes[0] == "person_1"


@pytest.mark.parametrize(("ago_s", "waits"), [(0.0, True), (10.0, True), (30.0, False)])
async def test_somebody_who_steps_before_the_arm_is_not_touched_and_the_arm_waits(kitchen, ago_s, waits):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    context = await rehearsal.prepare()
    actions = SKILLS["PICK"].actions(context, ["bottle_1"])
    assert await rehearsal.run(actions[:5], 900.0) is None
    base, bottle = rehearsal.body.pose.point, rehearsal.memory.snapshot().position("bottle_1", "room_1")
    between = 0.3 * np.array(base) + 0.7 * bottle[:2]
    built[0].person(*(float(each) for each in between), stamp_s=context.stamp_s - ago_s)
    failure = await rehearsal.run(actions[5:], 900.0)
    if waits:
        assert failure.code is FailureCode.PERSON_IN_WAY
        assert rehearsal.body.arm.extension_m < 0.05
    else:
        assert failure is None
