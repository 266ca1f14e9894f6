"""The stable codes of problem documents: which status each comes with, and what it means to a caller.

422 is for what is not as the document of the interface says, 404 for the name of nothing that is there, 409 for what
does not fit the state of things.
"""

from __future__ import annotations

import http
from collections.abc import Mapping
from types import MappingProxyType
from typing import Any

SCHEMA_NAME = "ProblemDocument"

CODES: Mapping[str, Mapping[int, str]] = MappingProxyType(
    {
        "unauthorized": {401: "There is no token, or a wrong one."},
        "forbidden": {403: "The token is a viewer's, and the call would change something."},
        "foreign_origin": {403: "The call names another host, or comes from another host's page."},
        "not_found": {404: "There is no such path."},
        "task_not_found": {404: "There is no such task, or it ended so long ago that it was forgotten."},
        "node_not_found": {404: "The graph has no such node."},
        "no_path": {404: "No open way is known between the two nodes."},
        "no_camera": {404: "The camera is off, or has not shown anything yet."},
        "frame_gone": {404: "The frame of this time is no longer kept."},
        "method_not_allowed": {405: "The path is there, but not for this method."},
        "not_allowed_now": {409: "It does not fit the state of things; the detail says what does."},
        "plan_changed": {409: "The plan that was approved is no longer the task's; look at the new one."},
        "not_teachable": {409: "This node takes no such name, label or region."},
        "idempotency_key_reused": {409: "The key came with another request before."},
        "invalid_disturbance": {409: "Nothing of the kind can happen in this house as it is now."},
        "request_too_large": {413: "The body has more bytes than are read."},
        "invalid_request": {422: "A field is missing, unknown, or of a wrong kind; `fields` lists them."},
        "unknown_layer": {422: "There is no such node type."},
        "invalid_query": {
            404: "The query names an unknown room or region.",
            422: "The query names an unknown type, attribute or order, or not one thing to be near to.",
        },
        "rate_limited": {429: "Too many calls in a short time; `Retry-After` says when to come back."},
        "queue_full": {429: "Too many tasks are open."},
        "internal_error": {500: "A fault of the service, which its log describes."},
        "not_ready": {503: "The service is starting, or has lost its robot."},
        "robot_unavailable": {503: "There is no robot."},
        "journal_unavailable": {503: "It cannot be written down: a task is not taken, what was taught is not kept."},
        "simulator_unavailable": {503: "The simulator is not running."},
    }
)
GUARDED = ("unauthorized", "forbidden", "foreign_origin", "request_too_large", "rate_limited")
"""What any call that needs a token may meet."""
OPEN_TO_ALL = ("foreign_origin", "request_too_large")
"""What any other call may meet."""

PROBLEM_SCHEMA: Mapping[str, Any] = MappingProxyType(
    {
        "title": SCHEMA_NAME,
        "description": "Why a call was refused (RFC 9457). `code` is stable; `detail` is for people.",
        "type": "object",
        "required": ["type", "title", "status", "code", "detail"],
        "properties": {
            "type": {"type": "string", "description": "`urn:majordomo:problem:` and the code."},
            "title": {"type": "string"},
            "status": {"type": "integer"},
            "code": {"type": "string", "enum": list(CODES)},
            "detail": {"type": "string"},
            "fields": {
                "type": "array",
                "description": "With `invalid_request`: what is wrong with which field.",
                "items": {
                    "type": "object",
                    "required": ["field", "message"],
                    "properties": {"field": {"type": "string"}, "message": {"type": "string"}},
                },
            },
        },
    }
)


def told(*codes: str) -> dict[int | str, dict[str, Any]]:
    """The responses that these codes come with, as the documentation shows them."""
    responses: dict[int | str, dict[str, Any]] = {}
    met = [(code, status, meaning) for code in codes for status, meaning in CODES[code].items()]
    for code, status, meaning in met:
        response = responses.setdefault(status, {"description": "", "content": {}})
        response["description"] = " ".join(filter(None, (response["description"], f"`{code}`: {meaning}")))
        content = response["content"].setdefault("application/problem+json", _content())
        content["examples"][code] = {"value": _example(code, status, meaning)}
        if status == 429:
            response["headers"] = {"Retry-After": {"description": "Seconds.", "schema": {"type": "integer"}}}
    return responses


def _content() -> dict[str, Any]:
    return {"schema": {"$ref": f"#/components/schemas/{SCHEMA_NAME}"}, "examples": {}}


def _example(code: str, status: int, meaning: str) -> dict[str, Any]:
    title = http.HTTPStatus(status).phrase
    return {
        "type": f"urn:majordomo:problem:{code}",
        "title": title,
        "status": status,
        "code": code,
        "detail": meaning.replace("`", ""),
    }
