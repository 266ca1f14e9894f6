"""Laws of furniture as the hand meets it, whatever kind and size it is of."""

from __future__ import annotations

from itertools import pairwise
from math import inf, pi

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from scene_graph.nodes import ObjectNode
from skills.arm.hand import Hand
from skills.furniture.furniture import Entry, Furniture
from skills.furniture.kinds import KINDS, is_container
from skills.outline import disc
from skills.place.place_spot import spots_on
from skills.place.settings import SpotSettings

LABELS = (*KINDS, "table", "shelf", "trash_can")
sizes = st.tuples(st.floats(0.3, 2.0), st.floats(0.3, 2.0), st.floats(0.3, 2.0))
shares = st.lists(st.floats(0.1, 1.0), max_size=5, unique=True).map(sorted)
directions = st.none() | st.sampled_from([0.0, pi / 2, pi, -pi / 2])


def node(label, size_m, boards=(), back_rad=None, back_share=None):
    back_m = None if back_share is None else back_share * min(size_m[:2]) / 2
    surfaces_m = tuple(share * size_m[2] for share in boards)
    return ObjectNode(id="it_1", label=label, size_m=size_m, surfaces_m=surfaces_m, back_rad=back_rad, back_m=back_m)


furnishings = st.builds(node, st.sampled_from(LABELS), sizes, shares, directions, st.none() | st.floats(0.3, 0.9))


@given(furnishings)
def test_surfaces_lie_one_over_the_other_within_the_box_and_only_the_highest_is_open_above(it):
    surfaces, half_m = Furniture.of(it).surfaces, it.size_m[2] / 2
    for below, above in pairwise(surfaces):
        assert -half_m <= below.height_m < above.height_m <= half_m + 1e-9
        assert below.free_m < above.height_m - below.height_m
        assert below.entry is Entry.LEVEL
    assert surfaces[-1].entry is not Entry.LEVEL
    assert surfaces[-1].free_m == inf


@given(furnishings)
def test_what_stands_on_a_surface_is_found_there(it):
    furniture = Furniture.of(it)
    assert all(furniture.surface_at(surface.height_m) == surface for surface in furniture.surfaces)


@given(furnishings, st.floats(-1.0, 1.0), st.floats(0.0, 0.1), st.integers(0, 99))
def test_what_is_met_is_met_lower_and_with_more_air_too(it, low_m, air_m, seed):
    furniture = Furniture.of(it)
    points = np.random.default_rng(seed).uniform(-1.0, 1.0, (50, 2)) * furniture.half_m
    met = furniture.met(points, low_m)
    assert not (met & ~furniture.met(points, low_m - 0.1)).any()
    assert not (met & ~furniture.met(points, low_m, air_m=air_m)).any()
    assert not furniture.met(points, it.size_m[2] / 2).any()


@given(furnishings)
def test_backs_and_arms_rise_over_the_surface_and_leave_the_box_only_where_nobody_knows_better(it):
    furniture = Furniture.of(it)
    for rim in furniture.suspects:
        assert furniture.surfaces[0].height_m <= rim.top_m <= it.size_m[2] / 2 + 1e-9
        assert rim.half_m == it.size_m[rim.axis] / 2
        assert furniture.beside(rim, np.zeros(2)).thick_m <= rim.thick_m


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(furnishings, st.tuples(st.floats(0.04, 0.2), st.floats(0.04, 0.2), st.floats(0.03, 0.3)))
def test_a_spot_lies_on_its_surface_off_the_edges_and_before_a_back_that_was_measured(flat, it, size_m):
    built = flat().thing(
        it.label.replace(" ", "_") + "_1", (0.0, 0.0, it.size_m[2] / 2), it.size_m, support=True,
        surfaces_m=it.surfaces_m, back_rad=it.back_rad, back_m=it.back_m,
    )  # fmt: skip
    name = it.label.replace(" ", "_") + "_1"
    furniture = Furniture.of(built.memory.snapshot().object(name))
    for spot in spots_on(built.memory.snapshot(), name, size_m, None):
        assert spot.surface in furniture.surfaces
        assert spot.surface.free_m > size_m[2]
        if spot.inside or spot.turn_rad is not None:
            continue
        at, radius_m = np.array(spot.anchor.point_m[:2]), disc(size_m).radius_m
        assert (np.abs(at) + radius_m <= furniture.half_m - SpotSettings().edge_m + 1e-9).all()
        for rim in (rim for rim in furniture.obstacles if rim.is_measured):
            assert rim.sign * at[rim.axis] + radius_m <= rim.half_m - rim.thick_m


@given(st.floats(0.03, 0.3), st.floats(0.0, 0.3), st.floats(-pi / 2, 0.0), st.floats(0.0, 0.2))
def test_a_higher_thing_or_one_held_higher_needs_no_less_room(height_m, above_m, pitch_rad, more_m):
    hand = Hand()
    needed_m = hand.headroom_m(height_m, above_m, pitch_rad)
    assert hand.headroom_m(height_m + more_m, above_m, pitch_rad) >= needed_m
    assert hand.headroom_m(height_m, above_m + more_m, pitch_rad) >= needed_m


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.floats(0.2, 0.5), st.floats(0.05, 0.2), st.floats(0.3, 1.2), st.floats(0.0, 0.3), st.floats(0.05, 0.45))
def test_what_fits_in_between_boards_fits_in_between_wider_and_higher_ones(
    flat, gap_m, more_m, wide_m, wider_m, high_m
):
    def fits(gap_m, wide_m):
        size_m, boards_m = (wide_m, 0.35, 0.4 + 2 * gap_m), (0.4, 0.4 + gap_m)
        built = flat().thing("shelf_1", (0.0, 0.0, size_m[2] / 2), size_m, support=True, surfaces_m=boards_m)
        spots = spots_on(built.memory.snapshot(), "shelf_1", (0.08, 0.08, high_m), None)
        return any(spot.is_covered for spot in spots)

    assert fits(gap_m + more_m, wide_m + wider_m) or not fits(gap_m, wide_m)


@pytest.mark.parametrize(
    ("label", "inside"), [("bowl", True), ("trash_can", True), ("cabinet", True), ("table", False)]
)
def test_things_are_put_in_containers_closed_ones_included(label, inside):
    assert is_container(label) is inside
