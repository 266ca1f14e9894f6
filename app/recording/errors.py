"""What can go wrong with a recording."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path


class RecordingError(Exception):
    """Base of everything that this package raises on purpose."""


class NoRecording(RecordingError):
    """The file is none of ours: no MCAP, or one in which topics are missing."""

    def __init__(self, path: Path, problem: str, topics: Iterable[str] = ()) -> None:
        self.path = path
        self.topics = tuple(topics)
        held = f"; it holds {', '.join(sorted(self.topics))}" if self.topics else ""
        super().__init__(f"{path} is no recording of a robot: {problem}{held}")


class RecordingDamaged(RecordingError):
    """The file is ours, and from ``sound_s`` (seconds of the recording) on cannot be read."""

    def __init__(self, path: Path, problem: str, sound_s: float) -> None:
        self.path = path
        self.sound_s = sound_s
        super().__init__(f"{path} is damaged after {sound_s:.1f} s: {problem}")


class RecordingExists(RecordingError):
    """A recording is never written over another file."""

    def __init__(self, path: Path) -> None:
        self.path = path
        super().__init__(f"{path} exists already, and a recording never replaces a file: name another")
