"""What became of each node, on disk beside the building that it is about."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from pydantic import TypeAdapter

from app.persistence.node_history import NodeHistory, Pasts
from scene_graph.long_term.json_files import replace_file, set_aside

FILE = "history.json"


@dataclass(frozen=True, kw_only=True)
class _Document:
    """The file. ``stamp_s``: robot time at which it was written; ``saved_s``: wall time, seconds since 1970."""

    version: Literal[1] = 1
    stamp_s: float
    saved_s: float
    pasts: Pasts


_FORMAT = TypeAdapter(_Document)


class HistoryFile:
    """Reads the history at the start and writes it when there is something new in it."""

    def __init__(self, folder: Path) -> None:
        """``folder``: of the building."""
        self._path = folder / FILE
        self._written: Pasts | None = None

    def read(self, *, wall_s: float) -> NodeHistory:
        """The history by a robot's clock that begins now, at ``wall_s`` (seconds since 1970): what was noted before is
        of negative times. A file that cannot be read is reported and set aside.
        """
        try:
            document = _FORMAT.validate_json(self._path.read_bytes())
        except FileNotFoundError:
            return NodeHistory()
        except (ValueError, OSError) as error:
            set_aside(self._path, error)
            return NodeHistory()
        elapsed_s = max(0.0, wall_s - document.saved_s) if document.saved_s else 0.0
        return NodeHistory(document.pasts.copied(-document.stamp_s - elapsed_s))

    def write(self, history: NodeHistory, *, stamp_s: float, wall_s: float) -> None:
        """Replace the file unless nothing has been noted since it was.

        Raises:
            OSError: it cannot be written.
        """
        pasts = history.pasts()
        if pasts != self._written:
            replace_file(self._path, _FORMAT.dump_json(_Document(stamp_s=stamp_s, saved_s=wall_s, pasts=pasts)))
            self._written = pasts
