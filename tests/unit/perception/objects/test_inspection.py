"""Where the robot still has to look."""

from dataclasses import replace

import pytest

from perception.objects.doubles.raycast import Solid
from scene_graph.edges import IntentionAction, IntentionStatus
from scene_graph.edits import PutNode
from scene_graph.nodes import RoomStatus
from unit.perception.objects.story import TABLE, Story, finish


def test_rooms_are_looked_around_then_supports_and_only_those_not_seen_from_near():
    far_table = Solid(label="desk", center=(2.0, 1.5, 0.375), size_m=(1.2, 0.6, 0.75))
    story = Story([TABLE, far_table], eye=(-1.3, 0.0), target=(1.0, 0.6, 0.6))
    graph = story.run(8)
    assert [(e.target, e.action) for e in graph.intentions()] == [("room_1", IntentionAction.LOOK)]
    finish(story, "room_1", IntentionStatus.DONE)
    graph = story.run(10)
    assert "desk_1" in {e.target for e in graph.intentions(IntentionStatus.PROPOSED)}
    story.room.eye, story.room.target = (2.0, 0.4), (2.0, 1.5, 0.75)
    story.run(1)
    finish(story, "desk_1", IntentionStatus.DONE)
    graph = story.run(1)
    assert graph.object("desk_1").inspected_s == story.now_s
    assert "desk_1" not in {e.target for e in graph.intentions()}
    assert graph.intentions(IntentionStatus.DONE)[0].target == "room_1"


@pytest.mark.parametrize(("status", "looked_around"), [(RoomStatus.PARTIAL, True), (RoomStatus.TEMPORARY, False)])
def test_a_room_is_looked_around_once_it_stands_though_a_part_of_it_is_only_guessed(status, looked_around):
    story = Story([TABLE])
    room = story.memory.snapshot().room("room_1")
    story.memory.commit([PutNode(replace(room, status=status))], agent="room_concept", stamp_s=0.0)
    assert ("room_1" in {edge.target for edge in story.run(2).intentions()}) is looked_around


def test_a_support_seen_from_near_counts_as_inspected():
    story = Story([TABLE], eye=(-1.2, 0.0))
    story.run(4)
    story.room.eye = (-1.0, 0.4)
    story.run(4)
    story.room.target = (0.0, -0.2, 0.75)
    graph = story.run(4)
    assert graph.object("table_1").inspected_s is not None


def test_a_support_that_a_look_did_not_show_is_looked_at_once_more_from_the_other_side():
    story = Story([TABLE], eye=(-2.6, 0.0))
    story.run(8)
    finish(story, "room_1", IntentionStatus.DONE)
    story.run(2)
    finish(story, "table_1", IntentionStatus.DONE)
    graph = story.run(1)
    (again,) = graph.intentions(IntentionStatus.PROPOSED)
    assert again.target == "table_1"
    assert abs(again.side_rad) < 0.8, "not from where one looked"
    assert graph.object("table_1").inspected_s is None
    finish(story, "table_1", IntentionStatus.DONE)
    graph = story.run(1)
    assert graph.object("table_1").inspected_s == story.now_s
    assert not graph.intentions(IntentionStatus.PROPOSED)


def test_a_look_that_fails_twice_is_given_up_with_its_reason():
    story = Story([TABLE])
    story.run(2)
    for _ in range(2):
        finish(story, "room_1", IntentionStatus.FAILED, "way blocked")
        graph = story.run(2)
    (edge,) = [e for e in graph.intentions() if e.target == "room_1"]
    assert edge.status is IntentionStatus.FAILED
    assert "way blocked" in edge.reason
    assert [e for e in story.run(3).intentions() if e.target == "room_1"] == [edge]
