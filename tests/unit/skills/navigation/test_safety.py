"""The last check before a velocity is sent."""

from __future__ import annotations

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from skills.geometry import Pose2
from skills.navigation.safety import admissible, retreat
from skills.ports import BodyLimits

LIMITS = BodyLimits()


points = st.tuples(st.floats(-2.4, 2.4), st.floats(-2.4, 2.4))


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
