"""Reads files of requests; their format is described in ``docs/requests.md``."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from importlib import resources
from pathlib import Path

from app.errors import LineError
from evaluations.planning.buildings import UnknownBuilding, building
from evaluations.planning.judging.expectation_reader import BadExpectation, read_expectation
from evaluations.planning.judging.expectations import Expectation, Request, Turn
from scene_graph.errors import SceneGraphError
from scene_graph.snapshot import Snapshot

OWN = ("developed", "held_out")
"""The halves that ship with the package. The grammar is developed against the first; nobody reads the second."""


@dataclass(kw_only=True)
class _Said:
    line: int
    text: str
    expected: list[Expectation] = field(default_factory=list)


@dataclass(kw_only=True)
class _Draft:
    category: str
    building: str
    turns: list[_Said]


def own_requests(half: str) -> tuple[Request, ...]:
    """The requests of one half that ships with the package."""
    text = resources.files(__package__).joinpath("requests", f"{half}.txt").read_text(encoding="utf-8")
    return read_requests(text, half)


def load_requests(file: Path) -> tuple[Request, ...]:
    """The requests of a file; buildings that are files are found beside it.

    Raises:
        LineError: naming line and field.
    """
    return read_requests(file.read_text(encoding="utf-8"), file.stem, folder=file.parent)


def read_requests(text: str, half: str, folder: Path | None = None) -> tuple[Request, ...]:
    """The requests in a text.

    Raises:
        LineError: naming line and field.
    """
    reader = _Reader(half, folder)
    for number, line in enumerate(text.splitlines(), 1):
        reader.take(number, line.strip())
    return reader.finished()


class _Reader:
    """Takes a file line by line."""

    def __init__(self, half: str, folder: Path | None) -> None:
        self._half, self._folder = half, folder
        self._building, self._category = "", ""
        self._snapshot: Snapshot | None = None
        self._drafts: list[_Draft] = []
        self._open = False

    def take(self, number: int, line: str) -> None:
        """One line, without the space around it."""
        if not line or line.startswith("#"):
            return
        if line.startswith(">"):
            self._expect(number, line[1:].strip())
        elif line.startswith("& "):
            if not self._open:
                raise LineError(self._half, number, "turn", "there is no request before it that it could go on")
            self._drafts[-1].turns.append(_Said(line=number, text=line[2:].strip()))
        else:
            self._open = False
            self._begin(number, line)

    def finished(self) -> tuple[Request, ...]:
        """All requests, each turn with something that is expected."""
        return tuple(_finished(draft, self._half) for draft in self._drafts)

    def _begin(self, number: int, line: str) -> None:
        if line.startswith("@"):
            self._building = line[1:].strip()
            self._snapshot = self._named(number, self._building)
        elif line.startswith("=="):
            self._category = line[2:].strip()
        elif not self._building or not self._category:
            missing = "category" if self._building else "building"
            raise LineError(self._half, number, missing, "say '@building' and '== category' before the first request")
        else:
            said = _Said(line=number, text=_plain(line))
            self._drafts.append(_Draft(category=self._category, building=self._building, turns=[said]))
            self._open = True

    def _expect(self, number: int, text: str) -> None:
        if not self._open or self._snapshot is None:
            raise LineError(self._half, number, "expectation", "comes before any request")
        try:
            self._drafts[-1].turns[-1].expected.append(read_expectation(text, self._snapshot))
        except BadExpectation as error:
            raise LineError(self._half, number, error.field, error.problem) from error

    def _named(self, number: int, name: str) -> Snapshot:
        try:
            return building(name, self._folder)
        except (UnknownBuilding, SceneGraphError, ValueError) as error:
            raise LineError(self._half, number, "building", str(error)) from error


def _plain(line: str) -> str:
    """The words; what would begin another kind of line is quoted with a backslash."""
    return re.sub(r"^\\(?=[@=#>&\\])", "", line)


def _finished(draft: _Draft, half: str) -> Request:
    for said in draft.turns:
        if not said.expected:
            raise LineError(half, said.line, "expectation", f"there is none for {said.text!r}: add a line with '>'")
    turns = tuple(Turn(text=said.text, expected=tuple(said.expected)) for said in draft.turns)
    return Request(half=half, line=draft.turns[0].line, category=draft.category, building=draft.building, turns=turns)
