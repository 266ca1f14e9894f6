"""Small things on, in and under the furniture of random rooms, and people."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

from simulation.furnishing.catalog import CATEGORIES
from simulation.furnishing.shapes import Size3, box
from simulation.houses.placement import to_house
from training.rooms.scene import NAMELESS, Item, Scene, made, nameless_size
from training.rooms.shapes import Generator, random_person, random_size

SMALL = tuple(name for name, category in CATEGORIES.items() if not category.static)
_SEAT_DEPTH = {"sofa": (0.0, -0.14, 0.6, 0.5), "bed": (0.0, -0.15, 0.85, 0.55), "chair": (0.0, -0.05, 0.8, 0.7)}
"""Where things lie on what has a back: center and extent of that place, as shares of the size."""


def load(scene: Scene, index: int, rng: Generator) -> None:
    """Things on and in a piece of furniture."""
    item = scene.items[index]
    if item.category not in CATEGORIES or (item.attached_to is not None and item.category != "cabinet"):
        return
    kind = CATEGORIES[item.category]
    if not (kind.support or kind.container) or rng.random() < 0.2:
        return
    levels = kind.levels if item.category == "shelf" else kind.levels[:1]
    for level in levels:
        most = (
            4
            if item.category in ("shelf", "chair", "stool", "nightstand", "bin", "sink")
            else 11
            if rng.random() < 0.3
            else 6
        )
        placed: list[Item] = []
        for _ in range(int(rng.integers(0, most))):
            thing = _small(rng)
            if item.category == "shelf" and level < 1.0 and thing.size_m[2] > 0.23 * item.size_m[2]:
                continue
            spot = _spot(item, level, thing, placed, rng)
            if spot is not None:
                thing = replace(thing, inside=index) if kind.container else replace(thing, on=index)
                placed.append(replace(thing, bottom_m=spot))
                _on_top(scene, scene.add(placed[-1]), rng)


def _spot(item: Item, level: float, thing: Item, placed: Sequence[Item], rng: Generator) -> Size3 | None:
    x, y, wide, deep = _SEAT_DEPTH.get(item.category, (0.0, 0.0, 0.96, 0.94))
    w, d, h = item.size_m
    play = [max(0.0, extent / 2 - thing.radius_m() * 0.9) for extent in (wide * w, deep * d)]
    if item.category in ("sink", "bathtub", "bin"):
        play = [max(0.0, side - 0.09) for side in play]
    for _ in range(5):
        offset = (x * w + float(rng.uniform(-1, 1)) * play[0], y * d + float(rng.uniform(-1, 1)) * play[1])
        at = to_house((*item.bottom_m[:2], item.yaw_rad), offset)
        if all(math.dist(at, other.bottom_m[:2]) > 0.8 * (other.radius_m() + thing.radius_m()) for other in placed):
            return (at[0], at[1], item.bottom_m[2] + level * h)
    return None


def _small(rng: Generator) -> Item:
    """A small thing, at the origin."""
    category = NAMELESS if rng.random() < 0.07 else str(rng.choice(SMALL))
    if rng.random() < 0.01:
        category = "tv"
    size = random_size(category, rng) if category != NAMELESS else nameless_size(rng, 0.05, 0.3)
    item = made(category, size, (0.0, 0.0, 0.0), float(rng.uniform(-math.pi, math.pi)), rng, furniture=False)
    if category in ("bottle", "can", "cup", "mug", "glass", "vase", "teddy") and rng.random() < 0.04:
        w, d, h = size
        return replace(item, toppled=True, size_m=(h, d, w))
    return item


def _on_top(scene: Scene, index: int, rng: Generator) -> None:
    """Now and then something lies on a box, a book or a plate, or in a bowl."""
    below = scene.items[index]
    if below.category not in ("box", "book", "plate", "bowl") or rng.random() > 0.25 or below.toppled:
        return
    thing = _small(rng)
    if thing.radius_m() > 1.2 * below.radius_m():
        return
    x, y, z = below.bottom_m
    if below.category == "bowl":
        scene.add(replace(thing, bottom_m=(x, y, z + 0.15 * below.size_m[2]), inside=index))
    else:
        scene.add(replace(thing, bottom_m=(x, y, z + below.size_m[2]), on=index))


def strew(scene: Scene, rng: Generator) -> None:
    """Things on the floor, under tables too."""
    for _ in range(int(rng.integers(0, 6))):
        thing = _small(rng)
        x, y = (float(rng.uniform(0.2, side - 0.2)) for side in scene.extent_m)
        item = replace(thing, bottom_m=(x, y, 0.0), on=1)
        others = [
            o
            for o in scene.items[2:]
            if o.bottom_m[2] < 0.1 and o.category not in ("table", "desk", "bench", "chair", "door")
        ]
        if all(math.dist((x, y), o.bottom_m[:2]) > o.radius_m() + item.radius_m() for o in others):
            scene.add(item)


def add_people(scene: Scene, rng: Generator) -> None:
    """Nobody, or one or two people, some with a thing in the hand."""
    for _ in range(int(rng.choice((0, 1, 2), p=(0.6, 0.3, 0.1)))):
        parts, size = random_person(rng)
        x, y = (float(rng.uniform(0.35, side - 0.35)) for side in scene.extent_m)
        near = [
            o
            for o in scene.items[2:]
            if math.dist((x, y), o.bottom_m[:2]) < min(o.radius_m(), 0.6) + 0.35 and o.furniture
        ]
        if near:
            continue
        yaw = float(rng.uniform(-math.pi, math.pi))
        hand = float(rng.choice((-1, 1)))
        holds = rng.random() < 0.4
        if holds:
            sleeve = next(part for part in parts if part.kind == "box" and abs(part.center_m[1]) > 0.15)
            parts += (box((0.18, hand * 0.24, 1.0), (0.28, 0.08, 0.08), sleeve.color),)
        index = scene.add(
            Item(
                category="person", parts=parts, bottom_m=(x, y, 0.0), size_m=size, yaw_rad=yaw, furniture=False, on=None
            )
        )
        if holds:
            thing = _small(rng)
            at = to_house((x, y, yaw), (0.32, hand * 0.24))
            scene.add(
                replace(
                    thing, bottom_m=(at[0], at[1], 1.0 - float(rng.uniform(0.0, 0.5)) * thing.size_m[2]), held_by=index
                )
            )
