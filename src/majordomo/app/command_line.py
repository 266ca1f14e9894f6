"""The command line: ``majordomo demo | serve | ask | plan | house | evaluate | doctor``."""

from __future__ import annotations

import asyncio
import json
import logging
import os
import sys
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from majordomo.app.evaluations.commands import evaluations
from majordomo.app.options import Network
from majordomo.app.settings import DEFAULT_DATA, ClockMode, Settings
from majordomo.perception.network.shipped import SHIPPED

application = typer.Typer(
    name="majordomo",
    help="A robot butler that maps its building, plans on a scene graph, and checks what it did.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
application.add_typer(evaluations, name="evaluate")

console = Console()
complaints = Console(stderr=True)

House = Annotated[str, typer.Option(help="A built-in house's name or a house file.")]
Seed = Annotated[int, typer.Option(min=0, help="Seed of everything that is random.")]
Data = Annotated[Path, typer.Option(help="Folder of token, logs and memory.")]


def main() -> None:
    """Entry point; expected problems end with a sentence and exit code 2, never with a stack trace."""
    from majordomo.app.evaluations.planning.errors import LineError
    from majordomo.app.runtime import RobotUnavailable
    from majordomo.app.server import RefusedToBind
    from majordomo.perception.network.errors import NetworkRefused
    from majordomo.planner.errors import BadModelKey, BadModelSpec
    from majordomo.scene_graph.errors import SceneFormatError
    from majordomo.simulation.errors import HouseError, SimulatorError

    try:
        application()
    except (
        RefusedToBind, HouseError, SimulatorError, RobotUnavailable, SceneFormatError, BadModelKey, BadModelSpec,
        NetworkRefused, LineError, OSError,
    ) as error:  # fmt: skip
        complaints.print(f"majordomo: {error}", style="red", markup=False, highlight=False)
        sys.exit(2)
    except KeyboardInterrupt:
        sys.exit(130)


@application.command()
def serve(
    house: House = "flat",
    seed: Seed = 0,
    clock: Annotated[
        ClockMode, typer.Option(help="Follow the wall clock, or simulated time in lockstep.")
    ] = ClockMode.REAL,
    speed: Annotated[str, typer.Option(help="Simulated seconds per second, or 'max' (lockstep only).")] = "1",
    port: Annotated[int, typer.Option(min=0, max=65535, help="0 picks a free one.")] = 8642,
    host: Annotated[str, typer.Option(help="Address to listen on.")] = "127.0.0.1",
    llm: Annotated[
        str | None, typer.Option(help="Language model, PROVIDER:MODEL; providers are openai, ollama and anthropic.")
    ] = None,
    llm_context: Annotated[
        int | None, typer.Option(envvar="MAJORDOMO_LLM_CONTEXT", min=1024, help="Its context length in tokens.")
    ] = None,
    model: Network = SHIPPED,
    data: Data = DEFAULT_DATA,
    simulation_api: Annotated[bool, typer.Option("--simulation-api", help="Offer truth and disturbances.")] = False,
    explore: Annotated[bool, typer.Option(help="Explore the building unasked.")] = True,
    camera: Annotated[bool, typer.Option(help="Use the RGB-D camera.")] = True,
    remember: Annotated[
        bool, typer.Option("--remember/--forget", help="Go on with the building as it was known, or begin anew.")
    ] = True,
    graph: Annotated[Path | None, typer.Option(help="Serve a stored scene graph without a robot.")] = None,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Log every frame's doings.")] = False,
) -> None:
    """Start the service; the first line printed is the page's address."""
    from majordomo.app.http.security import Token
    from majordomo.app.runtime import Runtime
    from majordomo.app.server import SWITCH_INTERVAL_S, bind, check_exposure, page_address
    from majordomo.app.server import serve as serve_forever

    sys.setswitchinterval(SWITCH_INTERVAL_S)
    settings = Settings(
        house=house,
        seed=seed,
        clock=clock,
        speed=_speed(speed, clock),
        port=port,
        host=host,
        llm=llm,
        llm_url=os.environ.get("MAJORDOMO_LLM_URL"),
        llm_key=os.environ.get("MAJORDOMO_LLM_KEY"),
        llm_context=llm_context,
        data=data,
        simulation_api=simulation_api,
        explore=explore,
        camera=camera,
        remember=remember,
        graph=graph,
        model=model,
    )
    _log_to_stderr(verbose=verbose)
    runtime = Runtime(settings)
    token = Token.stored_in(settings.data_folder)
    check_exposure(settings, has_token=True)
    with bind(settings) as listener:
        address = page_address(listener, token)
        started = asyncio.run(serve_forever(runtime, listener, token, lambda: print(address, flush=True)))
    if not started:
        raise typer.Exit(2)


@application.command()
def demo(
    house: House = "flat",
    seed: Seed = 0,
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port of the page to watch it on; 0 picks one.")] = 0,
) -> None:
    """Explore, carry out one request while a person interferes, and report what is true."""
    from majordomo.app.demo_report import show_demo

    succeeded = asyncio.run(show_demo(house=house, seed=seed, port=port, console=console))
    raise typer.Exit(0 if succeeded else 1)


@application.command()
def ask(
    request: Annotated[str, typer.Argument(help="What you want, in plain words.")],
    url: Annotated[str | None, typer.Option(help="Address of the service; default: the one running here.")] = None,
    token: Annotated[str | None, typer.Option(envvar="MAJORDOMO_TOKEN", help="Its token.")] = None,
    data: Data = DEFAULT_DATA,
) -> None:
    """Ask the running service for something and follow it to its end."""
    from majordomo.app.asking import NoService, ask_service, find_service

    try:
        service = find_service(url, token, data.expanduser())
        succeeded = asyncio.run(ask_service(service, request, console))
    except NoService as error:
        complaints.print(str(error), style="red", markup=False, highlight=False, soft_wrap=True)
        raise typer.Exit(2) from None
    raise typer.Exit(0 if succeeded else 1)


@application.command("plan")
def plan_on_graph(
    request: Annotated[str, typer.Argument(help="What you want, in plain words.")],
    graph: Annotated[Path, typer.Option(help="A stored scene graph, JSON of GET /v1/scene or your own; - reads it.")],
    pddl: Annotated[Path | None, typer.Option(help="Where to write the problem as PDDL, its domain beside.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Plan for a request on a stored scene graph and print the plan, or the reason why there is none."""
    from majordomo.app.planning import document, plan_on, told, write_problem
    from majordomo.app.stored_graph import load_graph

    snapshot = load_graph(graph)
    outcome = plan_on(snapshot, request)
    print(json.dumps(document(outcome, request), indent=1) if as_json else told(outcome, snapshot))
    if pddl is not None and outcome.problem is not None:
        domain = write_problem(outcome.problem, pddl)
        complaints.print(f"wrote {pddl} and {domain}", markup=False, highlight=False, soft_wrap=True)
    raise typer.Exit(0 if outcome.succeeded else 1)


@application.command("house")
def make_house(
    rooms: Annotated[int, typer.Option(min=1, help="How many, corridors and halls included.")] = 6,
    seed: Seed = 0,
    loop: Annotated[bool, typer.Option("--loop", help="Let some rooms be reached in two ways.")] = False,
    rectilinear: Annotated[bool, typer.Option("--rectilinear", help="Make some rooms L-, T- or U-shaped.")] = False,
    empty: Annotated[bool, typer.Option("--empty", help="Leave out furniture and objects.")] = False,
) -> None:
    """Write a generated house to standard output, to be used with --house."""
    from majordomo.simulation.generator import generate_house

    house = generate_house(rooms=rooms, seed=seed, loops=loop, rectilinear=rectilinear, furnished=not empty)
    sys.stdout.write(house.model_dump_json(by_alias=True, exclude_none=True, indent=1) + "\n")


@application.command()
def doctor(model: Network = SHIPPED) -> None:
    """Check what Majordomo needs on this machine, and say what to do about what is missing."""
    from majordomo.app.doctor import examine

    healthy = examine(console, model)
    raise typer.Exit(0 if healthy else 1)


def _speed(text: str, clock: ClockMode) -> float | None:
    if text == "max":
        if clock is ClockMode.REAL:
            raise typer.BadParameter("'max' needs --clock lockstep", param_hint="--speed")
        return None
    try:
        speed = float(text)
    except ValueError:
        speed = 0.0
    if not 0.0 < speed < float("inf"):
        raise typer.BadParameter(f"{text!r} is neither a positive number nor 'max'", param_hint="--speed")
    return speed


def _log_to_stderr(*, verbose: bool) -> None:
    logging.basicConfig(
        level=logging.DEBUG if verbose else logging.INFO,
        format="%(asctime)s %(levelname)-7s %(name)s: %(message)s",
        stream=sys.stderr,
    )
    for chatty in ("httpx", "httpcore", "asyncio", "websockets", "watchfiles"):
        logging.getLogger(chatty).setLevel(logging.WARNING)
