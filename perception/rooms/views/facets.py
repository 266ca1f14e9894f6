"""Wall returns of all views in one frame, sorted by the axis that their surface faces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.runs import runs
from perception.rooms.views.view import View

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class FacetSettings:
    """Which surface a return is on."""

    half_window_m: float = 0.18
    """Of the returns whose direction tells the surface's. Chosen: nine standard deviations of the usual range noise."""
    axis_tolerance_rad: float = float(np.deg2rad(20.0))
    """How far from an axis a surface may face. Chosen: what noise does in so short a window."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Facets:
    """Returns from surfaces that face one axis.

    ``offset_m``: (N,) coordinate across the surface, ``station_m``: (N,) along it, ``reach_m``: (N,) how far along the
    surface each return speaks for (half the distance to its neighbors in the same scan).
    """

    offset_m: Array
    station_m: Array
    reach_m: Array

    def near(self, offset_m: float, gate_m: float) -> Facets:
        """Those within ``gate_m`` of a line across the axis."""
        kept = np.abs(self.offset_m - offset_m) < gate_m
        return Facets(offset_m=self.offset_m[kept], station_m=self.station_m[kept], reach_m=self.reach_m[kept])

    def between(self, start_m: float, end_m: float) -> Facets:
        """Those with a station in an interval."""
        kept = (self.station_m > start_m) & (self.station_m < end_m)
        return Facets(offset_m=self.offset_m[kept], station_m=self.station_m[kept], reach_m=self.reach_m[kept])

    def seen(self, start_m: float, end_m: float, *, bin_m: float = 0.05) -> NDArray[np.bool_]:
        """(bins,) which parts of the interval returns speak for, in bins of about ``bin_m``."""
        bins = max(1, round((end_m - start_m) / bin_m))
        scale = bins / (end_m - start_m)
        first = np.clip(np.floor((self.station_m - self.reach_m - start_m) * scale), 0, bins).astype(np.int64)
        last = np.clip(np.ceil((self.station_m + self.reach_m - start_m) * scale), 0, bins).astype(np.int64)
        change = np.zeros(bins + 1)
        np.add.at(change, first, 1.0)
        np.add.at(change, last, -1.0)
        return np.asarray(np.cumsum(change[:-1]) > 0)

    def coverage(self, start_m: float, end_m: float) -> float:
        """Share of the interval that returns speak for."""
        return float(self.seen(start_m, end_m).mean())


def longest_gap(seen: NDArray[np.bool_]) -> tuple[int, int]:
    """First bin and number of bins of the longest unseen run."""
    first, last = max(runs(~seen), key=lambda run: run[1] - run[0], default=(0, 0))
    return first, last - first


def sort_by_axis(
    views: Sequence[View], direction_rad: float, settings: FacetSettings = FacetSettings()
) -> tuple[Facets, Facets]:
    """Returns facing x and facing y of the frame turned by ``direction_rad``."""
    turn = Pose2(0.0, 0.0, -direction_rad)
    x_facing: list[Array] = []
    y_facing: list[Array] = []
    for view in views:
        points = turn.apply(view.points_frame())
        if len(points) < 5:
            continue
        angle, reach = _surface(points, settings.half_window_m)
        rows = np.column_stack([points, reach])
        x_facing.append(rows[np.abs(np.abs(angle) - np.pi / 2) < settings.axis_tolerance_rad])
        y_facing.append(rows[np.abs(angle) < settings.axis_tolerance_rad])
    across_x = np.concatenate(x_facing) if x_facing else np.empty((0, 3))
    across_y = np.concatenate(y_facing) if y_facing else np.empty((0, 3))
    return (
        Facets(offset_m=across_x[:, 0], station_m=across_x[:, 1], reach_m=across_x[:, 2]),
        Facets(offset_m=across_y[:, 1], station_m=across_y[:, 0], reach_m=across_y[:, 2]),
    )


def _surface(points: Array, half_window_m: float) -> tuple[Array, Array]:
    """Angle (N,) in (-pi/2, pi/2] of the surface through each return, and how far along it the return speaks.

    Principal direction of the returns within a window of about fixed length, through running sums over the scan.
    """
    count = len(points)
    following = np.linalg.norm(np.roll(points, -1, axis=0) - points, axis=1)
    spacing = np.clip(np.minimum(following, np.roll(following, 1)), 2e-3, 2.0)
    half = np.clip(np.ceil(half_window_m / spacing), 3, min(60, (count - 1) // 2)).astype(np.int64)
    x, y = points[:, 0] - points[:, 0].mean(), points[:, 1] - points[:, 1].mean()
    columns = np.column_stack([np.ones(count), x, y, x * x, x * y, y * y])
    wrapped = np.concatenate([columns, columns, columns])
    sums = np.concatenate([np.zeros((1, 6)), np.cumsum(wrapped, axis=0)])
    center = np.arange(count) + count
    n, sx, sy, sxx, sxy, syy = (sums[center + half + 1] - sums[center - half]).T
    cxx, cxy, cyy = sxx / n - (sx / n) ** 2, sxy / n - sx * sy / n**2, syy / n - (sy / n) ** 2
    angle = 0.5 * np.arctan2(2.0 * cxy, cxx - cyy)
    typical = np.median(np.column_stack([following, np.roll(following, 1), np.roll(following, -1)]), axis=1)
    return angle, np.clip(1.2 * typical, 0.03, 0.5)
