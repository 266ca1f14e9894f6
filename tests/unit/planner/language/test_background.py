"""What is only told around a request, and what a request is about, on the home of ``grammar_home``."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Kind
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from skills.registry import load_registry

SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))
PLANNER = TaskPlanner(CommandGrammar(), Verifier(load_registry([])))

TOLD = [
    ("the office is a mess, put the pen on the couch", "on(pen_1, couch_1)"),
    ("a kid was playing with the key, take it to the office", "in(key_1, room_4)"),
    ("put the key on the desk, a kid was playing with it", "on(key_1, desk_1)"),
    ("the key and the pen are clutter, move them to the bedroom", "in(key_1, room_5) in(pen_1, room_5)"),
    ("somebody left the key on the table, bring it to Anna", "given(key_1, person_1)"),
    ("Anna has been waiting for the remote all morning, take it to her", "given(remote_1, person_1)"),
    ("my wife Anna forgot the key, take it to her", "given(key_1, person_1)"),
    ("I'm finished washing my hands so the key can go to the office", "in(key_1, room_4)"),
    ("the key belongs to Anna, give it to her", "given(key_1, person_1)"),
    ("the pen fell over, put it on the couch", "on(pen_1, couch_1)"),
    ("the kettle is whistling, bring me the key", "given(key_1, person_2)"),
    ("that was silly, bring me the key", "given(key_1, person_2)"),
    ("I can't reach the key, pass it to me", "given(key_1, person_2)"),
    ("put the key on the desk before it gets lost", "on(key_1, desk_1)"),
    ("Anna is cooking and needs the key", "given(key_1, person_1)"),
    ("bring me the key I am off to work", "given(key_1, person_2)"),
    ("the pen shouldn't lie there, put it on the couch", "on(pen_1, couch_1)"),
    ("my back is killing me, bring me the key", "given(key_1, person_2)"),
    ("as I'm cooking right now please fetch the key", "given(key_1, person_2)"),
    ("bring me the key, I want to lie down", "given(key_1, person_2)"),
    ("bring the key to Anna in the living room she works there", "given(key_1, person_1)"),
]
ABOUT = [
    ("the key, bring it to Anna", "given(key_1, person_1)"),
    ("the key which is silver, bring it to Anna", "given(key_1, person_1)"),
    ("the key - fetch it", "given(key_1, person_2)"),
    ("the key, could you put it on the desk", "on(key_1, desk_1)"),
    ("the key and the pen, put them on the couch", "on(key_1, couch_1) on(pen_1, couch_1)"),
    ("whatever is on the desk next to the pen, bring it to Anna", "given(bottle_2, person_1)"),
    ("that key, hand it over", "given(key_1, person_2)"),
    ("the key, could I have it?", "given(key_1, person_2)"),
    ("the only silver key in the house, I'd like to use it", "given(key_1, person_2)"),
    ("everything on the bed, put it on the desk", "on(book_2, desk_1) on(book_3, desk_1)"),
]
KEPT = [
    "my violin is broken, bring it to me",
    "the violin is on the desk with the pen, bring it to me",
    "the pen is broken and the key is new, put it on the couch",
    "the cups are to be washed, bring me the key",
    "the cups need washing, bring me the key",
    "I never liked the key, bring it to me",
    "I am allergic to nuts, bring me the apple",
    "I hate the red one, bring me a cup",
    "you should wash the cups, bring me the key",
    "the door must be shut, bring me the key",
    "the pen is to go to the office, bring me the key and the cups have to be washed",
    "Anna asked me to wash the cups, bring me the key",
    "bring me the key when I call",
    "I can't drink from the red cup, bring me a cup",
    "I want to drink the juice, bring me a cup",
    "bring me the key if I am off to work",
]
"""What says more than it tells, or leaves open what *it* is: nothing is done."""


def heard(text):
    return PLANNER.read(text, SNAPSHOT, Dialogue()).interpretation


@pytest.mark.parametrize(("text", "goals"), TOLD)
def test_a_statement_is_left_aside_and_says_what_a_pronoun_means(text, goals):
    found = heard(text)
    assert found.kind is Kind.PLAN, found.reply
    assert sorted(str(goal) for goal in found.goals) == sorted(goals.replace(") ", ")|").split("|"))


@pytest.mark.parametrize(("text", "goals"), ABOUT)
def test_a_noun_phrase_in_front_is_what_the_pronoun_means(text, goals):
    found = heard(text)
    assert found.kind is Kind.PLAN, found.reply
    assert sorted(str(goal) for goal in found.goals) == sorted(goals.replace(") ", ")|").split("|"))


@pytest.mark.parametrize("text", KEPT)
def test_what_may_be_a_wish_or_a_rule_is_not_left_aside(text):
    found = heard(text)
    assert found.kind is not Kind.PLAN, [str(goal) for goal in found.goals]
