"""The command line: ``majordomo demo | serve | ask | trace | plan | export | replay | mcp | house | …``."""

from __future__ import annotations

import asyncio
import json
import logging
import os
import sys
from collections.abc import Iterable, Sequence
from functools import partial
from pathlib import Path
from typing import Annotated

import typer
from rich.console import Console

from app.commands.discretion import DiscreetFormatter
from app.commands.exchange import add_exchange_commands
from app.commands.installed import add_installed_commands
from app.commands.options import Network
from app.settings import DEFAULT_DATA, ClockMode, Settings, origin
from perception.network.shipped import SHIPPED

application = typer.Typer(
    name="majordomo",
    help="A robot butler that maps its building, plans on a scene graph, and checks what it did.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
add_installed_commands(application)

console = Console()
complaints = Console(stderr=True)

House = Annotated[str, typer.Option(help="A built-in house's name or a house file.")]
Seed = Annotated[int, typer.Option(min=0, help="Seed of everything that is random.")]
Data = Annotated[Path, typer.Option(help="Folder of token, logs and memory.")]
Url = Annotated[str | None, typer.Option(help="Address of the service; default: the one running here.")]
ClientToken = Annotated[
    str | None, typer.Option("--token", envvar="MAJORDOMO_TOKEN", help="Its token; default: that of the data folder.")
]


def main() -> None:
    """Entry point; expected problems end with a sentence and exit code 2, never with a stack trace."""
    try:
        application()
    except KeyboardInterrupt:
        sys.exit(130)
    except Exception as error:
        if not isinstance(error, _expected()):
            raise
        complaints.print(f"majordomo: {error}", style="red", markup=False, highlight=False)
        sys.exit(2)


def _expected() -> tuple[type[Exception], ...]:
    """Errors that say all there is to say. Looked up when one is there: the libraries behind them take a second."""
    from app.errors import LineError, RefusedToBind, RobotUnavailable
    from app.recording.errors import RecordingError
    from app.stacks.robot_registry import NoSuchRobot, RobotMisfit
    from drivers.rosbridge.errors import RosbridgeError
    from perception.network.errors import NetworkRefused
    from planner.errors import BadModelKey, BadModelSpec
    from scene_graph.errors import SceneFormatError
    from simulation.errors import HouseError, SimulatorError

    return (
        RefusedToBind, HouseError, SimulatorError, RobotUnavailable, SceneFormatError, BadModelKey, BadModelSpec,
        NetworkRefused, LineError, RecordingError, NoSuchRobot, RobotMisfit, RosbridgeError, OSError,
    )  # fmt: skip


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
    robot: Annotated[
        str | None, typer.Option(help="A real robot instead of the simulated one, such as rosbridge:robot.toml.")
    ] = None,
    allow_origin: Annotated[
        list[str] | None, typer.Option(help="A page of another host that may call: https://robot.lan. May be repeated.")
    ] = None,
    requests_per_s: Annotated[
        float, typer.Option("--requests-per-second", min=1, help="Calls of one caller, in the long run.")
    ] = 200.0,
    journal_mb: Annotated[
        float, typer.Option(min=0.1, help="Megabytes that the traces of all tasks may take; the oldest go first.")
    ] = 64.0,
    record: Annotated[
        Path | None, typer.Option(help="Record sensors and graph to this new MCAP file, for replay and Foxglove.")
    ] = None,
    verbose: Annotated[bool, typer.Option("--verbose", "-v", help="Log every frame's doings.")] = False,
) -> None:
    """Start the service; the first line printed is the page's address."""
    from simulation.houses.house_file import load_house

    if graph is None and robot is None:
        load_house(house)  # a house that is none is refused before the libraries are loaded, which takes seconds

    from app.http.guards.security import VIEWER_FILE, Token
    from app.runtime import Runtime
    from app.server import SWITCH_INTERVAL_S, bind, check_exposure, page_address
    from app.server import serve as serve_forever
    from app.stacks.language_model import key_in

    if graph is not None and record is not None:
        raise typer.BadParameter("a stored graph has no sensors to record", param_hint="--record")
    if graph is not None and robot is not None:
        raise typer.BadParameter("a stored graph is served without a robot", param_hint="--robot")
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
        llm_key=key_in(os.environ),
        llm_context=llm_context,
        data=data,
        simulation_api=simulation_api,
        explore=explore,
        camera=camera,
        remember=remember,
        graph=graph,
        robot=robot,
        model=model,
        allow_origins=_origins(allow_origin or ()),
        requests_per_s=requests_per_s,
        journal_bytes=int(1e6 * journal_mb),
        record=record,
    )
    token = Token.stored_in(settings.data_folder)
    viewer = Token.stored_in(settings.data_folder, VIEWER_FILE)
    _log_to_stderr(verbose=verbose, secrets=(token.value, viewer.value, settings.llm_key or ""))
    runtime = Runtime(settings)
    check_exposure(settings, has_token=True)
    with bind(settings) as listener:
        address = page_address(listener, token)
        announce = partial(print, address, flush=True)
        started = asyncio.run(serve_forever(runtime, listener, token, announce, viewer=viewer))
    if not started:
        raise typer.Exit(2)


@application.command()
def demo(
    house: House = "flat",
    seed: Seed = 0,
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port of the page to watch it on; 0 picks one.")] = 0,
) -> None:
    """Explore, carry out one request while a person interferes, and report what is true."""
    from app.commands.demo import show_demo

    succeeded = asyncio.run(show_demo(house=house, seed=seed, port=port, console=console))
    raise typer.Exit(0 if succeeded else 1)


@application.command()
def ask(
    request: Annotated[str, typer.Argument(help="What you want, in plain words.")],
    url: Url = None,
    token: ClientToken = None,
    data: Data = DEFAULT_DATA,
    dry_run: Annotated[bool, typer.Option("--dry-run", help="Plan only; nothing moves.")] = False,
    confirm: Annotated[bool, typer.Option("--confirm", help="Show the plan, and ask before anything moves.")] = False,
    agree: Annotated[
        bool | None, typer.Option("--yes/--no", help="Approve plans that are shown, or turn them down, unasked.")
    ] = None,
    answer: Annotated[
        list[str] | None, typer.Option(help="Answer to the robot's next question; may be given several times.")
    ] = None,
    keyboard: Annotated[
        bool, typer.Option("--input/--no-input", help="Put questions to the keyboard; without, the task waits.")
    ] = True,
    follow: Annotated[
        bool, typer.Option("--follow/--detach", help="Stay until it ends, or only print its identifier.")
    ] = True,
    timeout: Annotated[float | None, typer.Option(min=0.0, help="Stay at most so many seconds.")] = None,
    as_json: Annotated[
        bool, typer.Option("--json", help="Print the task as JSON at the end, and nothing else.")
    ] = False,
) -> None:
    """Ask the running service for something and follow it to its end.

    Exit codes: 0 it succeeded; 1 it failed, was refused or cancelled; 2 there is no service, or it refuses the call;
    3 the task waits for a person and nobody is there; 4 it goes on after --timeout; 130 Ctrl-C: it goes on unless you
    cancel it.
    """
    from app.commands.ask import Asking, Manners
    from client import Client, ClientError, find_service

    manners = Manners(
        approval="ask" if confirm else "auto",
        dry_run=dry_run,
        agree=agree,
        answers=tuple(answer or ()),
        keyboard=keyboard,
        follow=follow,
        timeout_s=timeout,
    )
    try:
        with Client(find_service(url, token, data)) as robot:
            asking = Asking(robot=robot, console=complaints if as_json else console, manners=manners)
            ending = asking.run(request)
    except ClientError as error:
        complaints.print(str(error), style="red", markup=False, highlight=False, soft_wrap=True)
        raise typer.Exit(2) from None
    if as_json and asking.task is not None:
        print(asking.task.model_dump_json(indent=1))
    raise typer.Exit(ending)


@application.command()
def trace(
    task: Annotated[str, typer.Argument(help="Its identifier, such as task_3, or its number.")],
    url: Url = None,
    token: ClientToken = None,
    data: Data = DEFAULT_DATA,
    prompts: Annotated[bool, typer.Option("--prompts", help="Also every word that a language model was told.")] = False,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Show what was decided about a task, when and why; when no service runs, from what the last one left."""
    from app.commands.trace import NoTrace, find_trace, show_trace
    from client import ClientError

    try:
        found = find_trace(task, url=url, token=token, data=data.expanduser())
    except (NoTrace, ClientError) as error:
        complaints.print(str(error), style="red", markup=False, highlight=False, soft_wrap=True)
        raise typer.Exit(2) from None
    if as_json:
        print(found.trace.model_dump_json(indent=1))
    else:
        show_trace(found, console, prompts=prompts)


@application.command("plan")
def plan_on_graph(
    request: Annotated[str, typer.Argument(help="What you want, in plain words.")],
    graph: Annotated[Path, typer.Option(help="A stored scene graph, JSON of GET /v1/scene or your own; - reads it.")],
    pddl: Annotated[Path | None, typer.Option(help="Where to write the problem as PDDL, its domain beside.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Plan for a request on a stored scene graph and print the plan, or the reason why there is none."""
    from app.commands.plan import document, plan_on, told, write_problem
    from app.exchange.stored_graph import load_graph

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
    from simulation.generation.generator import generate_house

    house = generate_house(rooms=rooms, seed=seed, loops=loop, rectilinear=rectilinear, furnished=not empty)
    sys.stdout.write(house.model_dump_json(by_alias=True, exclude_none=True, indent=1) + "\n")


@application.command()
def doctor(
    model: Network = SHIPPED,
    data: Data = DEFAULT_DATA,
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port that the service shall listen on.")] = 8642,
    host: Annotated[str, typer.Option(help="Address that it shall listen on.")] = "127.0.0.1",
    llm: Annotated[str | None, typer.Option(help="Language model to try, PROVIDER:MODEL; default: none.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print JSON.")] = False,
) -> None:
    """Check what Majordomo needs on this machine, and say what to do about what is missing.

    Exit codes: 0 nothing keeps the service from running; 1 something does.
    """
    import httpx

    from app.doctor.examination import Examined, examine
    from app.doctor.finding import document, healthy, tell
    from app.stacks.language_model import key_in

    url, key = os.environ.get("MAJORDOMO_LLM_URL"), key_in(os.environ)
    what = Examined(data=data, network=model, host=host, port=port, llm=llm, llm_url=url, llm_key=key)
    with httpx.Client() as http:
        findings = examine(what, http)
    if as_json:
        print(json.dumps(document(findings), indent=1))
    else:
        tell(findings, console)
    raise typer.Exit(0 if healthy(findings) else 1)


add_exchange_commands(application)


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


def _origins(named: Sequence[str]) -> tuple[str, ...]:
    try:
        return tuple(origin(name) for name in named)
    except ValueError as error:
        raise typer.BadParameter(str(error), param_hint="--allow-origin") from None


def _log_to_stderr(*, verbose: bool, secrets: Iterable[str] = ()) -> None:
    handler = logging.StreamHandler(sys.stderr)
    handler.setFormatter(DiscreetFormatter("%(asctime)s %(levelname)-7s %(name)s: %(message)s", secrets=secrets))
    logging.basicConfig(level=logging.DEBUG if verbose else logging.INFO, handlers=[handler])
    for chatty in ("httpx", "httpcore", "asyncio", "websockets", "watchfiles"):
        logging.getLogger(chatty).setLevel(logging.WARNING)
