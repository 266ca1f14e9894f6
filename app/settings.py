"""Everything a service can be told at start, read once by the command line and handed down through constructors."""

from __future__ import annotations

import re
from enum import StrEnum
from pathlib import Path
from typing import Annotated

from pydantic import AfterValidator, BaseModel, ConfigDict, Field

from perception.network.shipped import SHIPPED

DEFAULT_DATA = Path("~/.local/share/majordomo")
JOURNAL_BYTES = 64_000_000
"""Of all traces of tasks together, where nothing else is said: weeks of many tasks a day."""


def origin(text: str) -> str:
    """A page's origin as browsers name it.

    Raises:
        ValueError: it is something else, such as an address with a path.
    """
    if not re.fullmatch(r"https?://[^/?#@*\s]+", text):
        raise ValueError(
            f"{text!r} is no origin: write scheme, host and port as a browser does, https://robot.lan:8443"
        )
    return text.lower()


Origin = Annotated[str, AfterValidator(origin)]


class ClockMode(StrEnum):
    """``real`` follows the wall clock; ``lockstep`` advances simulated time and runs each agent when due."""

    REAL = "real"
    LOCKSTEP = "lockstep"


class Settings(BaseModel):
    """Settings of one service.

    ``speed``: simulated seconds per wall second, ``None`` for as fast as the machine allows (lockstep only).
    ``llm``: ``provider:model`` or ``None`` for the command grammar alone. ``llm_context``: its context length in
    tokens, ``None`` for the provider's usual one. ``data``: folder of token, logs and memory.
    ``camera_hz``: camera frames taken and understood in a second of the robot's clock.
    ``model``: file of the panoptic scene graph network.
    ``remember``: take up the building that the data folder holds, and keep it there.
    ``allow_origins``: pages of other hosts that may call, as browsers name them: ``https://robot.lan``.
    ``requests_per_s``: calls of one caller in a second, in the long run. ``streams``: clients of the event stream.
    ``journal_bytes``: of all traces of tasks together; beyond, the oldest entries are dropped.
    ``robot``: which real robot serves, ``KIND:WHERE``, ``None`` for a simulated one in ``house``.
    ``record``: file to which sensors and graph are recorded, up to ``record_limit_bytes``.
    """

    model_config = ConfigDict(frozen=True, extra="forbid")

    house: str = "flat"
    seed: int = Field(default=0, ge=0)
    clock: ClockMode = ClockMode.REAL
    speed: float | None = Field(default=1.0, gt=0)
    host: str = "127.0.0.1"
    port: int = Field(default=8642, ge=0, le=65535)
    llm: str | None = None
    llm_url: str | None = None
    llm_key: str | None = Field(default=None, repr=False)
    llm_context: int | None = Field(default=None, ge=1024)
    data: Path = DEFAULT_DATA
    simulation_api: bool = False
    explore: bool = True
    camera: bool = True
    camera_hz: float = Field(default=5.0, gt=0)
    remember: bool = False
    graph: Path | None = None
    robot: str | None = None
    model: Path = SHIPPED
    record: Path | None = None
    record_limit_bytes: int = Field(default=20_000_000_000, gt=0)
    max_body_bytes: int = 65_536
    allow_origins: tuple[Origin, ...] = ()
    requests_per_s: float = Field(default=200.0, gt=0)
    streams: int = Field(default=256, ge=1)
    journal_bytes: int = Field(default=JOURNAL_BYTES, ge=100_000)

    @property
    def data_folder(self) -> Path:
        """The data folder with ``~`` resolved."""
        return self.data.expanduser()
