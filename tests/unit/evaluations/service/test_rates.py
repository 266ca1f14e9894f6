"""What counts as keeping up with the sensors."""

from __future__ import annotations

import pytest

from app.scheduler import Turns
from evaluations.service.latency import Answers
from evaluations.service.rates import BESIDE_SIMULATOR, FROM_MEMORY, Counts, summary

SECONDS = 10.0
QUICK = Answers(latencies_ms=(4.0,) * 99 + (40.0,))


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


def counts(scans=199, frames=300, understood=299, optimizer=100):
    return Counts(scans=scans, frames=frames, understood=understood, turns={"energy_optimizer": optimizer})


def test_rates_that_are_held_by_agents_that_all_get_their_turns():
    held = summary(FROM_MEMORY, SECONDS, counts(), turns(room_concept=0.4), QUICK)
    assert held["held"]
    assert (held["lidar_hz"], held["rgbd_hz"]) == (pytest.approx(19.9), pytest.approx(29.9))
    assert (held["frames_taken_hz"], held["frames_skipped"]) == (pytest.approx(30.0), 1)
    assert (held["overdue"], held["overdue_s"]) == ("room_concept", pytest.approx(0.3))
    assert (held["api_p50_ms"], held["api_requests"]) == (pytest.approx(4.0), 100)


def test_from_memory_more_is_asked_for_than_beside_the_simulator():
    fewer = counts(scans=100, frames=50, understood=50)
    assert summary(BESIDE_SIMULATOR, SECONDS, fewer, turns(), QUICK)["held"]
    assert not summary(FROM_MEMORY, SECONDS, fewer, turns(), QUICK)["held"]


def test_at_twice_the_pace_a_turn_is_overdue_after_half_the_period():
    twice = summary(FROM_MEMORY, SECONDS, counts(), turns(room_concept=0.4), QUICK, speed=2.0)
    assert (twice["overdue"], twice["overdue_s"]) == ("room_concept", pytest.approx(0.35))
    assert not summary(FROM_MEMORY, SECONDS, counts(), turns(room_concept=1.06), QUICK, speed=2.0)["held"]
    assert summary(FROM_MEMORY, SECONDS, counts(), turns(room_concept=1.06), QUICK)["held"]


@pytest.mark.parametrize(
    ("short", "longest_wait_s"),
    [({"scans": 150}, 0.2), ({"understood": 250}, 0.2), ({"optimizer": 80}, 0.2), ({}, 1.3)],
    ids=["scans are lost", "frames are not understood", "the optimizer is slow", "an agent starves"],
)
def test_what_is_not_held(short, longest_wait_s):
    assert not summary(FROM_MEMORY, SECONDS, counts(**short), turns(room_concept=longest_wait_s), QUICK)["held"]


@pytest.mark.parametrize(
    "answers",
    [Answers(latencies_ms=(4.0,) * 97 + (80.0,) * 3), Answers(latencies_ms=(4.0,) * 100, failures=("/healthz: 503",))],
    ids=["three in a hundred are slow", "one failed"],
)
def test_an_api_that_does_not_answer_in_time_or_at_all(answers):
    assert not summary(FROM_MEMORY, SECONDS, counts(), turns(), answers)["held"]


def test_an_agent_that_failed_meanwhile_held_nothing():
    failed = turns()
    failed[0].restarts = 1
    assert not summary(FROM_MEMORY, SECONDS, counts(), failed, QUICK)["held"]
