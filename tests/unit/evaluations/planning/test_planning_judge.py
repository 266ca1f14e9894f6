"""Scores of the evaluation of planning can fail: an end state, an answer or a question that is not as expected."""

from __future__ import annotations

import pytest

from evaluations.planning.buildings import building
from evaluations.planning.conversation import ANSWER, CLARIFY, PLAN, REFUSE, Outcome
from evaluations.planning.judging.expectation_reader import read_expectation
from evaluations.planning.judging.judge import Verdict, judge
from evaluations.planning.symbolic_execution import perform, write
from planner.tasks.tasks import StepReport
from scene_graph.memory import WorkingMemory
from skills.facts import read_state
from skills.registry import load_registry

STUDIO = building("studio")
SKILLS = load_registry()
CUP_TO_SHELF = (("GOTO", "cup_1"), ("PICK", "cup_1"), ("GOTO", "shelf_1"), ("PLACE", "cup_1", "shelf_1"))


def outcome(*steps, kind=PLAN, said="", candidates=(), after=STUDIO):
    reports = tuple(StepReport(skill=skill, args=tuple(args)) for skill, *args in steps)
    trail, obstacle = perform(reports, read_state(STUDIO), SKILLS)
    return Outcome(
        kind=kind,
        said=said,
        candidates=frozenset(candidates),
        steps=reports,
        source="grammar",
        sought=(),
        trail=trail,
        obstacle=obstacle,
        after=after,
        ms=1.0,
    )


def verdict(what, *lines):
    return judge(what, [read_expectation(line, STUDIO) for line in lines]).verdict


@pytest.mark.parametrize(
    "line",
    [
        "cup_1 -> shelf_1",
        "cup_1 -> room_2",
        "1 of cup_1 cup_2 -> shelf_1",
        "robot -> room_2 then cup_1 -> shelf_1",
        "cup_1 -> hand then cup_1 -> shelf_1; robot -> shelf_1",
    ],
)
def test_an_end_state_that_comes_true_is_right(line):
    assert verdict(outcome(*CUP_TO_SHELF), line) is Verdict.RIGHT


@pytest.mark.parametrize(
    "line",
    [
        "cup_1 -> table_1",
        "cup_2 -> shelf_1",
        "cup_1 cup_2 -> shelf_1",
        "2 of cup_1 cup_2 -> shelf_1",
        "cup_1 -> shelf_1 then robot -> room_3",
        "cup_1 -> shelf_1 then cup_1 -> hand",
        "robot -> room_2",
        "ask",
        "refuse cup",
        "answer shelf",
    ],
)
def test_whatever_else_is_done_is_a_wrong_action(line):
    assert verdict(outcome(*CUP_TO_SHELF), line) is Verdict.WRONG_ACTION


def test_one_expectation_of_several_is_enough():
    assert verdict(outcome(*CUP_TO_SHELF), "cup_2 -> shelf_1", "cup_1 -> shelf_1") is Verdict.RIGHT


def test_what_may_be_put_aside_need_not_stay():
    assert verdict(outcome(*CUP_TO_SHELF, ("GOTO", "room_3")), "robot -> room_3; aside cup_1") is Verdict.RIGHT


def test_a_plan_that_cannot_be_carried_out_is_never_right():
    judgement = judge(outcome(("PICK", "cup_1")), [read_expectation("cup_1 -> hand", STUDIO)])
    assert judgement.verdict is Verdict.WRONG_ACTION
    assert "cannot be carried out: PICK(cup_1)" in judgement.reason


def test_doing_nothing_where_something_is_to_be_done_is_missed():
    assert verdict(outcome(kind=REFUSE, said="no"), "cup_1 -> shelf_1") is Verdict.MISSED
    assert verdict(outcome(kind=ANSWER, said="It is there."), "cup_1 -> table_1") is Verdict.RIGHT


def test_an_answer_needs_its_words_as_words():
    told = outcome(kind=ANSWER, said="The cup is on the Table in the living room.")
    assert verdict(told, "answer table|desk, living room, !kitchen") is Verdict.RIGHT
    assert verdict(told, "answer tab") is Verdict.MISSED
    assert verdict(told, "answer tab*") is Verdict.RIGHT
    assert verdict(told, "answer table, !cup") is Verdict.MISSED


def test_a_question_is_about_exactly_its_candidates():
    asked = outcome(kind=CLARIFY, said="Which?", candidates=("cup_1", "cup_2"))
    assert verdict(asked, "ask") is Verdict.RIGHT
    assert verdict(asked, "ask cup_1 cup_2") is Verdict.RIGHT
    assert verdict(asked, "ask cup_1") is Verdict.MISSED


def test_what_cannot_be_done_is_named():
    refused = outcome(kind=REFUSE, said="I cannot pour.")
    assert verdict(refused, "decline pour*") is Verdict.RIGHT
    assert verdict(refused, "decline wash*") is Verdict.MISSED
    assert verdict(outcome(kind=ANSWER, said="pour"), "decline pour*") is Verdict.MISSED


def test_what_is_taught_is_read_from_the_graph():
    assert verdict(outcome(kind=ANSWER), "taught room_1 hall") is Verdict.RIGHT
    assert verdict(outcome(kind=ANSWER), "taught room_1 lobby") is Verdict.MISSED


def test_the_graph_believes_what_a_plan_led_to():
    memory = WorkingMemory(STUDIO)
    steps = outcome(*CUP_TO_SHELF, ("GOTO", "cup_2"), ("PICK", "cup_2"), ("GOTO", "room_3"))
    write(steps.trail[0], steps.trail[-1], memory, STUDIO.stamp_s + 1.0)
    after = read_state(memory.building())
    assert after.places == steps.trail[-1].places
    assert (after.holding, after.robot_room) == ("cup_2", "room_3")
    assert memory.building().support_of("cup_1") == "shelf_1"
