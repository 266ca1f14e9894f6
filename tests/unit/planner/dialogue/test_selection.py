"""Answers to the question which one is meant."""

from __future__ import annotations

import pytest

from flat_reader import FLAT, PLANNER
from planner.plan import Dialogue, Kind

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
