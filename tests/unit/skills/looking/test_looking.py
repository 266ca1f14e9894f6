"""Looking with a body that moves perfectly."""

from __future__ import annotations

from dataclasses import replace
from math import atan2, hypot, pi

import numpy as np
import pytest

from scene_graph.edits import PutNode
from scene_graph.nodes import ObjectState
from skills.anchor import Anchor
from skills.doubles import BoxWorld, FakeBody, Rehearsal
from skills.geometry import Box2, Pose2, wrap_rad
from skills.goto import journeys
from skills.looking.accounting import Account, AccountFor, SeeFromElsewhere
from skills.looking.looking import LookAt, SweepCamera
from skills.navigation.driving import DriveTo
from skills.navigation.goals import overlooking
from skills.obstacles.sight import hidden_share

pytestmark = pytest.mark.anyio


async def rows_of_a_sweep(flat):
    """Tilts, lowest first, at which a sweep holds the camera still."""
    rehearsal = Rehearsal(memory=flat().memory)
    context = await rehearsal.prepare()
    held = {}

    def watch(rehearsal):
        if rehearsal.body.camera == rehearsal.body._camera:
            tilt = round(rehearsal.body.camera[1], 2)
            held[tilt] = held.get(tilt, 0.0) + rehearsal.dt_s

    rehearsal.observe = watch
    assert await rehearsal.run([SweepCamera(context)]) is None
    return sorted(tilt for tilt, seconds in held.items() if seconds > 2.0)


HALF_HEIGHT_RAD = np.arctan(np.tan(np.deg2rad(30)) * 0.75)


@pytest.mark.parametrize(("x", "y"), [(1.0, 0.5), (-1.0, 0.05), (0.8, -1.0)])
async def test_camera_looks_at_a_point_also_behind(flat, x, y):
    rehearsal = Rehearsal(memory=flat().thing("cup_1", (x, y, 0.8), (0.08, 0.08, 0.1)).memory)
    context = await rehearsal.prepare()
    assert await rehearsal.run([LookAt(context, "cup_1", Anchor("cup_1"))]) is None
    px, py, pz = Anchor("cup_1").in_base(await rehearsal.prepare())
    pan, tilt = rehearsal.body.camera
    assert abs(wrap_rad(pan - atan2(py, px - 0.05))) < 0.05
    assert tilt == pytest.approx(atan2(pz - 1.4, hypot(px - 0.05, py)), abs=0.05)


async def test_a_sweep_stands_still_in_overlapping_views_all_around(flat):
    rehearsal = Rehearsal(memory=flat().memory)
    context = await rehearsal.prepare()
    still: dict[float, int] = {}

    def watch(rehearsal):
        camera = rehearsal.body.camera
        if abs(camera[0] - rehearsal.body._camera[0]) < 1e-9:
            still[round(camera[0], 2)] = still.get(round(camera[0], 2), 0) + 1

    rehearsal.observe = watch
    assert await rehearsal.run([SweepCamera(context)]) is None
    pans = sorted(pan for pan, ticks in still.items() if ticks * rehearsal.dt_s >= 0.4)
    assert len(pans) >= 8
    steps = np.diff([*pans, pans[0] + 2 * pi])
    assert steps.max() < np.deg2rad(60)


async def test_a_sweep_sees_from_before_the_robots_feet_to_higher_than_the_camera(flat):
    rows = await rows_of_a_sweep(flat)
    assert rows[-1] + HALF_HEIGHT_RAD > atan2(2.1 - 1.4, 1.6), "the top of a wardrobe, 1.6 m away"
    assert rows[0] - HALF_HEIGHT_RAD < -atan2(1.4, 0.5), "what lies on the floor half a meter away"
    assert np.diff(rows).max() < 2 * HALF_HEIGHT_RAD, "without a gap between the rows"


async def test_a_looking_journey_ends_in_the_room_center_having_looked_around(flat):
    rehearsal = Rehearsal(memory=flat().memory, body=FakeBody(pose=Pose2(1.5, 1.5)))
    context = await rehearsal.prepare()
    assert await rehearsal.run(journeys.look(context, "room_1")) is None
    assert rehearsal.body.pose.distance_m((0.0, 0.0)) < 0.1


async def test_what_should_be_on_a_table_and_is_not_seen_is_looked_at_until_that_is_certain(flat, onlooker):
    built = flat().table().bottle().thing("cup_1", (1.3, 1.4, 0.8), (0.08, 0.08, 0.1), on="table_1")
    rehearsal = Rehearsal(memory=built.memory, observe=onlooker, body=FakeBody(stamp_s=20.0))
    onlooker.blind_to = {"cup_1"}
    context = await rehearsal.prepare()
    aimed_s = 0.0

    def watch(rehearsal):
        nonlocal aimed_s
        onlooker(rehearsal)
        x_m, y_m, _ = Anchor("cup_1").in_base(context)
        aimed_s += rehearsal.dt_s * (abs(wrap_rad(rehearsal.body.camera[0] - atan2(y_m, x_m - 0.05))) < 0.03)
        if aimed_s > 1.5:
            cup = rehearsal.memory.snapshot().object("cup_1")
            rehearsal.memory.commit(
                [PutNode(replace(cup, state=ObjectState.MISSING))], agent="objects", stamp_s=rehearsal.body.stamp_s
            )

    rehearsal.observe = watch
    began_s = rehearsal.body.stamp_s
    assert await rehearsal.run([AccountFor(Account(context, "table_1", since_s=0.5))]) is None
    assert aimed_s > 1.5
    assert rehearsal.body.stamp_s - began_s < 6.0


async def test_a_thing_that_nobody_can_tell_about_is_not_looked_at_forever(flat, onlooker):
    rehearsal = Rehearsal(memory=flat().table().bottle().memory, observe=onlooker, body=FakeBody(stamp_s=20.0))
    onlooker.blind_to = {"bottle_1"}
    context = await rehearsal.prepare()
    began_s = rehearsal.body.stamp_s
    assert await rehearsal.run([AccountFor(Account(context, "table_1", since_s=0.5), patience_s=2.0)]) is None
    assert 2.0 < rehearsal.body.stamp_s - began_s < 6.0


@pytest.mark.parametrize("hides", [False, True])
async def test_what_hides_from_one_side_is_looked_for_from_another(flat, onlooker, hides):
    body = FakeBody(pose=Pose2(1.0, 0.2, pi / 2), stamp_s=20.0)
    rehearsal = Rehearsal(memory=flat().table().bottle().memory, observe=onlooker, body=body)
    onlooker.blind_to = {"bottle_1"} if hides else set()
    context = await rehearsal.prepare()
    account = Account(context, "table_1", since_s=0.5)
    assert await rehearsal.run([AccountFor(account, patience_s=1.0), SeeFromElsewhere(account, 0.5)]) is None
    moved_rad = Pose2(1.0, 1.2).bearing_rad(rehearsal.body.pose.point) - Pose2(1.0, 1.2).bearing_rad((1.0, 0.2))
    assert (abs(wrap_rad(moved_rad)) > 1.0) == hides
    assert account.unseen() == (["bottle_1"] if hides else [])


async def test_a_place_is_looked_at_for_as_long_as_doubt_grows(flat, onlooker):
    rehearsal = Rehearsal(memory=flat().table().bottle().memory, body=FakeBody(stamp_s=20.0))
    context = await rehearsal.prepare()

    def doubt(rehearsal):
        bottle = rehearsal.memory.snapshot().object("bottle_1")
        existence = max(bottle.existence - 0.1 * rehearsal.dt_s, 0.2)
        rehearsal.memory.commit(
            [PutNode(replace(bottle, existence=existence))], agent="objects", stamp_s=rehearsal.body.stamp_s
        )

    rehearsal.observe = doubt
    began_s = rehearsal.body.stamp_s
    assert await rehearsal.run([AccountFor(Account(context, "table_1", since_s=0.5), patience_s=2.0)]) is None
    assert 8.0 < rehearsal.body.stamp_s - began_s < 14.0
    assert rehearsal.memory.snapshot().object("bottle_1").existence == pytest.approx(0.2)


async def test_a_place_is_chosen_from_which_nothing_tall_hides_what_is_looked_at(flat):
    wardrobe = Box2(Pose2(1.0, 0.45), 1.0, 0.3)
    built = flat().table().thing("wardrobe_1", (1.0, 0.45, 0.9), (1.0, 0.3, 1.8))
    rehearsal = Rehearsal(
        memory=built.memory,
        world=BoxWorld(boxes=(Box2(Pose2(1.0, 1.2), 1.2, 0.8), wardrobe)),
        body=FakeBody(pose=Pose2(1.0, -1.0)),
    )
    context = await rehearsal.prepare()
    assert await rehearsal.run([DriveTo(context, "table_1", overlooking(context, "table_1", 0.5))]) is None
    x_m, y_m = rehearsal.body.pose.point
    line = np.linspace((x_m, y_m), (1.0, 1.2), 50)
    assert not wardrobe.contains(line).any()
    assert abs(x_m - 1.0) > 0.5 or y_m > 1.6


def test_what_hides_what_follows_from_heights_and_from_the_corners_of_a_room(flat):
    snapshot = flat().table().thing("box_1", (-1.0, 0.0, 0.4), (0.3, 0.3, 0.8)).memory.snapshot()
    seen_over, right_behind = np.array([[-1.8, 0.0, 0.7]]), np.array([[-1.2, 0.0, 0.1]])
    places = np.array([[0.2, 0.0], [-1.8, -1.2]])
    shares = [
        hidden_share(snapshot, "room_1", places, targets, camera_height_m=1.3).tolist()
        for targets in (seen_over, right_behind)
    ]
    assert shares == [[0.0, 0.0], [1.0, 0.0]]
    assert hidden_share(snapshot, "room_1", places, right_behind, camera_height_m=1.3, spared={"box_1"})[0] == 0.0
    outside = np.array([[-4.5, 0.0]])
    assert hidden_share(snapshot, "room_1", outside, seen_over, camera_height_m=1.3)[0] == 1.0
