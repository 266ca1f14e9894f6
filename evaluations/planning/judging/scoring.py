"""Figures of many records, and whether they are where they are to be."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from evaluations.planning.judging.judge import Verdict
from evaluations.planning.request_file import OWN
from evaluations.planning.runs import Record

OUT_OF_SCOPE = "out of scope"


@dataclass(frozen=True, kw_only=True)
class Band:
    """Aims for buildings of at most ``nodes`` nodes: processor time at the 99th percentile, and length of a prompt."""

    nodes: int
    ms: float
    tokens: int


@dataclass(frozen=True, kw_only=True)
class PlanningAims:
    """What planning is to come to; chosen."""

    right: float = 0.90
    """Of requests that nothing was developed against."""
    wrong_actions: float = 0.005
    declined: float = 0.98
    """Of what is out of scope, by name."""
    executable: float = 1.0
    bands: tuple[Band, ...] = (Band(nodes=200, ms=50.0, tokens=1500), Band(nodes=5000, ms=250.0, tokens=4000))
    slack: float = 1.02
    """Buildings count as of a size when they have a little more nodes."""
    corrupted: tuple[tuple[float, float], ...] = ((0.1, 0.98), (0.3, 0.95), (0.5, 0.85))
    """Share that is right with a model that slips so often."""

    def band(self, nodes: int) -> Band | None:
        """The smallest in which a building of so many nodes fits."""
        return next((band for band in self.bands if nodes <= self.slack * band.nodes), None)


def percentile(values: Sequence[float], share: float) -> float | None:
    """The smallest value that ``share`` of all do not exceed; ``None`` of nothing."""
    ordered = sorted(values)
    return ordered[max(0, math.ceil(share * len(ordered)) - 1)] if ordered else None


def summarize(records: Sequence[Record]) -> dict[str, Any]:
    """Counts, shares and costs of some records."""
    verdicts = Counter(record.verdict for record in records)
    ms = [each for record in records for each in record.ms]
    count = len(records)
    return {
        "requests": count,
        "right": verdicts[Verdict.RIGHT] / count if count else None,
        "wrong_actions": verdicts[Verdict.WRONG_ACTION] / count if count else None,
        "executable": _share([record.executable for record in records if record.acted]),
        "ms_p50": percentile(ms, 0.5),
        "ms_p99": percentile(ms, 0.99),
        "wall_ms_p99": percentile([each for record in records for each in record.wall_ms], 0.99),
        "prompt_tokens": max((record.prompt_tokens[0] for record in records), default=None),
        "prompt_tokens_with_schema": max((record.prompt_tokens[1] for record in records), default=None),
        "model_calls": sum(record.asked for record in records),
        "model_calls_at_most": max((record.asked for record in records), default=0),
    }


def by(records: Iterable[Record], key: Callable[[Record], str]) -> dict[str, dict[str, Any]]:
    """A summary for each value of ``key``, in order of appearance."""
    groups: dict[str, list[Record]] = {}
    for record in records:
        groups.setdefault(key(record), []).append(record)
    return {name: summarize(group) for name, group in groups.items()}


def band_of(record: Record, aims: PlanningAims = PlanningAims()) -> str:
    """The size of a record's building: ``at most 200 nodes``."""
    band = aims.band(record.nodes)
    return f"at most {band.nodes} nodes" if band is not None else "larger"


def figures(
    records: Sequence[Record],
    corrupted: Mapping[float, Sequence[Record]],
    aims: PlanningAims = PlanningAims(),
) -> list[dict[str, Any]]:
    """The figures that are aimed at: name, value, aim, and whether it is met. What was not measured has no row."""
    halves = {record.request.half for record in records}
    judged = [record for record in records if record.request.half != OWN[0] or OWN[1] not in halves]
    asked = [record for record in records if record.request.category == OUT_OF_SCOPE]
    rows = [
        _at_least("right, not developed against", summarize(judged)["right"], aims.right),
        _at_most("wrong actions", summarize(records)["wrong_actions"], aims.wrong_actions),
        _at_least("out of scope, declined by name", summarize(asked)["right"], aims.declined),
        _at_least("plans that can be carried out", summarize(records)["executable"], aims.executable),
    ]
    for band in aims.bands:
        group = summarize([record for record in records if aims.band(record.nodes) is band])
        rows.append(_at_most(f"tokens of a prompt, at most {band.nodes} nodes", group["prompt_tokens"], band.tokens))
    rows += _building_rows(records, aims)
    right = dict(aims.corrupted)
    for rate, these in corrupted.items():
        group = summarize(these)
        rows.append(_at_least(f"right with a model that slips at {rate:g}", group["right"], right.get(rate, 0.0)))
        rows.append(_at_least(f"plans that can be carried out at {rate:g}", group["executable"], aims.executable))
    return [row for row in rows if row["value"] is not None]


def _building_rows(records: Sequence[Record], aims: PlanningAims) -> list[dict[str, Any]]:
    """Processor time of each building that is of a size with an aim."""
    rows = []
    nodes = {record.request.building: record.nodes for record in records}
    for name, group in by(records, lambda record: record.request.building).items():
        band = aims.band(nodes[name])
        if band is not None:
            rows.append(_at_most(f"processor ms, 99 of 100, {name}", group["ms_p99"], band.ms))
    return rows


def slips(records: Iterable[Record]) -> dict[str, dict[str, int]]:
    """For each kind of slip, in how many requests it happened, and how many of those came out right."""
    counts: dict[str, dict[str, int]] = {}
    for record in records:
        for slip in dict.fromkeys(record.slips):
            row = counts.setdefault(slip, {"requests": 0, "right": 0, "wrong_actions": 0})
            row["requests"] += 1
            row["right"] += record.verdict is Verdict.RIGHT
            row["wrong_actions"] += record.verdict is Verdict.WRONG_ACTION
    return dict(sorted(counts.items()))


def _share(values: Sequence[bool]) -> float | None:
    return sum(values) / len(values) if values else None


def _at_least(name: str, value: float | None, aim: float) -> dict[str, Any]:
    return {"figure": name, "value": value, "aim": f">= {aim:g}", "met": value is not None and value >= aim}


def _at_most(name: str, value: float | None, aim: float) -> dict[str, Any]:
    return {"figure": name, "value": value, "aim": f"<= {aim:g}", "met": value is not None and value <= aim}
