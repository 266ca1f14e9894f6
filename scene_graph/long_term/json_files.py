"""Files that are replaced as a whole, and set aside when they cannot be read."""

from __future__ import annotations

import logging
import os
from pathlib import Path

logger = logging.getLogger(__name__)

_BROKEN = ".broken"


def replace_file(path: Path, content: bytes) -> None:
    """Write a file so that whoever reads it, at any time, finds the old one or the new one.

    Raises:
        OSError: it cannot be written.
    """
    draft = path.with_suffix(".tmp")
    with draft.open("wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    draft.replace(path)


def set_aside(path: Path, error: Exception) -> Path:
    """Rename a file that cannot be read, so that nothing of it is lost, and report why. Its new place."""
    aside = path.with_name(path.name + _BROKEN)
    number = 1
    while aside.exists():
        number += 1
        aside = path.with_name(f"{path.name}.{number}{_BROKEN}")
    path.replace(aside)
    logger.warning("%s cannot be read and was set aside as %s: %s", path, aside.name, error)
    return aside
