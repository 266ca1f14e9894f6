"""Answers carry their age, and counting, listing and existence agree with the graph."""

from __future__ import annotations

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from grammar_home import home
from planner.answers.whereabouts import age_phrase
from planner.dialogue.interpreter import Interpreter
from planner.doubles.sketch import Sketch, flat
from planner.grounding.phrasing import article
from planner.language.grammar.parser import CommandGrammar
from planner.naming import name_of
from planner.plan import Dialogue, Kind, QueryKind
from planner.skill_planner.verifier import Verifier
from scene_graph.nodes import UNKNOWN_LABEL, DoorState, ObjectState
from skills.registry import load_registry

EVERY_QUESTION = [
    "where is the cup",
    "how many cups are there",
    "what do you see",
    "which room are you in",
    "where am i",
    "what is in this room",
    "is there a cup",
    "what rooms do you know",
    "list everything",
    "who is here",
]
INTERPRETER = Interpreter(CommandGrammar(), Verifier(load_registry([])))


def ask(text, snapshot):
    return INTERPRETER.read(text, snapshot, Dialogue()).interpretation


@pytest.mark.parametrize(
    ("seconds", "words"),
    [
        (0, "just now"),
        (20, "20 seconds ago"),
        (60, "1 minute ago"),
        (185, "3 minutes ago"),
        (7200, "2 hours ago"),
        (90000, "1 day ago"),
        (400000, "5 days ago"),
    ],
)
def test_an_age_is_said_in_its_own_unit(seconds, words):
    assert age_phrase(seconds) == words


def test_what_has_no_name_is_called_a_thing_of_its_color():
    sketch = Sketch().room("room_1", "hall", at=(0.0, 0.0)).furniture("table_1", "table", "room_1", at=(0.0, 1.0))
    sketch.thing("unknown_1", UNKNOWN_LABEL, on="table_1", color="yellow").thing(
        "unknown_2", UNKNOWN_LABEL, on="table_1"
    )
    snapshot = sketch.snapshot(robot_in="room_1", at=(0.0, 0.0))
    assert ask("what is on the table?", snapshot).reply == "I have seen a yellow thing and a thing there."
    assert name_of("unknown_1", snapshot) == "the yellow thing"


def test_an_answer_says_how_old_it_is():
    snapshot = flat().snapshot(robot_in="room_2", at=(4.2, 0.0), stamp_s=290.0)
    assert ask("where is the apple", snapshot).reply == (
        "The red apple is on the counter in the kitchen; I saw it 3 minutes ago."
    )


def test_what_was_seen_now_is_in_sight():
    snapshot = flat().thing("key_1", "key", on="desk_1", last_seen_s=99.0).snapshot(robot_in="room_4", at=(4.2, 4.2))
    found = ask("what do you see", snapshot)
    assert found.reply == "I see a key."
    assert found.query is not None
    assert (found.query.kind, found.query.nodes) == (QueryKind.SEEN, ("key_1",))


def test_an_empty_graph_answers_as_well():
    snapshot = Sketch().room("room_1", at=(0.0, 0.0)).snapshot(robot_in="room_1", at=(0.0, 0.0))
    for text in EVERY_QUESTION:
        found = ask(text, snapshot)
        assert found.kind in (Kind.ANSWER, Kind.REFUSE), text
        assert found.reply


@settings(max_examples=40)
@given(st.lists(st.tuples(st.sampled_from(["cup", "jar"]), st.sampled_from([1, 2])), max_size=8))
def test_counting_agrees_with_counting(things):
    sketch = Sketch().room("room_1", "kitchen", at=(0.0, 0.0)).room("room_2", "hall", at=(4.2, 0.0))
    sketch.furniture("table_1", "table", "room_1", at=(0.0, 1.0)).furniture("desk_2", "desk", "room_2", at=(4.2, 1.0))
    for number, (label, room) in enumerate(things):
        sketch.thing(f"{label}_{number}", label, on="table_1" if room == 1 else "desk_2")
    snapshot = sketch.snapshot(robot_in="room_1", at=(0.0, 0.0))
    for text, count in (
        ("how many cups are there", sum(label == "cup" for label, _ in things)),
        ("how many jars are in the hall", sum(thing == ("jar", 2) for thing in things)),
        ("how many cups are on the table", sum(thing == ("cup", 1) for thing in things)),
    ):
        found = ask(text, snapshot)
        assert found.query is not None
        assert len(found.query.nodes) == count
        assert found.reply.startswith(f"I know of {count or 'no'} ")


@pytest.mark.parametrize("word", ["open", "closed"])
def test_a_door_that_was_not_seen_lately_is_not_said_to_be_open_or_closed(word):
    snapshot = (
        home()
        .door("room_5", "room_6", at=(4.0, 5.0), state=DoorState.UNKNOWN)
        .snapshot(robot_in="room_2", at=(4.2, 0.0))
    )
    assert ask(f"is the door between the bedroom and the bathroom {word}?", snapshot).reply.startswith("I do not know")


def test_what_is_missing_is_listed_and_not_said_to_be_there():
    snapshot = (
        home().thing("toy_1", "toy", on="bed_1", state=ObjectState.MISSING).snapshot(robot_in="room_2", at=(4.2, 0.0))
    )
    assert "toy" in ask("what is missing?", snapshot).reply
    assert ask("is the toy on the bed?", snapshot).reply.startswith("No. The toy")


def test_a_pair_of_things_takes_the_plural():
    snapshot = home().thing("scissors_1", "scissors", on="desk_1").snapshot(robot_in="room_2", at=(4.2, 0.0))
    assert "scissors are on the desk" in ask("where are the scissors?", snapshot).reply


def test_running_out_is_asked_the_other_way_round():
    snapshot = home().snapshot(robot_in="room_2", at=(4.2, 0.0))
    assert ask("are we out of apples?", snapshot).reply.startswith("No.")
    assert ask("are we out of bananas?", snapshot).reply.startswith("Yes.")


@pytest.mark.parametrize(
    ("thing", "told"),
    [
        ("red scissors on the brown bench in the hall", "red scissors on the brown bench in the hall"),
        ("keys", "keys"),
        ("orange cup in my gripper", "an orange cup in my gripper"),
        ("box with the glasses", "a box with the glasses"),
        ("Anna", "Anna"),
    ],
)
def test_what_comes_in_pairs_has_no_article(thing, told):
    assert article(thing) == told


@pytest.mark.parametrize(("count", "words"), [(0, "0 objects."), (1, "1 object."), (2, "2 objects.")])
def test_what_is_known_is_counted_where_nothing_is_in_view(count, words):
    sketch = Sketch().room("room_1", "kitchen", at=(0.0, 0.0))
    for k in range(count):
        sketch.furniture(f"table_{k + 1}", "table", "room_1", at=(k - 1.0, 1.2))
    snapshot = sketch.snapshot(robot_in="room_1", at=(0.0, -1.0), stamp_s=1000.0)
    assert ask("what do you see", snapshot).reply.endswith(words)
