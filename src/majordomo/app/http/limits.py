"""Limits on what a client may send, enforced before anything is parsed."""

from __future__ import annotations

from starlette.types import ASGIApp, Message, Receive, Scope, Send

from majordomo.app.http.problems import Problem, problem_response
from majordomo.app.http.security import is_loopback


class BodyLimit:
    """Middleware that refuses a request body over ``max_bytes`` with 413, announced or not."""

    def __init__(self, app: ASGIApp, *, max_bytes: int) -> None:
        self._app = app
        self._max_bytes = max_bytes

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        body = await self._read(receive) if _announced_bytes(scope) <= self._max_bytes else None
        if body is None:
            problem = Problem(413, "request_too_large", f"a request may have at most {self._max_bytes} bytes")
            await problem_response(problem)(scope, receive, send)
        else:
            await self._app(scope, _replay(body, receive), send)

    async def _read(self, receive: Receive) -> bytes | None:
        """The whole body, or ``None`` as soon as it is too large."""
        body = bytearray()
        more = True
        while more:
            message = await receive()
            body += message.get("body", b"")
            more = message.get("more_body", False)
            if len(body) > self._max_bytes:
                return None
        return bytes(body)


class HostGuard:
    """Middleware that refuses requests addressed to, or coming from a page of, another host (DNS rebinding, CSRF)."""

    def __init__(self, app: ASGIApp, *, hosts: frozenset[str]) -> None:
        self._app = app
        self._hosts = hosts

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
        host = _host_name(headers.get("host", ""))
        if not self._is_own(host):
            return False
        origin = headers.get("origin")
        return origin is None or self._is_own(_host_name(origin.partition("://")[2]))

    def _is_own(self, host: str) -> bool:
        return is_loopback(host) or host in self._hosts


def _host_name(authority: str) -> str:
    if authority.startswith("["):
        return authority.partition("]")[0] + "]"
    return authority.partition(":")[0].lower()


def _announced_bytes(scope: Scope) -> int:
    for name, value in scope["headers"]:
        if name.lower() == b"content-length" and value.isdigit():
            return int(value)
    return 0


def _replay(body: bytes, receive: Receive) -> Receive:
    sent = False

    async def replay() -> Message:
        nonlocal sent
        if sent:
            return await receive()
        sent = True
        return {"type": "http.request", "body": body, "more_body": False}

    return replay
