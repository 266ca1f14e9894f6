"""What commands say to people: results on standard output, everything else beside it."""

from __future__ import annotations

import typer
from rich.console import Console

console = Console()
complaints = Console(stderr=True)


def refused(reason: str) -> typer.Exit:
    """Say why a command is not carried out; to be raised."""
    complaints.print(reason, style="red", markup=False, highlight=False, soft_wrap=True)
    return typer.Exit(2)
