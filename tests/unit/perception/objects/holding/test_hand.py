"""What the hand takes, holds, lets go and loses."""

from dataclasses import replace

import numpy as np
import pytest

from perception.objects.agent import ObjectMemory
from perception.objects.doubles.raycast import Solid
from perception.objects.doubles.scripted import say
from scene_graph.long_term.keeping import KeepingSettings, _with_empty_hand
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ObjectNode, ObjectState
from unit.perception.objects.story import BLUE_BOTTLE, RED_CUP, TABLE, Story, grasped, joints


def test_what_lies_near_is_not_taken_for_the_thing_that_slipped_from_the_fingers():
    story = grasped()
    story.run(4)
    story.room.joints = joints((0.4, 0.0, 0.9), (False, False), 0.0)
    story.run(3)
    story.room.eye, story.room.target = (-2.4, 0.0), (-1.2, 0.2, 0.0)
    ball = Solid(label="ball", center=(-1.2, 0.2, 0.04), size_m=(0.08, 0.08, 0.08), color=(220.0, 30.0, 30.0))
    story.room.solids = [TABLE, RED_CUP, ball]
    graph = story.run(8)
    assert graph.object("bottle_1").state is ObjectState.MISSING
    assert "ball" in [n.label for n in graph.of_type(ObjectNode)]


@pytest.mark.parametrize("grasped_at", [True, False])
def test_a_book_that_the_hand_pushed_off_the_table_is_what_lies_below_though_it_looks_like_a_box(grasped_at):
    book = Solid(label="book", center=(-0.4, 0.1, 0.768), size_m=(0.2, 0.085, 0.036), color=(220.0, 200.0, 30.0))
    story = Story([TABLE, book])
    story.run(8)
    if grasped_at:
        say(story.memory, "grasping book_1", story.now_s)
    story.room.joints = joints((0.9, 0.1, 0.8), (False, False), 0.0)
    story.room.solids = [TABLE, replace(book, label="box", center=(-1.0, 0.3, 0.018))]
    story.run(2)
    say(story.memory, "stowing", story.now_s)
    story.room.joints = joints((0.1, 0.0, 0.75))
    assert story.run(25).object("book_1").state is ObjectState.MISSING
    story.room.eye, story.room.target = (-2.4, 0.6), (-1.0, 0.3, 0.0)
    graph = story.run(12)
    assert graph.object("book_1").state is (ObjectState.PRESENT if grasped_at else ObjectState.MISSING)
    small = [node.id for node in graph.of_type(ObjectNode) if node.graspable]
    assert small == (["book_1"] if grasped_at else ["book_1", "box_1"])
    if grasped_at:
        assert graph.position("book_1", "room_1") == pytest.approx((-1.0, 0.3, 0.018), abs=0.03)


def test_a_grasped_thing_hangs_from_the_gripper_and_has_no_support():
    story = grasped()
    graph = story.run(4)
    assert graph.robot.holding == "bottle_1"
    assert graph.object("bottle_1").state is ObjectState.HELD
    assert graph.parent("bottle_1").source == "robot"
    assert graph.room_of("bottle_1") == "room_1"
    assert graph.support_of("bottle_1") is None
    assert np.linalg.norm(graph.position("bottle_1", "robot") - (0.4, 0.0, 0.9)) < 0.1


def test_a_released_thing_stands_on_its_support_before_and_after_it_is_seen_again():
    story = grasped()
    story.run(4)
    place = np.array((0.2, 0.2, 0.87))
    story.room.eye = (-0.9, 0.0)
    T_base_room = story.room.T_room_base.inverse()
    say(story.memory, "releasing bottle_1 table_1", story.now_s)
    story.room.joints = joints(T_base_room.apply(place), (True, True), 0.068)
    story.run(1)
    story.room.silent = True
    story.room.joints = joints(T_base_room.apply(place), (False, False), 0.12)
    graph = story.run(3)
    assert graph.robot.holding is None
    assert graph.object("bottle_1").state is ObjectState.PRESENT
    assert graph.parent("bottle_1").source == "room_1"
    assert graph.support_of("bottle_1") == "table_1"
    assert np.linalg.norm(graph.position("bottle_1", "room_1") - place) < 0.1
    story.room.silent = False
    story.room.joints = joints((0.1, 0.0, 0.75))
    story.room.solids = [TABLE, RED_CUP, BLUE_BOTTLE.moved_to(tuple(place))]
    graph = story.run(6)
    assert np.linalg.norm(graph.position("bottle_1", "room_1") - place) < 0.015
    assert [n.id for n in graph.of_type(ObjectNode)] == ["bottle_1", "cup_1", "table_1"]


def test_what_the_hand_puts_where_a_look_alike_is_missed_is_what_was_in_the_hand():
    mine, theirs = (0.2, 0.2, 0.87), BLUE_BOTTLE.center
    story = Story([TABLE, BLUE_BOTTLE, RED_CUP, BLUE_BOTTLE.moved_to(mine)])
    graph = story.run(6)
    node_id = min(("bottle_1", "bottle_2"), key=lambda each: np.linalg.norm(graph.position(each, "room_1") - mine))
    other_id = {"bottle_1": "bottle_2", "bottle_2": "bottle_1"}[node_id]
    say(story.memory, f"grasping {node_id}", story.now_s)
    story.room.joints = joints(graph.position(node_id, "robot"), (True, True), 0.068)
    story.run(3)
    say(story.memory, "driving table_1", story.now_s)
    story.room.solids, story.room.eye = [TABLE, RED_CUP], (-1.6, 0.0)
    story.room.joints = joints((0.4, 0.0, 0.9), (True, True), 0.068)
    assert story.run(12).object(other_id).state is ObjectState.MISSING
    story.room.eye = (-0.9, 0.0)
    say(story.memory, f"releasing {node_id} table_1", story.now_s)
    at_hand = story.room.T_room_base.inverse().apply(np.array(theirs))
    for contacts, opening_m in (((True, True), 0.068), ((False, False), 0.12)):
        story.room.joints = joints(at_hand, contacts, opening_m)
        story.run(1)
        story.room.silent = True
    story.room.silent, story.room.joints = False, joints((0.1, 0.0, 0.75))
    story.room.solids = [TABLE, RED_CUP, BLUE_BOTTLE.moved_to((theirs[0] + 0.02, *theirs[1:]))]
    graph = story.run(10)
    assert graph.object(node_id).state is ObjectState.PRESENT
    assert graph.object(node_id).last_seen_s > story.now_s - 0.5
    assert graph.object(other_id).state is ObjectState.MISSING


def test_what_shows_beside_the_hand_is_no_new_thing_until_the_hand_is_away():
    story = Story([TABLE, BLUE_BOTTLE, RED_CUP])
    above = np.array(BLUE_BOTTLE.center) + np.array((0.0, 0.0, 0.2))
    story.room.joints = joints(story.room.T_room_base.inverse().apply(above))
    graph = story.run(8)
    assert [n.id for n in graph.of_type(ObjectNode)] == ["cup_1", "table_1"]
    story.room.joints = joints((0.1, 0.0, 0.75))
    graph = story.run(8)
    assert [n.id for n in graph.of_type(ObjectNode)] == ["bottle_1", "cup_1", "table_1"]


@pytest.mark.parametrize("arm", ["hand over it", "drawn in"])
def test_what_shows_of_a_thing_under_the_arm_tells_nothing_of_it(arm):
    story = Story([TABLE, BLUE_BOTTLE, RED_CUP])
    story.run(6)
    half = Solid(label="toy", center=(0.02, -0.17, 0.78), size_m=(0.05, 0.05, 0.06), color=(200.0, 30.0, 30.0))
    above = story.room.T_room_base.inverse().apply(np.add(RED_CUP.center, (0.0, 0.0, 0.25)))
    story.room.joints = joints(above) if arm == "hand over it" else joints((0.1, 0.0, 0.75), extension_m=0.0)
    story.room.solids = [TABLE, BLUE_BOTTLE, half]
    graph = story.run(12)
    assert graph.object("cup_1").state is ObjectState.PRESENT
    moved_m = np.linalg.norm(graph.position("cup_1", "room_1") - RED_CUP.center)
    assert bool(moved_m < 0.01) is (arm == "hand over it")


def test_a_thing_that_slips_from_the_fingers_is_missing_near_the_robot_until_seen():
    story = grasped()
    story.run(4)
    story.room.joints = joints((0.4, 0.0, 0.9), (False, False), 0.0)
    graph = story.run(3)
    assert graph.robot.holding is None
    assert graph.object("bottle_1").state is ObjectState.MISSING
    assert np.linalg.norm(graph.position("bottle_1", "robot")[:2] - (0.4, 0.0)) < 0.1
    story.room.eye, story.room.target = (-2.4, 0.0), (-1.2, 0.2, 0.0)
    story.room.solids = [TABLE, RED_CUP, BLUE_BOTTLE.moved_to((-1.2, 0.2, 0.12))]
    graph = story.run(8)
    assert graph.object("bottle_1").state is ObjectState.PRESENT
    assert np.linalg.norm(graph.position("bottle_1", "room_1") - (-1.2, 0.2, 0.12)) < 0.02


def test_a_thing_that_slips_from_the_fingers_on_its_way_down_was_not_put_there():
    story = grasped()
    story.run(4)
    T_base_room = story.room.T_room_base.inverse()
    say(story.memory, "releasing bottle_1 table_1", story.now_s)
    story.room.joints = joints(T_base_room.apply(np.array((0.2, 0.2, 1.1))), (True, True), 0.068)
    story.run(1)
    story.room.silent = True
    story.room.joints = replace(story.room.joints, finger_contacts=(False, False), gripper_opening_m=0.02)
    graph = story.run(3)
    assert graph.robot.holding is None
    assert graph.object("bottle_1").state is ObjectState.MISSING
    assert graph.support_of("bottle_1") is None


def switched_on_again(story, contacts, opening_m):
    """The robot after a restart, in front of the same table, with fingers that feel this."""
    story.memory = WorkingMemory(_with_empty_hand(story.memory.snapshot(), KeepingSettings()))
    assert story.memory.snapshot().object("bottle_1").state is ObjectState.MISSING
    random = np.random.default_rng(4)
    story.agent = ObjectMemory(story.memory, story.buffer, story.room, random=random, held_before="bottle_1")
    story.room.joints = joints((0.4, 0.0, 0.9), contacts, opening_m)
    return story


def test_what_is_still_in_the_hand_after_a_restart_is_held():
    story = grasped()
    story.run(4)
    graph = switched_on_again(story, (True, True), 0.068).run(4)
    assert graph.robot.holding == "bottle_1"
    assert graph.object("bottle_1").state is ObjectState.HELD
    assert np.linalg.norm(graph.position("bottle_1", "robot") - (0.4, 0.0, 0.9)) < 0.15
    story.room.joints = joints((0.4, 0.0, 0.9), (False, False), 0.0)
    assert story.run(3).object("bottle_1").state is ObjectState.MISSING


@pytest.mark.parametrize("opening_m", [0.0, 0.12])
def test_what_is_no_longer_in_the_hand_after_a_restart_is_missing_until_it_is_seen(opening_m):
    story = grasped()
    story.run(4)
    graph = switched_on_again(story, (False, False), opening_m).run(4)
    assert graph.robot.holding is None
    assert graph.object("bottle_1").state is ObjectState.MISSING
    story.room.joints = joints((0.4, 0.0, 0.9), (True, True), 0.05)  # something else, that nobody said is grasped
    assert story.run(3).robot.holding is None
    story.room.joints = joints((0.1, 0.0, 0.75))
    story.room.solids = [TABLE, RED_CUP, BLUE_BOTTLE]
    graph = story.run(8)
    assert graph.object("bottle_1").state is ObjectState.PRESENT
    assert [n.id for n in graph.of_type(ObjectNode)] == ["bottle_1", "cup_1", "table_1"]
    assert np.linalg.norm(graph.position("bottle_1", "room_1") - BLUE_BOTTLE.center) < 0.03


def test_contact_without_an_announcement_is_no_grasp():
    story = Story([TABLE, BLUE_BOTTLE])
    story.run(5)
    story.room.joints = joints((0.5, 0.0, 0.9), (True, True), 0.05)
    assert story.run(5).robot.holding is None


def test_a_phantom_grasp_is_found_out_when_the_thing_is_still_seen_in_its_place():
    story = Story([TABLE, BLUE_BOTTLE])
    graph = story.run(6)
    say(story.memory, "grasping bottle_1", story.now_s)
    story.room.joints = joints(graph.position("bottle_1", "robot"), (True, True), 0.03)
    story.run(2)
    assert story.memory.snapshot().robot.holding == "bottle_1"
    story.room.joints = joints((0.3, 0.0, 1.2), (True, True), 0.03)
    graph = story.run(8)
    assert graph.robot.holding is None
    assert graph.object("bottle_1").state is ObjectState.PRESENT
    assert graph.parent("bottle_1").source == "room_1"
