"""Ollama's own chat API, which, unlike its OpenAI-compatible one, lets a request set the context length.

https://github.com/ollama/ollama/blob/main/docs/api.md#generate-a-chat-completion
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from planner.models import reading
from planner.models.budget import tokens_needed
from planner.models.ladder import Rung, lower, spoken
from planner.models.protocol import ModelFailure, ModelReply, ModelRequest

KEEP_ALIVE = "30m"
"""Loading a model takes longer than most answers, and requests come with long pauses."""


class _Message(reading.Body):
    content: str


class _Chat(reading.Body):
    message: _Message
    done_reason: str | None = None
    prompt_eval_count: int = 0
    eval_count: int = 0


@dataclass(frozen=True, kw_only=True)
class OllamaWire:
    """Chats with one model; ``context_tokens`` is the longest context that is asked for,
    ``least_context_tokens`` the shortest: most prompts fit in it, so that the model is seldom loaded anew.
    """

    model: str
    context_tokens: int
    least_context_tokens: int = 8192
    rung: Rung = Rung.SCHEMA

    @property
    def provider(self) -> str:
        """``ollama``."""
        return "ollama"

    def url(self, base_url: str) -> str:
        """``base_url`` is the server's; its OpenAI-compatible ``/v1`` is taken for it."""
        return f"{base_url.rstrip('/').removesuffix('/v1').removesuffix('/api')}/api/chat"

    def headers(self, key: str) -> Mapping[str, str]:
        """A key is needed by proxies and by ollama.com only."""
        return {"Authorization": f"Bearer {key}"} if key else {}

    def payload(self, request: ModelRequest) -> dict[str, Any]:
        """The body of the request.

        By default, Ollama drops the beginning of a prompt that is longer than 4096 tokens and says nothing, hence
        ``num_ctx`` and ``truncate``. Models that think would put everything into another field of the answer, hence
        ``think``.
        """
        options = {"temperature": 0, "num_predict": request.max_tokens, "num_ctx": self._context(request)}
        payload: dict[str, Any] = {
            "model": self.model,
            "messages": spoken(request, with_schema=self.rung is not Rung.SCHEMA),
            "stream": False,
            "think": False,
            "truncate": False,
            "shift": False,
            "keep_alive": KEEP_ALIVE,
            "options": options,
        }
        if self.rung is Rung.SCHEMA:
            payload["format"] = dict(request.schema)
        elif self.rung is Rung.JSON_MODE:
            payload["format"] = "json"
        return payload

    def conceding(self, status: int, complaint: str) -> OllamaWire | None:
        """This, one rung lower, if the server does not know the format."""
        rung = lower(self.rung, status, complaint)
        return replace(self, rung=rung) if rung is not None else None

    def read(self, body: bytes) -> ModelReply | ModelFailure:
        """The answer in the body of a chat. Ollama has no word for refusals: they are prose without JSON."""
        chat = reading.parsed(_Chat, body, what="chat of Ollama's")
        if isinstance(chat, ModelFailure):
            return chat
        if chat.done_reason == "length":
            return reading.truncation(chat.message.content)
        return reading.reply(
            chat.message.content, prompt_tokens=chat.prompt_eval_count, completion_tokens=chat.eval_count
        )

    def _context(self, request: ModelRequest) -> int:
        """A power of two, since a model is loaded anew whenever the context length changes."""
        length = self.least_context_tokens
        while length < tokens_needed(request):
            length *= 2
        return min(length, self.context_tokens)
