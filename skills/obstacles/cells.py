"""Square cells of the floor as sorted integers, so that a memory of them is an array."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3
from skills.geometry import Points

CELL_M = 0.04
"""Length of a cell's side: the resolution of memory and map alike."""
_OFFSET = 1 << 20
_COLUMN = 1 << 21

Keys = NDArray[np.int64]


def packed(cells: NDArray[np.int64]) -> Keys:
    """One integer for each cell (N, 2), sorted by x then y."""
    cells = cells + _OFFSET
    return np.asarray((cells[:, 0] << 21) | cells[:, 1])


def keys_of(points: Points) -> Keys:
    """The cells that ``points`` (N, 2) lie in."""
    return packed(np.floor(points / CELL_M).astype(np.int64))


def neighbor_keys(keys: Keys) -> Keys:
    """(8, N) the cells around each of ``keys`` (N,)."""
    steps = [_COLUMN * di + dj for di in (-1, 0, 1) for dj in (-1, 0, 1) if di or dj]
    return np.asarray(keys + np.array(steps, dtype=np.int64)[:, None])


def found(keys: Keys, among: Keys) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Where ``keys`` belong in sorted others, and which are there already."""
    place = np.searchsorted(among, keys)
    known = place < len(among)
    known[known] = among[place[known]] == keys[known]
    return place, known


def moved(cells: NDArray[np.void], T_new_old: SE3 | None) -> NDArray[np.void]:
    """Records of cells, with ``key`` and ``at_m`` among their fields, in another frame, one for each cell there; none
    when the frames are not connected.
    """
    if T_new_old is None or not len(cells):
        return cells[:0]
    at_m = T_new_old.apply(np.column_stack([cells["at_m"], np.zeros(len(cells))]))[:, :2]
    keys, first = np.unique(keys_of(at_m), return_index=True)
    there = cells[first]
    there["key"], there["at_m"] = keys, at_m[first]
    return np.asarray(there)
