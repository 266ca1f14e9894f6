"""PLACE with a body that moves perfectly and perception that is played."""

from __future__ import annotations

from dataclasses import replace
from math import cos, pi, sin

import pytest

from scene_graph.nodes import RoomStatus
from skills.doubles import FakeBody, Rehearsal
from skills.failures import FailureCode
from skills.geometry import Pose2
from skills.place.place_search import ranked_spots
from skills.place.put_down import LowerToPlace
from skills.registry import load_registry

pytestmark = pytest.mark.anyio


SKILLS = load_registry([])


@pytest.mark.parametrize("target", ["room_1", "person_1", "table_1"])
async def test_what_is_held_can_be_put_down_for_any_kind_of_target(kitchen, target, carry_out):
    rehearsal = kitchen(lambda built: built.person(0.0, 1.8))
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", target), ("PLACE", "bottle_1", target)) is None
    assert rehearsal.memory.snapshot().support_of("bottle_1") == "table_1"


async def test_with_no_table_near_it_is_put_on_the_floor_beside_the_person(kitchen, carry_out):
    rehearsal = kitchen(lambda built: built.person(-2.0, 1.5))
    steps = (("PICK", "bottle_1"), ("GOTO", "person_1"), ("PLACE", "bottle_1", "person_1"))
    assert await carry_out(rehearsal, *steps) is None
    snapshot = rehearsal.memory.snapshot()
    assert snapshot.support_of("bottle_1") is None
    assert snapshot.position("bottle_1", "room_1")[2] == pytest.approx(0.12)


@pytest.mark.parametrize("bearing_rad", [pi, 5 * pi / 4, 3 * pi / 2])
async def test_who_is_handed_something_stands_where_the_arm_does_not_go(kitchen, bearing_rad, carry_out):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    x_m, y_m, _ = rehearsal.memory.snapshot().position("table_1", "room_1")
    built[0].person(float(x_m + 0.5 * cos(bearing_rad)), float(y_m + 0.5 * sin(bearing_rad)), stamp_s=1e6)
    assert await carry_out(rehearsal, ("GOTO", "person_1"), ("PLACE", "bottle_1", "person_1")) is None


async def test_beside_somebody_at_a_wall_nothing_is_put_down_behind_the_wall(kitchen):
    """Also where a part of the room was only guessed: beyond an outline nobody has seen the floor."""
    rehearsal = kitchen(lambda built: built.person(-2.85, 2.3))
    with rehearsal.memory.edit("test", 0.0) as tx:
        tx.put(replace(tx.snapshot.room("room_1"), status=RoomStatus.PARTIAL))
        tx.remove("table_2")
    context = await rehearsal.prepare()
    spots = [spot.anchor for spots in ranked_spots(context, "bottle_1", "person_1") for spot in spots]
    floor = [anchor.point_m for anchor in spots if anchor.node_id == "room_1"]
    assert floor
    assert all(abs(x_m) < 3.0 and abs(y_m) < 2.5 for x_m, y_m, _ in floor)


async def test_a_full_table_is_told_before_anything_moves(kitchen, carry_out):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    with rehearsal.memory.edit("test", 0.0) as tx:
        table = rehearsal.memory.snapshot().object("table_2")
        tx.put(replace(table, size_m=(0.1, 0.1, 0.75)))
    failure = await carry_out(rehearsal, ("PLACE", "bottle_1", "table_2"))
    assert failure.code is FailureCode.SUPPORT_FULL


async def test_the_robot_says_what_it_tries(kitchen, onlooker, carry_out):
    rehearsal, said = kitchen(), []

    def listen(r):
        onlooker(r)
        status = r.memory.snapshot().robot.status
        if not said or said[-1] != status:
            said.append(status)

    rehearsal.observe = listen
    await carry_out(rehearsal, ("PICK", "bottle_1"), ("PLACE", "bottle_1", "table_1"))
    assert said == [
        "idle",
        "driving to bottle_1",
        "grasping bottle_1",
        "driving to table_1",
        "releasing bottle_1 table_1",
    ]


async def test_a_table_higher_than_the_lift_is_told_before_driving_there(kitchen, carry_out):
    rehearsal = kitchen(lambda built: built.thing("shelf_1", (-1.5, 1.5, 0.7), (0.8, 0.4, 1.4), support=True))
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    failure = await carry_out(rehearsal, ("PLACE", "bottle_1", "shelf_1"))
    assert failure.code is FailureCode.UNREACHABLE


async def test_what_stops_the_arm_on_its_way_in_between_boards_is_not_the_board(flat, onlooker, fingers, carry_out):
    built = flat().table().bottle()
    built.thing("shelf_1", (-1.5, 2.3, 0.8), (0.9, 0.35, 1.6), support=True, surfaces_m=(0.4, 0.8, 1.2))
    body = FakeBody(pose=Pose2(0.9, 0.35, 1.5), grasped_width_m=fingers(built.memory))
    rehearsal = Rehearsal(memory=built.memory, body=body, observe=onlooker)
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "shelf_1")) is None
    context = await rehearsal.prepare()
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "shelf_1"])
    lowering = next(index for index, action in enumerate(actions) if isinstance(action, LowerToPlace))
    assert await rehearsal.run(actions[:lowering], 900.0) is None

    def stop_the_arm(r):
        onlooker(r)
        r.body.arm = replace(r.body.arm, extension_m=min(r.body.arm.extension_m, 0.15))

    rehearsal.observe = stop_the_arm
    assert (await rehearsal.run(actions[lowering:], 900.0)).code is FailureCode.UNREACHABLE


async def test_what_is_put_down_near_the_end_of_the_lift_is_lowered_to_where_it_stands(kitchen, carry_out):
    """A target above the lift's end stalls the arm, which then is taken to have met the surface."""
    rehearsal = kitchen()
    low_m, high_m = rehearsal.body.limits.lift_m
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "table_2"])
    lowering = next(index for index, action in enumerate(actions) if isinstance(action, LowerToPlace))
    assert await rehearsal.run(actions[:lowering], 900.0) is None
    released_m = []

    def end_the_lift(r):
        r.body.arm = replace(r.body.arm, lift_m=min(r.body.arm.lift_m, r.context.limits.lift_m[1]))
        released_m.append(r.body.arm.lift_m)

    actions[lowering].begin()
    standing_m = actions[lowering]._standing.lift_m
    rehearsal.context.limits = replace(context.limits, lift_m=(low_m, standing_m + 0.025))
    rehearsal.observe = end_the_lift
    assert high_m > standing_m + 0.1
    assert await rehearsal.run([actions[lowering]], 900.0) is None
    assert rehearsal.body.arm.lift_m == pytest.approx(standing_m, abs=0.006)
