"""Options that commands of evaluations share; light to import, as ``majordomo`` has to load them."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer


def _in_a_folder(file: Path | None) -> Path | None:
    """Make the file's folder, and refuse, before anything is measured, what could not be written afterwards."""
    if file is None:
        return None
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise typer.BadParameter(f"{file} cannot be written: {error}") from error
    if not file.exists() and not os.access(file.parent, os.W_OK):
        raise typer.BadParameter(f"{file} cannot be written: no permission")
    return file


def _picture(file: Path | None) -> Path | None:
    if file is not None and file.suffix.lower() != ".png":
        raise typer.BadParameter(f"{file} does not end in .png")
    return _in_a_folder(file)


House = Annotated[str, typer.Option(help="A built-in house's name or a house file.")]
Houses = Annotated[
    list[str] | None, typer.Option("--house", help="House files, names of built-in houses, or generated:N; repeat it.")
]
Seeds = Annotated[int, typer.Option(min=1, help="Runs of each, with seeds 0, 1, 2 …")]
JsonFile = Annotated[
    Path | None,
    typer.Option("--json", dir_okay=False, writable=True, callback=_in_a_folder, help="Where to write the figures."),
]
Plot = Annotated[
    Path | None,
    typer.Option(dir_okay=False, writable=True, callback=_picture, help="Where to draw them, a PNG file."),
]
Stocked = Annotated[int, typer.Option(min=0, help="How many stocked houses, of two to six rooms.")]
Looked = Annotated[
    list[str] | None,
    typer.Option(
        "--house",
        help="House files, names of built-in houses, stocked:N or generated:N, instead of --houses; repeat it.",
    ),
]
Jobs = Annotated[int, typer.Option(min=1, help="Runs at the same time.")]
