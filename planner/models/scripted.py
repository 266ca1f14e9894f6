"""A language model that follows a script, for tests and rehearsals: no call leaves the process."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from planner.models.extraction import json_object
from planner.models.protocol import FailureKind, ModelFailure, ModelReply, ModelRequest

Line = str | Mapping[str, Any] | ModelFailure
Script = Iterable[Line] | Callable[[ModelRequest], Line]


class ScriptedModel:
    """Answers with the lines of a script, one a call, or with what a function of the request says.

    A mapping is answered as JSON, a string as it is (and parsed as any model's text), a failure as such. After the last
    line the endpoint is down. ``requests`` keeps what was asked.
    """

    def __init__(self, script: Script, *, name: str = "scripted") -> None:
        self._speak = script if callable(script) else _in_turn(script)
        self._name = name
        self.requests: list[ModelRequest] = []

    @property
    def name(self) -> str:
        """As given."""
        return self._name

    async def complete(self, request: ModelRequest, deadline_s: float) -> ModelReply | ModelFailure:
        """The next line."""
        del deadline_s
        self.requests.append(request)
        line = self._speak(request)
        if isinstance(line, ModelFailure):
            return line
        text = line if isinstance(line, str) else json.dumps(line)
        data = json_object(text)
        if data is None:
            return ModelFailure(kind=FailureKind.MALFORMED_JSON, message="there is no JSON object in it", text=text)
        return ModelReply(data=data, text=text)


def _in_turn(script: Iterable[Line]) -> Callable[[ModelRequest], Line]:
    lines = iter(script)
    down = ModelFailure(kind=FailureKind.ENDPOINT_DOWN, message="the script is over")

    def speak(request: ModelRequest) -> Line:
        del request
        return next(lines, down)

    return speak
