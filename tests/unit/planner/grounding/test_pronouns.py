"""Me, it, here, and the same noun once more: what was said before."""

from __future__ import annotations

from flat_reader import goals, in_hall, read
from planner.doubles.sketch import Sketch, flat
from planner.plan import Kind


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


def test_mentioned_lists_the_newest_first():
    assert read("pick up the apple and go to the office").mentioned[0] == "room_4"
    assert "apple_1" in read("where is the apple").mentioned
