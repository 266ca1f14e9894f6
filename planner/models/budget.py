"""How many tokens a request takes, so that none is sent that a model would have to cut."""

from __future__ import annotations

import json
import math

from planner.models.protocol import FailureKind, ModelFailure, ModelRequest

BYTES_PER_TOKEN = 3.0
"""Of UTF-8. English prose has about four, identifiers and JSON, of which our prompts are full, fewer than three and a
half: the estimate shall rather be too high."""


def tokens_needed(request: ModelRequest) -> int:
    """Estimated tokens of prompt, schema and the longest answer."""
    texts = [message.text for message in request.messages] + [json.dumps(request.schema, separators=(",", ":"))]
    size = sum(len(text.encode("utf-8", "replace")) for text in texts)
    return math.ceil(size / BYTES_PER_TOKEN) + request.max_tokens


def over_budget(request: ModelRequest, context_tokens: int) -> ModelFailure | None:
    """Why the request is not sent, ``None`` when it fits into ``context_tokens``."""
    needed = tokens_needed(request)
    if needed <= context_tokens:
        return None
    message = f"what it would have to read is about {needed} tokens long, and it takes {context_tokens}"
    return ModelFailure(kind=FailureKind.PROMPT_TOO_LONG, message=message, attempts=0)
