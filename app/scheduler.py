"""Two ways to give agents their turns: in lockstep with simulated time, or each at its own rate in real time."""

from __future__ import annotations

import asyncio
import logging
import time
from collections import deque
from collections.abc import Awaitable, Callable, Sequence
from dataclasses import dataclass, field
from typing import Protocol

import numpy as np

logger = logging.getLogger(__name__)

TICK_S = 0.05
"""How finely simulated time is cut in lockstep, seconds."""
BUSY_WINDOW = 512
"""Steps over which an agent's busy time is summarized."""


class Agent(Protocol):
    """Something that gets a turn every ``period_s`` seconds of the robot's clock; it owns no task and never sleeps."""

    name: str
    period_s: float

    async def step(self, stamp_s: float) -> None:
        """One turn at robot time ``stamp_s``."""
        ...


@dataclass(kw_only=True)
class Turns:
    """Account of one agent's turns. ``fatal``: errors that end the scheduler instead of being survived.

    ``cpu_s``: processor time that the process used during its turns, once ``metered`` is set. In lockstep nobody else
    uses any meanwhile; in real time it would tell nothing. With many threads it takes up to half a millisecond to read.
    ``taken``: how many turns so far. ``longest_wait_s``: wall seconds between the starts of two successive ones.
    """

    agent: Agent
    fatal: tuple[type[Exception], ...] = ()
    metered: bool = False
    due_s: float = 0.0
    busy_ms: deque[float] = field(default_factory=lambda: deque(maxlen=BUSY_WINDOW))
    stamps_s: deque[float] = field(default_factory=lambda: deque(maxlen=64))
    restarts: int = 0
    last_error: str = ""
    cpu_s: float = 0.0
    taken: int = 0
    longest_wait_s: float = 0.0
    _taken_at_s: float | None = None

    async def take(self, stamp_s: float) -> None:
        """Give the agent its turn; an unexpected error is logged and counted, and the agent goes on."""
        started, cpu_started_s = time.perf_counter(), time.process_time() if self.metered else None
        self.stamps_s.append(stamp_s)
        self.taken += 1
        if self._taken_at_s is not None:
            self.longest_wait_s = max(self.longest_wait_s, started - self._taken_at_s)
        self._taken_at_s = started
        try:
            await self.agent.step(stamp_s)
        except self.fatal:
            raise
        except Exception as error:
            self.restarts += 1
            self.last_error = f"{type(error).__name__}: {error}"
            logger.exception("agent %s failed and goes on", self.agent.name, extra={"agent": self.agent.name})
        self.busy_ms.append(1000.0 * (time.perf_counter() - started))
        if cpu_started_s is not None:
            self.cpu_s += time.process_time() - cpu_started_s

    def summary(self) -> dict[str, float | int]:
        """Rate and busy time as ``GET /v1/status`` shows them."""
        stamps = self.stamps_s
        span_s = stamps[-1] - stamps[0] if len(stamps) > 1 else 0.0
        busy = np.asarray(self.busy_ms) if self.busy_ms else np.zeros(1)
        return {
            "rate_hz": round((len(stamps) - 1) / span_s, 2) if span_s > 0 else 0.0,
            "busy_ms_p50": round(float(np.percentile(busy, 50)), 2),
            "busy_ms_p99": round(float(np.percentile(busy, 99)), 2),
            "restarts": self.restarts,
        }


class Scheduler(Protocol):
    """Runs agents until cancelled."""

    @property
    def turns(self) -> Sequence[Turns]:
        """Account of every agent's turns."""
        ...

    @property
    def now_s(self) -> float:
        """Robot time in seconds."""
        ...

    async def run(self) -> None:
        """Give turns until cancelled, or until the robot's body is lost."""
        ...


class LockstepScheduler:
    """Advances simulated time by ``tick_s`` and gives every due agent its turn, in the order given.

    Same seed, same order, same log. ``speed`` limits simulated seconds per wall second, ``None`` does not. The event
    loop gets a breath every tick, so the API answers meanwhile.
    """

    def __init__(
        self,
        agents: Sequence[Agent],
        advance: Callable[[float], Awaitable[float]],
        *,
        tick_s: float = TICK_S,
        speed: float | None = None,
        fatal: tuple[type[Exception], ...] = (),
    ) -> None:
        self.turns: Sequence[Turns] = [Turns(agent=agent, fatal=fatal) for agent in agents]
        self._advance = advance
        self._tick_s = tick_s
        self._speed = speed
        self._now_s = 0.0

    @property
    def now_s(self) -> float:
        """Simulated time in seconds."""
        return self._now_s

    async def run(self) -> None:
        """Advance and give turns until cancelled or the simulator is lost."""
        wall_start, sim_start = time.monotonic(), self._now_s
        while True:
            await self.tick()
            ahead_s = 0.0
            if self._speed is not None:
                ahead_s = (self._now_s - sim_start) / self._speed - (time.monotonic() - wall_start)
            await asyncio.sleep(max(0.0, ahead_s))

    async def tick(self) -> None:
        """One tick of simulated time and the turns due in it."""
        self._now_s = await self._advance(self._tick_s)
        for turns in self.turns:
            if self._now_s >= turns.due_s - 1e-6:
                turns.due_s = _next_due(turns.due_s, turns.agent.period_s, self._now_s)
                await turns.take(self._now_s)


class RealTimeScheduler:
    """Gives each agent a task of its own that takes a turn every ``period_s`` of the robot's clock.

    After a turn that took too long the next comes at once, so that the rate is kept on average; what is late by more
    than a period is skipped.
    """

    def __init__(
        self,
        agents: Sequence[Agent],
        now: Callable[[], float],
        *,
        speed: float = 1.0,
        fatal: tuple[type[Exception], ...] = (),
    ) -> None:
        self.turns: Sequence[Turns] = [Turns(agent=agent, fatal=fatal) for agent in agents]
        self._now = now
        self._speed = speed

    @property
    def now_s(self) -> float:
        """Robot time in seconds."""
        return self._now()

    async def run(self) -> None:
        """Run all agents until cancelled, or until one meets a fatal error, which is raised."""
        try:
            async with asyncio.TaskGroup() as group:
                for turns in self.turns:
                    group.create_task(self._keep_turning(turns), name=f"agent {turns.agent.name}")
        except ExceptionGroup as errors:
            raise errors.exceptions[0] from None

    async def _keep_turning(self, turns: Turns) -> None:
        period_s = turns.agent.period_s / self._speed
        due = time.monotonic()
        while True:
            await turns.take(self._now())
            due = max(due + period_s, time.monotonic() - period_s)
            await asyncio.sleep(max(0.0, due - time.monotonic()))


def _next_due(due_s: float, period_s: float, now_s: float) -> float:
    """The first multiple of the period after ``now_s``; turns missed are skipped, never made up for in a burst."""
    missed = max(0, int((now_s - due_s) / period_s + 1e-6))
    return due_s + (missed + 1) * period_s
