"""What the things that the robot carries are made of, in the same frame as ``shapes``."""

from __future__ import annotations

import math
from collections.abc import Mapping
from types import MappingProxyType

from simulation.furnishing.shapes import Builder, Part, Size3, box, cylinder, sphere
from simulation.houses.colors import Rgb, toward

_BLACK: Rgb = (0.0, 0.0, 0.0)
_WHITE: Rgb = (1.0, 1.0, 1.0)
_METAL: Rgb = (0.70, 0.71, 0.73)


def _bottle(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, _, h = size
    label = cylinder(h * 0.22, w * 1.01, h * 0.22, toward(color, _WHITE, 0.75), solid=False)
    cap = cylinder(h * 0.92, w * 0.42, h * 0.08, toward(color, _BLACK, 0.5))
    return (cylinder(0.0, w, h * 0.7, color), cylinder(h * 0.7, w * 0.4, h * 0.22, color), cap, label)


def _can(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, _, h = size
    lid = cylinder(h - 0.004, w * 0.9, 0.005, _METAL, solid=False)
    return (cylinder(0.0, w, h, color), lid)


def _cup(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, _, h = size
    inside = cylinder(h - 0.002, w * 0.84, 0.003, toward(color, _BLACK, 0.6), solid=False)
    return (cylinder(0.0, w, h, color), inside)


def _mug(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, _, h = size
    handle = box((w / 2 + 0.012, 0.0, h * 0.5), (0.03, 0.012, h * 0.55), color, solid=False)
    return (*_cup(size, color), handle)


def _bowl(size: Size3, color: Rgb) -> tuple[Part, ...]:
    """A disc with a rim of eight blocks."""
    w, _, h = size
    floor_m, rim_m = 0.15 * h, 0.008
    across_m = w / 2 - rim_m / 2
    sides = []
    for sign in (-1, 1):
        sides.append(box((sign * across_m, 0.0, (h + floor_m) / 2), (rim_m, w * 0.45, h - floor_m), color))
        sides.append(box((0.0, sign * across_m, (h + floor_m) / 2), (w * 0.45, rim_m, h - floor_m), color))
        for other in (-1, 1):
            at = across_m / math.sqrt(2) * 0.98
            sides.append(box((sign * at, other * at, (h + floor_m) / 2), (w * 0.2, w * 0.2, h - floor_m), color))
    return (cylinder(0.0, w * 0.96, floor_m, toward(color, _BLACK, 0.15)), *sides)


def _plate(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, _, h = size
    inner = cylinder(h - 0.001, w * 0.65, 0.002, toward(color, _BLACK, 0.12), solid=False)
    return (cylinder(0.0, w, h, color), inner)


def _vase(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, _, h = size
    return (cylinder(0.0, w, h * 0.6, color), cylinder(h * 0.6, w * 0.6, h * 0.4, toward(color, _WHITE, 0.2)))


def _apple(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w = size[0]
    stalk = cylinder(w * 0.97, w * 0.08, w * 0.12, (0.30, 0.20, 0.10), solid=False)
    return (sphere((0.0, 0.0, w / 2), w, color), stalk)


def _round(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w = size[0]
    return (sphere((0.0, 0.0, w / 2), w, color),)


def _ball(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w = size[0]
    stripe = cylinder(w * 0.44, w * 1.004, w * 0.12, toward(color, _WHITE, 0.8), solid=False)
    return (sphere((0.0, 0.0, w / 2), w, color), stripe)


def _banana(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    ends = tuple(box((s * w * 0.33, d * 0.12, h / 2), (w * 0.34, d * 0.7, h), color) for s in (-1, 1))
    tip = box((w * 0.49, d * 0.12, h / 2), (w * 0.03, d * 0.4, h * 0.5), (0.25, 0.18, 0.05), solid=False)
    return (box((0.0, -d * 0.12, h / 2), (w * 0.4, d * 0.75, h), color), *ends, tip)


def _book(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    pages = box((0.004, -0.003, h / 2), (w, d, h * 0.7), (0.93, 0.91, 0.84), solid=False)
    return (box((0.0, 0.0, h / 2), size, color), pages)


def _crate(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    tape = box((0.0, 0.0, h / 2), (w * 0.16, d + 0.002, h + 0.002), toward(color, _WHITE, 0.5), solid=False)
    return (box((0.0, 0.0, h / 2), size, color), tape)


def _toy(size: Size3, color: Rgb) -> tuple[Part, ...]:
    """A block with two bricks in other colors on it, flush with its height."""
    w, d, h = size
    left = box((-w / 4, 0.0, h * 0.8), (w / 2, d, h * 0.4), (0.93, 0.80, 0.12))
    right = box((w / 4, 0.0, h * 0.8), (w / 2, d, h * 0.4), (0.10, 0.30, 0.78))
    return (box((0.0, 0.0, h * 0.3), (w, d, h * 0.6), color), left, right)


def _teddy(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    head = sphere((0.0, 0.0, h * 0.78), h * 0.42, color)
    ears = tuple(
        sphere((s * h * 0.17, 0.0, h * 0.95), h * 0.13, toward(color, _BLACK, 0.3), solid=False) for s in (-1, 1)
    )
    nose = sphere((0.0, -h * 0.2, h * 0.74), h * 0.1, toward(color, _WHITE, 0.5), solid=False)
    return (box((0.0, 0.0, h * 0.3), (w, d, h * 0.6), color), head, *ears, nose)


def _remote(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    keys = box((-w * 0.1, 0.0, h), (w * 0.55, d * 0.6, 0.003), toward(color, _WHITE, 0.5), solid=False)
    power = box((w * 0.38, 0.0, h), (0.012, 0.012, 0.004), (0.85, 0.1, 0.1), solid=False)
    return (box((0.0, 0.0, h / 2), size, color), keys, power)


def _phone(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    screen = box((0.0, 0.0, h), (w * 0.9, d * 0.88, 0.002), (0.20, 0.35, 0.55), solid=False)
    return (box((0.0, 0.0, h / 2), size, color), screen)


def _scissors(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    handles = tuple(box((-w * 0.3, s * d * 0.3, h / 2), (w * 0.4, d * 0.38, h), color) for s in (-1, 1))
    return (box((w * 0.2, 0.0, h / 2), (w * 0.6, d * 0.35, h), _METAL), *handles)


def _keys(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    tag = box((w * 0.25, 0.0, h / 2), (w * 0.5, d, h), (0.85, 0.65, 0.10))
    return (box((-w * 0.25, 0.0, h / 2), (w * 0.5, d * 0.5, h), color), tag)


def _clock(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    face = box((0.0, -d / 2, h / 2), (w * 0.8, 0.004, h * 0.8), (0.95, 0.95, 0.92), solid=False)
    hand = box((0.0, -d / 2 - 0.003, h * 0.62), (0.008, 0.003, h * 0.28), _BLACK, solid=False)
    return (box((0.0, 0.0, h / 2), size, color), face, hand)


SMALL_BUILDERS: Mapping[str, Builder] = MappingProxyType(
    {
        "bottle": _bottle, "can": _can, "cup": _cup, "mug": _mug, "glass": _cup, "bowl": _bowl, "plate": _plate,
        "vase": _vase, "apple": _apple, "orange": _round, "banana": _banana, "ball": _ball, "book": _book,
        "box": _crate, "toy": _toy, "teddy": _teddy, "remote": _remote, "phone": _phone, "scissors": _scissors,
        "keys": _keys, "clock": _clock,
    }
)  # fmt: skip
"""How things are built, by category."""
