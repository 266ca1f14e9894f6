"""Speed, acceleration and dead man: laws that hold whatever is asked."""

from __future__ import annotations

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.rosbridge.governor import Governor
from skills.ports import BodyLimits

LIMITS = BodyLimits()
DT_S = 0.05
anything = st.floats(allow_nan=True, allow_infinity=True)


@given(st.lists(st.one_of(st.none(), st.tuples(anything, anything)), max_size=60))
def test_no_request_lifts_the_limits_of_speed_and_acceleration(requests):
    governor = Governor(LIMITS)
    before = (0.0, 0.0)
    for request in requests:
        if request is not None:
            governor.want(*request)
        speed = governor.step(DT_S)
        assert abs(speed[0]) <= LIMITS.linear_mps
        assert abs(speed[1]) <= LIMITS.angular_radps
        assert abs(speed[0] - before[0]) <= LIMITS.linear_mps2 * DT_S + 1e-12
        assert abs(speed[1] - before[1]) <= LIMITS.angular_radps2 * DT_S + 1e-12
        before = speed


def test_a_wish_lapses_and_the_base_slows_down_to_rest():
    governor = Governor(LIMITS)
    speeds = []
    for step in range(60):
        if step < 20:
            governor.want(0.4, 0.0)
        speeds.append(governor.step(DT_S)[0])
    lapsed = 20 + math.ceil(LIMITS.command_timeout_s / DT_S)
    assert speeds[19] == pytest.approx(0.4)
    assert speeds[lapsed - 2] == pytest.approx(0.4), "not before its time"
    assert speeds[lapsed + 12] == 0.0


def test_halting_needs_no_time():
    governor = Governor(LIMITS)
    governor.want(0.4, 1.0)
    for _ in range(20):
        governor.step(DT_S)
    governor.halt()
    assert governor.speed == governor.step(DT_S) == (0.0, 0.0)
