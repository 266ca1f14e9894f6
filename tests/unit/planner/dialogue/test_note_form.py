"""Requests in note form, on the home of ``grammar_home``."""

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


def heard(text):
    return PLANNER.read(text, SNAPSHOT, Dialogue()).interpretation


@pytest.mark.parametrize(
    ("text", "goal"),
    [
        ("Pen. Kitchen.", "in(pen_1, room_1)"),
        ("The key. The desk, please.", "on(key_1, desk_1)"),
        ("phone. office. thanks", "in(phone_1, room_4)"),
    ],
)
def test_a_thing_and_a_place_in_note_form_are_a_request(text, goal):
    assert [str(each) for each in heard(text).goals] == [goal]


@pytest.mark.parametrize("text", ["Pen. Key.", "Kitchen. Pen.", "Kitchen. Office.", "Pen. Sofa bed."])
def test_other_notes_are_asked_about_or_refused(text):
    assert heard(text).kind is not Kind.PLAN
