"""Invents requests for a house from its own document: things a person would call by words that fit nothing else there:
their kind, a plain color and their kind, or their kind and the furniture they are on.

For scoring only; the robot is given the words alone.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator

from evaluations.missions.mission import Mission
from evaluations.missions.outcome import HAND, Outcome, Placed, RobotIn
from simulation.furnishing.catalog import GRIPPER_M, category_named
from simulation.furnishing.shapes import BUILDERS, plain_box
from simulation.houses.house import Furniture, House, Object, Room, room_at
from skills.arm.grasping import HOVER_M
from skills.ports import ArmGeometry, BodyLimits

LOWEST_M, HIGHEST_M = 0.15, 1.05
"""Tops within these heights are where things are asked for to be put."""
PLAIN_COLORS = ("red", "orange", "yellow", "green", "blue", "purple", "pink", "brown", "black", "gray", "white")
"""Colors that people and the robot call by the same word."""
_LEVEL_M = 0.005
"""A part that rises no more than this above where things are put does not push them off."""
_PAIRS = ("keys", "scissors")
_ABSENT = ("piano", "violin", "bicycle", "ladder")


@dataclass(frozen=True, kw_only=True)
class _Item:
    """A thing, what people call it, and the furniture and room it is in."""

    id: str
    words: str
    color: str
    category: str
    on: str
    room: Room

    @property
    def pronoun(self) -> str:
        """What a request calls it the second time."""
        return "them" if self.category in _PAIRS else "it"


@dataclass(frozen=True, kw_only=True)
class _Spot:
    """Furniture that things can be put on, what people call it, and its room."""

    id: str
    words: str
    room: Room


def invent(name: str, house: House, *, count: int, seed: int) -> list[Mission]:
    """Up to ``count`` missions of all kinds for a house, the same for the same seed; fewer where nothing can be asked.

    Every thing is asked for in at most one of them, so that they can be carried out one after another; what moves
    nothing is asked for once.
    """
    inventor = _Inventor(name, house, np.random.default_rng((seed, 0x3155)))
    missions: list[Mission] = []
    idle = 0
    while len(missions) < count and idle < len(KINDS):
        made = inventor.next()
        fresh = made is not None and (bool(made.things) or made.kind not in {mission.kind for mission in missions})
        missions += [made] if made is not None and fresh else []
        idle = 0 if fresh else idle + 1
    return missions


class _Inventor:
    def __init__(self, name: str, house: House, rng: Generator) -> None:
        self._name, self._house, self._rng = name, house, rng
        self._rooms = _uniquely_labelled(house)
        self._spots = _spots(house, self._rooms)
        self._items = [item for item in _items(house, self._spots) if item.room.id in self._rooms]
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

    def take(self, *, without_place: bool = False) -> _Item | None:
        """A thing that has not been asked for yet; ``without_place``: whose words do not say where it is."""
        found = next((item for item in self._items if not (without_place and " from " in item.words)), None)
        if found is not None:
            self._items.remove(found)
        return found

    def spot(self, *, beside: Sequence[_Item] = ()) -> _Spot | None:
        """Furniture to put something on, none of what carries it, or another of its kind, now: what is asked for later
        as *the mug from the desk* is still the only one there.
        """
        kinds = {item.category for item in beside}
        taken = {item.on for item in (*beside, *_all_objects(self._house)) if item.category in kinds}
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


def _to_place(inventor: _Inventor) -> _Made:
    item = inventor.take()
    spot = inventor.spot(beside=[item]) if item is not None else None
    if item is None or spot is None:
        return None
    whence = () if " from " in item.words else ("could you move {it} from {room} to {there}?",)
    words = inventor.say(
        "put {it} on {there}",
        "please bring {it} to {there}",
        "take {it} and put {that} on {there}",
        *whence,
        it=item.words, that=item.pronoun, there=spot.words, room=f"the {item.room.label}",
    )  # fmt: skip
    return words, Outcome(states=(Placed(things=(item.id,), places=(spot.id,)),))


def _to_room(inventor: _Inventor) -> _Made:
    item = inventor.take()
    room = inventor.room(but=item.room.id) if item is not None else None
    if item is None or room is None:
        return None
    words = inventor.say(
        "take {it} to the {room}", "{it} {belong} in the {room}, bring {that} there please",
        "move {it} to the {room}",
        it=item.words, that=item.pronoun, belong="belongs" if item.pronoun == "it" else "belong", room=room.label,
    )  # fmt: skip
    return words, Outcome(states=(Placed(things=(item.id,), places=(room.id,)),))


def _to_person(inventor: _Inventor) -> _Made:
    person = inventor.person()
    item = inventor.take() if person is not None else None
    if person is None or item is None:
        return None
    words = inventor.say("bring me {it}", "could you get me {it}?", "hand me {it} please", it=item.words)
    return words, Outcome(states=(Placed(things=(item.id,), places=(person,)),))


def _two_things(inventor: _Inventor) -> _Made:
    first = inventor.take(without_place=True)  # two places more in one sentence, and nobody knows what belongs to what
    second = inventor.take(without_place=True) if first is not None else None
    if first is None or second is None:
        return None
    spot = inventor.spot(beside=[first, second])
    if spot is None:
        return None
    words = inventor.say(
        "put {a} and {b} on {there}",
        "bring {a} to {there}, then {b} too",
        a=first.words, b=second.words, there=spot.words,
    )  # fmt: skip
    return words, Outcome(states=(Placed(things=(first.id, second.id), places=(spot.id,)),))


def _pick_up(inventor: _Inventor) -> _Made:
    item = inventor.take()
    if item is None:
        return None
    words = inventor.say("pick up {it}", "grab {it} and hold it", "take {it} in your hand", it=item.words)
    return words, Outcome(states=(Placed(things=(item.id,), places=(HAND,)),))


def _go(inventor: _Inventor) -> _Made:
    room = inventor.room()
    if room is None:
        return None
    words = inventor.say("go to the {room}", "drive to the {room} please", room=room.label)
    return words, Outcome(states=(RobotIn(rooms=(room.id,)),))


def _there_and_back(inventor: _Inventor) -> _Made:
    item = inventor.take()
    spot = inventor.spot(beside=[item]) if item is not None else None
    room = inventor.room(but=spot.room.id) if spot is not None else None
    if item is None or spot is None or room is None:
        return None
    words = inventor.say(
        "put {it} on {there} and then go to the {room}", it=item.words, there=spot.words, room=room.label
    )
    return words, Outcome(states=(Placed(things=(item.id,), places=(spot.id,)), RobotIn(rooms=(room.id,))))


def _where(inventor: _Inventor) -> _Made:
    item = inventor.take(without_place=True)
    if item is None:
        return None
    verb = "is" if item.pronoun == "it" else "are"
    words = inventor.say("where {verb} {it}?", "do you know where {it} {verb}?", it=item.words, verb=verb)
    return words, Outcome(words=(item.room.label,))


def _absent(inventor: _Inventor) -> _Made:
    room = inventor.room()
    if room is None:
        return None
    words = inventor.say("bring the {it} to the {room}", it=str(inventor.say(*_ABSENT)), room=room.label)
    return words, Outcome(refused=True)


KINDS: tuple[tuple[str, Callable[[_Inventor], _Made]], ...] = (
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


def _uniquely_labelled(house: House) -> dict[str, Room]:
    """Rooms that their label tells from the others."""
    named = [(room, room_name(room)) for room in house.rooms]
    counts = Counter(name for _, name in named)
    return {room.id: room.model_copy(update={"label": name}) for room, name in named if counts[name] == 1}


def room_name(room: Room) -> str:
    """What people call it."""
    return (room.label or room.id).replace("_", " ")


def _spots(house: House, rooms: dict[str, Room]) -> list[_Spot]:
    """Furniture of a height to put things on, alone of its kind in its room."""
    found = []
    for item in house.furniture:
        room = rooms.get(room_at(house, item.pose[0], item.pose[1]) or "")
        if room is None or not _carries(item):
            continue
        alike = [
            other
            for other in house.furniture
            if other.category == item.category and room_at(house, other.pose[0], other.pose[1]) == room.id
        ]
        if len(alike) == 1:
            words = f"the {_plain(item.category)} in the {room.label}"
            found.append(_Spot(id=item.id, words=words, room=room))
    return found


def _carries(item: Furniture) -> bool:
    kind = category_named(item.category, item.size, static=True)
    return kind.support and not kind.container and LOWEST_M <= _top_m(item) <= HIGHEST_M


def _top_m(item: Furniture) -> float:
    """Height of its first level."""
    kind = category_named(item.category, item.size, static=True)
    return kind.levels[0] * (item.size or kind.size_m)[2]


def _can_be_taken(size_m: tuple[float, float, float], bottom_m: float) -> bool:
    """Whether it fits between the fingers: its narrow side where the hand gets over it, both where it comes level."""
    over_m = BodyLimits().lift_m[1] - ArmGeometry().hand_length_m - HOVER_M
    narrow_m, wide_m = sorted(size_m[:2])
    return (narrow_m if bottom_m + size_m[2] <= over_m else wide_m) <= GRIPPER_M


def _items(house: House, spots: Sequence[_Spot]) -> list[_Item]:
    """Things of a size for the hand, on furniture within reach, that people have words for that fit nothing else."""
    everything = list(_all_objects(house))
    tops_m = {item.id: _top_m(item) for item in house.furniture if _carries(item)}
    found = []
    for item, entry in zip(everything, (entry for entry in house.objects if _room_of(house, entry)), strict=True):
        size = entry.size or category_named(entry.category, entry.size).size_m
        words = _words(item, everything, spots)
        if item.on in tops_m and _can_be_taken(size, tops_m[item.on]) and words is not None:
            carrier = next(piece for piece in house.furniture if piece.id == item.on)
            if _stands_free(entry, size, carrier):
                found.append(replace(item, words=words))
    return found


def _stands_free(entry: Object, size_m: tuple[float, float, float], carrier: Furniture) -> bool:
    """Whether it stays where the house says it is: what was put where the arm of a sofa is slips off."""
    if entry.offset is None:
        return True
    kind, top_m = category_named(carrier.category, carrier.size, static=True), _top_m(carrier)
    for part in BUILDERS.get(carrier.category, plain_box)(carrier.size or kind.size_m, (0.0, 0.0, 0.0)):
        low_m, high_m = (part.center_m[2] + sign * part.size_m[2] / 2 for sign in (-1, 1))
        aside_m = (abs(entry.offset[k] - part.center_m[k]) - part.size_m[k] / 2 for k in (0, 1))
        away_m = math.hypot(*(max(aside, 0.0) for aside in aside_m))
        above = high_m > top_m + _LEVEL_M and low_m < top_m + size_m[2]
        if part.solid and above and away_m < min(size_m[:2]) / 2:
            return False
    return True


def _words(item: _Item, everything: Sequence[_Item], spots: Sequence[_Spot]) -> str | None:
    """Kind alone, else color and kind where all of its kind have plain colors, else kind and furniture."""
    alike = [other for other in everything if other.category == item.category and other is not item]
    kind = _plain(item.category)
    if not alike:
        return f"the {kind}"
    colors = [each.color for each in (item, *alike)]
    if set(colors) <= {*PLAIN_COLORS} and item.color not in colors[1:]:
        return f"the {item.color} {kind}"
    spot = next((spot for spot in spots if spot.id == item.on), None)
    alone = spot is not None and not any(other.on == item.on for other in alike)
    return f"the {kind} from {spot.words}" if spot is not None and alone else None


def _all_objects(house: House) -> Iterator[_Item]:
    for entry in house.objects:
        room = _room_of(house, entry)
        if room is not None:
            kind = category_named(entry.category, entry.size)
            color, on = entry.color or kind.color, entry.on or entry.in_ or ""
            yield _Item(id=entry.id, words="", color=color, category=entry.category, on=on, room=room)


def _room_of(house: House, entry: Object) -> Room | None:
    carrier = next((item for item in house.furniture if item.id in (entry.on, entry.in_)), None)
    pose = carrier.pose if carrier is not None else entry.pose
    room = room_at(house, pose[0], pose[1]) if pose is not None else None
    return next((each.model_copy(update={"label": room_name(each)}) for each in house.rooms if each.id == room), None)


def _plain(category: str) -> str:
    return category.replace("_", " ")
