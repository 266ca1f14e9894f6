"""What a mission is to come to, and whether the truth has it so."""

from __future__ import annotations

import pytest

from evaluations.missions.outcome import HAND, Outcome, Placed, RobotIn, stirred
from mission_scenes import CUP, CUP_ON_TABLE, FLAT, scene, task
from planner.tasks.tasks import TaskStatus


@pytest.mark.parametrize(
    ("place", "there"), [("table_1", True), ("kitchen", True), ("desk_1", False), ("office", False), (HAND, False)]
)
def test_a_thing_is_where_the_truth_has_it(place, there):
    assert scene(CUP_ON_TABLE).is_at("cup_1", place) is there


def test_what_is_in_the_hand_is_nowhere_else_and_what_is_on_a_tray_is_on_the_table_too():
    assert scene(CUP_ON_TABLE, holding="cup_1").is_at("cup_1", HAND)
    assert not scene(CUP_ON_TABLE, holding="cup_1").is_at("cup_1", "kitchen")
    tray = {**CUP_ON_TABLE, "id": "tray_1"}
    assert scene({**CUP, "on": "tray_1"}, tray).is_at("cup_1", "table_1")


def test_a_thing_is_with_a_person_when_they_can_reach_it():
    x_m, y_m, _ = FLAT.people[0].pose
    person = FLAT.people[0].id
    assert scene({**CUP, "on": None, "position_m": [x_m + 1.5, y_m, 0.0]}).is_at("cup_1", person)
    assert not scene({**CUP, "on": None, "position_m": [x_m + 2.5, y_m, 0.0]}).is_at("cup_1", person)


def test_an_outcome_needs_state_and_words_and_a_refusal_needs_an_honest_end():
    placed = Outcome(states=(Placed(things=("cup_1",), places=("table_1",)),))
    assert placed.met(scene(CUP_ON_TABLE), task())
    assert not placed.met(scene({**CUP, "on": "desk_1"}), task())
    assert Outcome(words=("kitchen",)).met(scene(), task(reply="It is in the Kitchen."))
    assert not Outcome(words=("kitchen",)).met(scene(), task(reply="It is in the hall."))
    assert Outcome(refused=True).met(scene(), task(TaskStatus.REFUSED))
    assert not Outcome(refused=True).met(scene(), task())
    room = scene().robot_room
    assert RobotIn(rooms=(room,)).met(scene())
    assert not RobotIn(rooms=("nowhere",)).met(scene())


def test_things_that_nobody_asked_for_and_that_moved_are_counted():
    there = {**CUP_ON_TABLE, "position_m": [2.0, 1.0, 0.8]}
    assert stirred(scene(CUP_ON_TABLE), scene(there), frozenset()) == ("cup_1",)
    assert stirred(scene(CUP_ON_TABLE), scene(there), frozenset({"cup_1"})) == ()
    assert stirred(scene(CUP_ON_TABLE), scene(there), frozenset({"table_1"})) == ()
    assert stirred(scene(CUP_ON_TABLE), scene(CUP_ON_TABLE), frozenset()) == ()
