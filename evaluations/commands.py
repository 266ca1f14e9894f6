"""``majordomo evaluate …``: one command a measurement. What a command runs is loaded when it runs."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from app.commands.options import Network
from app.settings import Settings
from perception.network.shipped import SHIPPED

evaluations = typer.Typer(help="Measure something, print a table, write JSON.", no_args_is_help=True)

console = Console()


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


@evaluations.command("demo")
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


@evaluations.command("mapping")
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


@evaluations.command("noise")
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


@evaluations.command("localization")
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


@evaluations.command("resources")
def evaluate_resources(
    house: House = "flat",
    camera: Annotated[bool, typer.Option(help="Map with the camera on, or with the LiDAR alone.")] = True,
    json_file: JsonFile = None,
    plot: Plot = None,
) -> None:
    """Measure processor time and memory while a house is mapped, and while the known building grows to 1,000 rooms."""
    from evaluations.service.resources import evaluate

    good = evaluate(house=house, camera=camera, json_file=json_file, plot_file=plot, console=console)
    raise typer.Exit(0 if good else 1)


@evaluations.command("rates")
def evaluate_rates(
    house: House = "flat",
    seconds: Annotated[
        float, typer.Option(min=5.0, max=120.0, help="Wall seconds of each measurement; a replayed one fills 12 MB.")
    ] = 60.0,
    model: Network = SHIPPED,
    json_file: JsonFile = None,
) -> None:
    """Measure in real time whether agents and API keep up with the sensors, from memory and beside the simulator."""
    from evaluations.service.rates import evaluate

    good = evaluate(house=house, seconds=seconds, model=model, json_file=json_file, console=console)
    raise typer.Exit(0 if good else 1)


@evaluations.command("clients")
def evaluate_clients(
    house: House = "flat",
    seconds: Annotated[float, typer.Option(min=5.0, max=600.0, help="Wall seconds of each measurement.")] = 60.0,
    readers: Annotated[int, typer.Option(min=1, help="Clients of the event stream that read.")] = 180,
    mute: Annotated[int, typer.Option(min=0, help="Clients that never read.")] = 20,
    model: Network = SHIPPED,
    json_file: JsonFile = None,
) -> None:
    """Measure in real time whether clients of the event stream cost anything, and whether those that read miss any."""
    from evaluations.service.clients import evaluate

    good = evaluate(
        house=house, seconds=seconds, readers=readers, mute=mute, model=model, json_file=json_file, console=console
    )
    raise typer.Exit(0 if good else 1)


@evaluations.command("tracking")
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


@evaluations.command("network")
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


@evaluations.command("perception")
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


@evaluations.command("changes")
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


@evaluations.command("missions")
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


@evaluations.command("endurance")
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


@evaluations.command("planning")
def evaluate_planning(
    commands: Annotated[
        list[Path] | None,
        typer.Option(
            exists=True, dir_okay=False, readable=True, help="Requests of your own, see docs/requests.md; repeat it."
        ),
    ] = None,
    corrupt: Annotated[
        list[float] | None,
        typer.Option(min=0.0, max=1.0, help="Ask a model that errs in this share of its answers, too; repeat it."),
    ] = None,
    llm: Annotated[
        str | None, typer.Option(help="Language model for what the grammar cannot parse, PROVIDER:MODEL.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of the errors.")] = 0,
    json_file: JsonFile = None,
) -> None:
    """Put requests to the planner on stored graphs of 24 to 5,000 nodes, and compare what comes of them."""
    from app.stacks.language_model import key_in
    from evaluations.planning.evaluation import evaluate

    settings = Settings(llm=llm, llm_url=os.environ.get("MAJORDOMO_LLM_URL"), llm_key=key_in(os.environ))
    good = evaluate(
        files=commands or (), settings=settings, rates=corrupt or (), seed=seed, json_file=json_file, console=console
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


def _stocked(houses: int, house: list[str] | None) -> list[str]:
    """Houses by name, or so many stocked ones when none is named."""
    names = house or [f"stocked:{number}" for number in range(houses)]
    if not names:
        raise typer.BadParameter("there is no house to look at: name one with --house, or ask for some with --houses")
    return names
