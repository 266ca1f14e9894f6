"""Limits on what a client may send, enforced before anything is parsed."""

from __future__ import annotations

import asyncio
import contextlib
from collections.abc import AsyncIterator

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from app.http.documents.problems import Problem, problem_response
from app.http.guards.security import is_address, is_loopback

DRAINED_BODIES = 64
DRAIN_TIMEOUT_S = 5.0
WILDCARDS = frozenset({"0.0.0.0", "::"})  # noqa: S104 - told apart, not bound to


class BodyLimit:
    """Middleware that refuses a request body over ``max_bytes`` with 413, announced or not."""

    def __init__(self, app: ASGIApp, *, max_bytes: int) -> None:
        self._app = app
        self._max_bytes = max_bytes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        try:
            body = await self._read(receive) if _announced_bytes(scope) <= self._max_bytes else None
        except _ClientLeft:
            return
        if body is None:
            problem = Problem(413, "request_too_large", f"a request may have at most {self._max_bytes} bytes")
            await problem_response(problem)(scope, receive, send)
            await self._drain(receive)
        else:
            await self._app(scope, _replay(body, receive), send)

    async def _read(self, receive: Receive) -> bytes | None:
        """The whole body, or ``None`` as soon as it is too large."""
        body = bytearray()
        async for piece in _pieces(receive):
            body += piece
            if len(body) > self._max_bytes:
                return None
        return bytes(body)

    async def _drain(self, receive: Receive) -> None:
        """Take in some more of what was refused, so that a client still sending comes to read why."""
        left = DRAINED_BODIES * self._max_bytes
        with contextlib.suppress(_ClientLeft, TimeoutError):
            async with asyncio.timeout(DRAIN_TIMEOUT_S):
                async for piece in _pieces(receive):
                    left -= len(piece)
                    if left < 0:
                        return


class HostGuard:
    """Middleware that refuses requests addressed to, or coming from a page of, another host (DNS rebinding, CSRF).

    A service that listens on all addresses answers under each of them; names would let rebinding in. A page is its own
    when it comes from the host and port that the request goes to; others are in ``origins`` (``https://robot.lan``).
    """

    def __init__(self, app: ASGIApp, *, hosts: frozenset[str], origins: frozenset[str] = frozenset()) -> None:
        self._app = app
        self._hosts, self._origins = hosts, origins

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in {"http", "websocket"} or self._admits(scope):
            await self._app(scope, receive, send)
            return
        if scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 4403, "reason": "foreign host or origin"})
            return
        problem = Problem(403, "foreign_origin", "this service answers only under its own host and to its own page")
        await problem_response(problem)(scope, receive, send)

    def _admits(self, scope: Scope) -> bool:
        headers = {name.decode("latin-1").lower(): value.decode("latin-1") for name, value in scope["headers"]}
        authority = headers.get("host", "").lower()
        if not self._is_own(_host_name(authority)):
            return False
        origin = headers.get("origin", "").lower()
        return not origin or origin in self._origins or _same_place(origin.partition("://")[2], authority)

    def _is_own(self, host: str) -> bool:
        return is_loopback(host) or host in self._hosts or (bool(self._hosts & WILDCARDS) and is_address(host))


def _host_name(authority: str) -> str:
    if authority.startswith("["):
        return authority.partition("]")[0] + "]"
    return authority.partition(":")[0]


def _same_place(origin: str, authority: str) -> bool:
    """Whether a page's host and port are those of a request; this machine has several names."""
    ours, theirs = _host_name(authority), _host_name(origin)
    same_host = ours == theirs or (is_loopback(ours) and is_loopback(theirs))
    return same_host and origin.removeprefix(theirs) == authority.removeprefix(ours)


def _announced_bytes(scope: Scope) -> int:
    for name, value in scope["headers"]:
        if name.lower() == b"content-length" and value.isdigit():
            return int(value)
    return 0


class _ClientLeft(Exception):
    """The client hung up before its request was complete."""


async def _pieces(receive: Receive) -> AsyncIterator[bytes]:
    """The parts of a request's body as they come in."""
    more = True
    while more:
        message = await receive()
        if message["type"] == "http.disconnect":
            raise _ClientLeft
        yield message.get("body", b"")
        more = message.get("more_body", False)


def _replay(body: bytes, receive: Receive) -> Receive:
    sent = False

    async def replay() -> Message:
        nonlocal sent
        if sent:
            return await receive()
        sent = True
        return {"type": "http.request", "body": body, "more_body": False}

    return replay
