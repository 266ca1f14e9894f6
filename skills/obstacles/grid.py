"""An occupancy grid of one room: which cells the robot's center may enter, and how far the nearest obstacle is."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt
from scipy.spatial import cKDTree

from skills.geometry import Box2, Point2, Points
from skills.obstacles.cells import CELL_M

GROW_M = 0.71 * CELL_M
"""Obstacles grow by half a cell's diagonal before they are drawn, so that none slips between cell centers."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Grid:
    """Cell (i, j) has its center at ``origin + CELL_M * (i, j)``. ``clearance_m``: (nx, ny), distance to what is
    blocked.
    """

    origin: Point2
    clearance_m: NDArray[np.float64]

    @property
    def shape(self) -> tuple[int, int]:
        """Number of cells along x and y."""
        return self.clearance_m.shape[0], self.clearance_m.shape[1]

    def cells(self, points: Points) -> NDArray[np.int64]:
        """Cells (N, 2) that ``points`` (N, 2) lie in, clipped to the grid."""
        raw = np.rint((points - self.origin) / CELL_M).astype(np.int64)
        return np.clip(raw, 0, np.array(self.shape) - 1)

    def center(self, cell: tuple[int, int]) -> Point2:
        """Center of a cell."""
        return self.origin[0] + cell[0] * CELL_M, self.origin[1] + cell[1] * CELL_M

    def clearance_at(self, points: Points) -> Points:
        """Distance to the nearest blocked cell for ``points`` (N, 2); 0 outside the grid."""
        raw = np.rint((points - self.origin) / CELL_M).astype(np.int64)
        within = ((raw >= 0) & (raw < self.shape)).all(axis=1)
        i, j = np.clip(raw, 0, np.array(self.shape) - 1).T
        return np.where(within, self.clearance_m[i, j], 0.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class Canvas:
    """A grid being drawn: mark what is blocked, then ``finish``.

    ``at_m``: (nx, ny, 2), where in each cell it would be blocked: its center unless a point is known.
    """

    origin: Point2
    blocked: NDArray[np.bool_]
    at_m: NDArray[np.float64]

    @classmethod
    def covering(cls, low: Point2, high: Point2) -> Canvas:
        """An empty canvas over a rectangle."""
        shape = tuple(max(ceil((b - a) / CELL_M) + 1, 2) for a, b in zip(low, high, strict=True))
        return cls(origin=low, blocked=np.zeros(shape, dtype=bool), at_m=_centers(low, shape))

    def centers(self) -> Points:
        """Centers of all cells, (nx * ny, 2), row by row."""
        return _centers(self.origin, self.blocked.shape).reshape(-1, 2)

    def block(self, mask: NDArray[np.bool_]) -> None:
        """Block the cells where ``mask`` (nx * ny,) is true."""
        self.blocked.ravel()[mask] = True

    def block_box(self, box: Box2) -> None:
        """Block a rectangle."""
        self.block(box.grown(GROW_M).contains(self.centers()))

    def block_disc(self, center: Point2, radius_m: float) -> None:
        """Block a disc."""
        self.block(np.hypot(*(self.centers() - center).T) <= radius_m + GROW_M)

    def block_points(self, points: Points) -> None:
        """Block the cells that ``points`` (N, 2) lie in, right at these points; those beyond the canvas are dropped."""
        cells = np.rint((points - self.origin) / CELL_M).astype(np.int64)
        within = ((cells >= 0) & (cells < self.blocked.shape)).all(axis=1)
        i, j = cells[within].T
        self.blocked[i, j] = True
        self.at_m[i, j] = points[within]

    def finish(self, exact_m: float = 0.8) -> Grid:
        """The grid. Distances up to ``exact_m`` are exact to the points, not only to the cells that hold them; no robot
        is so wide, nor keeps so far from things, that more would matter.
        """
        if not self.blocked.any():
            return Grid(origin=self.origin, clearance_m=np.full(self.blocked.shape, 10.0))
        clearance_m = np.asarray(distance_transform_edt(~self.blocked) * CELL_M, dtype=np.float64)
        near = ~self.blocked & (clearance_m < exact_m)
        clearance_m[near], _ = cKDTree(self.at_m[self.blocked]).query(np.argwhere(near) * CELL_M + self.origin)
        return Grid(origin=self.origin, clearance_m=clearance_m)


def _centers(origin: Point2, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Centers of cells, (nx, ny, 2)."""
    return np.asarray(np.moveaxis(np.indices(shape), 0, -1) * CELL_M + origin, dtype=np.float64)
