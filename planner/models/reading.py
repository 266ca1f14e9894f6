"""What reading an answer has in common among providers: its shape, the JSON object in its text, the ways it failed."""

from __future__ import annotations

import json
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict

from planner.models.extraction import json_object
from planner.models.protocol import FailureKind, ModelFailure, ModelReply


class Body(BaseModel):
    """A part of an answer; fields that we do not know are passed over."""

    model_config = ConfigDict(extra="ignore")


Shape = TypeVar("Shape", bound=Body)


def parsed(shape: type[Shape], body: bytes, *, what: str) -> Shape | ModelFailure:
    """The body of an answer in its shape, or that it is no ``what``."""
    raw = body.decode("utf-8", "replace")
    try:
        return shape.model_validate(json.loads(raw))
    except (ValueError, RecursionError):
        return ModelFailure(
            kind=FailureKind.WRONG_SHAPE, message=f"the server's answer is not a {what}", text=raw[:2000]
        )


def reply(text: str, *, prompt_tokens: int, completion_tokens: int) -> ModelReply | ModelFailure:
    """The JSON object in the text that a model wrote."""
    data: Any = json_object(text)
    if data is None:
        return _failure(FailureKind.MALFORMED_JSON, "the answer holds no whole JSON object", text)
    return ModelReply(data=data, text=text, prompt_tokens=prompt_tokens, completion_tokens=completion_tokens)


def refusal(text: str) -> ModelFailure:
    """The model would not answer."""
    return _failure(FailureKind.REFUSAL, "the model declined to answer", text)


def truncation(text: str) -> ModelFailure:
    """The model had more to say than it may."""
    return _failure(FailureKind.TRUNCATED, "the answer was cut off at the length limit", text)


def _failure(kind: FailureKind, message: str, text: str) -> ModelFailure:
    return ModelFailure(kind=kind, message=message, text=text[:20_000])
