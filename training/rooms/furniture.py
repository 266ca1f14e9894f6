"""Furniture of random rooms, chairs at their tables, and what hangs on their walls."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from simulation.furnishing.catalog import CATEGORIES
from simulation.furnishing.shapes import Size3
from simulation.houses.placement import to_house
from training.rooms.scene import NAMELESS, Item, Scene, at_wall, bounds, made, nameless_size
from training.rooms.shapes import Generator, random_size

FURNITURE = tuple(name for name, category in CATEGORIES.items() if category.static)
_THEMES: Sequence[Sequence[str]] = (
    ("counter", "stove", "sink", "fridge", "table", "chair", "chair", "cabinet", "bin", "washing_machine", "stool"),
    ("sofa", "tv_stand", "shelf", "table", "plant", "lamp", "cabinet", "chair", "nightstand", "bench"),
    ("bed", "wardrobe", "nightstand", "desk", "shelf", "chair", "lamp", "plant"),
    ("desk", "shelf", "cabinet", "chair", "chair", "bin", "plant", "desk", "lamp"),
    ("toilet", "sink", "bathtub", "washing_machine", "bin", "cabinet", "stool"),
    ("table", "chair", "chair", "chair", "cabinet", "bench", "plant", "shelf"),
)
_ON_WALL = ("tv", "clock", "cabinet", NAMELESS, NAMELESS)


def furnish(scene: Scene, rng: Generator) -> None:
    """Furniture that belongs together half of the time, and chairs at its tables."""
    theme = list(_THEMES[int(rng.integers(len(_THEMES)))]) if rng.random() < 0.5 else None
    wanted = int(rng.integers(3, 13))
    for _ in range(wanted):
        category = str(rng.choice(theme)) if theme and rng.random() < 0.85 else str(rng.choice(FURNITURE))
        if rng.random() < 0.05:
            category = NAMELESS
        for _ in range(6):
            item = _piece(scene, category, rng)
            if item is not None:
                index = scene.add(item)
                if category in ("table", "desk") and rng.random() < 0.6:
                    _seats(scene, index, rng)
                break


def _piece(scene: Scene, category: str, rng: Generator) -> Item | None:
    """A piece of furniture at a wall or in the middle; none where it does not fit."""
    size = random_size(category, rng) if category != NAMELESS else nameless_size(rng, 0.3, 1.3)
    middle = rng.random() < (0.4 if category in ("table", "chair", "stool", "plant", "bin", "bench", "lamp") else 0.08)
    if middle:
        x, y = (float(rng.uniform(0.3, side - 0.3)) for side in scene.extent_m)
        yaw = float(rng.uniform(-math.pi, math.pi))
    else:
        side = int(rng.integers(4))
        length = scene.extent_m[side % 2]
        if size[0] + 0.1 > length:
            return None
        along = float(rng.uniform(size[0] / 2, length - size[0] / 2))
        x, y, yaw = at_wall(scene, side, along, size[1] / 2 + float(rng.uniform(0.01, 0.08)))
        if any(other == side and abs(along - at) < (size[0] + wide) / 2 + 0.1 for other, at, wide in scene.doors):
            return None
        yaw += float(rng.normal(0.0, 0.08)) if rng.random() < 0.15 else 0.0
    return _if_free(scene, made(category, size, (x, y, 0.0), yaw, rng, furniture=True))


def _if_free(scene: Scene, item: Item) -> Item | None:
    low, high = bounds(item)
    if min(low) < -0.001 or high[0] > scene.extent_m[0] + 0.001 or high[1] > scene.extent_m[1] + 0.001:
        return None
    for other in scene.items[2:]:
        if other.category != "door":
            other_low, other_high = bounds(other)
            if all(low[k] < other_high[k] + 0.02 and other_low[k] < high[k] + 0.02 for k in (0, 1)):
                return None
    return item


def _seats(scene: Scene, table: int, rng: Generator) -> None:
    """Chairs at a table, some of them pushed under it; a bin or a box may stand under it as well."""
    item = scene.items[table]
    for side in range(4):
        if rng.random() < 0.35:
            category = str(rng.choice(("chair", "stool", "bin"), p=(0.75, 0.15, 0.1)))
            size = random_size(category, rng)
            half = item.size_m[1 - side % 2] / 2 if side % 2 == 0 else item.size_m[0] / 2
            out = half + float(rng.uniform(-0.35, 0.25)) * size[1] + (0.25 if rng.random() < 0.4 else 0.0)
            turn = item.yaw_rad + side * math.pi / 2
            at = to_house((*item.bottom_m[:2], turn), (float(rng.uniform(-0.1, 0.1)), out))
            chair = made(category, size, (at[0], at[1], 0.0), turn + float(rng.normal(0.0, 0.15)), rng, furniture=True)
            others = [scene.items[k] for k in range(2, len(scene.items)) if k != table]
            if _within(scene, chair) and all(math.dist(o.bottom_m[:2], at) > o.radius_m() + 0.25 for o in others):
                scene.add(chair)


def _within(scene: Scene, item: Item) -> bool:
    low, high = bounds(item)
    return min(low) > 0.0 and high[0] < scene.extent_m[0] and high[1] < scene.extent_m[1]


def hang(scene: Scene, rng: Generator) -> None:
    """Things on the walls."""
    for _ in range(int(rng.integers(0, 4))):
        category = str(rng.choice(_ON_WALL))
        grown = float(rng.uniform(0.9, 1.4))
        if category == NAMELESS:
            size: Size3 = (float(rng.uniform(0.2, 1.0)), float(rng.uniform(0.02, 0.08)), float(rng.uniform(0.2, 0.9)))
        elif category == "clock":
            size = (0.25 * grown, 0.05, 0.25 * grown)
        elif category == "cabinet":
            size = (0.7 * grown, 0.35, 0.55 * grown)
        else:
            size = random_size(category, rng)
        side = int(rng.integers(4))
        length = scene.extent_m[side % 2]
        along = float(rng.uniform(0.6, length - 0.6))
        if any(other == side and abs(along - at) < (size[0] + wide) / 2 + 0.1 for other, at, wide in scene.doors):
            continue
        x, y, yaw = at_wall(scene, side, along, size[1] / 2 + 0.01)
        bottom = float(rng.uniform(1.0, 1.6))
        blocks = [
            o
            for o in scene.items[2:]
            if o.bottom_m[2] + o.size_m[2] > bottom and math.dist(o.bottom_m[:2], (x, y)) < o.radius_m() + size[0] / 2
        ]
        if not blocks:
            scene.add(replace(made(category, size, (x, y, bottom), yaw, rng, furniture=True), attached_to=0))
