"""Whether what is seen is a part of a thing that is known."""

import numpy as np
import pytest

from perception.objects.beliefs import LabelBelief
from perception.objects.furniture.surface import Box, SurfaceBelief
from perception.objects.identity.hypotheses import Hypothesis
from unit.perception.objects.things import are_one, decision, is_part, seen


def test_a_part_that_looks_like_something_else_from_near_is_a_part_until_it_is_seen_as_a_whole():
    toilet, part = seen("toilet", (0.7, 0.4, 0.8), 1), seen("bin", (0.3, 0.3, 0.5), 2)
    part.seen_whole = False
    assert is_part(part, toilet)
    part.seen_whole = True
    assert not is_part(part, toilet)


def test_the_same_cupboard_under_two_names_is_one_and_a_chair_under_a_table_is_not():
    cabinet, sideboard = seen("cabinet", (0.9, 0.5, 0.9), 1), seen("sideboard", (0.95, 0.48, 0.85), 2)
    assert are_one(cabinet, sideboard)
    assert is_part(sideboard, cabinet)
    table, chair = seen("table", (1.4, 0.9, 0.75), 3), seen("chair", (0.45, 0.45, 0.7), 4)
    assert not are_one(table, chair)
    assert not is_part(chair, table)


@pytest.mark.parametrize(
    ("looks_like", "part"),
    [((("shelf", 0.97),), False), ((("unknown", 0.9),), True), ((("shelf", 0.45), ("cabinet", 0.4)), True)],
)
def test_the_side_of_a_desk_that_nobody_can_name_for_sure_is_of_the_desk(looks_like, part):
    desk, side = seen("desk", (1.2, 0.7, 0.75), 1), seen("shelf", (0.66, 0.17, 0.7), 2)
    side.label = LabelBelief()
    for view in range(2):
        side.label.update(looks_like, view=view)
    assert are_one(desk, side) is part
    assert is_part(side, desk) is part


@pytest.mark.parametrize(
    ("middle_x_m", "long_m", "whole", "several"),
    [(0.3, 1.0, False, True), (0.3, 1.0, True, False), (0.0, 0.5, False, False), (1.2, 1.0, False, False)],
)
def test_what_spans_two_pieces_of_a_row_is_no_third_unless_it_reaches_beyond_or_is_seen_whole(
    middle_x_m, long_m, whole, several
):
    stove, fridge = seen("stove", (0.6, 0.6, 0.9), 1), seen("fridge", (0.6, 0.6, 1.8), 2)
    fridge.place = SurfaceBelief.of(Box(np.array((0.65, 0.0, 0.9)), (0.6, 0.6, 1.8), 0.0))
    low = seen("counter", (long_m, 0.5, 0.5), 3)
    low.place = SurfaceBelief.of(Box(np.array((middle_x_m, 0.0, 0.3)), (long_m, 0.5, 0.5), 0.0))
    low.seen_whole = whole
    low.label = LabelBelief()
    low.label.update((("counter", 0.5),))
    stove.node_id, fridge.node_id = "stove_1", "fridge_1"
    assert ("several" in decision(low, [stove, fridge]).best.way) is several
    assert decision(low, []).best.hypothesis is Hypothesis.NEW


@pytest.mark.parametrize(
    ("label", "size_m", "known_as", "known_m", "part_of_it"),
    [
        ("stove", (0.62, 0.6, 0.9), "counter", (2.05, 0.6, 0.9), False),  # what is left is a counter still
        ("washing machine", (0.6, 0.6, 0.85), "counter", (1.7, 0.6, 0.9), False),
        ("stove", (0.3, 0.2, 0.9), "counter", (2.05, 0.6, 0.9), True),  # no stove is as narrow
        ("bin", (0.3, 0.3, 0.4), "toilet", (0.7, 0.4, 0.8), True),
        ("washing machine", (0.6, 0.6, 0.85), "fridge", (0.65, 0.65, 1.8), True),  # nothing would be left
        ("desk", (1.0, 0.6, 0.75), "table", (2.0, 0.8, 0.75), True),  # of any size: may be the same piece
    ],
)
def test_an_appliance_in_a_row_is_a_piece_of_its_own_though_never_seen_as_a_whole(
    label, size_m, known_as, known_m, part_of_it
):
    known, part = seen(known_as, known_m, 1), seen(label, size_m, 2)
    at_the_end = np.array(((known_m[0] - size_m[0]) / 2, 0.0, size_m[2] / 2))
    for view in ("left", "right"):
        part.label.update(((label, 0.97),), view=view)
    part.place = SurfaceBelief.of(Box(at_the_end, size_m, 0.0))
    part.seen_whole = False
    assert is_part(part, known) is part_of_it


def test_what_fills_the_place_of_one_and_lies_in_another_is_of_the_first_and_nobody_waits_to_tell():
    desk, stool = seen("desk", (1.4, 0.8, 0.75), 1), seen("stool", (0.45, 0.45, 0.7), 2)
    chair = seen("chair", (0.45, 0.45, 0.72), 3)
    chair.seen_whole = False
    for known in ([desk, stool], [stool, desk]):
        decided = decision(chair, known)
        assert {claim.known for claim in decided.claims} == {desk, stool, None}
        assert decided.best.known is stool
        assert not decided.waits
