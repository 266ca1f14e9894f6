"""The whole Task Planner against a language model server over real HTTP on loopback, sound and broken."""

from __future__ import annotations

import asyncio
import json
import socket
import time
from collections.abc import AsyncIterator, Awaitable, Callable
from contextlib import asynccontextmanager

import httpx
import pytest
import uvicorn
from starlette.applications import Starlette
from starlette.requests import Request
from starlette.responses import JSONResponse, Response, StreamingResponse
from starlette.routing import Route

from majordomo.planner.grammar.parser import CommandGrammar
from majordomo.planner.models.openai import OpenAIModel, RetrySettings
from majordomo.planner.models.protocol import FailureKind, Message, ModelFailure, ModelReply, ModelRequest, Role
from majordomo.planner.plan import Dialogue, Kind, Plan, Source
from majordomo.planner.sketch import flat
from majordomo.planner.task_planner import TaskPlanner
from majordomo.planner.verifier import Verifier
from majordomo.skills.registry import load_registry

VERIFIER = Verifier(load_registry([]))
SNAPSHOT = flat().snapshot(robot_in="room_2", at=(4.2, 0.0))
VAGUE = "my desk looks so empty without that red thing one drinks tea from"
GOOD = {"kind": "plan", "goals": [{"predicate": "on", "args": ["cup_1", "desk_1"]}], "question": "", "reply": ""}
BAD = {"kind": "plan", "goals": [{"predicate": "on", "args": ["cup_77", "desk_1"]}], "question": "", "reply": ""}
Answer = Callable[[dict], Awaitable[Response]]


@pytest.fixture
def anyio_backend():
    return "asyncio"


def completion(content, finish="stop", **message):
    text = content if isinstance(content, str) else json.dumps(content)
    choice = {"message": {"role": "assistant", "content": text, **message}, "finish_reason": finish}
    return JSONResponse({"choices": [choice], "usage": {"prompt_tokens": 10, "completion_tokens": 5}})


class Endpoint:
    """A chat completion server that gives its answers in turn, the last one for ever, and keeps what it was asked."""

    def __init__(self, *answers) -> None:
        self.answers, self.requests, self.headers = list(answers), [], []

    async def complete(self, request: Request) -> Response:
        self.requests.append(await request.json())
        self.headers.append(dict(request.headers))
        answer = self.answers.pop(0) if len(self.answers) > 1 else self.answers[0]
        return await answer(self.requests[-1]) if callable(answer) and not isinstance(answer, Response) else answer


@asynccontextmanager
async def serving(endpoint: Endpoint) -> AsyncIterator[str]:
    app = Starlette(routes=[Route("/v1/chat/completions", endpoint.complete, methods=["POST"])])
    server = uvicorn.Server(uvicorn.Config(app, log_level="critical", lifespan="off", timeout_graceful_shutdown=1))
    listener = socket.create_server(("127.0.0.1", 0))
    task = asyncio.create_task(server.serve(sockets=[listener]))
    while not server.started:  # noqa: ASYNC110 -- uvicorn has no event for it
        await asyncio.sleep(0)
    try:
        yield f"http://127.0.0.1:{listener.getsockname()[1]}/v1"
    finally:
        server.should_exit = server.force_exit = True
        await task
        listener.close()


class Naps:
    """A sleep that does not: it notes how long it was asked to wait."""

    def __init__(self) -> None:
        self.seconds: list[float] = []

    async def __call__(self, seconds: float) -> None:
        self.seconds.append(seconds)


@asynccontextmanager
async def planning(base_url, *, deadline_s=20.0, naps=None):
    async with httpx.AsyncClient() as http:
        model = OpenAIModel("m", base_url=base_url, http=http, key="k", sleep=naps or Naps(), retry=RetrySettings())
        yield TaskPlanner(CommandGrammar(), VERIFIER, model, deadline_s=deadline_s), model


async def interpret(*answers, deadline_s=20.0):
    endpoint = Endpoint(*answers)
    async with serving(endpoint) as url, planning(url, deadline_s=deadline_s) as (planner, _):
        return await planner.interpret(VAGUE, SNAPSHOT, Dialogue()), endpoint


def assert_planned(found):
    assert (found.kind, found.source, [str(goal) for goal in found.goals]) == (
        Kind.PLAN,
        Source.MODEL,
        ["on(cup_1, desk_1)"],
    )
    assert isinstance(VERIFIER.plan_for(found.goals, SNAPSHOT), Plan)


def assert_asked(found, part):
    assert (found.kind, found.goals) == (Kind.CLARIFY, ())
    assert "I do not understand" in found.reply
    assert part in found.reply
    assert "Traceback" not in found.reply


@pytest.mark.anyio
async def test_a_sound_answer_becomes_goals_and_the_key_travels_as_bearer():
    found, endpoint = await interpret(completion(GOOD))
    assert_planned(found)
    assert endpoint.headers[0]["authorization"] == "Bearer k"
    named = endpoint.requests[0]["response_format"]["json_schema"]["schema"]
    enum = named["properties"]["goals"]["items"]["properties"]["args"]["items"]["enum"]
    assert "cup_1" in enum
    assert len(enum) <= 250


@pytest.mark.parametrize(
    "first",
    [
        completion("Certainly! I would put the cup on the desk."),
        completion('{"kind": "plan", "goals": ['),
        completion(json.dumps(GOOD)[:40], finish="length"),
        completion(BAD),
        completion({"kind": "plan"}),
        completion({"kind": 7, "goals": "none"}),
        JSONResponse({"unexpected": True}),
        Response("<html>", media_type="text/html"),
    ],
    ids=["prose", "truncated", "length", "unknown identifier", "no goals", "wrong types", "no completion", "html"],
)
@pytest.mark.anyio
async def test_a_bad_answer_is_corrected_in_another_round(first):
    found, endpoint = await interpret(first, completion(GOOD))
    assert_planned(found)
    assert "Your answer cannot be used" in endpoint.requests[1]["messages"][-1]["content"]


@pytest.mark.parametrize(
    "content",
    [
        f"```json\n{json.dumps(GOOD)}\n```",
        f"<think>{json.dumps(BAD)}</think>\n{json.dumps(GOOD)}",
        f"So: {json.dumps(GOOD)}.",
    ],
    ids=["fence", "reasoning", "prose around"],
)
@pytest.mark.anyio
async def test_json_is_found_in_its_wrapping(content):
    found, endpoint = await interpret(completion(content))
    assert_planned(found)
    assert len(endpoint.requests) == 1


@pytest.mark.parametrize("status", [429, 500, 502, 503])
@pytest.mark.anyio
async def test_a_passing_failure_is_tried_again(status):
    found, endpoint = await interpret(Response("busy", status_code=status), completion(GOOD))
    assert_planned(found)
    assert len(endpoint.requests) == 2


@pytest.mark.parametrize(
    ("answer", "part", "count"),
    [
        (Response("no", status_code=500), "status 500", 3),
        (Response("slow down", status_code=429), "no more requests", 3),
        (Response("who are you", status_code=401), "status 401", 1),
        (Response("no such model", status_code=404), "status 404", 1),
        (completion("", refusal="I cannot help with that"), "declined", 1),
        (completion("x", finish="content_filter"), "declined", 1),
        (completion("prose for ever"), "5 rounds", 5),
        (completion(BAD), "cup_77", 5),
    ],
)
@pytest.mark.anyio
async def test_a_lasting_failure_falls_back_to_the_grammar_and_says_so(answer, part, count):
    found, endpoint = await interpret(answer)
    assert_asked(found, part)
    assert len(endpoint.requests) == count


@pytest.mark.anyio
async def test_retry_after_is_obeyed():
    endpoint, naps = Endpoint(Response("", status_code=429, headers={"Retry-After": "7"}), completion(GOOD)), Naps()
    async with serving(endpoint) as url, planning(url, naps=naps) as (planner, _):
        assert_planned(await planner.interpret(VAGUE, SNAPSHOT, Dialogue()))
    assert naps.seconds == [7.0]


@pytest.mark.anyio
async def test_a_wait_longer_than_the_deadline_is_not_waited():
    endpoint, naps = Endpoint(Response("", status_code=429, headers={"Retry-After": "15"})), Naps()
    async with serving(endpoint) as url, planning(url, naps=naps, deadline_s=10.0) as (planner, _):
        assert_asked(await planner.interpret(VAGUE, SNAPSHOT, Dialogue()), "no more requests")
    assert naps.seconds == []


@pytest.mark.anyio
async def test_a_dead_endpoint_is_said_in_words():
    listener = socket.create_server(("127.0.0.1", 0))
    port = listener.getsockname()[1]
    listener.close()
    async with planning(f"http://127.0.0.1:{port}/v1") as (planner, _):
        assert_asked(await planner.interpret(VAGUE, SNAPSHOT, Dialogue()), "cannot be reached")


async def never(_) -> Response:
    await asyncio.sleep(60)
    return completion(GOOD)


async def drip(_) -> Response:
    async def slowly():
        for byte in completion(GOOD).body:
            yield bytes([byte])
            await asyncio.sleep(1)

    return StreamingResponse(slowly(), media_type="application/json")


@pytest.mark.parametrize("answer", [never, drip])
@pytest.mark.anyio
async def test_one_deadline_ends_a_slow_server(answer):
    started_s = time.perf_counter()
    found, _ = await interpret(answer, deadline_s=0.6)
    assert_asked(found, "within")
    assert time.perf_counter() - started_s < 10


@pytest.mark.anyio
async def test_a_cut_connection_is_tried_again_and_then_said():
    cuts = 0

    async def cut(reader, writer):
        nonlocal cuts
        cuts += 1
        await reader.read(100)
        writer.write(b"HTTP/1.1 200 OK\r\nContent-Length: 1000\r\n\r\n{")
        await writer.drain()
        writer.close()

    server = await asyncio.start_server(cut, "127.0.0.1", 0)
    async with server, planning(f"http://127.0.0.1:{server.sockets[0].getsockname()[1]}/v1") as (planner, _):
        assert_asked(await planner.interpret(VAGUE, SNAPSHOT, Dialogue()), "cannot be reached")
    assert cuts == 3


@pytest.mark.anyio
async def test_the_ladder_goes_down_once_and_stays_there():
    async def old_server(body):
        kind = body.get("response_format", {}).get("type")
        if kind is not None:
            return JSONResponse({"error": {"message": f"response_format {kind} is not supported"}}, status_code=400)
        return completion(f"Here: {json.dumps(GOOD)}")

    endpoint = Endpoint(old_server)
    request = ModelRequest(messages=(Message(role=Role.USER, text="hi"),), schema={"type": "object"})
    async with serving(endpoint) as url, planning(url) as (_, model):
        first, second = await model.complete(request, 5.0), await model.complete(request, 5.0)
    assert isinstance(first, ModelReply)
    assert isinstance(second, ModelReply)
    kinds = [body.get("response_format", {}).get("type") for body in endpoint.requests]
    assert kinds == ["json_schema", "json_object", None, None]
    assert "JSON schema" in endpoint.requests[-1]["messages"][-1]["content"]


@pytest.mark.anyio
async def test_a_huge_answer_is_cut_off():
    async def flood(_):
        async def pour():
            for _ in range(100):
                yield b"x" * 65536
                await asyncio.sleep(0)

        return StreamingResponse(pour())

    endpoint = Endpoint(flood)
    request = ModelRequest(messages=(Message(role=Role.USER, text="hi"),), schema={})
    async with serving(endpoint) as url, planning(url) as (_, model):
        failure = await model.complete(request, 10.0)
    assert isinstance(failure, ModelFailure)
    assert failure.kind is FailureKind.WRONG_SHAPE
