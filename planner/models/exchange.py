"""One HTTP exchange with a model's server: retries within a deadline, and what the server asks for in the meantime."""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Awaitable, Callable, Mapping
from dataclasses import dataclass, replace
from email.utils import parsedate_to_datetime
from typing import Any

import httpx

from planner.models.protocol import FailureKind, ModelFailure

PASSING = frozenset({FailureKind.ENDPOINT_DOWN, FailureKind.SERVER_ERROR, FailureKind.RATE_LIMITED})
RETRIED_STATUSES = frozenset({408, 409, 425, 429, 500, 502, 503, 504, 529})


@dataclass(frozen=True, kw_only=True)
class ExchangeSettings:
    """How often and how long a server is asked."""

    attempts: int = 3
    """In all. Chosen: what passes has mostly passed by then."""
    wait_s: float = 0.5
    """Before the second attempt; doubled for each after it, unless the server names a longer one (Retry-After)."""
    longest_wait_s: float = 20.0
    """A server that wants to be left alone for longer is not waited for. Chosen: half of what a request may take."""
    connect_s: float = 5.0
    """How long it may take to be connected. Chosen: a server that is there answers in less."""
    most_bytes: int = 2_000_000
    """Of an answer; a longer one is not read to its end. Chosen: a thousand times a plan."""
    error_within_bytes: int = 10_000
    """An error is told in the first so many bytes. Chosen: servers tell it in hundreds."""


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What came back and is not worth another attempt."""

    status: int
    body: bytes
    attempts: int = 1

    @property
    def text(self) -> str:
        """The beginning of the body, for people and journals."""
        return self.body[:4000].decode("utf-8", "replace")


class Exchange:
    """Posts JSON to one address.

    Args:
        http: client to use; its lifetime is the caller's.
        clock: seconds, monotonic.
    """

    def __init__(
        self,
        url: str,
        *,
        headers: Mapping[str, str],
        http: httpx.AsyncClient,
        settings: ExchangeSettings = ExchangeSettings(),
        clock: Callable[[], float] = time.monotonic,
        sleep: Callable[[float], Awaitable[None]] = asyncio.sleep,
    ) -> None:
        self._url, self._http, self._settings, self._clock, self._sleep = url, http, settings, clock, sleep
        self._headers = {**headers, "Content-Type": "application/json"}

    async def post(self, payload: Mapping[str, Any], deadline_s: float) -> Answer | ModelFailure:
        """The answer within ``deadline_s`` seconds, retries and waits included."""
        try:
            async with asyncio.timeout(max(deadline_s, 0.0)):
                return await self._with_retries(json.dumps(payload).encode(), self._clock() + deadline_s)
        except TimeoutError:
            return ModelFailure(kind=FailureKind.TIMEOUT, message=f"no answer within {deadline_s:.0f} s")

    async def _with_retries(self, content: bytes, end_s: float) -> Answer | ModelFailure:
        attempt = 1
        while True:
            outcome = replace(await self._once(content), attempts=attempt)
            if isinstance(outcome, Answer) or outcome.kind not in PASSING or attempt == self._settings.attempts:
                return outcome
            pause_s = max(outcome.wait_s, self._settings.wait_s * 2 ** (attempt - 1))
            if pause_s > self._settings.longest_wait_s or self._clock() + pause_s >= end_s:
                return outcome
            await self._sleep(pause_s)
            attempt += 1

    async def _once(self, content: bytes) -> Answer | ModelFailure:
        try:
            status, headers, body = await self._send(content)
        except (httpx.RequestError, httpx.InvalidURL) as error:
            message = f"the server at {host_of(self._url)} cannot be reached ({type(error).__name__})"
            return ModelFailure(kind=FailureKind.ENDPOINT_DOWN, message=message)
        if len(body) > self._settings.most_bytes:
            message = f"the server's answer is longer than {self._settings.most_bytes // 1_000_000} MB"
            return ModelFailure(
                kind=FailureKind.WRONG_SHAPE, message=message, text=body[:2000].decode(errors="replace")
            )
        if status == httpx.codes.OK:
            status = status_within(body, self._settings.error_within_bytes) or status
        answer = Answer(status=status, body=body)
        return _passing_failure(answer, _retry_after_s(headers)) if status in RETRIED_STATUSES else answer

    async def _send(self, content: bytes) -> tuple[int, Mapping[str, str], bytes]:
        body, timeout = bytearray(), httpx.Timeout(None, connect=self._settings.connect_s)
        sending = self._http.stream("POST", self._url, content=content, headers=self._headers, timeout=timeout)
        async with sending as response:
            async for chunk in response.aiter_bytes():
                body += chunk
                if len(body) > self._settings.most_bytes:
                    break
        return response.status_code, response.headers, bytes(body)


def status_within(body: bytes, within: int = ExchangeSettings.error_within_bytes) -> int | None:
    """The status that an error in the body stands for: gateways report some under the status of a success, ``{"error":
    {"code": 429, …}}``. ``None`` when there is no error; one without a code is taken for a fault of the server.
    ``within``: the first so many bytes.
    """
    if b'"error"' not in body[:within]:
        return None
    try:
        document = json.loads(body)
    except (ValueError, RecursionError):
        return None
    error = document.get("error") if isinstance(document, dict) else None
    if not error:
        return None
    code = error.get("code") if isinstance(error, dict) else None
    known = isinstance(code, int) and 400 <= code < 600
    return code if known else int(httpx.codes.BAD_GATEWAY)


def host_of(url: str) -> str:
    """Host and port of an address, without what may be a password."""
    return url.partition("//")[2].partition("/")[0].rpartition("@")[2] or url


def _passing_failure(answer: Answer, wait_s: float) -> ModelFailure:
    asks = f" and wants to be left alone for {wait_s:.0f} s" if wait_s else ""
    if answer.status == httpx.codes.TOO_MANY_REQUESTS:
        kind, message = FailureKind.RATE_LIMITED, f"the server takes no more requests for now{asks}"
    else:
        kind, message = FailureKind.SERVER_ERROR, f"the server answered with status {answer.status}{asks}"
    return ModelFailure(kind=kind, message=message, text=answer.text, wait_s=wait_s)


def _retry_after_s(headers: Mapping[str, str]) -> float:
    """Seconds in Retry-After, which may be a date, told by the server's own clock; zero when it cannot be read."""
    wanted = headers.get("retry-after", "")
    if wanted.isdecimal():
        return float(wanted[:9])
    try:
        span = parsedate_to_datetime(wanted) - parsedate_to_datetime(headers.get("date", ""))
    except (TypeError, ValueError):
        return 0.0
    return max(span.total_seconds(), 0.0)
