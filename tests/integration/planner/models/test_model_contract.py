"""What every adapter of a language model makes of answers, over real HTTP on loopback, by a server with a script."""

from __future__ import annotations

import json

import httpx
import pytest

from asked_model import GOOD, REQUEST, SCHEMA, ask, asking, assert_failed
from model_server import Anthropic, Line, ModelServer, Ollama, OpenAI
from planner.models.protocol import FailureKind, Message, ModelReply, ModelRequest, Role
from planner.models.spec import language_model, parse_spec

pytestmark = pytest.mark.anyio


async def test_a_sound_answer_comes_with_its_tokens_and_the_request_as_documented(dialect):
    outcome, server = await ask(dialect, Line(body=dialect.text(GOOD)))
    assert outcome == ModelReply(data={"a": 1}, text=GOOD, prompt_tokens=10, completion_tokens=5)
    assert server.paths == [dialect.path]
    (request,) = server.requests
    assert request["model"] == "tiny"
    assert dialect.schema(request) == SCHEMA
    assert request["messages"][-1] == {"role": "user", "content": "Hello?"}


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
