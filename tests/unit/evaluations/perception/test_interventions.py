"""What a person may do behind the robot's back, and what not."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluations.perception.interventions import KINDS, Gaze, interventions
from simulation.houses.disturbances import parse_disturbance
from simulation.houses.house import House

HOUSE = House.model_validate(
    {
        "rooms": [
            {"id": "k", "polygon": [[0, 0], [8, 0], [8, 3], [0, 3]]},
            {"id": "b", "polygon": [[8.2, 0], [12, 0], [12, 3], [8.2, 3]]},
        ],
        "doors": [{"id": "d", "rooms": ["k", "b"], "center": [8.1, 1.5]}],
        "furniture": [
            {"id": "table", "category": "table", "pose": [2.0, 1.0, 0.0]},
            {"id": "desk", "category": "desk", "pose": [6.0, 1.0, 0.0]},
            {"id": "bench", "category": "bench", "pose": [10.0, 1.0, 0.0]},
            {"id": "wardrobe", "category": "wardrobe", "pose": [11.0, 2.6, 0.0]},
        ],
        "robot": {"pose": [4.0, 1.0, 0.0]},
    }
)


def entry(name, on):
    return {"id": name, "category": "cup", "color": "red", "position_m": [0, 0, 0], "room": "k", "on": on, "in": None}


TRUTH = {"objects": [entry("cup", "table"), entry("plate", "desk"), entry("apple", "plate"), entry("ball", None)]}
AWAY = Gaze(x_m=100.0, y_m=100.0, yaw_rad=0.0, half_width_rad=0.5)


def possible(kind, rooms=("k", "b"), gaze=AWAY, known=None, seed=0):
    return interventions(kind, HOUSE, TRUTH, np.random.default_rng(seed), rooms=rooms, gaze=gaze, known=known)


@pytest.mark.parametrize("kind", KINDS)
def test_every_deed_is_one_that_the_simulator_reads(kind):
    assert possible(kind)
    for intervention in possible(kind):
        assert parse_disturbance(dict(intervention.event)).do == kind


def test_only_what_stands_on_furniture_and_carries_nothing_is_taken():
    assert {intervention.thing for intervention in possible("remove")} == {"cup"}


def test_a_moved_thing_goes_to_another_piece_of_furniture():
    for seed in range(20):
        (intervention,) = possible("move", seed=seed)
        assert intervention.places[0] == "table"
        assert intervention.places[1] in {"desk", "bench"}
        assert intervention.event["to"] == {"on": intervention.places[1]}


def test_only_what_the_graph_knows_is_moved_or_taken():
    assert not possible("remove", known={"plate"})
    assert not possible("move", known={"plate"})


def test_nothing_changes_in_rooms_that_were_not_found():
    assert {intervention.places for intervention in possible("add", rooms=("k",))} == {("table",), ("desk",)}
    assert not possible("remove", rooms=("b",))


def test_nothing_changes_where_the_camera_looks():
    ahead = Gaze(x_m=4.0, y_m=1.0, yaw_rad=0.0, half_width_rad=0.5)
    behind = Gaze(x_m=4.0, y_m=1.0, yaw_rad=math.pi, half_width_rad=0.5)
    assert {intervention.places for intervention in possible("add", rooms=("k",), gaze=ahead)} == {("table",)}
    assert {intervention.places for intervention in possible("add", rooms=("k",), gaze=behind)} == {("desk",)}
    assert not possible("remove", gaze=behind)


@pytest.mark.parametrize(
    ("x_m", "y_m", "met"), [(2, 0, True), (2, 1.05, False), (2, 1.3, False), (-1, 0, False), (7, 0, False)]
)
def test_a_gaze_meets_what_is_ahead_and_near(x_m, y_m, met):
    assert Gaze(x_m=0.0, y_m=0.0, yaw_rad=0.0, half_width_rad=0.48).meets(x_m, y_m) is met


def test_a_gaze_meets_a_disc_that_reaches_into_it_or_around_it():
    gaze = Gaze(x_m=0.0, y_m=0.0, yaw_rad=0.0, half_width_rad=0.48)
    assert gaze.meets(2.0, 1.2, 0.3)
    assert gaze.meets(-0.2, 0.0, 0.3)


def test_what_is_brought_is_new_and_the_same_for_the_same_seed():
    first, again, other = (possible("add", seed=seed)[0] for seed in (3, 3, 4))
    assert first == again != other
    assert first.thing not in {entry["id"] for entry in TRUTH["objects"]}
