"""``evaluate changes``: things are moved, removed and brought behind the robot's back; it looks once, and is scored.

After the robot has explored, one thing at a time is changed at places that its camera does not point at. Then an
intention, as the robot's own agents have them, asks for one look at each place that was concerned, and the graph is
compared with the truth before and after.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import time
import zlib
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table

from app.runtime import Runtime
from evaluations.mapping.exploration import pass_time, service_in_lockstep, until_explored
from evaluations.perception.change_scores import Moment, detected, false_alarms, summarize
from evaluations.perception.interventions import KINDS, Gaze, Intervention, Kind, interventions
from evaluations.perception.inventory import graph_contents, sizes_of, true_things
from evaluations.perception.perception import check, house_of
from evaluations.plots import save
from evaluations.pool import run_all, tell
from evaluations.tables import shown
from perception.objects.inspection import InspectionSettings
from scene_graph.edges import Edge, HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from scene_graph.edits import PutEdge, RemoveEdge
from scene_graph.nodes import ROBOT_ID, ObjectNode
from simulation.errors import DisturbError
from simulation.furnishing.catalog import category_named
from simulation.houses.house import House, room_at
from simulation.robot.description import CameraDescription

AGENT = "evaluation"
_ENDED = (IntentionStatus.DONE, IntentionStatus.FAILED)


@dataclass(frozen=True, kw_only=True)
class ChangeAims:
    """What the graph is to notice; chosen."""

    detected: float = 0.95
    """Share of changes of each kind."""
    right: float = 0.90
    """Share of true things and of nodes that are right after each change."""
    false_alarms_per_change: float = 0.1


@dataclass(frozen=True, kw_only=True)
class ChangeTiming:
    """In simulated time."""

    look_limit_s: float = 240.0
    """After so long the robot has not got to where something changed."""
    settle_s: float = 1.0
    """So long things may fall and roll, and the graph follow."""


def evaluate(
    *,
    houses: Sequence[str],
    changes: int,
    model: Path,
    jobs: int,
    json_file: Path | None,
    plot_file: Path | None,
    console: Console,
    aims: ChangeAims = ChangeAims(),
) -> bool:
    """Make ``changes`` in each house, print tables, write JSON and plot; whether all aims were met.

    ``houses``: as ``evaluate perception`` takes them.

    Raises:
        HouseError: a house cannot be read; said before anything is measured.
        NetworkRefused: so is what is wrong with the network's file.
    """
    check(houses, model)
    runs = run_all(run_once, [(house, changes, model) for house in houses], jobs=jobs, console=console, what="houses")
    summary = summarize(runs)
    console.print(_run_table(runs))
    console.print(_kind_table(summary, aims))
    console.print(
        f"graph after each change: {shown(summary['true_things_right'])} of the true things right, "
        f"{shown(summary['nodes_right'])} of the nodes true (aim: both >= {aims.right:g}); "
        f"{shown(summary['false_alarms_per_change'])} false alarms a change (aim: <= {aims.false_alarms_per_change:g})"
    )
    good = met(summary, aims) and all(run["explored"] for run in runs)
    if json_file is not None:
        document = {"model": model.name, "runs": runs, "summary": summary, "aims": asdict(aims), "met": good}
        json_file.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    if plot_file is not None:
        draw(summary, runs, plot_file, aims)
    return good


def met(summary: Mapping[str, Any], aims: ChangeAims = ChangeAims()) -> bool:
    """Whether enough changes of every kind were detected, and the graph was right enough after them."""
    kinds = summary["kinds"]
    return bool(
        kinds
        and all(row["detected"] >= aims.detected for row in kinds.values())
        and min(summary["true_things_right"] or 0.0, summary["nodes_right"] or 0.0) >= aims.right
        and summary["false_alarms_per_change"] <= aims.false_alarms_per_change
    )


def run_once(name: str, changes: int, model: Path) -> dict[str, Any]:
    """One house, in this process."""
    return asyncio.run(_run(name, house_of(name), changes, model))


async def _run(name: str, house: House, changes: int, model: Path) -> dict[str, Any]:
    async with service_in_lockstep(house, 0, camera=True, model=model) as runtime:
        started = time.monotonic()
        explored = await until_explored(runtime, house)
        tell(f"{name}: {'explored' if explored else 'given up'} after {runtime.now_s:.0f} simulated seconds")
        await pass_time(runtime, ChangeTiming().settle_s)
        experiment = _Experiment(runtime, house, np.random.default_rng(zlib.crc32(name.encode())))
        made: list[dict[str, Any]] = []
        for number in range(changes):
            kind = KINDS[number % len(KINDS)]
            row = await experiment.change(kind)
            made += [row] if row is not None else []
            outcome = "not made" if row is None else "noticed" if row["noticed"] else "not noticed"
            tell(f"{name}: change {number + 1} of {changes} ({kind}) {outcome}")
        return {
            "house": name,
            "explored": explored,
            "changes": made,
            "not_made": changes - len(made),
            "seconds": round(runtime.now_s, 2),
            "wall_seconds": round(time.monotonic() - started, 1),
            "failed_turns": sum(turns.restarts for turns in runtime.turns()),
        }


class _Experiment:
    """Changes one thing, sends the robot to look, and compares."""

    def __init__(
        self, runtime: Runtime, house: House, rng: np.random.Generator, *, timing: ChangeTiming = ChangeTiming()
    ) -> None:
        self._runtime, self._house, self._rng, self._timing = runtime, house, rng, timing
        self._sizes = sizes_of(house)
        self._rooms: Mapping[str, str] = {}

    async def change(self, kind: Kind) -> dict[str, Any] | None:
        """One change and what came of it; None where, from two places, nothing out of the robot's view can change."""
        before = await self._moment()
        intervention = await self._do(kind, before)
        if intervention is None and self._rooms:
            await self._look_at(str(self._rng.choice(sorted(self._rooms.values()))))
            before = await self._moment()
            intervention = await self._do(kind, before)
        if intervention is None:
            return None
        await pass_time(self._runtime, self._timing.settle_s)
        began_s = self._runtime.now_s
        looks = {place: await self._look(place, before) for place in dict.fromkeys(intervention.places)}
        await pass_time(self._runtime, self._timing.settle_s)
        after = await self._moment()
        true_right, nodes_right = after.accuracy(self._rooms)
        return {
            "kind": kind,
            "thing": intervention.thing,
            "category": intervention.category,
            "places": list(intervention.places),
            "looked": not any(looks.values()),
            "not_looked": {place: reason for place, reason in looks.items() if reason},
            "seconds": round(self._runtime.now_s - began_s, 2),
            **detected(kind, intervention.thing, before, after),
            "false_alarms": false_alarms(before, after),
            "true_things_right": true_right,
            "nodes_right": nodes_right,
        }

    async def _moment(self) -> Moment:
        truth = await self._runtime.require_robot().truth()
        contents = graph_contents(self._runtime.views.scene.document(), self._house)
        self._rooms = contents.rooms
        return Moment.of(true_things(self._house, truth, self._sizes), contents.things)

    async def _do(self, kind: Kind, before: Moment) -> Intervention | None:
        """Do the first intervention for which there is room. Only what the graph knows of is moved or removed."""
        robot = self._runtime.require_robot()
        truth, joints = await robot.truth(), await robot.joints()
        x_m, y_m, yaw_rad = truth["robot"]["pose"]
        half_width_rad = CameraDescription().horizontal_fov_rad / 2.0
        gaze = Gaze(x_m=x_m, y_m=y_m, yaw_rad=yaw_rad + joints.pan_rad, half_width_rad=half_width_rad)
        known = set(before.matching.node_of)
        possible = interventions(kind, self._house, truth, self._rng, rooms=self._rooms, gaze=gaze, known=known)
        for intervention in possible:
            if kind == "add":  # it is there even where it does not come to rest where it should
                self._sizes[intervention.thing] = category_named(intervention.category).size_m
            with contextlib.suppress(DisturbError):
                await robot.disturb(dict(intervention.event))
                return intervention
        return None

    async def _look(self, place: str, before: Moment) -> str:
        """One look at a piece of furniture, or around its room where the graph does not know it; why it was not had."""
        node = self._runtime.memory.building().get(before.matching.node_of.get(place, ""))
        if isinstance(node, ObjectNode):
            return await self._look_at(node.id, InspectionSettings().standoff_from(node))
        item = next(item for item in self._house.furniture if item.id == place)
        room = self._rooms.get(room_at(self._house, item.pose[0], item.pose[1]) or "")
        return await self._look_at(room) if room is not None else "its room is not known"

    async def _look_at(self, target: str, standoff_m: float = 0.0) -> str:
        """Wish for a look at a node and wait for it; why it was not had, nothing when it was."""
        memory, began_s = self._runtime.memory, self._runtime.now_s
        memory.load(target, agent=AGENT, stamp_s=began_s)
        wish = HasIntentionEdge(
            source=ROBOT_ID,
            target=target,
            agent=AGENT,
            action=IntentionAction.LOOK,
            priority=Priority.MEASURE_ROOM,
            standoff_m=standoff_m,
            proposed_s=began_s,
        )
        memory.commit([PutEdge(wish)], agent=AGENT, stamp_s=began_s)
        edge: Edge | None = wish
        while self._runtime.now_s < began_s + self._timing.look_limit_s:
            await self._runtime.wait_for_change()
            edge = memory.snapshot().edges.get(wish.key)
            if not isinstance(edge, HasIntentionEdge) or edge.status in _ENDED:
                break
        if edge is not None:
            memory.commit([RemoveEdge(wish.key)], agent=AGENT, stamp_s=self._runtime.now_s)
        if not isinstance(edge, HasIntentionEdge):
            return "it is gone from the graph"
        return "" if edge.status is IntentionStatus.DONE else edge.reason or f"still {edge.status}"


def _run_table(runs: Sequence[Mapping[str, Any]]) -> Table:
    table = Table(title="houses")
    columns = ("house", "explored", "changes", "detected", "false alarms", "true things right", "nodes true", "wall s")
    for column in columns:
        table.add_column(column, justify="left" if column == "house" else "right")
    for run in runs:
        own = summarize([run])
        table.add_row(
            run["house"],
            "yes" if run["explored"] else "[red]no",
            f"{own['changes']}" + (f" ({own['not_made']} had no place)" if own["not_made"] else ""),
            shown(own["detected"]),
            str(sum(own["false_alarms_by_kind"].values())),
            shown(own["true_things_right"]),
            shown(own["nodes_right"]),
            f"{run['wall_seconds']:.0f}",
        )
    return table


def _kind_table(summary: Mapping[str, Any], aims: ChangeAims) -> Table:
    table = Table(title="changes", caption=f"aim: at least {aims.detected:g} of every kind detected")
    for column in ("kind", "made", "looked at", "detected", "under its name", "identity kept", "false alarms"):
        table.add_column(column, justify="left" if column == "kind" else "right")
    for kind, row in summary["kinds"].items():
        shares = (row["looked"], row["detected"], row["named"], row["identity_kept"])
        table.add_row(kind, str(row["made"]), *(shown(value) for value in shares), str(row["false_alarms"]))
    return table


def draw(
    summary: Mapping[str, Any], runs: Sequence[Mapping[str, Any]], file: Path, aims: ChangeAims = ChangeAims()
) -> None:
    """Detected share by kind, and how right the graph was change after change."""
    figure = Figure(figsize=(10.0, 3.6), layout="constrained")
    kinds, course = figure.subplots(1, 2)
    rows = summary["kinds"]
    kinds.bar(list(rows), [row["detected"] or 0.0 for row in rows.values()], color="#1d4ed8")
    kinds.axhline(aims.detected, color="#b91c1c", linestyle="--", linewidth=1.0)
    kinds.set(title="changes detected", ylim=(0.0, 1.05))
    for run in runs:
        rights = [change["true_things_right"] for change in run["changes"]]
        course.plot(range(1, len(rights) + 1), rights, marker="o", markersize=3, label=run["house"])
    course.axhline(aims.right, color="#b91c1c", linestyle="--", linewidth=1.0)
    course.set(title="share of true things that the graph has right", xlabel="changes so far", ylim=(0.0, 1.05))
    course.legend(fontsize=8)
    save(figure, file)
