"""Ways over the true free floor: lengths, doors, and what is out of reach."""

from __future__ import annotations

import math

from evaluations.missions.episodes import is_within_reach
from evaluations.missions.mission import Mission
from evaluations.missions.outcome import HAND, Outcome, Placed, RobotIn, Scene
from evaluations.missions.ways import Ways
from mission_scenes import CUP_ON_TABLE, FLAT, scene
from simulation.houses.house import Door, Person, Room


def test_the_shortest_way_is_no_shorter_than_the_line_and_a_shut_door_lengthens_or_ends_it():
    ways = Ways(scene())
    start, goal = ways.middle_of("kitchen"), ways.middle_of("office")
    length_m = ways.length_m(start, goal)
    assert math.dist(start, goal) - 0.8 <= length_m < 4.0 * math.dist(start, goal)
    doors = [door.id for door in ways.doors_between(start, goal)]
    assert doors
    assert Ways(scene(), shut=doors[:1]).length_m(start, goal) > length_m
    assert Ways(scene(shut=[door.id for door in FLAT.doors])).length_m(start, goal) == math.inf
    assert ways.is_free(start)


def test_a_way_into_a_room_ends_behind_its_door_and_lengthens_what_goes_before():
    ways = Ways(scene())
    start, goal = ways.middle_of("kitchen"), ways.middle_of("office")
    into_m = ways.length_m(start, "office")
    assert ways.length_m(start, "hall") < into_m < ways.length_m(start, goal) + 0.8
    assert ways.length_m(start, "kitchen") == 0.0
    there_and_back_m = ways.length_m(start, goal, "kitchen")
    assert there_and_back_m > ways.length_m(start, goal) + into_m - 2.0
    assert Ways(scene(shut=[door.id for door in FLAT.doors])).length_m(start, "office") == math.inf
    assert ways.length_m(start, (-50.0, 0.0)) == math.inf
    assert not ways.is_free((-50.0, 0.0))


def test_a_room_behind_shut_doors_is_out_of_reach_for_the_robot_as_for_what_it_brings():
    there, here = scene(CUP_ON_TABLE), scene(CUP_ON_TABLE, shut=[door.id for door in FLAT.doors])
    away = next(room.id for room in FLAT.rooms if room.id != here.robot_room)
    sent = [Mission(house="flat", kind="go", request="", outcomes=(Outcome(states=(state,)),)) for state in (
        RobotIn(rooms=(away,)), RobotIn(rooms=(here.robot_room,)), RobotIn(rooms=(away, here.robot_room)),
        Placed(things=(), places=(away,)), Placed(things=(), places=(HAND,)),
    )]  # fmt: skip
    assert [is_within_reach(mission, there, Ways(there)) for mission in sent] == [True] * 5
    assert [is_within_reach(mission, here, Ways(here)) for mission in sent] == [False, True, True, False, True]


def test_nobody_reaches_through_a_wall():
    rooms = [
        Room(id=name, polygon=((x_m, 0.0), (x_m + 4.0, 0.0), (x_m + 4.0, 3.0), (x_m, 3.0)))
        for name, x_m in (("west", 0.0), ("east", 4.2))
    ]
    door = Door(id="door_1", rooms=("west", "east"), center=(4.1, 2.0), width=0.9)
    house = FLAT.model_copy(update={"rooms": tuple(rooms), "doors": (door,), "furniture": (), "objects": ()})
    truth = {"doors": [{"id": "door_1", "state": "open"}], "objects": [], "robot": {"holding": None}}
    ways = Ways(Scene(house=house, truth=truth))
    west, by_the_wall = (3.6, 0.5), (4.3, 0.5)
    assert math.dist(west, by_the_wall) < 0.8
    assert [each.id for each in ways.doors_between(west, by_the_wall)] == ["door_1"]
    assert ways.length_m(west, by_the_wall) > 2.0
    box = {"id": "box_1", "category": "box", "position_m": [4.1, 2.0, 0.1], "on": None, "in": None}
    in_the_door = Scene(house=house, truth={**truth, "objects": [box]})
    assert Ways(in_the_door).length_m(west, by_the_wall) == math.inf
    assert Ways(in_the_door, spared=["box_1"]).length_m(west, by_the_wall) < math.inf
    people = [{"id": "person_1", "position_m": (4.1, 2.0, 0.9)}]
    stays = house.model_copy(update={"people": (Person(id="person_1", pose=(4.1, 2.0, 0.0)),)})
    leaves = stays.model_copy(update={"people": (Person(id="person_1", pose=(1.0, 2.0, 0.0)),)})
    assert Ways(Scene(house=stays, truth={**truth, "people": people})).length_m(west, by_the_wall) == math.inf
    assert Ways(Scene(house=leaves, truth={**truth, "people": people})).length_m(west, by_the_wall) < math.inf
    on_the_bed = Scene(house=house, truth={**truth, "objects": [{**box, "on": "bed_1"}]})
    assert Ways(on_the_bed).length_m(west, by_the_wall) < math.inf
