"""The trace of a task as people and programs read it: from a running service, or from the file that one left."""

from __future__ import annotations

import sqlite3
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from pydantic import JsonValue, TypeAdapter

from app.journal.file import read_only
from client.documents import Trace, TraceEntry

_DATA = TypeAdapter(dict[str, JsonValue])


def read_trace(
    connection: sqlite3.Connection, task_id: str, *, after: int = 0, limit: int | None = None
) -> Trace | None:
    """The trace of a task in an open journal; ``None`` when the journal knows nothing of it."""
    rows = connection.execute(
        "SELECT seq, stamp_s, at_s, kind, what, why, data FROM decisions "
        "WHERE task = ? AND seq > ? ORDER BY seq LIMIT ?",
        (task_id, after, -1 if limit is None else limit + 1),
    ).fetchall()
    entries = [_entry(row) for row in rows]
    dropped = connection.execute("SELECT decisions FROM dropped WHERE task = ?", (task_id,)).fetchone()
    if not entries and dropped is None and not _is_known(connection, task_id):
        return None
    more = limit is not None and len(entries) > limit
    shown = entries[:limit] if more else entries
    return Trace(
        task=task_id, entries=shown, dropped=dropped[0] if dropped else 0, next=shown[-1].seq if more else None
    )


def stored_traces(data: Path, task_id: str) -> Iterator[tuple[Path, Trace]]:
    """The trace of a task in every journal of a data folder that knows it, the journal last written to first.

    Raises:
        sqlite3.Error: a journal cannot be read.
    """
    journals = sorted((data / "buildings").glob("*/tasks.sqlite3"), key=_last_written, reverse=True)
    for file in journals:
        connection = read_only(file)
        try:
            trace = read_trace(connection, task_id)
        finally:
            connection.close()
        if trace is not None:
            yield file, trace


def _entry(row: tuple[Any, ...]) -> TraceEntry:
    seq, stamp_s, at_s, kind, what, why, data = row
    return TraceEntry(
        seq=seq, stamp_s=stamp_s, at_s=at_s, kind=kind, what=what, why=why, data=_DATA.validate_json(data)
    )


def _is_known(connection: sqlite3.Connection, task_id: str) -> bool:
    return connection.execute("SELECT 1 FROM tasks WHERE id = ?", (task_id,)).fetchone() is not None


def _last_written(file: Path) -> float:
    parts = [file, file.with_name(f"{file.name}-wal")]
    return max(part.stat().st_mtime for part in parts if part.exists())
