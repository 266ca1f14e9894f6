"""The software stop at any instant of a mission: base and arm stand still within 100 ms, the hand keeps its grip."""

from __future__ import annotations

from math import dist

import numpy as np
import pytest

from physics_stage import two_rooms
from planner.goals import goal
from planner.tasks.tasks import TaskStatus

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
WITHIN_S, LOOK_S = 0.1, 0.1
STILL_M, STILL_RAD = 0.002, 0.005
"""What may move in ``LOOK_S``: the play of joints that hold still."""
BETWEEN_S = (0.1, 0.9)


def home():
    """Two bottles to carry back and forth between two rooms."""
    furniture = [
        {"id": "table_1", "category": "table", "pose": [1.4, 1.4, 0.0]},
        {"id": "table_2", "category": "table", "pose": [5.8, 1.4, 0.0]},
    ]
    bottle = {"id": "bottle_1", "category": "bottle", "color": "blue", "on": "table_1", "offset": [0.0, -0.2]}
    return two_rooms(furniture, [bottle], [-0.5, 0.0, 0.0])


async def still(built):
    """How far base (m), its heading (rad) and the arm's joints (m, m, rad, rad) move in a moment, from now on."""
    before, arm_before = (await built.robot.truth())["robot"]["pose"], (await built.robot.state()).arm
    built.now_s = await built.robot.advance(LOOK_S)
    after, arm_after = (await built.robot.truth())["robot"]["pose"], (await built.robot.state()).arm
    names = ("lift_m", "extension_m", "wrist_pitch_rad", "wrist_roll_rad")
    joints = [abs(getattr(arm_before, name) - getattr(arm_after, name)) for name in names]
    return dist(before[:2], after[:2]), abs(before[2] - after[2]), *joints


@pytest.mark.parametrize("instants", [30, pytest.param(100, marks=pytest.mark.long)])
async def test_at_any_instant_base_and_arm_stand_still_within_100_ms(stage, instants):
    built = await stage(home())
    rng = np.random.default_rng(7)
    doing, places = set(), ["table_2", "table_1"]
    trials = 0
    while trials < instants:
        place = places[len(built.queue.tasks) % 2]
        await built.ask(goal("on", "bottle_1", place))
        due_s = built.now_s + rng.uniform(*BETWEEN_S)
        while not built.task.status.ended:
            await built.tick()
            if built.now_s < due_s or built.resources.executor.job is None:
                continue
            held = built.truth["robot"]["holding"]
            doing.add(built.resources.executor.job.action.split()[0])
            built.robot.stop()
            built.now_s = await built.robot.advance(WITHIN_S)
            moved = await still(built)
            assert max(moved[0], *moved[2:4]) < STILL_M, (built.resources.executor.job.action, moved)
            assert max(moved[1], *moved[4:]) < STILL_RAD, (built.resources.executor.job.action, moved)
            assert (await built.robot.truth())["robot"]["holding"] == held
            built.robot.release_stop()
            trials, due_s = trials + 1, built.now_s + rng.uniform(*BETWEEN_S)
        assert built.task.status is TaskStatus.SUCCEEDED, built.task.explanation
    assert {"approach", "cross"} <= doing, doing
    assert len(doing) >= 6, doing
