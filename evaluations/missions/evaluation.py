"""``evaluate missions``: which missions are played where, and what they come to together."""

from __future__ import annotations

import asyncio
import json
from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path
from statistics import median
from typing import Any

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.table import Table

from evaluations.missions.attempts import HANDLING
from evaluations.missions.disturbances import DISTURBANCES
from evaluations.missions.episodes import Verdict, play_all
from evaluations.missions.mission import Mission
from evaluations.missions.mission_file import load_missions
from evaluations.missions.request_generator import invent
from evaluations.perception.perception import check, house_of
from evaluations.perception.recognition import share
from evaluations.pool import run_all
from evaluations.tables import shown

OWN_HOUSES = ("flat", "office", *(f"stocked:{number}" for number in range(20, 26)))
Row = Mapping[str, Any]


@dataclass(frozen=True, kw_only=True)
class LeastAims:
    """Shares that are to be reached: chosen, as high as a person would put up with."""

    success_undisturbed: float = 0.90
    success_disturbed: float = 0.80
    right_reason: float = 0.95
    """Of what was impossible, what the robot said."""
    picks: float = 0.95
    places: float = 0.97
    """At the first go."""


@dataclass(frozen=True, kw_only=True)
class MostAims:
    """What is not to be exceeded: nothing untrue, nothing touched, and ways a quarter longer than the shortest."""

    phantoms: int = 0
    collisions: int = 0
    way_over_shortest: float = 1.25


@dataclass(frozen=True, kw_only=True)
class MissionAims:
    """What missions are to come to together."""

    least: LeastAims = field(default_factory=LeastAims)
    most: MostAims = field(default_factory=MostAims)


def evaluate(
    *,
    houses: Sequence[str],
    commands: Path | None,
    requests: int,
    disturb: Sequence[str],
    seeds: Sequence[int],
    model: Path,
    jobs: int,
    json_file: Path | None,
    console: Console,
    pictures: Path | None = None,
    aims: MissionAims = MissionAims(),
) -> bool:
    """Play everything, print tables, write JSON; whether all aims were met.

    Args:
        houses: as ``evaluate perception`` takes them; not asked where ``commands`` names its own.
        commands: a mission file; without it ``requests`` are invented for each house.
        requests: how many for each house.
        disturb: names of what happens meanwhile, one a mission in turn; nothing by default.
        seeds: of every house's run.
        model: the network's file.
        jobs: runs at the same time.
        json_file: where to write the figures.
        console: where to print the tables.
        pictures: folder for a filmstrip of each mission; none by default.
        aims: what all is to come to.

    Raises:
        MissionFileError: what is wrong with the file; said before anything is played.
        HouseError: a house cannot be read.
        NetworkRefused: the network's file cannot be used.
    """
    missions = load_missions(commands) if commands is not None else _invented(houses, requests, disturb)
    names = list(dict.fromkeys(mission.house for mission in missions))
    check(names, model)
    for house in houses if commands is None else ():
        if house not in names:
            console.print(f"{house}: left out, as words fit no room and no thing there that do not fit another as well")
    played = [
        (name, [mission for mission in missions if mission.house == name], seed, model, pictures)
        for name in names
        for seed in seeds
    ]
    runs = run_all(run_once, played, jobs=jobs, console=console, what="houses")
    rows = [row for run in runs for row in run["missions"]]
    summary = summarize(rows)
    for title, key in (("by request", "kind"), ("by disturbance", "disturbance")):
        console.print(_table(title, rows, key))
    console.print(_aims(summary, aims))
    if json_file is not None:
        wanted = {"least": asdict(aims.least), "most": asdict(aims.most)}
        document = {"runs": runs, "summary": summary, **wanted, "met": met(summary, aims)}
        json_file.write_text(json.dumps(document, indent=1) + "\n", encoding="utf-8")
    return met(summary, aims) and all(run["explored"] for run in runs)


def run_once(
    name: str, missions: Sequence[Mission], seed: int, model: Path, pictures: Path | None = None
) -> dict[str, Any]:
    """One house, in this process."""
    return asyncio.run(play_all(name, house_of(name), missions, seed=seed, model=model, pictures=pictures))


def summarize(rows: Sequence[Row]) -> dict[str, Any]:
    """Figures over all missions. What was carried out was possible, whatever had been thought of it. What ended before
    anybody interfered was not disturbed.

    Single goes are counted where free floor led near enough from the start; those of the other missions by themselves.
    """
    upset = [row for row in rows if row["disturbance"] and row["made"]]
    calm = [row for row in rows if not (row["disturbance"] and row["made"]) and _was_possible(row)]
    possible = [row for row in upset if _was_possible(row)]
    impossible = [row for row in upset if not _was_possible(row)]
    near = [row for row in rows if row["within_reach"] or _done(row)]
    picks, places = (_first_goes(near, skill) for skill in HANDLING)
    ways = [row["driven_m"] / row["shortest_m"] for row in calm if _done(row) and (row["shortest_m"] or 0.0) > 1.0]
    return {
        "missions": len(rows),
        "success_undisturbed": share(sum(map(_done, calm)), len(calm)),
        "success_disturbed": share(sum(map(_done, possible)), len(possible)),
        "right_reason": share(sum(row["verdict"] == Verdict.RIGHTLY_IMPOSSIBLE for row in impossible), len(impossible)),
        "picks": share(sum(picks), len(picks)),
        "places": share(sum(places), len(places)),
        "attempts": {"PICK": len(picks), "PLACE": len(places)},
        "attempts_out_of_reach": sum(
            len(_first_goes(rows, skill)) - len(_first_goes(near, skill)) for skill in HANDLING
        ),
        "disturbed": len(upset),
        "impossible": len(impossible),
        "out_of_reach": len(rows) - len(upset) - len(calm),
        "not_made": sum(bool(row["disturbance"]) and not row["made"] for row in rows),
        "phantoms": sum(row["verdict"] == Verdict.PHANTOM for row in rows),
        "wrong_answers": sum(row["verdict"] == Verdict.WRONG_ANSWER for row in rows),
        "collisions": sum(row["collisions"] for row in rows),
        "way_over_shortest": median(ways) if ways else None,
        "verdicts": {verdict.value: sum(row["verdict"] == verdict for row in rows) for verdict in Verdict},
    }


def met(summary: Mapping[str, Any], aims: MissionAims = MissionAims()) -> bool:
    """Whether every figure that could be measured is where it is to be."""
    high = all(summary[name] is None or summary[name] >= aim for name, aim in asdict(aims.least).items())
    low = all(summary[name] is None or summary[name] <= aim for name, aim in asdict(aims.most).items())
    return high and low and summary["missions"] > 0


def _first_goes(rows: Sequence[Row], skill: str) -> list[bool]:
    """Of every attempt at a skill before anybody interfered, whether it came off."""
    return [go["done"] for row in rows for go in row["attempts"] if go["skill"] == skill and go["calm"]]


def _was_possible(row: Row) -> bool:
    return bool(row["possible"]) or _done(row)


def _done(row: Row) -> bool:
    return bool(row["verdict"] == Verdict.DONE)


def _invented(houses: Sequence[str], requests: int, disturb: Sequence[str]) -> list[Mission]:
    """Requests for every house; each is disturbed by what has not happened for longest of what can happen to it."""
    missions = []
    turn = list(disturb)
    for number, name in enumerate(houses):
        house = house_of(name)
        for mission in invent(name, house, count=requests, seed=number):
            disturbance = next((each for each in turn if DISTURBANCES[each].fits(mission, house)), "")
            turn = [*(each for each in turn if each != disturbance), *([disturbance] if disturbance else [])]
            missions.append(replace(mission, disturbance=disturbance))
    lasting = list(DISTURBANCES).index
    return sorted(missions, key=lambda m: (houses.index(m.house), lasting(m.disturbance) if m.disturbance else -1))


def _table(title: str, rows: Sequence[Row], key: str) -> Table:
    caption = "why, other: impossible, for the right reason or another; ref: refused"
    table = Table(title=title, caption=caption, box=SIMPLE_HEAD, padding=(0, 1, 0, 0))
    columns: Mapping[str, Callable[[Sequence[Row]], str]] = {
        "n": lambda group: str(len(group)),
        "done": lambda group: shown(share(sum(map(_done, group)), len(group)), 2),
        "why": lambda group: str(_count(group, Verdict.RIGHTLY_IMPOSSIBLE)),
        "other": lambda group: str(_count(group, Verdict.OTHER_REASON)),
        "phantom": lambda group: str(_count(group, Verdict.PHANTOM)),
        "wrong": lambda group: str(_count(group, Verdict.WRONG_ANSWER)),
        "fail": lambda group: str(_count(group, Verdict.HONEST_FAILURE)),
        "ref": lambda group: str(_count(group, Verdict.REFUSED)),
        "ask": lambda group: str(_count(group, Verdict.ASKED)),
        "hits": lambda group: str(sum(row["collisions"] for row in group)),
        "s": lambda group: f"{sum(row['seconds'] for row in group) / len(group):.0f}",
    }
    table.add_column(key, no_wrap=True)
    for column in columns:
        table.add_column(column, justify="right")
    groups: dict[str, list[Row]] = defaultdict(list)
    for row in rows:
        groups[row[key] or "none"].append(row)
    for name, group in [*sorted(groups.items()), ("all", list(rows))] if rows else []:
        table.add_row(name, *(tell(group) for tell in columns.values()))
    return table


def _count(rows: Sequence[Row], verdict: Verdict) -> int:
    return sum(row["verdict"] == verdict for row in rows)


def _aims(summary: Mapping[str, Any], aims: MissionAims) -> Table:
    table = Table(title="missions")
    for column in ("figure", "measured", "aim"):
        table.add_column(column, justify="left" if column == "figure" else "right")
    for wanted, sign in ((asdict(aims.least), ">="), (asdict(aims.most), "<=")):
        for name, aim in wanted.items():
            value = summary[name]
            table.add_row(
                name.replace("_", " "), str(value) if isinstance(value, int) else shown(value), f"{sign} {aim:g}"
            )
    return table
