"""``evaluate localization``: hours of driving between rooms of a known building, and the error of the believed place.

The paper reports at most 150 mm over four hours, with respect to the rooms' frames (section 4). The error here is the
same: the robot's place in its room as the graph has it, against the true one, the found room laid upon the true one.
"""

from __future__ import annotations

import asyncio
import json
import math
import statistics
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray
from rich.console import Console
from rich.table import Table

from app.runtime import Runtime
from evaluations.mapping.exploration import service_in_lockstep, until_explored
from evaluations.mapping.floor_plan import compare, in_house, placement, plan_of_house, plan_of_scene
from evaluations.mapping.mapping import house_of
from evaluations.mapping.patrol import Patrol
from evaluations.plots import save
from evaluations.pool import run_all
from scene_graph.nodes import ROBOT_ID, ROOT_ID
from simulation.houses.house import House

Array = NDArray[np.float64]

PAPER_MAX_MM = 150.0
"""Greatest error that the Concepts paper reports."""


@dataclass(frozen=True, kw_only=True)
class LocalizationAims:
    """How far off the robot may believe to be."""

    max_mm: float = 50.0
    """At any time: chosen, a third of the paper's."""


def evaluate(
    *,
    houses: Sequence[str],
    hours: float,
    jobs: int,
    json_file: Path | None,
    plot_file: Path | None,
    console: Console,
    aims: LocalizationAims = LocalizationAims(),
) -> bool:
    """Drive about in every house for ``hours`` each; whether the error never exceeded what it may."""
    runs = run_all(run_once, [(house, hours) for house in houses], jobs=jobs, console=console)
    console.print(_table(runs, aims))
    if json_file is not None:
        json_file.parent.mkdir(parents=True, exist_ok=True)
        document = {"runs": runs, "paper_max_mm": PAPER_MAX_MM, "aim_max_mm": aims.max_mm}
        json_file.write_text(json.dumps(document) + "\n", encoding="utf-8")
    if plot_file is not None:
        draw(runs, plot_file, aims)
    return all(run["explored"] and run["max_mm"] <= aims.max_mm for run in runs)


def run_once(name: str, hours: float) -> dict[str, Any]:
    """One house, in this process."""
    return asyncio.run(_run(name, house_of(name), 3600.0 * hours))


async def _run(name: str, house: House, seconds: float) -> dict[str, Any]:
    made: list[_Rounds] = []

    def rounds(runtime: Runtime) -> list[_Rounds]:
        made.append(_Rounds(runtime, house))
        return made

    async with service_in_lockstep(house, 0, witnesses=rounds) as runtime:
        started = time.monotonic()
        explored = await until_explored(runtime, house)
        witness, begin_s = made[0], runtime.now_s
        witness.begin()
        while explored and runtime.now_s < begin_s + seconds:
            await runtime.wait_for_change()
        return {
            "house": name,
            "explored": explored,
            "hours": (runtime.now_s - begin_s) / 3600.0,
            "wall_seconds": round(time.monotonic() - started, 1),
            "visits": witness.visits,
            "failed_visits": witness.failed,
            "driven_m": round(witness.driven_m, 1),
            "mean_mm": statistics.fmean(witness.errors_mm) if witness.errors_mm else math.inf,
            "p99_mm": float(np.percentile(witness.errors_mm, 99)) if witness.errors_mm else math.inf,
            "max_mm": max(witness.errors_mm, default=math.inf),
            "stamps_s": [round(stamp - begin_s, 1) for stamp in witness.stamps_s],
            "errors_mm": [round(error, 2) for error in witness.errors_mm],
        }


class _Rounds:
    """Sends the robot from room to room, and compares once a second where it is with where it believes to be."""

    name = "evaluation"
    period_s = 1.0

    def __init__(self, runtime: Runtime, house: House) -> None:
        self._runtime, self._house = runtime, house
        self._patrol = Patrol(self.name, runtime.memory)
        self._true = plan_of_house(house)
        self._rooms: dict[str, str] = {}
        self._begun = False
        self._last: Array | None = None
        self.stamps_s: list[float] = []
        self.errors_mm: list[float] = []
        self.driven_m = 0.0

    def begin(self) -> None:
        """The building is known: from now on it counts."""
        found = plan_of_scene(self._runtime.views.scene.document(), self._house.robot.pose)
        self._rooms = {ours: truth for truth, ours in compare(found, self._true).found.items()}
        self._begun = True

    @property
    def visits(self) -> int:
        """Rooms that were to be visited."""
        return self._patrol.visits

    @property
    def failed(self) -> int:
        """Visits that failed."""
        return self._patrol.failed

    async def step(self, stamp_s: float) -> None:
        """Compare, and choose the next room when the last one was reached."""
        if not self._begun:
            return
        truth = await self._runtime.require_robot().truth()
        self._compare(np.array(truth["robot"]["pose"][:2]), stamp_s)
        self._patrol.step(stamp_s)

    def _compare(self, actual: Array, stamp_s: float) -> None:
        self.driven_m += 0.0 if self._last is None else float(np.linalg.norm(actual - self._last))
        self._last = actual
        snapshot = self._runtime.memory.snapshot()
        room = snapshot.current_room
        if room not in self._rooms:
            return
        T_map_room = snapshot.transform(ROOT_ID, room)
        corners = T_map_room.apply([(x, y, 0.0) for x, y in snapshot.room(room).polygon_m])
        found = in_house(np.asarray(corners)[:, :2], self._house.robot.pose)
        rotation, shift = placement(found, self._true.rooms[self._rooms[room]])
        believed = in_house(snapshot.position(ROBOT_ID, ROOT_ID)[None, :2], self._house.robot.pose)[0]
        self.stamps_s.append(stamp_s)
        self.errors_mm.append(1000.0 * float(np.linalg.norm(rotation @ believed + shift - actual)))


def _table(runs: Sequence[Mapping[str, Any]], aims: LocalizationAims) -> Table:
    table = Table(title=f"localization error in mm (aim: at most {aims.max_mm:.0f}; paper: {PAPER_MAX_MM:.0f})")
    for column in ("house", "hours", "driven m", "visits", "failed", "mean", "p99", "max"):
        table.add_column(column, justify="left" if column == "house" else "right")
    for run in runs:
        table.add_row(
            run["house"],
            f"{run['hours']:.2f}",
            f"{run['driven_m']:.0f}",
            str(run["visits"]),
            str(run["failed_visits"]),
            *(f"{run[name]:.1f}" for name in ("mean_mm", "p99_mm", "max_mm")),
        )
    return table


def draw(runs: Sequence[Mapping[str, Any]], file: Path, aims: LocalizationAims = LocalizationAims()) -> None:
    """Error over time."""
    figure = Figure(figsize=(8.0, 3.2), layout="constrained")
    axis = figure.subplots()
    for run in runs:
        axis.plot([stamp / 3600.0 for stamp in run["stamps_s"]], run["errors_mm"], linewidth=0.6, label=run["house"])
    axis.axhline(aims.max_mm, color="#b91c1c", linestyle="--", linewidth=1.0)
    axis.set_xlabel("hours")
    axis.set_ylabel("error in mm")
    axis.set_ylim(bottom=0.0)
    axis.legend(fontsize=8)
    save(figure, file)
