"""Explores the flat for a while and leaves the event log: ``python explore_briefly.py LOG SECONDS SEED``."""

from __future__ import annotations

import asyncio
import sys
import tempfile
from pathlib import Path

from app.runtime import Runtime
from app.settings import ClockMode, Settings


async def explore(log: Path, seconds: float, seed: int) -> None:
    """Stop at the first change after ``seconds`` of simulated time; later lines are cut off, so that runs compare."""
    with tempfile.TemporaryDirectory() as folder:
        settings = Settings(house="flat", seed=seed, clock=ClockMode.LOCKSTEP, speed=None, data=Path(folder))
        runtime = Runtime(settings, event_log=log)
        async with runtime.running():
            while runtime.now_s < seconds + 1.0:
                await runtime.wait_for_change()


if __name__ == "__main__":
    asyncio.run(explore(Path(sys.argv[1]), float(sys.argv[2]), int(sys.argv[3])))
