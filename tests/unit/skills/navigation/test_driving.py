"""Driving and turning with a body that moves perfectly."""

from __future__ import annotations

from dataclasses import replace
from math import hypot, pi

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from skills.anchor import Anchor
from skills.doubles import BoxWorld, FakeBody, Rehearsal
from skills.failures import FailureCode
from skills.geometry import Box2, Pose2, wrap_rad
from skills.goto import journeys
from skills.navigation.driving import DriveTo, TurnTo
from skills.navigation.goals import around, at_poses, overlooking
from skills.navigation.pose import ANYWHERE
from skills.navigation.route import find_routes
from skills.obstacles.grid import Canvas

pytestmark = pytest.mark.anyio


PHYSICAL_RADIUS_M = 0.25


def goal_at(context, x, y, yaw=None):
    return DriveTo(context, "room_1", at_poses(context, "room_1", [(x, y, yaw)]))


coordinate = st.tuples(st.floats(-2.5, 2.5), st.floats(-2.0, 2.0))


furniture = st.lists(
    st.builds(
        Box2,
        st.builds(Pose2, st.floats(-2.5, 2.5), st.floats(-2.0, 2.0), st.floats(-pi, pi)),
        st.floats(0.3, 1.2),
        st.floats(0.3, 0.8),
    ),
    max_size=4,
)


@settings(max_examples=15, suppress_health_check=list(HealthCheck))
@given(furniture, coordinate, coordinate, st.floats(-pi, pi))
async def test_reaches_goals_in_furnished_rooms_without_touching(flat, boxes, start, goal, yaw):
    assume(all(box.distance_m(np.array([start]))[0] > 0.4 for box in boxes))
    canvas = Canvas.covering((-3.0, -2.5), (3.0, 2.5))
    canvas.block((np.abs(canvas.centers()) > (2.98, 2.48)).any(axis=1))
    for box in boxes:
        canvas.block_box(box.grown(0.06))
    assume(find_routes(canvas.finish(), start, 0.3).path_to(goal))
    rehearsal = Rehearsal(
        memory=flat().memory, world=BoxWorld(boxes=tuple(boxes)), body=FakeBody(pose=Pose2(*start, 0.0))
    )
    context = await rehearsal.prepare()
    assert await rehearsal.run([goal_at(context, *goal, yaw)]) is None
    assert rehearsal.body.pose.distance_m(goal) < 0.1
    assert abs(wrap_rad(rehearsal.body.pose.yaw_rad - yaw)) < 0.05
    assert rehearsal.least_clearance_m > PHYSICAL_RADIUS_M


async def test_walls_of_the_room_are_respected_without_any_scan(flat):
    rehearsal = Rehearsal(memory=flat().memory)
    context = await rehearsal.prepare()
    failure = await rehearsal.run([goal_at(context, 2.9, 2.0)])
    assert failure.code is FailureCode.WAY_BLOCKED


@pytest.mark.parametrize("way_around", [True, False])
async def test_a_vase_on_the_floor_that_the_scan_looks_over_is_never_driven_into(flat, way_around):
    """Also where what the graph says of furniture leaves no way, and only raw points are believed."""
    graph = flat().thing("shelf_1", (0.0, 0.0, 0.9), (0.4, 5.0, 1.8))
    places = [(-0.5, 0.0)] if way_around else [(-0.5, 0.5 * row) for row in range(-5, 6)]
    for number, (x, y) in enumerate(places):
        graph.thing(f"vase_{number}", (x, y, 0.11), (0.09, 0.09, 0.22), graspable=True)
    least_m = []

    def measure(rehearsal):
        at = rehearsal.body.pose.point
        least_m.append(min(hypot(x - at[0], y - at[1]) for x, y in places) - 0.045)

    rehearsal = Rehearsal(memory=graph.memory, body=FakeBody(pose=Pose2(-2.0, 0.0)), observe=measure)
    context = await rehearsal.prepare()
    failure = await rehearsal.run([goal_at(context, 2.0, 0.0)])
    assert (failure is None) is way_around
    assert min(least_m) > PHYSICAL_RADIUS_M


async def test_in_no_room_it_drives_on_the_scan_alone():
    from scene_graph.memory import WorkingMemory

    world = BoxWorld(boxes=(Box2(Pose2(1.0, 0.0), 0.4, 1.6),))
    rehearsal = Rehearsal(memory=WorkingMemory(), world=world, frame="root")
    context = await rehearsal.prepare()
    action = DriveTo(context, "root", at_poses(context, "root", [(2.0, 0.0, None)]))
    assert await rehearsal.run([action]) is None
    assert rehearsal.body.pose.distance_m((2.0, 0.0)) < 0.1
    assert rehearsal.least_clearance_m > PHYSICAL_RADIUS_M


async def test_a_lost_robot_drives_to_where_it_is_freest_and_forgets_what_it_saw_before(flat):
    graph = flat().table()
    rehearsal = Rehearsal(memory=graph.memory, body=FakeBody(pose=Pose2(-2.0, 0.0)))
    context = await rehearsal.prepare()
    assert await rehearsal.run([goal_at(context, 2.0, 0.0)]) is None
    with graph.memory.edit("test", 0.0) as tx:
        tx.put(replace(tx.snapshot.robot, localized=False))
    sides = (Box2(Pose2(0.8, -0.3), 0.1, 3.6), Box2(Pose2(3.8, -0.3), 0.1, 3.6))
    ends = (Box2(Pose2(2.3, 1.4), 3.1, 0.1), Box2(Pose2(2.3, -2.0), 3.1, 0.1))
    rehearsal.world = BoxWorld(boxes=(*sides, *ends))
    assert await rehearsal.run(journeys.look_from_the_middle(context)) is None
    assert rehearsal.body.pose.distance_m((2.3, -0.3)) < 0.5
    assert rehearsal.least_clearance_m > PHYSICAL_RADIUS_M
    assert context.surroundings.frame == ANYWHERE


async def test_stands_at_a_table_facing_it_with_the_table_within_reach(flat):
    world = BoxWorld(boxes=(Box2(Pose2(1.0, 1.2), 1.2, 0.8),))
    rehearsal = Rehearsal(memory=flat().table().memory, world=world)
    context = await rehearsal.prepare()
    assert await rehearsal.run([DriveTo(context, "table_1", around(context, "table_1", 0.42))]) is None
    assert PHYSICAL_RADIUS_M < rehearsal.least_clearance_m < 0.6
    bearing = rehearsal.body.pose.bearing_rad((1.0, 1.2))
    assert abs(wrap_rad(rehearsal.body.pose.yaw_rad - bearing)) < 0.05


@pytest.mark.parametrize("hemmed_in", [False, True])
async def test_what_cannot_be_come_near_to_is_looked_at_from_farther_away(flat, hemmed_in):
    table = Box2(Pose2(1.0, 1.2), 1.2, 0.8)
    in_front, beside = Box2(Pose2(1.2, 0.3), 3.2, 0.8), Box2(Pose2(-0.1, 1.6), 0.6, 1.8)
    world = BoxWorld(boxes=(table, in_front, beside) if hemmed_in else (table,))
    rehearsal = Rehearsal(memory=flat().table().memory, world=world, body=FakeBody(pose=Pose2(-2.0, -1.5)))
    context = await rehearsal.prepare()
    assert await rehearsal.run([DriveTo(context, "table_1", overlooking(context, "table_1", 0.5))]) is None
    pose = rehearsal.body.pose
    away_m = float(table.distance_m(np.array([pose.point]))[0])
    assert (0.95 < away_m < 1.9) if hemmed_in else away_m < 0.9
    assert abs(wrap_rad(pose.yaw_rad - pose.bearing_rad((1.0, 1.2)))) < 0.1
    assert rehearsal.least_clearance_m > PHYSICAL_RADIUS_M


async def test_something_that_appears_on_the_way_is_driven_around(flat):
    rehearsal = Rehearsal(memory=flat().memory, body=FakeBody(pose=Pose2(-2.0, 0.0)))

    def appear(rehearsal):
        if rehearsal.body.pose.x_m > -1.0:
            rehearsal.world = BoxWorld(boxes=(Box2(Pose2(0.5, 0.0), 0.4, 0.8),))

    rehearsal.observe = appear
    context = await rehearsal.prepare()
    assert await rehearsal.run([goal_at(context, 2.0, 0.0)]) is None
    assert rehearsal.least_clearance_m > PHYSICAL_RADIUS_M


@pytest.mark.parametrize(("gap_m", "passes"), [(0.57, True), (0.50, False)])
async def test_a_gap_hardly_wider_than_the_body_is_passed_where_there_is_no_other(flat, gap_m, passes):
    ends = (Box2(Pose2(0.0, side * (gap_m / 2 + 1.3)), 0.2, 2.6) for side in (1, -1))
    rehearsal = Rehearsal(memory=flat().memory, world=BoxWorld(boxes=(*ends,)), body=FakeBody(pose=Pose2(-2.0, 0.0)))
    context = await rehearsal.prepare()
    failure = await rehearsal.run([goal_at(context, 2.0, 0.0)])
    assert (failure is None) == passes
    assert rehearsal.least_clearance_m > PHYSICAL_RADIUS_M


async def test_a_wall_of_boxes_is_told_as_a_blocked_way(flat):
    world = BoxWorld(boxes=(Box2(Pose2(0.0, 0.0), 0.3, 6.0),))
    rehearsal = Rehearsal(memory=flat().memory, world=world, body=FakeBody(pose=Pose2(-2.0, 0.0)))
    context = await rehearsal.prepare()
    failure = await rehearsal.run([goal_at(context, 2.0, 0.0)])
    assert failure.code is FailureCode.WAY_BLOCKED
    assert rehearsal.least_clearance_m > PHYSICAL_RADIUS_M


async def test_a_person_who_stands_at_the_goal_is_named(flat):
    world = BoxWorld(boxes=(Box2(Pose2(2.0, 0.0), 0.5, 0.5), Box2(Pose2(1.2, 0.0), 0.1, 6.0)))
    rehearsal = Rehearsal(memory=flat().person(1.2, 0.0).memory, world=world, body=FakeBody(pose=Pose2(-1.0, 0.0)))
    context = await rehearsal.prepare()
    failure = await rehearsal.run([goal_at(context, 2.0, 1.5)])
    assert failure.code is FailureCode.PERSON_IN_WAY
    assert "person_1" in failure.evidence.nodes


async def test_path_is_shown_while_driving_and_cleared_after(flat):
    rehearsal = Rehearsal(memory=flat().memory)
    context = await rehearsal.prepare()
    shown = []
    rehearsal.observe = lambda r: shown.append(r.context.path_room)
    await rehearsal.run([goal_at(context, 2.0, 1.0)])
    assert any(path and path[-1] == pytest.approx((2.0, 1.0)) for path in shown)
    assert context.path_room == ()
    assert context.snapshot.robot.status == "driving to room_1"


async def test_same_start_same_path(flat):
    ends = []
    for _ in range(2):
        rehearsal = Rehearsal(memory=flat().table().memory)
        context = await rehearsal.prepare()
        await rehearsal.run([goal_at(context, 1.0, 2.1)])
        ends.append((rehearsal.body.pose, rehearsal.body.stamp_s))
    assert ends[0] == ends[1]


async def test_turns_to_face_a_point_within_a_centimeter_at_arms_length(flat):
    rehearsal = Rehearsal(memory=flat().table().bottle("bottle_1", 0.4, -0.5).memory)
    context = await rehearsal.prepare()
    turn = TurnTo(context, "bottle_1", Anchor("bottle_1"), tolerance_rad=0.012)
    assert await rehearsal.run([turn]) is None
    _, y, _ = Anchor("bottle_1").in_base(await rehearsal.prepare())
    assert abs(y) < 0.01


async def test_a_visit_to_a_door_stops_in_front_facing_it(flat):
    rehearsal = Rehearsal(memory=flat().memory)
    context = await rehearsal.prepare()
    assert await rehearsal.run(journeys.visit(context, "door_1_1_0", 1.0)) is None
    assert rehearsal.body.pose.distance_m((2.0, 0.0)) < 0.1
    assert abs(wrap_rad(rehearsal.body.pose.yaw_rad)) < 0.05


async def test_a_door_that_something_stands_before_is_looked_at_from_aside(flat):
    world = BoxWorld(boxes=(Box2(Pose2(2.2, 0.0), 0.7, 0.3),))
    rehearsal = Rehearsal(memory=flat().memory, world=world)
    context = await rehearsal.prepare()
    assert await rehearsal.run(journeys.visit(context, "door_1_1_0", 1.0)) is None
    pose = rehearsal.body.pose
    assert 0.4 < pose.distance_m((3.0, 0.0)) < 1.3
    assert abs(wrap_rad(pose.yaw_rad - pose.bearing_rad((3.0, 0.0)))) < 0.05
    assert rehearsal.least_clearance_m > 0.25
