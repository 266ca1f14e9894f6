"""All checks of the doctor, in the order in which a user meets what they are about."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

import httpx

from app.doctor import files, machine
from app.doctor.finding import Finding, Health
from perception.network.shipped import SHIPPED

LIMIT_S = 8.0
"""Of one check. On an idle machine all together take less than five seconds."""

Check = Callable[[], Finding | Iterable[Finding]]


@dataclass(frozen=True, kw_only=True)
class Examined:
    """What the service would be started with."""

    data: Path
    network: Path = SHIPPED
    host: str = "127.0.0.1"
    port: int = 8642
    llm: str | None = None
    llm_url: str | None = None
    llm_key: str | None = field(default=None, repr=False)


def examine(what: Examined, http: httpx.Client, *, limit_s: float = LIMIT_S) -> list[Finding]:
    """Run all checks; nothing is changed. ``http`` is used only if a language model is configured.

    ``limit_s``: how long one check may take; what takes longer is told as odd, and the next one begins.
    """
    data = what.data.expanduser()
    checks: tuple[tuple[str, Check], ...] = (
        ("python", machine.python),
        ("libraries", machine.libraries),
        ("houses", files.houses),
        ("network", partial(files.network, what.network)),
        ("data", partial(files.data_folder, data)),
        ("disk", partial(files.disk, data)),
        ("building", partial(files.journals, data)),
        ("port", partial(machine.port, what.host, what.port, data)),
        ("model", partial(machine.language_model, what.llm, what.llm_url, what.llm_key, http)),
    )
    return [finding for name, check in checks for finding in within(limit_s, name, check)]


def within(limit_s: float, name: str, check: Check) -> Sequence[Finding]:
    """What a check finds, or that it took too long; it is then left to itself, and ends with the program."""
    found: list[Finding] = []
    problems: list[BaseException] = []

    def look() -> None:
        try:
            outcome = check()
            found.extend([outcome] if isinstance(outcome, Finding) else outcome)
        except BaseException as problem:  # noqa: BLE001 - it is raised where the check was asked for
            problems.append(problem)

    looking = threading.Thread(target=look, name=f"doctor: {name}", daemon=True)
    looking.start()
    looking.join(limit_s)
    if looking.is_alive():
        text = f"not done after {limit_s:.0f} s"
        advice = "the machine is busy, or a disk or a server does not answer: ask again when it is quiet"
        return (*found, Finding(name=name, health=Health.ODD, text=text, advice=advice))
    if problems:
        raise problems[0]
    return found
