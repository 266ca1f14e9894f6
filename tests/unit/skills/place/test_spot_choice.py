"""Choosing a spot among those that are free."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState
from skills.anchor import Anchor
from skills.arm.kinematics import gripper_pose
from skills.doubles import Rehearsal
from skills.failures import FailureCode
from skills.place.place_search import free_spots
from skills.place.spot_choice import ChooseSpot
from skills.place.spot_reach import Placement
from skills.registry import load_registry

pytestmark = pytest.mark.anyio


SKILLS = load_registry([])


@pytest.mark.parametrize("tables", [0, 1])
async def test_in_a_room_what_is_not_known_by_name_carries_things_only_where_nothing_else_does(flat, tables):
    built = flat().thing("unknown_1", (0.9, 0.0, 0.4), (0.6, 0.5, 0.8), support=True)
    built.thing("cup_1", (0.0, 1.0, 0.05), (0.08, 0.08, 0.1), graspable=True)
    built = built.table() if tables else built
    context = await Rehearsal(memory=built.memory).prepare()
    spots = free_spots(context, "cup_1", "room_1")
    assert {spot.anchor.node_id for spot in spots} == {"table_1" if tables else "unknown_1"}


async def test_where_the_arm_was_stopped_on_its_way_to_the_floor_it_does_not_go_again_soon(flat):
    built = flat().thing("cup_1", (0.0, 1.0, 0.05), (0.08, 0.08, 0.1), graspable=True)
    context = await Rehearsal(memory=built.memory).prepare()
    stopped, *others = [spot.anchor for spot in free_spots(context, "cup_1", "room_1")]
    context.blocked_spots[stopped.node_id, stopped.point_m] = context.stamp_s
    again = [spot.anchor for spot in free_spots(context, "cup_1", "room_1")]
    assert again
    assert set(again) <= set(others)
    assert min(np.hypot(*np.subtract(on.point_m, stopped.point_m)[:2]) for on in again) > 0.1


async def test_where_things_leave_free_only_what_cannot_be_reached_the_table_is_full(kitchen, carry_out):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    spot = free_spots(context, "bottle_1", "table_1")[0]
    placement = Placement(
        object_id="bottle_1",
        target="table_2",
        spots=lambda: [replace(spot, anchor=Anchor("table_2", (0.0, 0.0, 3.0)))],
        spots_if_empty=lambda: free_spots(context, "bottle_1", "table_2", as_empty=True),
    )
    assert (await rehearsal.run([ChooseSpot(context, placement)])).code is FailureCode.SUPPORT_FULL
    placement.spots_if_empty = list
    assert (await rehearsal.run([ChooseSpot(context, placement)])).code is FailureCode.UNREACHABLE


@pytest.mark.parametrize(
    ("label", "graspable", "code"),
    [("plant", False, FailureCode.UNREACHABLE), ("plant", True, FailureCode.UNREACHABLE), ("unknown", True, None)],
)
async def test_a_spot_is_chosen_to_which_the_arm_gets_past_what_is_higher(kitchen, label, graspable, code, carry_out):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    spots = free_spots(context, "bottle_1", "table_2")
    placement = Placement(object_id="bottle_1", target="table_2", spots=lambda: spots, spots_if_empty=list)
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    cheapest = placement.spot
    x_m, y_m, _ = cheapest.anchor.position(rehearsal.memory.snapshot(), "room_1")
    built[0].thing(f"{label}_1", (x_m, y_m, 1.15), (0.1, 0.1, 0.3), graspable=graspable)
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    x2_m, y2_m, _ = placement.spot.anchor.position(rehearsal.memory.snapshot(), "room_1")
    assert np.hypot(x2_m - x_m, y2_m - y_m) > 0.1
    placement.spots = lambda: [cheapest]
    failure = await rehearsal.run([ChooseSpot(context, placement)])
    assert (failure.code if failure else None) is code


async def test_nothing_is_put_before_another_thing_on_a_board_where_there_is_a_spot_beside_it(kitchen, carry_out):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    spots = free_spots(context, "bottle_1", "table_2")
    placement = Placement(object_id="bottle_1", target="table_2", spots=lambda: spots)
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    first = placement.spot
    spots[spots.index(first)] = replace(first, bars=1)
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    assert placement.spot.bars == 0
    placement.spots = lambda: [replace(first, bars=1)]
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None


async def test_things_that_keep_the_arm_from_every_spot_of_a_table_make_it_full(kitchen, carry_out):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    spot = free_spots(context, "bottle_1", "table_2")[0]
    x_m, y_m, _ = spot.anchor.position(rehearsal.memory.snapshot(), "room_1")
    built[0].thing("plant_1", (x_m, y_m, 1.1), (0.1, 0.1, 0.7), on="table_2")
    placement = Placement(object_id="bottle_1", target="table_2", spots=lambda: [spot], spots_if_empty=lambda: [spot])
    assert (await rehearsal.run([ChooseSpot(context, placement)])).code is FailureCode.SUPPORT_FULL


async def test_where_no_good_spot_is_within_reach_the_next_best_is_taken(kitchen, carry_out):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    low, *others = free_spots(context, "bottle_1", "table_2")
    high = replace(low, anchor=Anchor("table_2", (0.0, 0.0, 3.0)))
    placement = Placement(
        object_id="bottle_1", target="room_1", spots=lambda: [high], further=lambda: [[high], [low], others]
    )
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    assert placement.spot == low
    assert low in placement.spots_at("table_2")


async def test_a_place_taken_meanwhile_is_exchanged_for_a_free_one(kitchen, onlooker, carry_out):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "table_2"])
    assert await rehearsal.run(actions[:3], 900.0) is None
    x, y, _ = actions[1]._placement.spot.anchor.position(rehearsal.memory.snapshot(), "room_1")
    with rehearsal.memory.edit("test", 0.0) as tx:
        cup = replace(rehearsal.memory.snapshot().object("bottle_1"), id="cup_1", state=ObjectState.PRESENT)
        tx.put(cup, RtEdge(source="room_1", target="cup_1", T_source_target=SE3.from_xyz_yaw(x, y, 0.87, 0.0)))
        from scene_graph.edges import InEdge

        tx.put(InEdge(source="cup_1", target="room_1"))
    assert await rehearsal.run(actions[3:], 900.0) is None
    a, b = (rehearsal.memory.snapshot().position(node, "room_1") for node in ("bottle_1", "cup_1"))
    assert abs(a - b)[:2].max() > 0.05


async def test_where_something_unseen_stopped_the_arm_nothing_is_put_next_time(kitchen, onlooker, carry_out):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "table_2"])
    assert await rehearsal.run(actions[:5], 900.0) is None
    spot = actions[1]._placement.spot.anchor.position(rehearsal.memory.snapshot(), "room_1")[:2]

    def stop_the_arm(r):
        onlooker(r)
        hand = gripper_pose(r.body.arm, r.body.geometry)
        if np.hypot(*(r.body.pose.apply(np.array([[hand.x_m, hand.y_m]]))[0] - spot)) < 0.1:
            r.body.arm = replace(r.body.arm, lift_m=max(r.body.arm.lift_m, 1.0))

    rehearsal.observe = stop_the_arm
    assert (await rehearsal.run(actions[5:], 900.0)).code is FailureCode.UNREACHABLE
    left = [each.anchor.position(rehearsal.memory.snapshot(), "room_1")[:2] for each in actions[1]._placement.spots()]
    assert min(np.hypot(*(at - spot)) for at in left) > 0.1
    assert await carry_out(rehearsal, ("PLACE", "bottle_1", "table_2")) is None


@pytest.mark.parametrize("as_empty", [False, True])
async def test_who_stands_at_the_only_free_spot_is_the_reason_why_nothing_is_put_there(kitchen, as_empty, carry_out):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    context = await rehearsal.prepare()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    spot = free_spots(context, "bottle_1", "table_2")[0]
    x_m, y_m, _ = spot.anchor.position(rehearsal.memory.snapshot(), "room_1")
    built[0].person(float(x_m) + 0.1, float(y_m), stamp_s=context.stamp_s)
    placement = Placement(
        object_id="bottle_1",
        target="table_2",
        spots=lambda: [spot],
        spots_if_empty=lambda: free_spots(context, "bottle_1", "table_2", as_empty=True) if as_empty else [],
    )
    failure = await rehearsal.run([ChooseSpot(context, placement)])
    assert (failure.code, failure.evidence.nodes) == (FailureCode.PERSON_IN_WAY, ("person_1", "table_2"))
