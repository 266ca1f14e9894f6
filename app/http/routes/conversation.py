"""What a client of the stream says, and what is answered: requests, stops, and refusals of everything else."""

from __future__ import annotations

import json
from typing import Any

from pydantic import ValidationError

from app.http.documents.requests import TaskRequest
from app.http.guards.rates import Budget
from app.http.guards.security import Role
from app.runtime import Runtime
from planner.errors import QueueFull

MAX_MESSAGE_CHARACTERS = 65_536
MESSAGES_PER_S, BURST = 10.0, 60.0
PATIENCE_PER_S, PATIENCE = 20.0, 200.0
"""How many messages over the rate are answered before a client is no longer listened to."""

Reply = dict[str, Any]


class TooManyMessages(Exception):
    """A client goes on sending although it is told to wait."""


class Conversation:
    """One client's side of the stream. Its stop is never too often; a viewer only listens."""

    def __init__(self, runtime: Runtime, role: Role) -> None:
        self._runtime, self._role = runtime, role
        self._budget = Budget(rate_hz=MESSAGES_PER_S, burst=BURST)
        self._patience = Budget(rate_hz=PATIENCE_PER_S, burst=PATIENCE)

    def take(self, text: str | None) -> Reply | None:
        """Carry out one message, ``None`` for one that is not text; the answer, if one is due.

        Raises:
            TooManyMessages: the client has been told to wait too often.
        """
        if text is None:
            return self._hurried() or refusal("not_text", "send JSON as text")
        if len(text) > MAX_MESSAGE_CHARACTERS:
            detail = f"a message may have at most {MAX_MESSAGE_CHARACTERS} characters"
            return self._hurried() or refusal("message_too_large", detail)
        try:
            message = json.loads(text)
        except (ValueError, RecursionError) as error:
            return self._hurried() or refusal("invalid_json", str(error))
        return self._obey(message)

    def _obey(self, message: Any) -> Reply | None:
        match message:
            case {"type": "stop"} if self._role is Role.OPERATOR:
                self._runtime.orders.stop()
                return None
            case {"type": "request", "text": str(words)} if self._role is Role.OPERATOR:
                return self._hurried() or self._submit(words)
            case {"type": "stop" | "request"} if self._role is not Role.OPERATOR:
                return self._hurried() or refusal("forbidden", "this token is a viewer's and only reads")
            case _:
                detail = 'send {"type": "request", "text": "…"} or {"type": "stop"}'
                return self._hurried() or refusal("unknown_message", detail)

    def _submit(self, words: str) -> Reply:
        try:
            request = TaskRequest(request=words)
        except ValidationError as error:
            return refusal("invalid_request", error.errors()[0]["msg"])
        try:
            return {"type": "accepted", "task": self._runtime.orders.submit(request.request).id}
        except QueueFull as full:
            return refusal("queue_full", str(full))

    def _hurried(self) -> Reply | None:
        """The refusal of a message that comes too soon after the others."""
        wait_s = self._budget.take()
        if wait_s == 0.0:
            return None
        if self._patience.take() > 0.0:
            raise TooManyMessages("too many messages in a short time")
        return refusal("rate_limited", f"too many messages in a short time; wait {wait_s:.1f} s")


def refusal(code: str, detail: str) -> Reply:
    """A problem, as the stream tells it."""
    return {"type": "problem", "code": code, "detail": detail}
