"""What every adapter of a language model keeps, over real HTTP on loopback, against a server that follows a script."""

from __future__ import annotations

import json
import socket
import time
from contextlib import asynccontextmanager

import httpx
import pytest

from model_server import DIALECTS, Anthropic, Line, ModelServer, Ollama, OpenAI
from planner.models.client import HttpModel
from planner.models.exchange import ExchangeSettings
from planner.models.protocol import FailureKind, Message, ModelFailure, ModelReply, ModelRequest, Role
from planner.models.spec import PROVIDERS, language_model, parse_spec

pytestmark = pytest.mark.anyio

SCHEMA = {"type": "object", "properties": {"a": {"type": "integer"}}, "required": ["a"], "additionalProperties": False}
REQUEST = ModelRequest(
    messages=(Message(role=Role.SYSTEM, text="Some rules."), Message(role=Role.USER, text="Hello?")), schema=SCHEMA
)
GOOD = '{"a": 1}'


@pytest.fixture
def anyio_backend():
    return "asyncio"


@pytest.fixture(params=DIALECTS, ids=lambda dialect: dialect.provider)
def dialect(request):
    return request.param


class Time:
    """A clock that stands still but for the naps that are asked for."""

    def __init__(self):
        self.now_s, self.naps = 100.0, []

    def __call__(self):
        return self.now_s

    async def sleep(self, seconds):
        self.naps.append(seconds)
        self.now_s += seconds


@asynccontextmanager
async def asking(dialect, *lines, url=None, context_tokens=32_768, clock=None, retry=ExchangeSettings()):
    """The adapter and the server that it asks."""
    server, clock = ModelServer(*lines), clock or Time()
    async with (
        server.running(),
        httpx.AsyncClient(verify=False) as http,
    ):  # reading certificates takes longer than a test
        wire = PROVIDERS[dialect.provider].wire("tiny", context_tokens)
        address = url or (f"{server.url}/v1" if dialect.provider == "openai" else server.url)
        yield (
            HttpModel(
                wire,
                base_url=address,
                http=http,
                key="k3y",
                context_tokens=context_tokens,
                retry=retry,
                clock=clock,
                sleep=clock.sleep,
            ),
            server,
        )


async def ask(dialect, *lines, deadline_s=20.0, request=REQUEST, **settings):
    async with asking(dialect, *lines, **settings) as (model, server):
        return await model.complete(request, deadline_s), server


def assert_failed(outcome, kind, *, attempts=1):
    assert isinstance(outcome, ModelFailure), outcome
    assert (outcome.kind, outcome.attempts) == (kind, attempts)
    assert outcome.message
    assert "k3y" not in repr(outcome)


async def test_a_sound_answer_comes_with_its_tokens_and_the_request_as_documented(dialect):
    outcome, server = await ask(dialect, Line(body=dialect.text(GOOD)))
    assert outcome == ModelReply(data={"a": 1}, text=GOOD, prompt_tokens=10, completion_tokens=5)
    assert server.paths == [dialect.path]
    (request,) = server.requests
    assert request["model"] == "tiny"
    assert dialect.schema(request) == SCHEMA
    assert request["messages"][-1] == {"role": "user", "content": "Hello?"}


@pytest.mark.parametrize("status", [408, 429, 500, 502, 503, 529])
async def test_a_failure_that_may_pass_is_tried_again(dialect, status):
    clock = Time()
    outcome, server = await ask(dialect, Line(body="busy", status=status), Line(body=dialect.text(GOOD)), clock=clock)
    assert isinstance(outcome, ModelReply)
    assert (outcome.attempts, len(server.requests), clock.naps) == (2, 2, [0.5])


@pytest.mark.parametrize(
    "error", [{"code": 429, "message": "busy"}, {"message": "busy"}, "busy", {"code": "overloaded"}]
)
async def test_an_error_under_the_status_of_a_success_is_one(dialect, error):
    outcome, server = await ask(dialect, Line(body={"error": error}), Line(body=dialect.text(GOOD)))
    assert isinstance(outcome, ModelReply)
    assert len(server.requests) == 2
    outcome, server = await ask(dialect, Line(body={"error": {"code": 401, "message": "who are you?"}}))
    assert_failed(outcome, FailureKind.HTTP_ERROR)
    assert "key" in outcome.message


async def test_an_answer_that_speaks_of_an_error_or_has_none_is_an_answer(dialect):
    outcome, _ = await ask(dialect, Line(body=dialect.text('{"a": 1, "error": "none"}') | {"error": None}))
    assert isinstance(outcome, ModelReply)


async def test_a_server_that_stays_out_of_order_is_given_up_after_three_attempts(dialect):
    clock = Time()
    outcome, server = await ask(dialect, Line(body="Traceback: secret", status=500), clock=clock)
    assert_failed(outcome, FailureKind.SERVER_ERROR, attempts=3)
    assert "status 500" in outcome.message
    assert "secret" not in outcome.message
    assert (len(server.requests), clock.naps) == (3, [0.5, 1.0])


@pytest.mark.parametrize(
    "headers",
    [
        {"Retry-After": "7"},
        {"Retry-After": "Sun, 06 Nov 1994 08:49:44 GMT", "Date": "Sun, 06 Nov 1994 08:49:37 GMT"},
    ],
    ids=["seconds", "date"],
)
async def test_a_wait_that_fits_into_the_deadline_is_kept(dialect, headers):
    clock, limit = Time(), Line(status=429, headers=headers)
    outcome, _ = await ask(dialect, limit, Line(body=dialect.text(GOOD)), clock=clock)
    assert isinstance(outcome, ModelReply)
    assert clock.naps == [7.0]


@pytest.mark.parametrize(
    ("deadline_s", "wait"), [(15.0, "16"), (3600.0, "1800")], ids=["past the deadline", "too long to hold a queue"]
)
async def test_a_wait_that_does_not_fit_ends_it_at_once(dialect, deadline_s, wait):
    clock, limit = Time(), Line(status=429, headers={"Retry-After": wait})
    outcome, server = await ask(dialect, limit, deadline_s=deadline_s, clock=clock)
    assert_failed(outcome, FailureKind.RATE_LIMITED)
    assert outcome.wait_s == float(wait)
    assert f"{wait} s" in outcome.message
    assert (len(server.requests), clock.naps) == (1, [])


@pytest.mark.parametrize("wait", ["soon", "-3", "nan", "", "Sun, 06 Nov 1994 08:49:44 GMT"])
async def test_a_wait_that_cannot_be_read_is_none(dialect, wait):
    clock, limit = Time(), Line(status=429, headers={"Retry-After": wait})
    outcome, _ = await ask(dialect, limit, Line(body=dialect.text(GOOD)), clock=clock)
    assert isinstance(outcome, ModelReply)
    assert clock.naps == [0.5]


async def test_one_deadline_ends_slow_bytes(dialect):
    started_s = time.perf_counter()
    outcome, _ = await ask(dialect, Line(body=dialect.text(GOOD), pause_s=0.05), deadline_s=0.2)
    assert_failed(outcome, FailureKind.TIMEOUT)
    assert time.perf_counter() - started_s < 3


async def test_no_attempt_begins_after_the_deadline(dialect):
    clock, retry = Time(), ExchangeSettings(wait_s=12.0, longest_wait_s=60.0)
    outcome, server = await ask(dialect, Line(status=500), deadline_s=30.0, clock=clock, retry=retry)
    assert_failed(outcome, FailureKind.SERVER_ERROR, attempts=2)
    assert (len(server.requests), clock.naps) == (2, [12.0])


async def test_a_cut_connection_is_tried_again(dialect):
    whole = Line(body=dialect.text(GOOD))
    outcome, _ = await ask(dialect, Line(body=dialect.text(GOOD), cut=True), whole)
    assert isinstance(outcome, ModelReply)
    outcome, server = await ask(dialect, Line(body=dialect.text(GOOD), cut=True))
    assert_failed(outcome, FailureKind.ENDPOINT_DOWN, attempts=3)
    assert server.url.removeprefix("http://") in outcome.message


async def test_a_dead_endpoint_is_named_without_its_password(dialect):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
    outcome, _ = await ask(dialect, Line(), url=f"http://user:passw0rd@127.0.0.1:{port}/v1")
    assert_failed(outcome, FailureKind.ENDPOINT_DOWN, attempts=3)
    assert f"127.0.0.1:{port}" in outcome.message
    assert "passw0rd" not in outcome.message


@pytest.mark.parametrize("url", ["http://", "http://[", "http://h:port", "http://no such host/"])
async def test_an_address_that_is_none_is_a_dead_endpoint(dialect, url):
    outcome, _ = await ask(dialect, Line(), url=url)
    assert_failed(outcome, FailureKind.ENDPOINT_DOWN, attempts=3)


async def test_a_refusal_is_one_where_the_provider_has_a_word_for_it(dialect):
    outcome, server = await ask(dialect, Line(body=dialect.refusal()))
    assert_failed(outcome, FailureKind.REFUSAL if dialect.refusal_is_told else FailureKind.MALFORMED_JSON)
    assert len(server.requests) == 1


async def test_an_answer_that_was_cut_off_is_none_even_if_it_holds_an_object(dialect):
    outcome, _ = await ask(dialect, Line(body=dialect.cut_off(f"{GOOD} and the ")))
    assert_failed(outcome, FailureKind.TRUNCATED)
    assert outcome.text.startswith(GOOD)


@pytest.mark.parametrize(
    "content",
    [
        f"```json\n{GOOD}\n```",
        f"Certainly! {GOOD} Anything else?",
        f'<think>maybe {{"a": 2, "b": "longer"}}</think>\n{GOOD}',
        f'<THINKING>{{"a": 3}}</THINKING>{GOOD}',
        f'it could be {{"a": 4, "b": "longer"}} or so</think>\n\n{GOOD}',
    ],
    ids=["fence", "prose", "reasoning", "other tag", "reasoning without its first tag"],
)
async def test_the_object_is_found_in_its_wrapping(dialect, content):
    outcome, _ = await ask(dialect, Line(body=dialect.text(content)))
    assert isinstance(outcome, ModelReply)
    assert (outcome.data, outcome.text) == ({"a": 1}, content)


@pytest.mark.parametrize(
    "content", ["I would rather not.", '{"a": ', "[1]", "", f"<think>{GOOD}", '{"a": ' + "9" * 5000]
)
async def test_an_answer_without_a_whole_object_is_malformed(dialect, content):
    outcome, _ = await ask(dialect, Line(body=dialect.text(content)))
    assert_failed(outcome, FailureKind.MALFORMED_JSON)


@pytest.mark.parametrize("number", range(4))
async def test_wrong_types_are_a_typed_outcome(dialect, number):
    outcome, server = await ask(dialect, Line(body=dialect.wrong_types[number]))
    assert_failed(outcome, FailureKind.WRONG_SHAPE)
    assert len(server.requests) == 1


@pytest.mark.parametrize("body", ["", "<html>", "[]", "null", '"hi"', "{", "[" * 3000, "9" * 5000, "{}\n{}"])
async def test_a_body_that_is_no_answer_is_a_typed_outcome(dialect, body):
    outcome, _ = await ask(dialect, Line(body=body))
    assert_failed(outcome, FailureKind.WRONG_SHAPE)


async def test_an_endless_answer_is_cut_off(dialect):
    outcome, _ = await ask(dialect, Line(body=dialect.text("x" * 4_000_000)))
    assert_failed(outcome, FailureKind.WRONG_SHAPE)
    assert "2 MB" in outcome.message
    assert len(outcome.text) <= 2000


@pytest.mark.parametrize(("status", "part"), [(401, "key"), (403, "key"), (404, "no such model"), (418, "418")])
async def test_a_refused_request_is_not_repeated_and_its_reason_is_named(dialect, status, part):
    outcome, server = await ask(dialect, Line(body={"error": {"message": "no"}}, status=status))
    assert_failed(outcome, FailureKind.HTTP_ERROR)
    assert part in outcome.message
    assert len(server.requests) == 1


@pytest.mark.parametrize("status", [400, 422])
async def test_the_ladder_goes_down_a_rung_at_a_time_and_stays_there(dialect, status):
    complaint, _ = dialect.unknown_format
    refused = Line(body=complaint if status == 400 else "", status=status)

    def old_server(body):
        return Line(body=dialect.text(f"Here: {GOOD}")) if dialect.rung(body) == "asking" else refused

    async with asking(dialect, old_server) as (model, server):
        outcomes = [await model.complete(REQUEST, 30.0) for _ in range(2)]
    assert all(isinstance(outcome, ModelReply) for outcome in outcomes)
    assert [dialect.rung(request) for request in server.requests] == ["schema", "middle", "asking", "asking"]
    assert json.dumps(SCHEMA, separators=(",", ":")) in server.requests[-1]["messages"][-1]["content"]


async def test_at_the_foot_of_the_ladder_a_complaint_is_final(dialect):
    outcome, server = await ask(dialect, Line(body=dialect.unknown_format[0], status=400))
    assert_failed(outcome, FailureKind.HTTP_ERROR)
    assert len(server.requests) == 3


async def test_other_complaints_leave_the_ladder_alone(dialect):
    async with asking(dialect, Line(body="no money left", status=400), Line(body=dialect.text(GOOD))) as (
        model,
        server,
    ):
        assert_failed(await model.complete(REQUEST, 30.0), FailureKind.HTTP_ERROR)
        assert isinstance(await model.complete(REQUEST, 30.0), ModelReply)
    assert [dialect.rung(request) for request in server.requests] == ["schema", "schema"]


async def test_a_prompt_that_the_server_finds_too_long_leaves_the_ladder_alone(dialect):
    body, status = dialect.too_long
    outcome, server = await ask(dialect, Line(body=body, status=status))
    assert_failed(outcome, FailureKind.PROMPT_TOO_LONG)
    assert len(server.requests) == 1


async def test_a_prompt_beyond_the_context_is_not_sent(dialect):
    request = ModelRequest(messages=(Message(role=Role.USER, text="word " * 2000),), schema=SCHEMA)
    outcome, server = await ask(dialect, Line(body=dialect.text(GOOD)), request=request, context_tokens=4096)
    assert_failed(outcome, FailureKind.PROMPT_TOO_LONG, attempts=0)
    assert "4096" in outcome.message
    assert server.requests == []
    outcome, server = await ask(dialect, Line(body=dialect.text(GOOD)), request=request, context_tokens=8192)
    assert isinstance(outcome, ModelReply)


async def test_any_text_reaches_the_server_as_it_is(dialect):
    text = 'a "quoted" \u2028 line, \x00, \U0001f600 and \ud800'
    request = ModelRequest(messages=(Message(role=Role.USER, text=text),), schema=SCHEMA)
    _, server = await ask(dialect, Line(body=dialect.text(GOOD)), request=request)
    assert server.requests[0]["messages"][-1]["content"] == text


async def test_keys_travel_as_each_provider_wants_them():
    for dialect, header, value in (
        (OpenAI(), "authorization", "Bearer k3y"),
        (Ollama(), "authorization", "Bearer k3y"),
        (Anthropic(), "x-api-key", "k3y"),
    ):
        _, server = await ask(dialect, Line(body=dialect.text(GOOD)))
        assert server.headers[0][header] == value
    assert server.headers[0]["anthropic-version"] == "2023-06-01"


async def test_a_specification_leads_to_the_right_address(dialect):
    async with ModelServer(Line(body=dialect.text(GOOD))).running() as server, httpx.AsyncClient(verify=False) as http:
        model = language_model(parse_spec(f"{dialect.provider}:tiny@{server.url}/v1"), http=http, key="k3y")
        assert isinstance(await model.complete(REQUEST, 30.0), ModelReply)
    assert server.paths == [dialect.path]
    assert model.name == f"{dialect.provider}:tiny"


@pytest.mark.parametrize(("words", "expected"), [(10, 8192), (6000, 16384), (16_000, 32_768), (17_000, 30_000)])
async def test_ollama_is_told_a_context_that_holds_the_prompt(words, expected):
    request = ModelRequest(messages=(Message(role=Role.USER, text="word " * words),), schema=SCHEMA)
    limit = 30_000 if expected == 30_000 else 32_768
    _, server = await ask(Ollama(), Line(body=Ollama.text(GOOD)), request=request, context_tokens=limit)
    (sent,) = server.requests
    assert sent["options"] == {"temperature": 0, "num_predict": 1024, "num_ctx": expected}
    assert (sent["stream"], sent["think"], sent["truncate"], sent["shift"]) == (False, False, False, False)


async def test_anthropic_reads_the_rules_apart_and_answers_by_tool_where_it_knows_no_schema():
    call = {"type": "tool_use", "id": "t", "name": "answer", "input": {"a": 1}}
    spoken = Anthropic.text("Let me see.", stop="tool_use")
    answer = Line(body={**spoken, "content": [*spoken["content"], call]})
    outcome, server = await ask(Anthropic(), Line(body=Anthropic.unknown_format[0], status=400), answer)
    assert isinstance(outcome, ModelReply)
    assert outcome.data == {"a": 1}
    sent = server.requests[1]
    assert sent["system"] == "Some rules."
    assert [message["role"] for message in sent["messages"]] == ["user"]
    assert sent["tools"][0]["input_schema"] == SCHEMA
    assert sent["tool_choice"] == {"type": "tool", "name": sent["tools"][0]["name"]}
    assert "temperature" not in sent


async def test_openais_reasoning_models_get_the_fields_that_they_know():
    def reasoning_model(body):
        if "max_tokens" in body:
            return Line(body="Unsupported parameter: 'max_tokens'. Use 'max_completion_tokens' instead.", status=400)
        if "temperature" in body:
            return Line(body="Unsupported value: 'temperature' does not support 0 with this model.", status=400)
        return Line(body=OpenAI.text(GOOD))

    outcome, server = await ask(OpenAI(), reasoning_model)
    assert isinstance(outcome, ModelReply)
    assert server.requests[-1]["max_completion_tokens"] == 1024
    assert [OpenAI.rung(request) for request in server.requests] == ["schema"] * 3
