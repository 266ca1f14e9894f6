"""The circuit breaker: rests that grow, one trial after each, and what people are told meanwhile."""

from __future__ import annotations

import asyncio
from datetime import UTC, datetime

import pytest

from planner.models.breaker import BreakerSettings, CircuitBreaker
from planner.models.protocol import FailureKind, Message, ModelFailure, ModelReply, ModelRequest, Role
from planner.models.scripted import ScriptedModel

pytestmark = pytest.mark.anyio

REQUEST = ModelRequest(messages=(Message(role=Role.USER, text="hi"),), schema={})
GOOD = {"a": 1}


@pytest.fixture
def anyio_backend():
    return "asyncio"


def failure(kind, wait_s=0.0):
    return ModelFailure(kind=kind, message="it is so", wait_s=wait_s)


DOWN = failure(FailureKind.ENDPOINT_DOWN)


class Bench:
    """A breaker with a clock that is set by hand, at noon."""

    def __init__(self, script, **settings):
        self.now_s = 1000.0
        self.model = ScriptedModel(script, name="openai:m")
        noon = datetime(2026, 1, 1, 12, tzinfo=UTC)
        self.breaker = CircuitBreaker(
            self.model,
            place="h:1",
            settings=BreakerSettings(**settings),
            clock=lambda: self.now_s,
            time_of_day=lambda: noon,
        )

    async def ask(self):
        outcome = await self.breaker.complete(REQUEST, 5.0)
        return "reply" if isinstance(outcome, ModelReply) else outcome.kind.value

    async def say(self):
        return (await self.breaker.complete(REQUEST, 5.0)).message

    @property
    def asked(self):
        return len(self.model.requests)


async def test_a_model_that_answers_is_asked_each_time():
    bench = Bench([GOOD] * 5)
    assert [await bench.ask() for _ in range(5)] == ["reply"] * 5
    assert bench.breaker.name == "openai:m"


@pytest.mark.parametrize("kind", [FailureKind.ENDPOINT_DOWN, FailureKind.SERVER_ERROR, FailureKind.TIMEOUT])
async def test_after_three_outages_in_a_row_it_rests_and_says_until_when(kind):
    bench = Bench([failure(kind)] * 9)
    assert [await bench.say() for _ in range(2)] == ["it is so"] * 2
    assert await bench.say() == "it is so; I use my own grammar until 12:00:30"
    bench.now_s += 10.0
    assert await bench.say() == "The language model at h:1 does not answer; I use my own grammar until 12:00:20"
    assert await bench.ask() == "resting"
    assert bench.asked == 3


@pytest.mark.parametrize("between", [GOOD, "prose", failure(FailureKind.REFUSAL), failure(FailureKind.HTTP_ERROR)])
async def test_outages_count_only_in_a_row(between):
    bench = Bench([DOWN, DOWN, between, DOWN, DOWN, GOOD])
    assert [await bench.ask() for _ in range(6)][-1] == "reply"


async def test_a_prompt_that_is_too_long_says_nothing_about_the_server():
    bench = Bench([DOWN, DOWN, failure(FailureKind.PROMPT_TOO_LONG), DOWN])
    for _ in range(4):
        await bench.ask()
    assert await bench.ask() == "resting"


async def test_each_rest_is_twice_as_long_up_to_a_limit():
    bench = Bench([DOWN] * 99, first_rest_s=30.0, longest_rest_s=100.0)
    for _ in range(3):
        await bench.ask()
    for rest_s in (30.0, 60.0, 100.0, 100.0):
        asked = bench.asked
        bench.now_s += rest_s - 0.1
        assert await bench.ask() == "resting"
        bench.now_s += 0.1
        assert await bench.ask() == "endpoint_down"
        assert bench.asked == asked + 1


async def test_one_answer_after_a_rest_ends_the_matter():
    bench = Bench([DOWN, DOWN, DOWN, "prose", DOWN, DOWN, DOWN, GOOD])
    for _ in range(3):
        await bench.ask()
    bench.now_s += 30.0
    assert [await bench.ask() for _ in range(4)] == ["malformed_json", *["endpoint_down"] * 3]
    assert await bench.say() == "The language model at h:1 does not answer; I use my own grammar until 12:00:30"
    bench.now_s += 30.0
    assert await bench.ask() == "reply"


async def test_a_server_that_asks_to_be_left_alone_is():
    bench = Bench([failure(FailureKind.RATE_LIMITED, wait_s=90.0), GOOD])
    assert await bench.say() == "it is so; I use my own grammar until 12:01:30"
    assert await bench.say() == "The language model at h:1 takes no more requests; I use my own grammar until 12:01:30"
    bench.now_s += 90.0
    assert await bench.ask() == "reply"


async def test_a_limit_without_a_time_is_no_reason_to_rest():
    bench = Bench([failure(FailureKind.RATE_LIMITED)] * 5 + [GOOD])
    assert [await bench.ask() for _ in range(6)][-1] == "reply"


async def test_while_one_request_tries_others_do_not_and_a_cancelled_try_is_none():
    gate, bench = asyncio.Event(), Bench([DOWN] * 3)
    for _ in range(3):
        await bench.ask()
    bench.now_s += 30.0

    class Waiting(ScriptedModel):
        async def complete(self, request, deadline_s):
            await gate.wait()
            return await super().complete(request, deadline_s)

    bench.breaker._model = Waiting([GOOD])
    trial = asyncio.create_task(bench.ask())
    await asyncio.sleep(0)
    assert await bench.ask() == "resting"
    trial.cancel()
    await asyncio.gather(trial, return_exceptions=True)
    gate.set()
    assert await bench.ask() == "reply"
