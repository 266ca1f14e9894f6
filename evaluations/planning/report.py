"""Tables and JSON of what was measured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from rich.table import Table

from evaluations.planning.judging.judge import Verdict
from evaluations.planning.judging.scoring import band_of, by, figures, slips, summarize
from evaluations.planning.runs import Record
from evaluations.tables import shown


def category_table(records: Sequence[Record]) -> Table:
    """Share right and number of requests, by category and half."""
    halves = tuple(dict.fromkeys(record.request.half for record in records))
    groups = by(records, lambda record: f"{record.request.category}|{record.request.half}")
    table = Table(title="requests that came out right")
    table.add_column("category")
    for half in halves:
        table.add_column(half.replace("_", " "), justify="right")
        table.add_column("wrong actions", justify="right")
    for category in dict.fromkeys(record.request.category for record in records):
        table.add_row(category, *_cells([groups.get(f"{category}|{half}") for half in halves]))
    whole = by(records, lambda record: record.request.half)
    table.add_section()
    table.add_row("all", *_cells([whole[half] for half in halves]))
    return table


def _cells(groups: Sequence[Mapping[str, Any] | None]) -> list[str]:
    cells = []
    for group in groups:
        if group is None:
            cells += ["–", "–"]
            continue
        right, wrong = (round(group[name] * group["requests"]) for name in ("right", "wrong_actions"))
        cells += [f"{right} of {group['requests']}", str(wrong) if wrong else ""]
    return cells


def building_table(records: Sequence[Record]) -> Table:
    """What a request costs, by building."""
    table = Table(title="cost of a request: milliseconds of the processor, the graph newly read for each")
    columns = (
        "building",
        "nodes",
        "requests",
        "ms, median",
        "99 of 100",
        "wall, 99 of 100",
        "prompt tokens",
        "with schema",
        "calls",
    )
    for column in columns:
        table.add_column(column, justify="left" if column == "building" else "right")
    nodes = {record.request.building: record.nodes for record in records}
    for name, group in by(records, lambda record: record.request.building).items():
        table.add_row(
            name,
            str(nodes[name]),
            str(group["requests"]),
            shown(group["ms_p50"], 1),
            shown(group["ms_p99"], 1),
            shown(group["wall_ms_p99"], 1),
            str(group["prompt_tokens"]),
            str(group["prompt_tokens_with_schema"]),
            str(group["model_calls"]),
        )
    return table


def slip_table(corrupted: Mapping[float, Sequence[Record]]) -> Table:
    """What became of requests in which a model slipped."""
    table = Table(title="a model that slips, and no grammar before it")
    for column in ("rate", "slip", "requests", "right", "wrong actions"):
        table.add_column(column, justify="left" if column == "slip" else "right")
    for rate, records in corrupted.items():
        whole = summarize(records)
        cells = _cells([whole])
        table.add_row(f"{rate:g}", f"any or none, {whole['model_calls_at_most']} calls at most", "", *cells)
        for slip, row in slips(records).items():
            table.add_row(
                "", slip.replace("_", " "), str(row["requests"]), str(row["right"]), str(row["wrong_actions"])
            )
        table.add_section()
    return table


def figure_table(rows: Sequence[Mapping[str, Any]]) -> Table:
    """The figures that are aimed at."""
    table = Table(title="aims")
    for column in ("figure", "measured", "aim"):
        table.add_column(column, justify="left" if column == "figure" else "right")
    for row in rows:
        measured = shown(row["value"]) if row["value"] <= 1.0 else f"{row['value']:.0f}"
        table.add_row(row["figure"], measured if row["met"] else f"[red]{measured}", row["aim"])
    return table


def failures(records: Sequence[Record]) -> list[str]:
    """One line for every request that did not come out right."""
    return [
        f"{record.request.name} ({record.request.building}, {record.request.category}) "
        f"{' / '.join(turn.text for turn in record.request.turns)!r}: "
        f"{'WRONG ACTION, ' if record.verdict is Verdict.WRONG_ACTION else ''}{record.reason}"
        for record in records
        if record.verdict is not Verdict.RIGHT
    ]


def document(
    records: Sequence[Record], corrupted: Mapping[float, Sequence[Record]], model: str | None
) -> dict[str, Any]:
    """Everything that was measured, as JSON."""
    rows = figures(records, corrupted)
    return {
        "model": model,
        "figures": rows,
        "met": all(row["met"] for row in rows),
        "halves": {
            half: {
                **summarize(group),
                "categories": by(group, lambda record: record.request.category),
            }
            for half, group in _halves(records).items()
        },
        "buildings": by(records, lambda record: record.request.building),
        "sizes": by(records, band_of),
        "corrupted": {
            f"{rate:g}": {**summarize(these), "slips": slips(these), "failures": failures(these)}
            for rate, these in corrupted.items()
        },
        "requests": [_row(record) for record in records],
    }


def _halves(records: Sequence[Record]) -> dict[str, list[Record]]:
    halves: dict[str, list[Record]] = {}
    for record in records:
        halves.setdefault(record.request.half, []).append(record)
    return halves


def _row(record: Record) -> dict[str, Any]:
    request = record.request
    return {
        "request": request.name,
        "category": request.category,
        "building": request.building,
        "turns": [turn.text for turn in request.turns],
        "verdict": record.verdict.value,
        "reason": record.reason,
        "ms": [round(each, 2) for each in record.ms],
        "prompt_tokens": record.prompt_tokens[0],
        "model_calls": record.asked,
    }
