"""Laws of the grid, the routes on it, the memory of obstacles, and the last check before a velocity is sent."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import cos, hypot, pi, sin

import numpy as np
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import RoomStatus
from skills.geometry import Box2, Pose2, inside_polygon
from skills.navigation.advance import Advance
from skills.navigation.grid import CELL_M, EXACT_M, Canvas
from skills.navigation.local_map import draw_map
from skills.navigation.pursuit import point_ahead
from skills.navigation.route import find_routes, path_length_m, sampled
from skills.navigation.safety import admissible, retreat
from skills.navigation.surroundings import Surroundings
from skills.navigation.walls import Walls
from skills.ports import BodyLimits, FloorReturns

LIMITS = BodyLimits()
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
    grid = canvas.finish()
    i, j = grid.cells(np.array([at]))[0]
    center = np.array(grid.center((int(i), int(j))))
    true_m = min(hypot(*(center - point)) for point in cells.values())
    if 2 * CELL_M < true_m < EXACT_M - CELL_M:
        assert grid.clearance_m[i, j] == pytest.approx(true_m, abs=1e-3)


def blurred_side(rng, x_m, count=60):
    """Returns off a surface along y, with the noise that is left of usual ranges once neighbors are averaged."""
    return np.column_stack([x_m + rng.normal(0.0, 0.009, count), rng.uniform(-0.3, 0.3, count), np.full(count, 0.4)])


@pytest.mark.parametrize("shift_m", np.arange(0.0, 0.04, 0.007).tolist())
@pytest.mark.parametrize(("width_m", "passes"), [(0.66, True), (0.54, False)])
def test_a_gap_is_passed_or_not_wherever_it_lies_on_the_grid_and_however_often_it_was_seen(width_m, passes, shift_m):
    rng, around = np.random.default_rng(1), Surroundings(frame="room_1")
    for scan in range(100):
        sides = [blurred_side(rng, shift_m + side * width_m / 2) for side in (-1.0, 1.0)]
        around.observe(np.concatenate(sides), SE3.from_xyz_yaw(0.0, 0.0, 0.0, 0.0), 0.1 * scan)
    canvas = Canvas.covering((-2.0, -2.0), (2.0, 2.0))
    canvas.block_box(Box2(Pose2(-1.3 - width_m / 2 + shift_m, 0.0), 2.6 - 0.1, 0.3))
    canvas.block_box(Box2(Pose2(1.3 + width_m / 2 + shift_m, 0.0), 2.6 - 0.1, 0.3))
    canvas.block_points(around.points())
    assert bool(find_routes(canvas.finish(), (0.0, -1.2), RADIUS_M).path_to((0.0, 1.2))) is passes


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


@given(st.floats(0.05, 0.6), st.floats(-1.0, 1.0), st.lists(points, min_size=1, max_size=30))
def test_an_admitted_velocity_stops_before_touching(linear, angular, some):
    obstacles = np.array(some)
    assume(np.hypot(*obstacles.T).min() > 0.27)
    v, w = admissible(linear, angular, obstacles, 0.26, LIMITS)
    pose = Pose2(0.0, 0.0)
    while v > 0:  # brakes at the limit along the same arc
        pose = pose.advanced(v * 0.02, w * 0.02)
        slower = max(v - LIMITS.linear_mps2 * 0.02, 0.0)
        v, w = slower, w * slower / v
        assert np.hypot(*(obstacles - pose.point).T).min() > 0.25


def test_turning_in_place_is_always_admitted():
    assert admissible(0.0, 0.8, np.array([[0.1, 0.0]]), 0.26, LIMITS) == (0.0, 0.8)


def test_a_robot_that_stands_too_close_may_back_away_but_not_advance():
    ahead = np.array([[0.2, 0.0]])
    assert admissible(0.3, 0.0, ahead, 0.26, LIMITS)[0] == 0.0
    assert admissible(-0.3, 0.0, ahead, 0.26, LIMITS)[0] == -0.3


def test_a_robot_that_came_too_close_backs_away_where_that_leads_off_and_stays_where_it_does_not():
    ahead, behind = np.array([[0.2, 0.1]]), np.array([[-0.24, 0.0]])
    assert retreat(ahead, 0.28, LIMITS) < 0.0
    assert retreat(np.concatenate([ahead, behind]), 0.28, LIMITS) == 0.0
    assert retreat(np.array([[0.5, 0.0]]), 0.28, LIMITS) == 0.0


def ring_points(x, y, z, count=40):
    angles = np.linspace(0, 2 * pi, count, endpoint=False)
    return np.array([[x + 0.02 * cos(a), y + 0.02 * sin(a), z] for a in angles])


def test_low_obstacles_are_remembered_and_tall_ones_fade():
    around = Surroundings(frame="room_1")
    around.observe(np.concatenate([ring_points(1.0, 0.0, 0.3), ring_points(0.0, 1.0, 1.4)]), SE3.identity(), 0.0)
    assert len(around.points()) > 4
    around.observe(np.zeros((0, 3)), SE3.identity(), 5.0)
    remembered = around.points()
    np.testing.assert_allclose(remembered.mean(axis=0), [1.0, 0.0], atol=0.04)
    around.observe(np.zeros((1, 3)), SE3.identity(), 70.0)
    assert len(around.points()) == 0


def test_a_low_obstacle_that_was_taken_away_is_gone_as_soon_as_the_floor_is_seen_there():
    rng, around, thing = np.random.default_rng(2), Surroundings(frame="room_1"), Box2(Pose2(2.05, 0.0), 0.1, 0.1)
    around.observe(ring_points(2.05, 0.0, 0.3), SE3.identity(), 0.0)
    for scan in range(20):  # seen together with it, the floor before it means nothing
        around.observe(ring_points(2.05, 0.0, 0.3), SE3.identity(), 0.1 * scan)
        around.observe_floor(floor_returns(rng, (thing, 0.0)), SE3.identity(), 0.1 * scan)
    assert len(around.points()) > 0
    for scan in range(50, 150):  # while the robot backs away, the rings sweep the place
        base = SE3.from_xyz_yaw(0.002 * (100 - scan), 0.0, 0.0, 0.0)
        around.observe_floor(floor_returns(rng, (thing, 0.0)), base, 0.1 * scan)
    assert len(around.points()) == 0


def test_obstacles_stay_in_place_when_the_frame_changes():
    around = Surroundings(frame="room_1")
    around.observe(ring_points(1.0, 0.5, 0.3), SE3.from_xyz_yaw(1.0, 0.0, 0.0, pi / 2), 0.0)
    np.testing.assert_allclose(around.points().mean(axis=0), [0.5, 1.0], atol=0.04)
    around.move_to("room_2", SE3.from_xyz_yaw(-3.0, 0.0, 0.0, 0.0))
    np.testing.assert_allclose(around.points().mean(axis=0), [-2.5, 1.0], atol=0.06)


def test_floor_ceiling_and_a_single_stray_hit_are_no_obstacles():
    around = Surroundings(frame="room_1")
    stray = np.array([[1.0, 1.0, 0.5]])
    around.observe(np.concatenate([ring_points(1, 0, 0.0), ring_points(0, 1, 2.2), stray]), SE3.identity(), 0.0)
    assert len(around.points()) == 0


def floor_returns(rng, thing, noise_m=0.02, sensor_m=1.6):
    """One scan of a floor on which ``thing``, a box of ``height_m``, lies; the rays of three steep rings."""
    box, height_m = thing
    angles = np.arange(900) * (2 * pi / 900)
    distance_m = np.concatenate([np.full(900, sensor_m / np.tan(np.radians(e))) for e in (60.0, 48.0, 38.0)])
    spots = distance_m[:, None] * np.column_stack([np.tile(np.cos(angles), 3), np.tile(np.sin(angles), 3)])
    z_m = np.where(box.contains(spots), height_m, 0.0)
    z_m += rng.normal(0.0, noise_m, len(spots)) * sensor_m / np.hypot(sensor_m, distance_m)
    near = np.abs(z_m) < 0.06
    return FloorReturns(
        spots_m=spots[near], points_m=np.column_stack([spots * (1 - z_m / sensor_m)[:, None], z_m])[near]
    )


@pytest.mark.parametrize(("noise_m", "told"), [(0.02, True), (0.05, False)])
def test_driving_up_to_a_thing_of_two_centimeters_shows_it_unless_noise_hides_it_and_never_more(noise_m, told):
    rng, around, thing = np.random.default_rng(2), Surroundings(frame="room_1"), Box2(Pose2(3.0, 0.1, 0.4), 0.2, 0.2)
    for step in range(100):  # at 0.2 m/s
        base = Pose2(0.02 * step, 0.0)
        x_m, y_m = base.inverse_apply(np.array([thing.pose.point]))[0]
        returns = floor_returns(rng, (Box2(Pose2(x_m, y_m, 0.4), 0.2, 0.2), 0.024), noise_m)
        around.observe_floor(returns, SE3.from_xyz_yaw(base.x_m, 0.0, 0.0, 0.0), 0.1 * step)
    found = around.points()
    assert (len(found) >= 4) is told
    assert not len(found) or thing.distance_m(found).max() < 0.08


def test_what_is_low_stays_in_place_when_the_frame_changes():
    rng, around, thing = np.random.default_rng(2), Surroundings(frame="room_1"), Box2(Pose2(2.05, 0.0), 0.2, 0.2)
    for _ in range(40):
        around.observe_floor(floor_returns(rng, (thing, 0.024)), SE3.identity(), 0.0)
    before = around.points()
    around.move_to("room_2", SE3.from_xyz_yaw(1.0, 0.0, 0.0, 0.0))
    np.testing.assert_allclose(around.points().mean(axis=0), before.mean(axis=0) + np.array([1.0, 0.0]), atol=0.01)
    around.forget()
    assert len(around.points()) == 0


def test_an_arm_that_reaches_down_is_nothing_on_the_floor():
    rng, hand = np.random.default_rng(2), Box2(Pose2(0.95, 0.0), 0.15, 0.1)
    for reach_m in (0.0, 1.1):
        around = Surroundings(frame="room_1")
        for _ in range(40):
            around.observe_floor(floor_returns(rng, (hand, 0.03)), SE3.identity(), 0.0, reach_m)
        assert (len(around.points()) > 0) is (reach_m == 0.0)


def test_a_thing_that_was_taken_away_is_forgotten_once_the_floor_is_seen_again():
    rng, around, thing = np.random.default_rng(2), Surroundings(frame="room_1"), Box2(Pose2(2.05, 0.0), 0.2, 0.2)
    for height_m, scans in ((0.024, 40), (0.0, 60)):
        for _ in range(scans):
            around.observe_floor(floor_returns(rng, (thing, height_m)), SE3.identity(), 0.0)
        assert (len(around.points()) > 0) is (height_m > 0.0)


def test_point_ahead_walks_along_the_path():
    path = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0))
    assert point_ahead(path, (0.5, 0.2), 0.8)[0] == pytest.approx((1.0, 0.3))
    assert point_ahead(path, (0.5, 0.2), 0.8)[1] == pytest.approx(1.5)
    assert point_ahead(path, (0.5, 0.2), 9.0)[0] == pytest.approx((1.0, 1.0))


def test_a_person_who_walks_by_leaves_no_footprints():
    around = Surroundings(frame="room_1")
    for step in range(20):
        feet, torso = ring_points(1.0, 0.1 * step, 0.3), ring_points(1.02, 0.1 * step, 1.4)
        around.observe(np.concatenate([feet, torso]), SE3.identity(), 0.1 * step)
    around.observe(np.zeros((0, 3)), SE3.identity(), 3.0)
    assert len(around.points()) == 0


def test_noise_on_a_known_wall_is_put_onto_the_wall_and_a_box_before_it_is_not(flat):
    snapshot = flat().memory.snapshot()
    blurred, box = np.array([[-2.95, 0.5], [-3.04, 0.6]]), np.array([[-2.6, 0.5]])
    kept = Walls.of(snapshot, "room_1").explain(np.concatenate([blurred, box]))
    assert (np.hypot(*(kept - box[0]).T) < 1e-9).any()
    near = kept[np.hypot(*(kept - (-3.0, 0.55)).T) < 0.2]
    np.testing.assert_allclose(near[:, 0], -3.0, atol=1e-9)


def test_a_door_gap_is_no_wall(flat):
    walls = Walls.of(flat().memory.snapshot(), "room_1").points
    assert not ((np.abs(walls[:, 1]) < 0.4) & (walls[:, 0] > 2.9)).any()
    assert ((np.abs(walls[:, 1]) > 0.5) & (walls[:, 0] > 2.9)).any()


@pytest.mark.parametrize(("status", "free"), [(RoomStatus.PERMANENT, False), (RoomStatus.PARTIAL, True)])
def test_a_wall_that_was_only_guessed_is_not_in_the_way(flat, status, free):
    memory = flat().memory
    with memory.edit("test", 0.0) as tx:
        tx.put(replace(tx.snapshot.room("room_1"), status=status))
    snapshot, spots = memory.snapshot(), [(0.0, 0.0), (-2.0, 0.0)]
    walls = Walls.of(snapshot, "room_1")
    grid = draw_map(snapshot, "room_1", np.zeros((0, 2)), spots, walls=walls, stamp_s=0.0, believe_furniture=False)
    beyond = [min(x for x, _ in snapshot.room("room_1").polygon_m) - 0.3, -1.0]
    assert bool(grid.clearance_at(np.array([beyond]))[0] > 0.15) is free


def test_no_way_leads_back_through_a_room_that_was_left_to_a_place_behind_its_walls(flat):
    snapshot = flat().memory.snapshot()
    walls = Walls.of(snapshot, "room_1")
    nothing = np.zeros((0, 2))
    inside, in_the_gap, behind = (1.0, 1.0), (2.95, 0.0), (4.2, 2.0)
    robot = (4.2, 0.0)
    away = draw_map(snapshot, "room_1", nothing, [robot, behind, inside], walls=walls, stamp_s=0.0)
    assert away.clearance_at(np.array([inside])) == 0.0
    assert away.clearance_at(np.array([in_the_gap])) > 0.0
    back = draw_map(snapshot, "room_1", nothing, [robot, inside, behind], walls=walls, stamp_s=0.0)
    assert back.clearance_at(np.array([inside])) > 0.5


def test_no_way_between_two_places_of_a_room_leads_through_another(flat):
    memory = flat().memory
    with memory.edit("test", 0.0) as tx:  # of room_1, much is guessed; room_2 behind its door is known
        tx.put(replace(tx.snapshot.room("room_1"), status=RoomStatus.PARTIAL))
    snapshot, spots = memory.snapshot(), [(2.0, 1.0), (2.0, -1.0)]
    grid = draw_map(
        snapshot,
        "room_1",
        np.zeros((0, 2)),
        spots,
        walls=Walls.of(snapshot, "room_1"),
        stamp_s=0.0,
        believe_furniture=False,
    )
    in_the_gap, behind = (2.95, 0.0), (3.9, 1.0)
    assert grid.clearance_at(np.array([behind])) == 0.0
    assert grid.clearance_at(np.array([in_the_gap])) > 0.0


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


def test_what_lies_where_the_lidar_looks_over_it_is_remembered_longer():
    around = Surroundings(frame="room_1")
    around.observe(ring_points(0.6, 0.0, 0.3), SE3.identity(), 0.0)
    around.observe(np.zeros((0, 3)), SE3.identity(), 60.0)
    np.testing.assert_allclose(around.points().mean(axis=0), [0.6, 0.0], atol=0.04)
    around.observe(np.zeros((1, 3)), SE3.from_xyz_yaw(-1.0, 0.0, 0.0, 0.0), 61.0)
    assert len(around.points()) == 0
