"""A scripted model that slips: seeded, at the given rate, and never beyond what a real one could say."""

from __future__ import annotations

import asyncio
import json

import pytest

from evaluations.planning.buildings import building
from evaluations.planning.corruption import Deaf, Oracle, Slip, can_be_put, fitting, right_answer, slipped
from evaluations.planning.request_file import read_requests
from evaluations.planning.runs import run_one
from planner.models.protocol import ModelFailure, ModelRequest
from planner.models.scripted import ScriptedModel
from planner.task_planner.proposal import read_proposal

STUDIO = building("studio")
REQUEST = ModelRequest(messages=(), schema={})
TEXT = """
@studio
== several steps
candle to the table, then see me
  > candle_1 -> table_1 then robot -> person_1
bring the cup
  > ask cup_1 cup_2
& red
  > cup_1 -> person_1
pour
  > decline pour*
"""
REQUESTS = read_requests(TEXT, "mine")
ERRAND = REQUESTS[0].turns[0]


def said(oracle, calls=60):
    oracle.hear(ERRAND, STUDIO)
    return [oracle.speak(REQUEST) for _ in range(calls)]


def test_the_same_seed_slips_alike_and_another_does_not():
    assert said(Oracle(0.5, "a")) == said(Oracle(0.5, "a"))
    assert said(Oracle(0.5, "a")) != said(Oracle(0.5, "b"))


def test_it_slips_as_often_as_it_is_told_to():
    oracle = Oracle(0.3, "a")
    said(oracle, calls=1000)
    assert len(oracle.slips) == pytest.approx(300, abs=60)
    assert set(oracle.slips) == set(Slip)
    assert all(line == right_answer(ERRAND.expected, STUDIO) for line in said(Oracle(0.0, "a")))


def test_the_right_answer_is_the_expected_end_as_goals():
    assert right_answer(ERRAND.expected, STUDIO)["goals"] == [
        {"predicate": "on", "args": ["candle_1", "table_1"]},
        {"predicate": "robot_at", "args": ["person_1"]},
    ]


@pytest.mark.parametrize("slip", Slip)
def test_every_slip_changes_the_answer_and_leaves_the_right_one_alone(slip):
    right = right_answer(ERRAND.expected, STUDIO)
    before = json.dumps(right)
    assert slip in fitting(right)
    assert slipped(right, slip, Oracle(0.0, "a")._random) != right
    assert json.dumps(right) == before


@pytest.mark.parametrize("slip", [Slip.WRONG_KIND, Slip.INVENTED_IDENTIFIER, Slip.WRONG_PREDICATE])
def test_a_slip_of_content_is_still_of_the_right_shape(slip):
    line = slipped(right_answer(ERRAND.expected, STUDIO), slip, Oracle(0.0, "a")._random)
    assert isinstance(read_proposal(line), ModelFailure) is (slip is Slip.WRONG_KIND)


def test_a_question_has_no_goals_to_get_wrong():
    asked = right_answer(REQUESTS[1].turns[0].expected, STUDIO)
    assert not {Slip.MISSING_STEP, Slip.SWAPPED_ARGUMENTS, Slip.WRONG_ORDER} & {*fitting(asked)}


def test_what_only_the_graph_can_answer_is_not_put_to_a_model():
    (question,) = read_requests("@studio\n== q\nwhere?\n> answer here\n", "mine")
    assert not can_be_put(question.turns[0].expected)


def test_a_model_that_never_slips_is_always_right():
    grammar = Deaf()
    for request in REQUESTS:
        oracle = Oracle(0.0, request.name)
        record = asyncio.run(run_one(request, grammar, ScriptedModel(oracle.speak), oracle=oracle))
        assert (record.verdict, record.executable) == ("right", True), record.reason
        assert record.asked == len(request.turns)
