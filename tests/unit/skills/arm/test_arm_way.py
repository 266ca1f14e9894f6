"""What lies on the way of the arm, and what that costs."""

from __future__ import annotations

from math import cos, inf, pi, sin

import numpy as np
import pytest

from skills.arm.arm import Retract
from skills.arm.arm_way import clear_over_m, passing_over
from skills.arm.hand import DOWN_RAD
from skills.arm.settings import ArmSettings, ReachSettings
from skills.doubles import FakeBody, Rehearsal
from skills.ports import ArmTarget

pytestmark = pytest.mark.anyio


REACH = ReachSettings()
BARRED_M = REACH.barred_cost_m


@pytest.mark.parametrize(
    ("cup_x_m", "cup_y_m", "clear_m"), [(0.45, 0.0, 0.89), (0.45, 0.11, 0.89), (0.45, 0.2, 0.0), (0.9, 0.0, 0.0)]
)
async def test_the_hand_goes_over_the_small_things_on_its_way(flat, cup_x_m, cup_y_m, clear_m):
    built = flat().thing("table_1", (0.9, 0.0, 0.375), (1.2, 0.8, 0.75), support=True)
    built.thing("book_1", (0.7, 0.0, 0.77), (0.2, 0.08, 0.04), on="table_1", graspable=True)
    built.thing("cup_1", (cup_x_m, cup_y_m, 0.8), (0.08, 0.08, 0.1), on="table_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody()).prepare()
    assert clear_over_m(context, 0.7, "book_1") == pytest.approx(clear_m)


@pytest.mark.parametrize(
    ("height_m", "aside_m", "cost_m"),
    [(0.96, 0.0, inf), (0.96, -0.01, BARRED_M), (0.96, -0.15, 0.0), (0.4, 0.0, 0.0)],
)
async def test_the_end_of_something_long_bars_the_arm_if_it_is_higher_than_the_hand(flat, height_m, aside_m, cost_m):
    built = flat().thing("stool_1", (0.12, 0.08, 0.25), (0.4, 0.4, 0.5), yaw=-2.08, support=True)
    built.thing("bottle_1", (0.0, 0.0, 0.62), (0.07, 0.07, 0.24), on="stool_1", graspable=True)
    built.thing("cabinet_1", (-0.31, -0.64 + aside_m, height_m / 2), (0.98, 0.44, height_m), yaw=-2.08, support=True)
    places = np.array(((-0.70, -0.13), (0.70, 0.13)))  # past the end of the cabinet, whose middle is far, and opposite
    costs = passing_over(built.context(), np.zeros(3), 0.5, places, {"bottle_1", "stool_1"})
    assert costs.tolist() == [cost_m, 0.0]


@pytest.mark.parametrize(
    ("name", "cost_m"), [("unknown_1", REACH.met_cost_m), ("cup_1", REACH.met_cost_m), ("plant_1", inf)]
)
async def test_a_small_thing_without_a_name_does_not_keep_the_hand_from_what_it_may_be_a_part_of(flat, name, cost_m):
    built = flat().thing("book_1", (0.0, 0.0, 0.47), (0.2, 0.08, 0.03), graspable=True)
    built.thing(name, (0.02, 0.0, 0.6), (0.14, 0.13, 0.2), graspable=name == "cup_1")
    places = np.array(((0.6, 0.0), (-0.6, 0.3)))
    costs = passing_over(built.context(), np.zeros(3), 0.5, places, {"book_1"})
    assert costs.tolist() == [cost_m, cost_m]


def test_what_the_arm_would_meet_in_the_middle_costs_more_than_what_it_would_graze(flat):
    built = flat().thing("book_1", (0.0, 0.0, 0.47), (0.2, 0.08, 0.03), graspable=True)
    context = built.thing("bottle_1", (0.25, 0.0, 0.6), (0.07, 0.07, 0.24), graspable=True).context()
    places = np.array([(0.6 * cos(turn), 0.6 * sin(turn)) for turn in (0.0, 0.2, 0.4, 0.8)])
    costs = passing_over(context, np.zeros(3), 0.5, places, {"book_1"})
    assert costs[0] == REACH.met_cost_m > costs[1] > costs[2] > REACH.in_the_way_cost_m > costs[3] == 0.0


def test_no_arm_reaches_through_a_wall_and_one_does_through_a_door(flat):
    context = flat().context()
    behind_the_wall, behind_the_door, at_the_wall = (3.3, 1.2, 0.0), (3.3, 0.0, 0.0), (2.9, 1.2, 0.0)
    for target, free in ((behind_the_wall, False), (behind_the_door, True), (at_the_wall, True)):
        places = np.array([[2.5, target[1]]])
        costs = passing_over(context, np.array(target), 0.5, places, set())
        assert bool(np.isfinite(costs[0])) is free


@pytest.mark.parametrize(
    ("kind", "back_rad", "from_back", "from_side", "from_front"),
    [
        ("chair", pi / 2, inf, 0.0, 0.0),
        ("chair", -pi / 2, 0.0, 0.0, inf),
        ("chair", None, 0.0, 0.0, 0.0),
        ("sofa", pi / 2, inf, inf, 0.0),
        ("stool", None, 0.0, 0.0, 0.0),
    ],
)
async def test_the_hand_comes_to_a_seat_neither_over_its_back_nor_over_an_arm_of_it(
    flat, kind, back_rad, from_back, from_side, from_front
):
    long_m = 1.9 if kind == "sofa" else 0.5
    built = flat().thing(f"{kind}_1", (0.0, 0.0, 0.45), (long_m, 0.5, 0.9), support=True, back_rad=back_rad)
    built.thing("cup_1", (0.0, 0.0, 0.5), (0.08, 0.08, 0.1), on=f"{kind}_1", graspable=True)
    places = np.array(((0.0, 0.6), (long_m / 2 + 0.35, 0.0), (0.0, -0.6)))
    spared = {"cup_1", f"{kind}_1"}
    costs = passing_over(built.context(), np.array((0.0, 0.0, 0.5)), 0.6, places, spared)
    assert costs.tolist() == [from_back, from_side, from_front]


@pytest.mark.parametrize(
    ("at_m", "along", "aslant"),
    [(0.0, 0.0, 0.0), (0.11, BARRED_M, 0.0), (0.17, BARRED_M, BARRED_M)],
)
async def test_to_what_is_close_to_the_back_of_a_chair_the_hand_comes_from_the_front(flat, at_m, along, aslant):
    built = flat().thing("chair_1", (0.0, 0.0, 0.45), (0.45, 0.45, 0.9), support=True, back_rad=pi / 2)
    built.thing("cup_1", (0.0, at_m, 0.5), (0.08, 0.08, 0.1), on="chair_1", graspable=True)
    places = np.array(((0.6, at_m), (0.5, at_m - 0.35), (0.0, at_m - 0.6)))
    target, spared = np.array((0.0, at_m, 0.5)), {"cup_1", "chair_1"}
    costs = passing_over(built.context(), target, 0.6, places, spared)
    assert costs.tolist() == [along, aslant, 0.0]


@pytest.mark.parametrize(
    ("aside_m", "stamp_s", "cost_m"),
    [(0.1, 0.0, inf), (0.25, 0.0, inf), (0.4, 0.0, 0.0), (0.25, 60.0, BARRED_M), (0.4, 60.0, 0.0)],
)
async def test_the_arm_does_not_pass_where_somebody_stands_or_was_seen(flat, aside_m, stamp_s, cost_m):
    context = flat().person(0.4, aside_m).context(stamp_s)
    places = np.array(((0.8, 0.0), (-0.8, 0.0)))
    costs = passing_over(context, np.zeros(3), 0.5, places, set())
    assert costs.tolist() == [cost_m, 0.0]


async def test_a_hand_that_let_go_rises_over_the_arm_of_a_sofa_before_it_is_drawn_back(flat):
    arm = ArmTarget(lift_m=0.6, extension_m=0.5, wrist_pitch_rad=DOWN_RAD, wrist_roll_rad=0.0)
    rehearsal = Rehearsal(memory=flat().memory, body=FakeBody(arm=arm))
    highest_m = []
    rehearsal.observe = lambda r: highest_m.append(r.body.arm.lift_m) if r.body.arm.extension_m > 0.4 else None
    assert await rehearsal.run([Retract(await rehearsal.prepare())]) is None
    assert max(highest_m) == pytest.approx(ArmSettings().carry_lift_m, abs=0.01)
