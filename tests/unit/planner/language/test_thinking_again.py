"""Slips that are taken back, in one request or in the next, and what goes on from there."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.dialogue.interpreter import Interpreter
from planner.goals import Goal, Predicate
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Exchange
from planner.skill_planner.verifier import Verifier
from skills.registry import load_registry

INTERPRETER = Interpreter(CommandGrammar(), Verifier(load_registry([])))
SNAPSHOT = home().person("person_3", "Doctor Weber", "room_4", at=(4.5, 4.2)).snapshot(robot_in="room_2", at=(4.2, 0.0))
PUT = Exchange(
    request="put the key on the desk",
    goals=(Goal(predicate=Predicate.ON, args=("key_1", "desk_1")),),
    status="succeeded",
)
BROUGHT = Exchange(
    request="bring Anna the apple",
    goals=(Goal(predicate=Predicate.GIVEN, args=("apple_1", "person_1")),),
    status="succeeded",
)


def read(text, *earlier):
    mentioned = tuple(i for exchange in earlier for goal in exchange.goals for i in goal.args)
    return INTERPRETER.read(text, SNAPSHOT, Dialogue(earlier=earlier, mentioned=mentioned)).interpretation


def goals(text, *earlier):
    return [goal.args for goal in read(text, *earlier).goals]


@pytest.mark.parametrize(
    ("text", "done"),
    [
        ("Take the red bottle, excuse me, the blue one, to Anna.", [("bottle_1", "person_1")]),
        ("The red bottle to Anna. Oh I'm so sorry, not red, blue.", [("bottle_1", "person_1")]),
        ("Take the apple to Anna, or actually to Doctor Weber.", [("apple_1", "person_3")]),
        ("The apple in the kitchen, please, to Anna.", [("apple_1", "person_1")]),
    ],
)
def test_a_slip_is_taken_back_within_a_request(text, done):
    assert goals(text) == done


@pytest.mark.parametrize(
    ("text", "same"),
    [
        ("where is the cup, sorry, the apple?", "where is the apple?"),
        ("how many apples, no, books are there?", "how many books are there?"),
        ("which room is the apple... I mean the key in?", "which room is the key in?"),
    ],
)
def test_a_slip_is_taken_back_within_a_question(text, same):
    assert read(text).reply == read(same).reply


@pytest.mark.parametrize(
    ("text", "done"),
    [
        ("actually, on the couch would be better", [("key_1", "couch_1")]),
        ("change of plan: on the couch please", [("key_1", "couch_1")]),
        ("thanks! now do the same with the apple", [("apple_1", "desk_1")]),
        ("forget the key, bring me the apple instead", [("apple_1", "person_2")]),
    ],
)
def test_a_remark_changes_the_request_before(text, done):
    assert goals(text, PUT) == done


def test_leaving_something_somewhere_is_no_remark():
    left = goals("leave the apple on the table in the kitchen", PUT)
    assert left == [("apple_1", "table_1")]


@pytest.mark.parametrize("text", ["take it to the doctor", "take it to Weber", "bring the doctor the apple"])
def test_a_part_of_a_name_names_the_person(text):
    assert goals(text, BROUGHT) == [("apple_1", "person_3")]


def test_what_somebody_wants_with_it_is_told_before_the_request():
    assert goals("Anna wants to see it too, take it to her", PUT) == [("key_1", "person_1")]


def test_the_colored_one_after_a_verb():
    bottle = Exchange(
        request="take the red bottle to Anna",
        goals=(Goal(predicate=Predicate.GIVEN, args=("bottle_2", "person_1")),),
        status="succeeded",
    )
    assert goals("and then take the blue one to the doctor", bottle) == [("bottle_1", "person_3")]
