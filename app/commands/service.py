"""Commands that run a service: ``majordomo serve | demo``, and ``doctor``, which says whether one can run here."""

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

from app.commands.log_redaction import RedactingFormatter
from app.commands.options import Data, House, Network, Seed
from app.commands.terminal import console
from app.settings import DEFAULT_DATA, JOURNAL_BYTES, ClockMode, Settings, origin
from perception.network.shipped import SHIPPED


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
    ] = JOURNAL_BYTES / 1e6,
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
        announce = partial(typer.echo, address)
        started = asyncio.run(serve_forever(runtime, listener, token, announce, viewer=viewer))
    if not started:
        raise typer.Exit(2)


def demo(
    house: House = "flat",
    seed: Seed = 0,
    port: Annotated[int, typer.Option(min=0, max=65535, help="Port of the page to watch it on; 0 picks one.")] = 0,
) -> None:
    """Explore, carry out one request while a person interferes, and report what is true."""
    from app.commands.demo import show_demo

    succeeded = asyncio.run(show_demo(house=house, seed=seed, port=port, console=console))
    raise typer.Exit(0 if succeeded else 1)


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
        typer.echo(json.dumps(document(findings), indent=1))
    else:
        tell(findings, console)
    raise typer.Exit(0 if healthy(findings) else 1)


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
    handler.setFormatter(RedactingFormatter("%(asctime)s %(levelname)-7s %(name)s: %(message)s", secrets=secrets))
    logging.basicConfig(level=logging.DEBUG if verbose else logging.INFO, handlers=[handler])
    for chatty in ("httpx", "httpcore", "asyncio", "websockets", "watchfiles"):
        logging.getLogger(chatty).setLevel(logging.WARNING)
