"""What rays did along the lines that walls lie on: where they ended, and where they went on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.rooms.views.facets import Facets
from perception.rooms.views.view import View

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class LineProfileSettings:
    """Where along lines rays are asked about, and what is made of their ends."""

    station_step_m: float = 0.1
    """Between stations. Chosen: a fifth of a narrow door."""
    end_m: float = 0.3
    """How far from where a wall seems to end its last return may be: three stations."""
    agree: float = 0.7
    """Share of the rays that must go the same way for a wall to face it. Chosen: clearly most."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LineProfile:
    """What rays did along parallel lines across ``axis``.

    ``lines``: (L,) offsets; ``stations``: (S,) along them. ``ending``, ``passing``: (L, S) how many views saw a ray end
    there, and pass. ``towards``: (L, S) sum of the signs of the ending rays' directions across the line.
    """

    axis: int
    lines: Array
    stations: Array
    ending: Array
    passing: Array
    towards: Array
    settings: LineProfileSettings = LineProfileSettings()

    @classmethod
    def of(
        cls,
        views: Sequence[View],
        lines: Array,
        stations: Array,
        axis: int,
        gate_m: float,
        crossing: Array | None = None,
        settings: LineProfileSettings = LineProfileSettings(),
    ) -> LineProfile:
        """Ask all views about all stations.

        ``crossing``: (C,) stations of lines across. A ray that ends rather on one of them met another wall just before
        this one: it tells nothing.
        """
        points = np.empty((len(lines), len(stations), 2))
        points[..., axis] = lines[:, None]
        points[..., 1 - axis] = stations[None, :]
        across = np.eye(2)[axis]
        ending, passing, towards = (np.zeros(points.shape[:2]) for _ in range(3))
        for view in views:
            clearance, incidence = view.clearance(points.reshape(-1, 2), across, gate_m)
            if crossing is not None:
                clearance[_on_crossing(view, points.reshape(-1, 2), axis, crossing, gate_m)] = np.nan
            clearance = clearance.reshape(ending.shape)
            with np.errstate(invalid="ignore"):
                ended = np.abs(clearance) <= gate_m
                passing += clearance > gate_m
            ending += ended
            towards += np.where(ended, np.sign(incidence).reshape(ending.shape), 0.0)
        return cls(
            axis=axis,
            lines=lines,
            stations=stations,
            ending=ending,
            passing=passing,
            towards=towards,
            settings=settings,
        )

    @property
    def told(self) -> Mask:
        """(L, S) where any ray says something."""
        return np.asarray(self.ending + self.passing > 0.0)

    def faces(self, line: int, stations: slice) -> float:
        """1 or -1: which way the rays go that end on a stretch of a line; 0 when they do not agree."""
        towards, ended = float(self.towards[line, stations].sum()), float(self.ending[line, stations].sum())
        return float(np.sign(towards)) if abs(towards) > self.settings.agree * ended else 0.0

    def wall(self, blocked: float) -> Mask:
        """(L, S) where more than ``blocked`` of the rays end."""
        return np.asarray(self.told & (self.ending > blocked * (self.ending + self.passing)))


def _on_crossing(view: View, points: Array, axis: int, crossing: Array, gate_m: float) -> Mask:
    """Which rays towards (N, 2) points end near these, but on a line across or nearer to it than to their own."""
    beyond, direction, _ = view.beyond(points)
    with np.errstate(invalid="ignore"):
        off_m = np.abs(beyond * direction[:, axis])
        station = points[:, 1 - axis] + beyond * direction[:, 1 - axis]
        across_m = np.abs(station[:, None] - crossing).min(axis=1)
        return np.asarray((off_m <= gate_m) & (across_m < np.maximum(off_m, gate_m / 2.0)))


def end_of_wall(on_line: Facets, about_m: float, *, wall_first: bool, end_m: float) -> float | None:
    """Station of the last return on a wall that ends at about ``about_m``, or the first on one that begins there.

    ``end_m``: how far from there it may be.
    """
    near = on_line.station_m[np.abs(on_line.station_m - about_m) < end_m]
    if len(near) == 0:
        return None
    return float(near.max() if wall_first else near.min())
