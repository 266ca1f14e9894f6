"""The capability ladder: how JSON is asked for, from a schema that the server enforces down to plain asking."""

from __future__ import annotations

import json
from enum import IntEnum

from planner.models.protocol import ModelRequest
from prompts.templates import render

SHAPE_STATUSES = frozenset({400, 404, 415, 422, 501})
"""With these a server may say that it does not know the response format."""
SHAPE_WORDS = ("format", "schema", "json_object", "structured", "grammar", "output_config", "tool")


class Rung(IntEnum):
    """How structured output is asked for; the next is tried when the server knows no better."""

    SCHEMA = 0
    JSON_MODE = 1
    EXTRACTION = 2


def lower(rung: Rung, status: int, complaint: str) -> Rung | None:
    """The next rung when the complaint is about the response format, ``None`` when it is not or there is none."""
    is_about_format = status == 422 or (status in SHAPE_STATUSES and any(word in complaint for word in SHAPE_WORDS))
    return Rung(rung + 1) if is_about_format and rung is not Rung.EXTRACTION else None


def spoken(request: ModelRequest, *, with_schema: bool) -> list[dict[str, str]]:
    """The conversation as all three APIs write it; ``with_schema`` ends it with the schema and a request for JSON."""
    messages = [{"role": message.role.value, "content": message.text} for message in request.messages]
    if with_schema:
        reminder = render("json_reminder", schema=json.dumps(request.schema, separators=(",", ":")))
        messages[-1]["content"] = f"{messages[-1]['content']}\n\n{reminder}"
    return messages
