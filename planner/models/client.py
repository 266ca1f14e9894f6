"""A language model behind HTTP: what all providers have in common. What differs is in one ``Wire`` each."""

from __future__ import annotations

import asyncio
import time
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import replace
from typing import Any, Protocol, Self

import httpx

from planner.models.budget import over_budget
from planner.models.exchange import Answer, Exchange, ExchangeSettings
from planner.models.protocol import FailureKind, ModelFailure, ModelReply, ModelRequest

HINTS = {
    401: " (it does not accept the key)",
    403: " (it does not accept the key)",
    404: " (it knows no such model or address)",
}
LENGTH_WORDS = ("context length", "context_length", "context size", "context_size", "context window", "too long")


class Wire(Protocol):
    """How one provider wants to be asked for a JSON object, and how it answers. Immutable."""

    @property
    def provider(self) -> str: ...

    @property
    def model(self) -> str: ...

    def url(self, base_url: str) -> str: ...

    def headers(self, key: str) -> Mapping[str, str]: ...

    def payload(self, request: ModelRequest) -> dict[str, Any]: ...

    def conceding(self, status: int, complaint: str) -> Self | None:
        """The wire without what the server complains about (in lower case), ``None`` when that is something else."""
        ...

    def read(self, body: bytes) -> ModelReply | ModelFailure: ...


class HttpModel:
    """One model of one server.

    Args:
        base_url: as the wire wants it.
        http: client to use; its lifetime is the caller's.
        context_tokens: a request that needs more is not sent.
        clock: seconds, monotonic.
    """

    def __init__(
        self,
        wire: Wire,
        *,
        base_url: str,
        http: httpx.AsyncClient,
        context_tokens: int,
        key: str = "",
        exchange: ExchangeSettings = ExchangeSettings(),
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], Awaitable[None]] = asyncio.sleep,
    ) -> None:
        self._wire, self._context_tokens, self._clock = wire, context_tokens, clock
        self._exchange = Exchange(
            wire.url(base_url), headers=wire.headers(key), http=http, settings=exchange, clock=clock, sleep=sleep
        )

    @property
    def name(self) -> str:
        """``PROVIDER:MODEL``."""
        return f"{self._wire.provider}:{self._wire.model}"

    async def complete(self, request: ModelRequest, deadline_s: float) -> ModelReply | ModelFailure:
        """Answer within ``deadline_s`` seconds; what the server does not know is left out from then on."""
        too_long = over_budget(request, self._context_tokens)
        if too_long is not None:
            return too_long
        end_s = self._clock() + deadline_s
        while True:
            wire = self._wire
            answer = await self._exchange.post(wire.payload(request), end_s - self._clock())
            if isinstance(answer, ModelFailure):
                return answer
            if answer.status == httpx.codes.OK:
                return replace(wire.read(answer.body), attempts=answer.attempts)
            milder = None if _is_about_length(answer) else wire.conceding(answer.status, answer.text.lower())
            if milder is None:
                return _failure(answer)
            self._wire = milder


def _is_about_length(answer: Answer) -> bool:
    statuses = (httpx.codes.BAD_REQUEST, httpx.codes.REQUEST_ENTITY_TOO_LARGE)
    return answer.status in statuses and any(word in answer.text.lower() for word in LENGTH_WORDS)


def _failure(answer: Answer) -> ModelFailure:
    if _is_about_length(answer):
        kind, message = FailureKind.PROMPT_TOO_LONG, "the server says that what it would have to read is too long"
    else:
        hint = HINTS.get(answer.status, "")
        kind, message = FailureKind.HTTP_ERROR, f"the server answered with status {answer.status}{hint}"
    return ModelFailure(kind=kind, message=message, text=answer.text[:2000], attempts=answer.attempts)
