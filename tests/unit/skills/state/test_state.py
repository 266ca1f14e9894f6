"""The symbolic state: facts read from a snapshot, distances through doors, equality for search."""

from __future__ import annotations

import time
from dataclasses import replace

import pytest

from planner.goals import goal, holds_in
from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorState, ObjectState
from skills.facts import read_state
from skills.goto.goto import Goto
from skills.place.place import Place
from skills.state.state import DoorLink, PlaceRelation, Thing, World


def furnished(flat):
    return flat().table().bottle().table("table_2", 0.5, 0.0, room="room_2")


def test_state_reads_places_rooms_and_doors(flat):
    state = read_state(furnished(flat).memory.snapshot())
    assert state.places == {"bottle_1": (PlaceRelation.ON, "table_1")}
    assert (state.robot_room, state.robot_at, state.holding) == ("room_1", "room_1", None)
    assert state.world.doors == (DoorLink(door="door_1_1_0", rooms=("room_1", "room_2"), open=True),)
    assert state.room_of("bottle_1") == state.room_of("table_1") == "room_1"
    assert state.world.things["bottle_1"].width_m == pytest.approx(0.07)


@pytest.mark.parametrize(
    ("place", "inside"),
    [((0.0, 0.0), True), ((2.9, 2.0), True), ((3.2, 0.0), True), ((3.6, 2.0), False), ((-3.7, 0.0), False)],
    ids=["in the middle", "at the wall", "in the doorway", "behind the wall", "outdoors"],
)
def test_who_stands_beyond_the_walls_of_a_room_is_not_in_it(flat, place, inside):
    built = furnished(flat)
    with built.memory.edit("test", 0.0) as tx:
        tx.put(RtEdge(source="room_1", target="robot", T_source_target=SE3.from_xyz_yaw(*place, 0.0, 0.0)))
    snapshot = built.memory.snapshot()
    state, skill = read_state(snapshot), Goto()
    assert state.is_inside("room_1") is inside
    assert holds_in(goal("robot_at", "room_1"), snapshot) is inside
    assert (skill.confirmed(snapshot, ("room_1",), 0.0) is None) is inside
    assert skill.conditions(state, ("room_1",)) == []
    assert skill.effects(state, ("room_1",)).is_inside("room_1")


def test_what_is_put_onto_the_floor_of_a_room_is_not_put_down_outdoors(flat):
    built = furnished(flat)
    with built.memory.edit("test", 0.0) as tx:
        tx.put(RtEdge(source="room_1", target="robot", T_source_target=SE3.from_xyz_yaw(-3.7, 0.0, 0.0, 0.0)))
    state = read_state(built.memory.snapshot())
    held = state.after(holding="bottle_1", places=state.moved("bottle_1", None))
    assert Place().conditions(held, ("bottle_1", "room_1"))
    assert not Place().conditions(Goto().effects(held, ("room_1",)), ("bottle_1", "room_1"))


def test_distance_goes_through_the_door(flat):
    state = read_state(furnished(flat).memory.snapshot())
    # room_1's center to the door is 3 m; the door's map point to table_2 at (5.7, 0) is 2.7 m.
    assert state.distance_m("room_1", "table_2") == pytest.approx(5.7)


def test_distance_is_symmetric_and_zero_to_itself(flat):
    state = read_state(furnished(flat).memory.snapshot())
    things = list(state.world.things)
    for a in things:
        assert state.world.distance_m(a, a) == 0.0
        for b in things:
            assert state.world.distance_m(a, b) == state.world.distance_m(b, a)


def test_no_distance_and_the_door_named_when_it_is_closed(flat):
    built = flat(door_state=DoorState.CLOSED).table("table_2", 0.5, 0.0, room="room_2")
    state = read_state(built.memory.snapshot())
    assert state.distance_m("room_1", "table_2") is None
    assert state.world.closed_doors("room_1", "room_2") == ("door_1_1_0",)


def test_way_through_three_rooms_is_the_shorter_of_two():
    things = {room: Thing(id=room, kind="room", label="", position_m=p) for room, p in ROOMS.items()}
    doors = {name: Thing(id=name, kind="door", label="", room=a, position_m=p) for name, (a, _, p) in DOORS.items()}
    links = tuple(DoorLink(door=name, rooms=(a, b)) for name, (a, b, _) in DOORS.items())
    world = World(things={**things, **doors}, doors=links)
    # a -> d1 (1) -> d2 (2) -> c (1) = 4; the direct door d3 lies far away: 5 + 5.
    assert world.distance_m("a", "c") == pytest.approx(4.0)
    shut = World(things=world.things, doors=(replace(links[0], open=False), *links[1:]))
    assert shut.distance_m("a", "c") == pytest.approx(2 * (4**2 + 2**2) ** 0.5)
    assert world.closed_doors("a", "c") == ()


ROOMS = {"a": (0.0, 0.0), "b": (2.0, 0.0), "c": (4.0, 0.0)}
DOORS = {"d1": ("a", "b", (1.0, 0.0)), "d2": ("b", "c", (3.0, 0.0)), "d3": ("a", "c", (2.0, 4.0))}


def test_held_and_missing_objects_have_no_place(flat):
    built = furnished(flat)
    with built.memory.edit("test", 0.0) as tx:
        tx.put(replace(built.memory.snapshot().object("bottle_1"), state=ObjectState.MISSING))
    state = read_state(built.memory.snapshot())
    assert state.missing == {"bottle_1"}


def test_equal_facts_are_equal_states_and_different_facts_are_not(flat):
    state = read_state(furnished(flat).memory.snapshot())
    there_and_back = state.after(robot_at="table_1").after(robot_at=state.robot_at)
    assert state == there_and_back
    assert hash(state) == hash(there_and_back)
    assert state != state.after(robot_at="table_1")


def test_near_things_count_as_reached(flat):
    state = read_state(flat().table("table_1", 0.9, 0.0).bottle("bottle_1", 0.5, 0.0).memory.snapshot())
    assert state.is_at("bottle_1")
    assert state.is_at("table_1")
    far = read_state(furnished(flat).memory.snapshot())
    assert not far.is_at("table_1")


def test_standing_at_one_bottle_is_standing_at_its_neighbor_but_not_at_the_next_table(flat):
    built = furnished(flat).bottle("bottle_2", 1.2, 0.95)
    state = read_state(built.memory.snapshot()).after(robot_at="bottle_1")
    assert state.is_at("bottle_2")
    assert state.is_at("table_1")
    assert not state.is_at("table_2")


def test_being_in_a_room_is_not_being_at_what_lies_on_its_floor(flat):
    built = flat().thing("box_1", (-2.0, 1.0, 0.1), (0.1, 0.1, 0.2), graspable=True)
    state = read_state(built.memory.snapshot())
    assert state.places["box_1"] == (PlaceRelation.IN, "room_1")
    assert not state.is_at("box_1")


def test_carried_things_are_where_the_robot_is(flat):
    state = read_state(furnished(flat).memory.snapshot())
    held = state.after(holding="bottle_1", places={}, robot_at="table_2", robot_room="room_2")
    assert held.room_of("bottle_1") == "room_2"
    assert held.anchor("bottle_1") == "table_2"


def test_search_makes_thousands_of_states_a_second(flat):
    state = read_state(furnished(flat).memory.snapshot())
    started = time.perf_counter()
    seen = {state.after(robot_at=str(i), places={**state.places, "x": (PlaceRelation.ON, str(i))}) for i in range(3000)}
    assert len(seen) == 3000
    assert time.perf_counter() - started < 1.0
