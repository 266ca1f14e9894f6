"""``kill -9`` at any instant: the next start knows the building, every acknowledged task, and what was taught.

The house is small, so that a mission soon has something in its hand. Whoever is killed before it is ready, in the
middle of a start, is killed as well.
"""

from __future__ import annotations

import pytest

from killed_service import Killing, explore
from paths import DATA

HOUSE = DATA / "studio.json"
FAST = ("--house", str(HOUSE), "--clock", "lockstep", "--speed", "max")
GOING = ("go to room_2", "where are you?", "go to room_1", "what rooms are there?")
CARRYING = ("bring the blue bottle to the desk", "where is the red cup?", "bring the red cup to the desk")
READY_S = 10.0
WHILE_STARTING = 0.15
LONGEST_START_S = 4.0


def kill(killing: Killing, longest_s: float, *, starting: bool) -> None:
    """End a life at a random instant, or in the middle of its start."""
    if starting:
        killing.life(killing.random.uniform(0.0, LONGEST_START_S), while_starting=True)
    else:
        killing.life(killing.random.uniform(1.0, longest_s))
    print(killing.account.summary(), flush=True)


@pytest.mark.slow
def test_two_kills_lose_nothing_that_was_acknowledged(tmp_path):
    arguments = (*FAST, "--no-camera")
    explore(tmp_path, *arguments, timeout_s=240.0)
    killing = Killing(tmp_path, arguments, GOING, seed=1)
    for starting in (False, True):
        kill(killing, 6.0, starting=starting)
    killing.look_again()
    assert killing.account.flaws == []
    assert len(killing.account.asked) >= 2
    assert len(killing.account.rooms) == 2


@pytest.mark.long
def test_nor_do_a_hundred_while_things_are_carried(tmp_path):
    explore(tmp_path, *FAST, timeout_s=600.0)
    killing = Killing(tmp_path, FAST, CARRYING, seed=2)
    for _ in range(100):
        kill(killing, 25.0, starting=killing.random.random() < WHILE_STARTING)
    killing.look_again()
    assert killing.account.flaws == []
    assert killing.account.kills == 100
    assert min(killing.account.interrupted, killing.account.carrying, killing.account.before_ready) > 3
    assert max(killing.account.ready_s) < READY_S
