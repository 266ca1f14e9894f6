"""Things are put on the boards of a shelf, in physics: level-wise, below the board above."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import pytest

from physics_stage import SKILLS
from planner.goals import goal
from planner.skill_planner.verifier import Verifier
from skills.failures import FailureCode

pytestmark = pytest.mark.anyio
BOARDS_M = (0.4, 0.8, 1.2, 1.6)
IN_REACH_M = (0.4, 0.8)


def with_shelf(make_house, category, on_shelf=(), turn=0.0, from_kind="table"):
    """A thing on a table, or a chair, and a shelf whose back is at a wall."""
    furniture = [
        {"id": "table_1", "category": from_kind, "pose": [1.4, -1.2, 0.0]},
        {"id": "shelf_1", "category": "shelf", "pose": [-1.2, 2.5 - 0.2, 0.0]},
    ]
    if turn:
        furniture[1]["pose"] = [-3.0 + 0.2, 0.6, pi / 2]
    offset = [0.0, 0.25] if from_kind == "table" else [0.05, -0.05]
    things = [{"id": f"{category}_1", "category": category, "on": "table_1", "offset": offset}, *on_shelf]
    return make_house(furniture, things, [0.0, 0.0, 0.5])


async def bring(built, thing, *, told=True):
    if not told:
        with built.memory.edit("test", 0.0) as tx:
            tx.put(replace(built.memory.snapshot().object("shelf_1"), surfaces_m=()))
    steps = (("GOTO", thing), ("PICK", thing), ("GOTO", "shelf_1"), ("PLACE", thing, "shelf_1"))
    failure = await built.carry_out(*steps)
    built.truth = await built.robot.truth()
    return failure


def board_of(built, thing, height_m):
    """The board on which a thing truly stands upright, with nothing touched on the way."""
    where = built.where(thing)
    assert where["on"] == "shelf_1"
    assert built.truth["collisions"] == 0
    bottom_m = where["position_m"][2] - height_m / 2
    board_m = min(BOARDS_M, key=lambda board_m: abs(board_m - bottom_m))
    assert bottom_m == pytest.approx(board_m, abs=0.012)
    return board_m


@pytest.mark.long
@pytest.mark.parametrize(("category", "height_m"), [("bottle", 0.24), ("apple", 0.075), ("book", 0.035)])
async def test_a_thing_is_put_on_a_board_of_a_shelf(stage, make_house, category, height_m):
    built = await stage(with_shelf(make_house, category), noise_m=0.004)
    built.speak = print
    assert await bring(built, f"{category}_1") is None
    assert board_of(built, f"{category}_1", height_m) in IN_REACH_M


@pytest.mark.long
async def test_where_one_board_is_crowded_another_is_taken(stage, make_house):
    crowd = [
        {"id": f"box_{k + 1}", "category": "box", "on": "shelf_1", "offset": [-0.3 + 0.2 * k, -0.03]} for k in range(4)
    ]
    built = await stage(with_shelf(make_house, "bottle", crowd), noise_m=0.004)
    assert {round(built.where(box["id"])["position_m"][2], 1) for box in crowd} == {0.8}
    assert await bring(built, "bottle_1") is None
    assert board_of(built, "bottle_1", 0.24) == 0.4


@pytest.mark.long
async def test_a_bottle_is_brought_from_a_chair_to_a_board(stage, make_house):
    """Held at its neck by a hand that points down it would not get in below the board above."""
    built = await stage(with_shelf(make_house, "bottle", from_kind="chair"), noise_m=0.004)
    assert await bring(built, "bottle_1") is None
    assert board_of(built, "bottle_1", 0.24) in IN_REACH_M


async def test_of_a_shelf_whose_boards_are_not_known_it_is_said_that_the_arm_does_not_reach_it(stage, make_house):
    built = await stage(with_shelf(make_house, "bottle"))
    failure = await bring(built, "bottle_1", told=False)
    assert failure.code is FailureCode.UNREACHABLE
    assert failure.message == "there is no free place from which the arm reaches shelf_1."
    assert built.truth["robot"]["holding"] == "bottle_1"


@pytest.mark.slow
async def test_what_was_put_on_a_board_is_fetched_from_there_again(stage, make_house):
    built = await stage(with_shelf(make_house, "bottle", turn=pi / 2), noise_m=0.004)
    assert await bring(built, "bottle_1") is None
    board_of(built, "bottle_1", 0.24)
    assert await fetch(built, "bottle_1") is None
    assert (await built.robot.truth())["collisions"] == 0


@pytest.mark.long
@pytest.mark.parametrize(
    ("category", "height_m"), [("banana", 0.04), ("book", 0.035), ("apple", 0.075), ("scissors", 0.015), ("cup", 0.1)]
)
async def test_what_lies_flat_on_a_board_is_taken_from_there(stage, make_house, category, height_m):
    """With its narrow side to the front, where a level hand would close on the air above it."""
    thing = {"id": "thing_1", "category": category, "pose": [-1.15, 2.26, 0.8 + height_m / 2, pi / 2]}
    built = await stage(with_shelf(make_house, "bottle", [thing]), noise_m=0.004)
    assert round(built.where("thing_1")["position_m"][2], 1) == 0.8
    assert await fetch(built, "thing_1") is None
    built.truth = await built.robot.truth()
    assert built.where("thing_1")["on"] == "table_1"
    assert built.truth["collisions"] == 0


async def test_what_stands_before_a_thing_on_a_board_is_taken_away_first_and_nothing_is_pushed(stage, make_house):
    behind = {"id": "apple_1", "category": "apple", "pose": [-1.15, 2.36, 0.8375, 0.0]}
    before = {"id": "can_1", "category": "can", "pose": [-1.12, 2.23, 0.86, 0.0]}
    built = await stage(with_shelf(make_house, "bottle", [behind, before]), noise_m=0.004)
    plan = Verifier(SKILLS).plan_for([goal("on", "apple_1", "table_1")], built.memory.snapshot())
    assert [step.args[0] for step in plan.steps if step.skill == "PICK"] == ["can_1", "apple_1"]
    assert await built.carry_out(*((step.skill, *step.args) for step in plan.steps)) is None
    built.truth = await built.robot.truth()
    assert built.where("apple_1")["on"] == "table_1"
    assert built.where("can_1")["on"] is not None
    assert built.truth["collisions"] == 0


async def fetch(built, thing):
    return await built.carry_out(("GOTO", thing), ("PICK", thing), ("GOTO", "table_1"), ("PLACE", thing, "table_1"))
