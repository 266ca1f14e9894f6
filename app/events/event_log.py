"""The event log: one JSON line per event, in robot time only, so that the same seed gives the same bytes."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TextIO

Hear = Callable[[float, str, Mapping[str, Any]], None]


def hear_nothing(stamp_s: float, kind: str, data: Mapping[str, Any]) -> None:
    """Listener for those who need none."""
    del stamp_s, kind, data


class EventLog:
    """Appends events to a file, or to nothing when no path is given. Keys are sorted, floats rounded.

    ``hear`` is told every event, file or not.
    """

    def __init__(self, path: Path | None, *, hear: Hear = hear_nothing) -> None:
        self._hear = hear
        self._file: TextIO | None = None
        if path is not None:
            path.parent.mkdir(parents=True, exist_ok=True)
            self._file = path.open("w", encoding="utf-8")

    def write(self, stamp_s: float, kind: str, data: Mapping[str, Any]) -> None:
        """Append one event of ``kind``."""
        self._hear(stamp_s, kind, data)
        if self._file is None:
            return
        record = {"stamp_s": stamp_s, "kind": kind, **data}
        self._file.write(json.dumps(_rounded(record), sort_keys=True, separators=(",", ":"), default=str) + "\n")

    def close(self) -> None:
        """Flush and close the file."""
        if self._file is not None:
            self._file.close()
            self._file = None


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return round(value, 6)
    if isinstance(value, Mapping):
        return {str(key): _rounded(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_rounded(item) for item in value]
    return value
