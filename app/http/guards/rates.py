"""How often somebody may come: budgets that fill up again with time."""

from __future__ import annotations

import time
from collections import OrderedDict
from collections.abc import Callable, Hashable

KEEP = 1024
"""Budgets that are remembered; who has not come for longest begins with a full one again."""


class Budget:
    """Room for ``burst`` calls at once and ``rate_hz`` of them a second in the long run (a token bucket).

    Args:
        clock: seconds, monotonic.
    """

    def __init__(self, *, rate_hz: float, burst: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate_hz, self._burst, self._clock = rate_hz, burst, clock
        self._left, self._then_s = burst, clock()

    def take(self) -> float:
        """Take room for one call; zero, or without room the seconds until there is some."""
        now_s = self._clock()
        self._left = min(self._burst, self._left + (now_s - self._then_s) * self._rate_hz)
        self._then_s = now_s
        if self._left < 1.0:
            return (1.0 - self._left) / self._rate_hz
        self._left -= 1.0
        return 0.0


class Budgets:
    """A budget for each caller, all of the same size."""

    def __init__(self, *, rate_hz: float, burst: float, clock: Callable[[], float] = time.monotonic) -> None:
        self._rate_hz, self._burst, self._clock = rate_hz, burst, clock
        self._of: OrderedDict[Hashable, Budget] = OrderedDict()

    def take(self, caller: Hashable) -> float:
        """Take room for one call of ``caller``; zero, or without room the seconds until there is some."""
        budget = self._of.get(caller)
        if budget is None:
            budget = self._of[caller] = Budget(rate_hz=self._rate_hz, burst=self._burst, clock=self._clock)
        self._of.move_to_end(caller)
        while len(self._of) > KEEP:
            self._of.popitem(last=False)
        return budget.take()
