"""Laws of free spots: on the support, off the edge, off the neighbors."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from skills.furniture.standing import surfaces_of
from skills.geometry import Box2, Pose2
from skills.outline import disc
from skills.place.place_spot import spots_on
from skills.place.settings import SpotSettings

SETTINGS = SpotSettings()

neighbors = st.lists(
    st.tuples(
        st.floats(-0.5, 0.5), st.floats(-0.3, 0.3), st.floats(-3.0, 3.0), st.floats(0.04, 0.3), st.floats(0.04, 0.3)
    ),
    max_size=6,
)
sizes = st.tuples(st.floats(0.04, 0.25), st.floats(0.04, 0.25), st.floats(0.05, 0.3))


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(neighbors, sizes)
def test_spots_lie_on_the_support_and_overlap_nothing(flat, things, size):
    built = flat().table("table_1", 1.0, 1.2)
    for k, (x, y, yaw, sx, sy) in enumerate(things):
        built.thing(f"box_{k + 1}", (1.0 + x, 1.2 + y, 0.85), (sx, sy, 0.2), yaw=yaw, on="table_1")
    snapshot = built.memory.snapshot()
    radius = disc(size).radius_m
    for spot in spots_on(snapshot, "table_1", size, None):
        x, y, z = spot.anchor.point_m
        if spot.turn_rad is not None:
            continue
        assert abs(x) + radius <= 0.6 - SETTINGS.edge_m + 1e-9
        assert abs(y) + radius <= 0.4 - SETTINGS.edge_m + 1e-9
        assert z == 0.375
        for bx, by, yaw, sx, sy in things:
            air = Box2(Pose2(bx, by, yaw), sx, sy).distance_m(np.array([[x, y]]))[0] - radius
            assert air >= SETTINGS.gap_m - 1e-6
            assert spot.room_m <= air + 1e-6


@settings(max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(neighbors, st.tuples(st.floats(0.12, 0.22), st.floats(0.04, 0.09), st.floats(0.02, 0.06)))
def test_what_is_laid_so_that_it_fits_lies_on_the_support_and_overlaps_nothing(flat, things, size):
    built = flat().thing("nightstand_1", (1.0, 1.2, 0.28), (0.45, 0.4, 0.56), support=True)
    for k, (x, y, yaw, sx, sy) in enumerate(things):
        built.thing(f"box_{k + 1}", (1.0 + x / 3, 1.2 + y / 3, 0.61), (sx / 2, sy / 2, 0.1), yaw=yaw, on="nightstand_1")
    for spot in spots_on(built.memory.snapshot(), "nightstand_1", size, None):
        if spot.turn_rad is None:
            continue
        x, y, _ = spot.anchor.point_m
        half = np.array(size[:2] if spot.turn_rad == 0.0 else size[1::-1]) / 2
        assert (np.abs([x, y]) + half <= np.array([0.225, 0.2]) - SETTINGS.edge_m + 1e-9).all()
        across = np.linspace(-1.0, 1.0, 9)
        covered = np.array([x, y]) + half * np.array([[a, b] for a in across for b in across])
        for bx, by, yaw, sx, sy in things:
            assert Box2(Pose2(bx / 3, by / 3, yaw), sx / 2, sy / 2).distance_m(covered).min() >= SETTINGS.gap_m - 1e-6


def test_a_phone_is_laid_beside_the_clock_in_the_middle_of_a_nightstand(flat):
    built = flat().thing("nightstand_1", (0.0, 0.0, 0.28), (0.47, 0.43, 0.56), support=True)
    built.thing("clock_1", (0.0, 0.0, 0.62), (0.1, 0.09, 0.11), on="nightstand_1")
    spots = spots_on(built.memory.snapshot(), "nightstand_1", (0.15, 0.07, 0.02), None)
    assert {spot.turn_rad for spot in spots} == {0.0, np.pi / 2}
    lengthwise = [spot.anchor.point_m for spot in spots if spot.turn_rad == 0.0]
    assert all(abs(y) > 0.045 + 0.035 + SETTINGS.gap_m for _, y, _ in lengthwise)


def test_the_first_spots_of_a_table_are_not_at_its_edge(flat):
    spots = spots_on(flat().table().memory.snapshot(), "table_1", (0.08, 0.08, 0.2), None)
    assert all(spot.air_m >= SETTINGS.ample_m - 1e-9 for spot in spots[:20])
    x, y, _ = np.abs([spot.anchor.point_m for spot in spots]).T
    assert [spot.edge_m for spot in spots] == pytest.approx(np.minimum(0.6 - x, 0.4 - y) - 0.04)
    assert min(spot.edge_m for spot in spots) < 0.05


def test_a_full_table_has_no_spot(flat):
    built = flat().table().thing("box_1", (1.0, 1.2, 0.85), (1.1, 0.7, 0.2), on="table_1")
    assert spots_on(built.memory.snapshot(), "table_1", (0.08, 0.08, 0.2), None) == []


def test_an_empty_table_has_many_and_what_is_held_does_not_count(flat):
    built = flat().table().thing("box_1", (1.0, 1.2, 0.85), (1.1, 0.7, 0.2), on="table_1")
    assert len(spots_on(built.memory.snapshot(), "table_1", (0.08, 0.08, 0.2), "box_1")) > 50


def test_too_big_for_the_support_is_no_spot(flat):
    built = flat().thing("stool_1", (0.0, 0.0, 0.2), (0.3, 0.3, 0.4), support=True)
    assert spots_on(built.memory.snapshot(), "stool_1", (0.3, 0.3, 0.1), None) == []
    assert spots_on(built.memory.snapshot(), "stool_1", (0.1, 0.1, 0.1), None) != []


def test_a_container_is_filled_over_its_center(flat):
    built = flat().table().thing("bowl_1", (1.0, 1.2, 0.8), (0.3, 0.3, 0.1), on="table_1")
    (spot,) = spots_on(built.memory.snapshot(), "bowl_1", (0.06, 0.06, 0.06), None)
    assert spot.inside
    assert spot.anchor.point_m == (0.0, 0.0, 0.05)


def test_unrelated_things_above_the_top_are_respected_too(flat):
    """A relation may be missing from the graph; geometry tells as well."""
    built = flat().table().thing("box_1", (1.0, 1.2, 0.85), (1.1, 0.7, 0.2))
    assert spots_on(built.memory.snapshot(), "table_1", (0.08, 0.08, 0.2), None) == []


def test_a_seat_is_lower_than_its_back_and_what_stands_there_tells_better(flat):
    built = flat().thing("chair_1", (0.0, 0.0, 0.45), (0.45, 0.45, 0.9), support=True)
    assert surfaces_of(built.memory.snapshot(), "chair_1", None)[0].height_m == 0.0
    built.thing("box_1", (0.0, 0.0, 0.52), (0.1, 0.1, 0.1), on="chair_1")
    assert abs(surfaces_of(built.memory.snapshot(), "chair_1", None)[0].height_m - 0.02) < 1e-9


def test_a_table_is_its_top(flat):
    assert surfaces_of(flat().table().bottle().memory.snapshot(), "table_1", None)[0].height_m == 0.375


def test_nothing_is_put_on_the_arms_or_the_back_of_a_sofa(flat):
    built = flat().thing("sofa_1", (0.0, 0.0, 0.4), (1.8, 0.9, 0.8), support=True)
    spots = spots_on(built.memory.snapshot(), "sofa_1", (0.08, 0.08, 0.1), None)
    assert spots
    for spot in spots:
        x, y, z = spot.anchor.point_m
        assert abs(x) <= 0.9 - 0.2 - 0.04
        assert abs(y) <= 0.45 - 0.22 - 0.04
        assert z == 0.0


@pytest.mark.parametrize("back_rad", [0.0, pi / 2, pi, -pi / 2])
def test_what_is_put_on_a_chair_stays_clear_of_its_back(flat, back_rad):
    """A book, brought over the seat at the height of the back, met it and was lost out of the hand."""
    back = {"back_rad": back_rad, "back_m": 0.17}
    built = flat().thing("chair_1", (0.0, 0.0, 0.45), (0.45, 0.45, 0.9), support=True, **back)
    size_m = (0.2, 0.09, 0.04)
    spots = spots_on(built.memory.snapshot(), "chair_1", size_m, None)
    toward = [spot.anchor.point_m[0] * cos(back_rad) + spot.anchor.point_m[1] * sin(back_rad) for spot in spots]
    assert spots
    assert max(toward) + disc(size_m).radius_m <= 0.17 - 0.03 + 1e-9
    assert min(toward) < -0.02


def test_a_chair_of_which_the_back_leaves_no_room_is_full(flat):
    built = flat().thing("chair_1", (0.0, 0.0, 0.45), (0.45, 0.45, 0.9), support=True, back_rad=pi / 2, back_m=-0.1)
    assert spots_on(built.memory.snapshot(), "chair_1", (0.2, 0.18, 0.04), None) == []


def test_a_narrow_chair_is_used_in_its_middle(flat):
    built = flat().thing("chair_1", (0.0, 0.0, 0.45), (0.2, 0.2, 0.9), support=True)
    assert {spot.anchor.point_m[:2] for spot in spots_on(built.memory.snapshot(), "chair_1", (0.1, 0.1, 0.1), None)}


@pytest.mark.parametrize(
    ("label", "inside"), [("cabinet", False), ("refrigerator", False), ("box", True), ("bin", True)]
)
def test_what_is_brought_to_a_cabinet_is_put_beside_what_stands_on_it_and_what_goes_into_a_box_is_dropped(
    flat, label, inside
):
    built = flat().thing(f"{label}_1", (0.0, 0.0, 0.45), (0.9, 0.5, 0.9), support=True)
    built.thing("cup_1", (0.0, 0.0, 0.95), (0.08, 0.08, 0.1), on=f"{label}_1", graspable=True)
    spots = spots_on(built.memory.snapshot(), f"{label}_1", (0.07, 0.07, 0.24), None)
    assert spots
    assert all(spot.inside is inside for spot in spots)
    assert inside or min(np.hypot(*spot.anchor.point_m[:2]) for spot in spots) > 0.08
