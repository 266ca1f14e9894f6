"""``evaluate endurance``: hours of missions in one house and one service, and whether it ends as it began."""

from __future__ import annotations

import asyncio
import contextlib
import json
import os
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from statistics import median
from typing import Any

import numpy as np
from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from app.runtime import Runtime
from evaluations.mapping.exploration import service_in_lockstep, until_explored
from evaluations.missions.disturbances import DISTURBANCES
from evaluations.missions.episodes import play_mission, scene_of
from evaluations.missions.evaluation import summarize
from evaluations.missions.mission import Mission
from evaluations.missions.outcome import Scene
from evaluations.missions.request_generator import invent
from evaluations.missions.simulated_user import SimulatedUser
from evaluations.perception.belief_scores import Sightings, score_house
from evaluations.perception.belief_scores import summarize as summarize_graph
from evaluations.perception.inventory import graph_contents, sizes_of, true_things
from evaluations.perception.perception import check, house_of
from evaluations.pool import run_all, tell
from evaluations.service.resources import resident_mb
from evaluations.tables import shown
from simulation.errors import DisturbError
from simulation.houses.house import House, Object

_GRAPH = ("recall", "precision", "duplicates", "support_right", "size_error_furniture_m")


@dataclass(frozen=True, kw_only=True)
class EnduranceAims:
    """What hours of missions may change."""

    growth: float = 1.05
    """Memory is flat when the last fifth of the time has at most so many times that of the first after warming up."""
    warm: float = 0.1
    """Share of the time in which caches and buffers may fill."""
    worse: float = 0.05
    """So much recall and precision of the graph may be lower at the end than after exploration."""
    swollen_m: float = 0.03
    """So much farther off may the sides of furniture be, in the mean: the arm goes by them."""


def evaluate(
    *,
    house: str,
    hours: float,
    requests: int,
    disturb: Sequence[str],
    seed: int,
    model: Path,
    json_file: Path | None,
    console: Console,
) -> bool:
    """Give requests for so many simulated hours, print tables, write JSON; whether all went on as it began.

    Args:
        house: as ``evaluate perception`` takes it.
        hours: simulated.
        requests: how many are invented between two accounts of the graph.
        disturb: names of what happens meanwhile, one a mission in turn; nothing by default.
        seed: of noise and requests.
        model: the network's file.
        json_file: where to write the figures, after every round, so that a run that is cut off is not lost.
        console: where to print the tables.

    Raises:
        HouseError: the house cannot be read.
        NetworkRefused: the network's file cannot be used.
    """
    check([house], model)
    arguments = (house, hours, requests, tuple(disturb), seed, model, json_file)
    run = run_all(run_once, [arguments], jobs=1, console=console, what="hours")[0]
    console.print(_table(run))
    if json_file is not None:
        _write(run, json_file)
    return bool(run["met"])


def run_once(
    house: str, hours: float, requests: int, disturb: Sequence[str], seed: int, model: Path, json_file: Path | None
) -> dict[str, Any]:
    """One house, in this process."""
    return asyncio.run(_run(house, house_of(house), hours, requests, disturb, seed, model, json_file))


async def _run(
    name: str,
    house: House,
    hours: float,
    requests: int,
    disturb: Sequence[str],
    seed: int,
    model: Path,
    json_file: Path | None,
) -> dict[str, Any]:
    began = time.monotonic()
    async with service_in_lockstep(house, seed, camera=True, model=model) as runtime:
        explored = await until_explored(runtime, house)
        tell(f"{name}: {'explored' if explored else 'given up'} after {runtime.now_s:.0f} simulated seconds")
        SimulatedUser(runtime, house).introduce()
        run: dict[str, Any] = {"house": name, "seed": seed, "hours": hours, "explored": explored}
        run |= {"rounds": [await _account(runtime, house)], "missions": [], "memory": [_memory(runtime)]}
        while runtime.now_s < 3600.0 * hours:
            await _round(runtime, house, run, requests, disturb)
            run |= {"seconds": round(runtime.now_s, 1), "wall_seconds": round(time.monotonic() - began, 1)}
            run["failed_turns"] = sum(turns.restarts for turns in runtime.turns())
            run |= _judged(run)
            tell(_progress(run))
            if json_file is not None:
                _write(run, json_file)
        return run


async def _round(runtime: Runtime, house: House, run: dict[str, Any], requests: int, disturb: Sequence[str]) -> None:
    """As many requests as the house as it now is allows for; then the graph is compared, and people tidy up."""
    number, until_s = len(run["rounds"]), 3600.0 * run["hours"]
    missions = invent(run["house"], as_it_is(await scene_of(runtime, house)), count=requests, seed=number)
    for index, mission in enumerate(missions):
        if runtime.now_s >= until_s:
            break
        upset = replace(mission, disturbance=_next(disturb, len(run["missions"]), mission, house))
        rng = np.random.default_rng((run["seed"], number, index))
        row = await play_mission(runtime, house, upset, rng)
        run["missions"].append({"round": number, "began_s": round(runtime.now_s - row["seconds"], 1), **row})
        run["memory"].append(_memory(runtime))
        tell(f"{runtime.now_s:.0f} s: {row['verdict']}: {upset.request} [{upset.disturbance or 'undisturbed'}]")
    run["rounds"].append(await _account(runtime, house))
    await _tidy_up(runtime, house)


def as_it_is(scene: Scene) -> House:
    """The house with its things where they now are; what is on something that can be moved stands for itself."""
    carriers = {item.id for item in scene.house.furniture}
    built = {entry.id: entry for entry in scene.house.objects}
    things = [_where_it_is(built[r["id"]], r, carriers) for r in scene.truth["objects"] if r["id"] in built]
    return scene.house.model_copy(update={"objects": tuple(things)})


def _where_it_is(entry: Object, record: Mapping[str, Any], carriers: set[str]) -> Object:
    on, inside = (carrier if carrier in carriers else None for carrier in (record["on"], record["in"]))
    pose = (*record["position_m"], 0.0) if on is None and inside is None else None
    return entry.model_copy(update={"on": on, "in_": inside, "offset": None, "pose": pose})


async def _tidy_up(runtime: Runtime, house: House) -> None:
    """People put back what lies on the floor or was handed to them; the robot has to find that out."""
    now = as_it_is(await scene_of(runtime, house))
    held = (await scene_of(runtime, house)).holding
    there = {entry.id: entry for entry in now.objects}
    for entry in house.objects:
        lying = entry.id in there and there[entry.id].pose is not None and entry.id != held
        if lying and (entry.on or entry.in_):
            to = {"on": entry.on} if entry.on else {"in": entry.in_}
            with contextlib.suppress(DisturbError):  # its place is taken by now: it stays where it is
                await runtime.require_robot().disturb({"do": "move", "id": entry.id, "to": to})


async def _account(runtime: Runtime, house: House) -> dict[str, Any]:
    """How right the graph is now, and what exactly is wrong in it."""
    truth = await runtime.require_robot().truth()
    sizes = {record["id"]: size for record in truth["objects"] if (size := sizes_of(house).get(record["id"]))}
    known = {**truth, "objects": [record for record in truth["objects"] if record["id"] in sizes]}
    graph = graph_contents(runtime.views.scene.document(), house)
    unseen = Sightings(in_view_m={}, renewed_m={}, seconds=runtime.now_s, switches=0)
    scored = score_house(house, true_things(house, known, sizes), graph, unseen)
    figures = summarize_graph([scored])
    return {
        "stamp_s": round(runtime.now_s, 1),
        **{name: figures[name] for name in ("things", "nodes", *_GRAPH)},
        "wrong_nodes": [node for node in scored["nodes"] if node["is"] != "named"],
        "not_found": [thing["id"] for thing in scored["things"] if thing["found"] != "named"],
    }


def _memory(runtime: Runtime) -> dict[str, float]:
    pid = runtime.require_robot().pid
    return {
        "stamp_s": round(runtime.now_s, 1),
        "service_mb": round(resident_mb(os.getpid()), 1),
        "simulator_mb": round(resident_mb(pid), 1) if pid else 0.0,
    }


def _next(disturb: Sequence[str], turn: int, mission: Mission, house: House) -> str:
    """The next disturbance that can happen to the mission."""
    names = [disturb[(turn + k) % len(disturb)] for k in range(len(disturb))]
    return next((name for name in names if DISTURBANCES[name].fits(mission, house)), "")


def _judged(run: Mapping[str, Any], aims: EnduranceAims = EnduranceAims()) -> dict[str, Any]:
    """Figures of the run so far."""
    growth = {name: grown(run["memory"], name, aims) for name in ("service_mb", "simulator_mb")}
    right = is_as_right(run["rounds"][0], run["rounds"][-1], aims)
    figures = summarize(run["missions"])
    good = run["explored"] and right and not figures["phantoms"] and not figures["collisions"]
    flat = growth["service_mb"] <= aims.growth
    return {"growth": growth, "summary": figures, "met": bool(good and flat and not run["failed_turns"])}


def is_as_right(first: Mapping[str, Any], last: Mapping[str, Any], aims: EnduranceAims = EnduranceAims()) -> bool:
    """Whether the graph is about as right as after exploration."""
    names = ("recall", "precision", "size_error_furniture_m")
    if any(account[name] is None for account in (first, last) for name in names):
        return False
    recall, precision, size_m = (last[name] - first[name] for name in names)
    return bool(recall >= -aims.worse and precision >= -aims.worse and size_m <= aims.swollen_m)


def grown(samples: Sequence[Mapping[str, float]], name: str, aims: EnduranceAims = EnduranceAims()) -> float:
    """Median of the last fifth of the time over that of the first fifth once warm; 1 while that is too short."""
    end_s = samples[-1]["stamp_s"]
    first = [each[name] for each in samples if aims.warm * end_s <= each["stamp_s"] <= (aims.warm + 0.2) * end_s]
    last = [each[name] for each in samples if each["stamp_s"] >= 0.8 * end_s]
    return median(last) / median(first) if first and last and median(first) > 0.0 else 1.0


def _progress(run: Mapping[str, Any]) -> str:
    last, memory = run["rounds"][-1], run["memory"][-1]
    return (
        f"{run['house']}: {run['seconds'] / 3600.0:.2f} h, {len(run['missions'])} missions, "
        f"recall {shown(last['recall'])}, precision {shown(last['precision'])}, service {memory['service_mb']:.0f} MB"
    )


def _table(run: Mapping[str, Any], aims: EnduranceAims = EnduranceAims()) -> Table:
    table = Table(title=f"{run['hours']:g} simulated hours in {run['house']}", box=SIMPLE_HEAD)
    for column in ("figure", "measured", "aim"):
        table.add_column(column, justify="left" if column == "figure" else "right")
    figures, first, last = run["summary"], run["rounds"][0], run["rounds"][-1]
    rows = [
        ("missions", str(figures["missions"]), ""),
        ("success, undisturbed", shown(figures["success_undisturbed"]), ""),
        ("success, disturbed", shown(figures["success_disturbed"]), ""),
        ("phantom successes", str(figures["phantoms"]), "0"),
        ("collisions", str(figures["collisions"]), "0"),
        ("restarts of agents", str(run["failed_turns"]), "0"),
        ("service's memory, last fifth over first", shown(run["growth"]["service_mb"]), f"<= {aims.growth:g}"),
        ("simulator's memory, last fifth over first", shown(run["growth"]["simulator_mb"]), ""),
    ]
    rows += [
        (f"graph: {name.replace('_', ' ')}, at the end", shown(last[name]), f"after exploration {shown(first[name])}")
        for name in _GRAPH
    ]
    for row in rows:
        table.add_row(*row)
    return table


def _write(run: Mapping[str, Any], file: Path) -> None:
    file.write_text(json.dumps(run, indent=1) + "\n", encoding="utf-8")
