"""Conditions as people state them, and names as they tell them."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.dialogue.interpreter import Interpreter
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue
from planner.skill_planner.verifier import Verifier
from skills.registry import load_registry

INTERPRETER = Interpreter(CommandGrammar(), Verifier(load_registry([])))
SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))


def read(text):
    return INTERPRETER.read(text, SNAPSHOT, Dialogue()).interpretation


def goals(text):
    return [goal.args for goal in read(text).goals]


@pytest.mark.parametrize(
    ("text", "done"),
    [
        ("Is Anna in the living room? If she is, take her the apple.", [("apple_1", "person_1")]),
        ("Is Anna in the living room? If she isn't, take her the apple.", []),
        ("Is Anna in the kitchen? If she isn't, go to the office.", [("room_4",)]),
        ("Go into the bathroom if it's open. If it isn't, come to me.", [("person_2",)]),
        ("Go into the kitchen if it is closed, otherwise come to me.", [("person_2",)]),
        ("Only if Anna is in the living room should you bring her the apple.", [("apple_1", "person_1")]),
        ("If we still have an apple in the kitchen bring it to Anna.", [("apple_1", "person_1")]),
        ("Provided that we have more than two books in the bedroom, go to the bedroom.", []),
        ("Provided that we have more than one book in the bedroom, go to the bedroom.", [("room_5",)]),
        ("Bring me an apple if we have any.", [("apple_1", "person_2")]),
        ("Bring Anna a pear if there is one, if not the apple.", [("apple_1", "person_1")]),
        ("If the bathroom door is not shut, go to the bedroom.", []),
        ("If the bathroom door is shut, go to the bedroom.", [("room_5",)]),
    ],
)
def test_a_condition_decides(text, done):
    assert goals(text) == done


@pytest.mark.parametrize(
    ("text", "node", "called"),
    [
        ("The living room is what we call the parlor.", "room_3", "parlor"),
        ("we call the office the study, please remember", "room_4", "study"),
        ("The office has been renamed to lab.", "room_4", "lab"),
        ("Call the office the front desk from today.", "room_4", "front desk"),
        ("we renamed the office, it is called lab now", "room_4", "lab"),
        ("The room you are standing in is called the foyer.", "room_2", "foyer"),
        ("the office's new name is study", "room_4", "study"),
        ("Could we name the office study?", "room_4", "study"),
        ("the office should be called the study", "room_4", "study"),
        ("change the name of the office to study", "room_4", "study"),
    ],
)
def test_rooms_are_renamed_in_many_words(text, node, called):
    (lesson,) = read(text).lessons
    assert (lesson.node, lesson.label) == (node, called)


@pytest.mark.parametrize("name", ["Greta", "Rosanna", "Tabel", "Marc"])
def test_a_name_is_taken_as_it_is_typed(name):
    (lesson,) = read(f"My name is {name}.").lessons
    assert lesson.name == name
