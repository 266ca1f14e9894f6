"""``majordomo evaluate resources | rates | clients``."""

from __future__ import annotations

from typing import Annotated

import typer

from app.commands.options import Network
from app.commands.terminal import console
from evaluations.options import House, JsonFile, Plot
from perception.network.shipped import SHIPPED


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
