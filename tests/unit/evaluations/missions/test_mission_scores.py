"""What missions come to together, and whether the aims are met."""

from __future__ import annotations

import pytest

from evaluations.missions.episodes import Verdict
from evaluations.missions.evaluation import met, summarize


def row(verdict, disturbance="", *, possible=True, near=True, collisions=0, driven_m=5.0, shortest_m=4.5, attempts=()):
    return {
        "verdict": verdict, "disturbance": disturbance, "made": bool(disturbance), "possible": possible,
        "within_reach": near,
        "collisions": collisions, "driven_m": driven_m, "shortest_m": shortest_m, "attempts": attempts,
    }  # fmt: skip


def test_one_phantom_or_one_collision_is_one_too_many():
    good = [row(Verdict.DONE)] * 9 + [row(Verdict.HONEST_FAILURE)]
    assert met(summarize(good))
    assert not met(summarize([*good, row(Verdict.PHANTOM)]))
    assert not met(summarize([*good[:-1], row(Verdict.DONE, collisions=1)]))
    assert not met(summarize([*good, row(Verdict.HONEST_FAILURE)]))
    assert not met(summarize([]))


def test_what_was_impossible_counts_for_its_reason_and_not_as_a_failure():
    rows = [row(Verdict.RIGHTLY_IMPOSSIBLE, "removed", possible=False), row(Verdict.DONE, "pushed")]
    summary = summarize(rows)
    assert (summary["success_disturbed"], summary["right_reason"], summary["impossible"]) == (1.0, 1.0, 1)
    assert met(summary)
    rows.append(row(Verdict.RIGHTLY_IMPOSSIBLE, possible=False))
    summary = summarize(rows)
    assert (summary["success_undisturbed"], summary["impossible"], summary["out_of_reach"]) == (None, 1, 1)
    rows.append(row(Verdict.OTHER_REASON, "removed", possible=False))
    assert not met(summarize(rows))


def test_what_was_carried_out_was_possible_whatever_had_been_thought():
    rows = [row(Verdict.DONE, "pushed", possible=False), row(Verdict.OTHER_REASON, "removed", possible=False)]
    summary = summarize([*rows, row(Verdict.DONE, possible=False)])
    assert (summary["success_disturbed"], summary["right_reason"], summary["impossible"]) == (1.0, 0.0, 1)
    assert (summary["success_undisturbed"], summary["out_of_reach"]) == (1.0, 0)


def test_what_ended_before_anybody_interfered_counts_as_undisturbed():
    early = {**row(Verdict.HONEST_FAILURE, "removed"), "made": False}
    summary = summarize([row(Verdict.DONE), early, {**early, "verdict": Verdict.DONE}, row(Verdict.DONE, "removed")])
    assert (summary["success_undisturbed"], summary["success_disturbed"]) == (pytest.approx(2 / 3), 1.0)
    assert (summary["not_made"], summary["disturbed"], summary["out_of_reach"]) == (2, 1, 0)


def test_the_way_is_compared_where_nobody_interfered():
    rows = [row(Verdict.DONE, driven_m=9.0), row(Verdict.DONE, "pushed", driven_m=90.0)]
    assert summarize(rows)["way_over_shortest"] == 2.0


def test_goes_count_until_somebody_interferes():
    goes = [{"skill": "PICK", "done": True, "calm": True}, {"skill": "PICK", "done": False, "calm": False}]
    summary = summarize([row(Verdict.DONE, "pushed", attempts=goes)])
    assert (summary["picks"], summary["places"]) == (1.0, None)
    bad = [{"skill": "PLACE", "done": False, "calm": True}]
    assert not met(summarize([row(Verdict.DONE, attempts=bad)]))


def test_goes_at_what_was_out_of_reach_from_the_start_are_counted_by_themselves():
    came, failed = ({"skill": "PICK", "done": done, "calm": True} for done in (True, False))
    rows = [
        row(Verdict.RIGHTLY_IMPOSSIBLE, possible=False, near=False, attempts=[failed]),
        row(Verdict.RIGHTLY_IMPOSSIBLE, "removed", possible=False, attempts=[came, failed]),
        row(Verdict.DONE, possible=False, near=False, attempts=[came]),
    ]
    summary = summarize(rows)
    assert summary["attempts"] == {"PICK": 3, "PLACE": 0}
    assert (summary["picks"], summary["attempts_out_of_reach"]) == (pytest.approx(2 / 3), 1)
