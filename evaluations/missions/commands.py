"""``majordomo evaluate missions | endurance``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from app.commands.options import Network
from app.commands.terminal import console
from evaluations.options import House, Jobs, JsonFile, Looked, Seeds
from perception.network.shipped import SHIPPED


def evaluate_missions(
    house: Looked = None,
    commands: Annotated[
        Path | None, typer.Option(exists=True, dir_okay=False, help="A mission file: docs/missions.md.")
    ] = None,
    requests: Annotated[int, typer.Option(min=1, help="How many are invented for each house.")] = 10,
    disturb: Annotated[
        list[str] | None,
        typer.Option(help="What happens meanwhile, by name, or all; repeat it: each request gets the next one."),
    ] = None,
    seeds: Seeds = 1,
    model: Network = SHIPPED,
    json_file: JsonFile = None,
    pictures: Annotated[
        Path | None, typer.Option(file_okay=False, help="Folder for a picture of each mission: way and camera.")
    ] = None,
    jobs: Jobs = 2,
) -> None:
    """Let the robot explore houses and carry out requests there while people interfere; compare with the truth."""
    from evaluations.missions.evaluation import OWN_HOUSES, evaluate
    from evaluations.missions.mission_file import MissionFileError

    try:
        good = evaluate(
            houses=house or OWN_HOUSES,
            commands=commands,
            requests=requests,
            disturb=_disturbances(disturb),
            seeds=range(seeds),
            model=model,
            jobs=jobs,
            json_file=json_file,
            console=console,
            pictures=pictures,
        )
    except MissionFileError as error:
        raise typer.BadParameter(str(error), param_hint="--commands") from error
    raise typer.Exit(0 if good else 1)


def evaluate_endurance(
    house: House = "flat",
    hours: Annotated[float, typer.Option(min=0.01, help="Simulated hours.")] = 3.0,
    requests: Annotated[int, typer.Option(min=1, help="How many between two accounts of the graph.")] = 10,
    disturb: Annotated[
        list[str] | None, typer.Option(help="What happens meanwhile, as for missions; repeat it.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of noise and requests.")] = 0,
    model: Network = SHIPPED,
    json_file: JsonFile = None,
) -> None:
    """Give requests for hours in one service; whether memory stays flat and the graph right."""
    from evaluations.missions.endurance import evaluate

    good = evaluate(
        house=house,
        hours=hours,
        requests=requests,
        disturb=_disturbances(disturb),
        seed=seed,
        model=model,
        json_file=json_file,
        console=console,
    )
    raise typer.Exit(0 if good else 1)


def _disturbances(names: list[str] | None) -> tuple[str, ...]:
    """Names of disturbances, *all* among them; a wrong one is refused."""
    from evaluations.missions.disturbances import DISTURBANCES

    asked = tuple(DISTURBANCES) if names == ["all"] else tuple(names or ())
    unknown = sorted(set(asked) - set(DISTURBANCES))
    if unknown:
        raise typer.BadParameter(
            f"no {', '.join(unknown)}; there are {', '.join(DISTURBANCES)}", param_hint="--disturb"
        )
    return asked
