"""The robot's time: follows the robot's stamps, and neither jumps nor goes back whatever its clock does."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from drivers.rosbridge.clock import ClockSettings, RobotClock


class Wall:
    def __init__(self):
        self.s = 1000.0

    def __call__(self):
        return self.s


def run(clock, wall, *, stamps, every_s):
    for stamp_s in stamps:
        clock.hear(stamp_s)
        wall.s += every_s


def test_time_begins_at_zero_and_follows_the_robot_however_slow_its_clock_is():
    wall = Wall()
    clock = RobotClock(wall)
    assert clock.now_s == 0.0
    assert clock.time_of(5.0) == float("-inf")
    run(clock, wall, stamps=[1.7e9 + 0.05 * step for step in range(101)], every_s=0.1)
    assert clock.time_of(1.7e9 + 5.0) == pytest.approx(5.0)
    assert clock.now_s == pytest.approx(5.1), "five seconds of the robot's, and a tenth of ours since"


@pytest.mark.parametrize("jump_s", [-3600.0, 7200.0])
def test_time_goes_on_from_where_it_was_when_the_robots_clock_is_set(jump_s):
    wall = Wall()
    clock = RobotClock(wall)
    run(clock, wall, stamps=[100.0 + 0.1 * step for step in range(11)], every_s=0.1)
    before_s = clock.now_s
    run(clock, wall, stamps=[101.1 + jump_s], every_s=0.0)
    assert clock.now_s == pytest.approx(before_s, abs=0.11)
    assert clock.time_of(101.1 + jump_s) == pytest.approx(before_s, abs=0.11)


def test_time_stands_when_nothing_is_heard_for_long_and_does_not_go_back_afterwards():
    wall = Wall()
    clock = RobotClock(wall)
    clock.hear(50.0)
    wall.s += 60.0
    assert clock.now_s == pytest.approx(ClockSettings().carry_s)
    clock.hear(50.1)
    assert clock.now_s == pytest.approx(ClockSettings().carry_s)


def test_a_message_that_was_overtaken_changes_nothing():
    wall = Wall()
    clock = RobotClock(wall)
    run(clock, wall, stamps=[10.0, 10.2, 10.1], every_s=0.1)
    assert clock.time_of(10.2) == pytest.approx(0.2, abs=0.11)
    assert clock.now_s >= 0.2


@given(st.lists(st.tuples(st.floats(-1e6, 1e6), st.floats(0.0, 10.0)), max_size=30))
def test_time_never_goes_back_whatever_the_stamps_are(heard):
    wall = Wall()
    clock = RobotClock(wall)
    told = [clock.now_s]
    for stamp_s, pause_s in heard:
        clock.hear(stamp_s)
        told.append(clock.now_s)
        wall.s += pause_s
        told.append(clock.now_s)
    assert told == sorted(told)
