"""The floor of one room on a grid: what is taken, what must stay free, and whether a robot still gets everywhere."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt, label

from simulation.generation.plans import Plan
from simulation.generation.settings import FloorSettings
from simulation.generation.tiles import Outline, sides

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


class Floor:
    """Cells of a room, (columns, rows). Make one with ``floor_of``.

    Args:
        corner: (2,) low corner of the grid, meters of the plan.
        free: cells inside the walls.
        kept: cells that nothing may stand on.
        fronts: (N, 2) a point before each door.
        settings: size of the cells, and what must stay free.
    """

    def __init__(self, corner: Array, free: Mask, kept: Mask, fronts: Array, settings: FloorSettings) -> None:
        self._settings = settings
        self._corner, self._free, self._kept = corner, free, kept
        self._fronts = [self._cell(point) for point in fronts]
        self._whole = int(self._passable(free).sum())

    def take(self, x_m: float, y_m: float, yaw_rad: float, size_m: tuple[float, float]) -> bool:
        """Stand something on the floor, if there is room and the robot can still pass; whether it was done."""
        covered = self._covered(x_m, y_m, yaw_rad, size_m)
        area = round(size_m[0] * size_m[1] / self._settings.cell_m**2)
        if int((covered & self._free).sum()) < 0.93 * area or (covered & (self._kept | ~self._free)).any():
            return False
        left = self._free & ~covered
        if not self._open(left):
            return False
        self._free = left
        return True

    def free_spots(self) -> Array:
        """(N, 2) points in meters that are well away from everything and connected with the doors."""
        clear = distance_transform_edt(self._free) * self._settings.cell_m > self._settings.start_free_m
        regions, _ = label(self._passable(self._free))
        if self._fronts:
            clear &= regions == regions[self._fronts[0]]
        return np.asarray(self._corner + (np.argwhere(clear) + 0.5) * self._settings.cell_m)

    def _open(self, free: Mask) -> bool:
        """Whether all doors are joined by ways, and enough of the room is left to drive in."""
        regions, count = label(self._passable(free))
        if count == 0:
            return False
        at = {int(regions[cell]) for cell in self._fronts}
        if len(at) > 1 or 0 in at:
            return False
        region = at.pop() if at else int(np.bincount(regions[regions > 0]).argmax())
        return int((regions == region).sum()) >= self._settings.least_left * self._whole

    def _covered(self, x_m: float, y_m: float, yaw_rad: float, size_m: tuple[float, float]) -> Mask:
        index = np.indices(self._free.shape).astype(np.float64)
        x = self._corner[0] + (index[0] + 0.5) * self._settings.cell_m - x_m
        y = self._corner[1] + (index[1] + 0.5) * self._settings.cell_m - y_m
        c, s = math.cos(yaw_rad), math.sin(yaw_rad)
        return np.asarray((np.abs(c * x + s * y) < size_m[0] / 2) & (np.abs(c * y - s * x) < size_m[1] / 2))

    def _cell(self, point: Array) -> tuple[int, int]:
        column, row = np.clip(
            ((point - self._corner) / self._settings.cell_m).astype(int), 0, np.array(self._free.shape) - 1
        )
        return int(column), int(row)

    def _passable(self, free: Mask) -> Mask:
        return np.asarray(distance_transform_edt(free) * self._settings.cell_m > self._settings.robot_m)


def floor_of(plan: Plan, room: int, settings: FloorSettings = FloorSettings()) -> Floor:
    """The empty floor of a room."""
    cell_m = settings.cell_m
    outline = np.array(plan.outlines[room]) / 1000
    low, high = outline.min(axis=0), outline.max(axis=0)
    shape = np.ceil((high - low) / cell_m).astype(int) + 2
    corner = low - cell_m
    index = np.indices(tuple(shape)).astype(np.float64)
    x, y = corner[0] + (index[0] + 0.5) * cell_m, corner[1] + (index[1] + 0.5) * cell_m
    free, kept, fronts = _inside(plan.outlines[room], x, y), np.zeros(tuple(shape), dtype=bool), []
    for door in plan.doors:
        if room not in door.rooms:
            continue
        center = np.array(door.center) / 1000
        across = np.array([0.0, 1.0]) if door.along_x else np.array([1.0, 0.0])
        reach = settings.door_free_m + plan.wall_mm / 2000
        half = door.width / 2000 + settings.door_side_m
        dx, dy = np.abs(x - center[0]), np.abs(y - center[1])
        kept |= (dx < half) & (dy < reach) if door.along_x else (dy < half) & (dx < reach)
        step = across * (settings.in_front_m + plan.wall_mm / 2000)
        fronts.append(center + step if _holds(plan.outlines[room], center + step) else center - step)
    return Floor(corner, free, kept, np.array(fronts).reshape(-1, 2), settings)


def _inside(outline: Outline, x: Array, y: Array) -> Mask:
    """Even-odd rule; sides run along the axes."""
    inside = np.zeros(x.shape, dtype=bool)
    for (ax, ay), (bx, by) in sides(outline):
        if ax == bx:
            inside ^= (y > min(ay, by) / 1000) & (y < max(ay, by) / 1000) & (x < ax / 1000)
    return inside


def _holds(outline: Outline, point: Array) -> bool:
    return bool(_inside(outline, np.array([point[0]]), np.array([point[1]]))[0])
