"""What people call the things and places of a house: words that fit nothing else there (referring expressions)."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from simulation.furnishing.catalog import category_named
from simulation.furnishing.shapes import BUILDERS, plain_box
from simulation.houses.house import Furniture, House, Object, Room, room_at
from simulation.robot.description import RobotDescription
from skills.arm.hand import Hand

PLAIN_COLORS = ("red", "orange", "yellow", "green", "blue", "purple", "pink", "brown", "black", "gray", "white")
"""Colors that people and the robot call by the same word."""
_PAIRS = ("keys", "scissors")


@dataclass(frozen=True, kw_only=True)
class RequestSettings:
    """What is asked for."""

    lowest_m: float = 0.15
    highest_m: float = 1.05
    """Tops within these heights are where things are asked for to be put: chosen, within the arm's reach from above."""
    level_m: float = 0.005
    """A part that rises no more than this above where things are put does not push them off."""


@dataclass(frozen=True, kw_only=True)
class Item:
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
class Spot:
    """Furniture that things can be put on, what people call it, and its room."""

    id: str
    words: str
    room: Room


def uniquely_labelled(house: House) -> dict[str, Room]:
    """Rooms that their label tells from the others."""
    named = [(room, room_name(room)) for room in house.rooms]
    counts = Counter(name for _, name in named)
    return {room.id: room.model_copy(update={"label": name}) for room, name in named if counts[name] == 1}


def room_name(room: Room) -> str:
    """What people call it."""
    return (room.label or room.id).replace("_", " ")


def spots_in(house: House, rooms: dict[str, Room], settings: RequestSettings = RequestSettings()) -> list[Spot]:
    """Furniture of a height to put things on, alone of its kind in its room."""
    found = []
    for item in house.furniture:
        room = rooms.get(room_at(house, item.pose[0], item.pose[1]) or "")
        if room is None or not _carries(item, settings):
            continue
        alike = [
            other
            for other in house.furniture
            if other.category == item.category and room_at(house, other.pose[0], other.pose[1]) == room.id
        ]
        if len(alike) == 1:
            words = f"the {_plain(item.category)} in the {room.label}"
            found.append(Spot(id=item.id, words=words, room=room))
    return found


def _carries(item: Furniture, settings: RequestSettings) -> bool:
    kind = category_named(item.category, item.size, static=True)
    return kind.support and not kind.container and settings.lowest_m <= _top_m(item) <= settings.highest_m


def _top_m(item: Furniture) -> float:
    """Height of its first level."""
    kind = category_named(item.category, item.size, static=True)
    return kind.levels[0] * (item.size or kind.size_m)[2]


def _can_be_taken(size_m: tuple[float, float, float], bottom_m: float) -> bool:
    """Whether it fits between the fingers: its narrow side where the hand gets over it, both where it comes level."""
    over_m = Hand().highest_pads_m - Hand().settings.hover_m
    narrow_m, wide_m = sorted(size_m[:2])
    return (narrow_m if bottom_m + size_m[2] <= over_m else wide_m) <= RobotDescription().graspable_m


def items_in(house: House, spots: Sequence[Spot], settings: RequestSettings = RequestSettings()) -> list[Item]:
    """Things of a size for the hand, on furniture within reach, that people have words for that fit nothing else."""
    everything = list(all_objects(house))
    tops_m = {item.id: _top_m(item) for item in house.furniture if _carries(item, settings)}
    found = []
    for item, entry in zip(everything, (entry for entry in house.objects if _room_of(house, entry)), strict=True):
        size = entry.size or category_named(entry.category, entry.size).size_m
        words = _words(item, everything, spots)
        if item.on in tops_m and _can_be_taken(size, tops_m[item.on]) and words is not None:
            carrier = next(piece for piece in house.furniture if piece.id == item.on)
            if _stands_free(entry, size, carrier, settings.level_m):
                found.append(replace(item, words=words))
    return found


def _stands_free(entry: Object, size_m: tuple[float, float, float], carrier: Furniture, level_m: float) -> bool:
    """Whether it stays where the house says it is: what was put where the arm of a sofa is slips off."""
    if entry.offset is None:
        return True
    kind, top_m = category_named(carrier.category, carrier.size, static=True), _top_m(carrier)
    for part in BUILDERS.get(carrier.category, plain_box)(carrier.size or kind.size_m, (0.0, 0.0, 0.0)):
        low_m, high_m = (part.center_m[2] + sign * part.size_m[2] / 2 for sign in (-1, 1))
        aside_m = (abs(entry.offset[k] - part.center_m[k]) - part.size_m[k] / 2 for k in (0, 1))
        away_m = math.hypot(*(max(aside, 0.0) for aside in aside_m))
        above = high_m > top_m + level_m and low_m < top_m + size_m[2]
        if part.solid and above and away_m < min(size_m[:2]) / 2:
            return False
    return True


def _words(item: Item, everything: Sequence[Item], spots: Sequence[Spot]) -> str | None:
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


def all_objects(house: House) -> Iterator[Item]:
    """Every thing of the house that is in a room; nobody has words for it yet."""
    for entry in house.objects:
        room = _room_of(house, entry)
        if room is not None:
            kind = category_named(entry.category, entry.size)
            color, on = entry.color or kind.color, entry.on or entry.in_ or ""
            yield Item(id=entry.id, words="", color=color, category=entry.category, on=on, room=room)


def _room_of(house: House, entry: Object) -> Room | None:
    carrier = next((item for item in house.furniture if item.id in (entry.on, entry.in_)), None)
    pose = carrier.pose if carrier is not None else entry.pose
    room = room_at(house, pose[0], pose[1]) if pose is not None else None
    return next((each.model_copy(update={"label": room_name(each)}) for each in house.rooms if each.id == room), None)


def _plain(category: str) -> str:
    return category.replace("_", " ")
