"""What each kind of thing is made of: at most sixteen boxes, upright cylinders and spheres.

Coordinates in meters in the thing's own frame: origin at the center of its bottom, z up, front toward -y.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Literal

from simulation.houses.colors import Rgb, toward

Size3 = tuple[float, float, float]
Builder = Callable[[Size3, Rgb], tuple["Part", ...]]

_BLACK: Rgb = (0.0, 0.0, 0.0)
_WHITE: Rgb = (1.0, 1.0, 1.0)
_METAL: Rgb = (0.55, 0.57, 0.60)


@dataclass(frozen=True, kw_only=True)
class Part:
    """One primitive. ``size_m``: full extent of its bounding box; a cylinder's and a sphere's diameter is the x extent.

    ``solid``: false for what is only seen, such as a label, and cannot be touched.
    """

    kind: Literal["box", "cylinder", "sphere"]
    center_m: Size3
    size_m: Size3
    color: Rgb
    solid: bool = True


def box(center_m: Size3, size_m: Size3, color: Rgb, *, solid: bool = True) -> Part:
    """A box with its sides along the axes."""
    return Part(kind="box", center_m=center_m, size_m=size_m, color=color, solid=solid)


def cylinder(z_m: float, diameter_m: float, height_m: float, color: Rgb, *, solid: bool = True) -> Part:
    """Upright, on the axis, its bottom at ``z_m``."""
    center = (0.0, 0.0, z_m + height_m / 2)
    return Part(kind="cylinder", center_m=center, size_m=(diameter_m, diameter_m, height_m), color=color, solid=solid)


def sphere(center_m: Size3, diameter_m: float, color: Rgb, *, solid: bool = True) -> Part:
    """A sphere about ``center_m``."""
    return Part(kind="sphere", center_m=center_m, size_m=(diameter_m,) * 3, color=color, solid=solid)


def plain_box(size: Size3, color: Rgb) -> tuple[Part, ...]:
    """A block of that size: whatever has no shape of its own."""
    return (box((0.0, 0.0, size[2] / 2), size, color),)


def _legs(size: Size3, top_m: float, thick_m: float, color: Rgb) -> tuple[Part, ...]:
    """Four square legs in the corners, from the floor to ``top_m``."""
    x, y = size[0] / 2 - thick_m / 2 - 0.02, size[1] / 2 - thick_m / 2 - 0.02
    return tuple(box((sx * x, sy * y, top_m / 2), (thick_m, thick_m, top_m), color) for sx in (-1, 1) for sy in (-1, 1))


def _table(size: Size3, color: Rgb) -> tuple[Part, ...]:
    top = 0.04
    plate = box((0.0, 0.0, size[2] - top / 2), (size[0], size[1], top), color)
    return (plate, *_legs(size, size[2] - top, 0.06, toward(color, _BLACK, 0.2)))


def _desk(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    dark = toward(color, _BLACK, 0.3)
    sides = tuple(box((s * (w / 2 - 0.03), 0.0, (h - 0.04) / 2), (0.04, d - 0.06, h - 0.04), dark) for s in (-1, 1))
    modesty = box((0.0, d / 2 - 0.05, h * 0.65), (w - 0.1, 0.02, h * 0.5), dark)
    return (box((0.0, 0.0, h - 0.02), (w, d, 0.04), color), *sides, modesty)


def _counter(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    body = box((0.0, 0.02, (h - 0.04) / 2), (w, d - 0.04, h - 0.04), toward(color, _WHITE, 0.5))
    return (body, box((0.0, 0.0, h - 0.02), (w, d, 0.04), toward(color, _BLACK, 0.3)))


def _chair(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    seat = h / 2
    back = box((0.0, d / 2 - 0.02, (h + seat) / 2), (w, 0.04, h - seat), color)
    return (box((0.0, 0.0, seat - 0.02), (w, d, 0.04), color), back, *_legs(size, seat - 0.04, 0.04, color))


def _sofa(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    seat, arm, back = h / 2, min(0.18, w / 8), min(0.22, d / 4)
    dark = toward(color, _BLACK, 0.25)
    arms = tuple(box((s * (w - arm) / 2, 0.0, h * 0.36), (arm, d, h * 0.72), dark) for s in (-1, 1))
    cushion = box((0.0, -back / 2, seat / 2), (w - 2 * arm, d - back, seat), color)
    return (cushion, box((0.0, (d - back) / 2, h / 2), (w - 2 * arm, back, h), dark), *arms)


def _bed(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    lying = h * 0.55
    wood: Rgb = (0.45, 0.30, 0.18)
    frame = box((0.0, -0.03, lying * 0.3), (w, d - 0.06, lying * 0.6), wood)
    mattress = box((0.0, -0.03, lying * 0.8), (w - 0.04, d - 0.06, lying * 0.4), color)
    pillow = box((0.0, d / 2 - 0.3, lying + 0.04), (w * 0.7, 0.35, 0.08), toward(color, _WHITE, 0.8))
    return (frame, mattress, pillow, box((0.0, d / 2 - 0.03, h / 2), (w, 0.06, h), wood))


def _shelf(size: Size3, color: Rgb) -> tuple[Part, ...]:
    """Open boards between two sides; the boards' tops are at the levels of its category."""
    w, d, h = size
    dark = toward(color, _BLACK, 0.2)
    sides = tuple(box((s * (w / 2 - 0.0125), 0.0, h / 2), (0.025, d, h), dark) for s in (-1, 1))
    back = box((0.0, d / 2 - 0.005, h / 2), (w - 0.05, 0.01, h), dark)
    boards = tuple(
        box((0.0, -0.005, h * k - 0.0125), (w - 0.05, d - 0.01, 0.025), color) for k in (0.25, 0.5, 0.75, 1.0)
    )
    return (*sides, back, *boards)


def _cabinet(size: Size3, color: Rgb) -> tuple[Part, ...]:
    _, d, h = size
    dark = toward(color, _BLACK, 0.35)
    knobs = tuple(box((s * 0.06, -d / 2 - 0.005, h * 0.6), (0.02, 0.01, 0.12), _METAL, solid=False) for s in (-1, 1))
    seam = box((0.0, -d / 2, h / 2), (0.012, 0.006, h * 0.94), dark, solid=False)
    return (box((0.0, 0.0, h / 2), size, color), seam, *knobs)


def _drawers(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    seams = tuple(box((0.0, -d / 2, h * k), (w * 0.9, 0.006, 0.012), _BLACK, solid=False) for k in (0.35, 0.7))
    return (box((0.0, 0.0, h / 2), size, color), *seams)


def _tv(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    foot = box((0.0, 0.0, 0.0125), (w * 0.35, d, 0.025), toward(color, _WHITE, 0.15))
    stem = box((0.0, 0.0, h * 0.08), (0.08, 0.04, h * 0.16), color)
    screen = box((0.0, -0.026, h * 0.57), (w * 0.95, 0.004, h * 0.78), (0.12, 0.16, 0.22), solid=False)
    return (foot, stem, box((0.0, 0.0, h * 0.57), (w, 0.05, h * 0.86), color), screen)


def _fridge(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    seam = box((0.0, -d / 2, h * 0.68), (w, 0.006, 0.015), _BLACK, solid=False)
    handles = tuple(
        box((-w * 0.4, -d / 2 - 0.01, h * k), (0.025, 0.02, h * 0.16), _METAL, solid=False) for k in (0.55, 0.8)
    )
    return (box((0.0, 0.0, h / 2), size, color), seam, *handles)


def _stove(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    window = box((0.0, -d / 2, h * 0.5), (w * 0.7, 0.006, h * 0.35), (0.1, 0.1, 0.12), solid=False)
    plate = box((0.0, 0.0, h - 0.004), (w - 0.02, d - 0.02, 0.01), (0.08, 0.08, 0.09), solid=False)
    rings = tuple(
        Part(
            kind="cylinder", center_m=(sx * w / 4, sy * d / 4, h), size_m=(0.17, 0.17, 0.006), color=_METAL, solid=False
        )
        for sx in (-1, 1)
        for sy in (-1, 1)
    )
    return (box((0.0, 0.0, h / 2), size, color), window, plate, *rings)


def _basin(size: Size3, color: Rgb, floor_m: float, rim_m: float) -> tuple[Part, ...]:
    """A block with a hollow down to ``floor_m``."""
    w, d, h = size
    gray = toward(color, _BLACK, 0.12)
    long = tuple(box((0.0, s * (d - rim_m) / 2, (h + floor_m) / 2), (w, rim_m, h - floor_m), color) for s in (-1, 1))
    short = tuple(
        box((s * (w - rim_m) / 2, 0.0, (h + floor_m) / 2), (rim_m, d - 2 * rim_m, h - floor_m), color) for s in (-1, 1)
    )
    return (box((0.0, 0.0, floor_m / 2), (w, d, floor_m), gray), *long, *short)


def _sink(size: Size3, color: Rgb) -> tuple[Part, ...]:
    _, d, h = size
    tap = box((0.0, d / 2 - 0.05, h + 0.1), (0.03, 0.03, 0.2), _METAL)
    spout = box((0.0, d / 2 - 0.12, h + 0.19), (0.025, 0.16, 0.02), _METAL)
    return (*_basin(size, color, h * 0.8, 0.09), tap, spout)


def _bathtub(size: Size3, color: Rgb) -> tuple[Part, ...]:
    return _basin(size, color, size[2] * 0.3, 0.07)


def _toilet(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    tank = box((0.0, d / 2 - d * 0.14, h * 0.5), (w, d * 0.28, h), color)
    bowl = box((0.0, -d * 0.14, h * 0.25), (w * 0.85, d * 0.7, h * 0.5), color)
    return (tank, bowl, box((0.0, -d * 0.14, h * 0.51), (w * 0.9, d * 0.7, 0.03), toward(color, _BLACK, 0.15)))


def _washer(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, d, h = size
    window = box((0.0, -d / 2, h * 0.5), (w * 0.5, 0.01, w * 0.5), (0.2, 0.25, 0.3), solid=False)
    return (box((0.0, 0.0, h / 2), size, color), window)


def _lamp(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, _, h = size
    shade = cylinder(h * 0.8, w, h * 0.2, color)
    return (cylinder(0.0, w * 0.8, 0.03, _METAL), cylinder(0.03, 0.04, h * 0.78, _METAL), shade)


def _plant(size: Size3, color: Rgb) -> tuple[Part, ...]:
    w, _, h = size
    pot = cylinder(0.0, w * 0.7, h * 0.35, (0.66, 0.32, 0.20))
    stem = cylinder(h * 0.35, 0.05, h * 0.2, (0.35, 0.25, 0.12))
    crown = sphere((0.0, 0.0, h - w * 0.5), w, color)
    return (pot, stem, crown, sphere((w * 0.12, w * 0.1, h - w * 0.75), w * 0.7, toward(color, _BLACK, 0.25)))


def _bin(size: Size3, color: Rgb) -> tuple[Part, ...]:
    return _basin(size, color, 0.05 * size[2], 0.015)


BUILDERS: Mapping[str, Builder] = MappingProxyType(
    {
        "table": _table, "desk": _desk, "counter": _counter, "chair": _chair, "stool": _table, "bench": _table,
        "sofa": _sofa, "bed": _bed, "shelf": _shelf, "cabinet": _cabinet, "wardrobe": _cabinet, "nightstand": _drawers,
        "tv_stand": _drawers, "tv": _tv, "fridge": _fridge, "stove": _stove, "sink": _sink, "washing_machine": _washer,
        "toilet": _toilet, "bathtub": _bathtub, "lamp": _lamp, "plant": _plant, "bin": _bin,
    }
)  # fmt: skip
"""How furniture is built, by category."""
