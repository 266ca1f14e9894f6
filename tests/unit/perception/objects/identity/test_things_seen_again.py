"""Things that are seen again in their places, at others, or beside those like them."""

import numpy as np
import pytest

from perception.objects.doubles.raycast import Solid
from scene_graph.nodes import ObjectNode, ObjectState
from unit.perception.objects.story import BLUE_BOTTLE, RED_CUP, TABLE, Story


def test_a_thing_taken_away_becomes_missing_and_present_again_when_it_returns():
    story = Story([TABLE, BLUE_BOTTLE, RED_CUP])
    story.run(6)
    story.room.solids = [TABLE, RED_CUP]
    graph = story.run(15)
    assert graph.object("bottle_1").state is ObjectState.MISSING
    assert graph.support_of("bottle_1") is None
    assert graph.object("cup_1").state is ObjectState.PRESENT
    story.room.solids = [TABLE, BLUE_BOTTLE, RED_CUP]
    graph = story.run(5)
    assert graph.object("bottle_1").state is ObjectState.PRESENT
    assert [n.id for n in graph.of_type(ObjectNode)] == ["bottle_1", "cup_1", "table_1"]


def test_a_scrap_seen_for_a_moment_where_a_thing_is_missed_is_not_that_thing():
    story = Story([TABLE, BLUE_BOTTLE, RED_CUP])
    story.run(6)
    story.room.solids = [TABLE, RED_CUP]
    assert story.run(15).object("bottle_1").state is ObjectState.MISSING
    x_m, y_m, z_m = BLUE_BOTTLE.center
    scrap = Solid(label="unknown", center=(x_m, y_m, z_m - 0.05), size_m=(0.12, 0.06, 0.05), color=(40.0, 120.0, 40.0))
    story.room.solids = [TABLE, RED_CUP, scrap]
    assert story.run(2).object("bottle_1").state is ObjectState.MISSING


def test_a_thing_moved_across_the_table_keeps_its_name():
    story = Story([TABLE, BLUE_BOTTLE, RED_CUP])
    story.run(6)
    story.room.solids = [TABLE, BLUE_BOTTLE.moved_to((0.25, 0.25, 0.87)), RED_CUP]
    graph = story.run(20)
    assert [n.id for n in graph.of_type(ObjectNode)] == ["bottle_1", "cup_1", "table_1"]
    assert np.linalg.norm(graph.position("bottle_1", "room_1") - (0.25, 0.25, 0.87)) < 0.02


def test_a_thing_nudged_a_little_is_followed():
    story = Story([TABLE, BLUE_BOTTLE])
    story.run(10)
    story.room.solids = [TABLE, BLUE_BOTTLE.moved_to((-0.16, 0.13, 0.87))]
    graph = story.run(12)
    assert np.linalg.norm(graph.position("bottle_1", "room_1") - (-0.16, 0.13, 0.87)) < 0.015
    assert [n.id for n in graph.of_type(ObjectNode)] == ["bottle_1", "table_1"]


def test_two_equal_cups_in_view_are_two_cups():
    other = RED_CUP.moved_to((0.1, 0.1, 0.80))
    graph = Story([TABLE, RED_CUP, other]).run(10)
    assert [n.id for n in graph.of_type(ObjectNode)] == ["cup_1", "cup_2", "table_1"]


def test_a_bottle_seen_again_elsewhere_after_a_while_is_the_same_bottle_where_one_had_looked_before():
    desk = Solid(label="desk", center=(0.0, 2.2, 0.375), size_m=(1.2, 0.6, 0.75), color=(90.0, 90.0, 90.0))
    story = Story([TABLE, desk, BLUE_BOTTLE], eye=(-1.2, 0.0))
    story.run(8)
    story.room.eye, story.room.target = (0.0, 1.0), (0.0, 2.2, 0.75)
    story.run(10)
    assert story.memory.snapshot().object("desk_1").inspected_s is not None
    story.wait(600.0)
    story.room.solids = [TABLE, desk, BLUE_BOTTLE.moved_to((0.1, 2.1, 0.87))]
    graph = story.run(8)
    assert [n.id for n in graph.of_type(ObjectNode)] == ["bottle_1", "desk_1", "table_1"]
    assert graph.support_of("bottle_1") == "desk_1"


def test_a_bottle_seen_at_its_new_place_before_it_is_missed_at_the_old_one_gets_its_name_back():
    desk = Solid(label="desk", center=(0.0, 2.2, 0.375), size_m=(1.2, 0.6, 0.75), color=(90.0, 90.0, 90.0))
    at_table, at_desk = ((-1.2, 0.0), (0.0, 0.0, 0.75)), ((0.0, 1.0), (0.0, 2.2, 0.75))
    story = Story([TABLE, desk, BLUE_BOTTLE], eye=at_table[0])
    for view, steps in ((at_table, 8), (at_desk, 10), (at_table, 4)):
        story.room.eye, story.room.target = view
        story.run(steps)
    story.room.solids = [TABLE, desk, BLUE_BOTTLE.moved_to((0.1, 2.1, 0.87))]
    story.room.eye, story.room.target = at_desk
    graph = story.run(8)
    assert {"bottle_1", "bottle_2"} <= {n.id for n in graph.of_type(ObjectNode)}, "nothing speaks against two yet"
    story.room.eye, story.room.target = at_table
    graph = story.run(20)
    assert [n.id for n in graph.of_type(ObjectNode)] == ["bottle_1", "desk_1", "table_1"]
    assert graph.object("bottle_1").state is ObjectState.PRESENT
    assert graph.support_of("bottle_1") == "desk_1"


def test_of_two_equal_bottles_the_one_taken_away_is_missing_and_not_the_other():
    desk = Solid(label="desk", center=(0.0, 2.2, 0.375), size_m=(1.2, 0.6, 0.75), color=(90.0, 90.0, 90.0))
    other = BLUE_BOTTLE.moved_to((0.1, 2.1, 0.87))
    story = Story([TABLE, desk, BLUE_BOTTLE, other], eye=(-1.2, 0.0))
    story.run(8)
    story.room.eye, story.room.target = (0.0, 1.0), (0.0, 2.2, 0.75)
    story.run(10)
    story.room.solids = [TABLE, desk, other]
    story.room.eye, story.room.target = (-1.2, 0.0), (0.0, 0.0, 0.75)
    graph = story.run(20)
    assert graph.object("bottle_1").state is ObjectState.MISSING
    assert graph.object("bottle_2").state is ObjectState.PRESENT


@pytest.mark.parametrize("shift", [(0.0, 0.0, 0.14), (0.0, -0.2, 0.0)])
@pytest.mark.parametrize("gone_first", [0, 1])
@pytest.mark.parametrize("back", [0, 1])
def test_of_two_missing_bottles_the_one_that_was_missed_there_or_nearest_is_found_again(gone_first, back, shift):
    bottles = [BLUE_BOTTLE, BLUE_BOTTLE.moved_to((0.35, 0.1, 0.87))]
    story = Story([TABLE, *bottles])
    graph = story.run(8)
    places = {n.id: graph.position(n.id, "room_1")[0] for n in graph.of_type(ObjectNode) if n.label == "bottle"}
    names = sorted(places, key=places.__getitem__)
    story.room.solids = [TABLE, bottles[1 - gone_first]]
    story.run(8)
    story.room.solids = [TABLE]
    graph = story.run(8)
    assert {graph.object(name).state for name in names} == {ObjectState.MISSING}
    x_m, y_m, z_m = np.array(bottles[back].center) + shift
    story.room.solids = [TABLE, bottles[back].moved_to((x_m, y_m, z_m))]
    graph = story.run(8)
    assert graph.object(names[back]).state is ObjectState.PRESENT
    assert graph.object(names[1 - back]).state is ObjectState.MISSING


def test_a_second_bottle_found_while_exploring_is_a_second_bottle():
    desk = Solid(label="desk", center=(0.0, 2.2, 0.375), size_m=(1.2, 0.6, 0.75), color=(90.0, 90.0, 90.0))
    story = Story([TABLE, desk, BLUE_BOTTLE, BLUE_BOTTLE.moved_to((0.1, 2.1, 0.87))], eye=(-1.2, 0.0))
    story.run(8)
    story.wait(20.0)
    story.room.eye, story.room.target = (0.0, 1.0), (0.0, 2.2, 0.75)
    graph = story.run(10)
    assert {"bottle_1", "bottle_2"} <= {n.id for n in graph.of_type(ObjectNode)}
    assert graph.support_of("bottle_2") == "desk_1"
