"""The verifier: flaws named, plans proven, and nothing unproven let through."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.doubles.sketch import Sketch, flat
from planner.goals import goal, holds, lasting
from planner.plan import Impossible, Plan, Source, Step
from planner.skill_planner.verifier import Verifier
from scene_graph.nodes import DoorState, ObjectState
from skills.registry import load_registry

SKILLS = load_registry([])
VERIFIER = Verifier(SKILLS)
SNAPSHOT = flat().snapshot(robot_in="room_2", at=(4.2, 0.0))


def carried_out(plan, snapshot):
    state = VERIFIER.state(snapshot)
    for step in plan.steps:
        assert SKILLS[step.skill].conditions(state, step.args) == [], step
        state = SKILLS[step.skill].effects(state, step.args)
    return state


def two_rooms(state: DoorState) -> Sketch:
    sketch = Sketch().room("room_1", "kitchen", at=(0.0, 0.0)).room("room_2", "hall", at=(4.2, 0.0))
    sketch.door("room_1", "room_2", at=(2.1, 0.0), state=state)
    sketch.furniture("table_1", "table", "room_1", at=(0.0, 1.0)).furniture("table_2", "table", "room_2", at=(4.2, 1.0))
    return sketch.thing("cup_1", "cup", on="table_1")


@pytest.mark.parametrize(
    "goals",
    [
        [goal("on", "cup_1", "desk_1")],
        [goal("in", "apple_1", "box_1")],
        [goal("in", "cup_1", "room_4")],
        [goal("near", "cup_1", "laptop_1")],
        [goal("given", "book_1", "person_1")],
        [goal("holding", "cup_3")],
        [goal("found", "apple_1")],
        [goal("robot_at", "room_3")],
        [goal("robot_at", "door_2_0_1")],
        [goal("robot_at", "room_1"), goal("robot_at", "room_3"), goal("robot_at", "room_1")],
        [goal("on", "cup_1", "desk_1"), goal("on", "cup_1", "couch_1")],
        [goal("on", f"cup_{k}", "desk_1") for k in (1, 2, 3)]
        + [goal("holding", "apple_1"), goal("robot_at", "room_3")],
    ],
    ids=lambda goals: " ".join(map(str, goals)),
)
def test_sound_goals_get_a_plan_that_symbolic_execution_carries_through(goals):
    plan = VERIFIER.plan_for(goals, SNAPSHOT)
    assert isinstance(plan, Plan)
    assert all(holds(g, carried_out(plan, SNAPSHOT)) for g in lasting(goals))
    assert plan.revision == SNAPSHOT.revision
    assert plan.expected_s > 0
    assert plan.expected_m >= 0


@pytest.mark.parametrize(
    ("goals", "reason"),
    [
        ([goal("on", "cup_7", "desk_1")], "cup_1, cup_2, cup_3"),
        ([goal("on", "table_1", "desk_1")], "cannot carry the table"),
        ([goal("holding", "laptop_1")], "cannot carry the gray laptop"),
        ([goal("on", "cup_1", "plant_1")], "put on the potted plant"),
        ([goal("in", "cup_1", "desk_1")], "put in the desk"),
        ([goal("given", "cup_1", "desk_1")], "people only"),
        ([goal("near", "cup_1", "room_1")], "near the kitchen"),
        ([goal("near", "cup_1", "plant_1")], "no surface near the potted plant"),
        ([goal("on", "room_1", "desk_1")], "is a room"),
        ([goal("on", "cup_1", "cup_1")], "itself"),
        ([goal("holding", "cup_1"), goal("holding", "cup_2")], "one hand"),
        ([goal("holding", "cup_1"), goal("on", "cup_2", "desk_1")], "one hand"),
        ([goal("robot_at", "robot")], "not a room"),
        ([goal("robot_at", "nowhere")], "not in the scene graph"),
    ],
)
def test_unsound_goals_are_refused_with_the_reason(goals, reason):
    flaws = VERIFIER.verify_goals(goals, SNAPSHOT)
    assert any(reason in flaw.message for flaw in flaws)
    refusal = VERIFIER.plan_for(goals, SNAPSHOT)
    assert isinstance(refusal, Impossible)
    assert refusal.reason == flaws[0].message


def test_things_cannot_stand_on_each_other_in_a_circle():
    sketch = flat().furniture("tray_1", "tray", "room_1", at=(1.0, 1.0), graspable=True)
    sketch.furniture("tray_2", "tray", "room_1", at=(1.0, -1.0), graspable=True)
    goals = [goal("on", "tray_1", "tray_2"), goal("on", "tray_2", "tray_1")]
    flaws = VERIFIER.verify_goals(goals, sketch.snapshot(robot_in="room_1", at=(0.0, 0.0)))
    assert any("each other" in flaw.message for flaw in flaws)


def test_behind_a_closed_door_there_is_no_way_and_the_door_is_named():
    closed = two_rooms(DoorState.CLOSED).snapshot(robot_in="room_2", at=(4.2, 0.0))
    refusal = VERIFIER.plan_for([goal("on", "cup_1", "table_2")], closed)
    assert isinstance(refusal, Impossible)
    assert "the door between the kitchen and the hall is closed" in refusal.reason
    assert "door_1_0_0" in refusal.nodes
    opened = two_rooms(DoorState.OPEN).snapshot(robot_in="room_2", at=(4.2, 0.0))
    assert isinstance(VERIFIER.plan_for([goal("on", "cup_1", "table_2")], opened), Plan)


def test_a_full_hand_is_emptied_first():
    holding = flat().snapshot(robot_in="room_2", at=(4.2, 0.0), holding="apple_1")
    plan = VERIFIER.plan_for([goal("on", "cup_1", "desk_1")], holding)
    assert isinstance(plan, Plan)
    assert plan.steps[0].skill == "PLACE"
    assert plan.steps[0].args[0] == "apple_1"


def test_what_is_held_already_is_not_put_down_first():
    holding = flat().snapshot(robot_in="room_2", at=(4.2, 0.0), holding="cup_1")
    plan = VERIFIER.plan_for([goal("on", "cup_1", "desk_1")], holding)
    assert isinstance(plan, Plan)
    assert [str(step) for step in plan.steps] == ["GOTO(desk_1)", "PLACE(cup_1, desk_1)"]


def test_what_stands_on_an_object_is_moved_away_first():
    sketch = flat().thing("tray_1", "tray", on="table_1", support=True).thing("cup_9", "cup", on="tray_1")
    snapshot = sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))
    plan = VERIFIER.plan_for([goal("on", "tray_1", "desk_1")], snapshot)
    assert isinstance(plan, Plan)
    picked = [step.args[0] for step in plan.steps if step.skill == "PICK"]
    assert picked == ["cup_9", "tray_1"]


def shelved(**can):
    """An apple on the middle board of a shelf at the office's wall, and a can before it."""
    sketch = flat().furniture(
        "shelf_2", "shelf", "room_4", at=(4.2, 6.0), size_m=(0.9, 0.35, 1.6), surfaces_m=(0.4, 0.8, 1.2, 1.6)
    )
    sketch.thing("apple_2", "apple", on="shelf_2", at=(4.2, 6.1), size_m=(0.07, 0.07, 0.07), bottom_m=0.8)
    sketch.thing("can_1", "can", on="shelf_2", at=(4.23, 5.95), size_m=(0.066, 0.066, 0.12), bottom_m=0.8, **can)
    return sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))


def test_what_stands_before_a_thing_on_a_board_is_moved_away_first():
    plan = VERIFIER.plan_for([goal("on", "apple_2", "table_1")], shelved())
    assert isinstance(plan, Plan)
    assert [step.args[0] for step in plan.steps if step.skill == "PICK"] == ["can_1", "apple_2"]
    assert [step.args[0] for step in plan.steps if step.skill == "PLACE"] == ["can_1", "apple_2"]
    assert VERIFIER.check_plan(plan, shelved()) == []
    both = [replace(goal("on", x, "table_1"), any_order=True) for x in ("apple_2", "can_1")]
    plan = VERIFIER.plan_for(both, shelved())
    assert isinstance(plan, Plan)
    assert [str(step) for step in plan.steps if step.skill != "GOTO"] == [
        "PICK(can_1)", "PLACE(can_1, table_1)", "PICK(apple_2)", "PLACE(apple_2, table_1)"
    ]  # fmt: skip


def test_what_stands_before_it_but_is_missing_does_not_keep_the_hand_from_a_thing():
    plan = VERIFIER.plan_for([goal("on", "apple_2", "table_1")], shelved(state=ObjectState.MISSING))
    assert isinstance(plan, Plan)
    assert [step.args[0] for step in plan.steps if step.skill == "PICK"] == ["apple_2"]


def test_something_too_wide_for_the_fingers_is_refused_with_its_width():
    sketch = flat().thing("ball_1", "ball", on="table_1", size_m=(0.3, 0.3, 0.3))
    refusal = VERIFIER.plan_for([goal("on", "ball_1", "desk_1")], sketch.snapshot(robot_in="room_1", at=(0.0, 0.0)))
    assert isinstance(refusal, Impossible)
    assert "0.30 m wide" in refusal.reason


def test_goals_that_hold_need_no_steps():
    plan = VERIFIER.plan_for([goal("on", "cup_1", "table_1")], SNAPSHOT)
    assert isinstance(plan, Plan)
    assert plan.steps == ()


def test_steps_without_their_goto_or_pick_do_not_pass():
    sound = VERIFIER.plan_for([goal("on", "cup_1", "desk_1")], SNAPSHOT)
    assert isinstance(sound, Plan)
    assert VERIFIER.check_plan(sound, SNAPSHOT) == []
    for left_out in range(len(sound.steps)):
        broken = replace(sound, steps=sound.steps[:left_out] + sound.steps[left_out + 1 :])
        assert VERIFIER.check_plan(broken, SNAPSHOT), broken


def test_steps_in_another_order_do_not_pass():
    sound = VERIFIER.plan_for([goal("on", "cup_1", "desk_1")], SNAPSHOT)
    assert isinstance(sound, Plan)
    assert VERIFIER.check_plan(replace(sound, steps=sound.steps[::-1]), SNAPSHOT)


def test_a_plan_is_checked_again_when_the_graph_has_moved_on():
    memory = flat().memory(robot_in="room_2", at=(4.2, 0.0))
    plan = VERIFIER.plan_for([goal("on", "cup_1", "desk_1")], memory.snapshot())
    assert isinstance(plan, Plan)
    with memory.edit("objects", 101.0) as tx:
        tx.put(replace(memory.snapshot().object("cup_1"), state=ObjectState.MISSING))
    assert "look for it" in VERIFIER.check_plan(plan, memory.snapshot())[0].message
    with memory.edit("objects", 102.0) as tx:
        tx.remove("cup_1")
    assert "no longer on my map" in VERIFIER.check_plan(plan, memory.snapshot())[0].message


def test_a_missing_object_is_no_flaw_of_a_goal():
    sketch = flat().thing("cup_9", "cup", on="table_1", state=ObjectState.MISSING)
    snapshot = sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))
    assert VERIFIER.verify_goals([goal("found", "cup_9")], snapshot) == []


def test_the_search_begins_in_the_room_of_the_last_place_with_what_was_never_inspected():
    sketch = flat().thing("cup_9", "cup", on="table_1", state=ObjectState.MISSING)
    sketch.furniture("shelf_9", "shelf", "room_1", at=(1.6, -1.6), inspected_s=50.0)
    snapshot = sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))
    plan = VERIFIER.search_plan("cup_9", snapshot, 95.0)
    assert isinstance(plan, Plan)
    assert (plan.source, plan.seeking, plan.goals) == (Source.SEARCH, "cup_9", (goal("found", "cup_9"),))
    assert [step.args[0] for step in plan.steps][:4] == ["table_1", "counter_1", "shelf_9", "room_1"]
    assert {step.args[0] for step in plan.steps} >= {"table_2", "desk_1", "room_3", "room_4"}
    assert VERIFIER.check_plan(plan, snapshot) == []


def test_places_looked_at_are_not_looked_at_again_and_in_the_end_the_object_is_gone():
    sketch = flat().thing("cup_9", "cup", on="table_1", state=ObjectState.MISSING)
    snapshot = sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))
    looked: frozenset[str] = frozenset()
    for _ in range(50):
        plan = VERIFIER.search_plan("cup_9", snapshot, 95.0, looked)
        if isinstance(plan, Impossible):
            assert "everywhere" in plan.reason
            return
        assert plan.steps[0].args[0] not in looked
        looked |= {plan.steps[0].args[0]}
    pytest.fail("the search never ends")


def test_what_was_inspected_since_the_search_began_is_left_out():
    sketch = flat().furniture("shelf_9", "shelf", "room_1", at=(1.6, -1.6), inspected_s=97.0)
    snapshot = sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))
    plan = VERIFIER.search_plan("cup_1", snapshot, 95.0)
    assert isinstance(plan, Plan)
    assert Step(skill="GOTO", args=("shelf_9",)) not in plan.steps
