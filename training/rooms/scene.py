"""A random room and what stands in it, before anything is rendered.

Room coordinates in meters: the floor spans (0, 0) to ``Scene.extent_m``, z is up.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np

from simulation.furnishing.shapes import Part, Size3
from simulation.pictures.relations import Solid
from training.rooms.shapes import Generator, nameless, random_color, random_parts

NAMELESS = "nameless"


@dataclass(frozen=True, kw_only=True)
class Item:
    """Something with a shape. ``bottom_m``: the center of its bottom. ``toppled``: it lies on its side."""

    category: str
    parts: tuple[Part, ...]
    bottom_m: Size3
    size_m: Size3
    yaw_rad: float
    furniture: bool
    on: int | None = None
    inside: int | None = None
    held_by: int | None = None
    attached_to: int | None = None
    toppled: bool = False

    def solid(self) -> Solid:
        """Its box."""
        x, y, z = self.bottom_m
        return Solid(
            center_m=(x, y, z + self.size_m[2] / 2), size_m=self.size_m, yaw_rad=self.yaw_rad, furniture=self.furniture,
            on=self.on, inside=self.inside, held_by=self.held_by, attached_to=self.attached_to,
        )  # fmt: skip

    def radius_m(self) -> float:
        """Of the circle around its footprint."""
        return math.hypot(*self.size_m[:2]) / 2


@dataclass(kw_only=True)
class Scene:
    """A room. Items 0 and 1 are all walls and the floor; what hangs or lies there refers to them."""

    extent_m: tuple[float, float]
    height_m: float
    items: list[Item] = field(default_factory=list)
    doors: list[tuple[int, float, float]] = field(default_factory=list)

    def add(self, item: Item) -> int:
        """Its index."""
        self.items.append(item)
        return len(self.items) - 1


def at_wall(scene: Scene, side: int, along: float, off: float) -> tuple[float, float, float]:
    """A point ``off`` meters before a wall, and the yaw of what stands there with its back to the wall."""
    w, d = scene.extent_m
    return (
        (along, off, math.pi),
        (w - off, along, -math.pi / 2),
        (along, d - off, 0.0),
        (off, along, math.pi / 2),
    )[side]


def bounds(item: Item) -> tuple[tuple[float, float], tuple[float, float]]:
    """Lowest and highest x and y of its footprint."""
    c, s = abs(math.cos(item.yaw_rad)), abs(math.sin(item.yaw_rad))
    x, y = (c * item.size_m[0] + s * item.size_m[1]) / 2, (s * item.size_m[0] + c * item.size_m[1]) / 2
    return (item.bottom_m[0] - x, item.bottom_m[1] - y), (item.bottom_m[0] + x, item.bottom_m[1] + y)


def made(category: str, size: Size3, bottom: Size3, yaw: float, rng: Generator, *, furniture: bool) -> Item:
    """A thing of that kind with shape and color at random."""
    if category == NAMELESS:
        parts = nameless(size, rng)
    else:
        parts = random_parts(category, size, random_color(rng, category), rng)
    return Item(category=category, parts=parts, bottom_m=bottom, size_m=size, yaw_rad=yaw, furniture=furniture)


def nameless_size(rng: Generator, low: float, high: float) -> Size3:
    """Sides between two lengths in meters, as many short ones as long ones."""
    x, y, z = (float(side) for side in np.exp(rng.uniform(math.log(low), math.log(high), 3)))
    return x, y, z
