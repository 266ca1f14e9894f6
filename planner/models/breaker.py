"""Leaves a language model alone for a while when its server is out of order, so that nobody waits for it in vain."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from datetime import UTC, datetime, timedelta

from planner.models.protocol import OUTAGES, FailureKind, LanguageModel, ModelFailure, ModelReply, ModelRequest

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class BreakerSettings:
    """After ``failures`` outages in a row the model rests; each rest is twice as long as the one before."""

    failures: int = 3
    first_rest_s: float = 30.0
    longest_rest_s: float = 600.0


def local_time() -> datetime:
    """The time of day where the robot is."""
    return datetime.now(UTC).astimezone()


class CircuitBreaker:
    """A language model that rests when its server does not answer, or when the server asks for it.

    After a rest one request is tried: an answer, even a useless one, ends the matter, another outage begins the next
    rest. Meanwhile every request fails at once.

    Args:
        place: where the model is, as people call it.
        clock: seconds, monotonic.
        time_of_day: for saying until when.
    """

    def __init__(
        self,
        model: LanguageModel,
        *,
        place: str,
        settings: BreakerSettings = BreakerSettings(),
        clock: Callable[[], float] = time.monotonic,
        time_of_day: Callable[[], datetime] = local_time,
    ) -> None:
        self._model, self._place, self._settings = model, place, settings
        self._clock, self._time_of_day = clock, time_of_day
        self._outages, self._rests, self._end_s = 0, 0, float("-inf")
        self._trying, self._complaint = False, ""

    @property
    def name(self) -> str:
        """As the model's own."""
        return self._model.name

    async def complete(self, request: ModelRequest, deadline_s: float) -> ModelReply | ModelFailure:
        """The model's answer, or at once that it rests."""
        if self._clock() < self._end_s or self._trying:
            message = f"The language model at {self._place} {self._complaint}; {self._until()}"
            return ModelFailure(kind=FailureKind.RESTING, message=message, attempts=0)
        self._trying = self._rests > 0
        try:
            return self._judged(await self._model.complete(request, deadline_s))
        finally:
            self._trying = False

    def _judged(self, outcome: ModelReply | ModelFailure) -> ModelReply | ModelFailure:
        """The outcome, and whether the model rests from now on."""
        if isinstance(outcome, ModelReply):
            self._outages = self._rests = 0
            return outcome
        if outcome.kind in OUTAGES:
            return self._after_outage(outcome)
        if outcome.kind is FailureKind.PROMPT_TOO_LONG:
            return outcome
        self._outages = self._rests = 0
        if outcome.kind is FailureKind.RATE_LIMITED and outcome.wait_s:
            return self._rest(outcome, outcome.wait_s, "takes no more requests")
        return outcome

    def _after_outage(self, failure: ModelFailure) -> ModelFailure:
        self._outages += 1
        if self._outages < self._settings.failures and not self._rests and not failure.wait_s:
            return failure
        rest_s = self._settings.first_rest_s * 2.0 ** min(self._rests, 16)
        self._rests += 1
        return self._rest(failure, max(rest_s, failure.wait_s), "does not answer")

    def _rest(self, failure: ModelFailure, rest_s: float, complaint: str) -> ModelFailure:
        rest_s = min(rest_s, self._settings.longest_rest_s)
        self._end_s, self._complaint = self._clock() + rest_s, complaint
        logger.info("the language model at %s %s and is left alone for %.0f s", self._place, complaint, rest_s)
        return replace(failure, message=f"{failure.message}; {self._until()}")

    def _until(self) -> str:
        left = timedelta(seconds=max(self._end_s - self._clock(), 0.0))
        return f"I use my own grammar until {self._time_of_day() + left:%H:%M:%S}"
