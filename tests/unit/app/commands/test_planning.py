"""``majordomo plan`` on graphs written by hand: what is left out is filled in, what is wrong is named."""

from __future__ import annotations

import json

import pytest

from app.commands.plan import document, plan_on, told, write_problem
from app.exchange.stored_graph import load_graph
from scene_graph.documents.interchange import from_json
from scene_graph.errors import SceneFormatError

NODES = [
    {"id": "kitchen", "type": "room", "label": "kitchen"},
    {"id": "office", "type": "room", "label": "office"},
    {"id": "door_1", "type": "door", "rooms": ["kitchen", "office"]},
    {"id": "table_1", "type": "object", "room": "kitchen"},
    {"id": "desk_1", "type": "object", "room": "office"},
    {"id": "cup_1", "type": "object"},
]
ON = {"source": "cup_1", "target": "table_1", "type": "on"}


def graph(*, edges=(ON,), **changed):
    """The smallest graph with a plan in it; ``changed`` are fields of nodes by identifier."""
    nodes = [node | changed.get(node["id"], {}) for node in NODES]
    return {"nodes": nodes, "edges": list(edges)}


def test_the_smallest_graph_by_hand_is_enough_for_a_plan():
    snapshot = from_json(graph())
    outcome = plan_on(snapshot, "bring the cup to the desk")
    assert [str(step) for step in outcome.plan.steps] == [
        "GOTO(cup_1)",
        "PICK(cup_1)",
        "GOTO(desk_1)",
        "PLACE(cup_1, desk_1)",
    ]
    assert "pick up the cup" in told(outcome, snapshot)
    plan = document(outcome, "bring the cup to the desk")["plan"]
    assert plan["goals"] == [{"predicate": "on", "args": ["cup_1", "desk_1"]}]
    assert plan["expected_s"] > 60


def test_a_closed_door_is_the_reason():
    snapshot = from_json(graph(door_1={"state": "closed"}))
    outcome = plan_on(snapshot, "bring the cup to the desk")
    assert not outcome.succeeded
    assert "is closed" in told(outcome, snapshot)
    assert document(outcome, "")["kind"] == "refuse"


def test_a_question_is_answered():
    outcome = plan_on(from_json(graph()), "where is the cup?")
    assert outcome.succeeded
    assert "table" in told(outcome, from_json(graph()))


@pytest.mark.parametrize(
    ("broken", "named"),
    [
        ({"nodes": "none"}, "nodes"),
        ({}, "nodes"),
        (graph(cup_1={"type": "mug"}), "nodes[5].type"),
        (graph(cup_1={"position_m": ["a", 0, 0]}), "nodes[5].position_m[0]"),
        (graph(cup_1={"size_m": [-1, 0.1, 0.1]}), "nodes[5].size_m[0]"),
        (graph(cup_1={"id": "table_1"}), "nodes[5].id"),
        (graph(cup_1={"room": "attic"}), "nodes[5].room"),
        (graph(door_1={"rooms": ["kitchen", "attic"]}), "nodes[2].rooms"),
        (graph(door_1={"rooms": []}), "nodes[2].rooms"),
        (graph(edges=[ON | {"target": "table_9"}]), "edges[0].target"),
        (graph(edges=[ON | {"type": "upon"}]), "edges[0].type"),
        (graph(edges=[{"source": "cup_1", "type": "on"}]), "edges[0].target"),
        (graph(edges=[ON, {"source": "cup_1", "target": "cup_1", "type": "on"}]), "edges[1]"),
    ],
)
def test_what_is_wrong_is_named(broken, named):
    with pytest.raises(SceneFormatError) as error:
        from_json(broken)
    assert str(error.value).startswith(named)


@pytest.mark.parametrize(
    ("content", "named"),
    [
        (b"{", "line 1"),
        (b"\xff\xfe", "UTF-8"),
        (b"[]", "object with nodes and edges"),
        (b"[" * 200_000, "nested too deeply"),
        (None, "folder"),
    ],
)
def test_what_is_no_graph_is_refused_with_a_sentence(tmp_path, content, named):
    path = tmp_path / "graph.json"
    if content is None:
        path.mkdir()
    else:
        path.write_bytes(content)
    with pytest.raises(SceneFormatError, match=named):
        load_graph(path)


def test_the_problem_is_written_with_its_domain_beside(tmp_path):
    outcome = plan_on(from_json(graph()), "bring the cup to the desk")
    domain = write_problem(outcome.problem, tmp_path / "cup.pddl")
    assert domain.name == "cup-domain.pddl"
    assert domain.read_text().startswith("(define (domain majordomo)")
    assert "(upon cup_1 table_1)" in (tmp_path / "cup.pddl").read_text()
    assert json.loads(json.dumps(document(outcome, "x")))["request"] == "x"
