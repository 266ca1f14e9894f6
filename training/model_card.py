"""Writes what ``majordomo evaluate network --json`` measured into the model card, between its two marks."""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from evaluations.perception.network import NetworkAims
from evaluations.perception.recognition import CLEAR_PX
from evaluations.tables import shown

BEGIN, END = "<!-- figures -->\n", "<!-- end of figures -->\n"
_CONFUSIONS = 16


class CardError(ValueError):
    """The card has no place for figures."""


def write(card: Path, report: Path) -> None:
    """Replace the figures of ``card`` by those of ``report``.

    Raises:
        CardError: the marks are not there.
    """
    text = card.read_text(encoding="utf-8")
    head, begin, rest = text.partition(BEGIN)
    _, end, tail = rest.partition(END)
    if not begin or not end:
        raise CardError(f"{card} has no lines {BEGIN.strip()} and {END.strip()}")
    figures = tables(json.loads(report.read_text(encoding="utf-8")))
    card.write_text(f"{head}{BEGIN}\n{figures}\n{END}{tail}", encoding="utf-8")


def tables(report: Mapping[str, Any], aims: NetworkAims = NetworkAims()) -> str:
    """The figures as Markdown."""
    model = report["model"]
    lines = [
        f"{report['pictures']} pictures.",
        "",
        "| figure | measured | aim |",
        "|---|---|---|",
        *(f"| {name.replace('_', ' ')} | {shown(report[name])} | ≥ {aim:.2f} |" for name, aim in aims.shares.items()),
        f"| relation mean recall@20 | {shown(report['relation_mean_recall_at_20'])} | |",
        f"| recall@20 of support (on, in) | {shown(report['support_recall_at_20'])} | |",
        f"| ms a frame, {model['threads']} threads | {model['median_ms']:.1f} | ≤ {aims.frame_ms:.0f} |",
        f"| file, MB | {model['megabytes']:.1f} | ≤ {aims.file_mb:.0f} |",
        "",
        f"| things from {CLEAR_PX} pixels up | shown | recall | found under any name | precision | mask IoU |",
        "|---|---|---|---|---|---|",
        *(_class_row(name, row) for name, row in sorted(report["classes"].items())),
        "",
        "| pixels from | " + " | ".join(report["recall_by_pixels"]) + " |",
        "|---" * (len(report["recall_by_pixels"]) + 1) + "|",
        "| recall | " + " | ".join(shown(value) for value in report["recall_by_pixels"].values()) + " |",
        "",
        "| predicate | " + " | ".join(report["relation_recall_by_predicate"]) + " |",
        "|---" * (len(report["relation_recall_by_predicate"]) + 1) + "|",
        "| recall@20 | " + " | ".join(shown(one) for one in report["relation_recall_by_predicate"].values()) + " |",
        "",
        "Most often mistaken: "
        + ", ".join(f"{true} as {given} ({count})" for true, given, count in report["confusions"][:_CONFUSIONS])
        + ".",
    ]
    return "\n".join(lines) + "\n"


def _class_row(name: str, row: Mapping[str, Any]) -> str:
    shares = (row["recall"], row["found_under_any_name"], row["precision"], row["mask_iou"])
    return f"| {name} | {row['there']} | " + " | ".join(shown(value, 2) for value in shares) + " |"
