"""The command line from outside: bad input gets a sentence and exit code 2, never a stack trace."""

from __future__ import annotations

import json
import os

import pytest

from paths import DATA
from service_process import majordomo, serving, wait_until

GRAPH = DATA / "flat_graph.json"
NETWORKS = DATA / "network"

ROOM = {"id": "a", "label": "kitchen", "polygon": [[0, 0], [4, 0], [4, 3], [0, 3]]}
DOOR = {"id": "d", "rooms": ["a", "outside"], "center": [4.1, 1.5], "width": 0.9}
HOUSE = {"rooms": [ROOM], "doors": [DOOR], "robot": {"pose": [1, 1, 0]}}


@pytest.fixture(scope="module")
def graph_service(tmp_path_factory):
    """Data folder of a service over a stored graph."""
    folder = tmp_path_factory.mktemp("service")
    with serving(folder, "--graph", str(GRAPH)):
        yield folder


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
        ("serve", "--llm", "anthropic:without-a-key"),
        ("serve", "--model", str(NETWORKS / "gray.onnx")),
        ("serve", "--model", "nowhere.onnx"),
        ("serve", "--robot", "nobodys:robot"),
        ("serve", "--robot", "rosbridge:nowhere.toml"),
        ("serve", "--robot", "rosbridge:nowhere.toml", "--clock", "lockstep"),
        ("serve", "--house", ""),
        ("serve", "--host", ""),
        ("serve", "--host", b"\xff"),
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


@pytest.mark.parametrize(
    ("request_text", "said"),
    [
        ("", "The request is empty. Please say in plain words what you want.\n"),
        (" \n", "The request is empty. Please say in plain words what you want.\n"),
        (b"bring \xff\xfe cup", "I cannot read this as text (UTF-8). Please type it again.\n"),
    ],
)
def test_a_request_that_says_nothing_ends_with_a_sentence_and_exit_code_2(graph_service, request_text, said):
    outcome = majordomo("ask", request_text, "--data", str(graph_service))
    assert (outcome.returncode, outcome.stdout, outcome.stderr) == (2, "", said)


def test_an_answer_from_a_pipe_that_is_no_text_is_refused_and_the_task_waits(graph_service, tmp_path):
    (tmp_path / "answer").write_bytes(b"\xff\xfe\n")
    with (tmp_path / "answer").open() as answer:
        outcome = majordomo("ask", "bring the cup to the bench", "--data", str(graph_service), stdin=answer)
    assert outcome.returncode == 3
    assert "I cannot read this as text" in outcome.stdout
    assert "the task waits" in outcome.stdout


def test_a_request_is_asked_and_its_trace_told_with_nothing_but_the_address_and_the_folder(graph_service):
    url = json.loads((graph_service / "service.json").read_text())["address"]
    asked = majordomo("ask", "where is the red apple?", "--url", url, "--data", str(graph_service), "--json")
    assert asked.returncode == 0, asked.stderr
    task = json.loads(asked.stdout)
    told = majordomo("trace", task["id"], "--data", str(graph_service), env=os.environ | {"COLUMNS": "160"})
    assert told.returncode == 0, told.stderr
    assert [kind in told.stdout for kind in ("received", "understood", "ended")] == [True] * 3
    entries = json.loads(majordomo("trace", task["id"], "--data", str(graph_service), "--json").stdout)["entries"]
    assert (entries[0]["what"], entries[-1]["data"]["status"]) == ("where is the red apple?", "succeeded")
    missing = majordomo("trace", "99", "--data", str(graph_service))
    assert (missing.returncode, "task_99" in missing.stderr) == (2, True)


def test_the_doctor_finds_this_machine_healthy(tmp_path):
    outcome = majordomo("doctor", "--port", "0", "--data", str(tmp_path), "--json")
    assert outcome.returncode == 0, outcome.stdout
    assert json.loads(outcome.stdout)["healthy"]


def test_the_doctor_says_what_a_network_file_holds_and_what_is_wrong_with_another():
    good = majordomo("doctor", "--port", "0", "--model", str(NETWORKS / "colors.onnx"))
    assert good.returncode == 0, good.stdout
    assert "3 classes, 2 predicates" in " ".join(good.stdout.split())
    bad = majordomo("doctor", env=os.environ | {"MAJORDOMO_MODEL": str(NETWORKS / "without_boxes.onnx")})
    assert bad.returncode == 1
    assert "'sub_boxes', 'obj_boxes' are missing" in " ".join(bad.stdout.split())


def test_a_service_sees_through_the_network_file_it_is_given(tmp_path):
    with serving(tmp_path, "--model", str(NETWORKS / "colors.onnx"), "--no-explore", "--forget") as service:
        wait_until(lambda: service.client.get("/v1/status").json()["camera"], 60.0)
        assert service.client.get("/v1/camera.jpg").status_code == 200
        assert service.client.get("/v1/status").json()["perception"] is None
