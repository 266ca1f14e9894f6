"""Straight ways through a gap beside or aslant to its axis."""

from math import hypot, pi

import numpy as np
import pytest

from skills.goto.lanes import Lane, clear_lane
from skills.goto.settings import LaneSettings

LANES = LaneSettings()
HALF_M = 0.28


def wall(width_m):
    """Both jambs, and the wall's near face on both sides."""
    aside = np.arange(width_m / 2, width_m / 2 + 1.0, 0.03)
    near = np.stack([np.zeros_like(aside), aside], axis=1)
    depth = np.arange(0.0, LANES.wall_m + 0.01, 0.03)
    jamb = np.stack([depth, np.full_like(depth, width_m / 2)], axis=1)
    left = np.vstack([near, jamb])
    return np.vstack([left, left * (1.0, -1.0)])


def box(x_m, y_m, side_m=0.2):
    steps = np.linspace(-side_m / 2, side_m / 2, 8)
    return np.stack(np.meshgrid(x_m + steps, y_m + steps), axis=-1).reshape(-1, 2)


def lane_through(*things, width_m=1.0, base_x_m=-0.8):
    return clear_lane(np.vstack([wall(width_m), *things]), half_m=HALF_M, width_m=width_m, base_x_m=base_x_m)


def test_an_empty_gap_is_crossed_on_its_axis_and_one_too_narrow_not_at_all():
    assert lane_through() == Lane()
    assert lane_through(width_m=0.5) is None


def test_what_stands_beside_the_axis_is_passed_on_its_other_side():
    lane = lane_through(box(0.5, 0.3))
    assert lane.bearing_rad == 0.0
    assert lane.offset_m == pytest.approx(-0.09, abs=0.031)


@pytest.mark.parametrize("y_m", [-0.05, 0.0, 0.05])
def test_what_lies_right_before_the_gap_is_passed_aslant(y_m):
    things = box(-0.6, y_m)
    lane = lane_through(things)
    assert 0.2 < abs(lane.bearing_rad) < pi / 3
    for x_m in np.arange(-LANES.front_m, LANES.wall_m + LANES.beyond_m, 0.02):
        nearest_m = min(hypot(x_m - x, lane.y_m(x_m) - y) for x, y in np.vstack([things, wall(1.0)]))
        assert nearest_m > HALF_M - 0.01


def test_a_way_that_only_one_slant_leaves_is_found():
    things = np.vstack([wall(1.01), box(-0.37, 0.0, 0.1), box(-0.2, -0.4, 0.1), box(0.85, -0.6, 0.1)])
    lane = clear_lane(things, half_m=0.265, width_m=1.01, base_x_m=-0.68)
    assert lane is not None
    assert lane.is_clear(things, 0.265, -LANES.front_m)
    closed = np.vstack([things, box(-0.2, 0.4, 0.1)])
    assert clear_lane(closed, half_m=0.265, width_m=1.01, base_x_m=-0.68) is None


def test_what_fills_the_gap_leaves_no_lane():
    assert lane_through(box(0.1, 0.0, 0.6)) is None


def test_lanes_that_a_robot_cannot_tell_apart_are_alike():
    assert Lane(offset_m=0.1).is_like(Lane(offset_m=0.11))
    assert not Lane(offset_m=0.1).is_like(Lane(offset_m=0.1, bearing_rad=0.26))
