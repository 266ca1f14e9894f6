"""Things seen through doors, walls, and things of no room."""

import numpy as np

from perception.objects.agent import ObjectMemory, ObjectMemorySettings
from perception.objects.doubles.raycast import Solid
from perception.objects.seeing.detection import DetectionSettings
from scene_graph.edges import ConnectsEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode, RemoveNode
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import DoorNode, ObjectNode
from unit.perception.objects.story import BLUE_BOTTLE, TABLE, Story


def open_door_to_room_2(story):
    door = DoorNode(id="door_1_0_0", rooms=("room_1", "room_2"), width_m=0.9, provisional=False)
    T_room_door = SE3.from_xyz_yaw(3.0, 0.0, 0.0, np.pi)
    story.memory.commit(
        [
            PutNode(door),
            PutEdge(RtEdge(source="room_1", target=door.id, T_source_target=T_room_door)),
            PutEdge(ConnectsEdge(source=door.id, target="room_1")),
            PutEdge(ConnectsEdge(source=door.id, target="room_2")),
        ],
        agent="door_concept",
        stamp_s=story.now_s,
    )


def test_a_thing_seen_through_the_door_belongs_to_the_room_behind_it():
    story = Story([BLUE_BOTTLE.moved_to((3.7, 0.0, 0.12))], rooms=2, eye=(2.2, 0.0), target=(3.7, 0.0, 0.2))
    open_door_to_room_2(story)
    graph = story.run(6)
    assert graph.room_of("bottle_1") == "room_2"
    assert graph.parent("bottle_1").source == "room_2"


def test_what_was_seen_through_a_door_is_in_the_room_behind_it_once_that_is_known():
    stool = Solid(label="stool", center=(4.2, 0.3, 0.25), size_m=(0.4, 0.4, 0.5))
    bottle = BLUE_BOTTLE.moved_to((3.7, -0.2, 0.12))
    story = Story([stool, bottle], rooms=2, eye=(2.2, 0.0), target=(3.9, 0.0, 0.2))
    assert not story.run(6).of_type(ObjectNode), "nothing is said of a room that nobody knows"
    story.room.target = (-2.0, 0.0, 1.0)
    story.run(30)
    open_door_to_room_2(story)
    graph = story.run(2)
    assert [node.id for node in graph.of_type(ObjectNode)] == ["bottle_1", "stool_1"]
    assert graph.room_of("bottle_1") == graph.room_of("stool_1") == "room_2"
    assert np.linalg.norm(graph.position("bottle_1", "room_1") - bottle.center) < 0.02


def test_a_wall_seen_through_a_door_is_no_furniture_of_the_room_behind_it():
    wall = Solid(label="wardrobe", center=(9.2, 0.0, 1.0), size_m=(0.02, 2.0, 2.0))
    story = Story([wall], rooms=2, eye=(2.9, 0.0), target=(9.2, 0.0, 1.2))
    story.agent = ObjectMemory(
        story.memory,
        story.buffer,
        story.room,
        random=np.random.default_rng(3),
        settings=ObjectMemorySettings(detection=DetectionSettings(range_limit_m=8.0)),
    )
    story.run(6)
    open_door_to_room_2(story)
    assert not story.run(4).of_type(ObjectNode)


def test_nothing_is_placed_while_the_heading_is_in_doubt():
    story = Story([TABLE, BLUE_BOTTLE])
    story.pose_std_rad = 0.02
    assert not story.run(8).of_type(ObjectNode)
    story.pose_std_rad = 0.002
    assert story.run(8).of_type(ObjectNode)


def test_a_thing_outside_every_known_room_is_dropped():
    story = Story([BLUE_BOTTLE.moved_to((3.7, 0.0, 0.12))], eye=(2.2, 0.0), target=(3.7, 0.0, 0.2))
    assert story.run(6).of_type(ObjectNode) == ()


def test_things_of_an_unloaded_room_are_let_go_and_never_written_back():
    story = Story([TABLE, BLUE_BOTTLE])
    story.run(6)
    story.room.silent = True
    story.memory.commit([RemoveNode("bottle_1")], agent="long_term_memory", stamp_s=story.now_s)
    assert "bottle_1" not in story.run(3)
    story.room.silent = False
    assert "bottle_2" in story.run(6)


def test_a_stretch_of_wall_that_the_network_takes_for_a_fridge_is_none():
    def at_the_wall(label, depth_m, width_m, height_m):
        size_m = (depth_m, width_m, height_m)
        return Solid(label=label, center=(3.0 - depth_m / 2, 0.0, height_m / 2 + 0.3), size_m=size_m)

    def seen(solid):
        graph = Story([solid], eye=(1.0, 0.0), target=(3.0, 0.0, 0.9)).run(8)
        return [node.label for node in graph.of_type(ObjectNode)]

    assert seen(at_the_wall("fridge", 0.02, 0.8, 1.2)) == []
    assert seen(at_the_wall("shelf", 0.25, 0.8, 1.2)) == ["shelf"]
    assert seen(at_the_wall("tv", 0.05, 0.8, 0.5)) == ["tv"], "what hangs on walls is there"
