"""The map of a room: walls, gaps, and rooms elsewhere."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import strategies as st

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import RoomStatus
from skills.geometry import Box2, Pose2
from skills.navigation.route import find_routes
from skills.obstacles.grid import Canvas
from skills.obstacles.local_map import draw_map
from skills.obstacles.surroundings import Surroundings
from skills.obstacles.walls import Walls

RADIUS_M = 0.28


points = st.tuples(st.floats(-2.4, 2.4), st.floats(-2.4, 2.4))


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


def test_of_a_room_that_was_not_seen_whole_an_arm_keeps_to_the_walls_that_are_known(flat):
    memory = flat().memory
    with memory.edit("test", 0.0) as tx:
        tx.put(replace(tx.snapshot.room("room_1"), status=RoomStatus.PARTIAL))
    assert Walls.of(memory.snapshot(), "room_1").tree is None
    known = Walls.known(memory.snapshot(), "room_1").points
    np.testing.assert_allclose(known[:, 0], 3.0, atol=1e-9)  # the one with the door
    assert np.ptp(known[:, 1]) > 4.5
    assert not (np.abs(known[:, 1]) < 0.4).any()
