"""Shortest ways on a grid: all of them from one start (Dijkstra), then the corners cut where there is a line of
sight.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import hypot

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from skills.geometry import Point2, Points
from skills.navigation.settings import RouteSettings
from skills.obstacles.cells import CELL_M
from skills.obstacles.grid import GROW_M, Grid

_STEPS = ((1, 0), (0, 1), (1, 1), (1, -1))


@dataclass(frozen=True, kw_only=True, eq=False)
class Routes:
    """The best way from ``start`` to every cell for a disc of ``radius_m``. ``cost_m``: (nx, ny), ``inf`` where none
    leads.
    """

    grid: Grid
    start: Point2
    radius_m: float
    cost_m: NDArray[np.float64]
    predecessors: NDArray[np.int32]
    comfort_m: float = RouteSettings.comfort_m

    def cost_at(self, points: Points) -> Points:
        """Cost (N,) of going to ``points`` (N, 2); ``inf`` for points the disc cannot stand on."""
        i, j = self.grid.cells(points).T
        standing = self.grid.clearance_at(points) >= needed_clearance_m(self.radius_m)
        return np.where(standing, self.cost_m[i, j], np.inf)

    def path_to(self, goal: Point2) -> tuple[Point2, ...]:
        """Way points from the start to ``goal``, shortened; empty when there is no way."""
        if not np.isfinite(self.cost_at(np.array([goal]))[0]):
            return ()
        cells = self._trace(goal)
        points = [self.start, *(self.grid.center(cell) for cell in cells[1:-1]), goal]
        return _shorten(self.grid, points, needed_clearance_m(self.radius_m), self.comfort_m)

    def _trace(self, goal: Point2) -> list[tuple[int, int]]:
        ny = self.grid.shape[1]
        (i, j), (i0, j0) = self.grid.cells(np.array([goal, self.start])).tolist()
        index, start = i * ny + j, i0 * ny + j0
        trace = [index]
        while index != start:
            index = int(self.predecessors[index])
            trace.append(index)
        return [divmod(k, ny) for k in reversed(trace)]


def needed_clearance_m(radius_m: float) -> float:
    """Clearance that a cell must have so that a disc centered in it touches nothing that was drawn."""
    return radius_m + GROW_M / 2


def find_routes(grid: Grid, start: Point2, radius_m: float, settings: RouteSettings = RouteSettings()) -> Routes:
    """All shortest ways from ``start``.

    Where the start itself is too close to something, cells around it with no less clearance may be used to get away.
    """
    needed = needed_clearance_m(radius_m)
    free = grid.clearance_m >= needed
    start_cell = grid.cells(np.array([start]))[0]
    lacking = np.clip((needed + settings.comfort_m - grid.clearance_m) / settings.comfort_m, 0.0, 1.0)
    multiplier = 1.0 + settings.comfort_weight * lacking**2
    free |= _escape(grid, start_cell, settings.escape_m)
    ny = grid.shape[1]
    costs, predecessors = dijkstra(
        _graph(free, multiplier), indices=int(start_cell[0] * ny + start_cell[1]), return_predecessors=True
    )
    return Routes(
        grid=grid,
        start=start,
        radius_m=radius_m,
        cost_m=costs.reshape(grid.shape),
        predecessors=predecessors,
        comfort_m=settings.comfort_m,
    )


def path_length_m(path: tuple[Point2, ...]) -> float:
    """Length of a chain of way points."""
    return sum(hypot(b[0] - a[0], b[1] - a[1]) for a, b in pairwise(path))


def sampled(a: Point2, b: Point2, step_m: float = CELL_M / 2) -> Points:
    """Points (N, 2) along a-b, both ends included."""
    count = max(int(hypot(b[0] - a[0], b[1] - a[1]) / step_m) + 1, 2)
    return np.linspace(a, b, count)


def _escape(grid: Grid, start_cell: NDArray[np.int64], around_m: float) -> NDArray[np.bool_]:
    """Cells near the start that are no closer to an obstacle than the start is; the start itself always."""
    i, j = np.indices(grid.shape)
    near = np.hypot(i - start_cell[0], j - start_cell[1]) * CELL_M <= around_m
    here = float(grid.clearance_m[start_cell[0], start_cell[1]])
    escape = near & (grid.clearance_m >= max(here, CELL_M))
    escape[start_cell[0], start_cell[1]] = True
    return np.asarray(escape)


def _graph(free: NDArray[np.bool_], multiplier: NDArray[np.float64]) -> csr_array:
    """Eight-connected cells; an edge costs its length times the mean multiplier of its ends."""
    nx, ny = free.shape
    index = np.arange(nx * ny, dtype=np.int32).reshape(nx, ny)
    rows, columns, weights = [], [], []
    for di, dj in _STEPS:
        here = (slice(0, nx - di), slice(max(0, -dj), ny - max(0, dj)))
        there = (slice(di, nx), slice(max(0, dj), ny + min(0, dj)))
        both = free[here] & free[there]
        if di and dj:  # no squeezing between two blocked corners
            both &= free[slice(0, nx - di), there[1]] & free[slice(di, nx), here[1]]
        rows.append(index[here][both])
        columns.append(index[there][both])
        weights.append(CELL_M * hypot(di, dj) * (multiplier[here][both] + multiplier[there][both]) / 2)
    shape = (nx * ny, nx * ny)
    a, b, w = (np.concatenate(parts) for parts in (rows, columns, weights))
    return csr_array((np.concatenate([w, w]), (np.concatenate([a, b]), np.concatenate([b, a]))), shape=shape)


def _shorten(grid: Grid, points: list[Point2], needed_m: float, comfort_m: float) -> tuple[Point2, ...]:
    """Greedy line of sight: skip way points while the straight line keeps the clearance that the way around had."""
    clearance = grid.clearance_at(np.array(points))
    kept = [points[0]]
    at = 0
    while at < len(points) - 1:
        reach = at + 1
        low, high = at + 1, len(points) - 1
        while low <= high:  # visibility is nearly monotone; a binary search finds a far visible point
            middle = (low + high) // 2
            floor_m = min(needed_m + comfort_m / 2, float(clearance[at : middle + 1].min()))
            if grid.clearance_at(sampled(points[at], points[middle])).min() >= floor_m - 1e-9:
                reach, low = middle, middle + 1
            else:
                high = middle - 1
        kept.append(points[reach])
        at = reach
    return tuple(kept)
