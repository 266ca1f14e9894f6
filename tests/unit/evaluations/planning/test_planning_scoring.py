"""Figures of the evaluation of planning: aims can be missed, and what was not measured has none."""

from __future__ import annotations

from dataclasses import replace

import pytest

from evaluations.planning.judging.expectations import Asked, Request, Turn
from evaluations.planning.judging.judge import Verdict
from evaluations.planning.judging.scoring import figures, percentile, slips, summarize
from evaluations.planning.report import document, failures
from evaluations.planning.runs import Record

REQUEST = Request(
    half="held_out", line=3, category="go", building="studio", turns=(Turn(text="go", expected=(Asked(),)),)
)
GOOD = Record(
    request=REQUEST,
    verdict=Verdict.RIGHT,
    reason="",
    ms=(10.0,),
    wall_ms=(12.0,),
    executable=True,
    acted=True,
    nodes=26,
    prompt_tokens=(900, 1200),
)
MISSED = replace(GOOD, verdict=Verdict.MISSED, reason="nothing is done", acted=False)
WRONG = replace(GOOD, verdict=Verdict.WRONG_ACTION, reason="goes elsewhere")


def unmet(records, corrupted=None):
    return {row["figure"] for row in figures(records, corrupted or {}) if not row["met"]}


def test_when_all_is_right_all_aims_are_met():
    assert unmet([GOOD] * 10) == set()
    assert document([GOOD] * 10, {}, None)["met"]


@pytest.mark.parametrize(
    ("record", "figure"),
    [
        (MISSED, "right, not developed against"),
        (WRONG, "wrong actions"),
        (replace(GOOD, executable=False), "plans that can be carried out"),
        (replace(GOOD, ms=(51.0,)), "processor ms, 99 of 100, studio"),
        (replace(GOOD, prompt_tokens=(1501, 2000)), "tokens of a prompt, at most 200 nodes"),
        (replace(GOOD, nodes=5010, ms=(251.0,)), "processor ms, 99 of 100, studio"),
        (replace(MISSED, request=replace(REQUEST, category="out of scope")), "out of scope, declined by name"),
    ],
)
def test_every_aim_can_be_missed(record, figure):
    assert figure in unmet([record])
    assert not document([record], {}, None)["met"]


def test_a_slow_building_is_not_hidden_among_quick_ones():
    slow = replace(GOOD, request=replace(REQUEST, building="hospital"), nodes=5010, ms=(251.0,))
    school = replace(GOOD, request=replace(REQUEST, building="school"), nodes=1500)
    assert unmet([school] * 200 + [slow]) == {"processor ms, 99 of 100, hospital"}


def test_the_half_that_is_developed_against_does_not_count_as_success():
    developed = replace(MISSED, request=replace(REQUEST, half="developed"))
    assert unmet([GOOD, developed]) == set()
    assert "right, not developed against" in unmet([developed])


def test_a_model_that_slips_has_aims_of_its_own():
    slipped = replace(MISSED, slips=("timeout",), asked=5)
    assert unmet([GOOD], {0.1: [slipped]}) == {"right with a model that slips at 0.1"}
    assert slips([slipped]) == {"timeout": {"requests": 1, "right": 0, "wrong_actions": 0}}


def test_what_was_not_measured_has_no_figure():
    assert not any("out of scope" in row["figure"] for row in figures([GOOD], {}))
    assert summarize([])["right"] is None


def test_a_percentile_is_a_value_that_was_measured():
    assert percentile(range(1, 101), 0.99) == 99
    assert percentile([7.0], 0.99) == 7.0
    assert percentile([], 0.5) is None


def test_a_failure_says_which_request_what_was_said_and_why():
    (line,) = failures([GOOD, WRONG])
    assert line == "held_out:3 (studio, go) 'go': WRONG ACTION, goes elsewhere"
