"""What counts as keeping up with the sensors."""

from __future__ import annotations

import pytest

from majordomo.app.evaluations.rates import summary
from majordomo.app.scheduler import Turns


class Agent:
    def __init__(self, name, period_s=0.1):
        self.name, self.period_s = name, period_s

    async def step(self, stamp_s):
        raise AssertionError("nobody steps here")


def turns(**longest_wait_s):
    return [
        Turns(agent=Agent(name), taken=200, longest_wait_s=wait_s)
        for name, wait_s in {"energy_optimizer": 0.12, **longest_wait_s}.items()
    ]


def test_rates_that_are_held_by_agents_that_all_get_their_turns():
    held = summary("from memory", 20.0, 10.0, 199, turns(room_concept=0.4))
    assert held["held"]
    assert held["lidar_hz"] == pytest.approx(19.9)
    assert (held["overdue"], held["overdue_s"]) == ("room_concept", pytest.approx(0.3))


def test_at_twice_the_pace_a_turn_is_overdue_after_half_the_period():
    twice = summary("from memory", 20.0, 10.0, 200, turns(room_concept=0.4), speed=2.0)
    assert (twice["overdue"], twice["overdue_s"]) == ("room_concept", pytest.approx(0.35))
    assert not summary("from memory", 20.0, 10.0, 200, turns(room_concept=1.06), speed=2.0)["held"]
    assert summary("from memory", 20.0, 10.0, 200, turns(room_concept=1.06))["held"]


@pytest.mark.parametrize(
    ("seconds", "scans", "longest_wait_s"),
    [(10.0, 150, 0.2), (30.0, 600, 0.2), (10.0, 200, 1.3)],
    ids=["scans are lost", "the optimizer is slow", "an agent starves"],
)
def test_what_is_not_held(seconds, scans, longest_wait_s):
    assert not summary("from memory", 20.0, seconds, scans, turns(room_concept=longest_wait_s))["held"]


def test_an_agent_that_failed_meanwhile_held_nothing():
    failed = turns()
    failed[0].restarts = 1
    assert not summary("from memory", 20.0, 10.0, 200, failed)["held"]
