"""Free space of supports and containers, as plans count on it."""

from __future__ import annotations

import pytest

from planner.doubles.sketch import Sketch
from planner.goals import goal
from planner.plan import Impossible, Plan
from planner.skill_planner.verifier import Verifier
from scene_graph.nodes import ObjectState
from skills.place.place_spot import spots_on
from skills.registry import load_registry

VERIFIER = Verifier(load_registry([]))


def room(**stool):
    """A room with a table full of cups, and a stool of 0.3 m."""
    sketch = Sketch().room("room_1", "kitchen", at=(0.0, 0.0))
    sketch.furniture("table_1", "table", "room_1", at=(0.0, 1.2))
    sketch.furniture("stool_1", "stool", "room_1", at=(1.2, -1.2), size_m=(0.3, 0.3, 0.5), **stool)
    for k in range(6):
        sketch.thing(f"cup_{k + 1}", "cup", on="table_1", at=(-0.5 + 0.2 * k, 1.2))
    return sketch


def planned(sketch, *goals):
    return VERIFIER.plan_for(goals, sketch.snapshot(robot_in="room_1", at=(0.0, -0.5)))


def on_stool(count):
    return [goal("on", f"cup_{k + 1}", "stool_1") for k in range(count)]


def test_a_small_stool_takes_some_cups_and_no_more():
    fitting = [count for count in range(1, 7) if isinstance(planned(room(), *on_stool(count)), Plan)]
    assert fitting == [1, 2, 3, 4]


def test_that_a_place_is_full_is_the_reason_in_a_persons_words():
    refusal = planned(room(), *on_stool(5))
    assert isinstance(refusal, Impossible)
    assert refusal.reason.startswith("The stool in the kitchen is full, the cup does not fit there")
    assert "stool_1" in refusal.nodes


def test_what_stands_there_already_takes_its_room():
    sketch = room().thing("vase_1", "vase", on="stool_1", size_m=(0.2, 0.2, 0.3), graspable=False)
    assert isinstance(planned(sketch, goal("on", "cup_1", "stool_1")), Impossible)


def test_what_is_carried_away_before_makes_room():
    sketch = room().thing("pot_1", "pot", on="stool_1", at=(1.2, -1.2), size_m=(0.1, 0.2, 0.2))
    assert isinstance(planned(sketch, goal("on", "cup_1", "stool_1")), Impossible)
    assert isinstance(planned(sketch, goal("on", "pot_1", "table_1"), goal("on", "cup_1", "stool_1")), Plan)


def test_what_is_missing_or_held_takes_no_room():
    pot = {"on": "stool_1", "size_m": (0.1, 0.2, 0.2)}
    gone = room().thing("pot_1", "pot", state=ObjectState.MISSING, **pot)
    assert isinstance(planned(gone, goal("on", "cup_1", "stool_1")), Plan)
    held = room().thing("pot_1", "pot", **pot).snapshot(robot_in="room_1", at=(0.0, -0.5), holding="pot_1")
    assert isinstance(VERIFIER.plan_for([goal("on", "cup_1", "stool_1")], held), Plan)


def test_the_next_nearest_surface_is_taken_when_the_nearest_is_full():
    sketch = room().thing("vase_1", "vase", on="stool_1", size_m=(0.2, 0.2, 0.3), graspable=False)
    sketch.furniture("shelf_1", "shelf", "room_1", at=(1.2, -0.2))
    plan = planned(sketch, goal("near", "cup_1", "stool_1"))
    assert isinstance(plan, Plan)
    assert plan.steps[-1].args == ("cup_1", "shelf_1")


@pytest.mark.parametrize(("size_m", "fits"), [((0.4, 0.4, 0.3), True), ((0.06, 0.06, 0.3), False)])
def test_into_a_container_goes_what_is_smaller_than_it(size_m, fits):
    sketch = room().furniture("box_1", "box", "room_1", at=(-1.2, -1.2), size_m=size_m)
    assert isinstance(planned(sketch, goal("in", "cup_1", "box_1")), Plan) == fits


def test_of_furniture_of_unknown_size_nothing_is_assumed():
    sketch = room().furniture("ledge_1", "ledge", "room_1", at=(-1.2, -1.2), size_m=(0.0, 0.0, 0.0))
    assert isinstance(planned(sketch, *(goal("on", f"cup_{k + 1}", "ledge_1") for k in range(6))), Plan)


@pytest.mark.parametrize(("gap_m", "fits"), [(0.135, True), (0.12, False)])
def test_a_cup_fits_into_a_gap_between_others_wherever_that_is(gap_m, fits):
    """A cup of 0.07 m needs 0.03 m on both sides."""
    sketch = Sketch().room("room_1", "kitchen", at=(0.0, 0.0))
    sketch.furniture("table_1", "coffee table", "room_1", at=(0.0, 1.0), size_m=(0.8, 0.18, 0.4))
    sketch.furniture("table_2", "table", "room_1", at=(0.0, -1.0)).thing("cup_1", "cup", on="table_2")
    for k, (left_m, right_m) in enumerate([(-0.4, -0.055), (gap_m - 0.055, 0.4)]):
        at, size_m = ((left_m + right_m) / 2, 1.0), (right_m - left_m, 0.1, 0.2)
        sketch.thing(f"vase_{k}", "vase", on="table_1", at=at, size_m=size_m, graspable=False)
    snapshot = sketch.snapshot(robot_in="room_1", at=(1.0, 0.0))
    assert isinstance(VERIFIER.plan_for([goal("on", "cup_1", "table_1")], snapshot), Plan) == fits
    assert bool(spots_on(snapshot, "table_1", (0.07, 0.07, 0.12), "cup_1")) == fits


def test_what_is_in_a_bowl_moves_with_it():
    sketch = (
        Sketch().room("room_1", at=(0.0, 0.0)).room("room_2", at=(4.2, 0.0)).door("room_1", "room_2", at=(2.1, 0.0))
    )
    sketch.furniture("table_1", "table", "room_1", at=(0.0, 1.0)).furniture("desk_1", "desk", "room_2", at=(4.2, 1.0))
    sketch.thing("bowl_1", "bowl", on="table_1", size_m=(0.08, 0.08, 0.08))
    sketch.thing("apple_1", "apple", on="bowl_1", relation="in")
    snapshot = sketch.snapshot(robot_in="room_1", at=(0.0, 0.0))
    plan = VERIFIER.plan_for([goal("on", "bowl_1", "desk_1"), goal("in", "apple_1", "room_2")], snapshot)
    assert isinstance(plan, Plan)
    assert [step.skill for step in plan.steps] == ["PICK", "GOTO", "PLACE"]
    out = VERIFIER.plan_for([goal("on", "bowl_1", "desk_1"), goal("on", "apple_1", "table_1")], snapshot)
    assert [str(step) for step in out.steps if step.skill == "PICK"] == ["PICK(bowl_1)", "PICK(apple_1)"]
