"""Each kind of disturbance takes what belongs to it, and names the field that does not."""

from __future__ import annotations

import json

import pytest
from pydantic import TypeAdapter

from simulation.errors import DisturbError, HouseError
from simulation.houses.disturbances import Happening, parse_disturbance
from simulation.houses.house_file import parse_house

CUP = {"id": "new", "category": "cup"}
RIGHT = [
    {"do": "move", "id": "cup_1", "to": {"on": "table_1"}},
    {"do": "move", "id": "cup_1", "to": {"in": "sink_1", "on": None, "offset": [0.1, 0]}},
    {"do": "move", "id": "robot", "to": {"pose": [1, 2.5, 0.0]}, "object": None},
    {"do": "walk", "id": "ada", "to": {"pose": [1.0, 2.0]}},
    {"do": "add", "object": {**CUP, "on": "table_1"}, "to": None},
    {"do": "add", "object": {**CUP, "pose": [0, 0, 0, 0], "color": "light blue"}},
    {"do": "remove", "id": "cup_1"},
    {"do": "close_door", "id": "d1", "to": None, "object": None},
    {"do": "open_door", "id": "d1"},
]
WRONG = [
    ({"do": "explode"}, "input tag 'explode' found using 'do'"),
    ({"id": "cup_1"}, "unable to extract tag using discriminator 'do'"),
    ({"do": "move", "id": "cup_1"}, "to"),
    ({"do": "move", "to": {"on": "table_1"}}, "id"),
    ({"do": "move", "id": "cup_1", "to": {}}, "to: needs exactly one of on, in and pose"),
    ({"do": "move", "id": "cup_1", "to": {"on": "table_1", "in": "sink_1"}}, "to: needs exactly one"),
    ({"do": "move", "id": "cup_1", "to": {"pose": [0, 0, 0, 0], "offset": [0, 0]}}, "to.offset"),
    ({"do": "move", "id": "cup_1", "to": {"pose": ["0", 0]}}, "to.pose[0]"),
    ({"do": "walk", "id": "ada"}, "to"),
    ({"do": "walk", "to": {"pose": [1.0, 2.0]}}, "id"),
    ({"do": "walk", "id": "ada", "to": {"on": "table_1"}}, "to"),
    ({"do": "add"}, "object"),
    ({"do": "add", "object": CUP}, "object: needs exactly one"),
    ({"do": "add", "object": {**CUP, "pose": [0, 0, 0, 1e30]}}, "object.pose[3]"),
    ({"do": "add", "object": {**CUP, "on": "table_1", "color": "blurple"}}, "object.color"),
    ({"do": "remove", "id": "cup_1", "to": {"on": "table_1"}}, "to"),
    ({"do": "remove", "id": ""}, "id"),
    ({"do": "remove", "id": "cup_1", "at_s": 1.0}, "at_s"),
]


@pytest.mark.parametrize("event", RIGHT)
def test_what_belongs_to_a_kind_is_taken_also_with_nulls_for_what_does_not(event):
    happening = parse_disturbance(event)
    assert happening.do == event["do"]
    assert parse_disturbance(happening.model_dump(by_alias=True, exclude_none=True)) == happening


@pytest.mark.parametrize(("event", "told"), WRONG)
def test_what_does_not_is_named_by_the_path_of_its_field(event, told):
    with pytest.raises(DisturbError) as caught:
        parse_disturbance(event)
    assert str(caught.value).startswith(told)


@pytest.mark.parametrize(("event", "told"), [(event, told) for event, told in WRONG if "at_s" not in event])
def test_events_of_a_house_are_read_in_the_same_way(event, told):
    room = {"id": "a", "polygon": [[0, 0], [4, 0], [4, 3], [0, 3]]}
    house = {"rooms": [room], "doors": [], "robot": {"pose": [1, 1, 0]}, "events": [{"at_s": 1.0, **event}]}
    with pytest.raises(HouseError) as caught:
        parse_house(json.dumps(house))
    assert str(caught.value).startswith("events[0]")


def test_the_schema_tells_the_kinds_apart_and_what_each_needs():
    schema = TypeAdapter(Happening).json_schema()
    kinds = schema["discriminator"]["mapping"]
    needed = {do: set(schema["$defs"][at.rpartition("/")[2]]["required"]) - {"do"} for do, at in kinds.items()}
    assert needed == {
        "move": {"id", "to"},
        "walk": {"id", "to"},
        "add": {"object"},
        "remove": {"id"},
        "close_door": {"id"},
        "open_door": {"id"},
    }
