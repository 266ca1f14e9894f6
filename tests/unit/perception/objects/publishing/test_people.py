"""Persons, and what is a part of them."""

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid
from scene_graph.nodes import ObjectNode, PersonNode
from unit.perception.objects.story import TABLE, Story


def test_a_person_is_a_node_on_the_floor_that_moves_when_they_walk():
    body = Solid(label="person", center=(1.0, 0.5, 0.85), size_m=(0.4, 0.4, 1.7), cylinder=True)
    story = Story([body], eye=(-2.0, 0.0), target=(1.0, 0.0, 1.0))
    graph = story.run(5)
    assert np.linalg.norm(graph.position("person_1", "room_1")[:2] - (1.0, 0.5)) < 0.1
    for step in range(10):
        story.room.solids = [body.moved_to((1.0, 0.5 - 0.1 * step, 0.85))]
        graph = story.run(1)
    assert np.linalg.norm(graph.position("person_1", "room_1")[:2] - (1.0, -0.4)) < 0.25
    assert "person_2" not in graph


@pytest.mark.parametrize("low_m", [0.75, 0.0])
def test_who_seems_to_stand_on_a_table_or_to_be_it_is_nobody_and_who_stands_behind_it_is_somebody(low_m):
    boxes = Solid(label="person", center=(0.0, 0.1, (low_m + 1.25) / 2), size_m=(1.21, 0.4, 1.25 - low_m))
    story = Story([TABLE])
    story.run(6)
    story.room.solids = [TABLE, boxes]
    assert not story.run(8).of_type(PersonNode)
    behind = Solid(label="person", center=(0.9, 0.1, 0.85), size_m=(0.4, 0.4, 1.7), cylinder=True)
    story.room.solids = [TABLE, behind]
    (person,) = story.run(8).of_type(PersonNode)
    assert np.linalg.norm(story.memory.snapshot().position(person.id, "room_1")[:2] - behind.center[:2]) < 0.2


@pytest.mark.parametrize(("top_m", "somebody"), [(0.88, False), (1.3, True)])
def test_what_stands_on_a_chair_is_nobody_and_who_sits_on_it_rises_above_it(top_m, somebody):
    chair = Solid(label="chair", center=(0.0, 0.1, 0.45), size_m=(0.45, 0.45, 0.9))
    there = Solid(label="person", center=(0.0, 0.1, top_m / 2), size_m=(0.46, 0.46, top_m))
    story = Story([chair])
    story.run(8)
    story.room.solids = [there]
    assert bool(list(story.run(4).of_type(PersonNode))) is somebody


def test_a_person_whose_legs_and_body_are_seen_as_two_masks_is_one():
    legs = Solid(label="person", center=(1.0, 0.5, 0.4), size_m=(0.35, 0.35, 0.8), cylinder=True)
    body = Solid(label="person", center=(1.0, 0.55, 1.3), size_m=(0.4, 0.4, 0.8), cylinder=True)
    friend = Solid(label="person", center=(1.0, -0.4, 0.85), size_m=(0.4, 0.4, 1.7), cylinder=True)
    story = Story([legs, body], eye=(-2.0, 0.0), target=(1.0, 0.0, 1.0))
    assert [node.id for node in story.run(6).of_type(PersonNode)] == ["person_1"]
    story.room.solids = [legs, body, friend]
    assert [node.id for node in story.run(6).of_type(PersonNode)] == ["person_1", "person_2"]


def test_what_looks_like_a_leg_below_a_desk_is_nobody_and_takes_nobody_there():
    leg = Solid(label="person", center=(1.0, -1.2, 0.2), size_m=(0.1, 0.1, 0.4), confidence=0.7)
    body = Solid(label="person", center=(1.0, 0.8, 0.85), size_m=(0.4, 0.4, 1.7), cylinder=True)
    story = Story([leg], eye=(-2.0, 0.0), target=(1.0, 0.0, 1.0))
    assert not list(story.run(8).of_type(PersonNode))
    story.room.solids = [leg, body]
    story.run(6)
    story.room.solids = [leg]
    graph = story.run(2)
    assert np.linalg.norm(graph.position("person_1", "room_1")[:2] - (1.0, 0.8)) < 0.2


def test_what_has_no_name_where_somebody_stands_is_a_part_of_them():
    body = Solid(label="person", center=(1.0, 0.5, 0.85), size_m=(0.4, 0.4, 1.7), cylinder=True)
    apron = Solid(label="unknown", center=(0.85, 0.45, 0.9), size_m=(0.25, 0.25, 0.3), cylinder=True)
    bag = Solid(label="unknown", center=(0.8, -0.4, 0.2), size_m=(0.3, 0.25, 0.3))
    story = Story([body, apron, bag], eye=(-1.2, 0.0), target=(1.0, 0.0, 0.7))
    graph = story.run(15)
    (node,) = graph.of_type(ObjectNode)
    assert np.linalg.norm(graph.position(node.id, "room_1") - bag.center) < 0.15


def test_legs_that_were_taken_for_furniture_are_no_node_once_it_is_seen_whose_they_are():
    body = Solid(label="person", center=(1.0, 0.5, 1.2), size_m=(0.4, 0.4, 0.9), cylinder=True)
    legs = Solid(label="unknown", center=(1.0, 0.5, 0.4), size_m=(0.34, 0.24, 0.8))
    bin_ = Solid(label="unknown", center=(0.8, -0.6, 0.4), size_m=(0.34, 0.24, 0.8))
    story = Story([legs, bin_], eye=(-1.2, 0.0), target=(1.0, 0.0, 0.7))
    assert len(story.run(30).of_type(ObjectNode)) == 2
    story.room.solids = [legs, bin_, body]
    graph = story.run(10)
    (node,) = graph.of_type(ObjectNode)
    assert np.linalg.norm(graph.position(node.id, "room_1") - bin_.center) < 0.2


def test_furniture_of_a_doubtful_name_where_somebody_stands_is_a_part_of_them():
    body = Solid(label="person", center=(1.0, 0.5, 1.2), size_m=(0.4, 0.4, 0.9), cylinder=True)
    legs = Solid(label="desk", center=(1.0, 0.5, 0.4), size_m=(0.34, 0.24, 0.8), confidence=0.42)
    desk = Solid(label="desk", center=(1.0, -0.9, 0.4), size_m=(0.6, 1.2, 0.75), confidence=0.42)
    graph = Story([body, legs, desk], eye=(-1.2, 0.0), target=(1.0, 0.0, 0.7)).run(30)
    (node,) = graph.of_type(ObjectNode)
    assert np.linalg.norm(graph.position(node.id, "room_1") - desk.center) < 0.3
