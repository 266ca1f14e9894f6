"""Language model plumbing without a network: extraction, completions, specifications, the double, proposals."""

from __future__ import annotations

import json

import httpx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.errors import BadModelKey, BadModelSpec
from planner.goals import Predicate
from planner.models.anthropic import AnthropicWire
from planner.models.budget import over_budget, tokens_needed
from planner.models.extraction import json_object
from planner.models.ollama import OllamaWire
from planner.models.openai import OpenAIWire
from planner.models.protocol import FailureKind, Message, ModelFailure, ModelReply, ModelRequest, Role
from planner.models.scripted import ScriptedModel
from planner.models.spec import language_model, parse_spec
from planner.task_planner.proposal import Proposal, goals_of, read_proposal, schema
from prompts.templates import PromptNotFound, WrongVariables, available, render, variables

values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats(allow_nan=False, allow_infinity=False) | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(st.text(max_size=5), inner, max_size=3),
    max_leaves=8,
)
objects = st.dictionaries(st.text(max_size=6), values, max_size=4)


@pytest.fixture
def anyio_backend():
    return "asyncio"


@given(objects, st.text(alphabet="abc .,\n", max_size=20), st.text(alphabet="abc .,\n", max_size=20))
def test_an_object_amid_prose_is_found_as_it_was_written(data, before, after):
    assert json_object(f"{before}{json.dumps(data)}{after}") == data


@pytest.mark.parametrize(
    "text",
    [
        '```json\n{"a": 1}\n```',
        'Sure! Here you are: {"a": 1} Anything else?',
        '<think>maybe {"b": 2} or so</think>{"a": 1}',
        '<thinking>{"a": 0, "much": "longer than the answer"}</thinking> {"a": 1}',
        '{not json} {"a": 1}',
        'say {"b": "longer than the answer"}</think>{"a": 1}',
        '{"a": 1}</think>',
    ],
)
def test_fences_prose_and_reasoning_are_passed_over(text):
    assert json_object(text) == {"a": 1}


@pytest.mark.parametrize(
    "text", ["", "no", "[1, 2]", '{"a": ', '"a"', "<think>{}", "{" * 5000, "[" * 5000, '{"a": ' + "9" * 5000]
)
def test_without_a_whole_object_there_is_none(text):
    assert json_object(text) is None


@given(st.text(max_size=60))
def test_any_text_is_searched_without_complaint(text):
    assert json_object(text) is None or isinstance(json_object(text), dict)


def completion(content='{"a": 1}', **fields):
    message = {"role": "assistant", "content": content} | fields.pop("message", {})
    choice = {"index": 0, "message": message, "finish_reason": "stop"} | fields.pop("choice", {})
    return json.dumps({"choices": [choice], "usage": {"prompt_tokens": 7, "completion_tokens": 3}} | fields).encode()


WIRES = (OpenAIWire(model="m"), OllamaWire(model="m", context_tokens=8192), AnthropicWire(model="m"))


def test_a_completion_gives_the_object_the_raw_text_and_the_tokens():
    assert WIRES[0].read(completion()) == ModelReply(
        data={"a": 1}, text='{"a": 1}', prompt_tokens=7, completion_tokens=3
    )


@pytest.mark.parametrize(
    ("body", "kind"),
    [
        (completion("sorry, prose only"), FailureKind.MALFORMED_JSON),
        (completion(None), FailureKind.MALFORMED_JSON),
        (completion(message={"refusal": "I will not"}), FailureKind.REFUSAL),
        (completion(choice={"finish_reason": "content_filter"}), FailureKind.REFUSAL),
        (completion('{"a": ', choice={"finish_reason": "length"}), FailureKind.TRUNCATED),
        (completion(choices=[]), FailureKind.WRONG_SHAPE),
        (completion(choices="none"), FailureKind.WRONG_SHAPE),
        (completion(message={"content": [1, 2]}), FailureKind.WRONG_SHAPE),
        (b"<html>502</html>", FailureKind.WRONG_SHAPE),
        (b"", FailureKind.WRONG_SHAPE),
        (b"\xff\xfe", FailureKind.WRONG_SHAPE),
        (b"[" * 100_000, FailureKind.WRONG_SHAPE),
    ],
    ids=lambda value: str(value)[:30],
)
def test_every_way_a_completion_fails_has_its_kind(body, kind):
    failure = WIRES[0].read(body)
    assert isinstance(failure, ModelFailure)
    assert failure.kind is kind


@given(st.binary(max_size=80) | values.map(lambda value: json.dumps(value).encode()))
def test_any_body_is_read_without_complaint(body):
    for wire in WIRES:
        assert isinstance(wire.read(body), ModelReply | ModelFailure)


@pytest.mark.parametrize(
    ("text", "base_url", "expected"),
    [
        ("openai:gpt-x", None, ("openai", "gpt-x", "https://api.openai.com/v1")),
        ("ollama:qwen2.5:7b", None, ("ollama", "qwen2.5:7b", "http://127.0.0.1:11434")),
        ("anthropic:claude-x", None, ("anthropic", "claude-x", "https://api.anthropic.com")),
        ("openai:org/model:free", "http://h/v1", ("openai", "org/model:free", "http://h/v1")),
        ("openai:m@http://127.0.0.1:1/v1", "http://h/v1", ("openai", "m", "http://127.0.0.1:1/v1")),
    ],
)
def test_a_specification_names_provider_model_and_address(text, base_url, expected):
    spec = parse_spec(text, base_url=base_url)
    assert (spec.provider, spec.model, spec.base_url) == expected


@pytest.mark.parametrize("text", ["", "openai", "openai:", "nobody:x", "gpt-x", ":x"])
def test_an_unreadable_specification_says_what_is_expected(text):
    with pytest.raises(BadModelSpec) as error:
        parse_spec(text)
    assert "openai:MODEL, ollama:MODEL, anthropic:MODEL" in str(error.value)


@pytest.mark.parametrize(
    ("spec", "key"), [("anthropic:m", None), ("anthropic:m", " "), ("openai:m", "schl\u00fcssel"), ("ollama:m", "a\nb")]
)
@pytest.mark.anyio
async def test_a_key_that_is_missing_or_none_is_said_before_any_request(spec, key):
    async with httpx.AsyncClient() as http:
        with pytest.raises(BadModelKey, match="MAJORDOMO_LLM_KEY") as error:
            language_model(parse_spec(spec), http=http, key=key)
    assert key is None or not key.strip() or key not in str(error.value)


@given(st.text(max_size=300), st.integers(0, 5000))
def test_a_request_is_sent_exactly_when_its_estimate_fits(text, tokens):
    request = ModelRequest(messages=(Message(role=Role.USER, text=text),), schema={}, max_tokens=100)
    assert tokens_needed(request) >= len(text) / 3 + 100
    assert (over_budget(request, tokens) is None) == (tokens_needed(request) <= tokens)


@pytest.mark.anyio
async def test_the_name_of_a_model_holds_no_key():
    async with httpx.AsyncClient() as http:
        model = language_model(parse_spec("openai:m"), http=http, key="secret")
        assert model.name == "openai:m"
        assert "secret" not in repr(model)


@pytest.mark.anyio
async def test_the_scripted_model_speaks_its_lines_and_then_is_down():
    failure = ModelFailure(kind=FailureKind.REFUSAL, message="no")
    model = ScriptedModel([{"a": 1}, "prose", failure])
    request = ModelRequest(messages=(Message(role=Role.USER, text="hi"),), schema={})
    answers = [await model.complete(request, 1.0) for _ in range(4)]
    assert isinstance(answers[0], ModelReply)
    assert [answer.kind for answer in answers[1:] if isinstance(answer, ModelFailure)] == [
        FailureKind.MALFORMED_JSON,
        FailureKind.REFUSAL,
        FailureKind.ENDPOINT_DOWN,
    ]
    assert model.requests == [request] * 4


@given(objects)
def test_any_object_is_a_proposal_or_has_a_flaw_in_one_sentence(data):
    found = read_proposal(data)
    assert isinstance(found, Proposal) or found.message.endswith(".")


@pytest.mark.parametrize(
    ("goal", "kind", "part"),
    [
        ({"predicate": "under", "args": ["a", "b"]}, FailureKind.WRONG_SHAPE, "on/2"),
        ({"predicate": "on", "args": ["a"]}, FailureKind.WRONG_SHAPE, "2 arguments"),
        ({"predicate": "on", "args": ["a", "z"]}, FailureKind.UNKNOWN_IDENTIFIER, "'z'"),
    ],
)
def test_a_goal_that_makes_no_sense_is_named(goal, kind, part):
    proposal = read_proposal({"kind": "plan", "goals": [goal], "question": "", "reply": ""})
    assert isinstance(proposal, Proposal)
    failure = goals_of(proposal, {"a": 1, "b": 1})
    assert isinstance(failure, ModelFailure)
    assert failure.kind is kind
    assert part in failure.message


def test_the_schema_allows_the_identifiers_and_nothing_else():
    document = schema(["cup_1", "table_1"])
    goal = document["properties"]["goals"]["items"]
    assert goal["properties"]["args"]["items"]["enum"] == ["cup_1", "table_1"]
    assert goal["properties"]["predicate"]["enum"] == [predicate.value for predicate in Predicate]
    assert document["additionalProperties"] is False


@pytest.mark.parametrize("name", available())
def test_every_prompt_is_filled_strictly(name):
    values = dict.fromkeys(variables(name), "{{ghost}} text")
    text = render(name, **values)
    assert text
    assert text.count("{{ghost}}") >= len(values)
    with pytest.raises(WrongVariables) as error:
        render(name, **values, extra="x")
    assert "extra" in error.value.unused
    if values:
        with pytest.raises(WrongVariables) as error:
            render(name)
        assert set(error.value.missing) == values.keys()


def test_an_unknown_prompt_lists_those_there_are():
    with pytest.raises(PromptNotFound) as error:
        render("no_such_prompt")
    assert error.value.available == available()
