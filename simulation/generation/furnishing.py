"""Furniture along the walls, a table here and there, small things on top; doors and ways stay free."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np

from simulation.furnishing.catalog import category_named
from simulation.generation.floor import Floor, floor_of
from simulation.generation.plans import Plan
from simulation.generation.settings import FurnishingSettings
from simulation.generation.tiles import Outline, sides

_FURNITURE: Mapping[str, Sequence[str]] = MappingProxyType(
    {
        "corridor": ("cabinet", "plant", "bench"),
        "hall": ("wardrobe", "cabinet", "bench", "plant", "plant", "sofa"),
        "living room": ("sofa", "tv_stand", "shelf", "table", "plant", "cabinet", "lamp", "wardrobe"),
        "lounge": ("sofa", "sofa", "table", "shelf", "plant", "lamp"),
        "reception": ("desk", "sofa", "plant", "shelf", "wardrobe"),
        "dining room": ("table", "cabinet", "chair", "chair", "shelf", "plant"),
        "kitchen": ("counter", "stove", "sink", "fridge", "table", "chair", "cabinet"),
        "meeting room": ("table", "shelf", "plant", "chair", "chair", "cabinet"),
        "office": ("desk", "shelf", "cabinet", "chair", "wardrobe", "plant", "bin"),
        "bedroom": ("bed", "wardrobe", "nightstand", "desk", "shelf", "chair"),
        "laundry room": ("washing_machine", "shelf", "sink", "bin"),
        "storage": ("shelf", "shelf", "cabinet", "wardrobe"),
        "bathroom": ("toilet", "sink", "bathtub", "washing_machine", "bin"),
    }
)
"""What stands in a room by its label, the most important first."""

_IN_THE_MIDDLE = frozenset({"table", "chair"})
_THINGS = ("bottle", "cup", "can", "mug", "bowl", "book", "apple", "vase", "box", "toy")
_COLORS = ("blue", "red", "green", "yellow", "white", "orange", "purple", "brown")


@dataclass(frozen=True, kw_only=True)
class Piece:
    """A piece of furniture in the plan: center in meters, ``yaw_rad``; its front is -y."""

    category: str
    room: int
    x_m: float
    y_m: float
    yaw_rad: float
    size_m: tuple[float, float, float]


@dataclass(frozen=True, kw_only=True)
class SmallThing:
    """A thing on piece number ``on``."""

    category: str
    color: str
    on: int


@dataclass(frozen=True, kw_only=True)
class Furnishing:
    """What stands in the house, and where the robot starts: ``start`` [x, y] in meters of the plan."""

    pieces: tuple[Piece, ...]
    things: tuple[SmallThing, ...]
    start: tuple[float, float]


def furnish(
    generator: np.random.Generator,
    plan: Plan,
    *,
    furnished: bool,
    settings: FurnishingSettings = FurnishingSettings(),
) -> Furnishing:
    """Fill the rooms of a plan, and set the robot down in one of them."""
    floors = [floor_of(plan, room, settings.floor) for room in range(len(plan.outlines))]
    pieces: list[Piece] = []
    if furnished:
        for room, floor in enumerate(floors):
            pieces += _fill(generator, plan, room, floor, settings)
    things = tuple(_things(generator, pieces, settings))
    return Furnishing(pieces=tuple(pieces), things=things, start=_start(generator, floors))


def _fill(
    generator: np.random.Generator, plan: Plan, room: int, floor: Floor, settings: FurnishingSettings
) -> list[Piece]:
    """Furniture for one room, as much as its taste and its size allow."""
    wanted = _FURNITURE.get(plan.uses[room].label, ("cabinet",))
    count = 1 + int(generator.integers(len(wanted)))
    placed: list[Piece] = []
    for category in wanted[:count]:
        for _ in range(settings.tries):
            piece = _try(generator, plan.outlines[room], room, category, settings.gaps_m)
            if floor.take(piece.x_m, piece.y_m, piece.yaw_rad, piece.size_m[:2]):
                placed.append(piece)
                break
    return placed


def _try(
    generator: np.random.Generator, outline: Outline, room: int, category: str, gaps_m: tuple[float, float]
) -> Piece:
    """A place against a wall, more often so for longer walls; some things now and then stand free."""
    usual = category_named(category, None, static=True).size_m
    size = tuple(round(side * float(generator.uniform(0.9, 1.1)), 2) for side in usual)
    width_m, depth_m = size[0], size[1]
    walls = [(np.array(a) / 1000, np.array(b) / 1000) for a, b in sides(outline)]
    lengths = np.array([np.linalg.norm(b - a) for a, b in walls])
    start, end = walls[generator.choice(len(walls), p=lengths / lengths.sum())]
    length = float(np.linalg.norm(end - start))
    along = (end - start) / length
    inward = np.array([-along[1], along[0]])
    room_for = max(length - width_m - 2 * gaps_m[1], 0.0)
    station = width_m / 2 + gaps_m[1] + room_for * _snap(float(generator.random()))
    away = depth_m / 2 + float(generator.uniform(*gaps_m))
    if category in _IN_THE_MIDDLE and generator.random() < 0.5:
        away += float(generator.uniform(0.8, 1.6))
    x_m, y_m = start + station * along + away * inward
    return Piece(
        category=category,
        room=room,
        x_m=round(float(x_m), 3),
        y_m=round(float(y_m), 3),
        yaw_rad=math.atan2(inward[0], -inward[1]),
        size_m=(size[0], size[1], size[2]),
    )


def _snap(share: float) -> float:
    """People like corners: a third of all places along a wall are its ends."""
    return float(np.clip(1.5 * share - 0.25, 0.0, 1.0))


def _things(generator: np.random.Generator, pieces: Sequence[Piece], settings: FurnishingSettings) -> list[SmallThing]:
    things: list[SmallThing] = []
    for index, piece in enumerate(pieces):
        category = category_named(piece.category, piece.size_m, static=True)
        if not category.support or piece.category in {"chair", "stool", "sofa", "bed", "bench", "stove"}:
            continue
        wanted = [
            SmallThing(category=str(generator.choice(_THINGS)), color=str(generator.choice(_COLORS)), on=index)
            for _ in range(int(generator.integers(settings.most_things + 1)))
        ]
        things += wanted[: int(piece.size_m[0] * piece.size_m[1] / settings.area_of_a_thing_m2)]
    return things


def _start(generator: np.random.Generator, floors: Sequence[Floor]) -> tuple[float, float]:
    """Somewhere in some room, well away from everything."""
    spots = [spots for floor in floors if len(spots := floor.free_spots())]
    room = spots[generator.integers(len(spots))]
    x_m, y_m = room[generator.integers(len(room))]
    return round(float(x_m), 3), round(float(y_m), 3)
