"""``evaluate mapping``: explored houses against their true floor plans, beside the paper's table 2."""

from __future__ import annotations

import json
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table

from evaluations.mapping.exploration import Exploration, explore_house
from evaluations.mapping.floor_plan import Errors, FloorPlan, Score, compare, plan_of_house, plan_of_scene
from evaluations.plots import draw_plans
from evaluations.pool import run_all
from simulation.generation.generator import generate_house
from simulation.houses.house import House
from simulation.houses.house_file import load_house

PAPER_MM = {
    "room_position": (34.1, 16.2),
    "room_size": (201.5, 8.8),
    "door_position": (37.5, 13.9),
    "door_width": (17.4, 16.7),
}
"""Mean and standard deviation, Concepts, table 2."""


@dataclass(frozen=True, kw_only=True)
class MappingAims:
    """Mean errors, in millimeters, and how far each room is to cover the true one: chosen, below the paper's."""

    room_position: float = 15.0
    room_size: float = 20.0
    door_position: float = 15.0
    door_width: float = 12.0
    least_iou: float = 0.95

    @property
    def errors_mm(self) -> dict[str, float]:
        """Those that are errors, by their names in the paper's table."""
        return {name: aim for name, aim in asdict(self).items() if name in PAPER_MM}


def generated(number: int) -> House:
    """House ``number`` of the evaluation: 4 to 12 rooms; every fourth has a loop, every fourth rectilinear rooms."""
    rooms = 4 + (5 * number) % 9
    return generate_house(rooms=rooms, seed=number, loops=number % 4 == 1, rectilinear=number % 4 == 3)


def evaluate(
    *,
    houses: Sequence[str],
    seeds: Sequence[int],
    jobs: int,
    json_file: Path | None,
    plot_file: Path | None,
    console: Console,
    aims: MappingAims = MappingAims(),
) -> bool:
    """Explore all houses under all seeds, print tables, write JSON and plot; whether every aim was met.

    ``houses``: file names, names of houses that ship with the package, or ``generated:N``.
    """
    runs = run_all(run_once, [(house, seed) for house in houses for seed in seeds], jobs=jobs, console=console)
    summary = summarize(runs)
    console.print(_run_table(runs))
    console.print(_summary_table(summary, aims))
    if json_file is not None:
        json_file.parent.mkdir(parents=True, exist_ok=True)
        document = {"runs": runs, "summary": summary, "paper_mm": PAPER_MM, "aim_mm": aims.errors_mm}
        json_file.write_text(json.dumps(document, indent=2) + "\n", encoding="utf-8")
    if plot_file is not None:
        draw_plans(runs, plot_file)
    right = sum(run["topology_right"] for run in runs)
    console.print(f"topology right in {right} of {len(runs)} runs; smallest IoU of a room {summary['least_iou']:.3f}")
    return bool(
        right == len(runs)
        and summary["least_iou"] >= aims.least_iou
        and all(summary[name]["mean_mm"] <= aim for name, aim in aims.errors_mm.items())
    )


def house_of(name: str) -> House:
    """The house of this name: ``generated:N``, one that ships with the package, or a file."""
    kind, _, number = name.partition(":")
    return generated(int(number)) if kind == "generated" and number.isdigit() else load_house(name)


def run_once(name: str, seed: int) -> dict[str, Any]:
    """Explore one house in this process; its figures."""
    house = house_of(name)
    explored = explore_house(house, seed)
    found, true = plan_of_scene(explored.scene, house.robot.pose), plan_of_house(house)
    return figures(name, seed, house, explored, compare(found, true), found)


def figures(
    name: str, seed: int, house: House, explored: Exploration, score: Score, found: FloorPlan
) -> dict[str, Any]:
    """One run as the JSON file holds it."""
    return {
        "house": name,
        "seed": seed,
        "rooms": len(house.rooms),
        "doors": len(house.doors),
        "explored": explored.complete,
        "topology_right": score.topology_right,
        "rooms_missed": list(score.rooms_missed),
        "rooms_invented": list(score.rooms_invented),
        "doors_missed": list(score.doors_missed),
        "doors_invented": list(score.doors_invented),
        "errors": _millimeters(score.errors),
        "errors_from_start_pose": _millimeters(score.unaligned),
        "iou": list(score.errors.iou),
        "collisions": explored.collisions,
        "sim_seconds": round(explored.sim_seconds, 2),
        "wall_seconds": round(explored.wall_seconds, 2),
        "found_plan": {room: polygon.round(4).tolist() for room, polygon in found.rooms.items()},
        "found_doors": {door_id: door.center.round(4).tolist() for door_id, door in found.doors.items()},
        "true_plan": {room.id: [list(point) for point in room.polygon] for room in house.rooms},
        "true_doors": {door.id: list(door.center) for door in house.doors},
    }


def summarize(runs: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Mean and standard deviation over all rooms and doors of all runs."""
    summary: dict[str, Any] = {}
    for name in PAPER_MM:
        values = [value for run in runs for value in run["errors"][name]]
        summary[name] = {
            "mean_mm": statistics.fmean(values) if values else float("inf"),
            "std_mm": statistics.pstdev(values) if values else 0.0,
            "max_mm": max(values, default=float("inf")),
        }
    summary["least_iou"] = min((value for run in runs for value in run["iou"]), default=0.0)
    summary["topology_right"] = sum(run["topology_right"] for run in runs)
    wall = sum(run["wall_seconds"] for run in runs)
    summary["times_real_time"] = sum(run["sim_seconds"] for run in runs) / wall if wall else 0.0
    return summary


def _millimeters(errors: Errors) -> dict[str, list[float]]:
    parts = {
        "room_position": errors.room_position_m,
        "room_size": errors.room_size_m,
        "door_position": errors.door_position_m,
        "door_width": errors.door_width_m,
    }
    return {name: [round(1000.0 * value, 2) for value in values] for name, values in parts.items()}


def _run_table(runs: Sequence[Mapping[str, Any]]) -> Table:
    table = Table(title="mapping")
    columns = (
        "house",
        "seed",
        "rooms",
        "topology",
        "room mm",
        "size mm",
        "door mm",
        "width mm",
        "IoU",
        "sim s",
        "× real",
    )
    for column in columns:
        table.add_column(column, justify="left" if column == "house" else "right")
    for run in runs:
        means = [_mean(run["errors"][name]) for name in PAPER_MM]
        table.add_row(
            run["house"],
            str(run["seed"]),
            str(run["rooms"]),
            "right" if run["topology_right"] else f"[red]{_what_is_wrong(run)}",
            *means,
            f"{min(run['iou'], default=0.0):.3f}",
            f"{run['sim_seconds']:.0f}",
            f"{run['sim_seconds'] / max(run['wall_seconds'], 1e-9):.1f}",
        )
    return table


def _mean(values: Sequence[float]) -> str:
    return f"{statistics.fmean(values):.1f}" if values else "-"


def _what_is_wrong(run: Mapping[str, Any]) -> str:
    parts = [
        f"{len(run[f'{kind}_{how}'])} {kind} {how}"
        for kind in ("rooms", "doors")
        for how in ("missed", "invented")
        if run[f"{kind}_{how}"]
    ]
    return ", ".join(parts)


def _summary_table(summary: Mapping[str, Any], aims: MappingAims) -> Table:
    table = Table(title="errors over all rooms and doors, in millimeters")
    for column in ("", "mean", "std", "max", "aim", "paper: mean", "paper: std"):
        table.add_column(column, justify="right" if column else "left")
    for name, (mean_mm, std_mm) in PAPER_MM.items():
        ours = summary[name]
        table.add_row(
            name.replace("_", " "),
            f"{ours['mean_mm']:.1f}",
            f"{ours['std_mm']:.1f}",
            f"{ours['max_mm']:.1f}",
            f"≤ {aims.errors_mm[name]:.0f}",
            f"{mean_mm:.1f}",
            f"{std_mm:.1f}",
        )
    return table
