"""References on the graph: none, one, several; labels, names, rooms, relations and order."""

from __future__ import annotations

from dataclasses import replace

import pytest

from flat_reader import goals, in_hall, read
from planner.doubles.sketch import Sketch, flat
from planner.naming import name_of
from planner.plan import Kind
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus, Priority, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import CrossingStatus, DoorNode, DoorState, ObjectState, RoomStatus


def test_nothing_of_the_kind_lists_what_there_is_instead():
    assert read("bring me the green bottle").reply == (
        "I know of no green bottle. I have seen a blue bottle on the table in the kitchen and a red bottle on the desk "
        "in the office."
    )


def test_a_word_that_is_spelled_rightly_is_not_taken_for_another():
    assert "Did you mean" not in read("bring me the ball").reply


def test_what_reads_alike_is_told_once():
    twins = flat()
    for number in (1, 2):
        twins.thing(f"phone_{number}", "phone", on="desk_1", color="blue")
    assert read("bring me the orange phone", in_hall(twins)).reply.count("blue phone") == 1


def test_while_doors_are_left_to_go_through_what_is_unknown_may_still_be_found():
    memory = flat().memory(robot_in="room_2", at=(4.2, 0.0))
    with memory.edit("test", 100.0) as tx:
        tx.put(DoorNode(id="door_2_1_0", rooms=("room_2", None), width_m=0.9, provisional=False))
        tx.put(RtEdge(source="room_2", target="door_2_1_0", T_source_target=SE3.from_xyz_yaw(0.0, 2.0, 0.0, 0.0)))
    reply = read("bring me the green bottle", memory.snapshot()).reply
    assert reply.startswith("I know of no green bottle.")
    assert reply.endswith("I have not seen the whole building yet.")


def test_a_door_that_was_given_up_is_told_with_what_is_unknown():
    memory = flat().memory(robot_in="room_2", at=(4.2, 0.0))
    with memory.edit("test", 100.0) as tx:
        given_up = {"width_m": 0.9, "provisional": False, "crossing": CrossingStatus.GIVEN_UP}
        tx.put(DoorNode(id="door_2_1_0", rooms=("room_2", None), crossing_reason="blocked", **given_up))
        tx.put(RtEdge(source="room_2", target="door_2_1_0", T_source_target=SE3.from_xyz_yaw(0.0, 2.0, 0.0, 0.0)))
    room = name_of("room_2", memory.snapshot())
    reply = read("bring me the green bottle", memory.snapshot()).reply
    assert reply.endswith(f"There is a door in {room} that I have not been through.")


@pytest.mark.parametrize(
    ("agent", "status", "explored", "said"),
    [
        ("objects", IntentionStatus.PROPOSED, False, True),
        ("objects", IntentionStatus.GRANTED, False, True),
        ("objects", IntentionStatus.REVOKED, False, True),
        ("objects", IntentionStatus.FAILED, False, False),
        ("task:task_1", IntentionStatus.GRANTED, False, False),
        ("objects", IntentionStatus.PROPOSED, True, False),
    ],
)
def test_while_an_agent_has_something_left_to_look_at_what_is_unknown_may_still_be_found(agent, status, explored, said):
    memory = flat().memory(robot_in="room_2", at=(4.2, 0.0))
    look = HasIntentionEdge(
        source="robot", target="table_1", agent=agent, action=IntentionAction.LOOK, priority=Priority.LOOK_AROUND
    )
    with memory.edit("test", 100.0) as tx:
        tx.put(replace(look, status=status), replace(tx.snapshot.root, explored=explored))
    reply = read("bring me the green bottle", memory.building()).reply
    assert reply.startswith("I know of no green bottle.")
    assert reply.endswith("I have not seen the whole building yet.") == said


def test_while_a_room_is_being_measured_what_is_unknown_may_still_be_found():
    memory = flat().memory(robot_in="room_2", at=(4.2, 0.0))
    with memory.edit("test", 100.0) as tx:
        tx.put(replace(tx.snapshot.room("room_3"), status=RoomStatus.TEMPORARY))
    assert "not seen the whole building yet" in read("bring me the green bottle", memory.building()).reply


def test_a_short_misspelled_word_suggests_the_label():
    assert "Did you mean apple?" in read("bring me the aqple").reply


def test_a_long_misspelled_word_is_taken_for_the_one_label_it_can_be():
    assert read("bring me the remte").goals == read("bring me the remote").goals != ()


def test_the_place_that_nobody_knows_is_the_news():
    assert "no garage" in read("bring me the cup from the garage").reply


def test_candidates_come_in_natural_order_with_their_identifiers():
    sketch = flat()
    for number in (9, 10, 11):
        sketch.thing(f"jar_{number}", "jar", on="desk_1")
    found = read("bring me the jar", in_hall(sketch))
    assert found.candidates == ("jar_9", "jar_10", "jar_11")


def test_an_exact_label_comes_before_its_synonyms():
    sketch = flat().thing("mug_1", "mug", on="desk_1")
    assert goals("bring me the mug", in_hall(sketch)) == "given(mug_1, person_2)"
    assert read("how many mugs are there", in_hall(sketch)).reply.startswith("I know of 4 mugs")


def test_where_there_is_no_cup_the_mug_there_is_meant():
    sketch = flat().thing("mug_1", "mug", on="desk_1")
    assert goals("bring me the cup from the desk", in_hall(sketch)) == "given(mug_1, person_2)"
    assert goals("bring me the cup from the counter", in_hall(sketch)) == "given(cup_2, person_2)"


def test_where_nothing_is_called_a_coffee_table_a_table_is_meant():
    assert goals("go to the coffee table in the living room") == goals("go to the table in the living room")
    assert "the table in the kitchen or the table in the living room" in read("go to the coffee table").reply
    assert read("how many coffee tables are there?").reply.startswith("I know of 2 coffee tables")


def test_where_one_is_called_a_coffee_table_no_other_table_is_meant():
    sketch = flat().furniture("table_9", "coffee table", "room_2", at=(4.0, 1.0))
    assert goals("go to the coffee table", in_hall(sketch)) == "robot_at(table_9)"
    assert read("how many coffee tables are there?", in_hall(sketch)).reply.startswith("I know of 1 coffee table")
    assert read("how many tables are there?", in_hall(sketch)).reply.startswith("I know of 3 tables")


def test_the_last_word_of_a_label_names_it():
    sketch = flat().thing("knife_1", "butter knife", on="desk_1")
    assert goals("bring me the knife", in_hall(sketch)) == "given(knife_1, person_2)"


def test_a_taught_name_names_one_thing():
    sketch = flat().thing("cup_9", "cup", on="desk_1", name="my mug")
    assert goals("bring me my mug", in_hall(sketch)) == "given(cup_9, person_2)"


def test_rooms_are_known_by_label_synonym_and_identifier():
    for words in ("living room", "lounge", "room_3", "room 3"):
        assert goals(f"go to the {words}") == "robot_at(room_3)"


def test_two_rooms_of_one_label_are_asked_about():
    sketch = flat().room("room_5", "office", at=(4.2, 8.4)).door("room_4", "room_5", at=(4.2, 6.3))
    found = read("go to the office", in_hall(sketch))
    assert (found.kind, found.candidates) == (Kind.CLARIFY, ("room_4", "room_5"))


def test_this_room_is_the_room_of_the_robot():
    assert goals("bring the apple to this room") == "in(apple_1, room_2)"


def test_a_room_before_a_noun_says_where_it_is():
    assert goals("put the apple on the living room table") == "on(apple_1, table_2)"


def test_big_needs_a_clear_difference():
    sketch = flat().thing("jar_1", "jar", on="desk_1", size_m=(0.08, 0.08, 0.10))
    sketch.thing("jar_2", "jar", on="desk_1", size_m=(0.08, 0.08, 0.105))
    assert read("bring me the big jar", in_hall(sketch)).candidates == ("jar_1", "jar_2")
    sketch.thing("jar_3", "jar", on="desk_1", size_m=(0.09, 0.09, 0.2))
    assert goals("bring me the big jar", in_hall(sketch)) == "given(jar_3, person_2)"


def test_nearest_is_measured_along_the_way_through_the_doors():
    sketch = Sketch().room("room_1", "kitchen", at=(0.0, 0.0)).room("room_2", "hall", at=(4.2, 0.0))
    sketch.furniture("table_1", "table", "room_1", at=(1.8, 1.8)).furniture(
        "table_2", "table", "room_2", at=(5.8, -1.5)
    )
    sketch.thing("cup_1", "cup", on="table_1").thing("cup_2", "cup", on="table_2")
    sketch.person("person_1", "user", "room_2", at=(4.0, 1.0))
    assert goals("bring me the nearest cup", in_hall(sketch)) == "given(cup_2, person_1)"


def test_a_missing_object_can_still_be_asked_for():
    sketch = flat().thing("watch_1", "watch", on="desk_1", state=ObjectState.MISSING)
    assert goals("find the watch", in_hall(sketch)) == "found(watch_1)"
    assert goals("bring me the watch", in_hall(sketch)) == "given(watch_1, person_2)"
    assert "not where I last saw it" in read("where is the watch", in_hall(sketch)).reply


def test_any_one_will_do_but_not_one_that_is_lost_or_there_already():
    sketch = flat().thing("jar_1", "jar", on="desk_1").thing("jar_2", "jar", on="counter_1", state=ObjectState.MISSING)
    sketch.thing("jar_3", "jar", on="couch_1")
    assert goals("put a jar on the desk", in_hall(sketch)) == "on(jar_3, desk_1)"


def test_a_relation_of_the_scene_graph_can_be_asked_for():
    sketch = flat().thing("sock_1", "sock", on="couch_1", relation="under").thing("sock_2", "sock", on="couch_1")
    assert goals("bring me the sock under the couch", in_hall(sketch)) == "given(sock_1, person_2)"


def test_a_way_that_is_shut_is_the_reason():
    sketch = flat()
    edges = in_hall(sketch)
    doors = [replace(edges.door(i), state=DoorState.CLOSED) for i in ("door_1_0_0", "door_2_0_0")]
    memory = sketch.memory(robot_in="room_2", at=(4.2, 0.0))
    with memory.edit("doors", 101.0) as tx:
        for door in doors:
            tx.put(door)
    found = read("bring me the apple", memory.snapshot())
    assert found.kind is Kind.REFUSE
    assert "the door between the kitchen and the hall is closed" in found.reply
