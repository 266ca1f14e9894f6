"""What is remembered of obstacles around the robot, and for how long."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np
import pytest
from hypothesis import strategies as st

from scene_graph.geometry.se3 import SE3
from skills.geometry import Box2, Pose2
from skills.obstacles.surroundings import Surroundings
from skills.ports import FloorReturns

points = st.tuples(st.floats(-2.4, 2.4), st.floats(-2.4, 2.4))


def ring_points(x, y, z, count=40):
    angles = np.linspace(0, 2 * pi, count, endpoint=False)
    return np.array([[x + 0.02 * cos(a), y + 0.02 * sin(a), z] for a in angles])


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


def test_a_person_who_walks_by_leaves_no_footprints():
    around = Surroundings(frame="room_1")
    for step in range(20):
        feet, torso = ring_points(1.0, 0.1 * step, 0.3), ring_points(1.02, 0.1 * step, 1.4)
        around.observe(np.concatenate([feet, torso]), SE3.identity(), 0.1 * step)
    around.observe(np.zeros((0, 3)), SE3.identity(), 3.0)
    assert len(around.points()) == 0


def test_what_lies_where_the_lidar_looks_over_it_is_remembered_longer():
    around = Surroundings(frame="room_1")
    around.observe(ring_points(0.6, 0.0, 0.3), SE3.identity(), 0.0)
    around.observe(np.zeros((0, 3)), SE3.identity(), 60.0)
    np.testing.assert_allclose(around.points().mean(axis=0), [0.6, 0.0], atol=0.04)
    around.observe(np.zeros((1, 3)), SE3.from_xyz_yaw(-1.0, 0.0, 0.0, 0.0), 61.0)
    assert len(around.points()) == 0
