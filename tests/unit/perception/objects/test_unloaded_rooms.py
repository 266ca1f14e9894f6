"""Things of rooms that working memory does not hold keep their names, and nobody gets a name twice."""

from dataclasses import replace

import numpy as np
import pytest

from perception.objects.agent import ObjectMemory
from scene_graph.edges import InEdge, IntentionStatus, RelationEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode
from scene_graph.geometry.se3 import SE3
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ObjectNode, ObjectState
from unit.perception.objects.story import BLUE_BOTTLE, TABLE, Story, finish

ELSEWHERE = ObjectNode(
    id="bottle_1",
    label="bottle",
    label_distribution=(("bottle", 0.99),),
    color="blue",
    name="mine",
    size_m=BLUE_BOTTLE.size_m,
    graspable=True,
    observations=20,
)


@pytest.fixture
def story():
    """A bottle is known to be in room 2; the robot has looked at the table in room 1."""
    story = Story([TABLE], rooms=2, eye=(0.0, -1.0))
    story.memory = WorkingMemory(story.memory.snapshot(), long_term=LongTermStore())
    story.agent = ObjectMemory(story.memory, story.buffer, story.room, random=np.random.default_rng(3))
    hung = RtEdge(source="room_2", target="bottle_1", T_source_target=SE3.from_xyz_yaw(0.0, 1.0, 0.8, 0.0))
    story.memory.commit(
        [PutNode(ELSEWHERE), PutEdge(hung), PutEdge(InEdge(source="bottle_1", target="room_2"))],
        agent="objects",
        stamp_s=0.0,
    )
    story.run(10)
    assert story.memory.snapshot().object("table_1").inspected_s is not None
    story.memory.unload("room_2", agent="ltsm", stamp_s=story.now_s)
    story.run(2)
    return story


def test_what_is_in_an_unloaded_room_stays_there_untouched(story):
    story.run(10)
    assert story.memory.unloaded == ("room_2",)
    assert story.memory.building().object("bottle_1") == ELSEWHERE


def test_a_thing_brought_from_an_unloaded_room_keeps_its_name(story):
    story.wait(600.0)
    story.room.solids = [TABLE, BLUE_BOTTLE]
    graph = story.run(12)
    assert [node.id for node in graph.of_type(ObjectNode)] == ["bottle_1", "table_1"]
    assert graph.room_of("bottle_1") == "room_1"
    assert graph.support_of("bottle_1") == "table_1"
    assert graph.object("bottle_1").name == "mine"


def test_another_thing_gets_a_name_that_is_free_everywhere(story):
    red = replace(BLUE_BOTTLE, color=(200.0, 30.0, 30.0), size_m=(0.09, 0.09, 0.32), center=(-0.2, 0.1, 0.91))
    story.room.solids = [TABLE, red]
    graph = story.run(12)
    assert [node.id for node in graph.of_type(ObjectNode)] == ["bottle_2", "table_1"]
    assert story.memory.building().object("bottle_1") == ELSEWHERE


def test_a_fresh_start_knows_which_names_are_taken(story):
    story.agent = ObjectMemory(story.memory, story.buffer, story.room, random=np.random.default_rng(3))
    story.room.solids = [TABLE, BLUE_BOTTLE]
    assert "bottle_2" in story.run(12)


def test_what_stands_on_furniture_still_does_when_its_room_is_back(story):
    story.room.solids = [TABLE, BLUE_BOTTLE.moved_to((0.2, -0.1, 0.87))]
    story.run(12)
    on_table = story.memory.snapshot().relations(predicate="on")
    assert len(on_table) == 1
    story.room.silent = True
    robot = story.memory.snapshot()
    moved = [RtEdge(source="room_2", target="robot", T_source_target=SE3.identity())]
    with story.memory.edit("test", story.now_s) as tx:
        tx.remove(*(edge.key for edge in (*robot.edges_to("robot"), *robot.edges_from("robot"))))
        tx.put(*moved, InEdge(source="robot", target="room_2"))
    story.memory.unload("room_1", agent="ltsm", stamp_s=story.now_s)
    story.agent_only(3)
    assert story.memory.unloaded == ("room_1",)
    story.memory.load("room_1", agent="ltsm", stamp_s=story.now_s)
    story.agent_only(3)
    assert [edge.key for edge in story.memory.snapshot().relations(predicate="on")] == [on_table[0].key]


def test_a_thing_missed_here_that_was_seen_in_a_room_that_is_unloaded_now_is_known_to_be_there():
    story = Story([TABLE, BLUE_BOTTLE], rooms=2, eye=(0.0, -1.0))
    story.memory = WorkingMemory(story.memory.snapshot(), long_term=LongTermStore())
    story.agent = ObjectMemory(story.memory, story.buffer, story.room, random=np.random.default_rng(3))
    assert story.run(10).support_of("bottle_1") == "table_1"
    finish(story, "room_2", IntentionStatus.DONE)
    shelf = ObjectNode(id="shelf_1", label="shelf", size_m=(0.8, 0.3, 1.0), support=True, inspected_s=0.5)
    there = replace(ELSEWHERE, id="bottle_2", name="", first_seen_s=story.now_s + 2.0, last_seen_s=story.now_s + 2.2)
    story.room.target = (0.0, -3.0, 1.0)
    story.run(12)
    with story.memory.edit("objects", story.now_s) as tx:
        for node, height_m in ((shelf, 0.5), (there, 1.12)):
            T_room_node = SE3.from_xyz_yaw(0.0, 1.0, height_m, 0.0)
            tx.put(node, RtEdge(source="room_2", target=node.id, T_source_target=T_room_node))
            tx.put(InEdge(source=node.id, target="room_2"))
        tx.put(RelationEdge(source="bottle_2", target="shelf_1", predicate="on", probability=0.95))
    story.run(2)
    story.memory.unload("room_2", agent="ltsm", stamp_s=story.now_s)
    story.run(2)
    story.room.solids, story.room.target = [TABLE], (0.0, 0.0, 0.75)
    story.run(20)
    building = story.memory.building()
    assert building.object("bottle_1").state is ObjectState.PRESENT
    assert building.room_of("bottle_1") == "room_2"
    assert building.support_of("bottle_1") == "shelf_1"
    assert "bottle_2" not in building
