"""One exploration of one house, in lockstep and without camera, and what came of it."""

from __future__ import annotations

import asyncio
import contextlib
import logging
import tempfile
import time
from collections.abc import AsyncIterator, Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from app.runtime import Runtime
from app.scheduler import TICK_S, Agent
from app.settings import ClockMode, Settings
from perception.network.shipped import SHIPPED
from simulation.houses.house import House


@dataclass(frozen=True, kw_only=True)
class ExplorationLimit:
    """After how much simulated time an exploration is given up: several times as long as it takes."""

    house_s: float = 300.0
    room_s: float = 120.0
    """More for each room."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Exploration:
    """``scene``: the map as the interface shows it. ``complete``: whether the robot said by itself that it was done."""

    scene: dict[str, Any]
    complete: bool
    sim_seconds: float
    wall_seconds: float
    collisions: int


def explore_house(house: House, seed: int) -> Exploration:
    """Explore until the robot says it is done, or for far longer than that should take."""
    return asyncio.run(_explore(house, seed))


async def _explore(house: House, seed: int) -> Exploration:
    async with service_in_lockstep(house, seed) as runtime:
        started = time.monotonic()
        complete = await until_explored(runtime, house)
        wall_seconds = time.monotonic() - started
        truth = await runtime.require_robot().truth()
        return Exploration(
            scene=runtime.views.scene.document(),
            complete=complete,
            sim_seconds=runtime.now_s,
            wall_seconds=wall_seconds,
            collisions=int(truth["collisions"]),
        )


@contextlib.asynccontextmanager
async def service_in_lockstep(
    house: House,
    seed: int,
    *,
    camera: bool = False,
    model: Path = SHIPPED,
    witnesses: Callable[[Runtime], Sequence[Agent]] | None = None,
    tick_s: float = TICK_S,
) -> AsyncIterator[Runtime]:
    """A service with its robot in a house, as fast as the machine allows, forgotten afterwards.

    ``model``: file of the network that its camera looks through.
    """
    logging.getLogger("majordomo").setLevel(logging.ERROR)
    with tempfile.TemporaryDirectory(prefix="majordomo-evaluate-") as folder:
        file = Path(folder) / "house.json"
        file.write_text(house.model_dump_json(by_alias=True, exclude_none=True), encoding="utf-8")
        settings = Settings(
            house=str(file),
            seed=seed,
            clock=ClockMode.LOCKSTEP,
            speed=None,
            camera=camera,
            data=Path(folder),
            model=model,
        )
        runtime = Runtime(settings, witnesses=witnesses, tick_s=tick_s)
        async with runtime.running():
            yield runtime


def meter(runtime: Runtime) -> None:
    """Count every agent's processor time from now on, which slows all down a little."""
    for turns in runtime.turns():
        turns.metered = True


async def until_explored(runtime: Runtime, house: House, limit: ExplorationLimit = ExplorationLimit()) -> bool:
    """Wait until the robot says that it is done; false when that takes far too long."""
    limit_s = limit.house_s + limit.room_s * len(house.rooms)
    while not runtime.memory.snapshot().root.explored:
        if runtime.now_s > limit_s:
            return False
        await runtime.wait_for_change()
    return True


async def pass_time(runtime: Runtime, seconds: float) -> None:
    """Let the robot's agents go on for so many simulated seconds."""
    until_s = runtime.now_s + seconds
    while runtime.now_s < until_s:
        await runtime.wait_for_change()
