"""The whole Task Planner against each provider's kind of server over real HTTP on loopback, sound and broken."""

from __future__ import annotations

import json
import socket
import time
from contextlib import asynccontextmanager

import httpx
import pytest

from model_server import Line, ModelServer, OpenAI
from planner.doubles.sketch import flat
from planner.language.grammar.parser import CommandGrammar
from planner.models.breaker import BreakerSettings, CircuitBreaker
from planner.models.client import HttpModel
from planner.models.spec import PROVIDERS
from planner.plan import Dialogue, Kind, Plan, Source
from planner.skill_planner.verifier import Verifier
from planner.task_planner.settings import TaskPlannerSettings
from planner.task_planner.task_planner import TaskPlanner
from skills.registry import load_registry

pytestmark = pytest.mark.anyio

VERIFIER = Verifier(load_registry([]))
SNAPSHOT = flat().snapshot(robot_in="room_2", at=(4.2, 0.0))
VAGUE = "my desk looks so empty without that red thing one drinks tea from"
GOOD = {"kind": "plan", "goals": [{"predicate": "on", "args": ["cup_1", "desk_1"]}], "question": "", "reply": ""}
BAD = {"kind": "plan", "goals": [{"predicate": "on", "args": ["cup_77", "desk_1"]}], "question": "", "reply": ""}


def said(dialect, content):
    return Line(body=dialect.text(content if isinstance(content, str) else json.dumps(content)))


async def nap(seconds):
    del seconds


@asynccontextmanager
async def planning(dialect, url, *, deadline_s=20.0, failures=3, context_tokens=32_768, journal=None):
    async with httpx.AsyncClient(verify=False) as http:  # reading certificates takes longer than a test
        model = HttpModel(
            PROVIDERS[dialect.provider].wire("m", context_tokens),
            base_url=f"{url}/v1",
            http=http,
            key="k3y",
            context_tokens=context_tokens,
            sleep=nap,
        )
        breaker = CircuitBreaker(model, place="the cellar", settings=BreakerSettings(failures=failures))
        entries = [] if journal is None else journal
        yield TaskPlanner(
            CommandGrammar(),
            VERIFIER,
            breaker,
            settings=TaskPlannerSettings(deadline_s=deadline_s),
            journal=entries.append,
        )


async def interpret(dialect, *lines, **settings):
    async with ModelServer(*lines).running() as server, planning(dialect, server.url, **settings) as planner:
        return await planner.interpret(VAGUE, SNAPSHOT, Dialogue()), server


def assert_planned(found):
    assert (found.kind, found.source) == (Kind.PLAN, Source.MODEL)
    assert [str(goal) for goal in found.goals] == ["on(cup_1, desk_1)"]
    assert isinstance(VERIFIER.plan_for(found.goals, SNAPSHOT), Plan)


def assert_asked(found, part):
    assert (found.kind, found.goals) == (Kind.CLARIFY, ())
    assert "I do not understand" in found.reply
    assert part in found.reply
    assert not any(word in found.reply for word in ("Traceback", "secret", "k3y"))


async def test_a_sound_answer_becomes_goals(dialect):
    journal = []
    found, server = await interpret(dialect, said(dialect, GOOD), journal=journal)
    assert_planned(found)
    enum = dialect.schema(server.requests[0])["properties"]["goals"]["items"]["properties"]["args"]["items"]["enum"]
    assert "cup_1" in enum
    assert len(enum) <= 250
    assert [entry["event"] for entry in journal] == ["model_prompt", "model_answer"]
    assert json.loads(journal[1]["text"]) == GOOD
    assert "k3y" not in json.dumps(journal)


@pytest.mark.parametrize(
    "first",
    [
        lambda dialect: said(dialect, "Certainly! I would put the cup on the desk."),
        lambda dialect: said(dialect, '{"kind": "plan", "goals": ['),
        lambda dialect: Line(body=dialect.cut_off(json.dumps(GOOD)[:40])),
        lambda dialect: said(dialect, BAD),
        lambda dialect: said(dialect, {"kind": "plan"}),
        lambda dialect: said(dialect, {"kind": 7, "goals": "none"}),
        lambda dialect: Line(body={"unexpected": True}),
        lambda dialect: Line(body="<html>"),
    ],
    ids=["prose", "truncated", "length", "unknown identifier", "no goals", "wrong types", "no completion", "html"],
)
async def test_a_bad_answer_is_corrected_in_another_round(dialect, first):
    found, server = await interpret(dialect, first(dialect), said(dialect, GOOD))
    assert_planned(found)
    assert "Your answer cannot be used" in server.requests[1]["messages"][-1]["content"]


@pytest.mark.parametrize(
    ("line", "part", "count"),
    [
        (Line(body="Traceback: secret", status=500), "status 500", 3),
        (Line(status=429), "no more requests", 3),
        (Line(status=429, headers={"Retry-After": "900"}), "alone for 900 s; I use my own grammar until", 1),
        (Line(status=401), "status 401", 1),
        (Line(status=404), "status 404", 1),
        (Line(body=OpenAI().refusal()), "declined", 3),
        (Line(body=OpenAI.text("x", stop="content_filter")), "declined", 3),
        (said(OpenAI, "prose for ever"), "5 rounds", 5),
        (said(OpenAI, BAD), "cup_77", 5),
    ],
)
async def test_a_lasting_failure_falls_back_to_the_grammar_and_says_so(line, part, count):
    found, server = await interpret(OpenAI(), line)
    assert_asked(found, part)
    assert len(server.requests) == count


async def test_a_dead_endpoint_is_said_in_words(dialect):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
    async with planning(dialect, f"http://127.0.0.1:{port}") as planner:
        assert_asked(await planner.interpret(VAGUE, SNAPSHOT, Dialogue()), "cannot be reached")


async def test_one_deadline_ends_a_slow_server():
    started_s = time.perf_counter()
    found, _ = await interpret(OpenAI(), Line(body=OpenAI.text("x"), pause_s=0.1), deadline_s=0.5)
    assert_asked(found, "within")
    assert time.perf_counter() - started_s < 10


async def test_a_scene_beyond_the_context_is_not_sent(dialect):
    found, server = await interpret(dialect, said(dialect, GOOD), context_tokens=1024)
    assert_asked(found, "cannot take this request")
    assert server.requests == []


async def test_a_server_out_of_order_is_left_alone_and_each_reply_says_until_when(dialect):
    server = ModelServer(Line(status=500))
    async with server.running(), planning(dialect, server.url, failures=2) as planner:
        replies = [(await planner.interpret(VAGUE, SNAPSHOT, Dialogue())) for _ in range(4)]
        understood = await planner.interpret("bring me the apple", SNAPSHOT, Dialogue())
    assert len(server.requests) == 6
    assert "until" not in replies[0].reply
    assert_asked(replies[1], "status 500; I use my own grammar until")
    for reply in replies[2:]:
        assert_asked(reply, "(The language model at the cellar does not answer; I use my own grammar until")
    assert (understood.kind, understood.source) == (Kind.PLAN, Source.GRAMMAR)
    assert "language model" not in understood.reply
