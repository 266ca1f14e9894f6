"""What stands in the way of the hand to a thing on a board."""

from __future__ import annotations

from dataclasses import replace

import pytest

from scene_graph.nodes import RoomStatus
from skills.arm.barring import barring
from skills.facts import read_state
from skills.pick.pick import Pick
from skills.state.state import PlaceRelation

APPLE_M = (0.07, 0.07, 0.07)
CAN_M = (0.066, 0.066, 0.12)
BOARD_M = 0.8


def shelved(flat, *things, boards_m=(0.4, 0.8, 1.2, 1.6)):
    """A shelf at the wall y = 2.5, its front toward -y; an apple at the back of a board, and more: name, x, y, size."""
    built = flat().thing("shelf_1", (0.0, 2.3, 0.8), (0.9, 0.35, 1.6), support=True, surfaces_m=boards_m)
    for name, x_m, y_m, size_m, *fields in (("apple_1", 0.0, 0.08, APPLE_M), *things):
        more = fields[0] if fields else {}
        height_m = more.pop("board_m", BOARD_M) + size_m[2] / 2
        built.thing(name, (x_m, 2.3 + y_m, height_m), size_m, on="shelf_1", **{"graspable": True, **more})
    return built


@pytest.mark.parametrize(
    ("thing", "bars"),
    [
        (("can_1", 0.04, -0.05, CAN_M), True),
        (("can_1", -0.06, -0.05, CAN_M), True),
        (("can_1", 0.13, -0.05, CAN_M), False),  # the hand comes in beside it
        (("can_1", 0.08, 0.09, CAN_M), False),  # abreast: the fingers pass, the palm stays before both
        (("can_1", 0.0, -0.05, (0.066, 0.066, 0.02)), False),  # the hand is over it
        (("can_1", 0.0, -0.05, CAN_M, {"board_m": 0.4}), False),
        (("vase_1", 0.0, -0.05, CAN_M, {"graspable": False}), False),  # nothing can be done about it
        (("unknown_1", 0.0, -0.05, CAN_M), False),  # may be a part of the apple
    ],
)
def test_what_a_level_hand_would_meet_on_its_way_in_bars_it(flat, thing, bars):
    built = shelved(flat, thing)
    assert barring(built.memory.snapshot(), "apple_1") == ((thing[0],) if bars else ())
    assert barring(built.memory.snapshot(), thing[0]) == ()


def test_the_foremost_is_first(flat):
    built = shelved(flat, ("can_1", 0.03, -0.02, CAN_M), ("can_2", 0.0, -0.1, CAN_M))
    assert barring(built.memory.snapshot(), "apple_1") == ("can_2", "can_1")
    assert barring(built.memory.snapshot(), "can_1") == ("can_2",)


def test_on_the_top_and_on_a_table_the_hand_comes_from_above(flat):
    can = ("can_1", 0.0, -0.05, CAN_M, {"board_m": 1.6})
    built = shelved(flat, can).thing("pear_1", (0.0, 2.38, 1.635), APPLE_M, on="shelf_1", graspable=True)
    assert barring(built.memory.snapshot(), "pear_1") == ()
    built = shelved(flat, can, boards_m=())
    assert barring(built.memory.snapshot(), "apple_1") == ()


@pytest.mark.parametrize(("height_m", "bars"), [(0.12, True), (0.06, False)])
def test_over_what_lies_flat_the_hand_comes_from_above_as_high_as_the_board_lets_it(flat, height_m, bars):
    book = ("book_1", 0.0, 0.05, (0.15, 0.1, 0.03), {"board_m": 0.4})
    can = ("can_1", 0.0, -0.1, (0.066, 0.066, height_m), {"board_m": 0.4})
    assert barring(shelved(flat, book, can).memory.snapshot(), "book_1") == (("can_1",) if bars else ())


def test_a_shelf_in_the_middle_of_a_room_is_open_on_both_sides(flat):
    built = flat().thing("shelf_1", (0.0, 0.0, 0.8), (0.9, 0.35, 1.6), support=True, surfaces_m=(0.4, 0.8, 1.2, 1.6))
    built.thing("apple_1", (0.0, 0.05, 0.835), APPLE_M, on="shelf_1", graspable=True)
    built.thing("can_1", (0.0, -0.06, 0.86), CAN_M, on="shelf_1", graspable=True)
    assert barring(built.memory.snapshot(), "apple_1") == ()


def test_where_the_wall_is_not_known_the_hand_may_come_from_both_sides(flat):
    built = shelved(flat, ("can_1", 0.0, -0.05, CAN_M))
    with built.memory.edit("test", 0.0) as tx:
        tx.put(replace(built.memory.snapshot().node("room_1"), status=RoomStatus.TEMPORARY))
    assert barring(built.memory.snapshot(), "apple_1") == ()


def test_pick_names_it_until_it_was_moved(flat):
    snapshot = shelved(flat, ("can_1", 0.0, -0.05, CAN_M)).memory.snapshot()
    state = read_state(snapshot).after(robot_at="shelf_1")
    (unmet,) = Pick().conditions(state, ["apple_1"])
    assert unmet.message == "can_1 stands before apple_1: move it away first."
    for place in ((PlaceRelation.IN, "room_1"), (PlaceRelation.ON, "table_1"), None):
        assert Pick().conditions(state.after(places=state.moved("can_1", place)), ["apple_1"]) == []
