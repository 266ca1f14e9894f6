"""What can go wrong in the simulation: each error is named for its condition and carries its data."""

from __future__ import annotations


class SimulatorError(Exception):
    """Base of all errors of this package."""


class HouseError(SimulatorError, ValueError):
    """A house is not one that can be built.

    ``path``: where in the document, as in ``doors[1].center``; the name of the file or house where it is the whole.
    """

    def __init__(self, path: str, problem: str) -> None:
        super().__init__(f"{path}: {problem}" if path else problem)
        self.path = path
        self.problem = problem

    def __reduce__(self) -> tuple[type[HouseError], tuple[str, str]]:
        return type(self), (self.path, self.problem)


class DisturbError(SimulatorError, ValueError):
    """A disturbance cannot be carried out in this house as it is now. ``path``: its offending field."""

    def __init__(self, path: str, problem: str) -> None:
        super().__init__(f"{path}: {problem}" if path else problem)
        self.path = path
        self.problem = problem

    def __reduce__(self) -> tuple[type[DisturbError], tuple[str, str]]:
        return type(self), (self.path, self.problem)


class SimulatorDied(SimulatorError):
    """The simulator's process ended, or stopped answering."""
