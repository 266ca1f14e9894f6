"""Options of commands, and what they can be; light to import, as every command has to load them."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

House = Annotated[str, typer.Option(help="A built-in house's name or a house file.")]
Seed = Annotated[int, typer.Option(min=0, help="Seed of everything that is random.")]
Data = Annotated[Path, typer.Option(help="Folder of token, logs and memory.")]
Url = Annotated[str | None, typer.Option(help="Address of the service; default: the one running here.")]
ClientToken = Annotated[
    str | None, typer.Option("--token", envvar="MAJORDOMO_TOKEN", help="Its token; default: that of the data folder.")
]
Network = Annotated[
    Path,
    typer.Option(
        "--model",
        envvar="MAJORDOMO_MODEL",
        help="The network that the robot sees with, an ONNX file; see docs/network.md.",
    ),
]


class GraphFormat(StrEnum):
    """Formats of a scene graph."""

    MAJORDOMO = "majordomo"
    SPARK_DSG = "spark-dsg"
