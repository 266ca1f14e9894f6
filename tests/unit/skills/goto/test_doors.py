"""Crossing doors in a kinematic world."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scene_graph.edges import ConnectsEdge, InEdge, MatchEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorState, RoomStatus
from skills.doubles import BoxWorld, FakeBody, Rehearsal
from skills.failures import FailureCode
from skills.geometry import Box2, Pose2
from skills.goto import journeys
from skills.goto.doors import CrossDoor
from skills.registry import load_registry

pytestmark = pytest.mark.anyio
SEEN_BEFORE_S = 16.0
"""No time to go in, wait, back out and line up again."""


def wall(width_m=0.8, *more):
    side = (5.0 - width_m) / 2
    jambs = [Box2(Pose2(3.1, sign * (width_m + side) / 2), 0.2, side) for sign in (1, -1)]
    return BoxWorld(boxes=(*jambs, *more), heights_m=(0.3, 0.6, 1.2, 1.5))


class Crossing:
    """Re-parents the robot into room_2 once its axis is beyond the middle of the wall, with a slightly wrong pose."""

    def __init__(self, error=(0.0, 0.0, 0.0)):
        self.error = error
        self.entered = False

    def __call__(self, rehearsal):
        body, memory = rehearsal.body, rehearsal.memory
        if not self.entered and body.pose.x_m > 3.3:
            self.entered = True
            snapshot = memory.snapshot()
            dx, dy, dyaw = self.error
            body.pose = Pose2(body.pose.x_m - 5.2 + dx, body.pose.y_m + dy, body.pose.yaw_rad + dyaw)
            boxes = tuple(
                Box2(Pose2(b.pose.x_m - 5.2 + dx, b.pose.y_m + dy, b.pose.yaw_rad), b.size_x_m, b.size_y_m)
                for b in rehearsal.world.boxes
            )
            rehearsal.world = BoxWorld(boxes=boxes, heights_m=rehearsal.world.heights_m)
            rehearsal.frame = "room_2"
            with memory.edit("long_term_memory", body.stamp_s) as tx:
                tx.remove(snapshot.parent("robot").key)
                tx.remove(InEdge(source="robot", target="room_1").key)
                pose = SE3.from_xyz_yaw(body.pose.x_m, body.pose.y_m, 0.0, body.pose.yaw_rad)
                tx.put(RtEdge(source="room_2", target="robot", T_source_target=pose, stamp_s=body.stamp_s))
                tx.put(InEdge(source="robot", target="room_2"))


@settings(max_examples=15, suppress_health_check=list(HealthCheck))
@given(st.floats(-0.3, 0.3), st.floats(0.35, 1.2), st.floats(-0.6, 0.6))
async def test_passes_a_gap_of_80_cm_from_wherever_it_starts(flat, y, before, yaw):
    body = FakeBody(pose=Pose2(3.0 - before, y, yaw))
    rehearsal = Rehearsal(memory=flat(width_m=0.8).memory, world=wall(0.8), body=body)
    context = await rehearsal.prepare()
    assert await rehearsal.run([CrossDoor(context, "door_1_1_0")]) is None
    assert rehearsal.body.pose.x_m == pytest.approx(3.0 + 0.2 + 0.9, abs=0.1)
    assert rehearsal.least_clearance_m > 0.29


async def test_a_door_with_furniture_right_before_it_is_crossed_from_between_the_two(flat):
    world = wall(0.9, Box2(Pose2(1.95, 0.0), 0.4, 0.6))
    rehearsal = Rehearsal(memory=flat(width_m=0.9).memory, world=world, body=FakeBody(pose=Pose2(1.2, 1.0)))
    context = await rehearsal.prepare()
    assert await rehearsal.run([CrossDoor(context, "door_1_1_0")]) is None
    assert rehearsal.least_clearance_m > 0.25


async def test_a_door_with_something_lying_where_one_lines_up_is_crossed_from_within_its_gap(flat):
    world = wall(0.9, Box2(Pose2(2.29, -0.05), 0.12, 0.12))
    rehearsal = Rehearsal(memory=flat(width_m=0.9).memory, world=world, body=FakeBody(pose=Pose2(1.2, 1.0)))
    context = await rehearsal.prepare()
    assert await rehearsal.run(journeys.cross(context, "door_1_1_0")) is None
    assert rehearsal.body.pose.x_m == pytest.approx(3.0 + 0.2 + 0.9, abs=0.1)
    assert rehearsal.least_clearance_m > 0.25


async def test_what_stands_beside_the_axis_before_the_gap_is_passed_on_the_other_side(flat):
    world = wall(1.1, Box2(Pose2(2.6, 0.30), 0.1, 0.1))
    rehearsal = Rehearsal(memory=flat(width_m=1.1).memory, world=world, body=FakeBody(pose=Pose2(2.5, 0.0)))
    context = await rehearsal.prepare()
    assert await rehearsal.run([CrossDoor(context, "door_1_1_0")]) is None
    assert rehearsal.body.pose.x_m == pytest.approx(3.0 + 0.2 + 0.9, abs=0.1)
    assert rehearsal.least_clearance_m > 0.25


async def test_goes_on_in_the_new_room_when_placed_there_on_the_way(flat):
    crossing = Crossing(error=(0.0, 0.02, 0.01))
    rehearsal = Rehearsal(memory=flat().memory, world=wall(0.9), observe=crossing)
    context = await rehearsal.prepare()
    assert await rehearsal.run(journeys.cross(context, "door_1_1_0")) is None
    assert crossing.entered
    assert rehearsal.body.pose.x_m == pytest.approx(-2.0 + 0.9, abs=0.1)
    assert abs(rehearsal.body.pose.y_m) < 0.06
    assert rehearsal.least_clearance_m > 0.29


async def test_goto_crosses_into_the_other_room_and_is_confirmed(flat):
    built = flat().table("table_2", 0.8, 1.0, room="room_2")
    rehearsal = Rehearsal(memory=built.memory, world=wall(0.9), observe=Crossing())
    context = await rehearsal.prepare()
    goto = load_registry([])["GOTO"]
    assert await rehearsal.run(goto.actions(context, ["table_2"])) is None
    assert goto.confirmed(built.memory.snapshot(), ["table_2"], 0.0) is None


async def test_a_panel_in_the_gap_is_told_as_a_closed_door(flat):
    world = wall(0.9, Box2(Pose2(3.1, 0.0), 0.05, 0.9))
    rehearsal = Rehearsal(memory=flat().memory, world=world, body=FakeBody(pose=Pose2(2.0, 0.0)))
    context = await rehearsal.prepare()
    failure = await rehearsal.run([CrossDoor(context, "door_1_1_0")])
    assert failure.code is FailureCode.DOOR_CLOSED
    assert failure.evidence.nodes == ("door_1_1_0",)
    assert rehearsal.least_clearance_m > 0.25
    assert rehearsal.body.pose.x_m < 2.6


async def test_a_person_in_the_gap_is_named_and_a_box_is_not(flat):
    for person, code in ((True, FailureCode.PERSON_IN_WAY), (False, FailureCode.WAY_BLOCKED)):
        built = flat()
        if person:
            built.person(3.1, 0.0)
        world = wall(0.9, Box2(Pose2(3.1, 0.0), 0.3, 0.4))
        rehearsal = Rehearsal(memory=built.memory, world=world, body=FakeBody(pose=Pose2(2.0, 0.0)))
        failure = await rehearsal.run([CrossDoor(await rehearsal.prepare(), "door_1_1_0")])
        assert failure.code is code
        assert rehearsal.least_clearance_m > 0.25


async def test_a_person_who_fills_the_gap_is_no_closed_door_and_one_before_a_panel_does_not_hide_it(flat):
    for person_x_m, thing, code in (
        (3.1, Box2(Pose2(3.1, 0.0), 0.3, 0.75), FailureCode.PERSON_IN_WAY),
        (2.5, Box2(Pose2(3.1, 0.0), 0.05, 0.9), FailureCode.DOOR_CLOSED),
    ):
        built = flat()
        built.person(person_x_m, 0.0)
        rehearsal = Rehearsal(memory=built.memory, world=wall(0.9, thing), body=FakeBody(pose=Pose2(2.0, 0.0)))
        failure = await rehearsal.run([CrossDoor(await rehearsal.prepare(), "door_1_1_0")])
        assert failure.code is code


def with_second_door(built):
    """Another door between the rooms, 1.7 m beside the first."""
    with built.memory.edit("test", 0.0) as tx:
        for near, wall_id, rooms, x_m in (
            ("door_1_1_1", "wall_1_1", ("room_1", "room_2"), 1.7),
            ("door_2_3_1", "wall_2_3", ("room_2", "room_1"), -1.7),
        ):
            tx.put(replace(built.memory.snapshot().door("door_1_1_0"), id=near, rooms=rooms))
            tx.put(RtEdge(source=wall_id, target=near, T_source_target=SE3.from_xyz_yaw(x_m, 0.0, 0.0, 0.0)))
            tx.put(*(ConnectsEdge(source=near, target=room) for room in rooms))
        tx.put(MatchEdge(source="door_1_1_1", target="door_2_3_1"))
    return built


async def test_after_a_blocked_door_another_one_is_taken_for_a_while(flat):
    built = with_second_door(flat())
    world = wall(0.9, Box2(Pose2(3.1, 0.0), 0.3, 0.4))
    rehearsal = Rehearsal(memory=built.memory, world=world, body=FakeBody(pose=Pose2(2.0, 0.0)))
    context = await rehearsal.prepare()

    def doors():
        return [action.door_id for action in journeys.travel(context, "room_2") if isinstance(action, CrossDoor)]

    assert doors() == ["door_1_1_0"]
    context.blocked_doors["door_1_1_0"] = context.stamp_s
    assert doors() == ["door_1_1_1"]
    context.stamp_s += context.settings.blocked_s
    assert doors() == ["door_1_1_0"]
    del context.blocked_doors["door_1_1_0"]
    assert (await rehearsal.run(journeys.travel(context, "room_2"))).code is FailureCode.WAY_BLOCKED
    assert [*context.blocked_doors] == ["door_1_1_0"]
    assert doors() == ["door_1_1_1"]


async def test_a_blocked_door_is_tried_again_where_there_is_no_other(flat):
    rehearsal = Rehearsal(memory=flat().memory, world=wall())
    context = await rehearsal.prepare()
    context.blocked_doors["door_1_1_0"] = context.stamp_s
    assert [a.door_id for a in journeys.travel(context, "room_2") if isinstance(a, CrossDoor)] == ["door_1_1_0"]


@pytest.mark.parametrize(("x", "room"), [(2.62, "room_1"), (-1.65, "room_2")])
async def test_what_is_known_to_lie_before_or_behind_a_door_is_passed_though_no_scan_shows_it_any_more(flat, x, room):
    built = flat(width_m=1.2).thing("clock_1", (x, 0.2, 0.06), (0.12, 0.06, 0.12), room=room, graspable=True)
    rehearsal = Rehearsal(memory=built.memory, world=wall(1.2), body=FakeBody(pose=Pose2(1.9, 0.0)))
    context = await rehearsal.prepare()
    clock = Box2(Pose2(x if room == "room_1" else x + 5.2, 0.2), 0.12, 0.06)
    nearest_m = []
    rehearsal.observe = lambda r: nearest_m.append(clock.distance_m(np.array([r.body.pose.point]))[0])
    assert await rehearsal.run([CrossDoor(context, "door_1_1_0")]) is None
    assert min(nearest_m) > 0.26
    assert rehearsal.least_clearance_m > 0.25


@pytest.mark.parametrize("side", [1, -1])
async def test_what_lies_at_one_side_of_a_wide_door_is_passed_on_the_other(flat, side):
    thing = Box2(Pose2(3.45, side * 0.27), 0.1, 0.15)
    body = FakeBody(pose=Pose2(2.0, 0.0))
    rehearsal = Rehearsal(memory=flat(width_m=1.2).memory, world=wall(1.2, thing), body=body)
    context = await rehearsal.prepare()
    assert await rehearsal.run([CrossDoor(context, "door_1_1_0")]) is None
    assert rehearsal.body.pose.x_m > 3.9
    assert rehearsal.body.pose.y_m * side < -0.1
    assert rehearsal.least_clearance_m > 0.25
    assert rehearsal.body.stamp_s < SEEN_BEFORE_S


async def test_someone_who_steps_aside_delays_only(flat):
    rehearsal = Rehearsal(memory=flat().memory, body=FakeBody(pose=Pose2(2.0, 0.0)))

    def walk(rehearsal):
        blocked = rehearsal.body.stamp_s < 6.0
        rehearsal.world = wall(0.9, *([Box2(Pose2(3.1, 0.0), 0.3, 0.4)] if blocked else []))

    rehearsal.world = BoxWorld(heights_m=(1.2, 1.5))
    rehearsal.observe = walk
    context = await rehearsal.prepare()
    assert await rehearsal.run([CrossDoor(context, "door_1_1_0")]) is None
    assert rehearsal.body.stamp_s > 6.0


async def test_a_closed_way_fails_at_once_with_the_door(flat):
    built = flat(door_state=DoorState.CLOSED).table("table_2", 0.8, 1.0, room="room_2")
    rehearsal = Rehearsal(memory=built.memory)
    context = await rehearsal.prepare()
    actions = load_registry([])["GOTO"].actions(context, ["table_2"])
    failure = await rehearsal.run(actions[1:])
    assert failure.code is FailureCode.DOOR_CLOSED
    assert "door_1_1_0" in failure.message
    assert rehearsal.body.pose == Pose2(0.0, 0.0)


async def test_a_door_is_crossed_from_its_far_side_by_the_far_rooms_node(flat):
    built = flat()
    snapshot = built.memory.snapshot()
    with built.memory.edit("test", 0.0) as tx:
        tx.remove(snapshot.parent("robot").key)
        tx.remove(InEdge(source="robot", target="room_1").key)
        tx.put(RtEdge(source="room_2", target="robot", T_source_target=SE3.identity()))
        tx.put(InEdge(source="robot", target="room_2"))
    rehearsal = Rehearsal(memory=built.memory, frame="room_2", body=FakeBody(pose=Pose2(-1.0, 0.0, pi)))
    context = await rehearsal.prepare()
    assert await rehearsal.run(journeys.cross(context, "door_2_3_0")) is None
    assert rehearsal.body.pose.x_m == pytest.approx(-2.0 - 0.2 - 0.9, abs=0.1)


async def test_out_of_a_room_not_measured_yet_the_way_leads_back_through_the_door(flat):
    built = flat().table("table_1", 1.0, 2.1)
    with built.memory.edit("test", 0.0) as tx:
        tx.put(replace(built.memory.snapshot().room("room_2"), status=RoomStatus.TEMPORARY, polygon_m=()))
    body = FakeBody(pose=Pose2(4.4, 0.3))
    rehearsal = Rehearsal(memory=built.memory, world=wall(0.9, Box2(Pose2(1.0, 2.1), 1.2, 0.8)), body=body)
    context = await rehearsal.prepare()
    goto = load_registry([])["GOTO"]
    assert await rehearsal.run(goto.actions(context, ["table_1"])) is None
    assert goto.confirmed(built.memory.snapshot(), ["table_1"], 0.0) is None
    assert abs(body.pose.x_m) < 3.0
    assert abs(body.pose.y_m) < 2.5
    assert rehearsal.least_clearance_m > 0.25
