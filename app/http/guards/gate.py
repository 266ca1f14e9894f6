"""The gate in front of all routes: who has no token, acts as a viewer, or comes too often is turned away here.

Whatever is not named open asks for a token, also a path that leads nowhere and a route that is added tomorrow.
"""

from __future__ import annotations

import math

from starlette.requests import HTTPConnection
from starlette.types import ASGIApp, Receive, Scope, Send

from app.http.documents.problems import Problem, problem_response
from app.http.guards.rates import Budgets
from app.http.guards.security import Access, Role, offered_token

OPEN = frozenset({"/", "/docs", "/openapi.json", "/healthz", "/readyz"})
"""The page, its documentation, yes and no: the same for everybody."""
OPEN_FOLDER = "/page/"
STREAM = "/v1/stream"
"""Lets in by itself, since its token may also come in the first message."""
STOP = "/v1/stop"
READING = frozenset({"GET", "HEAD", "OPTIONS"})
READING_POSTS = frozenset({"/v1/scene/query"})

UNAUTHORIZED = Problem(
    401,
    "unauthorized",
    "a valid bearer token is needed; it is in the address printed at start",
    headers={"WWW-Authenticate": "Bearer"},
)
FORBIDDEN = Problem(403, "forbidden", "this token is a viewer's and only reads; an operator's token is needed")


class Gate:
    """Middleware that lets a call through with a token of the role it needs, and as often as ``budgets`` allow.

    The operator's stop is never too often.
    """

    def __init__(self, app: ASGIApp, *, access: Access, budgets: Budgets) -> None:
        self._app, self._access, self._budgets = app, access, budgets

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        if scope["type"] not in {"http", "websocket"}:
            await self._app(scope, receive, send)
            return
        refusal = self._refusal(scope)
        if refusal is None:
            await self._app(scope, receive, send)
        elif scope["type"] == "websocket":
            await receive()
            await send({"type": "websocket.close", "code": 4401, "reason": "a valid token is needed"})
        else:
            await problem_response(refusal)(scope, receive, send)

    def _refusal(self, scope: Scope) -> Problem | None:
        """Why a call is turned away, ``None`` if it is not."""
        path = scope["path"]
        if path in OPEN or path.startswith(OPEN_FOLDER) or (path == STREAM and scope["type"] == "websocket"):
            return None
        role = self._access.role_of(offered_token(HTTPConnection(scope)))
        if not (path == STOP and role is Role.OPERATOR):
            wait_s = self._budgets.take(((scope.get("client") or ("",))[0], role))
            if wait_s > 0.0:
                return too_often(wait_s)
        if role is None:
            return UNAUTHORIZED
        needed = needed_role(scope.get("method", "GET"), path)
        return FORBIDDEN if role is Role.VIEWER and needed is Role.OPERATOR else None


def needed_role(method: str, path: str) -> Role:
    """Who may make a call: what changes nothing is for viewers too."""
    return Role.VIEWER if method in READING or path in READING_POSTS else Role.OPERATOR


def too_often(wait_s: float) -> Problem:
    """The refusal of a call that came too soon."""
    seconds = max(1, math.ceil(wait_s))
    detail = f"too many calls in a short time; come back in {seconds} s"
    return Problem(429, "rate_limited", detail, headers={"Retry-After": str(seconds)})
