"""What a plan is foretold to change, against the two states compared by hand."""

from __future__ import annotations

from planner.forecast import forecast
from skills.state.placement import PlaceRelation
from skills.state.state import DoorLink, PlanState, World

DOOR = DoorLink(door="door_1", rooms=("room_1", "room_2"), open=False)


def state(*, room="room_1", holding=None, places=(), is_open=False):
    world = World(things={}, doors=(DOOR,)).with_door("door_1", is_open=is_open)
    return PlanState(world=world, robot_at=room, robot_room=room, holding=holding, places=dict(places))


def told(found):
    return [str(fact) for fact in found.added], [str(fact) for fact in found.removed]


def test_what_was_put_elsewhere_is_there_and_no_longer_here():
    before = state(places={"cup_1": (PlaceRelation.ON, "table_1"), "cup_2": (PlaceRelation.ON, "table_1")})
    after = state(places={"cup_1": (PlaceRelation.IN, "sink_1"), "cup_2": (PlaceRelation.ON, "table_1")})
    touched = ["cup_1", "cup_2", "sink_1", "cup_1"]
    assert told(forecast(before, after, touched)) == (["in(cup_1, sink_1)"], ["on(cup_1, table_1)"])


def test_what_is_in_the_hand_the_room_and_the_door_count_too():
    before = state(places={"cup_1": (PlaceRelation.ON, "table_1")})
    after = state(room="room_2", holding="cup_1", is_open=True)
    assert told(forecast(before, after, ["cup_1", "door_1"])) == (
        ["holding(cup_1)", "open(door_1)", "robot_at(room_2)"],
        ["on(cup_1, table_1)", "robot_at(room_1)"],
    )


def test_nothing_changes_where_nothing_is_done():
    assert told(forecast(state(), state(), [])) == ([], [])


def test_given_to_a_person_is_told_as_such():
    after = state(places={"cup_1": (PlaceRelation.GIVEN, "person_1")})
    assert told(forecast(state(holding="cup_1"), after, ["cup_1"])) == (["given(cup_1, person_1)"], ["holding(cup_1)"])
