"""Shapes to learn from: the catalog's builders with proportions and parts shaken, other builds, nameless things."""

from __future__ import annotations

import colorsys
from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np

from simulation.furnishing.catalog import CATEGORIES
from simulation.furnishing.shapes import Part, Size3, box, cylinder, sphere
from simulation.houses.colors import COLORS, Rgb, color_of, toward
from simulation.world.people import person_parts

Generator = np.random.Generator
Build = Callable[[Size3, Rgb, Generator], tuple[Part, ...]]

_OTHER_BUILD = 0.25
_WHITE: Rgb = (1.0, 1.0, 1.0)
_BLACK: Rgb = (0.0, 0.0, 0.0)
_NAMED = tuple(COLORS.values())
_TRUE_COLORS: Mapping[str, tuple[str, ...]] = {
    "apple": ("red", "green", "lime", "maroon", "yellow"),
    "orange": ("orange",),
    "banana": ("yellow", "lime", "gold"),
    "keys": ("silver", "gray", "gold", "dark gray"),
    "plant": ("green", "dark green", "olive", "lime"),
}
"""Kinds that are told from others by their color."""
_SIZES: Mapping[str, tuple[Size3, Size3]] = {
    "table": ((0.75, 0.65, 0.4), (2.0, 1.1, 0.78)),
    "bench": ((0.8, 0.3, 0.38), (1.6, 0.42, 0.48)),
    "stool": ((0.3, 0.3, 0.4), (0.42, 0.42, 0.65)),
    "chair": ((0.4, 0.4, 0.8), (0.6, 0.6, 1.05)),
    "shelf": ((0.6, 0.25, 1.0), (1.6, 0.45, 2.1)),
    "cabinet": ((0.6, 0.35, 0.7), (1.3, 0.55, 1.3)),
    "wardrobe": ((0.8, 0.45, 1.7), (1.6, 0.65, 2.2)),
    "tv_stand": ((0.95, 0.3, 0.38), (1.8, 0.5, 0.6)),
    "nightstand": ((0.35, 0.3, 0.45), (0.55, 0.5, 0.7)),
    "box": ((0.08, 0.06, 0.06), (0.3, 0.22, 0.22)),
}  # fmt: skip
"""Smallest and largest size of kinds that vary more than the others."""


def random_size(category: str, rng: Generator) -> Size3:
    """A size that something of this kind may have: near the usual one half of the time."""
    usual = np.array(CATEGORIES[category].size_m)
    if category in _SIZES and rng.random() < 0.6:
        low, high = (np.array(size) for size in _SIZES[category])
        return _size(rng.uniform(low, high))
    small = CATEGORIES[category].mass_kg > 0.0
    spread = rng.choice((0.0, 0.06, 0.16), p=(0.25, 0.35, 0.4))
    whole = np.exp(rng.normal(0.0, 0.12)) if spread and small else 1.0
    size = usual * whole * np.exp(rng.uniform(-spread, spread, 3))
    if usual[0] == usual[1]:
        size[1] = size[0]
    return _size(size)


def random_color(rng: Generator, category: str | None = None) -> Rgb:
    """Any color; for kinds that are known by theirs, one like it."""
    if category is not None and category in _TRUE_COLORS and rng.random() < 0.93:
        return shaken_color(color_of(str(rng.choice(_TRUE_COLORS[category]))), rng, 0.05)
    kind = rng.random()
    if category is not None and category in CATEGORIES and kind < 0.25:
        return shaken_color(color_of(CATEGORIES[category].color), rng, 0.05)
    if kind < 0.6:
        base = _NAMED[int(rng.integers(len(_NAMED)))]
        shade = rng.random()
        base = toward(base, _WHITE, 0.5) if shade < 0.15 else toward(base, _BLACK, 0.45) if shade < 0.3 else base
        return shaken_color(base, rng, 0.04)
    hue, saturation, value = rng.random(), rng.random() ** 0.8, rng.uniform(0.06, 1.0)
    return colorsys.hsv_to_rgb(hue, saturation, value)


def shaken_color(color: Rgb, rng: Generator, by: float) -> Rgb:
    """A color near ``color``."""
    r, g, b = np.clip(np.array(color) + rng.normal(0.0, by, 3), 0.0, 1.0)
    return float(r), float(g), float(b)


def random_parts(category: str, size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    """Something of a kind that is in the catalog."""
    if category in _OTHER_BUILDS and rng.random() < _OTHER_BUILD:
        return shaken(_OTHER_BUILDS[category](size, color, rng), rng)
    return shaken(CATEGORIES[category].parts(size, color), rng)


def random_person(rng: Generator) -> tuple[tuple[Part, ...], Size3]:
    """A person in other clothes, taller or shorter; parts and size."""
    tall, wide = rng.uniform(0.85, 1.12), rng.uniform(0.85, 1.2)
    shirt, trousers, hair = random_color(rng), random_color(rng), random_color(rng)
    skin = toward((0.93, 0.76, 0.65), (0.30, 0.18, 0.12), rng.random())
    usual = person_parts()
    clothes = {usual[0].color: trousers, usual[4].color: shirt, usual[5].color: skin, usual[-1].color: hair}
    parts = [
        replace(
            part,
            center_m=(part.center_m[0] * wide, part.center_m[1] * wide, part.center_m[2] * tall),
            size_m=_size(
                np.array(part.size_m) * (wide, wide, tall) if part.kind != "sphere" else np.array(part.size_m)
            ),
            color=clothes[part.color],
        )
        for part in usual
    ]
    return shaken(tuple(parts), rng), (0.3 * wide, 0.57 * wide, 1.72 * tall)


def nameless(size: Size3, rng: Generator) -> tuple[Part, ...]:
    """Something that no name fits: one to six primitives of several colors in a heap."""
    parts: list[Part] = []
    for _ in range(int(rng.integers(1, 7)) if rng.random() < 0.75 else 1):
        extent = np.array(size) * rng.uniform(0.25, 1.0, 3)
        at = (np.array(size) - extent) * rng.uniform(-0.5, 0.5, 3)
        color, kind = random_color(rng), rng.random()
        height = extent[2] / 2 if rng.random() < 0.6 else size[2] / 2 + at[2]
        if kind < 0.5:
            parts.append(box((at[0], at[1], height), _size(extent), color))
        elif kind < 0.8:
            upright = cylinder(height - extent[2] / 2, float(min(extent[:2])), float(extent[2]), color)
            parts.append(replace(upright, center_m=(at[0], at[1], height)))
        else:
            parts.append(sphere((at[0], at[1], max(height, min(extent) / 2)), float(min(extent)), color))
    return tuple(parts)


def shaken(parts: tuple[Part, ...], rng: Generator) -> tuple[Part, ...]:
    """The same with the proportions, places and shades of its parts changed a little; sometimes a decal is missing."""
    by = float(rng.choice((0.0, 0.03, 0.08), p=(0.3, 0.4, 0.3)))
    if by == 0.0:
        return parts
    kept = [part for part in parts if part.solid or rng.random() > by]
    return tuple(
        replace(
            part,
            size_m=_size(np.array(part.size_m) * np.exp(rng.normal(0.0, by, 3) if part.solid else np.zeros(3))),
            color=shaken_color(part.color, rng, by / 2),
        )
        for part in kept
    )


def _size(extent: np.ndarray) -> Size3:
    x, y, z = (max(0.002, float(side)) for side in extent)
    return x, y, z


def _at(part: Part, x: float, y: float) -> Part:
    return replace(part, center_m=(x, y, part.center_m[2]))


def _round_table(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    across = min(size[:2])
    dark = toward(color, _BLACK, rng.uniform(0.0, 0.5))
    foot = cylinder(0.0, across * rng.uniform(0.3, 0.6), 0.03, dark)
    return (cylinder(size[2] - 0.04, across, 0.04, color), cylinder(0.03, 0.08, size[2] - 0.07, dark), foot)


def _panel_table(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, d, h = size
    thick = rng.uniform(0.03, 0.07)
    sides = tuple(box((s * w * 0.42, 0.0, (h - thick) / 2), (0.07, d * 0.7, h - thick), color) for s in (-1, 1))
    return (box((0.0, 0.0, h - thick / 2), (w, d, thick), toward(color, _WHITE, rng.uniform(0.0, 0.3))), *sides)


def _pedestal_chair(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, d, h = size
    seat = h * 0.5
    back = box((0.0, d / 2 - 0.03, seat + (h - seat) * 0.6), (w * 0.9, 0.06, (h - seat) * 0.8), color)
    foot = cylinder(0.0, w * 0.9, 0.05, (0.15, 0.15, 0.16))
    pole = cylinder(0.05, 0.07, seat - 0.1, (0.3, 0.3, 0.32))
    arms = tuple(box((s * w * 0.46, 0.0, seat + 0.18), (0.05, d * 0.6, 0.04), _BLACK) for s in (-1, 1))
    return (box((0.0, 0.0, seat - 0.03), (w, d, 0.07), color), back, foot, pole, *(arms if rng.random() < 0.5 else ()))


def _cushioned_sofa(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, d, h = size
    seats = int(rng.integers(2, 4))
    light = toward(color, _WHITE, rng.uniform(0.0, 0.35))
    wide = (w - 0.24) / seats
    cushions = [
        box((-w / 2 + 0.12 + wide * (k + 0.5), -0.08, h * 0.45), (wide - 0.02, d - 0.2, h * 0.16), light)
        for k in range(seats)
    ]
    backs = [
        replace(c, center_m=(c.center_m[0], d * 0.26, h * 0.72), size_m=(wide - 0.02, 0.16, h * 0.4)) for c in cushions
    ]
    base = box((0.0, 0.0, h * 0.2), (w, d, h * 0.36), color)
    arms = [box((s * (w / 2 - 0.06), 0.0, h * 0.35), (0.12, d, h * 0.7), color) for s in (-1, 1)]
    return (base, box((0.0, d / 2 - 0.06, h * 0.45), (w, 0.12, h * 0.9), color), *arms, *cushions, *backs)


def _two_pillow_bed(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, d, h = size
    lying = h * 0.55
    wood = random_color(rng)
    pillows = [box((s * w * 0.24, d / 2 - 0.3, lying + 0.05), (w * 0.4, 0.35, 0.1), _WHITE) for s in (-1, 1)]
    cover = box((0.0, -d * 0.12, lying + 0.01), (w, d * 0.7, 0.05), random_color(rng))
    base = box((0.0, 0.0, lying * 0.3), (w, d, lying * 0.6), wood)
    mattress = box((0.0, 0.0, lying * 0.8), (w * 0.97, d * 0.97, lying * 0.4), color)
    head = box((0.0, d / 2 - 0.03, h / 2), (w, 0.06, h * rng.uniform(0.8, 1.0)), wood)
    return (base, mattress, *pillows, *((cover,) if rng.random() < 0.6 else ()), head)


def _drawer_cabinet(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, d, h = size
    metal = (0.55, 0.57, 0.6)
    columns = int(rng.integers(2, 4))
    fronts = [
        box(
            ((k + 0.5) / columns * w - w / 2, -d / 2, h * 0.5),
            (w / columns - 0.03, 0.008, h * 0.9),
            toward(color, _BLACK, 0.15),
        )
        for k in range(columns)
    ]
    knobs = [
        box((f.center_m[0] + 0.1 * w / columns, -d / 2 - 0.01, h * 0.6), (0.02, 0.02, 0.08), metal) for f in fronts
    ]
    return (box((0.0, 0.0, h / 2), size, color), *fronts, *knobs)


def _bushy_plant(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, _, h = size
    pot = cylinder(0.0, w * rng.uniform(0.5, 0.8), h * 0.3, random_color(rng))
    leaves = []
    for _ in range(int(rng.integers(3, 7))):
        across = w * rng.uniform(0.35, 0.65)
        at = rng.uniform(-0.5, 0.5, 2) * (w - across)
        leaves.append(
            sphere((at[0], at[1], rng.uniform(h * 0.5, h - across / 2)), across, shaken_color(color, rng, 0.07))
        )
    return (pot, cylinder(h * 0.3, 0.05, h * 0.35, (0.35, 0.25, 0.12)), *leaves)


def _ball_lamp(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, _, h = size
    metal = random_color(rng)
    return (
        cylinder(0.0, w * 0.7, 0.03, metal),
        cylinder(0.03, 0.035, h - w * 0.9, metal),
        sphere((0.0, 0.0, h - w * 0.4), w * 0.8, color),
    )


def _shouldered_bottle(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, _, h = size
    body = h * rng.uniform(0.55, 0.7)
    cap = cylinder(h * 0.9, w * 0.45, h * 0.1, random_color(rng))
    label = cylinder(body * 0.3, w * 1.02, body * 0.4, random_color(rng), solid=False)
    neck = cylinder(body, w * rng.uniform(0.3, 0.45), h * 0.9 - body, color)
    return (cylinder(0.0, w, body, color), sphere((0.0, 0.0, body), w * 0.96, color), neck, cap, label)


def _round_vase(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, _, h = size
    rim = cylinder(h * 0.93, w * 0.75, h * 0.07, color)
    foot = cylinder(0.0, w * 0.6, h * 0.15, color)
    neck = cylinder(h * 0.5, w * rng.uniform(0.4, 0.55), h * 0.45, color)
    return (foot, sphere((0.0, 0.0, h * 0.38), w, color), neck, rim)


def _sitting_teddy(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, d, h = size
    light = toward(color, _WHITE, rng.uniform(0.2, 0.6))
    head = sphere((0.0, 0.0, h * 0.76), h * 0.4, color)
    ears = [sphere((s * h * 0.17, 0.0, h * 0.94), h * 0.15, color) for s in (-1, 1)]
    legs = [sphere((s * w * 0.3, -d * 0.4, h * 0.12), h * 0.22, color) for s in (-1, 1)]
    return (
        sphere((0.0, 0.0, h * 0.34), h * 0.58, color),
        head,
        *ears,
        *legs,
        sphere((0.0, -h * 0.17, h * 0.72), h * 0.13, light),
    )


def _handled_mug(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, _, h = size
    inside = cylinder(h - 0.002, w * 0.85, 0.003, toward(color, _BLACK, 0.6), solid=False)
    out = w / 2 + rng.uniform(0.01, 0.025)
    bars = [box(((w / 2 + out) / 2, 0.0, h * k), (out - w / 2 + 0.02, 0.012, 0.012), color) for k in (0.25, 0.75)]
    return (cylinder(0.0, w, h, color), inside, *bars, box((out, 0.0, h * 0.5), (0.012, 0.012, h * 0.55), color))


def _framed_tv(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    w, d, h = size
    feet = [box((s * w * 0.3, 0.0, h * 0.07), (0.04, d, h * 0.14), color) for s in (-1, 1)]
    shown = random_color(rng) if rng.random() < 0.5 else (0.1, 0.12, 0.16)
    screen = box((0.0, -0.026, h * 0.57), (w * 0.93, 0.006, h * 0.76), shown, solid=False)
    return (*feet, box((0.0, 0.0, h * 0.57), (w, 0.05, h * 0.86), color), screen)


def _toy_car(size: Size3, color: Rgb, rng: Generator) -> tuple[Part, ...]:
    """Two bricks on a block, in any colors."""
    w, d, h = size
    bricks = [box((s * w / 4, 0.0, h * 0.8), (w / 2, d, h * 0.4), random_color(rng)) for s in (-1, 1)]
    return (box((0.0, 0.0, h * 0.3), (w, d, h * 0.6), color), *bricks)


_OTHER_BUILDS: Mapping[str, Build] = {
    "table": lambda size, color, rng: (_round_table if rng.random() < 0.5 else _panel_table)(size, color, rng),
    "stool": _round_table, "bench": _panel_table, "chair": _pedestal_chair, "sofa": _cushioned_sofa,
    "bed": _two_pillow_bed, "cabinet": _drawer_cabinet, "wardrobe": _drawer_cabinet, "plant": _bushy_plant,
    "lamp": _ball_lamp, "bottle": _shouldered_bottle, "vase": _round_vase, "teddy": _sitting_teddy,
    "mug": _handled_mug, "tv": _framed_tv, "toy": _toy_car,
}  # fmt: skip
