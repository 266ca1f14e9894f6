"""Chat completions as OpenAI defined them and vLLM, llama.cpp, LM Studio, OpenRouter and others offer them.

Structured output by capability: JSON schema, else JSON mode, else asking for JSON and extracting it. The first that the
server accepts is remembered.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, replace
from enum import IntEnum
from typing import Any

import httpx

from majordomo.planner.models.completions import read_completion
from majordomo.planner.models.protocol import FailureKind, ModelFailure, ModelReply, ModelRequest
from majordomo.prompts.templates import render

MAX_ANSWER_BYTES = 2_000_000
RETRIED_STATUSES = frozenset({408, 409, 425, 429, 500, 502, 503, 504, 529})
SHAPE_STATUSES = frozenset({400, 404, 415, 422, 501})
"""With these a server may say that it does not know the response format."""


class Rung(IntEnum):
    """How structured output is asked for; the next is tried when the server knows no better."""

    SCHEMA = 0
    JSON_MODE = 1
    EXTRACTION = 2


@dataclass(frozen=True, kw_only=True)
class RetrySettings:
    """``attempts`` in all; the wait doubles from ``wait_s``, unless the server names one (Retry-After)."""

    attempts: int = 3
    wait_s: float = 0.5
    longest_wait_s: float = 20.0


class OpenAIModel:
    """One model of an OpenAI-compatible server.

    Args:
        model: as the server names it.
        base_url: up to and including ``/v1``.
        http: client to use; its lifetime is the caller's.
        key: sent as bearer token when not empty.
    """

    def __init__(
        self,
        model: str,
        *,
        base_url: str,
        http: httpx.AsyncClient,
        key: str = "",
        retry: RetrySettings = RetrySettings(),
        sleep: Callable[[float], Awaitable[None]] = asyncio.sleep,
    ) -> None:
        self._model, self._url = model, f"{base_url.rstrip('/')}/chat/completions"
        self._http, self._retry, self._sleep = http, retry, sleep
        self._headers = {"Authorization": f"Bearer {key}"} if key else {}
        self._rung = Rung.SCHEMA

    @property
    def name(self) -> str:
        """``openai:MODEL``."""
        return f"openai:{self._model}"

    async def complete(self, request: ModelRequest, deadline_s: float) -> ModelReply | ModelFailure:
        """Answer within ``deadline_s`` seconds, retries and waits included."""
        try:
            async with asyncio.timeout(max(deadline_s, 0.0)):
                return await self._with_retries(request, time.monotonic() + deadline_s)
        except TimeoutError:
            return ModelFailure(kind=FailureKind.TIMEOUT, message=f"no answer within {deadline_s:.0f} s")

    async def _with_retries(self, request: ModelRequest, end_s: float) -> ModelReply | ModelFailure:
        attempt = 1
        while True:
            rung = self._rung
            outcome, wait_s = await self._once(request)
            if self._rung > rung:
                continue
            outcome = replace(outcome, attempts=attempt)
            if wait_s is None or attempt >= self._retry.attempts:
                return outcome
            pause_s = min(max(wait_s, self._retry.wait_s * 2 ** (attempt - 1)), self._retry.longest_wait_s)
            if time.monotonic() + pause_s >= end_s:
                return outcome
            await self._sleep(pause_s)
            attempt += 1

    async def _once(self, request: ModelRequest) -> tuple[ModelReply | ModelFailure, float | None]:
        """One exchange; with a failure that may pass, the seconds that the server wants to be left alone."""
        try:
            status, headers, body = await self._exchange(request)
        except httpx.TimeoutException:
            return ModelFailure(kind=FailureKind.TIMEOUT, message="the server did not answer in time"), 0.0
        except (httpx.TransportError, httpx.InvalidURL) as error:
            message = f"the server at {self._host} cannot be reached ({type(error).__name__})"
            return ModelFailure(kind=FailureKind.ENDPOINT_DOWN, message=message), 0.0
        if status == httpx.codes.OK:
            return read_completion(body), None
        if status in SHAPE_STATUSES and self._rung < Rung.EXTRACTION and _is_about_format(body):
            self._rung = Rung(self._rung + 1)
        return _http_failure(status, body), _retry_after_s(headers) if status in RETRIED_STATUSES else None

    async def _exchange(self, request: ModelRequest) -> tuple[int, Mapping[str, str], bytes]:
        body = bytearray()
        payload = self._payload(request)
        async with self._http.stream("POST", self._url, json=payload, headers=self._headers, timeout=None) as response:
            async for chunk in response.aiter_bytes():
                body += chunk
                if len(body) > MAX_ANSWER_BYTES:
                    break
        return response.status_code, response.headers, bytes(body)

    def _payload(self, request: ModelRequest) -> dict[str, Any]:
        messages = [{"role": message.role.value, "content": message.text} for message in request.messages]
        payload: dict[str, Any] = {"model": self._model, "temperature": 0, "max_tokens": request.max_tokens}
        if self._rung is Rung.SCHEMA:
            named = {"name": request.schema_name, "strict": True, "schema": dict(request.schema)}
            payload["response_format"] = {"type": "json_schema", "json_schema": named}
        else:
            reminder = render("json_reminder", schema=json.dumps(request.schema, separators=(",", ":")))
            messages[-1] = {**messages[-1], "content": f"{messages[-1]['content']}\n\n{reminder}"}
        if self._rung is Rung.JSON_MODE:
            payload["response_format"] = {"type": "json_object"}
        return {**payload, "messages": messages}

    @property
    def _host(self) -> str:
        return self._url.split("/")[2] if "//" in self._url else self._url


def _is_about_format(body: bytes) -> bool:
    text = body[:4000].decode("utf-8", "replace").lower()
    return any(word in text for word in ("response_format", "json_schema", "json_object", "schema", "structured"))


def _http_failure(status: int, body: bytes) -> ModelFailure:
    text = body[:2000].decode("utf-8", "replace")
    if status == httpx.codes.TOO_MANY_REQUESTS:
        return ModelFailure(
            kind=FailureKind.RATE_LIMITED, message="the server takes no more requests for now", text=text
        )
    return ModelFailure(kind=FailureKind.HTTP_ERROR, message=f"the server answered with status {status}", text=text)


def _retry_after_s(headers: Mapping[str, str]) -> float:
    """Seconds in Retry-After; zero when it is absent or a date."""
    try:
        return max(float(headers.get("retry-after", "0")), 0.0)
    except ValueError:
        return 0.0
