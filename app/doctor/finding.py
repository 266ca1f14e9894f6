"""What the doctor finds, and how it is told."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import asdict, dataclass
from enum import StrEnum
from typing import Any

from rich.console import Console
from rich.text import Text


class Health(StrEnum):
    """How a check came out; only ``bad`` keeps something from working."""

    WELL = "ok"
    ODD = "odd"
    BAD = "bad"


_STYLES = {Health.WELL: "green", Health.ODD: "yellow", Health.BAD: "red"}


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One check: what was looked at, how it came out, what was found, and what to do if it is not well."""

    name: str
    health: Health = Health.WELL
    text: str
    advice: str = ""


def tell(findings: Iterable[Finding], console: Console) -> None:
    """Print findings, a line each, and the advice below."""
    for finding in findings:
        style = _STYLES[finding.health]
        mark = (f"{finding.health.upper() if finding.health is Health.BAD else finding.health:<4}", style)
        console.print(Text.assemble(mark, f" {finding.name:<10} ", finding.text), soft_wrap=True)
        if finding.advice:
            console.print(Text.assemble(" " * 16, ("→ ", style), finding.advice), soft_wrap=True)


def document(findings: Iterable[Finding]) -> dict[str, Any]:
    """Findings as plain data; ``healthy`` when none is bad."""
    listed = list(findings)
    return {"healthy": healthy(listed), "findings": [asdict(finding) for finding in listed]}


def healthy(findings: Iterable[Finding]) -> bool:
    """Whether nothing is bad."""
    return all(finding.health is not Health.BAD for finding in findings)
