"""Endurance: requests are invented for the house as it has become, and memory that grows is noticed."""

from __future__ import annotations

import pytest

from evaluations.missions.endurance import EnduranceAims, as_it_is, grown, is_as_right
from evaluations.missions.outcome import Scene
from evaluations.missions.request_generator import invent
from simulation.houses.house import House
from simulation.houses.house_file import load_house

FLAT = load_house("flat")
AIMS = EnduranceAims()


def _record(entry, **place):
    return {"id": entry.id, "position_m": [1.0, 1.0, 0.8], "on": None, "in": None, **place}


def _scene(**moved):
    there = [
        _record(entry, **moved.get(entry.id, {"on": entry.on, "in": entry.in_}))
        for entry in FLAT.objects
        if moved.get(entry.id, {}) is not None
    ]
    return Scene(house=FLAT, truth={"objects": there})


def test_the_house_as_it_is_has_things_where_they_were_put_and_is_a_house_still():
    first, second, third = FLAT.objects[:3]
    spot = next(item.id for item in FLAT.furniture if item.id not in (first.on, first.in_))
    now = as_it_is(_scene(**{first.id: {"on": spot}, second.id: {"on": None}, third.id: None}))
    there = {entry.id: entry for entry in now.objects}
    assert there[first.id].on == spot
    assert there[first.id].offset is None
    assert there[first.id].pose is None
    assert there[second.id].pose == (1.0, 1.0, 0.8, 0.0)
    assert there[second.id].on is None
    assert third.id not in there
    assert House.model_validate_json(now.model_dump_json(by_alias=True, exclude_none=True)) == now


def test_what_stands_on_something_that_can_be_moved_stands_for_itself():
    first, second = FLAT.objects[:2]
    there = {entry.id: entry for entry in as_it_is(_scene(**{first.id: {"on": second.id}})).objects}
    assert there[first.id].on is None
    assert there[first.id].pose is not None


def test_requests_follow_the_things():
    things = {entry.id: {"on": None} for entry in FLAT.objects}
    asked = invent("flat", as_it_is(_scene(**things)), count=30, seed=1)
    assert not any(mission.things for mission in asked)  # all lie about, and only what is on furniture is asked for
    assert any(mission.things for mission in invent("flat", as_it_is(_scene()), count=30, seed=1))


@pytest.mark.parametrize(("leak_mb", "flat"), [(0.0, True), (0.2, False)])
def test_memory_that_grows_all_the_time_is_noticed_and_a_warm_up_is_not_held_against_it(leak_mb, flat):
    samples = [{"stamp_s": 10.0 * k, "mb": 100.0 + min(k, 50) + leak_mb * max(0, k - 50)} for k in range(1000)]
    assert (grown(samples, "mb") <= AIMS.growth) is flat


def test_a_run_of_no_length_has_not_grown():
    assert grown([{"stamp_s": 0.0, "mb": 100.0}], "mb") == 1.0


@pytest.mark.parametrize(
    ("worse", "right"),
    [
        ({}, True),
        ({"recall": 0.9 - 1.1 * AIMS.worse}, False),
        ({"precision": 1.0 - 1.1 * AIMS.worse}, False),
        ({"size_error_furniture_m": 0.05 + 1.1 * AIMS.swollen_m}, False),
        ({"size_error_furniture_m": 0.01}, True),
        ({"size_error_furniture_m": None}, False),
    ],
)
def test_a_graph_that_lost_things_or_whose_furniture_swells_is_noticed(worse, right):
    explored = {"recall": 0.9, "precision": 1.0, "size_error_furniture_m": 0.05}
    assert is_as_right(explored, {**explored, **worse}) is right
