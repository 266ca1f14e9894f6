"""An adapter of a language model and the scripted server that it asks, for tests of what every adapter keeps."""

from __future__ import annotations

from contextlib import asynccontextmanager

import httpx

from model_server import ModelServer
from planner.models.client import HttpModel
from planner.models.exchange import ExchangeSettings
from planner.models.protocol import Message, ModelFailure, ModelRequest, Role
from planner.models.spec import PROVIDERS

SCHEMA = {"type": "object", "properties": {"a": {"type": "integer"}}, "required": ["a"], "additionalProperties": False}
REQUEST = ModelRequest(
    messages=(Message(role=Role.SYSTEM, text="Some rules."), Message(role=Role.USER, text="Hello?")), schema=SCHEMA
)
GOOD = '{"a": 1}'


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
async def asking(dialect, *lines, url=None, context_tokens=32_768, clock=None, exchange=ExchangeSettings()):
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
                exchange=exchange,
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
