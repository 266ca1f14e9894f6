"""Options that several commands take."""

from __future__ import annotations

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
