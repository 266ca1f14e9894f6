"""What a thing covers of the surface that it stands on, in the axes of what carries it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot, pi

import numpy as np

from skills.geometry import Points


@dataclass(frozen=True, kw_only=True)
class Outline:
    """A disc that holds a thing however it is turned (``turn_rad`` is ``None``, both halves its radius), or the
    rectangle that it covers when its long side points along ``turn_rad``, a quarter turn or none.
    """

    half_m: tuple[float, float]
    turn_rad: float | None = None

    @property
    def radius_m(self) -> float:
        """Of the disc; of a rectangle, half of its longer side."""
        return max(self.half_m)

    def gap_to_box_m(self, points: Points, middle: Points, half_m: Points, yaw_rad: float) -> Points:
        """Air (N,) between a thing at ``points`` (N, 2) and a rectangle, of half extents (2,), that is turned; below 0
        where they overlap. Between two rectangles it is the widest strip that parts them along a side, which is the
        distance or less.
        """
        c, s = float(np.cos(yaw_rad)), float(np.sin(yaw_rad))
        apart = points - middle
        along = np.abs(apart @ np.array([[c, -s], [s, c]]))
        if self.turn_rad is None:
            return np.asarray(np.hypot(*np.maximum(along - half_m, 0.0).T) - self.half_m[0])
        mixed, own = np.array([[abs(c), abs(s)], [abs(s), abs(c)]]), np.array(self.half_m)
        strips = np.concatenate([np.abs(apart) - own - mixed @ half_m, along - half_m - mixed @ own], axis=1)
        return np.asarray(strips.max(axis=1))

    def gap_to_m(self, points: Points, at: Points, other: Outline) -> Points:
        """Air (N,) between a thing at ``points`` (N, 2) and another of which the outline's middle is ``at`` (2,)."""
        if self.turn_rad is None and other.turn_rad is None:
            return np.asarray(np.hypot(*(points - at).T) - self.half_m[0] - other.half_m[0])
        if other.turn_rad is None:
            beyond = np.maximum(np.abs(points - at) - np.array(self.half_m), 0.0)
            return np.asarray(np.hypot(*beyond.T) - other.half_m[0])
        return self.gap_to_box_m(points, at, np.array(other.half_m), 0.0)


def disc(size_m: tuple[float, float, float], round_m: float = 0.02) -> Outline:
    """The disc that holds a thing however it is turned; what is longer than wide by less than ``round_m`` is round."""
    narrow, wide = sorted(size_m[:2])
    radius_m = wide / 2 if wide - narrow < round_m else hypot(narrow, wide) / 2
    return Outline(half_m=(radius_m, radius_m))


def turned(size_m: tuple[float, float, float], finger_m: float, round_m: float = 0.02) -> Iterator[Outline]:
    """The rectangles of an oblong thing, lengthwise and crosswise, with the fingers that let go of it, which stand
    across its narrow side; none of a round one.
    """
    narrow, wide = sorted(size_m[:2])
    if wide - narrow < round_m:
        return
    along, across = wide / 2, narrow / 2 + finger_m
    yield Outline(half_m=(along, across), turn_rad=0.0)
    yield Outline(half_m=(across, along), turn_rad=pi / 2)
