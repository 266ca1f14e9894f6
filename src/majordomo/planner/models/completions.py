"""Reads a chat completion: the JSON object that the model wrote, or which way it failed."""

from __future__ import annotations

import json
from typing import Any

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from majordomo.planner.models.extraction import json_object
from majordomo.planner.models.protocol import FailureKind, ModelFailure, ModelReply


class _Message(BaseModel):
    model_config = ConfigDict(extra="ignore")
    content: str | None = None
    refusal: str | None = None


class _Choice(BaseModel):
    model_config = ConfigDict(extra="ignore")
    message: _Message
    finish_reason: str | None = None


class _Usage(BaseModel):
    model_config = ConfigDict(extra="ignore")
    prompt_tokens: int = 0
    completion_tokens: int = 0


class _Completion(BaseModel):
    model_config = ConfigDict(extra="ignore")
    choices: list[_Choice] = Field(min_length=1)
    usage: _Usage | None = None


def read_completion(body: bytes) -> ModelReply | ModelFailure:
    """The answer in the body of a chat completion."""
    raw = body.decode("utf-8", "replace")
    try:
        completion = _Completion.model_validate(json.loads(raw))
    except (json.JSONDecodeError, ValidationError, RecursionError):
        message = "the server's answer is not a chat completion"
        return ModelFailure(kind=FailureKind.WRONG_SHAPE, message=message, text=raw[:2000])
    choice, usage = completion.choices[0], completion.usage or _Usage()
    text = choice.message.content or ""
    if choice.message.refusal or choice.finish_reason == "content_filter":
        return _failure(FailureKind.REFUSAL, "the model declined to answer", choice.message.refusal or text)
    if choice.finish_reason == "length":
        return _failure(FailureKind.TRUNCATED, "the answer was cut off at the length limit", text)
    data: Any = json_object(text)
    if data is None:
        return _failure(FailureKind.MALFORMED_JSON, "the answer holds no whole JSON object", text)
    return ModelReply(
        data=data, text=text, prompt_tokens=usage.prompt_tokens, completion_tokens=usage.completion_tokens
    )


def _failure(kind: FailureKind, message: str, text: str) -> ModelFailure:
    return ModelFailure(kind=kind, message=message, text=text[:20_000])
