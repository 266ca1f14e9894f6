"""The command line from outside: bad input gets a sentence and exit code 2, never a stack trace."""

from __future__ import annotations

import json

import pytest

from service_process import majordomo

ROOM = {"id": "a", "label": "kitchen", "polygon": [[0, 0], [4, 0], [4, 3], [0, 3]]}
DOOR = {"id": "d", "rooms": ["a", "outside"], "center": [4.1, 1.5], "width": 0.9}
HOUSE = {"rooms": [ROOM], "doors": [DOOR], "robot": {"pose": [1, 1, 0]}}


def house_with(**changes):
    return json.dumps(HOUSE | changes)


@pytest.mark.parametrize(
    ("text", "named"),
    [
        (house_with(doors=[DOOR | {"center": [9.0, 9.0]}]), "doors[0].center"),
        (house_with(rooms=[ROOM | {"colour": "red"}]), "rooms[0].colour"),
        (house_with(wall_height=-2.5), "wall_height"),
        (house_with()[:-5], "line 1"),
    ],
)
def test_a_faulty_house_is_refused_with_the_field_that_is_wrong(tmp_path, text, named):
    path = tmp_path / "house.json"
    path.write_text(text)
    outcome = majordomo("serve", "--house", str(path), "--port", "0", "--data", str(tmp_path))
    assert outcome.returncode == 2
    assert named in outcome.stderr
    assert "Traceback" not in outcome.stderr
    assert outcome.stdout == ""


@pytest.mark.parametrize(
    "arguments",
    [
        ("serve", "--house", "castle"),
        ("serve", "--speed", "max"),
        ("serve", "--llm", "nonsense"),
        ("ask", "where is the cup?"),
    ],
)
def test_what_cannot_be_done_is_said_in_a_sentence(tmp_path, arguments):
    outcome = majordomo(*arguments, "--data", str(tmp_path))
    assert outcome.returncode == 2
    assert outcome.stderr.strip()
    assert "Traceback" not in outcome.stderr


def test_asking_where_no_service_is_names_the_folder_and_the_option_that_chooses_it(tmp_path):
    folder = tmp_path / "a folder whose name is longer than a line of eighty characters in a terminal is"
    outcome = majordomo("ask", "where is the cup?", "--data", str(folder))
    assert outcome.returncode == 2
    assert f"{folder}:" in outcome.stderr
    assert "--data" in outcome.stderr


def test_the_doctor_finds_this_machine_healthy():
    outcome = majordomo("doctor")
    assert outcome.returncode == 0, outcome.stdout
