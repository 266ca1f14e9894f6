"""What nobody has seen lately is neither open nor closed: it is said, and asked about where a request turns on it."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.dialogue.selection import confirms
from planner.grounding.openness import is_open
from planner.language.grammar.parser import CommandGrammar
from planner.plan import Dialogue, Kind
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from scene_graph.nodes import DoorState
from skills.registry import load_registry

PLANNER = TaskPlanner(CommandGrammar(), Verifier(load_registry([])))


def house(state=DoorState.UNKNOWN):
    sketch = home().room("room_7", "pantry", at=(-6.0, 0.0)).door("room_1", "room_7", at=(-3.0, 0.0), state=state)
    return sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))


def ask(text, *answers, snapshot=None):
    dialogue = Dialogue(answers=tuple(("?", answer) for answer in answers))
    return PLANNER.read(text, snapshot or house(), dialogue).interpretation


def test_a_room_behind_doors_of_which_none_is_known_is_not_known_to_be_open():
    assert is_open("room_7", house()) is None
    assert is_open("room_7", house(DoorState.OPEN)) is True
    assert is_open("room_6", house()) is False
    assert is_open("table_1", house()) is None


def test_doors_that_nobody_has_seen_lately_are_not_listed_as_open_but_named():
    opened, unknown = ask("which doors are open?").reply.split(" I do not know whether ")
    assert "pantry" not in opened
    assert "pantry" in unknown


@pytest.mark.parametrize("text", ["which doors are closed?", "how many doors are open?", "is every door open?"])
def test_other_questions_about_doors_say_what_is_not_known(text):
    assert "I do not know whether" in ask(text).reply or ask(text).reply.startswith("No.")


def test_one_closed_door_is_enough_to_say_that_not_all_are_open():
    assert ask("are all the doors open?").reply.startswith("No.")


@pytest.mark.parametrize(
    "condition",
    ["the door to the pantry is open", "the pantry is open", "the pantry door is closed", "the pantry is not closed"],
)
def test_a_condition_on_what_is_not_known_is_asked_about(condition):
    asked = ask(f"if {condition}, go to the kitchen")
    assert asked.kind is Kind.CLARIFY
    assert asked.reply.endswith(f"Is it so that {condition}?")
    assert ask(f"if {condition}, go to the kitchen", "yes").goals
    assert ask(f"if {condition}, go to the kitchen", "yes it is").goals
    assert not ask(f"if {condition}, go to the kitchen", "no").goals
    assert not ask(f"if {condition}, go to the kitchen", "it isn't").goals


def test_a_condition_on_a_door_that_was_seen_needs_no_question():
    assert ask("if the pantry is open, go to the kitchen", snapshot=house(DoorState.OPEN)).goals
    assert not ask("if the pantry is open, go to the kitchen", snapshot=house(DoorState.CLOSED)).goals
    assert ask("unless the pantry is open, go to the kitchen", snapshot=house(DoorState.CLOSED)).goals


@pytest.mark.parametrize(
    ("answer", "asked", "so"),
    [
        ("yes", "the door is open", True),
        ("it's open", "the door is open", True),
        ("open", "the door is closed", False),
        ("it is not closed", "the door is closed", False),
        ("no", "the door is open", False),
        ("nope", "the door is open", False),
        ("bring me the cup", "the door is open", None),
    ],
)
def test_an_answer_settles_a_condition(answer, asked, so):
    assert confirms(answer, asked) is so


def test_all_is_more_than_some():
    assert ask("are all the cups in the kitchen?").reply.startswith("No.")
    assert ask("are the books on the bed?").reply.startswith("No.")
    assert ask("are there two cups on the table in the kitchen?").reply.startswith("No, I know of only 1.")
    assert ask("is a cup in the kitchen?").reply.startswith("Yes.")
    assert ask("are both books in the bedroom on the bed?").reply.startswith("Yes.")
