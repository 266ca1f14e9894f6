"""References on the graph: none, one, several; labels, names, rooms, relations, order, and what was said before."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.controller.identity_check import IdentityCheck
from planner.dialogue.interpreter import Interpreter
from planner.doubles.sketch import Sketch, flat
from planner.language.grammar.parser import CommandGrammar
from planner.naming import name_of
from planner.plan import Dialogue, Kind
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus, Priority, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import CrossingStatus, DoorNode, DoorState, ObjectState, RoomStatus
from skills.registry import load_registry

VERIFIER = Verifier(load_registry([]))
INTERPRETER = Interpreter(CommandGrammar(), VERIFIER)
PLANNER = TaskPlanner(CommandGrammar(), VERIFIER)
FLAT = flat().snapshot(robot_in="room_2", at=(4.2, 0.0))


def read(text, snapshot=FLAT, **dialogue):
    return INTERPRETER.read(text, snapshot, Dialogue(**dialogue)).interpretation


def goals(text, snapshot=FLAT, **dialogue):
    found = read(text, snapshot, **dialogue)
    return " ".join(map(str, found.goals)) or f"{found.kind}: {found.reply}"


def in_hall(sketch):
    return sketch.snapshot(robot_in="room_2", at=(4.2, 0.0))


def at_desk(sketch):
    return sketch.snapshot(robot_in="room_4", at=(4.2, 4.4))


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


def nameless(sketch, node_id, on, **chances):
    return sketch.thing(node_id, "unknown", on=on, label_distribution=tuple(chances.items()))


def test_what_has_no_name_is_meant_where_nothing_else_is_and_it_most_probably_is_that():
    sketch = nameless(flat(), "unknown_1", "desk_1", unknown=0.45, ball=0.4, orange=0.15)
    assert goals("bring me the ball", in_hall(sketch)) == "given(unknown_1, person_2)"
    assert "no orange" in read("bring me the orange", in_hall(sketch)).reply
    assert "no ball" in read("bring me the ball from the table", in_hall(sketch)).reply
    nameless(sketch, "unknown_2", "table_1", unknown=0.5, ball=0.35)
    assert set(read("bring me the ball", in_hall(sketch)).candidates) == {"unknown_1", "unknown_2"}
    sketch.thing("ball_1", "ball", on="counter_1")
    assert goals("bring me the ball", in_hall(sketch)) == "given(ball_1, person_2)"


def test_so_is_a_place_without_a_name():
    chances = (("unknown", 0.55), ("piano", 0.4))
    sketch = flat().furniture("unknown_1", "unknown", "room_3", at=(9.5, 1.0), label_distribution=chances)
    sketch.thing("ball_1", "ball", on="unknown_1")
    sketch.thing("ball_2", "ball", on="desk_1")
    assert goals("bring me the ball from the piano", in_hall(sketch)) == "given(ball_1, person_2)"
    assert goals("put the ball on the desk on the piano", in_hall(sketch)) == "on(ball_2, unknown_1)"


@pytest.mark.parametrize(("label", "mistaken"), [("unknown", False), ("ball", False), ("orange", True)])
def test_what_has_no_name_and_was_taken_for_a_ball_must_not_turn_out_to_be_something_else(label, mistaken):
    request = "bring me the ball"
    before = nameless(flat(), "unknown_1", "desk_1", unknown=0.45, ball=0.4, orange=0.15)
    taken = IdentityCheck(request, read(request, in_hall(before)).goals, in_hall(before))
    after = flat().thing("unknown_1", label, on="desk_1", label_distribution=((label, 0.95),))
    assert (taken.mistake(at_desk(after)) is not None) == mistaken


@pytest.mark.parametrize("label", ["orange", "unknown"])
@pytest.mark.parametrize(
    ("where", "doubted"),
    [
        ({"robot_in": "room_2", "at": (4.2, 0.0)}, False),
        ({"robot_in": "room_4", "at": (4.2, 3.0)}, False),
        ({"robot_in": "room_4", "at": (4.2, 4.4)}, True),
        ({"robot_in": "room_2", "at": (4.2, 0.0), "holding": "ball_1"}, True),
    ],
)
def test_what_a_thing_looks_like_from_afar_waits_until_the_robot_is_there(label, where, doubted):
    request, before = "bring me the ball", flat().thing("ball_1", "ball", on="desk_1")
    taken = IdentityCheck(request, read(request, in_hall(before)).goals, in_hall(before))
    after = flat().thing("ball_1", label, on="desk_1", label_distribution=((label, 0.95),)).snapshot(**where)
    assert ((taken.mistake(after) or taken.refuted(after)) is not None) == doubted
    assert (taken.mistake(after, at_last=True) or taken.refuted(after, at_last=True)) is not None


@pytest.mark.parametrize("label", ["orange", "unknown"])
def test_what_slipped_from_the_hand_is_what_it_was_until_all_is_done_however_it_looks_where_it_lies(label):
    request, before = "bring me the ball", flat().thing("ball_1", "ball", on="desk_1")
    after = at_desk(flat().thing("ball_1", label, on="desk_1", label_distribution=((label, 0.95),)))

    def doubt(**last):
        return taken.mistake(after, **last) or taken.refuted(after, **last)

    taken = IdentityCheck(request, read(request, in_hall(before)).goals, in_hall(before))
    assert doubt() is not None
    taken.fell("ball_1")
    assert doubt() is None
    assert doubt(at_last=True) is not None


def test_what_hardly_may_be_a_ball_is_none():
    sketch = nameless(flat(), "unknown_1", "desk_1", unknown=0.8, ball=0.15)
    assert "no ball" in read("bring me the ball", in_hall(sketch)).reply


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


def test_without_anybody_seen_me_has_no_place():
    sketch = Sketch().room("room_2", "hall", at=(4.2, 0.0)).furniture("table_1", "table", "room_2", at=(4.2, 1.0))
    sketch.thing("cup_1", "cup", on="table_1")
    assert read("bring me the cup", in_hall(sketch)).reply == "I see nobody, so I do not know where you are."


def test_the_only_person_is_me_and_of_several_the_user_or_the_one_who_speaks():
    assert goals("bring me the apple") == "given(apple_1, person_2)"
    assert goals("bring me the apple", speaker="person_1") == "given(apple_1, person_1)"
    sketch = Sketch().room("room_2", "hall", at=(4.2, 0.0)).furniture("table_1", "table", "room_2", at=(4.2, 1.0))
    sketch.thing("cup_1", "cup", on="table_1").person("person_7", "", "room_2", at=(4.2, -1.0))
    assert goals("bring me the cup", in_hall(sketch)) == "given(cup_1, person_7)"
    sketch.person("person_8", "", "room_2", at=(3.2, -1.0))
    assert read("bring me the cup", in_hall(sketch)).candidates == ("person_7", "person_8")


def test_it_is_what_was_spoken_of_in_this_request_then_in_the_hand_then_before():
    assert goals("pick up the apple and put it in the box", mentioned=("book_1",)) == "in(apple_1, box_1)"
    assert goals("put it on the desk", mentioned=("book_1", "apple_1")) == "on(book_1, desk_1)"
    holding = flat().snapshot(robot_in="room_2", at=(4.2, 0.0), holding="cup_1")
    assert goals("put it on the desk", holding, mentioned=("book_1",)) == "on(cup_1, desk_1)"
    assert read("put it on the desk").kind is Kind.REFUSE


def test_what_is_held_is_put_down_here():
    holding = flat().snapshot(robot_in="room_1", at=(0.0, 0.0), holding="cup_2")
    assert goals("put it down", holding) == "in(cup_2, room_1)"
    assert goals("put down the green cup", holding) == "in(cup_2, room_1)"
    assert goals("put down whatever you are holding", holding) == "in(cup_2, room_1)"
    assert read("what are you holding", holding).reply == "I am holding the green cup."


def test_the_room_gone_to_settles_which_one():
    assert goals("go to the kitchen and take the bottle") == "robot_at(room_1) holding(bottle_1)"


def test_the_same_noun_later_in_a_request_is_the_same_thing():
    assert goals("take the red cup and put the cup on the desk") == "on(cup_1, desk_1)"


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


def test_mentioned_lists_the_newest_first():
    assert read("pick up the apple and go to the office").mentioned[0] == "room_4"
    assert "apple_1" in read("where is the apple").mentioned


ANSWERS = [
    ("bring me the bottle", ["the blue one"], "given(bottle_1, person_2)"),
    ("bring me the bottle", ["blue"], "given(bottle_1, person_2)"),
    ("bring me the bottle", ["2"], "given(bottle_2, person_2)"),
    ("bring me the bottle", ["the second one"], "given(bottle_2, person_2)"),
    ("bring me the bottle", ["the one on the desk"], "given(bottle_2, person_2)"),
    ("bring me the bottle", ["on the desk"], "given(bottle_2, person_2)"),
    ("bring me the bottle", ["in the office"], "given(bottle_2, person_2)"),
    ("bring me the bottle", ["bottle_1"], "given(bottle_1, person_2)"),
    ("bring me the bottle", ["both"], "given(bottle_1, person_2) given(bottle_2, person_2)"),
    ("bring me the bottle", ["any"], "given(bottle_1, person_2)"),
    ("bring me the bottle", ["go to the kitchen"], "robot_at(room_1)"),
    ("bring me the bottle", ["hm", "the red one"], "given(bottle_2, person_2)"),
    ("put the bottle on the table", ["the kitchen", "the red one"], "on(bottle_2, table_1)"),
    ("put the book", ["on the desk"], "on(book_1, desk_1)"),
    ("put the book", ["the office"], "in(book_1, room_4)"),
    ("blarg the fnord", ["bring me the apple"], "given(apple_1, person_2)"),
]


@pytest.mark.parametrize(("text", "answers", "expected"), ANSWERS)
@pytest.mark.anyio
async def test_answers_settle_what_was_asked(text, answers, expected):
    dialogue = Dialogue(answers=tuple(("Which one?", answer) for answer in answers))
    found = await PLANNER.interpret(text, FLAT, dialogue)
    assert " ".join(map(str, found.goals)) == expected


@pytest.mark.parametrize("answer", ["", "the striped one", "banana", "\x00", "x" * 20_000])
@pytest.mark.anyio
async def test_an_answer_that_settles_nothing_leaves_the_question_open(answer):
    dialogue = Dialogue(answers=(("Which one?", answer),))
    found = await PLANNER.interpret("bring me the bottle", FLAT, dialogue)
    assert (found.kind, found.candidates) == (Kind.CLARIFY, ("bottle_1", "bottle_2"))


@pytest.fixture
def anyio_backend():
    return "asyncio"
