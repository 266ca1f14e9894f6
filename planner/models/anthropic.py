"""Anthropic's Messages API.

https://platform.claude.com/docs/en/api/messages and /docs/en/build-with-claude/structured-outputs
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from planner.models import reading
from planner.models.ladder import Rung, lower, spoken
from planner.models.protocol import ModelFailure, ModelReply, ModelRequest, Role

VERSION = "2023-06-01"


class _Block(reading.Body):
    type: str
    text: str = ""
    input: dict[str, Any] | None = None


class _Usage(reading.Body):
    input_tokens: int = 0
    output_tokens: int = 0


class _Answer(reading.Body):
    content: list[_Block]
    stop_reason: str | None = None
    usage: _Usage | None = None


@dataclass(frozen=True, kw_only=True)
class AnthropicWire:
    """Messages of one model. It knows no JSON mode: the middle rung makes it call a tool that takes the answer.

    No temperature is sent, since newer models refuse it.
    """

    model: str
    rung: Rung = Rung.SCHEMA

    @property
    def provider(self) -> str:
        """``anthropic``."""
        return "anthropic"

    def url(self, base_url: str) -> str:
        """``base_url`` with or without ``/v1``."""
        return f"{base_url.rstrip('/').removesuffix('/v1')}/v1/messages"

    def headers(self, key: str) -> Mapping[str, str]:
        """The key, and the version of the API."""
        return {"x-api-key": key, "anthropic-version": VERSION}

    def payload(self, request: ModelRequest) -> dict[str, Any]:
        """The body of the request."""
        messages = spoken(request, with_schema=self.rung is Rung.EXTRACTION)
        rules = [message["content"] for message in messages if message["role"] == Role.SYSTEM]
        payload: dict[str, Any] = {
            "model": self.model,
            "max_tokens": request.max_tokens,
            "messages": [message for message in messages if message["role"] != Role.SYSTEM],
        }
        if rules:
            payload["system"] = "\n\n".join(rules)
        schema, name = dict(request.schema), request.schema_name
        if self.rung is Rung.SCHEMA:
            payload["output_config"] = {"format": {"type": "json_schema", "schema": schema}}
        elif self.rung is Rung.JSON_MODE:
            payload["tools"] = [{"name": name, "description": "Takes the answer.", "input_schema": schema}]
            payload["tool_choice"] = {"type": "tool", "name": name}
        return payload

    def conceding(self, status: int, complaint: str) -> AnthropicWire | None:
        """This, one rung lower, if the server or the model does not know the format."""
        rung = lower(self.rung, status, complaint)
        return replace(self, rung=rung) if rung is not None else None

    def read(self, body: bytes) -> ModelReply | ModelFailure:
        """The answer in the body of a message."""
        answer = reading.parsed(_Answer, body, what="message of Anthropic's")
        if isinstance(answer, ModelFailure):
            return answer
        called = [json.dumps(block.input) for block in answer.content if block.input is not None]
        text = "".join(called or [block.text for block in answer.content if block.type == "text"])
        usage = answer.usage or _Usage()
        if answer.stop_reason == "refusal":
            return reading.refusal(text)
        if answer.stop_reason in {"max_tokens", "model_context_window_exceeded"}:
            return reading.truncation(text)
        return reading.reply(text, prompt_tokens=usage.input_tokens, completion_tokens=usage.output_tokens)
