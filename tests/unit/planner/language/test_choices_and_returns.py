"""What answers leave out, and what is put back after several things were moved, on the home of ``grammar_home``."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.goals import Goal, Predicate
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Exchange, Kind, Offer
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from skills.registry import load_registry

SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))
PLANNER = TaskPlanner(CommandGrammar(), Verifier(load_registry([])))

LEFT_OUT = [
    ("bring me the bottle", "not the {0} one", 1),
    ("bring me the bottle", "not {0}", 1),
    ("bring me the bottle", "anything but the {0} one", 1),
    ("bring me the bottle", "the one that isn't {0}", 1),
    ("bring me the bottle", "no, not the {1} one", 0),
]
"""A request that asks which, an answer with colors of the candidates, and which candidate it leaves."""


def heard(text, snapshot, dialogue):
    return PLANNER.read(text, snapshot, dialogue).interpretation


def colors(candidates):
    return [SNAPSHOT.node(i).color for i in candidates]


@pytest.mark.parametrize(("text", "answer", "left"), LEFT_OUT)
def test_an_answer_that_says_which_one_not_leaves_the_other(text, answer, left):
    asked = heard(text, SNAPSHOT, Dialogue())
    assert len(asked.candidates) == 2
    said = answer.format(*colors(asked.candidates))
    found = heard(text, SNAPSHOT, Dialogue(answers=(("Which one?", said),)))
    assert [goal.args[0] for goal in found.goals] == [asked.candidates[left]]


def test_an_answer_that_leaves_several_decides_nothing():
    text = "bring me the book"
    asked = heard(text, SNAPSHOT, Dialogue())
    found = heard(text, SNAPSHOT, Dialogue(answers=(("Which?", "not the blue one"),)))
    assert len(asked.candidates) == 3
    assert found.kind is Kind.CLARIFY


@pytest.mark.parametrize("text", ["undo that", "put it back", "take them back", "put that back where it was"])
def test_all_that_was_moved_together_goes_back(text):
    moved = {"cup_1": "table_1", "apple_1": "counter_1"}
    goals = tuple(Goal(predicate=Predicate.IN, args=(i, "room_4")) for i in moved)
    earlier = Exchange(request="", goals=goals, status="succeeded", explanation="")
    dialogue = Dialogue(earlier=(earlier,), mentioned=("apple_1", "cup_1"), origins=moved)
    there = home().snapshot(robot_in="room_4", at=(4.2, 4.2))
    found = heard(text, there, dialogue)
    assert {goal.args for goal in found.goals} == set(moved.items())


def exchange(*things):
    goals = tuple(Goal(predicate=Predicate.IN, args=(i, "room_4")) for i in things)
    return Exchange(request="", goals=goals, status="succeeded", explanation="")


ORIGINS = {"cup_1": "table_1", "apple_1": "counter_1"}


@pytest.mark.parametrize(
    "text", ["put both back", "take both of them back where they came from", "put everything back"]
)
def test_what_two_requests_moved_goes_back(text):
    earlier = (exchange("apple_1"), exchange("cup_1"))
    found = heard(text, SNAPSHOT, Dialogue(earlier=earlier, mentioned=("apple_1", "cup_1"), origins=ORIGINS))
    assert {goal.args for goal in found.goals} == set(ORIGINS.items())


def test_both_of_one_thing_is_asked_about():
    earlier = (exchange("apple_1"),)
    found = heard("put both back", SNAPSHOT, Dialogue(earlier=earlier, mentioned=("apple_1",), origins=ORIGINS))
    assert found.kind is Kind.CLARIFY


def test_both_are_the_two_things_taken_in_this_request():
    found = heard("take the key. take the phone. put both on the counter", SNAPSHOT, Dialogue())
    assert len({goal.args[0] for goal in found.goals}) == 2


def test_the_second_one_is_the_second_of_what_the_question_offered_whatever_has_turned_up_since():
    """A cup was brought instead of another: by the time that the request was read again, a third was known."""
    text = "bring me the book"
    asked = heard(text, SNAPSHOT, Dialogue())
    offered = asked.candidates[1:]
    offer = Offer(asked=asked.asked, candidates=offered)
    found = heard(text, SNAPSHOT, Dialogue(answers=(("Which one?", "the second one"),), offers=(offer,)))
    assert len(asked.candidates) == 3
    assert [goal.args[0] for goal in found.goals] == [offered[1]]


def test_what_was_chosen_is_meant_though_something_else_alone_is_called_so_now():
    chosen, other = "cup_1", "bottle_1"
    offer = Offer(asked="bottle", candidates=(other, chosen))
    found = heard("take the bottle", SNAPSHOT, Dialogue(answers=(("Which one?", "the second one"),), offers=(offer,)))
    assert [goal.args for goal in found.goals] == [(chosen,)]


def test_an_answer_to_what_is_no_longer_known_decides_nothing():
    text = "bring me the book"
    asked = heard(text, SNAPSHOT, Dialogue())
    offer = Offer(asked=asked.asked, candidates=(asked.candidates[0], "book_99"))
    found = heard(text, SNAPSHOT, Dialogue(answers=(("Which one?", "the second one"),), offers=(offer,)))
    assert found.kind is Kind.CLARIFY
