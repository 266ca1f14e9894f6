"""Options of commands, and what they can be; light to import, as every command has to load them."""

from __future__ import annotations

from enum import StrEnum
from pathlib import Path
from typing import Annotated

import typer

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
