"""Which cells of an arrangement are the room: those that are seen through, wide enough, and reached from the robot."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from perception.geometry.runs import runs

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


def cell_of(xs: Array, ys: Array, point: Array) -> tuple[int, int]:
    """Column and row of the cell that (2,) ``point`` is in, or of the nearest one."""
    column = int(np.clip(np.searchsorted(xs, point[0]) - 1, 0, len(xs) - 2))
    row = int(np.clip(np.searchsorted(ys, point[1]) - 1, 0, len(ys) - 2))
    return column, row


def thin(xs: Array, ys: Array, thin_m: float) -> Mask:
    """Cells that are thinner than ``thin_m`` along one of the axes."""
    return np.minimum(np.diff(xs)[:, None], np.diff(ys)[None, :]) < thin_m


def slits(seen: Mask, blocked: Mask, crossing: Array, narrowest_m: float) -> Mask:
    """(lines, stretches) stretches of lines across the first axis that let through, but are too narrow together."""
    columns = np.pad(seen, ((1, 1), (0, 0)))
    passable = ~blocked & columns[:-1] & columns[1:]
    return passable & ~_wide_enough(passable.T, crossing, narrowest_m).T


def without_crannies(inside: Mask, xs: Array, ys: Array, narrowest_m: float) -> Mask:
    """The room without cells in which it is narrower than ``narrowest_m`` along either axis."""
    kept = inside
    while True:
        wide = _wide_enough(kept, xs, narrowest_m) & _wide_enough(kept.T, ys, narrowest_m).T
        if not wide.any() or (wide == kept).all():
            return kept
        kept = wide


def _wide_enough(inside: Mask, offsets: Array, narrowest_m: float) -> Mask:
    """Cells whose run of inside cells along the first axis is at least ``narrowest_m`` long."""
    wide = np.zeros_like(inside)
    for row in range(inside.shape[1]):
        for first, last in runs(inside[:, row]):
            wide[first:last, row] = offsets[last] - offsets[first] >= narrowest_m
    return wide


def flood(free: Mask, blocked_x: Mask, blocked_y: Mask, start: tuple[int, int]) -> Mask:
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
