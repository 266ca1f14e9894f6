"""Colors by name: a few dozen usual ones, ``light`` or ``dark`` before any of them, or ``#rrggbb``."""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

Rgb = tuple[float, float, float]

COLORS: Mapping[str, Rgb] = MappingProxyType(
    {
        "red": (0.80, 0.10, 0.10),
        "green": (0.12, 0.55, 0.16),
        "blue": (0.10, 0.22, 0.78),
        "yellow": (0.93, 0.80, 0.12),
        "orange": (0.95, 0.50, 0.08),
        "purple": (0.48, 0.16, 0.62),
        "violet": (0.48, 0.16, 0.62),
        "pink": (0.94, 0.52, 0.68),
        "magenta": (0.80, 0.10, 0.60),
        "brown": (0.45, 0.27, 0.13),
        "tan": (0.76, 0.62, 0.42),
        "beige": (0.88, 0.82, 0.68),
        "cream": (0.95, 0.92, 0.80),
        "black": (0.08, 0.08, 0.08),
        "white": (0.94, 0.94, 0.94),
        "gray": (0.50, 0.50, 0.50),
        "grey": (0.50, 0.50, 0.50),
        "silver": (0.72, 0.73, 0.75),
        "gold": (0.80, 0.65, 0.18),
        "cyan": (0.15, 0.75, 0.80),
        "turquoise": (0.20, 0.75, 0.70),
        "teal": (0.10, 0.48, 0.50),
        "navy": (0.06, 0.09, 0.38),
        "maroon": (0.45, 0.06, 0.10),
        "olive": (0.48, 0.48, 0.12),
        "lime": (0.55, 0.85, 0.15),
        "clear": (0.80, 0.88, 0.92),
        "transparent": (0.80, 0.88, 0.92),
        "wood": (0.64, 0.45, 0.26),
    }
)


def is_color(name: str) -> bool:
    """Whether ``color_of`` knows it."""
    return _rgb(name) is not None


def color_problem(name: str | None) -> str | None:
    """What is wrong with a color, if anything; none at all is right."""
    if name is None or is_color(name):
        return None
    return f"unknown color '{name}'; use a name like 'light blue' or #rrggbb"


def color_of(name: str) -> Rgb:
    """Shares of red, green and blue; KeyError for an unknown name."""
    rgb = _rgb(name)
    if rgb is None:
        raise KeyError(name)
    return rgb


def toward(color: Rgb, other: Rgb, share: float) -> Rgb:
    """The mixture with ``share`` of ``other``."""
    r, g, b = (one + share * (two - one) for one, two in zip(color, other, strict=True))
    return r, g, b


def _rgb(name: str) -> Rgb | None:
    plain = re.sub(r"[\s_-]+", " ", name.strip().lower())
    if re.fullmatch(r"#[0-9a-f]{6}", plain):
        return int(plain[1:3], 16) / 255, int(plain[3:5], 16) / 255, int(plain[5:7], 16) / 255
    shade, _, base = plain.rpartition(" ")
    if base not in COLORS or shade not in ("", "light", "dark", "bright"):
        return None
    mixed = {"light": toward(COLORS[base], (1.0, 1.0, 1.0), 0.5), "dark": toward(COLORS[base], (0.0, 0.0, 0.0), 0.45)}
    return mixed.get(shade, COLORS[base])
