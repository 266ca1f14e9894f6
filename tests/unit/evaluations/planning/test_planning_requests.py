"""Files of requests for the evaluation of planning: what is wrong with one is said by line and field."""

from __future__ import annotations

import json

import pytest

from app.errors import LineError
from evaluations.planning.buildings import NODES, building, building_document
from evaluations.planning.floor_plan import scene_document
from evaluations.planning.judging.expectation_reader import BadExpectation, read_expectation
from evaluations.planning.judging.expectations import (
    Answered,
    Asked,
    Condition,
    Controlled,
    Declined,
    EndState,
    Refused,
    Seek,
    Taught,
)
from evaluations.planning.request_file import OWN, load_requests, own_requests, read_requests

STUDIO = building("studio")


def complaint(text):
    with pytest.raises(LineError) as caught:
        read_requests(text, "mine")
    return str(caught.value)


def test_a_request_is_its_words_and_what_may_come_of_them():
    (request,) = read_requests("@studio\n== go\ngo away\n  > robot -> room_3\n  > ask\n", "mine")
    assert (request.name, request.category, request.building) == ("mine:3", "go", "studio")
    assert request.turns[0].text == "go away"
    assert [type(one) for one in request.turns[0].expected] == [EndState, Asked]


def test_a_dialogue_has_turns_each_with_its_own_expectation():
    (request,) = read_requests("@studio\n== talk\nbring the cup\n> ask\n& the red one\n> cup_1 -> hand\n", "mine")
    assert [turn.text for turn in request.turns] == ["bring the cup", "the red one"]


def test_what_would_begin_another_kind_of_line_is_quoted_with_a_backslash():
    (request,) = read_requests("@studio\n== odd\n\\> go\n> ask\n", "mine")
    assert request.turns[0].text == "> go"


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("go\n> ask", "mine, line 1, building"),
        ("@studio\ngo\n> ask", "mine, line 2, category"),
        ("@castle\n== a\ngo\n> ask", "line 1, building: no building 'castle': name one of studio"),
        ("@studio\n== a\n> ask", "line 3, expectation: comes before any request"),
        ("@studio\n== a\n& go\n> ask", "line 3, turn"),
        ("@studio\n== a\ngo\nstay\n> ask", "line 3, expectation: there is none for 'go'"),
        ("@studio\n== a\ngo\n> robot -> room_99", "line 4, room_99: is no node of the building"),
        ("@studio\n== a\ngo\n> cup_9 -> table_1", "line 4, cup_9: is no node of the building"),
        ("@studio\n== a\ngo\n> 3 of cup_1 cup_2 -> table_1", "line 4, 3 of cup_1 cup_2: there are 2 of them"),
        ("@studio\n== a\ngo\n> maybe", "line 4, maybe: is none of answer, ask"),
        ("@studio\n== a\ngo\n> decline", "line 4, decline"),
        ("@studio\n== a\ngo\n> control jump", "line 4, control"),
        ("@studio\n== a\ngo\n> gold.cup@*-> hand", "line 4, gold.cup@*: there is no such thing"),
    ],
)
def test_what_is_wrong_is_said_by_line_and_field(text, said):
    assert said in complaint(text)


@pytest.mark.parametrize(
    ("text", "meant"),
    [
        ("ask cup_1 cup_2", Asked(candidates=frozenset({"cup_1", "cup_2"}))),
        ("answer two|2, !garage", Answered(words=(("two", "2"),), never=("garage",))),
        ("refuse closed", Refused(words=(("closed",),))),
        ("decline pour*", Declined(words=(("pour*",),))),
        ("control stop", Controlled(word="stop")),
        ("taught room_1 the study", Taught(node_id="room_1", name="the study")),
        ("seek key_1", Seek(object_id="key_1")),
    ],
)
def test_each_kind_of_expectation_is_one_line(text, meant):
    assert read_expectation(text, STUDIO) == meant


def test_an_end_state_has_stages_in_order_and_things_that_may_be_put_aside():
    end = read_expectation("robot -> room_3 then 1 of cup_1 cup_2 -> shelf_1|table_1; aside book_1", STUDIO)
    there = Condition(subjects=("robot",), count=1, places=("room_3",))
    put = Condition(subjects=("cup_1", "cup_2"), count=1, places=("shelf_1", "table_1"))
    assert end == EndState(stages=((there,), (put,)), aside=("book_1",))


def test_a_set_is_named_by_label_color_and_place():
    (condition,) = read_expectation("cup@table_1 -> shelf_1", STUDIO).stages[0]
    assert condition.subjects == ("cup_1", "cup_2")
    (condition,) = read_expectation("red.cup@room_2 -> shelf_1", STUDIO).stages[0]
    assert condition.subjects == ("cup_1",)


def test_what_has_no_subject_is_no_end_state():
    with pytest.raises(BadExpectation, match="end state"):
        read_expectation("-> table_1", STUDIO)


def test_a_building_of_ones_own_lies_beside_the_requests(tmp_path):
    (tmp_path / "flat.json").write_text(json.dumps(building_document("studio")), encoding="utf-8")
    (tmp_path / "mine.txt").write_text("@flat.json\n== go\ngo\n> robot -> room_3\n", encoding="utf-8")
    (request,) = load_requests(tmp_path / "mine.txt")
    assert (request.half, request.building) == ("mine", "flat.json")


@pytest.mark.parametrize("name", [name for name in NODES if name != "hospital"])
def test_a_building_is_as_large_as_it_says_and_the_same_each_time(name):
    document = building_document(name)
    assert document == building_document(name)
    assert 0.8 * NODES[name] <= len(document["nodes"]) <= 1.35 * NODES[name]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("room room_1 hall", "line 1, room_1: a corridor comes before"),
        ("  table_1 red", "line 1, table_1: stands in no room"),
        ("corridor room_1 hall\n  gizmo_1 red", "line 2, gizmo_1: no kind of thing 'gizmo'"),
        ("corridor room_1 hall\nroom room_1 den", "line 2, room_1: is there already"),
        ("corridor room_1 hall\n  bowl_1 red on table_1", "line 2, table_1: comes after what stands on it"),
        ("corridor room_1 hall\nroom room_2 den beyond room_9", "line 2, beyond: there is no room room_9"),
    ],
)
def test_what_is_wrong_with_a_floor_plan_is_said_by_line_and_field(text, said):
    with pytest.raises(LineError) as caught:
        scene_document(text)
    assert said in str(caught.value)


@pytest.mark.slow
def test_our_own_requests_load_so_that_every_node_they_expect_is_in_its_building():
    developed, held_out = (own_requests(half) for half in OWN)
    for half in (developed, held_out):
        assert len(half) >= 240
        assert len({request.category for request in half}) >= 16
        assert len({request.building for request in half}) >= 6
    said = [
        {tuple(turn.text.casefold() for turn in request.turns) for request in half} for half in (developed, held_out)
    ]
    assert not said[0] & said[1]
