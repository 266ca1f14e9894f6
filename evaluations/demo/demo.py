"""``evaluate demo``: the demonstration under several seeds, reported outcome against the simulator's truth."""

from __future__ import annotations

import asyncio
import json
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from app.demo import DemoOutcome, Scenario, play
from app.runtime import Runtime
from app.settings import ClockMode, Settings
from evaluations.pool import run_all
from planner.tasks.tasks import Task
from simulation.houses.house import furniture_places
from simulation.houses.house_file import load_house


@dataclass(frozen=True, kw_only=True)
class DemoAims:
    """What the demonstration is to come to; never may it report what is not true."""

    success: float = 0.9
    """Share of runs that succeed in truth: chosen."""


class _Silence:
    """Progress that nobody watches."""

    def exploring(self, rooms: int, doors_done: int, doors: int, objects: int, stamp_s: float) -> None: ...

    def explored(self, stamp_s: float, *, complete: bool) -> None: ...

    def disturbed(self, scenario: Scenario, stamp_s: float) -> None: ...

    def working(self, task: Task) -> None: ...


def evaluate(
    *,
    house: str,
    seeds: Sequence[int],
    jobs: int,
    logs: Path | None,
    json_file: Path | None,
    console: Console,
    aims: DemoAims = DemoAims(),
) -> bool:
    """Run all seeds, print a table, write JSON; whether enough succeeded and nothing was claimed that is not true."""
    load_house(house)
    runs = run_all(run_once, [(house, seed, logs) for seed in seeds], jobs=jobs, console=console)
    if json_file is not None:
        json_file.parent.mkdir(parents=True, exist_ok=True)
        json_file.write_text(json.dumps({"house": house, "runs": runs}, indent=2) + "\n", encoding="utf-8")
    console.print(_table(runs))
    phantoms = sum(run["reported"] and not run["true"] for run in runs)
    successes = sum(run["reported"] and run["true"] for run in runs)
    console.print(f"{successes} of {len(runs)} succeeded in truth; {phantoms} phantom successes")
    return bool(phantoms == 0 and successes >= aims.success * len(runs))


def run_once(house: str, seed: int, logs: Path | None) -> dict[str, Any]:
    """One run in this process; its figures."""
    return asyncio.run(_run(house, seed, logs))


async def _run(house: str, seed: int, logs: Path | None) -> dict[str, Any]:
    with tempfile.TemporaryDirectory(prefix="majordomo-evaluate-") as folder:
        settings = Settings(house=house, seed=seed, clock=ClockMode.LOCKSTEP, speed=None, data=Path(folder))
        log = logs / f"demo_{house}_{seed}.jsonl" if logs is not None else None
        runtime = Runtime(settings, event_log=log)
        async with runtime.running():
            outcome = await play(runtime, runtime.require_robot(), furniture_places(load_house(house)), _Silence())
    return _figures(outcome)


def _figures(outcome: DemoOutcome) -> dict[str, Any]:
    task = outcome.task
    return {
        "seed": outcome.seed,
        "reported": outcome.reported,
        "true": outcome.true,
        "replans": outcome.replans,
        "sim_seconds": outcome.sim_seconds,
        "wall_seconds": outcome.wall_seconds,
        "explored": outcome.explored,
        "disturbed": outcome.disturbed,
        "failures": [failure.code for failure in task.failures] if task else [],
        "explanation": task.explanation if task else "",
    }


def _table(runs: Sequence[dict[str, Any]]) -> Table:
    table = Table(title="demonstration")
    columns = (
        "seed",
        "reported",
        "true",
        "explored",
        "disturbed",
        "replans",
        "sim_seconds",
        "wall_seconds",
        "failures",
    )
    for column in columns:
        table.add_column(column)
    for run in runs:
        table.add_row(*(_cell(run[column]) for column in columns))
    return table


def _cell(value: Any) -> str:
    if isinstance(value, list):
        return ", ".join(str(item) for item in value)
    return f"{value:.0f}" if isinstance(value, float) else str(value)
