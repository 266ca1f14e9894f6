"""How the end of a mission is judged: the right reason, and what was touched."""

from __future__ import annotations

from dataclasses import replace

import pytest

from evaluations.missions.disturbances import DISTURBANCES
from evaluations.missions.episodes import OUT_OF_REACH, Verdict, impossible_as_told, touched_last
from mission_scenes import task
from planner.tasks.tasks import TaskStatus
from skills.failures import Evidence, Failure, FailureCode


@pytest.mark.parametrize(
    ("codes", "near", "right"),
    [
        (["unreachable", "object_gone"], True, True),
        (["unreachable", "object_gone"], False, True),
        (["object_gone", "unreachable"], False, True),
        (["object_gone", "unreachable"], True, False),
        (["support_full"], False, False),
        ([], True, False),
    ],
)
def test_what_was_removed_from_out_of_reach_may_be_called_either(codes, near, right):
    evidence = Evidence(revision=1)
    failures = tuple(Failure(code=FailureCode(code), message="", evidence=evidence) for code in codes)
    reasons = DISTURBANCES["removed"].reasons | (frozenset() if near else OUT_OF_REACH)
    told = impossible_as_told(replace(task(TaskStatus.FAILED), failures=failures), reasons, within_reach=near)
    assert told is (Verdict.RIGHTLY_IMPOSSIBLE if right else Verdict.OTHER_REASON)


@pytest.mark.parametrize(("near", "verdict"), [(True, Verdict.OTHER_REASON), (False, Verdict.RIGHTLY_IMPOSSIBLE)])
def test_what_is_out_of_reach_need_not_be_known(near, verdict):
    assert impossible_as_told(task(TaskStatus.REFUSED), OUT_OF_REACH, within_reach=near) is verdict


def test_what_was_touched_is_told_of_the_newest_collisions_only():
    truth = {"collisions": 5, "touched": ["wall", "chair_1", "cup_1"]}
    assert touched_last(truth, 2) == ["chair_1", "cup_1"]
    assert touched_last(truth, 5) == ["wall", "chair_1", "cup_1"]
    assert touched_last(truth, 0) == []
