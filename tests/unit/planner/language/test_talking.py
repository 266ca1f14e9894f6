"""What people say back: answers to the robot's questions, and words that stop it, hold it or call it off."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.language.grammar.parser import CommandGrammar
from planner.language.sentences.control import Control, control_word
from planner.plan import Dialogue, Kind
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from skills.registry import load_registry

PLANNER = TaskPlanner(CommandGrammar(), Verifier(load_registry([])))
SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))


def chosen(request, answer):
    read = PLANNER.read(request, SNAPSHOT, Dialogue(answers=(("?", answer),))).interpretation
    return {goal.args[0] for goal in read.goals}


@pytest.mark.parametrize(
    ("answer", "book"),
    [
        ("the blue one, silly", "book_2"),
        ("I think it was blue", "book_2"),
        ("she likes yellow", "book_3"),
        ("hmm, the yellow one I guess", "book_3"),
        ("it's on the shelf", "book_1"),
        ("green, from the office", "book_1"),
        ("that green one over there", "book_1"),
        ("the latter", "book_3"),
        ("the first one you mentioned", "book_1"),
        ("the yellow one of course, what else", "book_3"),
    ],
)
def test_an_answer_may_be_any_sentence_that_fits_one_candidate(answer, book):
    assert chosen("bring me the book", answer) == {book}


@pytest.mark.parametrize(
    "answer",
    [
        "the yellow one in the kitchen",
        "the red one",
        "not the yellow one",
        "the blue or the yellow one",
        "the one she always reads",
        "I think it was in the bedroom",
        "no idea",
    ],
)
def test_an_answer_that_fits_none_or_several_chooses_nothing(answer):
    assert chosen("bring me the book", answer) == set()


@pytest.mark.parametrize("answer", ["not the red one, the other", "hmm, not the red one", "anything but the red one"])
def test_what_is_left_out_leaves_the_other(answer):
    assert chosen("bring me the bottle", answer) == {"bottle_1"}


def test_a_request_in_the_place_of_an_answer_is_a_request():
    read = PLANNER.read("bring me the book", SNAPSHOT, Dialogue(answers=(("?", "go to the bedroom"),)))
    assert [goal.args for goal in read.interpretation.goals] == [("room_5",)]


@pytest.mark.parametrize(
    ("text", "control"),
    [
        ("STOP THE ROBOT NOW", Control.STOP),
        ("stop it right there", Control.STOP),
        ("Robot, stop what you're doing this instant", Control.STOP),
        ("that's enough now", Control.STOP),
        ("cut it out", Control.STOP),
        ("halt everything", Control.STOP),
        ("pause the task", Control.PAUSE),
        ("take five", Control.PAUSE),
        ("You may continue now.", Control.RESUME),
        ("keep going please", Control.RESUME),
        ("okay, get on with it", Control.RESUME),
        ("I changed my mind, forget the whole thing.", Control.CANCEL),
        ("I don't need it anymore", Control.CANCEL),
        ("never mind, leave it", Control.CANCEL),
    ],
)
def test_control_in_many_words(text, control):
    assert control_word(text) is control


@pytest.mark.parametrize(
    "text",
    ["stop at the kitchen", "stop by the office", "pause at the door", "continue to the office", "take five cups",
     "I don't need the cup anymore", "stop, then go to the kitchen", "freeze the peas", "wait in the hall"],
)  # fmt: skip
def test_what_says_more_is_no_control(text):
    assert control_word(text) is None


def test_an_unclear_answer_asks_again():
    read = PLANNER.read("bring me the book", SNAPSHOT, Dialogue(answers=(("?", "the pretty one"),)))
    assert read.interpretation.kind is Kind.CLARIFY
