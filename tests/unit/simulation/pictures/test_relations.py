"""What is true between things, from their boxes and their places in the picture."""

from __future__ import annotations

import math

import pytest

from simulation.pictures.relations import Seen, Solid, true_relations


def solid(x=0.0, y=0.0, bottom=0.0, size=(1.0, 1.0, 1.0), *, yaw=0.0, furniture=False, **bearers):
    center = (x, y, bottom + size[2] / 2)
    return Solid(center_m=center, size_m=size, yaw_rad=yaw, furniture=furniture, **bearers)


def seen(left=0.0, right=10.0, *, distance=2.0, top=0.0, bottom=10.0):
    return Seen(box_px=(left, top, right, bottom), distance_m=distance)


TABLE = solid(size=(1.2, 0.8, 0.7), furniture=True)
HERE = seen()


def test_what_stands_on_a_table_is_on_it_and_nothing_else():
    cup = solid(bottom=0.7, size=(0.1, 0.1, 0.1), on=0)
    assert true_relations([TABLE, cup], [seen(distance=2.0), seen(distance=1.5)]) == ((1, "on", 0),)


def test_a_hand_holds_and_a_container_contains():
    person, cup = solid(size=(0.5, 0.3, 1.8)), solid(bottom=1.0, size=(0.1, 0.1, 0.1), held_by=0)
    assert true_relations([person, cup], [HERE, HERE]) == ((0, "holding", 1),)
    box, toy = solid(size=(0.4, 0.4, 0.3)), solid(size=(0.1, 0.1, 0.1), inside=0)
    assert true_relations([box, toy], [HERE, HERE]) == ((1, "in", 0),)


def test_nothing_is_said_about_what_is_not_seen():
    cup = solid(bottom=0.7, size=(0.1, 0.1, 0.1), on=0)
    assert true_relations([TABLE, cup], [None, HERE]) == ()
    assert true_relations([TABLE, cup], [HERE, None]) == ()


def test_things_on_the_same_table_are_beside_each_other_the_left_one_first():
    things = [solid(x=x, bottom=0.7, size=(0.1, 0.1, 0.1), on=0) for x in (-0.1, 0.1)]
    places = [seen(0, 100, distance=2.0), seen(60, 70, distance=1.9), seen(20, 30, distance=1.9)]
    assert (2, "beside", 1) in true_relations([TABLE, *things], places)


@pytest.mark.parametrize(("gap_m", "near"), [(0.25, True), (0.45, False)])
def test_beside_ends_where_the_gap_gets_wide(gap_m, near):
    things = [solid(size=(0.1, 0.1, 0.1)), solid(x=0.1 + gap_m, size=(0.1, 0.1, 0.1))]
    places = [seen(0, 10), seen(40, 50)]
    assert true_relations(things, places) == (((0, "beside", 1),) if near else ())


def test_the_gap_is_measured_between_turned_sides():
    long = solid(size=(2.0, 0.2, 0.5), furniture=True)
    along = solid(y=0.7, size=(2.0, 0.2, 0.5), furniture=True)
    across = solid(y=0.7, size=(2.0, 0.2, 0.5), yaw=math.pi / 2, furniture=True)
    places = [seen(0, 10), seen(40, 50)]
    assert true_relations([long, along], places) == ((0, "beside", 1),)
    assert true_relations([long, across], places) == ((0, "beside", 1),)
    assert true_relations([long, solid(y=1.9, size=(2.0, 0.2, 0.5), yaw=math.pi / 2, furniture=True)], places) == ()


def test_what_stands_below_a_table_is_under_it_and_not_beside():
    stool = solid(size=(0.3, 0.3, 0.4), furniture=True)
    assert true_relations([TABLE, stool], [HERE, HERE]) == ((1, "under", 0),)


def test_what_hangs_above_is_over():
    clock = solid(bottom=1.2, size=(0.3, 0.05, 0.3), attached_to=2)
    wall = solid(x=50.0)
    assert (0, "over", 1) in true_relations([clock, TABLE, wall], [HERE, HERE, None])
    high = solid(bottom=2.6, size=(0.3, 0.05, 0.3), attached_to=2)
    assert true_relations([high, TABLE, wall], [HERE, HERE, None]) == ()


def test_in_front_of_is_meant_from_the_viewer():
    chair, shelf = (solid(x=x, size=(0.5, 0.5, 1.0), furniture=True) for x in (0.0, 1.2))
    near, far = seen(10, 30, distance=1.5), seen(0, 60, distance=2.4)
    assert true_relations([chair, shelf], [near, far]) == ((0, "in front of", 1),)
    assert true_relations([chair, shelf], [far, near]) == ((1, "in front of", 0),)
    aside = seen(70, 90, distance=1.5)
    assert true_relations([chair, shelf], [aside, far]) == ()
