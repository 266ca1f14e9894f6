"""Straight ways through a gap in a wall, beside or aslant to its axis where something stands in the way.

All in the crossing's axis frame: origin at the gap's center on the near face of the wall, x in the direction of travel,
y to the left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import chain
from math import cos, sin, tan

import numpy as np

from skills.geometry import Points
from skills.goto.settings import LaneSettings


@dataclass(frozen=True, kw_only=True)
class Lane:
    """Crosses the middle of the wall ``offset_m`` to the left of the gap's center, ``bearing_rad`` to the left of
    straight ahead.
    """

    offset_m: float = 0.0
    bearing_rad: float = 0.0
    settings: LaneSettings = field(default_factory=LaneSettings, repr=False)

    def y_m(self, x_m: float) -> float:
        """How far to the left it is at ``x_m``."""
        return self.offset_m + tan(self.bearing_rad) * (x_m - self.settings.wall_m / 2)

    def is_like(self, other: Lane) -> bool:
        """Whether a robot could not tell one from the other."""
        turned_rad = abs(self.bearing_rad - other.bearing_rad)
        return abs(self.offset_m - other.offset_m) < self.settings.same_m and turned_rad < self.settings.same_rad

    def is_clear(self, points: Points, half_m: float, from_m: float) -> bool:
        """Whether no point (N, 2) is within ``half_m`` of it, from x = ``from_m`` until the base has left the wall."""
        c, s = cos(self.bearing_rad), sin(self.bearing_rad)
        middle_m = self.settings.wall_m / 2
        along_m, aside_m = ((points - (middle_m, self.offset_m)) @ np.array([[c, -s], [s, c]])).T
        begin_m, end_m = (from_m - middle_m) / c, (middle_m + self.settings.beyond_m) / c
        return not ((along_m > begin_m) & (along_m < end_m) & (np.abs(aside_m) < half_m)).any()


def clear_lane(
    points: Points, *, half_m: float, width_m: float, base_x_m: float, settings: LaneSettings = LaneSettings()
) -> Lane | None:
    """The lane nearest to the axis of a gap of ``width_m`` in which a body of half the width ``half_m`` touches none of
    ``points`` (N, 2): from where the base is on; one aslant from where it lines up. ``None`` where there is none.
    """
    for lane in chain.from_iterable(_lanes(width_m / 2 - half_m, *steps, settings) for steps in settings.steps):
        from_m = -settings.front_m if lane.bearing_rad else min(base_x_m, -half_m)
        if lane.is_clear(points, half_m, from_m):
            return lane
    return None


def _lanes(room_m: float, step_m: float, step_rad: float, settings: LaneSettings) -> Iterator[Lane]:
    """Straight ones before those aslant, small offsets first; jambs are among the points, so these need no care."""
    steps = range(int(max(room_m, 0.0) / step_m) + 1)
    for bearing_rad in np.arange(0.0, settings.most_aslant_rad, step_rad).tolist():
        for turn in (1, -1) if bearing_rad else (1,):
            for offset_m in (sign * step * step_m for step in steps for sign in (1, -1)):
                yield Lane(offset_m=offset_m, bearing_rad=turn * bearing_rad, settings=settings)
