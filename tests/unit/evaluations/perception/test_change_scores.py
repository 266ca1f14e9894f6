"""What counts as a change detected, and what as a false alarm."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from evaluations.perception.change_scores import Moment, detected, false_alarms, summarize
from evaluations.perception.changes import met
from evaluations.perception.inventory import GraphThing, TrueThing

SIZE = (0.08, 0.08, 0.1)
HERE, THERE = (1.0, 1.0, 0.8), (4.0, 1.0, 0.8)


def thing(name, at, category="cup"):
    return TrueThing(id=name, category=category, position_m=np.array(at), size_m=SIZE, room="k")


def node(name, at, label="cup"):
    return GraphThing(id=name, label=label, position_m=np.array(at), size_m=SIZE)


BOOK, BOOK_1 = thing("book", (2.0, 2.0, 0.8), "book"), node("book_1", (2.0, 2.0, 0.8), "book")
BEFORE = Moment.of([thing("cup", HERE), BOOK], [node("cup_1", HERE), BOOK_1])


def after(true_at=None, nodes=()):
    true = [] if true_at is None else [thing("cup", true_at)]
    return Moment.of([*true, BOOK], [*nodes, BOOK_1])


def noticed(kind, before, then):
    return detected(kind, "cup", before, then)["noticed"]


def test_a_thing_taken_away_is_noticed_when_its_node_is_no_longer_present():
    assert noticed("remove", BEFORE, after())
    assert not noticed("remove", BEFORE, after(None, [node("cup_1", HERE)]))


def test_a_new_node_of_its_name_at_the_old_place_means_that_nothing_was_noticed():
    assert not noticed("remove", BEFORE, after(None, [node("cup_2", HERE)]))
    assert noticed("remove", BEFORE, after(None, [node("cup_2", THERE)]))


@pytest.mark.parametrize(
    ("nodes", "expected"),
    [
        ([node("cup_1", THERE)], {"noticed": True, "named": True, "kept": True}),
        ([node("cup_2", THERE)], {"noticed": True, "named": True, "kept": False}),
        ([node("mug_1", THERE, "mug")], {"noticed": True, "named": False, "kept": False}),
        ([node("cup_1", HERE)], {"noticed": False, "named": False, "kept": False}),
        ([node("cup_1", HERE), node("cup_2", THERE)], {"noticed": False, "named": False, "kept": False}),
        ([], {"noticed": False, "named": False, "kept": False}),
        ([node("cup_1", (4.0, 1.4, 0.8))], {"noticed": False, "named": False, "kept": True}),
    ],
)
def test_a_moved_thing_is_noticed_when_it_has_left_the_old_place_and_stands_at_the_new(nodes, expected):
    assert detected("move", "cup", BEFORE, after(THERE, nodes)) == expected


def test_a_thing_that_was_brought_is_noticed_when_a_node_stands_there():
    before = Moment.of([BOOK], [BOOK_1])
    assert detected("add", "cup", before, after(HERE, [node("cup_1", HERE)])) == {
        "noticed": True, "named": True, "kept": None
    }  # fmt: skip
    assert noticed("add", before, after(HERE, [node("mug_1", HERE, "mug")]))
    assert not noticed("add", before, after(HERE))


def how(before, then):
    return [(alarm["node"], alarm["how"]) for alarm in false_alarms(before, then)]


def test_the_change_itself_is_no_false_alarm():
    assert how(BEFORE, after()) == []
    assert how(BEFORE, after(THERE, [node("cup_1", THERE)])) == []
    assert how(BEFORE, after(THERE, [node("cup_2", THERE)])) == []
    assert how(BEFORE, after(HERE, [node("cup_1", HERE)])) == []


@pytest.mark.parametrize(
    ("books", "alarm"),
    [
        ([], ("book_1", "gone")),
        ([replace(BOOK_1, position_m=np.array((2.35, 2.0, 0.8)))], ("book_1", "shifted")),
        ([replace(BOOK_1, label="box")], ("book_1", "renamed")),
        ([BOOK_1, replace(BOOK_1, id="book_2")], ("book_2", "made up")),
        ([BOOK_1, node("toy_1", (3.0, 3.0, 0.8), "toy")], ("toy_1", "made up")),
    ],
)
def test_nodes_of_things_that_stand_as_they_did_must_not_change(books, alarm):
    assert how(BEFORE, Moment.of([BOOK], books)) == [alarm]


def test_a_thing_that_gets_another_node_is_not_gone():
    assert how(BEFORE, Moment.of([BOOK], [replace(BOOK_1, id="book_2")])) == []


def test_what_truly_moved_may_move_in_the_graph():
    pushed = replace(BOOK, position_m=np.array((2.4, 2.0, 0.8)))
    then = Moment.of([pushed], [replace(BOOK_1, position_m=np.array((2.4, 2.0, 0.8)))])
    assert how(BEFORE, then) == []


def test_a_thing_found_at_last_is_no_false_alarm():
    before = Moment.of([BOOK], [])
    assert how(before, Moment.of([BOOK], [BOOK_1])) == []


def test_accuracy_asks_for_things_of_found_rooms_and_for_every_node():
    moment = Moment.of([thing("cup", HERE), BOOK], [node("cup_1", HERE), node("toy_1", THERE, "toy")])
    assert moment.accuracy({"k": "room_1"}) == (0.5, 0.5)
    assert moment.accuracy({}) == (None, 0.5)


def test_a_node_without_a_name_is_neither_right_nor_wrong_unless_it_stands_for_nothing():
    unnamed = Moment.of([thing("cup", HERE), BOOK], [node("thing_1", HERE, "unknown"), BOOK_1])
    assert unnamed.accuracy({"k": "room_1"}) == (0.5, 1.0)
    nothing = Moment.of([BOOK], [node("thing_1", HERE, "unknown"), BOOK_1])
    assert nothing.accuracy({"k": "room_1"}) == (1.0, 0.5)


def change(kind="move", **more):
    row = {"kind": kind, "noticed": True, "named": True, "kept": True if kind == "move" else None, "looked": True}
    return {**row, "false_alarms": [], "true_things_right": 0.95, "nodes_right": 0.95, **more}


def figures(*changes):
    return summarize([{"changes": list(changes), "not_made": 0}])


def test_all_detected_without_false_alarms_meets_the_aims():
    report = figures(change(), change("add"), change("remove"))
    assert report["detected"] == 1.0
    assert report["kinds"]["move"]["identity_kept"] == 1.0
    assert report["kinds"]["add"]["identity_kept"] is None
    assert met(report)


@pytest.mark.parametrize(
    "wrong",
    [
        {"noticed": False},
        {"true_things_right": 0.6},
        {"nodes_right": 0.6},
        {"false_alarms": [{"node": "cup_1", "of": "cup", "how": "gone"}]},
    ],
)
def test_one_figure_that_falls_short_is_enough_to_miss_the_aim(wrong):
    assert not met(figures(change("add"), change("remove"), change(**wrong)))


def test_each_kind_is_asked_for_by_itself():
    assert not met(figures(*[change("add")] * 50, change("move", noticed=False)))


def test_where_nothing_could_be_changed_nothing_is_met():
    assert not met(figures())
