"""An occupancy grid of one room: which cells the robot's center may enter, and how far the nearest obstacle is."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from majordomo.skills.geometry import Box2, Point2, Points

CELL_M = 0.04
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
    """A grid being drawn: mark what is blocked, then ``finish``."""

    origin: Point2
    blocked: NDArray[np.bool_]

    @classmethod
    def covering(cls, low: Point2, high: Point2) -> Canvas:
        """An empty canvas over a rectangle."""
        shape = tuple(max(ceil((b - a) / CELL_M) + 1, 2) for a, b in zip(low, high, strict=True))
        return cls(origin=low, blocked=np.zeros(shape, dtype=bool))

    def centers(self) -> Points:
        """Centers of all cells, (nx * ny, 2), row by row."""
        nx, ny = self.blocked.shape
        x, y = np.meshgrid(np.arange(nx), np.arange(ny), indexing="ij")
        return np.asarray(np.stack([x.ravel(), y.ravel()], axis=1) * CELL_M + self.origin, dtype=np.float64)

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
        """Block the cells that ``points`` (N, 2) lie in; points beyond the canvas are dropped."""
        cells = np.rint((points - self.origin) / CELL_M).astype(np.int64)
        cells = cells[((cells >= 0) & (cells < self.blocked.shape)).all(axis=1)]
        self.blocked[cells[:, 0], cells[:, 1]] = True

    def finish(self) -> Grid:
        """The grid."""
        if not self.blocked.any():
            return Grid(origin=self.origin, clearance_m=np.full(self.blocked.shape, 10.0))
        clearance = distance_transform_edt(~self.blocked) * CELL_M
        return Grid(origin=self.origin, clearance_m=np.asarray(clearance, dtype=np.float64))
