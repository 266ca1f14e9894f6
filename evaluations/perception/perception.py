"""``evaluate perception``: what the graph holds of stocked houses after the robot has looked around in them.

The robot explores with all of its own agents, in lockstep, its camera's pictures understood by the network that the
service uses too. Then every object node is compared with what is there: see ``matching`` for which node is which
thing, and ``belief_scores`` for the figures. The network has learned from other houses.
"""

from __future__ import annotations

import asyncio
import json
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table

from app.runtime import Runtime
from evaluations.mapping.exploration import meter, pass_time, service_in_lockstep, until_explored
from evaluations.mapping.mapping import house_of as mapped_house_of
from evaluations.perception.belief_scores import BANDS_M, NEAR_M, score_house, summarize
from evaluations.perception.inventory import graph_contents, true_things
from evaluations.perception.visibility import VisibilityMonitor
from evaluations.plots import save
from evaluations.pool import run_all, tell
from evaluations.tables import shown
from perception.network.model import OnnxPanopticModel
from simulation.generation.stocking import stocked_house
from simulation.houses.house import House


@dataclass(frozen=True, kw_only=True)
class LeastBelief:
    """Shares that are to be reached; chosen."""

    recall: float = 0.90
    precision: float = 0.92
    room_right: float = 0.95
    support_right: float = 0.90
    room_labels_right: float = 0.90


@dataclass(frozen=True, kw_only=True)
class MostBelief:
    """What is not to be exceeded; chosen."""

    duplicates: float = 0.02
    position_error_m: float = 0.04
    switches_per_10_min: float = 1.0


@dataclass(frozen=True, kw_only=True)
class PerceptionAims:
    """What the graph is to hold after a look around."""

    least: LeastBelief = field(default_factory=LeastBelief)
    most: MostBelief = field(default_factory=MostBelief)


def evaluate(
    *,
    houses: Sequence[str],
    model: Path,
    jobs: int,
    json_file: Path | None,
    plot_file: Path | None,
    console: Console,
    aims: PerceptionAims = PerceptionAims(),
) -> bool:
    """Look around in all houses, print tables, write JSON and plot; whether all aims were met.

    ``houses``: file names, names of houses that ship with the package, ``generated:N`` or ``stocked:N``.

    Raises:
        HouseError: a house cannot be read; said before anything is measured.
        NetworkRefused: so is what is wrong with the network's file.
    """
    check(houses, model)
    runs = run_all(run_once, [(house, model) for house in houses], jobs=jobs, console=console, what="houses")
    summary = summarize(runs)
    for table in (_run_table(runs), _class_table(summary), _summary_table(summary, aims)):
        console.print(table)
    if summary["misnamed"]:
        worst = ", ".join(f"{true} as {called} ({count})" for true, called, count in summary["misnamed"][:12])
        console.print(f"Most often misnamed: {worst}.")
    good = met(summary, aims) and all(run["explored"] for run in runs)
    if json_file is not None:
        document = {
            "model": model.name,
            "runs": runs,
            "summary": summary,
            "at_least": asdict(aims.least),
            "at_most": asdict(aims.most),
            "met": good,
        }
        json_file.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    if plot_file is not None:
        draw(summary, plot_file, aims)
    return good


def check(houses: Sequence[str], model: Path) -> None:
    """Read every house and the network once, so that what is wrong with them is said at once."""
    for name in houses:
        house_of(name)
    OnnxPanopticModel.load(model)


def house_of(name: str) -> House:
    """The house of this name: ``stocked:N``, all its doors open, or what ``evaluate mapping`` takes."""
    kind, _, number = name.partition(":")
    if kind != "stocked" or not number.isdigit():
        return mapped_house_of(name)
    house = stocked_house(seed=int(number))
    return house.model_copy(update={"doors": tuple(door.model_copy(update={"state": "open"}) for door in house.doors)})


def run_once(name: str, model: Path) -> dict[str, Any]:
    """One house, in this process."""
    return asyncio.run(_run(name, house_of(name), model))


async def _run(name: str, house: House, model: Path) -> dict[str, Any]:
    made: list[VisibilityMonitor] = []

    def monitors(runtime: Runtime) -> list[VisibilityMonitor]:
        made.append(VisibilityMonitor(runtime, house))
        return made

    async with service_in_lockstep(house, 0, camera=True, model=model, witnesses=monitors) as runtime:
        started = time.monotonic()
        meter(runtime)
        explored = await until_explored(runtime, house)
        tell(f"{name}: {'explored' if explored else 'given up'} after {runtime.now_s:.0f} simulated seconds")
        await pass_time(runtime, 1.0)  # for what was seen last to get into the graph
        truth = await runtime.require_robot().truth()
        monitor = made[0]
        things = true_things(house, truth, monitor.sizes)
        graph = graph_contents(runtime.views.scene.document(), house)
        return {
            "house": name,
            "rooms_there": len(house.rooms),
            "rooms_found": len(graph.rooms),
            "explored": explored,
            "wall_seconds": round(time.monotonic() - started, 1),
            "cpu_seconds": {turns.agent.name: round(turns.cpu_s, 1) for turns in runtime.turns()},
            "failed_turns": sum(turns.restarts for turns in runtime.turns()),
            **score_house(house, things, graph, monitor.sightings()),
        }


def met(summary: Mapping[str, Any], aims: PerceptionAims = PerceptionAims()) -> bool:
    """Whether every figure is where it is to be; what could not be measured is not."""
    high = all(summary[name] is not None and summary[name] >= aim for name, aim in asdict(aims.least).items())
    low = all(summary[name] is not None and summary[name] <= aim for name, aim in asdict(aims.most).items())
    return high and low and summary["nodes"] > 0


def _run_table(runs: Sequence[Mapping[str, Any]]) -> Table:
    table = Table(title="houses")
    columns = ("house", "rooms", "explored", "things", "nodes", "recall", "precision", "duplicates", "sim s", "wall s")
    for column in columns:
        table.add_column(column, justify="left" if column == "house" else "right")
    for run in runs:
        own = summarize([run])
        table.add_row(
            run["house"],
            f"{run['rooms_found']} of {run['rooms_there']}",
            "yes" if run["explored"] else "[red]no",
            str(own["things"]),
            str(own["nodes"]),
            *(shown(own[figure]) for figure in ("recall", "precision", "duplicates")),
            f"{run['seconds']:.0f}",
            f"{run['wall_seconds']:.0f}",
        )
    return table


def _class_table(summary: Mapping[str, Any]) -> Table:
    table = Table(title="by class")
    for column in ("class", "there", "recall", "found under any name", "claimed", "precision", "error mm"):
        table.add_column(column, justify="left" if column == "class" else "right")
    for name, row in sorted(summary["classes"].items(), key=lambda item: (item[1]["recall"] or 0.0, item[0])):
        error_m = row["error_m"]
        table.add_row(
            name,
            str(row["there"]),
            shown(row["recall"]),
            shown(row["found_under_any_name"]),
            str(row["claimed"]),
            shown(row["precision"]),
            "–" if error_m is None else f"{1000.0 * error_m:.0f}",
        )
    return table


def _summary_table(summary: Mapping[str, Any], aims: PerceptionAims) -> Table:
    table = Table(title="the graph")
    for column in ("figure", "measured", "aim"):
        table.add_column(column, justify="left" if column == "figure" else "right")
    for name, aim in asdict(aims.least).items():
        table.add_row(name.replace("_", " "), shown(summary[name]), f">= {aim:g}")
    for name, aim in asdict(aims.most).items():
        table.add_row(name.replace("_", " "), shown(summary[name]), f"<= {aim:g}")
    others = (
        "recall_in_view", "found_under_any_name", "unnamed", "invented", "position_error_small_m",
        "position_error_furniture_m", "relation_recall",
    )  # fmt: skip
    for name in others:
        table.add_row(name.replace("_", " "), shown(summary[name]), "")
    for low in map("{:g}".format, BANDS_M):
        table.add_row(f"position error m, seen from {low} m on", shown(summary["position_error_by_distance"][low]), "")
        table.add_row(f"recall, in view from {low} m on", shown(summary["recall_by_distance"][low]), "")
    for name, value in summary["relation_recall_by_predicate"].items():
        table.add_row(f"relation recall, {name}", shown(value), "")
    for name, count in summary["support"].items():
        table.add_row(f"support {name}, things", str(count), "")
    table.caption = f"position error: of things seen from {NEAR_M:g} m or nearer; in view: in that distance too"
    return table


def draw(summary: Mapping[str, Any], file: Path, aims: PerceptionAims = PerceptionAims()) -> None:
    """Recall and precision per class; error and recall by distance."""
    figure = Figure(figsize=(13.0, 9.0), layout="constrained")
    axes = figure.subplot_mosaic([["class", "error"], ["class", "recall"]], width_ratios=(3, 2))
    rows = sorted(summary["classes"].items(), key=lambda item: item[1]["recall"] or 0.0)
    names = [name for name, _ in rows]
    axes["class"].barh(names, [row["recall"] or 0.0 for _, row in rows], color="#1d4ed8", label="recall")
    axes["class"].plot([row["precision"] or 0.0 for _, row in rows], names, "o", color="#c2410c", label="precision")
    axes["class"].set_title("object nodes by class")
    axes["class"].legend(loc="lower left")
    _draw_bands(axes["error"], summary["position_error_by_distance"], "position error in m, by nearest sighting")
    axes["error"].axhline(aims.most.position_error_m, color="#b91c1c", linestyle="--", linewidth=1.0)
    _draw_bands(axes["recall"], summary["recall_by_distance"], "recall, by nearest distance in view")
    for axis in axes.values():
        axis.grid(alpha=0.3)
    save(figure, file)


def _draw_bands(axis: Axes, figures: Mapping[str, float | None], title: str) -> None:
    axis.bar([f"{low} m +" for low in figures], [value or 0.0 for value in figures.values()], color="#1d4ed8")
    axis.set_title(title)
