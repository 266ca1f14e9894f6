"""``majordomo evaluate demo``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app.commands.terminal import console
from evaluations.options import House, Jobs, JsonFile, Seeds


def evaluate_demo(
    seeds: Seeds = 10,
    json_file: JsonFile = None,
    house: House = "flat",
    jobs: Jobs = 2,
    logs: Annotated[Path | None, typer.Option(help="Folder for the runs' event logs.")] = None,
    first_seed: Annotated[int, typer.Option(min=0)] = 0,
) -> None:
    """Play the demonstration under several seeds and compare what was reported with the truth."""
    from evaluations.demo.demo import evaluate

    good = evaluate(
        house=house,
        seeds=range(first_seed, first_seed + seeds),
        jobs=jobs,
        logs=logs,
        json_file=json_file,
        console=console,
    )
    raise typer.Exit(0 if good else 1)
