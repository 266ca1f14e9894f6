"""Chat completions as OpenAI defined them and vLLM, llama.cpp, LM Studio, OpenRouter and others offer them.

https://platform.openai.com/docs/api-reference/chat
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import httpx
from pydantic import Field

from planner.models import reading
from planner.models.ladder import Rung, lower, spoken
from planner.models.protocol import ModelFailure, ModelReply, ModelRequest


class _Message(reading.Body):
    content: str | None = None
    refusal: str | None = None


class _Choice(reading.Body):
    message: _Message
    finish_reason: str | None = None


class _Usage(reading.Body):
    prompt_tokens: int = 0
    completion_tokens: int = 0


class _Completion(reading.Body):
    choices: list[_Choice] = Field(min_length=1)
    usage: _Usage | None = None


@dataclass(frozen=True, kw_only=True)
class OpenAIWire:
    """Chat completions of one model.

    ``limit_field``, ``temperature``: OpenAI's reasoning models know the length limit by another name and choose their
    temperature themselves; most other servers know only the older form, which is tried first.
    """

    model: str
    rung: Rung = Rung.SCHEMA
    limit_field: str = "max_tokens"
    temperature: bool = True

    @property
    def provider(self) -> str:
        """``openai``."""
        return "openai"

    def url(self, base_url: str) -> str:
        """``base_url`` goes up to and includes ``/v1``."""
        return f"{base_url.rstrip('/')}/chat/completions"

    def headers(self, key: str) -> Mapping[str, str]:
        """The key travels as bearer token; servers of one's own often want none."""
        return {"Authorization": f"Bearer {key}"} if key else {}

    def payload(self, request: ModelRequest) -> dict[str, Any]:
        """The body of the request."""
        messages = spoken(request, with_schema=self.rung is not Rung.SCHEMA)
        payload: dict[str, Any] = {"model": self.model, self.limit_field: request.max_tokens, "messages": messages}
        if self.temperature:
            payload["temperature"] = 0
        if self.rung is Rung.SCHEMA:
            named = {"name": request.schema_name, "strict": True, "schema": dict(request.schema)}
            payload["response_format"] = {"type": "json_schema", "json_schema": named}
        elif self.rung is Rung.JSON_MODE:
            payload["response_format"] = {"type": "json_object"}
        return payload

    def conceding(self, status: int, complaint: str) -> OpenAIWire | None:
        """This, without what the server complains about."""
        if status == httpx.codes.BAD_REQUEST:
            if self.limit_field == "max_tokens" and "max_completion_tokens" in complaint:
                return replace(self, limit_field="max_completion_tokens")
            if self.temperature and "temperature" in complaint:
                return replace(self, temperature=False)
        rung = lower(self.rung, status, complaint)
        return replace(self, rung=rung) if rung is not None else None

    def read(self, body: bytes) -> ModelReply | ModelFailure:
        """The answer in the body of a chat completion."""
        completion = reading.parsed(_Completion, body, what="chat completion")
        if isinstance(completion, ModelFailure):
            return completion
        choice, usage = completion.choices[0], completion.usage or _Usage()
        text = choice.message.content or ""
        if choice.message.refusal or choice.finish_reason == "content_filter":
            return reading.refusal(choice.message.refusal or text)
        if choice.finish_reason == "length":
            return reading.truncation(text)
        return reading.reply(text, prompt_tokens=usage.prompt_tokens, completion_tokens=usage.completion_tokens)
