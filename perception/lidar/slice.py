"""The part of a LiDAR revolution that sees only walls: above furniture and doors (Concepts, algorithm 1, line 1).

Above a door the wall goes on to the ceiling, so a horizontal slice above 2 m sees the whole inner outline of the room,
and for each direction the nearest return in the slice is the room's wall: what lies farther was seen under a lintel.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.lidar.range_noise import range_noise_m
from perception.ports import LidarScan
from perception.sensing import ray_directions_base

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class SliceSettings:
    """Heights in meters above the floor."""

    bottom_m: float = 2.05
    """Above doors, which are 2 m high, and usual furniture."""
    highest_bottom_m: float = 2.3
    """Where the slice begins at most in high rooms. Chosen."""
    depth_m: float = 0.45
    """Wanted thickness of the slice: several rings of the LiDAR meet a wall in it. Chosen."""
    thinnest_m: float = 0.12
    """Least thickness, in low rooms. Chosen."""
    same_wall_m: float = 0.25
    """Returns of one direction that belong together. Chosen: a slanted wall's, and less than what is behind a door."""
    ceiling_margin_m: float = 0.10
    """Left out below the ceiling: five standard deviations of the usual range noise."""
    floor_m: float = 0.15
    """Returns below are of the floor. Chosen: range noise, and a base that tilts a little."""


@dataclass(frozen=True, kw_only=True, eq=False)
class OutlineScan:
    """A flat scan of walls: one point per direction that returned.

    ``points_base``: (N, 2), counter-clockwise by direction. ``origin_base``: (2,) where the rays start.
    ``ranges_m``: (azimuths,) horizontal distance for every direction of ``azimuths_rad`` (base frame), ``inf`` where
    nothing returned. ``blind_m``: nearer than this no ray rises into the slice, so that a lintel is not seen.
    ``surrounded``: share of directions in which anything but the floor returned, at any height.
    """

    stamp_s: float
    points_base: Array
    origin_base: Array
    azimuths_rad: Array
    ranges_m: Array
    blind_m: float
    surrounded: float = 1.0

    @property
    def coverage(self) -> float:
        """Share of directions in which a wall was seen."""
        return float(np.isfinite(self.ranges_m).mean())

    @property
    def noise_m(self) -> float:
        """Standard deviation of the ranges."""
        return range_noise_m(self.ranges_m[np.isfinite(self.ranges_m)])


class OutlineSlicer:
    """Cuts outline scans out of LiDAR revolutions; learns how high the walls are from what it has seen.

    Attributes:
        wall_top_m: highest wall return so far, ``None`` before the first scan.
        ceiling_m: height of the ceiling, ``None`` when none is seen.
    """

    def __init__(self, settings: SliceSettings = SliceSettings()) -> None:
        self._settings = settings
        self.wall_top_m: float | None = None
        self.ceiling_m: float | None = None
        self._newest: tuple[LidarScan, OutlineScan] | None = None

    def cut(self, scan: LidarScan) -> OutlineScan:
        """The nearest wall return above furniture and doors in each direction; the same scan is cut once."""
        if self._newest is None or self._newest[0] is not scan:
            self._newest = scan, self._cut(scan)
        return self._newest[1]

    def _cut(self, scan: LidarScan) -> OutlineScan:
        directions = ray_directions_base(scan)
        ranges = scan.ranges_m.astype(np.float64)
        origin = scan.T_base_lidar.translation_m
        with np.errstate(invalid="ignore"):
            heights = np.where(np.isfinite(ranges), origin[2] + ranges * directions[..., 2], -np.inf)
        self._learn_heights(heights)
        bottom_m, top_m = self._limits()
        horizontal = np.hypot(directions[..., 0], directions[..., 1])
        distance = np.where((heights > bottom_m) & (heights < top_m), ranges * horizontal, np.inf)
        nearest = self._nearest(distance)
        seen = np.isfinite(nearest)
        azimuths = np.arctan2(directions[0, :, 1], directions[0, :, 0])
        units = np.stack([np.cos(azimuths), np.sin(azimuths)], axis=1)
        return OutlineScan(
            stamp_s=scan.stamp_s,
            points_base=units[seen] * nearest[seen, None] + origin[:2],
            origin_base=origin[:2].copy(),
            azimuths_rad=azimuths,
            ranges_m=nearest,
            blind_m=_blind_m(bottom_m - float(origin[2]), float(scan.elevations_rad.max())),
            surrounded=float((heights > self._settings.floor_m).any(axis=0).mean()),
        )

    def _nearest(self, distance: Array) -> Array:
        """Per direction, the mean of the returns close behind the nearest one: the minimum alone would be biased."""
        nearest = distance.min(axis=0)
        together = distance <= nearest + self._settings.same_wall_m
        together &= np.isfinite(distance)
        count = together.sum(axis=0)
        total = np.where(together, distance, 0.0).sum(axis=0)
        return np.where(count > 0, total / np.maximum(count, 1), np.inf)

    def _learn_heights(self, heights: Array) -> None:
        returned = heights[np.isfinite(heights)]
        if returned.size == 0:
            return
        ceiling = _ceiling(heights)
        if ceiling is not None:
            self.ceiling_m = ceiling
        top = _quantile(returned, 0.999)
        self.wall_top_m = top if self.wall_top_m is None else max(self.wall_top_m, top)

    def _limits(self) -> tuple[float, float]:
        settings = self._settings
        top_m = np.inf if self.ceiling_m is None else self.ceiling_m - settings.ceiling_margin_m
        highest = min(self.wall_top_m if self.wall_top_m is not None else settings.bottom_m, top_m)
        bottom_m = float(np.clip(highest - settings.depth_m, settings.bottom_m, settings.highest_bottom_m))
        return min(bottom_m, highest - settings.thinnest_m), top_m


def _blind_m(above_m: float, highest_rad: float) -> float:
    """Distance at which the highest ray of a LiDAR has risen so far, meters; infinite where no ray rises."""
    if above_m <= 0.0:
        return 0.0
    return above_m / math.tan(highest_rad) if highest_rad > 0.0 else math.inf


def _ceiling(heights: Array, *, tolerance_m: float = 0.04, share: float = 0.2) -> float | None:
    """Height of a flat ceiling: two steep rings that both return often from one and the same height."""
    found: list[float] = []
    for ring in heights[-3:]:
        returned = ring[np.isfinite(ring)]
        if returned.size < 20:
            continue
        height = _quantile(returned, 0.9)
        if height > 2.1 and float((np.abs(returned - height) < tolerance_m).mean()) > share:
            found.append(height)
    found.sort()
    if len(found) >= 2 and found[-1] - found[-2] < tolerance_m:
        return (found[-1] + found[-2]) / 2.0
    return None


def _quantile(values: Array, share: float) -> float:
    """The value that ``share`` of (N,) values do not exceed; faster than interpolating between two."""
    place = int(share * (len(values) - 1))
    return float(np.partition(values, place)[place])
