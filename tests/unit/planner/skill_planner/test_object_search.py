"""In which order the robot looks for what is not in its place, or was never seen."""

import pytest

from planner.doubles.sketch import Sketch, flat
from planner.plan import Impossible
from planner.skill_planner.likely_rooms import room_weights
from planner.skill_planner.verifier import Verifier
from scene_graph.nodes import ObjectState
from skills.registry import load_registry

VERIFIER = Verifier(load_registry())


def row(*labels):
    """Rooms in a row, 4 m apart, each with one table; the robot is in the first one."""
    sketch = Sketch()
    for number, label in enumerate(labels, start=1):
        x_m = 4.0 * number
        sketch.room(f"room_{number}", label, at=(x_m, 0.0))
        sketch.furniture(f"table_{number}", "table", f"room_{number}", at=(x_m, 1.0))
        if number > 1:
            sketch.door(f"room_{number - 1}", f"room_{number}", at=(x_m - 2.0, 0.0))
    return sketch


def rooms_in_order(plan, snapshot):
    return list(dict.fromkeys(snapshot.room_of(step.args[0]) or step.args[0] for step in plan.steps))


def scouted(sketch, kind):
    snapshot = sketch.snapshot(robot_in="room_1", at=(4.0, 0.0))
    return rooms_in_order(VERIFIER.scouting_plan(kind, snapshot, 95.0), snapshot)


@pytest.mark.parametrize(
    ("kind", "first"),
    [
        ("spoon", "kitchen"),
        ("banana", "kitchen"),
        ("screwdriver", "storage"),
        ("toothbrush", "bathroom"),
        ("stapler", "hall"),
    ],
)
def test_a_thing_never_seen_is_looked_for_first_where_its_kind_usually_lies(kind, first):
    labels = ("hall", "bathroom", "storage", "kitchen")
    assert labels[int(scouted(row(*labels), kind)[0].removeprefix("room_")) - 1] == first


def test_a_likely_room_at_the_other_end_of_the_building_waits_until_near_ones_were_looked_at():
    order = scouted(row("hall", *["bedroom"] * 12, "kitchen"), "spoon")
    assert order[0] == "room_1"
    assert order[-1] != "room_14"
    assert order.index("room_14") > 1


def test_a_room_with_more_of_the_kind_comes_before_one_without():
    sketch = row("bedroom", "hall", "bedroom").thing("clock_1", "clock", on="table_3")
    snapshot = sketch.snapshot(robot_in="room_2", at=(8.0, 0.0))
    order = rooms_in_order(VERIFIER.scouting_plan("clock", snapshot, 95.0), snapshot)
    assert order.index("room_3") < order.index("room_1")


def test_what_is_lost_is_looked_for_where_it_was_before_anywhere_else():
    sketch = row("hall", "kitchen", "bedroom").thing("cup_9", "cup", on="table_3", state=ObjectState.MISSING)
    snapshot = sketch.snapshot(robot_in="room_1", at=(4.0, 0.0))
    plan = VERIFIER.search_plan("cup_9", snapshot, 95.0)
    assert rooms_in_order(plan, snapshot) == ["room_3", "room_2", "room_1"]


@pytest.mark.parametrize(
    ("label", "first_seen_s", "looked_at"), [("unknown", 95.0, True), ("unknown", 85.0, False), ("cup", 95.0, False)]
)
def test_what_turned_up_without_a_name_may_be_what_is_lost_and_is_looked_at(label, first_seen_s, looked_at):
    sketch = row("hall", "kitchen").thing("cup_9", "cup", on="table_2", state=ObjectState.MISSING)
    sketch.thing("thing_1", label, on="table_1", first_seen_s=first_seen_s)
    snapshot = sketch.snapshot(robot_in="room_1", at=(4.0, 0.0))
    places = [step.args[0] for step in VERIFIER.search_plan("cup_9", snapshot, 95.0).steps]
    assert ("thing_1" in places) is looked_at
    assert isinstance(VERIFIER.search_plan("cup_9", snapshot, 95.0, places), Impossible)


def test_every_place_is_in_the_tour_once():
    snapshot = flat().snapshot(robot_in="room_2", at=(4.2, 0.0))
    places = [step.args[0] for step in VERIFIER.scouting_plan("hammer", snapshot, 95.0).steps]
    assert len(places) == len(set(places))
    assert {"table_1", "counter_1", "desk_1", "shelf_1", "room_1", "room_2", "room_3", "room_4"} <= set(places)


def test_a_word_for_a_room_is_as_good_as_its_usual_name_and_a_large_room_likelier_than_a_small_one():
    snapshot = row("hallway", "kitchenette", "bedroom").snapshot(robot_in="room_1", at=(4.0, 0.0))
    weights = room_weights(("cup",), None, snapshot)
    assert weights["room_2"] > weights["room_1"] == weights["room_3"]
    assert room_weights((), "room_3", snapshot)["room_3"] > weights["room_3"]
