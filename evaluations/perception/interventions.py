"""What a person may do to a house while nobody looks: take a thing away, put it elsewhere, bring another.

For scoring only: interventions are chosen from the truth, and the robot is told nothing of them.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from simulation.furnishing.catalog import CATEGORIES, category_named
from simulation.houses.house import House, room_at

Kind = Literal["move", "remove", "add"]
KINDS: tuple[Kind, ...] = ("move", "remove", "add")


@dataclass(frozen=True, kw_only=True)
class Intervention:
    """A change to be made. ``event``: as ``disturb`` takes it. ``places``: furniture from which and onto which."""

    kind: Kind
    thing: str
    category: str
    event: Mapping[str, Any]
    places: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Gaze:
    """Where a camera is in the house, in meters, where it looks, and half its angle of view, in radians."""

    x_m: float
    y_m: float
    yaw_rad: float
    half_width_rad: float
    range_m: float = 6.0
    """Beyond, no change is seen: twice as far as depth tells anything of small things."""

    def meets(self, x_m: float, y_m: float, radius_m: float = 0.0) -> bool:
        """Whether a disc may be in the picture, as far as walls do not hide it."""
        distance_m = math.hypot(x_m - self.x_m, y_m - self.y_m)
        if distance_m <= radius_m:
            return True
        aside_rad = abs(math.remainder(math.atan2(y_m - self.y_m, x_m - self.x_m) - self.yaw_rad, math.tau))
        return distance_m < self.range_m and aside_rad < self.half_width_rad + math.asin(radius_m / distance_m)


def interventions(
    kind: Kind,
    house: House,
    truth: Mapping[str, Any],
    rng: np.random.Generator,
    *,
    rooms: Collection[str],
    gaze: Gaze,
    known: Collection[str] | None = None,
    highest_m: float = 1.25,
) -> Sequence[Intervention]:
    """What could be done now, in random order; whether there is room for a thing shows when it is put.

    Args:
        kind: what is to be done.
        house: as it was built.
        truth: the simulator's truth as it is now.
        rng: draws the order, and what is brought.
        rooms: in which things may change.
        gaze: of the robot's camera; no place in it is touched.
        known: things that may be moved or removed; all by default.
        highest_m: onto tops above this nothing is put that the robot, whose camera is 1.4 m high, has to see.
    """
    places = _supports(house, rooms, gaze, highest_m)
    if kind == "add":
        taken = {entry["id"] for entry in truth["objects"]}
        return [_adding(places[k], taken, rng) for k in rng.permutation(len(places))]
    things = [
        entry
        for entry in truth["objects"]
        if entry["on"] in places and (known is None or entry["id"] in known) and not _carries(entry["id"], truth)
    ]
    order = [things[k] for k in rng.permutation(len(things))]
    if kind == "remove":
        return [_intervention(kind, entry, {"do": "remove", "id": entry["id"]}, (entry["on"],)) for entry in order]
    goals = [(entry, [place for place in places if place != entry["on"]]) for entry in order]
    return [_moving(entry, str(rng.choice(others))) for entry, others in goals if others]


def _supports(house: House, rooms: Collection[str], gaze: Gaze, highest_m: float) -> list[str]:
    """Furniture onto which things are put, not in view."""
    found = []
    for item in house.furniture:
        kind = category_named(item.category, item.size, static=True)
        size = item.size or kind.size_m
        x_m, y_m, _ = item.pose
        carries = kind.support and kind.levels[0] * size[2] <= highest_m
        if carries and room_at(house, x_m, y_m) in rooms and not gaze.meets(x_m, y_m, math.hypot(*size[:2]) / 2.0):
            found.append(item.id)
    return found


def _carries(name: str, truth: Mapping[str, Any]) -> bool:
    return any(name in (entry["on"], entry["in"]) for entry in truth["objects"])


def _moving(entry: Mapping[str, Any], goal: str) -> Intervention:
    event = {"do": "move", "id": entry["id"], "to": {"on": goal}}
    return _intervention("move", entry, event, (entry["on"], goal))


def _intervention(
    kind: Kind, entry: Mapping[str, Any], event: Mapping[str, Any], places: tuple[str, ...]
) -> Intervention:
    return Intervention(kind=kind, thing=entry["id"], category=entry["category"], event=event, places=places)


def _adding(place: str, taken: Collection[str], rng: np.random.Generator) -> Intervention:
    small = [name for name, category in CATEGORIES.items() if not category.static]
    category = str(rng.choice(small))
    name = next(f"brought_{n}" for n in range(len(taken) + 1) if f"brought_{n}" not in taken)
    event = {"do": "add", "object": {"id": name, "category": category, "on": place}}
    return Intervention(kind="add", thing=name, category=category, event=event, places=(place,))
