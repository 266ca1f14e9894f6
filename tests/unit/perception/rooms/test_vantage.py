"""Where to look at a room from."""

from __future__ import annotations

import numpy as np

from perception.ports import RobotShape
from perception.rooms.survey.vantage import freest_way, next_vantage
from unit.perception.lidar_house import House, l_shape, rectangle
from unit.perception.rooms.viewed_rooms import outline_from

NOWHERE = np.empty((0, 2))


def test_an_unseen_leg_leaves_the_outline_open_and_is_where_to_go_next() -> None:
    outline = outline_from(House(rooms={"a": l_shape()}), (5.5, 2.0))
    assert not outline.closed
    place = next_vantage(outline, NOWHERE, [], np.array([5.5, 2.0]))
    assert place is not None
    assert np.linalg.norm(place - np.array([1.5, 2.0])) < 1.0


def test_a_place_that_was_visited_is_not_proposed_again() -> None:
    outline = outline_from(House(rooms={"a": rectangle(4.0, 3.0)}), (1.0, 1.0))
    first = next_vantage(outline, NOWHERE, [], np.array([1.0, 1.0]))
    assert first is not None
    assert np.linalg.norm(first - np.array([2.0, 1.5])) < 0.05
    assert next_vantage(outline, NOWHERE, [first], np.array([1.0, 1.0])) is None


def test_a_vantage_point_keeps_clear_of_furniture() -> None:
    outline = outline_from(House(rooms={"a": rectangle(4.0, 3.0)}), (1.0, 1.0))
    table = np.array([[2.0, 1.5], [2.2, 1.5], [1.8, 1.5]])
    place = next_vantage(outline, table, [], np.array([1.0, 1.0]))
    assert place is not None
    assert np.linalg.norm(table - place, axis=1).min() > 0.39


def test_a_vantage_point_is_one_that_a_way_leads_to() -> None:
    outline = outline_from(House(rooms={"a": l_shape()}), (5.5, 2.0))
    robot = np.array([5.5, 1.2])
    free = next_vantage(outline, NOWHERE, [], robot)
    screen = np.column_stack([np.full(40, 4.0), np.linspace(0.1, 2.3, 40)])
    shut_in = next_vantage(outline, screen, [], robot)
    assert free is not None
    assert free[0] < 3.5
    assert shut_in is None or shut_in[0] > 4.0


def test_a_robot_that_is_too_wide_for_the_way_ahead_finds_none() -> None:
    posts = np.array([(x_m, side_m) for x_m in np.linspace(0.0, 3.0, 31) for side_m in (-0.4, 0.4)])
    assert freest_way(posts) is not None
    assert freest_way(posts, shape=RobotShape(footprint_radius_m=0.4)) is None
