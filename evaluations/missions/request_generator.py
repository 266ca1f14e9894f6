"""Invents requests for a house from its own document, in words that fit nothing else there.

For scoring only; the robot is given the words alone.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np
from numpy.random import Generator

from evaluations.missions.mission import Mission
from evaluations.missions.outcome import HAND, Outcome, Placed, RobotIn
from evaluations.missions.referring_expressions import Item, Spot, all_objects, items_in, spots_in, uniquely_labelled
from simulation.houses.house import House, Room

_ABSENT = ("piano", "violin", "bicycle", "ladder")


def invent(name: str, house: House, *, count: int, seed: int) -> list[Mission]:
    """Up to ``count`` missions of all kinds for a house, the same for the same seed; fewer where nothing can be asked.

    Every thing is asked for in at most one of them, so that they can be carried out one after another; what moves
    nothing is asked for once.
    """
    generator = _MissionGenerator(name, house, np.random.default_rng((seed, 0x3155)))
    missions: list[Mission] = []
    idle = 0
    while len(missions) < count and idle < len(KINDS):
        made = generator.next()
        fresh = made is not None and (bool(made.things) or made.kind not in {mission.kind for mission in missions})
        missions += [made] if made is not None and fresh else []
        idle = 0 if fresh else idle + 1
    return missions


class _MissionGenerator:
    def __init__(self, name: str, house: House, rng: Generator) -> None:
        self._name, self._house, self._rng = name, house, rng
        self._rooms = uniquely_labelled(house)
        self._spots = spots_in(house, self._rooms)
        self._items = [item for item in items_in(house, self._spots) if item.room.id in self._rooms]
        self._rng.shuffle(self._items)
        self._turn = int(rng.integers(len(KINDS)))

    def next(self) -> Mission | None:
        """A mission of the next kind."""
        kind, make = KINDS[self._turn % len(KINDS)]
        self._turn += 1
        made = make(self)
        if made is None:
            return None
        words, outcome = made
        return Mission(house=self._name, kind=kind, request=words, outcomes=(outcome,))

    def say(self, *ways: str, **parts: str) -> str:
        """One of several ways to say it."""
        return str(self._rng.choice(ways)).format(**parts)

    def take(self, *, without_place: bool = False) -> Item | None:
        """A thing that has not been asked for yet; ``without_place``: whose words do not say where it is."""
        found = next((item for item in self._items if not (without_place and " from " in item.words)), None)
        if found is not None:
            self._items.remove(found)
        return found

    def spot(self, *, beside: Sequence[Item] = ()) -> Spot | None:
        """Furniture to put something on, none of what carries it, or another of its kind, now: what is asked for later
        as *the mug from the desk* is still the only one there.
        """
        kinds = {item.category for item in beside}
        taken = {item.on for item in (*beside, *all_objects(self._house)) if item.category in kinds}
        possible = [spot for spot in self._spots if spot.id not in taken]
        return possible[int(self._rng.integers(len(possible)))] if possible else None

    def room(self, *, but: str = "") -> Room | None:
        """A room that people have a word for."""
        possible = [room for room in self._rooms.values() if room.id != but]
        return possible[int(self._rng.integers(len(possible)))] if possible else None

    def person(self) -> str | None:
        """The only person there is."""
        return self._house.people[0].id if len(self._house.people) == 1 else None


_Made = tuple[str, Outcome] | None


def _to_place(generator: _MissionGenerator) -> _Made:
    item = generator.take()
    spot = generator.spot(beside=[item]) if item is not None else None
    if item is None or spot is None:
        return None
    whence = () if " from " in item.words else ("could you move {it} from {room} to {there}?",)
    words = generator.say(
        "put {it} on {there}",
        "please bring {it} to {there}",
        "take {it} and put {that} on {there}",
        *whence,
        it=item.words, that=item.pronoun, there=spot.words, room=f"the {item.room.label}",
    )  # fmt: skip
    return words, Outcome(states=(Placed(things=(item.id,), places=(spot.id,)),))


def _to_room(generator: _MissionGenerator) -> _Made:
    item = generator.take()
    room = generator.room(but=item.room.id) if item is not None else None
    if item is None or room is None:
        return None
    words = generator.say(
        "take {it} to the {room}", "{it} {belong} in the {room}, bring {that} there please",
        "move {it} to the {room}",
        it=item.words, that=item.pronoun, belong="belongs" if item.pronoun == "it" else "belong", room=room.label,
    )  # fmt: skip
    return words, Outcome(states=(Placed(things=(item.id,), places=(room.id,)),))


def _to_person(generator: _MissionGenerator) -> _Made:
    person = generator.person()
    item = generator.take() if person is not None else None
    if person is None or item is None:
        return None
    words = generator.say("bring me {it}", "could you get me {it}?", "hand me {it} please", it=item.words)
    return words, Outcome(states=(Placed(things=(item.id,), places=(person,)),))


def _two_things(generator: _MissionGenerator) -> _Made:
    first = generator.take(without_place=True)  # two places more in one sentence, and nobody knows what belongs to what
    second = generator.take(without_place=True) if first is not None else None
    if first is None or second is None:
        return None
    spot = generator.spot(beside=[first, second])
    if spot is None:
        return None
    words = generator.say(
        "put {a} and {b} on {there}",
        "bring {a} to {there}, then {b} too",
        a=first.words, b=second.words, there=spot.words,
    )  # fmt: skip
    return words, Outcome(states=(Placed(things=(first.id, second.id), places=(spot.id,)),))


def _pick_up(generator: _MissionGenerator) -> _Made:
    item = generator.take()
    if item is None:
        return None
    words = generator.say("pick up {it}", "grab {it} and hold it", "take {it} in your hand", it=item.words)
    return words, Outcome(states=(Placed(things=(item.id,), places=(HAND,)),))


def _go(generator: _MissionGenerator) -> _Made:
    room = generator.room()
    if room is None:
        return None
    words = generator.say("go to the {room}", "drive to the {room} please", room=room.label)
    return words, Outcome(states=(RobotIn(rooms=(room.id,)),))


def _there_and_back(generator: _MissionGenerator) -> _Made:
    item = generator.take()
    spot = generator.spot(beside=[item]) if item is not None else None
    room = generator.room(but=spot.room.id) if spot is not None else None
    if item is None or spot is None or room is None:
        return None
    words = generator.say(
        "put {it} on {there} and then go to the {room}", it=item.words, there=spot.words, room=room.label
    )
    return words, Outcome(states=(Placed(things=(item.id,), places=(spot.id,)), RobotIn(rooms=(room.id,))))


def _where(generator: _MissionGenerator) -> _Made:
    item = generator.take(without_place=True)
    if item is None:
        return None
    verb = "is" if item.pronoun == "it" else "are"
    words = generator.say("where {verb} {it}?", "do you know where {it} {verb}?", it=item.words, verb=verb)
    return words, Outcome(words=(item.room.label,))


def _absent(generator: _MissionGenerator) -> _Made:
    room = generator.room()
    if room is None:
        return None
    words = generator.say("bring the {it} to the {room}", it=str(generator.say(*_ABSENT)), room=room.label)
    return words, Outcome(refused=True)


KINDS: tuple[tuple[str, Callable[[_MissionGenerator], _Made]], ...] = (
    ("to a place", _to_place),
    ("to a room", _to_room),
    ("to a person", _to_person),
    ("two things", _two_things),
    ("pick up", _pick_up),
    ("place and go", _there_and_back),
    ("go", _go),
    ("where", _where),
    ("not there", _absent),
)
