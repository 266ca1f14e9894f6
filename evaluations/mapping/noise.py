"""``evaluate noise``: how much sensor noise mapping bears, one kind at a time (Concepts, section 5.1).

The paper leaves these three sweeps to future work; there are no figures of its own to stand beside.
"""

from __future__ import annotations

import json
import statistics
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table

from evaluations.mapping.exploration import explore_house
from evaluations.mapping.floor_plan import compare, plan_of_house, plan_of_scene
from evaluations.mapping.mapping import figures, house_of
from evaluations.plots import save
from evaluations.pool import run_all


@dataclass(frozen=True, kw_only=True)
class Sweep:
    """One kind of noise: the house file's ``field``, its values, a unit to show them in, and how much must be borne."""

    field: str
    title: str
    values: tuple[float, ...]
    unit: str
    scale: float
    aim: float


SWEEPS = (
    Sweep(
        field="lidar_range_std_m",
        title="LiDAR range",
        values=(0.01, 0.02, 0.035, 0.05, 0.075, 0.1),
        unit="mm",
        scale=1000.0,
        aim=0.05,
    ),
    Sweep(
        field="odometry_distance_ratio",
        title="odometry, distance",
        values=(0.005, 0.01, 0.02, 0.03, 0.04, 0.05),
        unit="%",
        scale=100.0,
        aim=0.03,
    ),
    Sweep(
        field="odometry_angle_ratio",
        title="odometry, angle",
        values=(0.005, 0.01, 0.02, 0.03, 0.04, 0.05),
        unit="%",
        scale=100.0,
        aim=0.03,
    ),
)
"""The ranges of section 5.1."""


def evaluate(
    *,
    houses: Sequence[str],
    seeds: Sequence[int],
    jobs: int,
    json_file: Path | None,
    plot_file: Path | None,
    console: Console,
) -> bool:
    """Run all sweeps over all houses and seeds; whether topology stayed right as far as it must."""
    points = [(sweep, value) for sweep in SWEEPS for value in sweep.values]
    jobs_list = [(house, seed, sweep.field, value) for sweep, value in points for house in houses for seed in seeds]
    runs = run_all(run_once, jobs_list, jobs=jobs, console=console)
    results = [_summary(sweep, runs) for sweep in SWEEPS]
    for result in results:
        console.print(_table(result))
    if json_file is not None:
        json_file.parent.mkdir(parents=True, exist_ok=True)
        json_file.write_text(json.dumps({"runs": runs, "sweeps": results}, indent=2) + "\n", encoding="utf-8")
    if plot_file is not None:
        draw(results, plot_file)
    return all(result["borne"] is not None and result["borne"] >= result["aim"] for result in results)


def run_once(name: str, seed: int, field: str, value: float) -> dict[str, Any]:
    """Explore one house with one kind of noise changed, the others as they usually are."""
    house = house_of(name)
    house = house.model_copy(update={"noise": house.noise.model_copy(update={field: value})})
    explored = explore_house(house, seed)
    found = plan_of_scene(explored.scene, house.robot.pose)
    run = figures(name, seed, house, explored, compare(found, plan_of_house(house)), found)
    return {**run, "field": field, "value": value}


def _summary(sweep: Sweep, runs: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """One row a value; ``borne``: the largest value up to which topology was right in every run."""
    rows: list[dict[str, Any]] = []
    borne: float | None = None
    unbroken = True
    for value in sweep.values:
        here = [run for run in runs if run["field"] == sweep.field and run["value"] == value]
        right = sum(run["topology_right"] for run in here)
        unbroken = unbroken and right == len(here)
        borne = value if unbroken else borne
        means = {
            name: statistics.fmean(numbers) if (numbers := [n for run in here for n in run["errors"][name]]) else None
            for name in ("room_position", "room_size", "door_position", "door_width")
        }
        rows.append({"value": value, "runs": len(here), "topology_right": right, "mean_mm": means})
    return {
        "field": sweep.field,
        "title": sweep.title,
        "unit": sweep.unit,
        "scale": sweep.scale,
        "aim": sweep.aim,
        "borne": borne,
        "rows": rows,
    }


def _table(result: Mapping[str, Any]) -> Table:
    borne = "never" if result["borne"] is None else f"up to {result['borne'] * result['scale']:g} {result['unit']}"
    aim = f"{result['aim'] * result['scale']:g} {result['unit']}"
    table = Table(title=f"{result['title']}: topology right {borne} (aim {aim})")
    for column in (result["unit"], "topology", "room mm", "size mm", "door mm", "width mm"):
        table.add_column(column, justify="right")
    for row in result["rows"]:
        means = ("-" if mean is None else f"{mean:.1f}" for mean in row["mean_mm"].values())
        table.add_row(f"{row['value'] * result['scale']:g}", f"{row['topology_right']} of {row['runs']}", *means)
    return table


def draw(results: Sequence[Mapping[str, Any]], file: Path) -> None:
    """Mean errors over noise, one picture a sweep; values at which a topology was wrong are shaded."""
    figure = Figure(figsize=(4.2 * len(results), 3.6), layout="constrained")
    axes = figure.subplots(1, len(results), squeeze=False)[0]
    for axis, result in zip(axes, results, strict=True):
        xs = [row["value"] * result["scale"] for row in result["rows"]]
        for name in ("room_position", "room_size", "door_position", "door_width"):
            means = [row["mean_mm"][name] for row in result["rows"]]
            axis.plot(
                xs, [float("nan") if mean is None else mean for mean in means], "o-", label=name.replace("_", " ")
            )
        if result["borne"] is None or result["borne"] < result["rows"][-1]["value"]:
            axis.axvspan((result["borne"] or 0.0) * result["scale"], xs[-1], color="#fee2e2", zorder=0)
        axis.set_title(result["title"], fontsize=10)
        axis.set_xlabel(result["unit"])
        axis.set_ylabel("mean error in mm")
        axis.set_ylim(bottom=0.0)
    axes[0].legend(fontsize=8)
    save(figure, file)
