"""One exploration of one house, in lockstep and without camera, and what came of it."""

from __future__ import annotations

import asyncio
import logging
import tempfile
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from majordomo.app.runtime import Runtime
from majordomo.app.scene_documents import scene_document
from majordomo.app.settings import ClockMode, Settings
from majordomo.simulation.house import House

LIMIT_S = 300.0
LIMIT_PER_ROOM_S = 120.0


@dataclass(frozen=True, kw_only=True, eq=False)
class Exploration:
    """``scene``: the map as the interface shows it. ``complete``: whether the robot said by itself that it was done."""

    scene: dict[str, Any]
    complete: bool
    sim_seconds: float
    wall_seconds: float
    agents: dict[str, dict[str, float | int]]
    collisions: int


def explore_house(house: House, seed: int, *, on_tick: Callable[[Runtime], None] | None = None) -> Exploration:
    """Explore until the robot says it is done, or for far longer than that should take."""
    return asyncio.run(_explore(house, seed, on_tick))


async def _explore(house: House, seed: int, on_tick: Callable[[Runtime], None] | None) -> Exploration:
    logging.getLogger("majordomo").setLevel(logging.WARNING)
    limit_s = LIMIT_S + LIMIT_PER_ROOM_S * len(house.rooms)
    with tempfile.TemporaryDirectory(prefix="majordomo-evaluate-") as folder:
        file = Path(folder) / "house.json"
        file.write_text(house.model_dump_json(by_alias=True, exclude_none=True), encoding="utf-8")
        settings = Settings(
            house=str(file), seed=seed, clock=ClockMode.LOCKSTEP, speed=None, camera=False, data=Path(folder)
        )
        runtime = Runtime(settings)
        async with runtime.running():
            started = time.monotonic()
            while not (complete := runtime.memory.snapshot().root.explored) and runtime.now_s < limit_s:
                await runtime.wait_for_change()
                if on_tick is not None:
                    on_tick(runtime)
            wall_seconds = time.monotonic() - started
            truth = await runtime.require_robot().truth()
            return Exploration(
                scene=scene_document(runtime.memory.snapshot(), "map"),
                complete=complete,
                sim_seconds=runtime.now_s,
                wall_seconds=wall_seconds,
                agents=runtime.status_document()["agents"],
                collisions=int(truth["collisions"]),
            )
