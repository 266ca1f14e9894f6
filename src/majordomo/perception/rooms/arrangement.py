"""Arrangement of wall lines into cells, and which cells are the room (extends Concepts beyond rectangles).

All wall lines of a rectilinear room, taken across the whole plane, cut it into cells. A cell belongs to the room when
rays have passed through most of it, and when it can be reached from where the robot stands without passing a stretch
of line that more rays end on than pass: the lintel above an open door is one, which keeps the next room out.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from majordomo.perception.localization.planar import Pose2
from majordomo.perception.rooms.facets import Facets
from majordomo.perception.rooms.views import View

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_EDGE_STEP_M = 0.1
_RUN = 4  # steps
_GRAZING = 0.12  # cosine of incidence below which a ray says nothing about passing a line


@dataclass(frozen=True, kw_only=True)
class ArrangementSettings:
    """Lengths in meters.

    ``gate_m``: returns this near to a line support it. ``shortest_wall_m``: least supported length of a line.
    ``separation_m``: nearer parallel lines are one. ``blocked``: share of rays ending on a stretch that make it a wall.
    ``free``: share of a cell that must have been seen through. ``views``: how many of the views are asked.
    """

    gate_m: float = 0.06
    shortest_wall_m: float = 0.2
    separation_m: float = 0.09
    blocked: float = 0.5
    free: float = 0.5
    free_margin_m: float = 0.06
    views: int = 24

    def for_noise(self, noise_m: float) -> ArrangementSettings:
        """Gates wide enough for ranges with this standard deviation."""
        gate_m = max(self.gate_m, 3.0 * noise_m)
        return replace(
            self,
            gate_m=gate_m,
            separation_m=max(self.separation_m, 1.5 * gate_m),
            free_margin_m=max(self.free_margin_m, gate_m),
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Arrangement:
    """Cells between the lines ``xs`` and ``ys`` (sorted, meters, axis-aligned frame).

    ``inside``: (len(xs) - 1, len(ys) - 1), the cells of the room.
    """

    xs: Array
    ys: Array
    inside: Mask


def wall_offsets(facets: Facets, settings: ArrangementSettings) -> list[float]:
    """Sorted offsets of the lines on which returns lie, each at the mean of its returns."""
    if len(facets.offset_m) == 0:
        return []
    bin_m = settings.gate_m / 4.0
    covered = _covered_length(facets, bin_m)
    lowest = float(facets.offset_m.min())
    offsets: list[float] = []
    for index in np.argsort(-covered, kind="stable"):
        if covered[index] < settings.shortest_wall_m:
            break
        offset = lowest + (index + 0.5) * bin_m
        for gate_m in (settings.gate_m, 0.75 * settings.gate_m):
            near = facets.offset_m[np.abs(facets.offset_m - offset) < gate_m]
            offset = float(near.mean()) if len(near) else offset
        if all(abs(offset - other) > settings.separation_m for other in offsets):
            offsets.append(offset)
    return sorted(offsets)


def _covered_length(facets: Facets, bin_m: float, *, station_bin_m: float = 0.05) -> Array:
    """Per offset bin, the length along the line with a return within two bins of it."""
    row = ((facets.offset_m - facets.offset_m.min()) / bin_m).astype(np.int64)
    column = ((facets.station_m - facets.station_m.min()) / station_bin_m).astype(np.int64)
    hits = np.zeros((int(row.max()) + 5, int(column.max()) + 1), dtype=np.int32)
    np.add.at(hits, (row + 2, column), 1)
    padded = np.concatenate([np.zeros((1, hits.shape[1]), dtype=np.int64), np.cumsum(hits, axis=0)])
    window = padded[5:] - padded[:-5]
    return np.asarray((window > 0).sum(axis=1) * station_bin_m, dtype=np.float64)


def arrange(
    views: Sequence[View],
    x_facing: Facets,
    y_facing: Facets,
    direction_rad: float,
    settings: ArrangementSettings | None = None,
) -> Arrangement | None:
    """The arrangement of all wall lines, with the cells of the room that the last view was taken in.

    ``None`` when fewer than two lines across each axis were seen.
    """
    settings = settings or ArrangementSettings()
    xs = np.array(wall_offsets(x_facing, settings))
    ys = np.array(wall_offsets(y_facing, settings))
    if len(xs) < 2 or len(ys) < 2:
        return None
    turn = Pose2(0.0, 0.0, direction_rad)
    turned = [view.moved(turn.inverse() @ view.T_frame_base) for view in _spread(views, settings.views)]
    xs, ys = (
        _with_edges(xs, _opening_edges(turned, ys, xs, y_facing, 1, settings), settings),
        _with_edges(ys, _opening_edges(turned, xs, ys, x_facing, 0, settings), settings),
    )
    free = _free_share(turned, xs, ys, settings.free_margin_m)
    blocked_x = _ending_share(turned, xs, ys, 0, settings.gate_m) > settings.blocked
    blocked_y = settings.blocked < _ending_share(turned, ys, xs, 1, settings.gate_m).T
    robot = turned[-1].T_frame_base.position_m
    return Arrangement(xs=xs, ys=ys, inside=_flood(free > settings.free, blocked_x, blocked_y, _cell(xs, ys, robot)))


def _pairs(values: Array) -> list[tuple[float, float]]:
    return list(pairwise(values.tolist()))


def _spread(views: Sequence[View], count: int) -> list[View]:
    """At most ``count`` of the views, evenly spread, the last one among them."""
    index = np.unique(np.linspace(0, len(views) - 1, min(count, len(views))).astype(np.int64))
    return [views[int(i)] for i in index]


def _free_share(views: Sequence[View], xs: Array, ys: Array, margin_m: float) -> Array:
    """Share of each cell that any view saw through, on a grid of sample points per cell."""
    x_samples, y_samples = _samples(xs), _samples(ys)
    x_all = np.concatenate(x_samples)
    y_all = np.concatenate(y_samples)
    points = np.stack(np.meshgrid(x_all, y_all, indexing="ij"), axis=-1).reshape(-1, 2)
    seen = np.zeros(len(points), dtype=bool)
    for view in views:
        seen |= view.beyond(points)[0] > margin_m
    share = seen.reshape(len(x_all), len(y_all)).astype(np.float64)
    x_starts = np.cumsum([0] + [len(part) for part in x_samples[:-1]])
    y_starts = np.cumsum([0] + [len(part) for part in y_samples[:-1]])
    sums = np.add.reduceat(np.add.reduceat(share, x_starts, axis=0), y_starts, axis=1)
    counts = np.outer([len(part) for part in x_samples], [len(part) for part in y_samples])
    return np.asarray(sums / counts)


def _ending_share(views: Sequence[View], lines: Array, crossing: Array, axis: int, gate_m: float) -> Array:
    """(len(lines), len(crossing) - 1) share of rays that end on a stretch of a line among those that end on or pass it.

    ``lines`` are offsets along ``axis``; ``crossing`` cuts them into stretches.
    """
    stations = _samples(crossing)
    ending, passing = _endings(views, lines, np.concatenate(stations), axis, gate_m)
    starts = np.cumsum([0] + [len(part) for part in stations[:-1]])
    ended = np.add.reduceat(ending, starts, axis=1)
    passed = np.add.reduceat(passing, starts, axis=1)
    return np.asarray(ended / np.maximum(ended + passed, 1.0))


def _endings(views: Sequence[View], lines: Array, stations: Array, axis: int, gate_m: float) -> tuple[Array, Array]:
    """(lines, stations) how many views see a ray end on a line at a station, and how many see one pass it."""
    points = np.empty((len(lines), len(stations), 2))
    points[..., axis] = lines[:, None]
    points[..., 1 - axis] = stations[None, :]
    ending, passing = np.zeros(points.shape[:2]), np.zeros(points.shape[:2])
    for view in views:
        beyond, direction, distance = view.beyond(points.reshape(-1, 2))
        incidence = np.abs(direction[:, axis])
        tells = (incidence > _GRAZING) & (distance > view.scan.blind_m + gate_m)
        clearance = np.where(tells, beyond * incidence, np.nan).reshape(ending.shape)
        with np.errstate(invalid="ignore"):
            ending += np.abs(clearance) <= gate_m
            passing += clearance > gate_m
    return ending, passing


def _opening_edges(
    views: Sequence[View], lines: Array, crossing: Array, facets: Facets, axis: int, settings: ArrangementSettings
) -> list[float]:
    """Stations at which a wall on one of the ``lines`` ends and a wide opening begins.

    Another wall goes off there, though nobody may have stood where its face can be seen: the corner of a nook.
    ``facets`` lie along the lines.
    """
    stations = np.arange(crossing[0] + _EDGE_STEP_M / 2.0, crossing[-1], _EDGE_STEP_M)
    ending, passing = _endings(views, lines, stations, axis, settings.gate_m)
    edges: list[float] = []
    for k, line in enumerate(lines):
        told = ending[k] + passing[k] > 0.0
        wall = told & (ending[k] > settings.blocked * (ending[k] + passing[k]))
        on_line = facets.near(float(line), 1.5 * settings.gate_m).station_m
        for edge, wall_first in _changes(wall, told & ~wall):
            middle = stations[0] + (edge - 0.5) * _EDGE_STEP_M
            near = on_line[np.abs(on_line - middle) < 1.5 * _EDGE_STEP_M]
            if len(near):
                edges.append(float(near.max() if wall_first else near.min()))
    return edges


def _changes(wall: Mask, opened: Mask) -> list[tuple[int, bool]]:
    """Indices at which a long enough run of wall meets a long enough run of opening, and whether wall came first."""
    found: list[tuple[int, bool]] = []
    for index in range(_RUN, len(wall) - _RUN + 1):
        before, after = slice(index - _RUN, index), slice(index, index + _RUN)
        if wall[before].all() and opened[after].all():
            found.append((index, True))
        elif opened[before].all() and wall[after].all():
            found.append((index, False))
    return found


def _with_edges(offsets: Array, edges: Sequence[float], settings: ArrangementSettings) -> Array:
    """Wall lines, and the edges that are not near one."""
    merged = offsets.tolist()
    for edge in sorted(edges):
        if all(abs(edge - other) > 2.0 * settings.separation_m for other in merged):
            merged.append(edge)
    return np.array(sorted(merged))


def _samples(lines: Array) -> list[Array]:
    """Sample coordinates within each interval, denser in narrow ones, clear of its ends."""
    parts: list[Array] = []
    for start, end in _pairs(lines):
        count = int(np.clip(np.ceil((end - start) / 0.25), 3, 16))
        margin = min(0.08, 0.3 * (end - start))
        parts.append(np.linspace(start + margin, end - margin, count))
    return parts


def _cell(xs: Array, ys: Array, point: Array) -> tuple[int, int]:
    column = int(np.clip(np.searchsorted(xs, point[0]) - 1, 0, len(xs) - 2))
    row = int(np.clip(np.searchsorted(ys, point[1]) - 1, 0, len(ys) - 2))
    return column, row


def _flood(free: Mask, blocked_x: Mask, blocked_y: Mask, start: tuple[int, int]) -> Mask:
    """Free cells reachable from ``start`` across stretches that are not walls."""
    inside = np.zeros_like(free)
    inside[start] = True
    queue = deque([start])
    columns, rows = free.shape
    while queue:
        i, j = queue.popleft()
        steps = (
            (i + 1, j, i + 1 < columns and not blocked_x[i + 1, j]),
            (i - 1, j, i > 0 and not blocked_x[i, j]),
            (i, j + 1, j + 1 < rows and not blocked_y[i, j + 1]),
            (i, j - 1, j > 0 and not blocked_y[i, j]),
        )
        for column, row, passable in steps:
            if passable and free[column, row] and not inside[column, row]:
                inside[column, row] = True
                queue.append((column, row))
    return inside
