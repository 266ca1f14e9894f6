"""A skill from an installed package: search, verifier, schema and prompt know it without other change."""

from __future__ import annotations

from dataclasses import replace

import pytest

from paths import PACKAGES
from planner.doubles.sketch import Sketch
from planner.goals import goal, holds_in
from planner.language.grammar.parser import CommandGrammar
from planner.naming import step_phrase
from planner.plan import Dialogue, Impossible, Plan
from planner.skill_planner.skill_planner import SkillPlanner, skill_lines
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from scene_graph.nodes import DoorState
from skills.registry import load_registry


@pytest.fixture
def skills(monkeypatch):
    monkeypatch.syspath_prepend(str(PACKAGES))
    return load_registry()


def three_rooms():
    """Kitchen, hall and office in a row behind closed doors, a cup in the kitchen, the robot in the office."""
    sketch = Sketch().room("room_1", "kitchen", at=(0.0, 0.0)).room("room_2", "hall", at=(4.2, 0.0))
    sketch.room("room_3", "office", at=(8.4, 0.0))
    sketch.door("room_1", "room_2", at=(2.1, 0.0), state=DoorState.CLOSED)
    sketch.door("room_2", "room_3", at=(6.3, 0.0), state=DoorState.CLOSED)
    sketch.furniture("table_1", "table", "room_1", at=(0.0, 1.0)).furniture("desk_1", "desk", "room_3", at=(8.4, 1.0))
    return sketch.thing("cup_1", "cup", on="table_1").snapshot(robot_in="room_3", at=(8.4, 0.0))


GOALS = [goal("on", "cup_1", "desk_1")]


def test_a_plan_opens_the_doors_on_its_way_and_is_proven(skills):
    snapshot, verifier = three_rooms(), Verifier(skills)
    plan = verifier.plan_for(GOALS, snapshot)
    assert isinstance(plan, Plan), plan
    assert [step.skill for step in plan.steps] == [*("GOTO", "OPEN") * 2, "GOTO", "PICK", "GOTO", "PLACE"]
    assert verifier.check_plan(plan, snapshot) == []
    without = replace(plan, steps=tuple(step for step in plan.steps if step.skill != "OPEN"))
    assert "is closed" in verifier.check_plan(without, snapshot)[0].message
    assert step_phrase(plan.steps[1], snapshot) == "open the door between the hall and the office"


def test_without_the_package_the_closed_doors_are_the_reason():
    refusal = Verifier(load_registry([])).plan_for(GOALS, three_rooms())
    assert isinstance(refusal, Impossible)
    assert "cannot open doors" in refusal.reason


def test_schema_prompt_and_phrases_know_it(skills):
    described = {entry["name"]: entry for entry in SkillPlanner(skills).describe()}
    assert described["OPEN"]["schema"]["required"] == ["door"]
    assert "- OPEN(door): open a closed door." in skill_lines(Verifier(skills).skills)
    assert skills.phrases() == {"OPEN": ("open {door}", "unlock {door}")}


@pytest.mark.parametrize(
    ("text", "goals"),
    [
        ("open the door between the hall and the office", ["open(door_2_0_1)"]),
        ("please unlock the door between the kitchen and the hall", ["open(door_1_0_0)"]),
        (
            "open the door between the hall and the kitchen, then go to the kitchen",
            ["open(door_1_0_0)", "robot_at(room_1)"],
        ),
        ("open both doors", ["open(door_1_0_0)", "open(door_2_0_1)"]),
    ],
)
def test_what_a_package_can_do_is_asked_for_in_its_words(skills, text, goals):
    snapshot, verifier = three_rooms(), Verifier(skills)
    found = TaskPlanner(CommandGrammar(), verifier).read(text, snapshot, Dialogue()).interpretation
    assert [str(goal) for goal in found.goals] == goals, found.reply
    plan = verifier.plan_for(found.goals, snapshot)
    assert isinstance(plan, Plan), plan
    assert verifier.check_plan(plan, snapshot) == []
    assert "OPEN" in {step.skill for step in plan.steps}


def test_only_doors_are_opened_and_only_with_the_package(skills):
    for known, said in ((skills, "doors only"), (load_registry([]), "cannot open")):
        planner = TaskPlanner(CommandGrammar(), Verifier(known))
        found = planner.read("open the cup", three_rooms(), Dialogue()).interpretation
        assert not found.goals
        assert said in found.reply
    flaws = Verifier(load_registry([])).verify_goals([goal("open", "door_1_0_0")], three_rooms())
    assert [flaw.message for flaw in flaws] == ["I cannot open doors."]
    assert "doors only" in Verifier(skills).verify_goals([goal("open", "cup_1")], three_rooms())[0].message


def test_a_door_is_found_open_in_the_graph(skills):
    snapshot = three_rooms()
    opened = Sketch().room("room_1", "kitchen", at=(0.0, 0.0)).room("room_2", "hall", at=(4.2, 0.0))
    opened.door("room_1", "room_2", at=(2.1, 0.0))
    assert not holds_in(goal("open", "door_1_0_0"), snapshot)
    assert holds_in(goal("open", "door_1_0_0"), opened.snapshot(robot_in="room_1", at=(0.0, 0.0)))
