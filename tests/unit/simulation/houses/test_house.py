"""House files: what is wrong is named by the path of its field."""

from __future__ import annotations

import copy
import json

import pytest

from simulation.errors import HouseError
from simulation.houses.house import furniture_places, room_at
from simulation.houses.house_file import builtin_houses, load_house, parse_house

HOUSE = {
    "rooms": [
        {"id": "a", "label": "kitchen", "polygon": [[0, 0], [4, 0], [4, 3], [0, 3]]},
        {"id": "b", "label": "hall", "polygon": [[4.2, 0], [8, 0], [8, 3], [4.2, 3]]},
    ],
    "doors": [{"id": "d", "rooms": ["a", "b"], "center": [4.1, 1.5], "width": 0.9, "height": 2.0, "state": "open"}],
    "furniture": [{"id": "t", "category": "table", "pose": [2, 1, 0], "size": [1.2, 0.8, 0.75]}],
    "objects": [{"id": "o", "category": "bottle", "color": "blue", "on": "t", "offset": [0.1, 0.0]}],
    "people": [{"id": "p", "name": "Ada", "pose": [5, 1, 0]}],
    "robot": {"pose": [1, 1, 0]},
    "events": [{"at_s": 4.0, "do": "move", "id": "o", "to": {"on": "t"}}],
}


def changed(path, value):
    house = copy.deepcopy(HOUSE)
    *way, last = path
    place = house
    for step in way:
        place = place[step]
    place[last] = value
    return json.dumps(house)


def test_the_house_of_these_tests_is_well_formed():
    house = parse_house(json.dumps(HOUSE))
    assert room_at(house, 2.0, 1.0) == "a"
    assert furniture_places(house) == {"t": ("table", "kitchen")}


@pytest.mark.parametrize(
    ("path", "value", "named"),
    [
        (("doors", 0, "center"), [9.0, 9.0], "doors[0].center"),
        (("doors", 0, "rooms"), ["a", "cellar"], "doors[0].rooms"),
        (("doors", 0, "width"), -0.9, "doors[0].width"),
        (("doors", 0, "state"), "ajar", "doors[0].state"),
        (("rooms", 0, "colour"), "red", "rooms[0].colour"),
        (("rooms", 1, "id"), "a", "rooms[1].id"),
        (("rooms", 0, "polygon"), [[0, 0], [4, 3], [4, 0], [0, 3]], "rooms[0].polygon"),
        (("rooms", 0, "polygon"), [[0, 3], [4, 3], [4, 0], [0, 0]], "rooms[0].polygon"),
        (("rooms", 1, "polygon"), [[3, 0], [8, 0], [8, 3], [3, 3]], "rooms"),
        (("furniture", 0, "size"), [1.2, -0.8, 0.75], "furniture[0].size"),
        (("objects", 0, "on"), "shelf", "objects[0].on"),
        (("objects", 0, "pose"), [1, 1, 0, 0], "objects[0]"),
        (("objects", 0, "color"), "blurple", "objects[0].color"),
        (("robot", "pose"), [20, 20, 0], "robot.pose"),
        (("robot", "pose"), [1, 1], "robot.pose"),
        (("wall_thickness",), 0, "wall_thickness"),
        (("events", 0, "do"), "explode", "events[0]"),
    ],
)
def test_what_is_wrong_is_named_by_the_path_of_its_field(path, value, named):
    with pytest.raises(HouseError) as caught:
        parse_house(changed(path, value))
    assert str(caught.value).startswith(named)


@pytest.mark.parametrize("missing", ["rooms", "doors", "robot"])
def test_rooms_doors_and_robot_are_required_and_nothing_else(missing):
    house = {key: value for key, value in HOUSE.items() if key in {"rooms", "doors", "robot"}}
    parse_house(json.dumps(house))
    del house[missing]
    with pytest.raises(HouseError, match=f"^{missing}"):
        parse_house(json.dumps(house))


def test_broken_json_is_told_by_line_and_column():
    with pytest.raises(HouseError, match="line 1"):
        parse_house(json.dumps(HOUSE)[:-7])


def test_an_unknown_house_is_answered_with_those_there_are():
    with pytest.raises(HouseError, match="flat"):
        load_house("castle")


def test_the_example_houses_cover_what_the_readme_promises():
    houses = {name: load_house(name) for name in builtin_houses()}
    assert {"flat": 3, "office": 6, "ward": 10}.items() <= {n: len(h.rooms) for n, h in houses.items()}.items()
    assert any(len(room.polygon) == 6 for room in houses["loft"].rooms)
    categories = {item.category for house in houses.values() for item in (*house.furniture, *house.objects)}
    assert len(categories) >= 20
