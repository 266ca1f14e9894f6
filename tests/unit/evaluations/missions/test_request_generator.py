"""Requests are invented in words that fit one thing alone, and every thing is asked for once."""

from __future__ import annotations

import io

import numpy as np
import pytest
from rich.console import Console

from evaluations.missions.evaluation import evaluate
from evaluations.missions.request_generator import invent
from mission_scenes import CUP_ON_TABLE, FLAT, scene, task
from perception.network.shipped import SHIPPED
from simulation.houses.house import Furniture, Object

FLAT_THINGS = [{**CUP_ON_TABLE, "id": thing.id, "on": thing.on} for thing in FLAT.objects]


def test_invented_requests_are_the_same_for_a_seed_and_ask_for_every_thing_once():
    missions = invent("flat", FLAT, count=20, seed=3)
    assert missions == invent("flat", FLAT, count=20, seed=3)
    assert missions != invent("flat", FLAT, count=20, seed=4)
    asked = [thing for mission in missions for thing in mission.things]
    assert len(asked) == len(set(asked)) >= 4
    for mission in missions:
        assert not any(outcome.met(scene(*FLAT_THINGS), task()) for outcome in mission.outcomes if outcome.things)


def test_a_house_in_which_words_fit_nothing_alone_is_named_as_left_out(tmp_path):
    things = FLAT.model_copy(update={"rooms": tuple(r.model_copy(update={"label": "hall"}) for r in FLAT.rooms)})
    assert invent("halls", things, count=5, seed=0) == []
    (tmp_path / "halls.json").write_text(things.model_dump_json(by_alias=True))
    console = Console(file=io.StringIO(), width=200)
    all_met = evaluate(
        houses=[str(tmp_path / "halls.json")], commands=None, requests=5, disturb=(), seeds=(0,), model=SHIPPED, jobs=1,
        json_file=None, console=console,
    )  # fmt: skip
    assert not all_met
    assert "halls.json: left out" in console.file.getvalue()


@pytest.mark.parametrize(("x_m", "asked"), [(0.0, True), (0.85, False)])
def test_what_was_put_into_the_arm_of_a_sofa_is_not_asked_for_as_it_slips_off(x_m, asked):
    room = next(room for room in FLAT.rooms if room.label == "office")
    x, y = np.array(room.polygon).mean(axis=0).tolist()
    sofa = Furniture(id="sofa_9", category="sofa", size=(1.84, 0.87, 0.85), pose=(x, y, 0.0))
    bottle = Object(id="bottle_9", category="bottle", on="sofa_9", offset=(x_m, -0.1))
    house = FLAT.model_copy(update={"furniture": (sofa,), "objects": (bottle,), "people": ()})
    missions = [mission for seed in range(6) for mission in invent("flat", house, count=9, seed=seed)]
    assert any("bottle" in mission.request for mission in missions) is asked


def test_a_thing_is_called_by_its_kind_or_a_plain_color_or_its_place_never_by_words_that_fit_two():
    bottle = {"category": "bottle", "on": "table_1"}
    things = [
        Object(id="bottle_1", color="blue", **bottle), Object(id="bottle_2", color="dark cream", **bottle),
        Object(id="bottle_3", color="blue", category="bottle", on="desk_1"),
        Object(id="cup_1", color="red", category="cup", on="table_1"),
        Object(id="cup_2", color="white", category="cup", on="table_1"),
        Object(id="book_1", color="light teal", category="book", on="table_1"),
    ]  # fmt: skip
    house = FLAT.model_copy(update={"objects": tuple(things)})
    requests = [mission.request for seed in range(8) for mission in invent("flat", house, count=20, seed=seed)]
    said = " | ".join(requests)
    for words in ("the bottle from the desk in the office", "the red cup", "the white cup", "the book"):
        assert words in said
    for words in ("cream", "the blue bottle", "the bottle from the table"):
        assert words not in said


def test_where_a_thing_of_its_kind_is_asked_for_by_its_place_no_other_is_brought_before():
    furniture = {item.id for item in FLAT.furniture if item.id in ("desk_1", "table_1", "table_2", "shelf_1")}
    cups = [Object(id=f"cup_{k}", category="cup", on=on) for k, on in enumerate(sorted(furniture))]
    house = FLAT.model_copy(update={"objects": tuple(cups)})
    stands_on = {cup.id: cup.on for cup in cups}
    asked = [mission for seed in range(8) for mission in invent("flat", house, count=20, seed=seed) if mission.things]
    assert any(" from " in mission.request for mission in asked)
    for mission in asked:
        assert not {*mission.places} & {*stands_on.values()}, mission.request
