"""``majordomo evaluate mapping | noise | localization``."""

from __future__ import annotations

from typing import Annotated

import typer

from app.commands.terminal import console
from evaluations.options import Houses, Jobs, JsonFile, Plot, Seeds


def evaluate_mapping(
    houses: Annotated[int, typer.Option(min=0, help="How many generated houses, of 4 to 12 rooms.")] = 4,
    seeds: Seeds = 1,
    full: Annotated[
        bool, typer.Option("--full", help="20 generated houses and those that ship with the package.")
    ] = False,
    house: Houses = None,
    json_file: JsonFile = None,
    plot: Plot = None,
    jobs: Jobs = 2,
) -> None:
    """Let the robot map houses, and compare rooms and doors with the truth and with the paper's table 2."""
    from evaluations.mapping.mapping import evaluate
    from simulation.houses.house_file import builtin_houses

    names = [f"generated:{number}" for number in range(20 if full else houses)]
    names += [*(builtin_houses() if full else ()), *(house or ())]
    good = evaluate(houses=names, seeds=range(seeds), jobs=jobs, json_file=json_file, plot_file=plot, console=console)
    raise typer.Exit(0 if good else 1)


def evaluate_noise(
    house: Houses = None,
    seeds: Seeds = 1,
    json_file: JsonFile = None,
    plot: Plot = None,
    jobs: Jobs = 2,
) -> None:
    """Raise the noise of LiDAR and odometry, one at a time, until the map is no longer right."""
    from evaluations.mapping.noise import evaluate

    good = evaluate(
        houses=house or ("flat", "generated:1"),
        seeds=range(seeds),
        jobs=jobs,
        json_file=json_file,
        plot_file=plot,
        console=console,
    )
    raise typer.Exit(0 if good else 1)


def evaluate_localization(
    hours: Annotated[float, typer.Option(min=0.01, help="Simulated hours of driving in each house.")] = 4.0,
    house: Houses = None,
    json_file: JsonFile = None,
    plot: Plot = None,
    jobs: Jobs = 2,
) -> None:
    """Drive from room to room for hours, and compare where the robot believes to be with where it is."""
    from evaluations.mapping.localization import evaluate

    good = evaluate(
        houses=house or ("office",), hours=hours, jobs=jobs, json_file=json_file, plot_file=plot, console=console
    )
    raise typer.Exit(0 if good else 1)
