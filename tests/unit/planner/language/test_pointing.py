"""What *that is my mug* means after something was brought, found or asked about."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.goals import Goal, Predicate
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Exchange, Kind, Lesson
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from skills.registry import load_registry

PLANNER = TaskPlanner(CommandGrammar(), Verifier(load_registry([])))
SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))


def taught(request, *, moved="", mentioned=(), answers=()):
    goals = (Goal(predicate=Predicate.ON, args=(moved, "desk_1")),) if moved else ()
    dialogue = Dialogue(
        mentioned=(moved, *mentioned) if moved else mentioned,
        earlier=(Exchange(request="before", goals=goals),),
        answers=answers,
    )
    return PLANNER.read(request, SNAPSHOT, dialogue).interpretation


@pytest.mark.parametrize(
    "text", ["that's my story book", "this is my story book", "it's my story book", "call it my story book"]
)
def test_it_is_what_was_moved_last(text):
    found = taught(text, moved="book_3", mentioned=("book_1",))
    assert (found.kind, found.lessons) == (Kind.ANSWER, (Lesson(node="book_3", name="my story book"),))


def test_it_is_what_was_spoken_of_if_it_is_of_that_sort():
    found = taught("it's my house key", mentioned=("table_1", "key_1"))
    assert found.lessons == (Lesson(node="key_1", name="my house key"),)


@pytest.mark.parametrize("text", ["that's the wrong book", "that is my favourite", "that's the house key"])
def test_what_may_only_be_a_remark_is_asked_about(text):
    found = taught(text, moved="book_3")
    assert (found.kind, found.lessons) == (Kind.CLARIFY, ())


def test_nothing_spoken_of_is_pointed_at_by_another_sort():
    found = taught("that's my bicycle", mentioned=("table_1", "key_1"))
    assert (found.kind, found.lessons) == (Kind.CLARIFY, ())
