"""Commands that exchange with other programs: ``majordomo house | export | replay | mcp``."""

from __future__ import annotations

import asyncio
import json
import sys
from pathlib import Path
from typing import Annotated

import typer

from app.commands.options import ClientToken, Data, GraphFormat, Network, Seed, Url
from app.commands.terminal import complaints, refused
from app.settings import DEFAULT_DATA
from perception.network.shipped import SHIPPED
from planner.tasks.approval import Approval


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


def export_graph(
    file: Annotated[Path, typer.Argument(help="Where to write; - writes to standard output.")],
    kind: Annotated[
        GraphFormat, typer.Option("--format", help="Our own, or the JSON of Spark-DSG (Hydra).")
    ] = GraphFormat.MAJORDOMO,
    graph: Annotated[
        Path | None,
        typer.Option(help="Take this stored scene graph, in either format, and not a service's; - reads it."),
    ] = None,
    url: Url = None,
    token: ClientToken = None,
    data: Data = DEFAULT_DATA,
) -> None:
    """Write down the scene graph of the running service; ``serve --graph`` and ``plan --graph`` read both formats."""
    from app.commands.export import export, graph_of
    from app.exchange.stored_graph import load_graph
    from client import NoService, find_service

    try:
        snapshot = load_graph(graph) if graph is not None else graph_of(find_service(url, token, data.expanduser()))
    except NoService as error:
        raise refused(str(error)) from None
    export(snapshot, file, kind)


def replay_recording(
    file: Annotated[Path, typer.Argument(help="A recording, MCAP, as serve --record makes it.")],
    graph: Annotated[Path | None, typer.Option(help="Where to write the graph that comes out; - prints it.")] = None,
    model: Network = SHIPPED,
) -> None:
    """Let perception work on a recording again, without a robot, and say what it makes of it."""
    from app.commands.export import write_text
    from app.recording.errors import RecordingError
    from app.replay import replay, told

    try:
        replayed = asyncio.run(replay(file, model=model))
    except RecordingError as error:
        raise refused(f"majordomo: {error}") from None
    complaints.print(told(replayed), markup=False, highlight=False, soft_wrap=True)
    if graph is not None:
        write_text(json.dumps(replayed.scene, indent=1) + "\n", graph)


def serve_mcp(
    approval: Annotated[
        Approval, typer.Option(help="Whether a person approves each plan on the page, or requests run at once.")
    ] = Approval.ASK,
    url: Url = None,
    token: ClientToken = None,
    data: Data = DEFAULT_DATA,
) -> None:
    """Offer the running service to a language model's host as tools, over standard input and output (MCP)."""
    from client import NoService, find_service

    try:
        from app.exchange.mcp_server import ServiceTools, make_mcp_server
    except ModuleNotFoundError as error:
        missing = f"majordomo mcp needs the package {error.name!r}: pip install 'majordomo[mcp]'"
        raise refused(missing) from None
    try:
        service = find_service(url, token, data.expanduser())
    except NoService as error:
        raise refused(str(error)) from None
    make_mcp_server(ServiceTools(service, approval=approval)).run("stdio")
