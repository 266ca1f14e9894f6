"""Outlines of rooms from a few views."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from perception.geometry.planar import Pose2
from perception.geometry.polygon import signed_area, wall_lengths
from perception.rooms.outline.entrance import entrance
from perception.rooms.outline.outline import (
    ArrangementSettings,
    _center,
    _false_step,
    _MeasuredWall,
    _straightened,
)
from perception.rooms.views.view import dominant_direction
from unit.perception.lidar_house import Array, Door, House, l_shape, rectangle, t_shape, turned, u_shape
from unit.perception.rooms.viewed_rooms import approach, corner_error_m, outline_from, view_at


@pytest.mark.parametrize(
    ("polygon", "places"),
    [
        (rectangle(4.0, 3.0), [(1.0, 1.0)]),
        (rectangle(1.5, 1.2), [(0.75, 0.6)]),
        (rectangle(12.0, 12.0), [(2.0, 3.0)]),
        (rectangle(30.0, 8.0), [(14.0, 3.0)]),
        (l_shape(), [(1.5, 1.2)]),
        (t_shape(), [(1.0, 1.0), (4.0, 1.5)]),
        (u_shape(), [(7.0, 5.0), (1.0, 1.0), (7.0, 1.0)]),
    ],
    ids=["room", "closet", "hall", "long hall", "L", "T", "U"],
)
@pytest.mark.parametrize("angle_rad", [0.0, 0.7, -2.1])
def test_a_rectilinear_room_is_outlined_within_twelve_millimeters(
    polygon: Array, places: list[tuple[float, float]], angle_rad: float
) -> None:
    house = turned(House(rooms={"a": polygon}), angle_rad)
    turn = Pose2(0.0, 0.0, angle_rad)
    outline = outline_from(house, *[tuple(turn.apply(np.array(place))) for place in places])
    assert outline.closed
    assert signed_area(outline.polygon) > 0.0
    assert corner_error_m(house.rooms["a"], outline.polygon) < 0.012


@pytest.mark.parametrize("angle_rad", [0.0, 0.7, -2.1])
def test_the_lintel_that_the_robot_came_in_under_hides_no_part_of_the_room(angle_rad: float) -> None:
    room, beside = rectangle(4.0, 3.4), rectangle(3.0, 3.4, x=-3.2)
    door = Door(rooms=("a", "b"), center=(-0.1, 1.7), width=1.8)
    house = turned(House(rooms={"a": room, "b": beside}, doors=[door]), angle_rad)
    turn = Pose2(0.0, 0.0, angle_rad)
    way = [tuple(turn.apply(np.array([x_m, 1.7]))) for x_m in (-0.15, 0.05, 0.3, 0.4)]
    assert not outline_from(house, *way[2:]).closed
    assert outline_from(house, *way).closed


def test_a_wall_of_which_little_was_seen_beside_the_entrance_is_still_open() -> None:
    rooms = {"a": rectangle(4.0, 1.2), "b": rectangle(3.0, 1.2, x=-3.2)}
    house = House(rooms=rooms, doors=[Door(rooms=("a", "b"), center=(-0.1, 0.6), width=0.9)])
    outline = outline_from(house, *[(x_m, 0.6) for x_m in (-0.15, 0.05, 0.35)])
    assert outline.support.min() < 0.75
    assert not outline.closed


def test_an_arm_of_a_room_through_which_the_robot_came_may_still_be_part_of_it() -> None:
    room = rectangle(4.0, 3.0)
    assert entrance(room, np.array([[-0.2, 1.5], [0.2, 1.5]])) is not None
    assert entrance(room, np.array([[-1.5, 1.5], [-0.2, 1.5], [0.2, 1.5]])) is None
    assert entrance(room, np.array([[0.2, 1.5], [-0.2, 1.5], [0.2, 1.5]])) is None


@pytest.mark.parametrize(("steps", "seed"), [(9, 0), (5, 1)])
def test_a_small_room_seen_from_beside_its_door_is_not_cut_at_the_door_s_post(steps: int, seed: int) -> None:
    rooms = {"bathroom": rectangle(2.48, 1.94), "hall": rectangle(4.2, 1.64, x=-1.5, y=2.09)}
    house = House(
        rooms=rooms,
        doors=[Door(rooms=("bathroom", "hall"), center=(1.6, 2.015), width=1.02)],
        wall_thickness=0.15,
    )
    way = [(1.6 - 0.35 * step / 8, 1.38 - 0.5 * step / 8) for step in range(steps)]
    outline = outline_from(house, *way, seed=seed)
    assert outline.closed
    assert corner_error_m(rooms["bathroom"], outline.polygon) < 0.012


@pytest.mark.parametrize("x_m", [3.3, 3.6, 3.8])
def test_standing_in_front_of_an_open_door_does_not_join_two_rooms(x_m: float) -> None:
    house = House(
        rooms={"a": rectangle(4.0, 3.0), "b": rectangle(5.0, 3.0, x=4.1)},
        doors=[Door(rooms=("a", "b"), center=(4.05, 1.5), width=1.0)],
        wall_thickness=0.1,
    )
    outline = outline_from(house, (2.5, 1.5), (3.0, 1.5), (x_m, 1.5))
    assert outline.closed
    assert corner_error_m(house.rooms["a"], outline.polygon) < 0.012


@pytest.mark.parametrize(
    ("width_m", "station_m", "thickness_m"),
    [(0.9, 1.5, 0.1), (0.8, 0.45, 0.2), (0.9, 2.2, 0.4), (1.8, 1.4, 0.15)],
    ids=["in the middle", "at the corner", "thick wall", "wide"],
)
def test_an_opening_as_high_as_the_walls_does_not_join_two_rooms(
    width_m: float, station_m: float, thickness_m: float
) -> None:
    house = House(
        rooms={"a": rectangle(4.0, 3.0), "b": rectangle(5.0, 3.4, x=4.0 + thickness_m)},
        doors=[Door(rooms=("a", "b"), center=(4.0 + thickness_m / 2.0, station_m), width=width_m, height=2.5)],
        wall_thickness=thickness_m,
    )
    outline = outline_from(house, (1.0, 1.0), (2.0, 1.9), (3.2, 0.4), (3.0, 1.4))
    assert outline.closed
    assert corner_error_m(house.rooms["a"], outline.polygon) < 0.012
    beyond = outline_from(house, (5.2, 0.8), (6.0, 1.4), (5.0, 0.3), (6.6, 2.4))
    assert beyond.closed
    assert corner_error_m(house.rooms["b"], beyond.polygon) < 0.012


def test_a_nook_behind_an_opening_with_thick_walls_beside_it_belongs_to_the_room() -> None:
    alcove = np.array([[0, 0], [4, 0], [4, 1], [4.9, 1], [4.9, 2], [4, 2], [4, 3], [0, 3]], dtype=np.float64)
    outline = outline_from(House(rooms={"a": alcove}), (1.0, 1.0), (2.5, 1.5), (3.4, 1.3))
    assert corner_error_m(alcove, outline.polygon) < 0.012


@pytest.mark.parametrize("width_m", [1.2, 1.5, 1.8])
def test_the_bend_of_a_hall_around_the_room_that_the_robot_came_from_is_no_opening_to_another(width_m: float) -> None:
    right, top = 1.6 + 0.15 + 2.0 + 0.15 + 1.6, width_m + 0.15 + 2.6
    hall = np.array(
        [[0, 0], [right, 0], [right, top], [3.9, top], [3.9, width_m], [1.6, width_m], [1.6, top], [0, top]]
    )
    house = House(
        rooms={"hall": hall, "bathroom": rectangle(2.0, 2.45, x=1.75, y=width_m + 0.15)},
        doors=[Door(rooms=("hall", "bathroom"), center=(1.675, top - 1.0), width=1.0)],
        wall_thickness=0.15,
    )
    outline = outline_from(house, *[(x_m, top - 1.0) for x_m in (1.72, 1.6, 1.4, 1.2, 1.0, 0.8)])
    assert not outline.closed
    assert outline.gap_m.max() == pytest.approx(width_m, abs=0.25)


@pytest.mark.parametrize("x_m", [1.12, 1.5, 2.4])
def test_a_nook_seen_from_far_along_its_wall_is_no_other_room(x_m: float) -> None:
    hall = np.array([[0, 0], [3.56, 0], [3.56, 9], [0, 9], [0, 8.2], [-2, 8.2], [-2, 5.4], [0, 5.4]], dtype=np.float64)
    house = House(rooms={"hall": hall}, doors=[Door(rooms=("hall", "outside"), center=(1.7, -0.1))])
    outline = outline_from(house, (x_m - 0.2, 1.7), (x_m, 1.7), (x_m, 1.9))
    assert not outline.closed or corner_error_m(hall, outline.polygon) < 0.02


@pytest.mark.parametrize("width_m", [1.0, 1.4])
def test_the_mouth_of_a_corridor_s_arm_is_unseen_wall_however_sparse_the_returns_beside_it_are(width_m: float) -> None:
    end = 5.6 + width_m
    corridor = np.array([[0, 0], [12, 0], [12, 1.2], [end, 1.2], [end, 3], [5.6, 3], [5.6, 1.2], [0, 1.2]])
    outline = outline_from(House(rooms={"corridor": corridor}), (1.5, 0.6), (2.0, 0.6), (2.4, 0.6))
    assert not outline.closed
    assert outline.gap_m.max() == pytest.approx(width_m, abs=0.15)


def test_a_slanted_wall_gives_an_outline_that_does_not_count_as_closed() -> None:
    polygon = np.array([[0.0, 0.0], [5.0, 0.0], [3.0, 4.0], [0.0, 4.0]])
    measured = approach(polygon, (1.0, 1.0), (1.8, 1.6), 0)
    assert not measured.fit.outline.closed
    assert measured.error_m() < 0.05


@given(st.floats(-3.0, 3.0))
@settings(max_examples=15)
def test_the_dominant_direction_turns_with_the_robot(yaw_rad: float) -> None:
    view = view_at(House(rooms={"a": rectangle(5.0, 3.0)}), Pose2(2.0, 1.0, yaw_rad), np.random.default_rng(0))
    direction, share = dominant_direction([view])
    assert share == pytest.approx(1.0)
    assert abs(np.remainder(direction + np.pi / 4, np.pi / 2) - np.pi / 4) < 0.003


def measured(polygon: Array, offsets_m: list[float]) -> list[_MeasuredWall]:
    """Walls of an outline along the axes, found at these offsets."""
    steps = np.roll(polygon, -1, axis=0) - polygon
    return [
        _MeasuredWall(
            across=int(abs(dx) > abs(dy)),
            offset_m=offset_m,
            offset_std_m=0.001,
            sigma_m=0.02,
            support=1.0,
            gap_m=0.0,
            gap_center=(0.0, 0.0),
        )
        for (dx, dy), offset_m in zip(steps.tolist(), offsets_m, strict=True)
    ]


@pytest.mark.parametrize("first", range(6))
@pytest.mark.parametrize(("found_m", "steps"), [(0.02, 1), (0.10, 0)], ids=["one surface", "a chimney breast"])
def test_two_lines_that_turn_out_to_be_one_surface_are_one_wall_and_a_real_step_stays(
    first: int, found_m: float, steps: int
) -> None:
    polygon = np.array([[0.0, 0.1], [0.3, 0.1], [0.3, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]])
    walls = measured(polygon, [found_m, 0.3, 0.0, 4.0, 3.0, 0.0])
    polygon, walls = np.roll(polygon, -first, axis=0), walls[first:] + walls[:first]
    step = _false_step(polygon, walls, ArrangementSettings().gate_m)
    assert (step is not None) == bool(steps)
    if step is not None:
        corners = {(round(x, 3), round(y, 3)) for x, y in _straightened(polygon, step).tolist()}
        assert corners == {(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)}


def test_a_recess_that_turns_out_to_be_level_with_its_wall_goes_with_both_its_steps() -> None:
    polygon = np.array(
        [[0.0, 0.0], [1.0, 0.0], [1.0, -0.1], [2.0, -0.1], [2.0, 0.0], [4.0, 0.0], [4.0, 3.0], [0.0, 3.0]]
    )
    walls = measured(polygon, [0.0, 1.0, 0.02, 2.0, 0.0, 4.0, 3.0, 0.0])
    step = _false_step(polygon, walls, ArrangementSettings().gate_m)
    assert step is not None
    corners = {(round(x, 3), round(y, 3)) for x, y in _straightened(polygon, step).tolist()}
    assert corners in (
        {(0.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)},
        {(0.0, -0.1), (2.0, -0.1), (2.0, 0.0), (4.0, 0.0), (4.0, 3.0), (0.0, 3.0)},
    )
    assert wall_lengths(_straightened(polygon, step)).min() > 0.05


def test_of_two_surfaces_as_large_as_each_other_neither_is_the_wall() -> None:
    assert _center(np.array([-0.08] * 4 + [0.08] * 4), 0.01, 0.06) == (0.01, 0.06)
