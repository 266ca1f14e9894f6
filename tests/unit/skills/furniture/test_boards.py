"""Boards of a shelf: which there are, what fits below the one above, and from where the hand gets in."""

from __future__ import annotations

from dataclasses import replace
from math import inf, pi

import numpy as np
import pytest

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode
from skills.anchor import Anchor
from skills.arm.hand import Hand
from skills.arm.level_hand import prefers_level
from skills.arm.roof import is_covered, roof_over_m
from skills.arm.way_in import is_among_boards, is_before, off_end
from skills.furniture.furniture import Furniture
from skills.furniture.standing import stand_of
from skills.outline import disc
from skills.place.capacity import Capacity
from skills.place.place_spot import spots_on
from skills.state.world import Thing

HAND = Hand()
SHELF = ObjectNode(id="shelf_1", label="shelf", size_m=(0.9, 0.35, 1.6), surfaces_m=(0.4, 0.8, 1.2), support=True)
BOTTLE_M = (0.07, 0.07, 0.24)
CAN_M = (0.066, 0.066, 0.12)


def shelved(flat, surfaces_m=(0.4, 0.8, 1.2)):
    """A flat with a shelf at the wall y = 2.5, its front toward -y."""
    return flat().thing("shelf_1", (0.0, 2.3, 0.8), SHELF.size_m, support=True, surfaces_m=surfaces_m)


def on_board(built, name, x, y, height_m, size=BOTTLE_M, **fields):
    """Put a thing on a board, ``x`` and ``y`` in the shelf."""
    return built.thing(name, (x, 2.3 + y, height_m + size[2] / 2), size, on="shelf_1", **fields)


def heights(spots):
    return {round(spot.anchor.point_m[2] + 0.8, 3) for spot in spots}


def test_the_boards_of_a_shelf_end_with_its_top_and_tell_how_much_is_free_above():
    boards = Furniture.of(SHELF).surfaces
    assert [round(board.height_m + 0.8, 6) for board in boards] == [0.4, 0.8, 1.2, 1.6]
    assert [round(board.free_m, 6) for board in boards[:-1]] == [round(0.4 - Furniture.of(SHELF).kind.board_m, 6)] * 3
    assert boards[-1].free_m == inf


def test_the_top_is_where_it_was_measured_if_it_was():
    low = replace(SHELF, size_m=(0.9, 0.35, 1.02), surfaces_m=(0.5, 1.0))
    assert [round(board.height_m + 0.51, 6) for board in Furniture.of(low).surfaces] == [0.5, 1.0]


@pytest.mark.parametrize("changes", [{"surfaces_m": ()}, {"surfaces_m": (1.58,)}, {"label": "chair"}])
def test_what_has_a_top_alone_and_seats_have_no_boards(changes):
    (surface,) = Furniture.of(replace(SHELF, **changes)).surfaces
    assert not surface.is_covered


def test_a_thing_goes_on_every_board_that_has_room_for_it(flat):
    spots = spots_on(shelved(flat).memory.snapshot(), "shelf_1", BOTTLE_M, None)
    assert heights(spots) == {0.4, 0.8, 1.2, 1.6}
    for spot in spots:
        assert abs(spot.anchor.point_m[0]) <= 0.45 - (0.13 if spot.is_covered else 0.0)


def test_what_is_too_high_for_a_board_goes_on_top(flat):
    assert heights(spots_on(shelved(flat).memory.snapshot(), "shelf_1", (0.1, 0.1, 0.38), None)) == {1.6}


def test_what_stands_on_one_board_takes_no_room_on_the_others(flat):
    built = on_board(shelved(flat), "box_1", 0.0, 0.0, 0.8, (0.8, 0.3, 0.1))
    assert heights(spots_on(built.memory.snapshot(), "shelf_1", BOTTLE_M, None)) == {0.4, 1.2, 1.6}


def test_behind_what_stands_in_front_nothing_is_put_from_that_side(flat):
    built = on_board(shelved(flat), "bottle_1", 0.0, -0.1, 0.8)
    spots = [spot for spot in spots_on(built.memory.snapshot(), "shelf_1", BOTTLE_M, None) if spot.is_covered]
    behind = [
        spot
        for spot in spots
        if round(spot.anchor.point_m[2], 6) == 0.0
        and abs(spot.anchor.point_m[0]) < 0.1
        and spot.anchor.point_m[1] > -0.1
    ]
    assert all(-1 not in spot.sides for spot in behind)
    assert any(spot.sides == (-1, 1) for spot in spots)


def test_without_boards_a_shelf_is_its_top_as_before(flat):
    assert heights(spots_on(shelved(flat, ()).memory.snapshot(), "shelf_1", BOTTLE_M, None)) == {1.6}


def test_the_arm_comes_in_straight_from_before_and_clear_of_the_ends(flat):
    snapshot = shelved(flat).memory.snapshot()

    def before(point_m, *places):
        return is_before(snapshot, "shelf_1", point_m, np.array(places), "room_1", HAND).tolist()

    middle = (0.0, 0.0, 0.0)
    assert before(middle, (0.0, 1.7), (0.1, 1.7), (0.5, 1.9), (0.7, 2.3)) == [True, True, False, False]
    near_end = (0.3, 0.0, 0.0)
    assert before(near_end, (0.3, 1.7), (0.5, 1.7), (0.15, 1.7)) == [True, False, True]
    assert is_before(snapshot, "shelf_1", middle, np.array([(0.0, 1.7)]), "room_1", HAND, sides=(1,)).tolist() == [
        False
    ]


def test_a_hand_that_points_down_needs_more_room_over_a_board_than_a_level_one():
    level, down = (HAND.headroom_m(0.24, 0.12, pitch) for pitch in (0.0, -pi / 2))
    assert 0.24 < level < 0.365 - 0.05
    assert down > 0.3
    assert HAND.headroom_m(0.075, 0.04, -pi / 2) < 0.365


def test_a_thing_stands_on_the_board_below_its_bottom_and_is_covered_by_the_next(flat):
    built = on_board(shelved(flat), "cup_1", 0.0, 0.0, 0.4, (0.08, 0.08, 0.1), graspable=True)
    snapshot = built.memory.snapshot()
    assert round(stand_of(snapshot, "cup_1").surface.height_m, 6) == -0.4
    assert is_covered(snapshot, "cup_1", "room_1", HAND)


@pytest.mark.parametrize(
    ("height_m", "surfaces_m", "level"), [(0.1, (), True), (0.035, (), False), (0.035, (1.0,), True)]
)
def test_below_a_board_what_is_low_is_taken_from_above_if_the_hand_fits_in(flat, height_m, surfaces_m, level):
    shelf = shelved(flat, (0.4, 0.8, *surfaces_m, 1.2))
    snapshot = on_board(shelf, "book_1", 0.0, 0.0, 0.8, (0.2, 0.085, height_m), graspable=True).memory.snapshot()
    assert prefers_level(snapshot, "book_1", SE3.from_xyz_yaw(0.55, 0.0, 0.8 + height_m / 2, 0.0), HAND) is level
    roof_m = roof_over_m(snapshot, "book_1", HAND)
    board = stand_of(snapshot, "book_1").surface
    assert height_m / 2 + roof_m + HAND.geometry.hand_length_m < board.free_m


def test_nothing_is_over_what_stands_on_top(flat):
    built = on_board(shelved(flat), "book_1", 0.0, 0.0, 1.6, (0.2, 0.085, 0.035), graspable=True)
    assert roof_over_m(built.memory.snapshot(), "book_1", HAND) == inf


@pytest.mark.parametrize(
    ("x_m", "width_m", "aside_m"),
    [
        (0.0, 0.07, 0.0),
        (0.36, 0.07, -0.017),  # as far as the fingers allow
        (-0.36, 0.07, 0.017),
        (0.325, 0.07, -0.005),  # as far as it takes
        (0.36, 0.11, 0.0),  # it fills the hand
    ],
)
def test_near_an_end_of_a_board_the_hand_takes_a_thing_a_little_from_the_inside(flat, x_m, width_m, aside_m):
    built = on_board(shelved(flat), "glass_1", x_m, 0.0, 0.8, (width_m, width_m, 0.14), graspable=True)
    snapshot = built.memory.snapshot()
    at = off_end(snapshot, "glass_1", HAND).position(snapshot, "shelf_1")
    assert at == pytest.approx((x_m + aside_m, 0.0, 0.07), abs=1e-6)


@pytest.mark.parametrize(
    ("box_y_m", "aside_m"),
    [
        (-0.08, -0.006),  # beside the way of the palm: as much room to it as to the end
        (0.06, -0.017),  # behind the palm: only the end counts
    ],
)
def test_between_an_end_and_a_neighbor_the_hand_comes_in_the_middle(flat, box_y_m, aside_m):
    built = on_board(shelved(flat), "glass_1", 0.36, 0.05, 0.8, (0.07, 0.07, 0.14), graspable=True)
    on_board(built, "box_1", 0.213, box_y_m, 0.8, (0.14, 0.08, 0.1), graspable=True)
    snapshot = built.memory.snapshot()
    at = off_end(snapshot, "glass_1", HAND).position(snapshot, "shelf_1")
    assert at == pytest.approx((0.36 + aside_m, 0.05, 0.07), abs=1e-3)


def test_what_stands_on_top_or_is_gone_is_taken_at_its_middle(flat):
    snapshot = on_board(shelved(flat), "glass_1", 0.4, 0.0, 1.6, (0.07, 0.07, 0.14)).memory.snapshot()
    assert off_end(snapshot, "glass_1", HAND) == Anchor("glass_1")
    assert off_end(snapshot, "glass_9", HAND) == Anchor("glass_9")


def test_a_hand_is_among_boards_between_them_and_not_above_the_top(flat):
    snapshot = shelved(flat).memory.snapshot()
    assert is_among_boards(snapshot, "room_1", np.array((0.0, 2.2, 0.9)), HAND)
    assert not is_among_boards(snapshot, "room_1", np.array((0.0, 2.2, 1.7)), HAND)
    assert not is_among_boards(snapshot, "room_1", np.array((0.0, 1.6, 0.9)), HAND)


@pytest.mark.parametrize(
    ("surfaces_m", "count", "fits"),
    [((0.4, 0.8, 1.2), 8, True), ((0.4, 0.8, 1.2), 30, False), ((1.2,), 1, False), ((), 8, True)],
)
def test_a_shelf_has_room_on_the_boards_that_the_arm_reaches(flat, surfaces_m, count, fits):
    built = shelved(flat, surfaces_m).table()
    for k in range(count):
        built.bottle(f"bottle_{k + 1}", x=0.5 + 0.03 * k)
    shelf = Thing(id="shelf_1", kind="object", label="shelf", support=True, size_m=SHELF.size_m)
    coming = [f"bottle_{k + 1}" for k in range(count)]
    assert Capacity(built.memory.snapshot()).fits(shelf, (), coming) == fits


def test_a_spot_tells_how_many_things_one_could_no_longer_take_if_something_stood_there(flat):
    built = on_board(shelved(flat), "apple_1", 0.0, 0.08, 0.8, (0.07, 0.07, 0.07))
    on_board(built, "box_1", 0.3, 0.08, 0.4, (0.07, 0.07, 0.07))
    spots = [s for s in spots_on(built.memory.snapshot(), "shelf_1", CAN_M, None) if abs(s.anchor.point_m[2]) < 0.01]
    before = [s for s in spots if abs(s.anchor.point_m[0]) < 0.1]
    beside = [s for s in spots if abs(s.anchor.point_m[0]) > 0.09 + 0.015 + 0.035 + disc(CAN_M).radius_m]
    assert before
    assert {s.bars for s in before} == {1}
    assert beside
    assert {s.bars for s in beside} == {0}
    assert min(s.anchor.point_m[1] for s in before) < 0.0 < max(s.anchor.point_m[1] for s in beside)


def test_on_the_top_of_a_shelf_nothing_stands_before_another(flat):
    built = on_board(shelved(flat), "apple_1", 0.0, 0.08, 1.6, (0.07, 0.07, 0.07))
    spots = spots_on(built.memory.snapshot(), "shelf_1", CAN_M, None)
    assert {spot.bars for spot in spots if not spot.is_covered} == {0}
