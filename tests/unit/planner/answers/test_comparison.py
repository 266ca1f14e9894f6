"""Which has most, which is bigger: compared on the graph, and said when there is nothing to compare."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.dialogue.interpreter import Interpreter
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Kind, QueryKind
from planner.skill_planner.verifier import Verifier
from skills.registry import load_registry

INTERPRETER = Interpreter(CommandGrammar(), Verifier(load_registry([])))
SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))


def ask(text):
    return INTERPRETER.read(text, SNAPSHOT, Dialogue()).interpretation


@pytest.mark.parametrize(
    "text",
    [
        "which room has the most cups?",
        "where are most of the cups?",
        "in which room do we have the most cups?",
        "what room has most cups in it?",
        "which room do most of the cups live in?",
    ],
)
def test_the_room_with_the_most_of_something(text):
    assert ask(text).query.kind is QueryKind.MOST
    assert ask(text).reply == "The kitchen, with 2 cups."


def test_places_that_have_as_many_are_all_named():
    assert ask("which room has the fewest cups?").reply.endswith("with no cups each.")
    assert "the office" in ask("which room has the fewest cups?").reply


def test_the_fullest_and_the_emptiest():
    assert ask("which room is the fullest?").reply == ask("which room has the most things?").reply
    assert ask("which table is emptier?").reply == ask("which table has the fewest things?").reply


@pytest.mark.parametrize(
    "text",
    [
        "which has more cups, the kitchen or the office?",
        "are there more cups in the office or in the kitchen?",
        "are there as many cups in the office as in the kitchen?",
        "who has more cups, the kitchen or the office?",
    ],
)
def test_two_places_are_counted_side_by_side(text):
    assert ask(text).reply == "The kitchen: 2 cups; the office: no cups."


@pytest.mark.parametrize(
    ("text", "reply"),
    [
        ("does the kitchen have more cups than the office?", "Yes. The kitchen: 2 cups; the office: no cups."),
        ("are there more cups in the kitchen than in the office?", "Yes. The kitchen: 2 cups; the office: no cups."),
        ("are there more cups in the office than in the kitchen?", "No. The kitchen: 2 cups; the office: no cups."),
        ("are there fewer cups in the office than in the kitchen?", "Yes. The office: no cups; the kitchen: 2 cups."),
    ],
)
def test_whether_there_are_more_is_answered_with_yes_or_no(text, reply):
    assert ask(text).reply == reply


@pytest.mark.parametrize(
    ("text", "reply"),
    [
        ("which is bigger, the blue bottle or the red one?", "The red bottle"),
        ("which one is smaller: the red bottle or the blue bottle?", "The blue bottle"),
        ("is the red bottle bigger than the blue bottle?", "Yes: the red bottle"),
        ("is the blue bottle bigger than the red one?", "No: the red bottle"),
        ("which is closer, the kitchen or the bedroom?", "The kitchen"),
        ("is the bedroom farther than the kitchen?", "Yes: the bedroom"),
    ],
)
def test_two_things_are_compared(text, reply):
    assert ask(text).reply.startswith(reply)


def test_a_thing_is_not_compared_with_itself_and_an_unclear_one_is_asked_about():
    assert "only one" in ask("which is bigger, the apple or the red apple?").reply
    assert ask("which is bigger, the cup or the apple?").kind is Kind.CLARIFY


def test_what_is_not_known_is_not_counted():
    assert "unicorn" in ask("which room has the most unicorns?").reply
