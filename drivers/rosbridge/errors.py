"""What can go wrong with a robot behind rosbridge: each error is named for its condition and carries its data."""

from __future__ import annotations

from pathlib import Path


class RosbridgeError(Exception):
    """Base of all errors of this package."""


class BadProfile(RosbridgeError, ValueError):
    """A robot's profile cannot be used; names the field."""

    def __init__(self, path: Path, problem: str) -> None:
        super().__init__(f"{path}: {problem}")
        self.path, self.problem = path, problem


class RobotNotReached(RosbridgeError):
    """Nobody answers at the address, or what answers does not say what a robot says."""

    def __init__(self, url: str, problem: str) -> None:
        super().__init__(f"{url}: {problem}")
        self.url, self.problem = url, problem


class BadMessage(RosbridgeError, ValueError):
    """A message holds what no sensor can mean."""


class FrameUnknown(RosbridgeError, LookupError):
    """No chain of transforms leads from one frame to the other."""

    def __init__(self, base: str, frame: str, known: frozenset[str]) -> None:
        listed = ", ".join(sorted(known)) or "none"
        super().__init__(f"nobody has said where frame '{frame}' is on '{base}'; known: {listed}")
        self.base, self.frame, self.known = base, frame, known


class FrameStale(RosbridgeError, LookupError):
    """A frame that moves was not told of at the time that is asked for."""

    def __init__(self, frame: str) -> None:
        super().__init__(f"nobody has said where the moving frame '{frame}' was then; does /tf still come?")
        self.frame = frame
