"""What the planner asks of a language model, and what comes back: a reply, or one of a closed set of failures."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Protocol


class Role(StrEnum):
    """Who speaks a message."""

    SYSTEM = "system"
    USER = "user"
    ASSISTANT = "assistant"


@dataclass(frozen=True, kw_only=True)
class Message:
    """One message of a conversation."""

    role: Role
    text: str


@dataclass(frozen=True, kw_only=True)
class ModelRequest:
    """A conversation that shall end in one JSON object that matches ``schema``."""

    messages: tuple[Message, ...]
    schema: Mapping[str, Any]
    schema_name: str = "answer"
    max_tokens: int = 1024


@dataclass(frozen=True, kw_only=True)
class ModelReply:
    """A JSON object; that it matches the schema is still to be checked. ``text`` is the raw answer."""

    data: Mapping[str, Any]
    text: str
    prompt_tokens: int = 0
    completion_tokens: int = 0
    attempts: int = 1


class FailureKind(StrEnum):
    """Closed set of ways in which a language model fails."""

    ENDPOINT_DOWN = "endpoint_down"
    SERVER_ERROR = "server_error"
    HTTP_ERROR = "http_error"
    RATE_LIMITED = "rate_limited"
    TIMEOUT = "timeout"
    RESTING = "resting"
    PROMPT_TOO_LONG = "prompt_too_long"
    REFUSAL = "refusal"
    TRUNCATED = "truncated"
    MALFORMED_JSON = "malformed_json"
    WRONG_SHAPE = "wrong_shape"
    UNKNOWN_IDENTIFIER = "unknown_identifier"


CORRECTABLE = frozenset(
    {FailureKind.TRUNCATED, FailureKind.MALFORMED_JSON, FailureKind.WRONG_SHAPE, FailureKind.UNKNOWN_IDENTIFIER}
)
"""Failures of the answer, which another round may mend; the others are failures of the service."""

OUTAGES = frozenset({FailureKind.ENDPOINT_DOWN, FailureKind.SERVER_ERROR, FailureKind.TIMEOUT})
"""Failures after which the next request would most likely fail as well."""


@dataclass(frozen=True, kw_only=True)
class ModelFailure:
    """Why there is no usable answer, in one sentence for a person; ``text`` is the raw answer, if there was one.

    ``wait_s``: how long the server asked to be left alone, zero when it did not.
    """

    kind: FailureKind
    message: str
    text: str = ""
    attempts: int = 1
    wait_s: float = 0.0


class LanguageModel(Protocol):
    """Anything that answers a conversation with a JSON object."""

    @property
    def name(self) -> str:
        """How people call it: ``openai:gpt-4o-mini``."""
        ...

    async def complete(self, request: ModelRequest, deadline_s: float) -> ModelReply | ModelFailure:
        """Answer within ``deadline_s`` seconds from now, retries included. Never raises for what the service does."""
        ...
