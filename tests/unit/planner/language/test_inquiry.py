"""Questions in unusual orders of words are the same questions."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.dialogue.interpreter import Interpreter
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Kind
from planner.skill_planner.verifier import Verifier
from skills.registry import load_registry

INTERPRETER = Interpreter(CommandGrammar(), Verifier(load_registry([])))
SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))


def ask(text):
    return INTERPRETER.read(text, SNAPSHOT, Dialogue()).interpretation


SAME = [
    ("hey where the apple at", "where is the apple"),
    ("where would I find an apple", "where is an apple"),
    ("where was the key last", "where is the key"),
    ("where might the key be now", "where is the key"),
    ("where all are the books", "where are the books"),
    ("where has Anna been hiding", "where is Anna"),
    ("where has Anna left the key", "where is the key"),
    ("on what is the key lying", "where is the key"),
    ("which room is Anna sitting in", "which room is Anna in"),
    ("which rooms have a sink in them", "which room has a sink"),
    ("in which room are there books", "which room has books"),
    ("is Anna in the kitchen or in the living room", "where is Anna"),
    ("how many books do we own altogether", "how many books are there"),
    ("how many books are there still on the bed", "how many books are on the bed"),
    ("how many of the cups are in the kitchen", "how many cups are in the kitchen"),
    ("how many bottles does Anna have left in the office", "how many bottles are in the office"),
    ("what are the colors of the books", "what color are the books"),
    ("which color is it, the key", "which color is it, the key"),
    ("who do I find in the living room", "who is in the living room"),
    ("who is playing in the living room", "who is in the living room"),
    ("what else is on the bed", "what is on the bed"),
    ("what is usually kept on the desk", "what is on the desk"),
    ("which book is on the shelf, the green or the blue one", "which book is on the shelf"),
    ("isn't the key on the table", "is the key on the table"),
    ("is there still an apple in the kitchen", "is there an apple in the kitchen"),
    ("are there any books left on the bed", "are there any books on the bed"),
]


@pytest.mark.parametrize(("said", "plain"), SAME)
def test_the_order_of_words_does_not_change_a_question(said, plain):
    told, expected = ask(said), ask(plain)
    assert told.kind is expected.kind
    assert told.reply == expected.reply


@pytest.mark.parametrize(
    "text",
    [
        "where is the cup that I broke yesterday",
        "how many cups did Anna wash in the kitchen",
        "which year were you born",
        "where can I sit",
    ],
)
def test_a_question_that_says_more_than_that_is_not_answered_in_part(text):
    assert ask(text).kind in (Kind.CLARIFY, Kind.REFUSE)


def test_what_nobody_knows_is_still_asked_about():
    assert "no unicorn" in ask("where would I find a unicorn").reply
    assert "no unicorns" in ask("how many unicorns do we own").reply.replace("unicorn ", "unicorns ")


def test_a_question_never_moves_anything():
    for text in ("where did you put the key", "which room did you bring the apple to", "where do you get the cup"):
        assert not ask(text).goals


def test_to_find_and_to_be_asked_where_is_one_question():
    assert not ask("find Anna for me. Which room is she in?").goals
    assert "living room" in ask("find Anna for me. Which room is she in?").reply
    assert ask("find Anna, then go to the kitchen").goals
