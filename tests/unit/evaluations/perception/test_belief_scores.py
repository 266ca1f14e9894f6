"""The figures of ``evaluate perception``, from a graph that is right, and from ones that are wrong in one way each."""

from __future__ import annotations

from dataclasses import asdict, replace

import numpy as np
import pytest

from evaluations.perception.belief_scores import Sightings, score_house, summarize
from evaluations.perception.inventory import (
    GraphContents,
    GraphThing,
    graph_contents,
    sizes_of,
    true_relations_of,
    true_things,
)
from evaluations.perception.perception import PerceptionAims, met
from evaluations.perception.visibility import in_view
from simulation.houses.house import House

AT_LEAST, AT_MOST = asdict(PerceptionAims().least), asdict(PerceptionAims().most)

HOUSE = House.model_validate(
    {
        "rooms": [
            {"id": "k", "label": "kitchen", "polygon": [[0, 0], [4, 0], [4, 3], [0, 3]]},
            {"id": "c", "label": "corridor", "polygon": [[4.2, 0], [9, 0], [9, 3], [4.2, 3]]},
        ],
        "doors": [{"id": "d", "rooms": ["k", "c"], "center": [4.1, 1.5]}],
        "furniture": [
            {"id": "table", "category": "table", "pose": [2.0, 1.0, 0.0]},
            {"id": "fridge", "category": "fridge", "pose": [0.5, 2.5, 0.0]},
            {"id": "stove", "category": "stove", "pose": [1.5, 2.6, 0.0]},
        ],
        "objects": [
            {"id": "cup", "category": "cup", "on": "table", "offset": [0.0, 0.0]},
            {"id": "can", "category": "can", "on": "table", "offset": [0.2, 0.0]},
            {"id": "ball", "category": "ball", "pose": [7.0, 1.0, 0.0, 0.0]},
        ],
        "robot": {"pose": [1.0, 2.0, 0.5]},
    }
)
PLACES = {
    "cup": ((2.0, 1.0, 0.8), "k", "table"),
    "can": ((2.2, 1.0, 0.81), "k", "table"),
    "ball": ((7.0, 1.0, 0.0425), "c", None),
}
TRUTH = {
    "objects": [
        {"id": name, "category": name, "color": "red", "position_m": list(at), "room": room, "on": on, "in": None}
        for name, (at, room, on) in PLACES.items()
    ]
}
TRUE = true_things(HOUSE, TRUTH, sizes_of(HOUSE))
RIGHT = GraphContents(
    things=tuple(
        GraphThing(
            id=f"{thing.id}_1",
            label=thing.category,
            position_m=thing.position_m + np.array((0.03, 0.0, 0.0)),
            size_m=thing.size_m,
            room={"k": "room_1", "c": "room_2"}[thing.room],
        )
        for thing in TRUE
    ),
    relations=(
        ("cup_1", "on", "table_1"),
        ("can_1", "on", "table_1"),
        ("can_1", "beside", "cup_1"),
        ("stove_1", "beside", "fridge_1"),
    ),
    rooms={"k": "room_1", "c": "room_2"},
    labels={"room_1": "kitchen", "room_2": "hall"},
)
SEEN = Sightings(
    in_view_m={thing.id: 1.5 for thing in TRUE},
    renewed_m={f"{thing.id}_1": 1.5 for thing in TRUE},
    seconds=300.0,
    switches=0,
)


def figures(graph=RIGHT, seen=SEEN):
    return summarize([score_house(HOUSE, TRUE, graph, seen)])


def changed(name, **fields):
    things = tuple(replace(node, **fields) if node.id == name else node for node in RIGHT.things)
    return replace(RIGHT, things=things)


def without(name):
    return replace(RIGHT, things=tuple(node for node in RIGHT.things if node.id != name))


def test_a_graph_that_is_right_has_full_marks_and_meets_the_aims():
    report = figures()
    for name in (*AT_LEAST, "relation_recall", "recall_in_view", "found_under_any_name"):
        assert report[name] == 1.0, name
    assert report["position_error_m"] == pytest.approx(0.03)
    assert report["duplicates"] == report["invented"] == report["switches_per_10_min"] == 0.0
    assert met(report)


@pytest.mark.parametrize("figure", [*AT_LEAST, *AT_MOST])
def test_one_figure_that_falls_short_is_enough_to_miss_the_aim(figure):
    worse = AT_LEAST[figure] - 0.01 if figure in AT_LEAST else AT_MOST[figure] + 0.01
    assert not met({**figures(), figure: worse})


@pytest.mark.parametrize("figure", [*AT_LEAST, *AT_MOST])
def test_what_could_not_be_measured_is_not_met(figure):
    assert not met({**figures(), figure: None})


def test_how_far_the_sides_of_furniture_are_off_is_told_whichever_of_them_is_the_longer():
    assert figures()["size_error_furniture_m"] == pytest.approx(0.0)
    table = next(thing for thing in TRUE if thing.furniture)
    x_m, y_m, z_m = table.size_m
    swollen = figures(changed(f"{table.id}_1", size_m=(y_m + 0.1, x_m + 0.04, z_m + 1.0)))
    assert swollen["size_error_furniture_m"] == pytest.approx(0.1 / sum(thing.furniture for thing in TRUE))


def test_an_empty_graph_meets_no_aim():
    report = figures(replace(RIGHT, things=(), relations=()))
    assert report["recall"] == 0.0
    assert report["precision"] is report["position_error_m"] is None
    assert not met(report)


def test_what_is_missed_lowers_recall_and_nothing_else_but_its_relations():
    report = figures(without("can_1"))
    assert report["recall"] == pytest.approx(5 / 6)
    assert report["precision"] == report["support_right"] == 1.0
    assert report["classes"]["can"]["recall"] == 0.0
    assert report["relation_recall"] == pytest.approx(2 / 4)


def test_a_wrong_name_lowers_recall_and_precision_and_is_told():
    report = figures(changed("cup_1", label="mug"))
    assert report["recall"] == report["precision"] == pytest.approx(5 / 6)
    assert report["found_under_any_name"] == 1.0
    assert report["misnamed"] == [["cup", "mug", 1]]
    assert report["classes"]["mug"] == {
        "there": 0, "claimed": 1, "recall": None, "found_under_any_name": None, "precision": 0.0, "error_m": None
    }  # fmt: skip


def test_a_node_without_a_name_is_no_claim_unless_it_stands_for_nothing():
    report = figures(changed("cup_1", label="unknown"))
    assert report["recall"] == pytest.approx(5 / 6)
    assert report["precision"] == 1.0
    assert report["unnamed"] == pytest.approx(1 / 6)
    assert report["misnamed"] == []
    assert figures(changed("cup_1", label="unknown", position_m=np.zeros(3)))["precision"] == pytest.approx(5 / 6)


def test_second_nodes_and_inventions_are_told_apart():
    cup = next(node for node in RIGHT.things if node.id == "cup_1")
    more = (replace(cup, id="cup_2"), replace(cup, id="cup_3", position_m=np.array((3.5, 2.5, 0.8))))
    report = figures(replace(RIGHT, things=(*RIGHT.things, *more)))
    assert report["duplicates"] == report["invented"] == pytest.approx(1 / 8)
    assert report["precision"] == pytest.approx(6 / 8)


def test_of_rooms_that_were_never_found_nothing_is_asked():
    report = figures(replace(without("ball_1"), rooms={"k": "room_1"}))
    assert report["things"] == 5
    assert report["recall"] == 1.0


def test_errors_are_told_by_the_distance_of_the_nearest_sighting():
    far = replace(SEEN, renewed_m={**SEEN.renewed_m, "cup_1": 3.4})
    report = figures(changed("cup_1", position_m=np.array((2.0, 1.2, 0.8))), far)
    assert report["position_error_m"] == pytest.approx(0.03)
    assert report["position_error_by_distance"]["3"] == pytest.approx(0.2)
    assert report["position_error_by_distance"]["0"] is None
    assert report["position_error_small_m"] == pytest.approx((0.2 + 0.03 + 0.03) / 3)


def test_what_the_camera_never_came_near_to_is_not_asked_for_in_view():
    unseen = replace(SEEN, in_view_m={name: 1.0 for name in SEEN.in_view_m if name != "can"})
    report = figures(without("can_1"), unseen)
    assert report["recall"] == pytest.approx(5 / 6)
    assert report["recall_in_view"] == 1.0


@pytest.mark.parametrize(
    ("relations", "verdict"),
    [
        ((), "lacking"),
        ((("cup_1", "on", "can_1"),), "other"),
        ((("cup_1", "in", "table_1"),), "other"),
        ((("cup_1", "on", "table_1"), ("cup_1", "on", "can_1")), "other"),
    ],
)
def test_support_is_right_only_when_carrier_and_predicate_are(relations, verdict):
    rest = tuple(relation for relation in RIGHT.relations if relation[0] != "cup_1")
    report = figures(replace(RIGHT, relations=(*rest, *relations)))
    assert report["support"] == {verdict: 1, "right": 2}
    assert report["support_right"] == pytest.approx(2 / 3)


def test_what_lies_on_the_floor_is_carried_by_nothing():
    report = figures(replace(RIGHT, relations=(*RIGHT.relations, ("ball_1", "on", "table_1"))))
    assert report["support"]["made up"] == 1


def test_a_thing_of_the_wrong_room_counts():
    assert figures(changed("ball_1", room="room_1"))["room_right"] == pytest.approx(5 / 6)


def test_beside_holds_either_way_and_other_relations_do_not():
    turned = tuple((b, predicate, a) for a, predicate, b in RIGHT.relations)
    report = figures(replace(RIGHT, relations=turned))
    assert report["relation_recall_by_predicate"] == {"beside": 1.0, "on": 0.0}


def test_a_room_is_asked_for_its_label_where_its_contents_tell():
    wrong = figures(replace(RIGHT, labels={"room_1": "office", "room_2": ""}))
    assert wrong["room_labels_right"] == 0.0  # of the kitchen alone: a ball does not tell a corridor
    assert figures()["room_labels_right"] == 1.0


def test_switches_are_counted_by_ten_minutes():
    assert figures(seen=replace(SEEN, switches=2))["switches_per_10_min"] == pytest.approx(4.0)


def test_relations_do_not_depend_on_a_viewer():
    assert {predicate for _, predicate, _ in true_relations_of(TRUE)} == {"on", "beside"}


def test_a_scene_is_laid_upon_the_house_room_by_room():
    corners = np.array([[0, 0], [4, 0], [4, 3], [0, 3]], float) + 0.1
    x, y, yaw = HOUSE.robot.pose
    back = np.array([[np.cos(yaw), np.sin(yaw)], [-np.sin(yaw), np.cos(yaw)]])

    def on_map(points):
        return (np.asarray(points) - (x, y)) @ back.T

    cup = {
        "id": "cup_1", "type": "object", "label": "cup", "state": "present", "room": "room_1",
        "size_m": [0.1, 0.1, 0.1], "position_m": [*on_map((2.1, 1.1)), 0.8],
    }  # fmt: skip
    room = {"id": "room_1", "type": "room", "label": "kitchen", "polygon_m": on_map(corners).tolist()}
    gone = {**cup, "id": "cup_2", "state": "missing"}
    held = {**cup, "id": "cup_3", "state": "held"}
    scene = {"nodes": [room, cup, gone, held], "edges": []}
    laid = graph_contents(scene, HOUSE)
    assert [node.id for node in laid.things] == ["cup_1", "cup_3"]
    assert laid.things[0].position_m == pytest.approx((2.0, 1.0, 0.8), abs=1e-6)
    assert laid.rooms == {"k": "room_1"}
    assert graph_contents(scene, HOUSE, lay=False).things[0].position_m == pytest.approx((2.1, 1.1, 0.8))


@pytest.mark.parametrize(
    ("point", "seen"),
    [((2.0, 0.0, 1.4), True), ((-2.0, 0.0, 1.4), False), ((2.0, 2.0, 1.4), False), ((0.5, 0, 0), False)],
)
def test_a_point_is_in_view_ahead_and_not_aside_or_below(point, seen):
    assert in_view(np.array(point), (0.0, 0.0, 0.0, 0.0)) is seen
    assert in_view(np.array((-point[1], point[0], point[2])), (0.0, 0.0, np.pi / 2, 0.0)) is seen
