"""Laws of ways, distances and progress in the plane."""

from __future__ import annotations

from itertools import pairwise
from math import hypot, pi

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from skills.geometry import Box2, Pose2, inside_polygon
from skills.navigation.advance import Advance
from skills.navigation.pursuit import point_ahead
from skills.navigation.route import find_routes, path_length_m, sampled
from skills.obstacles.cells import CELL_M
from skills.obstacles.grid import Canvas

RADIUS_M = 0.28


coordinate = st.floats(-2.0, 2.0)


boxes = st.lists(
    st.builds(
        Box2, st.builds(Pose2, coordinate, coordinate, st.floats(-pi, pi)), st.floats(0.02, 1.5), st.floats(0.02, 1.5)
    ),
    max_size=6,
)


points = st.tuples(st.floats(-2.4, 2.4), st.floats(-2.4, 2.4))


def drawn(obstacles):
    canvas = Canvas.covering((-2.5, -2.5), (2.5, 2.5))
    for box in obstacles:
        canvas.block_box(box)
    return canvas.finish()


def gap_m(obstacles, at):
    return min((float(box.distance_m(np.atleast_2d(at)).min()) for box in obstacles), default=10.0)


@settings(max_examples=60)
@given(boxes, points, points)
def test_a_planned_path_never_comes_closer_to_a_box_than_the_radius(obstacles, start, goal):
    assume(gap_m(obstacles, start) > RADIUS_M + 0.08)
    path = find_routes(drawn(obstacles), start, RADIUS_M).path_to(goal)
    for a, b in pairwise(path):
        assert gap_m(obstacles, sampled(a, b, 0.02)) >= RADIUS_M - 1e-6
    if path:
        assert path[0] == start
        assert path[-1] == goal


@settings(max_examples=30)
@given(boxes, points, points)
def test_a_path_is_no_shorter_than_the_straight_line_and_empty_floor_gives_just_that(obstacles, start, goal):
    straight = hypot(goal[0] - start[0], goal[1] - start[1])
    path = find_routes(drawn(obstacles), start, RADIUS_M).path_to(goal)
    if path:
        assert path_length_m(path) >= straight - 1e-9
    free = find_routes(drawn([]), start, RADIUS_M).path_to(goal)
    assert path_length_m(free) <= straight + 0.1


def test_there_is_no_way_through_a_wall_and_one_through_a_gap():
    wall = [Box2(Pose2(0.0, 0.0), 0.1, 6.0)]
    assert find_routes(drawn(wall), (-1.0, 0.0), RADIUS_M).path_to((1.0, 0.0)) == ()
    gap = [Box2(Pose2(0.0, 1.75), 0.1, 2.5), Box2(Pose2(0.0, -1.75), 0.1, 2.5)]
    assert find_routes(drawn(gap), (-1.0, 0.0), RADIUS_M).path_to((1.0, 0.0)) != ()


@settings(max_examples=60)
@given(st.lists(points, min_size=1, max_size=30), points)
def test_clearance_is_the_distance_to_the_nearest_point_and_not_to_its_cell(some, at):
    canvas = Canvas.covering((-2.5, -2.5), (2.5, 2.5))
    cells = {tuple(np.rint((np.array(point) + 2.5) / CELL_M)): point for point in some}  # one a cell is kept
    canvas.block_points(np.array(list(cells.values())))
    grid = canvas.finish(exact_m=0.8)
    i, j = grid.cells(np.array([at]))[0]
    center = np.array(grid.center((int(i), int(j))))
    true_m = min(hypot(*(center - point)) for point in cells.values())
    if 2 * CELL_M < true_m < 0.8 - CELL_M:
        assert grid.clearance_m[i, j] == pytest.approx(true_m, abs=1e-3)


def test_a_robot_too_close_to_a_table_finds_its_way_off_without_getting_closer():
    table = [Box2(Pose2(0.0, 0.8), 1.2, 0.8)]
    path = find_routes(drawn(table), (0.0, 0.14), RADIUS_M).path_to((0.0, -1.5))
    assert path
    assert min(gap_m(table, sampled(a, b)) for a, b in pairwise(path)) >= 0.22


@example(corners=[(0.0, 1.0), (1.0, 0.0), (-1.0, 2.2250738585072014e-308)], point=(0.0, 2.0))
@given(st.lists(points, min_size=3, max_size=6), points)
def test_inside_agrees_with_the_winding_of_a_convex_polygon(corners, point):
    from scipy.spatial import ConvexHull, QhullError

    try:
        hull = ConvexHull(np.array(corners))
    except QhullError:
        assume(False)
    offsets = hull.equations[:, :2] @ point + hull.equations[:, 2]
    assume(np.abs(offsets).min() > 1e-6)
    polygon = [tuple(corner) for corner in np.array(corners)[hull.vertices]]
    assert bool(inside_polygon(polygon, np.array([point]))[0]) == bool((offsets < 0).all())


@given(st.builds(Pose2, coordinate, coordinate, st.floats(-4.0, 4.0)), st.lists(points, min_size=1, max_size=5))
def test_pose_maps_there_and_back(pose, some):
    array = np.array(some)
    np.testing.assert_allclose(pose.inverse_apply(pose.apply(array)), array, atol=1e-9)


def test_point_ahead_walks_along_the_path():
    path = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0))
    assert point_ahead(path, (0.5, 0.2), 0.8)[0] == pytest.approx((1.0, 0.3))
    assert point_ahead(path, (0.5, 0.2), 0.8)[1] == pytest.approx(1.5)
    assert point_ahead(path, (0.5, 0.2), 9.0)[0] == pytest.approx((1.0, 1.0))


def test_a_robot_sent_back_and_forth_between_two_ways_is_astray_though_each_time_it_comes_further():
    advance, stamp_s = Advance(stamp_s=0.0), 0.0
    for _ in range(5):
        for start_m in (3.0, 9.0):
            for step in range(20):
                stamp_s += 0.1
                advance.note(start_m - 0.05 * step, stamp_s, turning=step < 5)
    assert advance.astray


def test_a_long_way_around_and_the_detours_on_it_lead_nobody_astray():
    advance, stamp_s = Advance(stamp_s=0.0), 0.0
    for start_m, end_m in ((3.0, 2.0), (9.0, 5.0), (7.0, 3.0), (4.5, 1.0), (2.0, 0.5), (1.5, 0.0)):
        for remaining_m in np.arange(start_m, end_m, -0.05):
            stamp_s += 0.1
            advance.note(float(remaining_m), stamp_s, turning=False)
            assert not advance.astray
    assert stamp_s - advance.stamp_s < 0.2
