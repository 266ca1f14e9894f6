"""``evaluate resources``: what each agent costs while a house is mapped, and what knowing a large building costs.

Beside the paper's figure 11 and table 3. The paper runs six agents in six processes; here they share one, so memory is
that of the service as a whole, with the simulator, which a real robot does not need, beside it.
"""

from __future__ import annotations

import asyncio
import json
import os
import statistics
import timeit
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table

from app.runtime import Runtime
from evaluations.mapping.exploration import ExplorationLimit, meter, service_in_lockstep, until_explored
from evaluations.mapping.known_building import known_building
from evaluations.plots import save
from evaluations.pool import run_all
from perception.memory.working_set import WorkingSet
from scene_graph.edits import PutEdge
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.memory import WorkingMemory
from simulation.houses.house_file import load_house

PAPER_MB = {
    "room_concept": 197,
    "door_concept": 184,
    "robot_body": 203,
    "long_term_memory": 216,
    "energy_optimizer": 144,
    "mission_monitoring": 144,
}
"""Mean resident memory of each of the paper's processes, table 3."""

ROOMS = (10, 30, 100, 300, 1000)
"""Sizes of the building that is known."""


@dataclass(frozen=True, kw_only=True)
class ResourceAims:
    """What the service may take."""

    most_mb: float = 600.0
    """Chosen: little more than half of what the paper's processes take together."""
    growth: float = 1.10
    """So many times as much may the largest building cost as the smallest: it is to cost the same."""


def evaluate(
    *,
    house: str,
    camera: bool,
    json_file: Path | None,
    plot_file: Path | None,
    console: Console,
    aims: ResourceAims = ResourceAims(),
) -> bool:
    """Map ``house`` and grow a building; whether memory stays below what it may, and flat."""
    run = run_all(run_once, [(house, camera)], jobs=1, console=console, what="mapping")[0]
    growth = run_all(grown, [(rooms,) for rooms in ROOMS], jobs=1, console=console, what="growing")
    console.print(_agent_table(run, aims))
    console.print(_growth_table(growth))
    if json_file is not None:
        json_file.parent.mkdir(parents=True, exist_ok=True)
        document = {"mapping": run, "growth": growth, "paper_mb": PAPER_MB}
        json_file.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    if plot_file is not None:
        draw(run, growth, plot_file)
    flat = all(growth[-1][name] <= aims.growth * growth[0][name] for name in ("elements", "commit_us"))
    return bool(run["service_mb_max"] < aims.most_mb and flat)


def run_once(house: str, camera: bool) -> dict[str, Any]:
    """Map a house and watch the agents."""
    return asyncio.run(_run(house, camera=camera))


async def _run(name: str, *, camera: bool) -> dict[str, Any]:
    house = load_house(name)
    made: list[_Meter] = []

    def meters(runtime: Runtime) -> list[_Meter]:
        made.append(_Meter(runtime))
        return made

    async with service_in_lockstep(house, 0, camera=camera, witnesses=meters) as runtime:
        meter(runtime)
        explored = await until_explored(runtime, house)
        samples = made[0].samples
        seconds = max(runtime.now_s, 1e-9)
        cpu = {turns.agent.name: 100.0 * turns.cpu_s / seconds for turns in runtime.turns()}
    return {
        "house": name,
        "camera": camera,
        "explored": explored and seconds < ExplorationLimit().house_s * 10,
        "sim_seconds": seconds,
        "cpu_percent": cpu,
        "service_mb_max": max(sample["service_mb"] for sample in samples),
        "service_mb_mean": statistics.fmean(sample["service_mb"] for sample in samples),
        "simulator_mb_max": max(sample["simulator_mb"] for sample in samples),
        "samples": samples,
    }


class _Meter:
    """Reads memory and every agent's processor time once a simulated second."""

    name = "meter"
    period_s = 1.0

    def __init__(self, runtime: Runtime) -> None:
        self._runtime = runtime
        self._before: dict[str, float] = {}
        self.samples: list[dict[str, Any]] = []

    async def step(self, stamp_s: float) -> None:
        """One sample; processor time in percent of one core, at the speed of simulated time."""
        spent = {turns.agent.name: turns.cpu_s for turns in self._runtime.turns()}
        percent = {name: 100.0 * (cpu_s - self._before.get(name, 0.0)) / self.period_s for name, cpu_s in spent.items()}
        self._before = spent
        robot = self._runtime.robot
        self.samples.append(
            {
                "stamp_s": stamp_s,
                "service_mb": resident_mb(os.getpid()),
                "simulator_mb": resident_mb(robot.pid) if robot is not None and robot.pid else 0.0,
                "cpu_percent": percent,
            }
        )


def resident_mb(pid: int) -> float:
    """Resident memory of a process in megabytes, 0 where the system does not tell."""
    try:
        pages = int(Path(f"/proc/{pid}/statm").read_text(encoding="ascii").split()[1])
    except (OSError, ValueError, IndexError):
        return 0.0
    return pages * os.sysconf("SC_PAGE_SIZE") / 1e6


def grown(rooms: int) -> dict[str, Any]:
    """Size and speed of working memory when ``rooms`` rooms are known, in a process of its own."""
    building = known_building(rooms)
    memory = WorkingMemory(building, long_term=LongTermStore())
    working_set = WorkingSet("long_term_memory", memory)
    for stamp_s in (0.0, 10.0):
        working_set.update(stamp_s)
    pose = building.parent("robot")
    edits = [PutEdge(pose)] if pose is not None else []

    def move() -> None:
        memory.commit(edits, agent="energy_optimizer", stamp_s=11.0)

    snapshot = memory.snapshot()
    return {
        "rooms": rooms,
        "elements": len(snapshot.nodes) + len(snapshot.edges),
        "commit_us": 1e6 * min(timeit.repeat(move, number=20, repeat=60)) / 20,
        "upkeep_us": 1e6 * min(timeit.repeat(lambda: working_set.update(11.0), number=20, repeat=30)) / 20,
        "process_mb": resident_mb(os.getpid()),
    }


def _agent_table(run: Mapping[str, Any], aims: ResourceAims) -> Table:
    table = Table(
        title=f"{run['house']}, {'with' if run['camera'] else 'without'} camera: service at most "
        f"{run['service_mb_max']:.0f} MB (aim: {aims.most_mb:.0f}; the paper's processes {sum(PAPER_MB.values())} MB), "
        f"simulator {run['simulator_mb_max']:.0f} MB"
    )
    table.add_column("agent")
    table.add_column("% of a core", justify="right")
    table.add_column("paper: MB", justify="right")
    for name, percent in sorted(run["cpu_percent"].items(), key=lambda item: -item[1]):
        table.add_row(name, f"{percent:.2f}", str(PAPER_MB.get(name, "")))
    table.add_row("all", f"{sum(run['cpu_percent'].values()):.2f}", str(sum(PAPER_MB.values())))
    return table


def _growth_table(growth: Sequence[Mapping[str, Any]]) -> Table:
    table = Table(title="working memory while the known building grows")
    for column in ("rooms", "nodes and edges", "pose update µs", "upkeep µs", "process MB"):
        table.add_column(column, justify="right")
    for row in growth:
        figures = (f"{row[name]:.0f}" for name in ("commit_us", "upkeep_us", "process_mb"))
        table.add_row(str(row["rooms"]), str(row["elements"]), *figures)
    return table


def draw(run: Mapping[str, Any], growth: Sequence[Mapping[str, Any]], file: Path) -> None:
    """Processor time of the busiest agents over time, and cost over the size of the known building."""
    figure = Figure(figsize=(11.0, 3.8), layout="constrained")
    over_time, over_rooms = figure.subplots(1, 2)
    stamps = [sample["stamp_s"] for sample in run["samples"]]
    busiest = sorted(run["cpu_percent"], key=lambda name: -run["cpu_percent"][name])[:8]
    for name in busiest:
        values = [sample["cpu_percent"].get(name, 0.0) for sample in run["samples"]]
        over_time.plot(stamps, values, linewidth=0.9, label=name.replace("_", " "))
    over_time.set_xlabel("simulated seconds")
    over_time.set_ylabel("% of a core")
    over_time.legend(fontsize=7)
    rooms = [row["rooms"] for row in growth]
    over_rooms.semilogx(rooms, [row["commit_us"] for row in growth], "o-", label="pose update, µs")
    over_rooms.semilogx(rooms, [row["elements"] for row in growth], "s-", label="nodes and edges in working memory")
    over_rooms.set_xlabel("known rooms")
    over_rooms.set_ylim(bottom=0.0)
    over_rooms.legend(fontsize=8)
    save(figure, file)
