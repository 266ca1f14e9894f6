"""Every time the robot tries to pick something up or to put it down counts once."""

from __future__ import annotations

from dataclasses import replace

import pytest

from evaluations.missions.attempts import Attempts
from mission_scenes import CUP_ON_TABLE, scene, task
from planner.tasks.tasks import PlanReport, StepReport, StepStatus, TaskStatus


def plan_of(*steps):
    reports = tuple(StepReport(skill=skill, args=("cup_1",), status=status) for skill, status in steps)
    return PlanReport(source="grammar", revision=1, goals=(), steps=reports)


def test_a_go_counts_once_it_has_begun_and_ended_and_a_failed_one_stays_failed_after_a_new_plan():
    attempts = Attempts()
    pending, running, failed, done = StepStatus.PENDING, StepStatus.RUNNING, StepStatus.FAILED, StepStatus.SUCCEEDED
    for steps in (
        (("GOTO", done), ("PICK", failed)),
        (("GOTO", done), ("PICK", running)),
        (("GOTO", done), ("PICK", failed)),
        (("GOTO", running), ("PICK", pending)),
        (("GOTO", done), ("PICK", running)),
        (("GOTO", running), ("PICK", pending)),
        (("GOTO", done), ("PICK", running)),
        (("GOTO", done), ("PICK", done)),
        (("GOTO", done), ("PICK", done)),
    ):
        attempts.follow(replace(task(TaskStatus.RUNNING), plan=plan_of(*steps)))
    found = attempts.check(scene(CUP_ON_TABLE, holding="cup_1"), calm=True)
    assert [(attempt.step, attempt.done) for attempt in found] == [("PICK(cup_1)", False), ("PICK(cup_1)", True)]
    assert attempts.check(scene(CUP_ON_TABLE), calm=True) == []


@pytest.mark.parametrize(("skill", "holding"), [("PICK", None), ("PLACE", "cup_1")])
def test_a_go_that_the_robot_takes_for_done_and_the_truth_does_not_is_none(skill, holding):
    attempts = Attempts()
    for status in (StepStatus.RUNNING, StepStatus.SUCCEEDED):
        attempts.follow(replace(task(TaskStatus.RUNNING), plan=plan_of((skill, status))))
    (attempt,) = attempts.check(scene(CUP_ON_TABLE, holding=holding), calm=True)
    assert not attempt.done
