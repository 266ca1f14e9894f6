"""Reads files of missions, as ``docs/missions.md`` describes them."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path

from evaluations.missions.disturbances import DISTURBANCES
from evaluations.missions.mission import Mission
from evaluations.missions.outcome import HAND, ROBOT, Outcome, Placed, RobotIn
from evaluations.perception.perception import house_of
from simulation.errors import HouseError
from simulation.houses.house import House
from simulation.houses.house_file import load_house


class MissionFileError(ValueError):
    """A line of a mission file that cannot be read; says which and why."""

    def __init__(self, line: int, problem: str) -> None:
        super().__init__(f"line {line}: {problem}")


def load_missions(file: Path) -> list[Mission]:
    """The missions of a file, in its order; houses that are files are found beside it.

    Raises:
        MissionFileError: naming the line.
    """
    reader = _Reader(file.parent)
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        reader.take(number, line.strip())
    return reader.missions


@dataclass(kw_only=True)
class _Place:
    name: str
    house: House
    ids: frozenset[str] = field(default_factory=frozenset)


class _Reader:
    """Takes a file line by line."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        self._place: _Place | None = None
        self._kind = "request"
        self.missions: list[Mission] = []

    def take(self, number: int, line: str) -> None:
        """One line, without the space around it."""
        if not line or line.startswith("#"):
            return
        if line.startswith("@"):
            self._place = self._house(number, line[1:].strip())
        elif line.startswith("=="):
            self._kind = line[2:].strip()
        elif self._place is None:
            raise MissionFileError(number, "say '@house' before the first request")
        elif line.startswith(">"):
            last = self._last(number)
            outcome = self._outcome(number, line[1:].strip(), self._place)
            self.missions[-1] = replace(last, outcomes=(*last.outcomes, outcome))
        elif line.startswith("!"):
            name = line[1:].strip()
            if name not in DISTURBANCES:
                raise MissionFileError(number, f"no disturbance {name!r}; there are {', '.join(sorted(DISTURBANCES))}")
            self.missions[-1] = replace(self._last(number), disturbance=name)
        else:
            self.missions.append(Mission(house=self._place.name, kind=self._kind, request=line))

    def _last(self, number: int) -> Mission:
        if not self.missions:
            raise MissionFileError(number, "comes before any request")
        return self.missions[-1]

    def _house(self, number: int, name: str) -> _Place:
        beside = self._folder / name
        try:
            house = load_house(beside) if beside.is_file() else house_of(name)
        except HouseError as error:
            raise MissionFileError(number, f"house {name!r}: {error}") from error
        ids = {room.id for room in house.rooms} | {item.id for item in house.furniture} | {HAND, ROBOT}
        ids |= {thing.id for thing in house.objects} | {person.id for person in house.people}
        return _Place(name=str(beside) if beside.is_file() else name, house=house, ids=frozenset(ids))

    def _outcome(self, number: int, text: str, place: _Place) -> Outcome:
        word, _, rest = text.partition(" ")
        if word == "refuse":
            return Outcome(refused=True, words=_words(rest))
        if word == "answer":
            return Outcome(words=_words(rest))
        states = []
        for part in text.split(";"):
            left, arrow, right = part.partition("->")
            if not arrow:
                problem = f"{part.strip()!r} is no outcome: write 'thing -> place', refuse or answer"
                raise MissionFileError(number, problem)
            states.append(_state(left.split(), tuple(name.strip() for name in right.split("|"))))
        unknown = {name for state in states for name in _names(state)} - place.ids
        if unknown:
            raise MissionFileError(number, f"the house has no {', '.join(sorted(unknown))}")
        sent = {name for state in states if isinstance(state, RobotIn) for name in state.rooms}
        if no_rooms := sent - {room.id for room in place.house.rooms}:
            raise MissionFileError(number, f"the robot ends in a room, and {', '.join(sorted(no_rooms))} is none")
        return Outcome(states=tuple(states))


def _state(left: list[str], places: tuple[str, ...]) -> Placed | RobotIn:
    if left == [ROBOT]:
        return RobotIn(rooms=places)
    if len(left) > 2 and left[0].isdigit() and left[1] == "of":
        return Placed(things=tuple(left[2:]), places=places, count=int(left[0]))
    return Placed(things=tuple(left), places=places)


def _names(state: Placed | RobotIn) -> tuple[str, ...]:
    return state.rooms if isinstance(state, RobotIn) else (*state.things, *state.places)


def _words(text: str) -> tuple[str, ...]:
    return tuple(word.strip() for word in text.split(",") if word.strip())
