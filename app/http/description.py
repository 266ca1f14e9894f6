"""The OpenAPI document: what the routes say about themselves, and what goes for all of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from fastapi import FastAPI
from pydantic import BaseModel

from app.http.documents.codes import PROBLEM_SCHEMA, SCHEMA_NAME
from app.http.guards.gate import needed_role

ABOUT = """Ask a robot for something; it plans, acts, checks, explains.

**Token.** Every call needs `Authorization: Bearer TOKEN`. The operator's token is in the address that is printed at
start, and in the file `token` of the data folder; the one in `viewer-token` only reads. It may also come as the query
parameter `token`.

**Problems.** Every refusal is `application/problem+json` with a stable `code`. 401, 403, 413 and 429 may come from any
call that needs a token; 429 says in `Retry-After` when to come back, and never meets `POST /v1/stop`. 422: the request
is not as this document says. 404: it names something that is not there. 409: it does not fit the state of things.

**Frames and units.** Meters, radians, seconds of the robot's clock. Positions are in the map: origin where the robot
started, x forward, z up.

**Stream.** `WS /v1/stream?since=SEQ` sends `{"seq", "type", "stamp_s", "data"}` with types `snapshot` (first,
unless `since` is known), `scene`, `task`, `robot`, `perception` and `log`; numbers count up without gap, and who reads
too slowly gets a new snapshot. It takes `{"type": "request", "text": "..."}` and `{"type": "stop"}`; the token comes as
query, header or first message, `{"token": "..."}`. Codes at its end: 4401 no valid token, 1013 too many clients,
1008 too many messages, 1009 too long a message.
"""

TAGS = [
    {"name": "tasks", "description": "Requests, from their words to a confirmed outcome, and the stop."},
    {"name": "scene", "description": "What the robot knows of the building, and teaching it."},
    {"name": "status", "description": "What it is doing, and figures."},
    {"name": "simulation", "description": "For scoring, with `--simulation-api`."},
    {"name": "health", "description": "Yes or no, without a token."},
]


def shows(model: type[BaseModel], example: Mapping[str, Any] | None = None, status: int = 200, **more: Any) -> Any:
    """The response of a call that goes well, as the documentation shows it."""
    content = {} if example is None else {"content": {"application/json": {"example": example}}}
    return {status: {"model": model, **content, **more}}


def shows_media(media_type: str, description: str, schema: Mapping[str, Any] | None = None) -> Any:
    """The same for what is no JSON."""
    return {200: {"description": description, "content": {media_type: {"schema": schema or {"type": "string"}}}}}


def describe(app: FastAPI) -> None:
    """Complete the document with the schema that all problems share, and with the role that each call needs."""
    plain = app.openapi

    def openapi() -> dict[str, Any]:
        fresh = app.openapi_schema is None
        document = plain()
        if fresh:
            _complete(document)
        return document

    app.openapi = openapi  # type: ignore[method-assign]


def _complete(document: dict[str, Any]) -> None:
    schemas = document["components"]["schemas"]
    schemas[SCHEMA_NAME] = dict(PROBLEM_SCHEMA)
    for unused in ("HTTPValidationError", "ValidationError"):
        schemas.pop(unused, None)
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            if "application/json" in operation["responses"].get("422", {}).get("content", {}):
                del operation["responses"]["422"]  # the framework's own; no value of such a parameter is wrong
            if "security" in operation:
                operation["x-role"] = needed_role(method.upper(), path).value
