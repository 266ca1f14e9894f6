"""What every action does: it stops, times out and leaves the body safe."""

from __future__ import annotations

import pytest
from py_trees.common import Status

from skills.action import Action
from skills.doubles import Rehearsal
from skills.failures import FailureCode
from skills.navigation.driving import DriveTo
from skills.navigation.goals import at_poses

pytestmark = pytest.mark.anyio


def goal_at(context, x, y, yaw=None):
    return DriveTo(context, "room_1", at_poses(context, "room_1", [(x, y, yaw)]))


class Endless(Action):
    timeout_s = 3.0
    holds_arm = True

    def step(self):
        self.context.commands.drive = (0.3, 0.0)
        return Status.RUNNING


async def test_a_latched_stop_freezes_the_action_and_its_clock(flat):
    rehearsal = Rehearsal(memory=flat().memory)
    context = await rehearsal.prepare()
    action = goal_at(context, 2.0, 0.0)

    def press(rehearsal):
        if 2.0 < rehearsal.body.stamp_s < 100.0:
            rehearsal.body.stop()
        elif rehearsal.body.stopped:
            rehearsal.body.release_stop()

    rehearsal.observe = press
    assert await rehearsal.run([action]) is None
    assert rehearsal.body.stamp_s > 100.0


async def test_an_action_that_never_ends_times_out_and_stands_still(flat):
    rehearsal = Rehearsal(memory=flat().memory)
    context = await rehearsal.prepare()
    failure = await rehearsal.run([Endless("wait", context)])
    assert failure.code is FailureCode.TIMEOUT
    assert rehearsal.body._drive == (0.0, 0.0)


async def test_an_interrupted_action_stops_the_base_and_freezes_the_arm(flat):
    rehearsal = Rehearsal(memory=flat().memory)
    context = await rehearsal.prepare()
    action = Endless("wait", context)
    action.tick_once()
    action.stop(Status.INVALID)
    assert context.commands.drive == (0.0, 0.0)
    assert context.commands.arm == context.body.arm
