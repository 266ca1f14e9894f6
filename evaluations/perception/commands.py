"""``majordomo evaluate tracking | network | perception | changes``."""

from __future__ import annotations

from typing import Annotated

import typer

from app.commands.options import Network
from app.commands.terminal import console
from evaluations.options import Jobs, JsonFile, Looked, Plot, Stocked
from perception.network.shipped import SHIPPED


def evaluate_tracking(
    repetitions: Annotated[int, typer.Option(min=1, help="Runs with measurements of their own.")] = 1000,
    measurements: Annotated[int, typer.Option(min=2, help="How often a thing at rest is seen in each.")] = 30,
    seed: Annotated[int, typer.Option(min=0)] = 0,
    json_file: JsonFile = None,
    plot: Plot = None,
) -> None:
    """Measure how well filters tell where a thing at rest or just moved is, beside the Filtering paper's table 1."""
    from evaluations.perception.tracking import evaluate

    good = evaluate(
        seed=seed,
        repetitions=repetitions,
        measurements=measurements,
        json_file=json_file,
        plot_file=plot,
        console=console,
    )
    raise typer.Exit(0 if good else 1)


def evaluate_network(
    model: Network = SHIPPED,
    houses: Annotated[int, typer.Option(min=1, help="How many generated houses.")] = 20,
    first_house: Annotated[int, typer.Option(min=0, help="Seed of the first house; the others follow.")] = 0,
    pictures: Annotated[int, typer.Option(min=1, help="Of each house.")] = 40,
    json_file: JsonFile = None,
    plot: Plot = None,
) -> None:
    """Show a network pictures of furnished houses, and count what it recognizes: things, masks, relations."""
    from evaluations.perception.network import evaluate

    good = evaluate(
        model=model,
        seeds=range(first_house, first_house + houses),
        pictures=pictures,
        json_file=json_file,
        plot_file=plot,
        console=console,
    )
    raise typer.Exit(0 if good else 1)


def evaluate_perception(
    houses: Stocked = 4,
    house: Looked = None,
    model: Network = SHIPPED,
    json_file: JsonFile = None,
    plot: Plot = None,
    jobs: Jobs = 2,
) -> None:
    """Let the robot look around in stocked houses, and compare every object in its graph with what is there."""
    from evaluations.perception.perception import evaluate

    names = _stocked(houses, house)
    good = evaluate(houses=names, model=model, jobs=jobs, json_file=json_file, plot_file=plot, console=console)
    raise typer.Exit(0 if good else 1)


def evaluate_changes(
    houses: Stocked = 4,
    house: Looked = None,
    changes: Annotated[int, typer.Option(min=1, help="In each house: moved, removed and brought in turn.")] = 15,
    model: Network = SHIPPED,
    json_file: JsonFile = None,
    plot: Plot = None,
    jobs: Jobs = 2,
) -> None:
    """Move, remove and add things behind the robot's back, let it look once, and count what it noticed."""
    from evaluations.perception.changes import evaluate

    names = _stocked(houses, house)
    good = evaluate(
        houses=names, changes=changes, model=model, jobs=jobs, json_file=json_file, plot_file=plot, console=console
    )
    raise typer.Exit(0 if good else 1)


def _stocked(houses: int, house: list[str] | None) -> list[str]:
    """Houses by name, or so many stocked ones when none is named."""
    names = house or [f"stocked:{number}" for number in range(houses)]
    if not names:
        raise typer.BadParameter("there is no house to look at: name one with --house, or ask for some with --houses")
    return names
