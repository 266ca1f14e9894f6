"""``evaluate rates``: does the service keep up with its sensors, and does every agent get its turn in time?

Twice, in real time, through the whole service with its API: with a drive through a known building played from memory
at 20 LiDAR revolutions and 30 RGB-D frames a second; and while exploring beside the simulator, which takes its share of
the same machine. Meanwhile a client asks the API for something ten times a second.
"""

from __future__ import annotations

import asyncio
import json
import logging
import os
import secrets
import sys
import tempfile
import time
from collections.abc import Callable, Mapping, Sequence
from contextlib import AbstractAsyncContextManager, nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

import numpy as np
from rich.console import Console
from rich.table import Table

from app.events.event_log import EventLog
from app.http.guards.security import Token
from app.runtime import Runtime
from app.scheduler import Turns
from app.server import SWITCH_INTERVAL_S, bind, serving
from app.settings import ClockMode, Settings
from app.stacks.robot import RobotStack
from evaluations.pool import run_all
from evaluations.service.latency import Answers, api_probe
from evaluations.service.replay import CAMERA_HZ, LIDAR_HZ, RecordedRobot, Recording, record
from perception.network.model import OnnxPanopticModel
from planner.models.protocol import LanguageModel
from planner.tasks.queue import TaskQueue
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ObjectNode

SPEED = 2.0
"""Recorded seconds that are played in a second."""
_SETTLE_S, _SPARE_S = 2.0, 10.0
"""So long a service runs before it is measured, and so much more than is measured is recorded."""


@dataclass(frozen=True, kw_only=True)
class RateAims:
    """What counts as keeping up with the sensors; their own rates are those of the source."""

    optimizer_hz: float = 10.0
    overdue_s: float = 1.0
    """No agent may wait so long for its turn: chosen, what a person would notice."""
    api_p99_ms: float = 50.0
    """Chosen: half of what a person feels as at once."""
    slack: float = 0.98
    """A rate counts as held from this share of it on."""


@dataclass(frozen=True, kw_only=True)
class Source:
    """Where measurements come from, and how many of each kind a second."""

    name: str
    lidar_hz: float
    rgbd_hz: float


FROM_MEMORY = Source(name="from memory", lidar_hz=SPEED * LIDAR_HZ, rgbd_hz=SPEED * CAMERA_HZ)
BESIDE_SIMULATOR = Source(name="beside the simulator", lidar_hz=10.0, rgbd_hz=5.0)


@dataclass(frozen=True, kw_only=True)
class Counts:
    """What the service has taken in so far. ``turns``: of each agent. ``cpu_s``: processor time of the process."""

    scans: int
    frames: int
    understood: int
    turns: Mapping[str, int]
    cpu_s: float = 0.0

    @classmethod
    def of(cls, runtime: Runtime) -> Counts:
        """As it is now."""
        stack = cast("RobotStack", runtime.stack)
        return cls(
            scans=stack.scans,
            frames=stack.frames,
            understood=stack.frames_understood,
            turns={one.agent.name: one.taken for one in runtime.turns()},
            cpu_s=time.process_time(),
        )

    def since(self, before: Counts) -> Counts:
        """What has come since ``before``."""
        return Counts(
            scans=self.scans - before.scans,
            frames=self.frames - before.frames,
            understood=self.understood - before.understood,
            turns={name: taken - before.turns.get(name, 0) for name, taken in self.turns.items()},
            cpu_s=self.cpu_s - before.cpu_s,
        )


def evaluate(*, house: str, seconds: float, model: Path, json_file: Path | None, console: Console) -> bool:
    """Measure both; whether all rates are held, nobody waits too long, and the API answers in time.

    Raises:
        NetworkRefused: what is wrong with the network's file, said before anything is measured.
    """
    OnnxPanopticModel.load(model)
    jobs = [(source, house, seconds, model) for source in ("replay", "simulator")]
    runs = run_all(run_once, jobs, jobs=1, console=console)
    console.print(_table(runs))
    if json_file is not None:
        document = {"cores": os.cpu_count(), "model": model.name, "runs": runs}
        json_file.parent.mkdir(parents=True, exist_ok=True)
        json_file.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    return all(run["held"] for run in runs)


def run_once(source: str, house: str, seconds: float, model: Path) -> dict[str, Any]:
    """One of the two, in this process."""
    logging.getLogger("majordomo").setLevel(logging.ERROR)
    sys.setswitchinterval(SWITCH_INTERVAL_S)
    measure = _replayed if source == "replay" else _beside_simulator
    return asyncio.run(measure(house, seconds, model))


async def _replayed(house: str, seconds: float, model: Path) -> dict[str, Any]:
    recording = await record(house, SPEED * (_SETTLE_S + seconds + _SPARE_S))
    with tempfile.TemporaryDirectory(prefix="majordomo-evaluate-") as folder:
        settings = Settings(house=house, speed=SPEED, camera_hz=CAMERA_HZ, explore=False, model=model, **_real(folder))
        return await measured(FROM_MEMORY, Runtime(settings, build=Player(recording)), seconds)


async def _beside_simulator(house: str, seconds: float, model: Path) -> dict[str, Any]:
    with tempfile.TemporaryDirectory(prefix="majordomo-evaluate-") as folder:
        settings = Settings(house=house, camera_hz=BESIDE_SIMULATOR.rgbd_hz, model=model, **_real(folder))
        return await measured(BESIDE_SIMULATOR, Runtime(settings), seconds)


def _real(folder: str) -> dict[str, Any]:
    return {"clock": ClockMode.REAL, "camera": True, "data": Path(folder), "port": 0}


class Player:
    """``BuildStack`` around a recorded robot, which knows the building from the start."""

    def __init__(self, recording: Recording) -> None:
        self._recording = recording

    async def __call__(
        self,
        settings: Settings,
        queue: TaskQueue,
        model: LanguageModel | None,
        log: EventLog,
        *,
        anew: bool = False,  # noqa: ARG002 - a recording begins where it begins
    ) -> RobotStack:
        network = await asyncio.to_thread(OnnxPanopticModel.load, settings.model)
        memory = WorkingMemory(self._recording.building, long_term=LongTermStore())
        robot = RecordedRobot(self._recording, speed=settings.speed or 1.0)
        return RobotStack(robot, settings, queue, model, log, network=network, memory=memory)


Audience = Callable[[int, str], AbstractAsyncContextManager[None]]
"""Who listens, at a port with a token, while something is measured."""


async def measured(
    source: Source, runtime: Runtime, seconds: float, audience: Audience | None = None
) -> dict[str, Any]:
    """Run a service, let it settle, and measure for so many wall seconds while its API is asked."""
    token = Token(secrets.token_urlsafe(24))
    async with api_probe() as probe:
        with bind(runtime.settings) as listener:
            async with serving(runtime, listener, token):
                while not runtime.ready:
                    await runtime.wait_for_change()
                await asyncio.sleep(_SETTLE_S)
                place = (listener.getsockname()[1], token.value)
                async with audience(*place) if audience is not None else nullcontext():
                    before, started = Counts.of(runtime), time.monotonic()
                    answers = await probe.ask(*place, seconds)
                    counts, took_s = Counts.of(runtime).since(before), time.monotonic() - started
                figures = summary(source, took_s, counts, runtime.turns(), answers, speed=runtime.settings.speed or 1.0)
                things = len(runtime.memory.building().of_type(ObjectNode))
                return {**figures, "network": runtime.views.status.document()["network"], "things": things}


def summary(
    source: Source,
    seconds: float,
    counts: Counts,
    turns: Sequence[Turns],
    answers: Answers,
    *,
    speed: float = 1.0,
    aims: RateAims = RateAims(),
) -> dict[str, Any]:
    """What was held. ``counts``: what came within ``seconds``. ``turns``: since the start.

    A turn is overdue when it comes later than a period after the one before; at ``speed``, robot seconds per wall
    second, a period is so much shorter. All seconds that are told are those on the wall.
    """
    agents = {
        one.agent.name: {
            "rate_hz": counts.turns.get(one.agent.name, 0) / seconds,
            "overdue_s": max(0.0, one.longest_wait_s - one.agent.period_s / speed),
            **{figure: value for figure, value in one.summary().items() if figure != "rate_hz"},
        }
        for one in turns
    }
    longest = max(agents, key=lambda name: agents[name]["overdue_s"])
    p50_ms, p99_ms = (float(value) for value in np.percentile(answers.latencies_ms, [50, 99]))
    figures = {
        "lidar_hz": counts.scans / seconds,
        "rgbd_hz": counts.understood / seconds,
        "optimizer_hz": agents["energy_optimizer"]["rate_hz"],
        "overdue_s": agents[longest]["overdue_s"],
        "api_p99_ms": p99_ms,
    }
    rates = {"lidar_hz": source.lidar_hz, "rgbd_hz": source.rgbd_hz, "optimizer_hz": aims.optimizer_hz}
    held = (
        all(figures[rate] >= aims.slack * aim for rate, aim in rates.items())
        and figures["overdue_s"] < aims.overdue_s
        and p99_ms < aims.api_p99_ms
        and not answers.failures
        and not any(one["restarts"] for one in agents.values())
    )
    return {
        "source": source.name,
        "seconds": seconds,
        **figures,
        "aims": rates,
        "api_p50_ms": p50_ms,
        "api_requests": len(answers.latencies_ms),
        "api_failures": list(answers.failures),
        "frames_taken_hz": counts.frames / seconds,
        "frames_skipped": max(0, counts.frames - counts.understood),
        "overdue": longest,
        "cpu_cores": counts.cpu_s / seconds,
        "restarts": sum(one["restarts"] for one in agents.values()),
        "agents": agents,
        "held": bool(held),
    }


def _table(runs: Sequence[Mapping[str, Any]], aims: RateAims = RateAims()) -> Table:
    table = Table(title=f"rates in real time on {os.cpu_count()} cores")
    table.add_column("figure")
    for run in runs:
        table.add_column(run["source"], justify="right")
        table.add_column("aim", justify="right")
    for name, rate in {"LiDAR": "lidar_hz", "RGB-D understood": "rgbd_hz", "optimizer": "optimizer_hz"}.items():
        table.add_row(
            f"{name} Hz", *(cell for run in runs for cell in (f"{run[rate]:.1f}", f"{run['aims'][rate]:.0f}"))
        )
    rows: dict[str, tuple[str, str]] = {
        "frames skipped": ("{frames_skipped}", ""),
        "longest overdue s": ("{overdue_s:.2f}", f"< {aims.overdue_s:.0f}"),
        "of agent": ("{overdue}", ""),
        "restarts": ("{restarts}", "0"),
        "cores used by the service": ("{cpu_cores:.2f}", ""),
        "API p50 ms": ("{api_p50_ms:.1f}", ""),
        "API p99 ms": ("{api_p99_ms:.1f}", f"< {aims.api_p99_ms:.0f}"),
        "API failures": ("{failures}", "0"),
    }
    for name, (shape, aim) in rows.items():
        shown = (shape.format(**run, failures=len(run["api_failures"])) for run in runs)
        table.add_row(name, *(cell for figure in shown for cell in (figure, aim)))
    return table
