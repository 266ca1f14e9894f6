"""Which node is which thing: by name and place, one to one, second nodes and inventions apart."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluations.perception.inventory import GraphThing, TrueThing
from evaluations.perception.matching import Identities, match_things, off_m


def thing(name, category, position, size=(0.08, 0.08, 0.1), **more):
    return TrueThing(id=name, category=category, position_m=np.array(position, float), size_m=size, **more)


def node(name, label, position, size=(0.08, 0.08, 0.1), room="room_1"):
    return GraphThing(id=name, label=label, position_m=np.array(position, float), size_m=size, room=room)


CUP = thing("a_cup", "cup", (1.0, 1.0, 0.8))
BED = thing("a_bed", "bed", (4.0, 2.0, 0.45), size=(1.5, 2.0, 0.9), furniture=True)


def test_a_node_is_the_nearest_thing_of_its_name_and_each_only_once():
    other = thing("other_cup", "cup", (1.3, 1.0, 0.8))
    matching = match_things(
        [CUP, other], [node("cup_1", "cup", (1.28, 1.0, 0.8)), node("cup_2", "cup", (1.2, 1.0, 0.8))]
    )
    assert matching.named == {"a_cup": "cup_2", "other_cup": "cup_1"}
    assert matching.misnamed == matching.duplicates == {}
    assert matching.invented == ()


def test_a_small_thing_is_looked_for_within_half_a_meter():
    assert match_things([CUP], [node("cup_1", "cup", (1.45, 1.0, 0.8))]).named == {"a_cup": "cup_1"}
    assert match_things([CUP], [node("cup_1", "cup", (1.55, 1.0, 0.8))]).invented == ("cup_1",)


@pytest.mark.parametrize(("x_m", "found"), [(4.7, True), (4.0 + 0.75 + 0.25, True), (4.0 + 0.75 + 0.35, False)])
def test_furniture_is_looked_for_around_its_footprint(x_m, found):
    matching = match_things([BED], [node("bed_1", "bed", (x_m, 2.0, 0.4), size=(1.4, 1.9, 0.8))])
    assert matching.named == ({"a_bed": "bed_1"} if found else {})


def test_a_turned_footprint_is_turned():
    turned = thing("b", "bench", (0.0, 0.0, 0.2), size=(2.0, 0.4, 0.4), yaw_rad=math.pi / 2.0, furniture=True)
    assert turned.gap_m(np.array((0.0, 0.9, 0.2))) == 0.0
    assert turned.gap_m(np.array((0.9, 0.0, 0.2))) == pytest.approx(0.7)
    assert turned.gap_m(np.array((0.5, 1.4, 0.2))) == pytest.approx(0.5)


def test_a_thing_under_another_name_is_misnamed_and_not_invented():
    matching = match_things([CUP], [node("mug_1", "mug", (1.03, 1.0, 0.8))])
    assert matching.misnamed == matching.node_of == {"a_cup": "mug_1"}
    assert matching.thing_of == {"mug_1": "a_cup"}
    assert matching.named == {}
    assert matching.invented == ()


def test_what_is_much_smaller_than_a_thing_is_not_that_thing_under_another_name():
    assert match_things([BED], [node("book_1", "book", (4.0, 2.0, 0.5))]).invented == ("book_1",)


def test_a_second_node_of_one_thing_is_a_duplicate_by_name_or_by_place():
    nodes = [
        node("cup_1", "cup", (1.0, 1.0, 0.8)),
        node("cup_2", "cup", (1.3, 1.0, 0.8)),
        node("mug_1", "mug", (1.05, 1.0, 0.8)),
    ]
    matching = match_things([CUP], nodes)
    assert matching.named == {"a_cup": "cup_1"}
    assert matching.duplicates == {"cup_2": "a_cup", "mug_1": "a_cup"}


def test_a_nodes_own_name_goes_before_a_nearer_place():
    mug = thing("a_mug", "mug", (1.1, 1.0, 0.8))
    matching = match_things([CUP, mug], [node("cup_1", "cup", (1.1, 1.0, 0.8)), node("mug_1", "mug", (1.0, 1.0, 0.8))])
    assert matching.named == {"a_cup": "cup_1", "a_mug": "mug_1"}


def test_nothing_there_and_nothing_known_is_no_mistake():
    assert match_things([], []).node_of == {}
    assert match_things([CUP], []).node_of == {}
    assert match_things([], [node("cup_1", "cup", (0, 0, 0))]).invented == ("cup_1",)


def test_the_error_is_the_distance_between_centers():
    assert off_m(CUP, node("cup_1", "cup", (1.03, 1.04, 0.8))) == pytest.approx(0.05)


def test_a_thing_that_gets_another_node_switches_once():
    identities = Identities()
    first, second = node("cup_1", "cup", (1.0, 1.0, 0.8)), node("cup_2", "cup", (1.0, 1.0, 0.8))
    for graph in ([first], [first], [], [second], [second]):
        identities.update([CUP], graph)
    assert identities.switches == 1
    assert identities.last == {"a_cup": "cup_2"}


def test_a_nearer_second_node_is_no_switch_for_as_long_as_the_first_is_near():
    identities = Identities()
    first, second = node("cup_1", "cup", (1.2, 1.0, 0.8)), node("cup_2", "cup", (1.0, 1.0, 0.8))
    identities.update([CUP], [first])
    identities.update([CUP], [first, second])
    assert identities.switches == 0


def test_a_node_that_is_renamed_is_still_the_same():
    identities = Identities()
    identities.update([CUP], [node("thing_1", "unknown", (1.0, 1.0, 0.8))])
    identities.update([CUP], [node("thing_1", "cup", (1.0, 1.0, 0.8))])
    assert identities.switches == 0


def test_two_things_that_change_places_keep_their_nodes_when_these_follow():
    identities = Identities()
    left, right = (1.0, 1.0, 0.8), (3.0, 1.0, 0.8)
    for here, there in ((left, right), (right, left)):
        identities.update(
            [thing("a", "cup", here), thing("b", "cup", there)],
            [node("cup_1", "cup", here), node("cup_2", "cup", there)],
        )
    assert identities.switches == 0
    identities.update(
        [thing("a", "cup", left), thing("b", "cup", right)],
        [node("cup_1", "cup", right), node("cup_2", "cup", left)],
    )
    assert identities.switches == 2
