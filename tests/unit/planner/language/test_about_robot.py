"""What the robot says of itself."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.dialogue.interpreter import Interpreter
from planner.goals import Goal, Predicate
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Exchange
from planner.skill_planner.verifier import Verifier
from scene_graph.nodes import RoomStatus
from skills.registry import load_registry

INTERPRETER = Interpreter(CommandGrammar(), Verifier(load_registry([])))
SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))
BROUGHT = Exchange(
    request="bring me the apple",
    goals=(Goal(predicate=Predicate.GIVEN, args=("apple_1", "person_2")),),
    status="succeeded",
    explanation="The red apple is with user.",
)


def ask(text, *earlier):
    return INTERPRETER.read(text, SNAPSHOT, Dialogue(earlier=earlier)).interpretation


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("who are you?", "I am Majordomo"),
        ("hello! who are you?", "I am Majordomo"),
        ("are you a robot?", "I am Majordomo"),
        ("how are you?", "I am fine"),
        ("do you need charging?", "100 %"),
        ("are you tired?", "100 %"),
        ("what have you got there?", "I am holding nothing"),
        ("are you free?", "waiting for your request"),
        ("what could I ask you?", "I can go to places"),
        ("do you know my name?", "You are user"),
        ("explore", "I have seen all of the building that I can get to: 6 rooms."),
        ("have you seen the whole house?", "I have seen all of the building"),
        ("how do you know that?", "seen myself"),
        ("how long would it take you to get to the kitchen?", "I would need about"),
        ("how long does it take to bring me the apple?", "to bring you the red apple"),
        ("how long would it take to get to the bathroom?", "no open way"),
    ],
)
def test_questions_about_the_robot_are_answered(text, said):
    assert said in ask(text).reply


@pytest.mark.parametrize("text", ["have you finished?", "did it work?", "what did you do?", "where have you been?"])
def test_what_it_did_is_told(text):
    assert "bring me the apple" in ask(text, BROUGHT).reply


@pytest.mark.parametrize("status", ["running", "failed", "cancelled"])
def test_what_it_was_about_is_told_even_if_it_did_not_end_well(status):
    cut_off = Exchange(request=BROUGHT.request, goals=BROUGHT.goals, status=status, explanation="I was switched off.")
    assert "bring me the apple" in ask("what were you doing?", cut_off, BROUGHT).reply
    assert f"It is {status}" in ask("what were you doing?", cut_off, BROUGHT).reply


def test_what_never_began_is_not_told_as_a_deed():
    refused = Exchange(request=BROUGHT.request, goals=BROUGHT.goals, status="refused")
    assert ask("what were you doing?", refused).reply == "I have done nothing yet."


def test_fetching_takes_longer_than_going():
    def seconds(text):
        number, unit = ask(text).reply.removeprefix("I would need about ").split()[:2]
        return float(number) * (60 if unit.startswith("minute") else 1)

    assert seconds("how long to fetch the apple") > seconds("how long to reach the apple")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("did you bring the apple?", "Yes. You asked"),
        ("have you brought me the apple?", "Yes. You asked"),
        ("did you take the key?", "No, not that I remember. The silver key is on the table"),
        ("what did I ask you?", "bring me the apple"),
    ],
)
def test_deeds_are_remembered(text, said):
    assert said in ask(text, BROUGHT).reply
    assert not ask(text, BROUGHT).goals


def test_an_open_or_failed_request_is_not_said_to_be_done():
    running = Exchange(request="bring me the apple", goals=BROUGHT.goals, status="running")
    failed = Exchange(request="bring me the apple", goals=BROUGHT.goals, status="failed")
    assert ask("did you bring the apple?", running).reply.startswith("Not yet.")
    assert ask("did you bring the apple?", failed).reply.startswith("No.")


@pytest.mark.parametrize(
    ("before", "text", "same"),
    [
        ("where is the apple?", "and the key?", "where is the key?"),
        ("where is the apple?", "what about the key", "where is the key?"),
        ("how many books are there?", "and cups?", "how many cups are there?"),
        ("what is on the bed?", "and the desk?", "what is on the desk?"),
        ("how many cups are in the kitchen?", "and in the living room?", "how many cups are in the living room?"),
        ("is the red bottle in the office?", "and the blue one?", "is the blue bottle in the office?"),
    ],
)
def test_a_question_goes_on_with_something_else(before, text, same):
    assert ask(text, Exchange(request=before)).reply == ask(same).reply


def test_after_a_deed_another_thing_is_asked_for():
    assert ask("and the key", BROUGHT).goals


def test_how_far_the_robot_is():
    assert ask("how far are you from the kitchen").reply.startswith("The kitchen is about")


def test_while_there_is_more_to_explore_that_is_said_and_a_room_is_explored_by_going_there():
    unseen = home().room("room_7", "unknown", at=(20.0, 0.0), status=RoomStatus.TEMPORARY)
    unseen = unseen.snapshot(robot_in="room_2", at=(4.2, 0.0))
    reply = INTERPRETER.read("explore the rest of the flat", unseen, Dialogue()).interpretation.reply
    assert reply.startswith("I know 7 rooms so far, and there is more to see.")
    assert ask("explore the kitchen").goals == ask("go to the kitchen").goals
