"""Whether what is seen is a thing that is known, in its place or moved."""

import numpy as np
import pytest

from perception.objects.furniture.surface import Box, SurfaceBelief
from perception.objects.identity.evidence import alike, left
from perception.objects.identity.pair import Moment, Pair, Subject
from perception.objects.tracking.handled import HandDid
from scene_graph.nodes import ObjectState
from unit.perception.objects.things import agree, banana_like, moved, nameless, taken_for, thing, turned_up


def test_a_missing_thing_is_recognized_elsewhere():
    missing = thing(1, state=ObjectState.MISSING)
    assert moved(thing(2, seen=(20.0, 21.0)), [missing], place_known=False) is missing


def test_two_things_seen_at_the_same_time_are_two():
    assert moved(thing(2, seen=(9.0, 10.0)), [thing(1, seen=(0.0, 9.5))]) is None


def test_the_longer_unseen_the_likelier_it_has_moved():
    ages = [0.0, 10.0, 100.0, 1000.0, 10_000.0]
    chances = [left(Pair(Subject.of(thing(2, seen=(10.0 + age, 1e6))), thing(1), Moment())) for age in ages]
    assert chances == sorted(chances)
    assert chances[0] < 0.02
    assert chances[-1] > 0.99


def test_a_look_alike_in_an_unexplored_place_is_new_and_in_an_inspected_place_is_the_old_one():
    known = thing(1, seen=(0.0, 10.0))
    assert moved(thing(2, seen=(600.0, 601.0)), [known], place_known=False) is None
    assert moved(thing(2, seen=(600.0, 601.0)), [known], place_known=True) is known


def test_what_was_seen_at_its_place_a_moment_ago_is_not_what_is_seen_at_another():
    known = thing(1, seen=(0.0, 10.0))
    assert moved(thing(2, seen=(60.0, 61.0)), [known], place_known=True) is None
    known.state = ObjectState.MISSING
    assert moved(thing(2, seen=(60.0, 61.0)), [known], place_known=True) is known


def test_one_of_several_present_look_alikes_is_never_taken_for_the_moved_one():
    twins = [thing(1), thing(2)]
    assert moved(thing(3, seen=(500.0, 501.0)), twins) is None
    missing = thing(4, state=ObjectState.MISSING)
    assert moved(thing(3, seen=(500.0, 501.0)), [*twins, missing]) is missing


def test_what_the_hand_has_put_there_is_not_the_missing_thing_that_turned_up():
    missing, other = thing(1, state=ObjectState.MISSING), thing(2, seen=(20.0, 21.0))
    known = {"looked_before": {"room_1": 0.0}}
    assert turned_up(missing, [other], **known) is other
    other.note_hand(HandDid.PUT, 15.0)
    assert turned_up(missing, [other], **known) is None


def test_where_such_things_come_in_numbers_one_that_was_hidden_so_far_is_not_the_missing_one():
    missing, hidden_so_far = thing(1, state=ObjectState.MISSING), thing(2, seen=(20.0, 21.0))
    hidden_so_far.put_at("room_1", np.array((0.3, 0.0, 0.0)), 0.01)
    beside = thing(3, seen=(0.0, 21.0))
    beside.put_at("room_1", np.array((0.4, 0.0, 0.0)), 0.01)
    known = {"looked_before": {"room_1": 0.0}}
    assert turned_up(missing, [hidden_so_far], **known) is hidden_so_far
    assert turned_up(missing, [beside, hidden_so_far], **known) is None
    gone_too = thing(3, seen=(0.0, 5.0), state=ObjectState.MISSING)
    assert turned_up(missing, [gone_too, hidden_so_far], **known) is hidden_so_far


@pytest.mark.parametrize(
    ("look", "apart_m", "one"),
    [({}, 0.02, True), ({}, 0.05, False), ({"label": "cup"}, 0.02, False), ({"size_m": (0.3, 0.3, 0.5)}, 0.02, False)],
)
def test_a_missing_thing_is_the_one_like_it_that_is_seen_in_its_very_place_since_when_ever(look, apart_m, one):
    missing, seen = thing(1, state=ObjectState.MISSING), thing(2, seen=(5.0, 21.0), **look)
    seen.put_at("room_1", np.array((apart_m, 0.0, 0.0)), 0.01)
    elsewhere = thing(3, seen=(0.0, 5.0))
    elsewhere.put_at("room_1", np.array((1.0, 0.0, 0.0)), 0.01)
    assert (turned_up(missing, [elsewhere, seen]) is seen) is one
    seen.note_hand(HandDid.PUT, 15.0)
    assert turned_up(missing, [elsewhere, seen]) is None


@pytest.mark.parametrize(
    ("at", "same"),
    [((0.4, 0.3, 0.12), True), ((0.3, 0.2, 0.6), True), ((3.0, 1.0, 0.12), True), ((3.0, 1.0, 0.6), False)],
)
def test_what_fell_from_the_hand_lies_near_there_or_on_the_floor_and_a_look_alike_on_another_table_is_another(at, same):
    fallen, sighting = thing(1, state=ObjectState.MISSING), thing(2, seen=(20.0, 21.0))
    sighting.put_at("room_1", np.array(at), 0.01)
    known = {"looked_before": {"room_1": 0.0}}
    assert moved(sighting, [fallen]) is fallen, "somebody may have put it anywhere"
    assert turned_up(fallen, [sighting], **known) is sighting
    fallen.note_hand(HandDid.DROPPED, 15.0)
    assert (moved(sighting, [fallen]) is fallen) is same
    assert (turned_up(fallen, [sighting], **known) is sighting) is same


@pytest.mark.parametrize("state", [ObjectState.PRESENT, ObjectState.MISSING])
@pytest.mark.parametrize(
    ("look", "at_x_m", "same"),
    [({}, 0.03, True), ({}, 0.3, False), ({"color": "red"}, 0.03, False), ({"size_m": (0.3, 0.2, 0.05)}, 0.03, False)],
)
def test_what_looks_the_same_in_the_very_place_of_a_thing_is_that_thing_whatever_it_is_called(
    state, look, at_x_m, same
):
    book = thing(1, "book", state=state)
    sighting = banana_like(2, seen=(20.0, 21.0), **look)
    sighting.put_at("room_1", np.array((at_x_m, 0.0, 0.0)), 0.01)
    assert (taken_for(sighting, [book]) is book) is same
    if state is ObjectState.MISSING:
        assert (turned_up(book, [sighting], looked_before={"room_1": 0.0}) is sighting) is same


@pytest.mark.parametrize(
    ("look", "same"),
    [
        ({}, True),
        ({"color": "red"}, False),
        ({"size_m": (0.3, 0.2, 0.05)}, False),
        ({"seen": (5.0, 21.0)}, False),
    ],
)
def test_what_slipped_is_known_by_its_looks_where_it_lies_even_if_it_is_called_otherwise_there(look, same):
    slipped, far = (thing(n, "book", state=ObjectState.MISSING) for n in (1, 2))
    far.put_at("room_1", np.array((3.0, 0.0, 0.0)), 0.01)
    slipped.put_at("room_1", np.array((0.5, 0.0, 0.0)), 0.01)
    sighting = banana_like(3, **{"seen": (20.0, 21.0), **look})
    assert not alike(Pair(Subject.of(sighting), slipped, Moment()))
    assert taken_for(sighting, [far, slipped]) is None
    for track in (far, slipped):
        track.note_hand(HandDid.DROPPED, 15.0)
    assert (taken_for(sighting, [far, slipped]) is slipped) is same


@pytest.mark.parametrize(
    ("look", "same"),
    [
        ({}, True),
        ({"at": (2.0, 0.0, 0.04)}, False),
        ({"color": "blue"}, False),
        ({"size_m": (0.25, 0.2, 0.15)}, False),
        ({"seen": (5.0, 21.0)}, False),
    ],
)
def test_a_can_that_was_knocked_down_is_what_lies_below_as_large_and_as_red_though_nobody_can_name_it(look, same):
    can = thing(1, "can", "red", (0.066, 0.066, 0.12), state=ObjectState.MISSING)
    can.put_at("room_1", np.array((0.0, 0.0, 0.96)), 0.03)
    lying = {"size_m": (0.12, 0.068, 0.066), "color": "red", "at": (0.2, 0.3, 0.04), "seen": (20.0, 21.0)}
    sighting = nameless(2, **{**lying, **look})
    assert (taken_for(sighting, [can]) is can) is same
    assert (turned_up(can, [sighting], looked_before={"room_1": 0.0}) is sighting) is same
    can.state = ObjectState.PRESENT
    assert taken_for(sighting, [can]) is None


@pytest.mark.parametrize(("long_m", "same"), [(0.2, True), (0.14, False)])
def test_a_book_that_fell_on_its_edge_is_the_book_though_the_network_is_sure_that_it_is_a_banana(long_m, same):
    book = thing(1, "book", "yellow", (0.2, 0.09, 0.036), state=ObjectState.MISSING)
    book.put_at("room_1", np.array((0.0, 0.0, 0.02)), 0.5)
    book.note_hand(HandDid.DROPPED, 15.0)
    sighting = thing(2, "banana", "yellow", (long_m, 0.039, 0.086), seen=(20.0, 21.0))
    sighting.put_at("room_1", np.array((0.05, -0.03, 0.49)), 0.01)
    assert (taken_for(sighting, [book]) is book) is same


@pytest.mark.parametrize(
    ("touched", "at", "color", "same"),
    [
        (True, (0.6, 0.4, 0.02), "yellow", True),
        (False, (0.6, 0.4, 0.02), "yellow", False),
        (True, (1.6, 0.4, 0.02), "yellow", False),
        (True, (0.6, 0.4, 0.02), "red", False),
    ],
)
def test_what_the_hand_has_knocked_off_a_desk_is_what_lies_near_below_though_surely_called_otherwise(
    touched, at, color, same
):
    book = thing(1, "book", "yellow", (0.2, 0.085, 0.035), state=ObjectState.MISSING)
    book.put_at("room_1", np.array((0.0, 0.0, 0.77)), 0.01)
    if touched:
        book.note_hand(HandDid.TOUCHED, 15.0)
    sighting = thing(2, "banana", color, (0.195, 0.088, 0.02), seen=(20.0, 21.0))
    sighting.put_at("room_1", np.array(at), 0.01)
    assert (taken_for(sighting, [book]) is book) is same


@pytest.mark.parametrize(
    ("label", "state", "same"),
    [
        ("stove", ObjectState.PRESENT, False),
        ("stove", ObjectState.MISSING, True),
        ("chair", ObjectState.PRESENT, True),
    ],
)
def test_what_is_built_in_is_not_taken_for_moved_as_long_as_it_may_be_in_its_place(label, state, same):
    size_m = (0.6, 0.6, 0.9)
    known = thing(1, label, size_m=size_m, state=state)
    sighting = thing(2, label, size_m=size_m, seen=(600.0, 601.0))
    for track, x_m in ((known, 0.0), (sighting, 1.0)):
        track.place = SurfaceBelief.of(Box(np.array((x_m, 0.0, 0.45)), size_m, 0.0), frames=50)
    assert (moved(sighting, [known]) is known) is same


def test_likeness_is_symmetric():
    a, b = thing(1), thing(2, label="vase", size_m=(0.1, 0.1, 0.2))
    assert agree(a, b) == pytest.approx(agree(b, a))
    assert agree(a, thing(3)) == pytest.approx(1.0, abs=0.01)


@pytest.mark.parametrize(
    ("awaited", "at", "color", "same"),
    [
        (True, (0.06, 0.05, 0.46), "yellow", True),  # half hidden by the hand, nameless and too short
        (True, (0.3, 0.0, 0.46), "yellow", False),
        (True, (0.06, 0.05, 0.46), "blue", False),
        (False, (0.06, 0.05, 0.46), "yellow", False),  # seen since it was put there: this is another
    ],
)
def test_what_is_seen_where_the_hand_has_just_put_something_is_that(awaited, at, color, same):
    nameless = {"label": "unknown", "size_m": (0.09, 0.07, 0.03)}
    book = thing(1, "book", "yellow", (0.2, 0.09, 0.03), seen=(0.0, 19.9))
    lost = thing(2, color="yellow", state=ObjectState.MISSING, **nameless)
    part = thing(3, color=color, seen=(20.0, 21.0), **nameless)
    if awaited:
        book.note_hand(HandDid.PUT, 20.0)
    book.put_at("room_1", np.array((0.0, 0.0, 0.46)), 0.03)
    part.put_at("room_1", np.array(at), 0.01)
    assert (taken_for(part, [lost, book]) is book) is same
