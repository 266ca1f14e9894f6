"""Constructions of English that any word may fill, ten ways each, on the home of ``grammar_home``."""

from __future__ import annotations

import pytest

from grammar_home import home
from planner.language.grammar.parser import CommandGrammar
from planner.language.sentences.control import Control, control_word
from planner.plan import Dialogue, Kind
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from skills.registry import load_registry

SNAPSHOT = home().snapshot(robot_in="room_2", at=(4.2, 0.0))
PLANNER = TaskPlanner(CommandGrammar(), Verifier(load_registry([])))

GOING = [
    "toddle off to the kitchen", "trundle along to the kitchen", "scoot over into the kitchen",
    "off you pop to the kitchen",
    "to the kitchen with you, my metal friend", "haul your metal butt into the kitchen",
    "get yourself down to the kitchen",
    "report to the kitchen please", "check in at the kitchen", "you are needed in the kitchen",
    "now over to the kitchen with you",
    "hi there, make your way to the kitchen", "show up in the kitchen", "please to come in the kitchen",
    "be off to the kitchen",
]  # fmt: skip
GIVING = [
    "fetch me the key, love", "the key over here please", "give to me the silver key", "bring the key over",
    "hand over the key",
    "I could murder the key right now, bring it here", "Anna says bring me the key",
    "give me the key that is silver",
    "I have lost patience, bring me the key", "of the keys bring me the silver one",
    "uh the the key yeah the key bring it",
    "I would not say no to the key", "how about bringing me the key", "key silver one to me",
    "bring me the key will you",
]  # fmt: skip
PUTTING = [
    "into the box with the key", "back in the box with that key", "toss the key in the box",
    "put the key, I mean, put the key in the box",
    "put the key on the couch no in the box", "put the key on the couch... no wait, just in the box",
    "tuck the key in the box",
    "the pen, I mean the key, in the box please", "take the pen no the key to the box",
    "the key... put that in the box okay",
    "maybe the key could go in the box or something", "chuck the old key in the box",
    "the key is meant to be in the box",
    "put the key in the boxx", "thekey goes in the box",
]  # fmt: skip
NEGATED = [
    "put the books on the desk, bar the green one", "put the books on the desk but leave the green one where it is",
    "put the books on the desk, but not the green one", "put all the books on the desk except the green one",
    "put every book on the desk other than the green", "all the books but the green one go on the desk",
    "put the books on the desk, leaving out the green one", "the books, other than the green one, onto the desk",
    "put the books on the desk, minus the green one", "put the books that are not green on the desk",
]  # fmt: skip
TOO = [
    "put the key in the box, then the pen too", "put the key in the box, then the pen",
    "put the key in the box and then the pen as well", "put the key in the box, and also the pen",
    "bring the key to the box, then the pen too", "take the key to the box, then the pen as well",
    "move the key into the box, after that the pen",
]  # fmt: skip
CONTROLS = [
    ("on second thought, drop that job", Control.CANCEL), ("cancel what I asked", Control.CANCEL),
    ("never mind that task", Control.CANCEL),
    ("scrap the whole thing", Control.CANCEL), ("forget what I said", Control.CANCEL),
    ("abort your current mission", Control.CANCEL),
    ("I changed my mind", Control.CANCEL), ("don't bother", Control.CANCEL), ("call off the errand", Control.CANCEL),
    ("take a break", Control.PAUSE), ("hold your horses", Control.PAUSE), ("give me a second", Control.PAUSE),
    ("stand by", Control.PAUSE),
    ("stay exactly where you are, not another inch", Control.STOP), ("don't move a muscle", Control.STOP),
    ("not one step further", Control.STOP),
    ("stop dead", Control.STOP), ("hold still", Control.STOP), ("stay put", Control.STOP),
    ("whoa stop right there", Control.STOP),
    ("resume where you left off", Control.RESUME), ("carry on with what you were doing", Control.RESUME),
    ("as you were", Control.RESUME),
    ("get back to your work", Control.RESUME), ("continue with the task", Control.RESUME),
    ("drop the key on the desk", None), ("stop at the kitchen", None), ("leave it on the desk", None),
    ("take the break fast", None),
    ("return it", None), ("stay in the kitchen", None), ("forget the red cup, bring the blue one", None),
]  # fmt: skip


def heard(text):
    return PLANNER.read(text, SNAPSHOT, Dialogue()).interpretation


def goals_of(text):
    found = heard(text)
    assert found.kind is Kind.PLAN, found.reply
    return sorted(str(goal) for goal in found.goals)


@pytest.mark.parametrize("text", GOING)
def test_a_verb_of_motion_with_a_way_means_going_there(text):
    assert goals_of(text) == ["robot_at(room_1)"]


@pytest.mark.parametrize("text", GIVING)
def test_a_thing_and_the_speaker_mean_bringing(text):
    assert goals_of(text) == ["given(key_1, person_2)"]


@pytest.mark.parametrize("text", PUTTING)
def test_a_thing_and_a_way_mean_putting_it_there(text):
    assert goals_of(text) == ["in(key_1, box_1)"]


@pytest.mark.parametrize("text", NEGATED)
def test_what_is_left_out_is_left(text):
    assert goals_of(text) == ["on(book_2, desk_1)", "on(book_3, desk_1)"]


@pytest.mark.parametrize("text", TOO)
def test_what_has_neither_verb_nor_place_goes_where_the_one_before_goes(text):
    assert goals_of(text) == ["in(key_1, box_1)", "in(pen_1, box_1)"]


@pytest.mark.parametrize(
    ("text", "goals"),
    [
        ("put the key in the box, then grab the pen", ["holding(pen_1)", "in(key_1, box_1)"]),
        ("put the key in the box and bring me the pen", ["given(pen_1, person_2)", "in(key_1, box_1)"]),
        ("put the key in the box, then the pen on the desk", ["in(key_1, box_1)", "on(pen_1, desk_1)"]),
        ("bring me the key, then the pen", ["given(key_1, person_2)", "given(pen_1, person_2)"]),
    ],
)
def test_what_has_a_verb_or_a_place_of_its_own_goes_there(text, goals):
    assert goals_of(text) == goals


@pytest.mark.parametrize(
    "text",
    [
        "take the key in your hand",
        "get the key from the table in the kitchen in your hand",
        "pick up the key in your hand",
    ],
)
def test_taking_in_the_hand_is_picking_up(text):
    assert goals_of(text) == ["holding(key_1)"]


@pytest.mark.parametrize(
    ("text", "unknown"),
    [
        ("put the vase from the table in the kitchen on the desk in the office", "vase"),
        ("take the vase from the table in the kitchen in your hand", "vase"),
        ("put the apple from the desk in the office on the table in the kitchen", "apple"),
    ],
)
def test_what_is_not_known_is_the_thing_and_not_a_room_on_a_desk(text, unknown):
    found = heard(text)
    assert found.kind is Kind.REFUSE
    assert found.reply.startswith(f"I know of no {unknown} from the ")


@pytest.mark.parametrize(
    ("text", "goal"),
    [
        ("take the key to Ben... on second thought to Anna, Ben might lose it", "given(key_1, person_1)"),
        ("take the key to the office, wait, to the kitchen, I am there", "in(key_1, room_1)"),
        ("take the key to the office, I mean to the kitchen, Anna is there", "in(key_1, room_1)"),
        ("put the key on the desk, no, in the box, it is safer there", "in(key_1, box_1)"),
        ("I need a book. It mustn't be green.", "given(book_2, person_2)"),
        ("bring me a book, but it really can't be blue", "given(book_1, person_2)"),
    ],
)
def test_a_place_taken_back_and_a_color_ruled_out_afterwards_count_whatever_is_told_of_them(text, goal):
    assert goals_of(text) == [goal]


@pytest.mark.parametrize(("text", "control"), CONTROLS)
def test_controls_are_known_by_their_shape(text, control):
    assert control_word(text) is control


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("go to the kitchen and wait for me", "I stay in the kitchen"),
        ("go to the kitchen and stay put", "I stay in the kitchen"),
        ("wait in the kitchen", "I stay in the kitchen"),
        ("go to the kitchen, wait there, then go to the office", "I do not wait in between"),
    ],
)
def test_waiting_is_done_at_the_end_and_declined_in_between(text, said):
    found = heard(text)
    assert found.kind is Kind.PLAN
    assert said in found.reply


@pytest.mark.parametrize("text", ["go to the kitchen and wait until noon", "wait five minutes, then go to the kitchen"])
def test_waiting_for_a_time_is_not_left_out(text):
    assert heard(text).kind is not Kind.PLAN


def test_rooms_are_called_by_their_names():
    assert heard("which room are you in").reply == "I am in the hall."
    assert "room_" not in heard("list the rooms").reply


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("put the key left of the pen", "beside the black pen; I do not choose the side"),
        ("put the key between the pen and the bottle on the desk", "beside the black pen and the red bottle"),
        ("lay the key to the right of the pen", "I do not choose the side"),
        ("put the key in front of the pen", "I do not choose the side"),
    ],
)
def test_a_side_is_declined_and_the_thing_put_beside(text, said):
    found = heard(text)
    assert [str(goal) for goal in found.goals] == ["on(key_1, desk_1)"], found.reply
    assert said in found.reply


@pytest.mark.parametrize(
    "text", ["put the key behind the couch", "put the key under the desk", "put the key between the pen and the bowl"]
)
def test_a_side_where_nothing_can_be_put_is_refused(text):
    assert heard(text).kind is Kind.REFUSE


def test_a_sink_of_several_is_the_one_in_the_room_that_was_named():
    shelved = home().furniture("shelf_9", "shelf", "room_5", at=(7.0, 5.0)).snapshot(robot_in="room_2", at=(4.2, 0.0))
    said = "put the books on the bed on the shelf"
    found = PLANNER.read(said, shelved, Dialogue()).interpretation
    assert {goal.args[1] for goal in found.goals} == {"shelf_9"}, found.reply
    asked = PLANNER.read("put the key on the shelf", shelved, Dialogue()).interpretation
    assert asked.kind is Kind.CLARIFY


@pytest.mark.parametrize(
    "text", ["on the desk with the pen", "in the room with the bed", "nobody said bring me the key"]
)
def test_a_place_told_by_what_is_there_is_no_request(text):
    assert not [goal for goal in heard(text).goals if goal.object_id is not None]


@pytest.mark.parametrize("text", ["run a bath for me", "drive a car", "could you walk a dog"])
def test_a_verb_of_motion_with_a_thing_is_no_motion(text):
    found = heard(text)
    assert found.kind is Kind.REFUSE
    assert text.removeprefix("could you ").split()[0] in found.reply


@pytest.mark.parametrize(
    "text",
    [
        "empty the bed; all the things on it go to the desk",
        "clear the bed: everything on it goes to the desk",
        "clear the bed. the stuff on there goes to the desk",
    ],
)
def test_what_is_on_it_is_on_what_the_heading_names(text):
    assert goals_of(text) == ["on(book_2, desk_1)", "on(book_3, desk_1)"]


def test_a_definite_topic_is_one_thing():
    sketch = home().thing("medicine_1", "medicine", on="desk_1", color="white", at=(4.4, 5.6))
    snapshot = sketch.thing("medicine_2", "medicine", on="bed_1", color="blue").snapshot(robot_in="room_2", at=(4.2, 0))
    reading = PLANNER.read("my medicine, please, I have to take it", snapshot, Dialogue())
    assert reading.interpretation.kind is Kind.CLARIFY
    assert set(reading.interpretation.candidates) == {"medicine_1", "medicine_2"}


def test_a_thing_is_also_called_by_the_color_of_its_case():
    sketch = home().thing("tablet_1", "tablet", on="desk_1", color="blue", accents=("orange",), at=(4.4, 5.6))
    snapshot = sketch.thing("tablet_2", "tablet", on="bed_1", color="blue").snapshot(robot_in="room_2", at=(4.2, 0))
    reading = PLANNER.read("put the orange tablet on the bed", snapshot, Dialogue())
    assert [str(goal) for goal in reading.interpretation.goals] == ["on(tablet_1, bed_1)"]
    told = PLANNER.read("what color is the tablet on the desk?", snapshot, Dialogue())
    assert told.interpretation.reply == "The tablet on the desk in the office is blue, and partly orange."


def test_what_is_mainly_of_a_color_goes_before_what_has_it_too():
    sketch = home().thing("tablet_1", "tablet", on="desk_1", color="blue", accents=("orange",), at=(4.4, 5.6))
    snapshot = sketch.thing("tablet_2", "tablet", on="bed_1", color="orange").snapshot(robot_in="room_2", at=(4.2, 0))
    reading = PLANNER.read("put the orange tablet on the desk", snapshot, Dialogue())
    assert [str(goal) for goal in reading.interpretation.goals] == ["on(tablet_2, desk_1)"]
