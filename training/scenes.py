"""Random rooms full of things: what stands where, before anything is rendered.

Room coordinates in meters: the floor spans (0, 0) to ``Scene.extent_m``, z is up.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace

import numpy as np

from simulation.furnishing.catalog import CATEGORIES
from simulation.furnishing.shapes import Part, Size3, box
from simulation.houses.colors import Rgb
from simulation.houses.placement import to_house
from simulation.pictures.relations import Solid
from training.shapes import Generator, nameless, random_color, random_parts, random_person, random_size, shaken_color

FURNITURE = tuple(name for name, category in CATEGORIES.items() if category.static)
SMALL = tuple(name for name, category in CATEGORIES.items() if not category.static)
NAMELESS = "nameless"
WALL_M = 0.2

_WALL_RGB: Rgb = (0.90, 0.89, 0.85)
_FLOOR_RGB: Rgb = (0.62, 0.55, 0.47)
_DOOR_RGB: Rgb = (0.55, 0.38, 0.24)
_THEMES: Sequence[Sequence[str]] = (
    ("counter", "stove", "sink", "fridge", "table", "chair", "chair", "cabinet", "bin", "washing_machine", "stool"),
    ("sofa", "tv_stand", "shelf", "table", "plant", "lamp", "cabinet", "chair", "nightstand", "bench"),
    ("bed", "wardrobe", "nightstand", "desk", "shelf", "chair", "lamp", "plant"),
    ("desk", "shelf", "cabinet", "chair", "chair", "bin", "plant", "desk", "lamp"),
    ("toilet", "sink", "bathtub", "washing_machine", "bin", "cabinet", "stool"),
    ("table", "chair", "chair", "chair", "cabinet", "bench", "plant", "shelf"),
)
_SEAT_DEPTH = {"sofa": (0.0, -0.14, 0.6, 0.5), "bed": (0.0, -0.15, 0.85, 0.55), "chair": (0.0, -0.05, 0.8, 0.7)}
"""Where things lie on what has a back: center and extent of that place, as shares of the size."""
_ON_WALL = ("tv", "clock", "cabinet", NAMELESS, NAMELESS)


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


def random_scene(rng: Generator) -> Scene:
    """A furnished room with things on, in, under and beside each other."""
    scene = Scene(
        extent_m=(float(rng.uniform(2.4, 7.5)), float(rng.uniform(2.4, 6.5))), height_m=float(rng.uniform(2.3, 3.0))
    )
    _structure(scene, rng)
    _furnish(scene, rng)
    _hang(scene, rng)
    carriers = [index for index, item in enumerate(scene.items) if item.furniture and index > 1]
    for index in carriers:
        _load(scene, index, rng)
    _strew(scene, rng)
    _people(scene, rng)
    return scene


def _structure(scene: Scene, rng: Generator) -> None:
    plain = rng.random() < 0.4
    wall = shaken_color(_WALL_RGB, rng, 0.02) if plain else random_color(rng)
    floor = shaken_color(_FLOOR_RGB, rng, 0.02) if plain else random_color(rng)
    w, d = scene.extent_m
    for side, length in enumerate((w, d, w, d)):
        if rng.random() < 0.4:
            width = float(rng.uniform(0.7, 1.3))
            if length > width + 0.6:
                scene.doors.append((side, float(rng.uniform(width / 2 + 0.2, length - width / 2 - 0.2)), width))
    blocks = []
    for side, length in enumerate((w, d, w, d)):
        shade = wall if rng.random() < 0.8 else shaken_color(wall, rng, 0.1)
        gaps = sorted((at - wide / 2, at + wide / 2) for other, at, wide in scene.doors if other == side)
        edges = [-WALL_M, *(edge for gap in gaps for edge in gap), length + WALL_M]
        for low, high in zip(edges[::2], edges[1::2], strict=True):
            blocks.append(_wall_part(scene, side, low, high, 0.0, scene.height_m, shade))
        for low, high in gaps:
            blocks.append(_wall_part(scene, side, low, high, float(rng.uniform(1.9, 2.1)), scene.height_m, shade))
        if gaps and rng.random() < 0.8:
            beyond = shaken_color(shade, rng, 0.05)
            far = float(rng.uniform(1.2, 4.0))
            blocks.append(_wall_part(scene, side, -4.0, length + 4.0, 0.0, scene.height_m, beyond, far))
    scene.add(_fixed("wall", tuple(blocks)))
    ground = box((w / 2, d / 2, -0.01), (w + 12.0, d + 12.0, 0.02), floor)
    scene.add(_fixed("floor", (ground,)))
    door = shaken_color(_DOOR_RGB, rng, 0.03) if rng.random() < 0.6 else random_color(rng)
    for side, at, width in scene.doors:
        if rng.random() < 0.45:
            height = float(rng.uniform(1.9, 2.1))
            x, y, yaw = _at_wall(scene, side, at, -WALL_M / 2)
            leaf = box((0.0, 0.0, height / 2), (width, float(rng.uniform(0.04, 0.1)), height), door)
            scene.add(
                Item(
                    category="door",
                    parts=(leaf,),
                    bottom_m=(x, y, 0.0),
                    size_m=leaf.size_m,
                    yaw_rad=yaw,
                    furniture=True,
                    attached_to=0,
                )
            )


def _fixed(category: str, parts: tuple[Part, ...]) -> Item:
    return Item(
        category=category, parts=parts, bottom_m=(0.0, 0.0, 0.0), size_m=(0.0, 0.0, 0.0), yaw_rad=0.0, furniture=True
    )


def _at_wall(scene: Scene, side: int, along: float, off: float) -> tuple[float, float, float]:
    """A point ``off`` meters before a wall, and the yaw of what stands there with its back to the wall."""
    w, d = scene.extent_m
    return (
        (along, off, math.pi),
        (w - off, along, -math.pi / 2),
        (along, d - off, 0.0),
        (off, along, math.pi / 2),
    )[side]


def _wall_part(
    scene: Scene, side: int, low: float, high: float, bottom: float, top: float, color: Rgb, beyond: float = 0.0
) -> Part:
    x, y, _ = _at_wall(scene, side, (low + high) / 2, -WALL_M / 2 - beyond)
    size = (high - low, WALL_M, top - bottom) if side % 2 == 0 else (WALL_M, high - low, top - bottom)
    return box((x, y, (bottom + top) / 2), size, color)


def _furnish(scene: Scene, rng: Generator) -> None:
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
    size = random_size(category, rng) if category != NAMELESS else _nameless_size(rng, 0.3, 1.3)
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
        x, y, yaw = _at_wall(scene, side, along, size[1] / 2 + float(rng.uniform(0.01, 0.08)))
        if any(other == side and abs(along - at) < (size[0] + wide) / 2 + 0.1 for other, at, wide in scene.doors):
            return None
        yaw += float(rng.normal(0.0, 0.08)) if rng.random() < 0.15 else 0.0
    return _if_free(scene, _made(category, size, (x, y, 0.0), yaw, rng, furniture=True))


def _made(category: str, size: Size3, bottom: Size3, yaw: float, rng: Generator, *, furniture: bool) -> Item:
    if category == NAMELESS:
        parts = nameless(size, rng)
    else:
        parts = random_parts(category, size, random_color(rng, category), rng)
    return Item(category=category, parts=parts, bottom_m=bottom, size_m=size, yaw_rad=yaw, furniture=furniture)


def _if_free(scene: Scene, item: Item) -> Item | None:
    low, high = _bounds(item)
    if min(low) < -0.001 or high[0] > scene.extent_m[0] + 0.001 or high[1] > scene.extent_m[1] + 0.001:
        return None
    for other in scene.items[2:]:
        if other.category != "door":
            other_low, other_high = _bounds(other)
            if all(low[k] < other_high[k] + 0.02 and other_low[k] < high[k] + 0.02 for k in (0, 1)):
                return None
    return item


def _bounds(item: Item) -> tuple[tuple[float, float], tuple[float, float]]:
    c, s = abs(math.cos(item.yaw_rad)), abs(math.sin(item.yaw_rad))
    x, y = (c * item.size_m[0] + s * item.size_m[1]) / 2, (s * item.size_m[0] + c * item.size_m[1]) / 2
    return (item.bottom_m[0] - x, item.bottom_m[1] - y), (item.bottom_m[0] + x, item.bottom_m[1] + y)


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
            chair = _made(category, size, (at[0], at[1], 0.0), turn + float(rng.normal(0.0, 0.15)), rng, furniture=True)
            others = [scene.items[k] for k in range(2, len(scene.items)) if k != table]
            if _within(scene, chair) and all(math.dist(o.bottom_m[:2], at) > o.radius_m() + 0.25 for o in others):
                scene.add(chair)


def _within(scene: Scene, item: Item) -> bool:
    low, high = _bounds(item)
    return min(low) > 0.0 and high[0] < scene.extent_m[0] and high[1] < scene.extent_m[1]


def _hang(scene: Scene, rng: Generator) -> None:
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
        x, y, yaw = _at_wall(scene, side, along, size[1] / 2 + 0.01)
        bottom = float(rng.uniform(1.0, 1.6))
        blocks = [
            o
            for o in scene.items[2:]
            if o.bottom_m[2] + o.size_m[2] > bottom and math.dist(o.bottom_m[:2], (x, y)) < o.radius_m() + size[0] / 2
        ]
        if not blocks:
            scene.add(replace(_made(category, size, (x, y, bottom), yaw, rng, furniture=True), attached_to=0))


def _load(scene: Scene, index: int, rng: Generator) -> None:
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
    size = random_size(category, rng) if category != NAMELESS else _nameless_size(rng, 0.05, 0.3)
    item = _made(category, size, (0.0, 0.0, 0.0), float(rng.uniform(-math.pi, math.pi)), rng, furniture=False)
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


def _nameless_size(rng: Generator, low: float, high: float) -> Size3:
    x, y, z = (float(side) for side in np.exp(rng.uniform(math.log(low), math.log(high), 3)))
    return x, y, z


def _strew(scene: Scene, rng: Generator) -> None:
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


def _people(scene: Scene, rng: Generator) -> None:
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


def visible_targets(scene: Scene) -> Iterator[tuple[Item, Size3]]:
    """Places worth a picture: tops that carry something, things on the floor, people."""
    for index, item in enumerate(scene.items):
        carries = [other for other in scene.items if index in (other.on, other.inside) and index > 1]
        if carries:
            center = np.mean([other.bottom_m for other in carries], axis=0)
            yield item, (float(center[0]), float(center[1]), float(center[2]))
        elif item.category == "person" or item.on == 1:
            yield item, (item.bottom_m[0], item.bottom_m[1], item.size_m[2] * 0.6)
