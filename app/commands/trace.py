"""``majordomo trace``: what was decided about a task, when and why, as a table; from a service or from its files."""

from __future__ import annotations

import datetime as dt
import sqlite3
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from rich.console import Console
from rich.table import Table
from rich.text import Text

from app.journal.trace import stored_traces
from client import Client, NoService, NotFound, Service, Trace, TraceEntry, find_service

STYLES = {
    "received": "bold",
    "understood": "cyan",
    "planned": "cyan",
    "replanned": "yellow",
    "asked": "yellow",
    "shown": "yellow",
    "failure": "red",
    "stopped": "red",
    "observed": "green",
    "verified": "green",
    "ended": "bold",
}


class NoTrace(RuntimeError):
    """Nothing is known of a task, here or there."""


@dataclass(frozen=True, kw_only=True)
class Found:
    """A trace, and where it is from."""

    trace: Trace
    source: str


def find_trace(task_id: str, *, url: str | None, token: str | None, data: Path) -> Found:
    """The trace from the service at ``url`` or the one running here, else from the journals in the data folder.

    ``task_id``: also a bare number.

    Raises:
        NoTrace: saying where was looked.
        NoService: the service at ``url`` does not answer.
    """
    task_id = f"task_{task_id}" if task_id.isdecimal() else task_id
    service = _service(url, token, data)
    if service is not None:
        try:
            return Found(trace=trace_of(service, task_id), source=f"the service at {service.address}")
        except NotFound as problem:
            raise NoTrace(f"{problem.detail} in the service at {service.address}") from None
        except NoService:
            if url is not None:
                raise
    return _stored(task_id, data)


def trace_of(service: Service, task_id: str) -> Trace:
    """The whole trace of a task, page by page.

    Raises:
        ClientError: the service does not answer, or refuses.
    """
    entries: list[TraceEntry] = []
    after: int | None = 0
    dropped = 0
    with Client(service) as robot:
        while after is not None:
            page = robot.trace(task_id, after=after)
            entries += page.entries
            after, dropped = page.next, page.dropped
    return Trace(task=task_id, entries=entries, dropped=dropped)


def show_trace(found: Found, console: Console, *, prompts: bool = False) -> None:
    """Print a trace; ``prompts``: with every word that was said to a language model."""
    trace = found.trace
    if trace.dropped:
        console.print(f"{trace.dropped} older entries were dropped, because the journal is full.", style="yellow")
    table = Table("when", "robot", "what", "why", title=f"{trace.task}, from {found.source}", title_justify="left")
    table.columns[1].justify = "right"
    for entry in trace.entries:
        what = Text.assemble((entry.kind.replace("_", " "), STYLES.get(entry.kind, "")), "  ", entry.what)
        table.add_row(_time(entry.at_s), f"{entry.stamp_s:.1f} s", what, Text(entry.why))
        if prompts and entry.kind == "model_asked":
            table.add_row("", "", Text("\n".join(_messages(entry)), style="dim"), "")
    console.print(table)


def _service(url: str | None, token: str | None, data: Path) -> Service | None:
    try:
        return find_service(url, token, data)
    except NoService:
        if url is not None:
            raise
        return None


def _stored(task_id: str, data: Path) -> Found:
    """The newest trace of this name among the journals that a data folder holds."""
    try:
        for file, trace in stored_traces(data, task_id):
            return Found(trace=trace, source=f"{file.parent.name}, where no service runs now")
    except sqlite3.Error as problem:
        raise NoTrace(
            f"a journal in {data} cannot be read: {problem}; 'majordomo doctor --data {data}' says more"
        ) from problem
    raise NoTrace(f"nothing is known of {task_id} in {data}, and no service runs there")


def _time(at_s: float) -> str:
    return dt.datetime.fromtimestamp(at_s).astimezone().strftime("%Y-%m-%d %H:%M:%S")


def _messages(entry: TraceEntry) -> Iterable[str]:
    messages = entry.data.get("messages")
    for message in messages if isinstance(messages, list) else []:
        if isinstance(message, dict):
            yield f"{message.get('role')}: {message.get('text')}"
