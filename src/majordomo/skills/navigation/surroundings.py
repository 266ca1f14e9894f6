"""A short memory of raw obstacle points around the robot, kept in the frame the robot is placed in.

A ring LiDAR on a mast does not see low things near the robot, so low points stay for a while; tall things are always in
view, so their points (a person walking by) fade at once.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from majordomo.scene_graph.se3 import SE3
from majordomo.skills.geometry import Point2, Points

CELL_M = 0.04
PATCH_CELLS = 3
_OFFSET = 1 << 20


@dataclass(frozen=True, kw_only=True)
class SurroundingsConfig:
    """Heights of what can be hit, how far to look, and how long to remember."""

    min_height_m: float = 0.04
    max_height_m: float = 1.80
    tall_m: float = 0.95
    max_range_m: float = 6.0
    body_radius_m: float = 0.20
    fade_low_s: float = 20.0
    fade_tall_s: float = 0.7
    min_hits: int = 2


@dataclass(kw_only=True)
class Surroundings:
    """Cells of ``CELL_M`` in which something was hit lately.

    ``arm_reach_m``: how far the arm reaches ahead; points on it are not obstacles.
    """

    config: SurroundingsConfig = field(default_factory=SurroundingsConfig)
    frame: str = ""
    _keys: NDArray[np.int64] = field(default_factory=lambda: np.zeros(0, dtype=np.int64))
    _seen_s: NDArray[np.float64] = field(default_factory=lambda: np.zeros(0))
    _tall: NDArray[np.bool_] = field(default_factory=lambda: np.zeros(0, dtype=bool))
    _last_scan: object = None

    def points(self) -> Points:
        """Centers of occupied cells, (N, 2), in ``frame``."""
        return _centers(self._keys)

    def points_near(self, point: Point2, reach_m: float) -> Points:
        """Those within ``reach_m`` of ``point``."""
        points = self.points()
        return np.asarray(points[np.hypot(*(points - point).T) < reach_m])

    def observe(self, points_base: Points, T_frame_base: SE3, stamp_s: float, arm_reach_m: float = 0.0) -> None:
        """Take in one scan, (N, 3) in the base frame. The same array twice counts once."""
        if points_base is not self._last_scan:
            self._last_scan = points_base
            cells, tall = self._cells(points_base, T_frame_base, arm_reach_m)
            self._merge(cells, np.full(len(cells), stamp_s), tall)
        fade_s = np.where(self._tall, self.config.fade_tall_s, self.config.fade_low_s)
        self._keep(stamp_s - self._seen_s <= fade_s)

    def move_to(self, frame: str, T_new_old: SE3 | None) -> None:
        """Carry the memory into another frame, or drop it when the frames are not connected."""
        old, seen_s, tall = self.points(), self._seen_s, self._tall
        self.frame = frame
        self._keep(np.zeros(len(self._keys), dtype=bool))
        if T_new_old is not None and len(old):
            moved = T_new_old.apply(np.column_stack([old, np.zeros(len(old))]))[:, :2]
            keys, first = np.unique(_keys(moved), return_index=True)
            self._merge(keys, seen_s[first], tall[first])

    def forget(self) -> None:
        """Drop everything, for instance after the robot was carried away."""
        self._keep(np.zeros(len(self._keys), dtype=bool))

    def _cells(
        self, points: Points, T_frame_base: SE3, arm_reach_m: float
    ) -> tuple[NDArray[np.int64], NDArray[np.bool_]]:
        config = self.config
        x, y, z = points.T
        range_m = np.hypot(x, y)
        keep = (z > config.min_height_m) & (z < config.max_height_m)
        keep &= (range_m > config.body_radius_m) & (range_m < config.max_range_m)
        if arm_reach_m > 0:
            keep &= ~((x > 0) & (x < arm_reach_m) & (np.abs(y) < 0.12))
        points = points[keep]
        if not len(points):
            return np.zeros(0, dtype=np.int64), np.zeros(0, dtype=bool)
        placed = points @ T_frame_base.rotation()[:2].T + T_frame_base.translation_m[:2]
        cells = np.floor(placed / CELL_M).astype(np.int64)
        corner = cells.min(axis=0)
        columns, rows = cells.max(axis=0) - corner + 1
        index = (cells[:, 0] - corner[0]) * rows + cells[:, 1] - corner[1]
        counts = np.bincount(index, minlength=columns * rows)
        hit = np.flatnonzero(counts)
        cells = np.stack([hit // rows, hit % rows], axis=1) + corner
        tall = np.bincount(index[points[:, 2] > config.tall_m], minlength=columns * rows)[hit] > 0
        keys = _packed(cells)
        solid = (counts[hit] >= config.min_hits) | _found(keys, self._keys)[1]
        return keys[solid], _beside_tall(cells[solid], tall[solid])

    def _merge(self, keys: NDArray[np.int64], seen_s: Points, tall: NDArray[np.bool_]) -> None:
        """Take in what was seen of ``keys``, sorted and each once."""
        place, known = _found(keys, self._keys)
        self._seen_s[place[known]], self._tall[place[known]] = seen_s[known], tall[known]
        at = place[~known]
        self._keys = np.insert(self._keys, at, keys[~known])
        self._seen_s = np.insert(self._seen_s, at, seen_s[~known])
        self._tall = np.insert(self._tall, at, tall[~known])

    def _keep(self, mask: NDArray[np.bool_]) -> None:
        if not mask.all():
            self._keys, self._seen_s, self._tall = self._keys[mask], self._seen_s[mask], self._tall[mask]


def _beside_tall(cells: NDArray[np.int64], tall: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Which of (N, 2) cells are part of something tall: those that are, and those in or next to a patch that has one.

    A person's feet are seen beside the torso; they must fade with it, or every step would leave an obstacle behind.
    """
    if not tall.any():
        return tall
    patches = cells // PATCH_CELLS
    patches -= patches.min(axis=0) - 1
    high = np.zeros(patches.max(axis=0) + 2, dtype=bool)
    high[*patches[tall].T] = True
    rows = high.copy()
    rows[1:] |= high[:-1]
    rows[:-1] |= high[1:]
    around = rows.copy()
    around[:, 1:] |= rows[:, :-1]
    around[:, :-1] |= rows[:, 1:]
    return np.asarray(tall | around[*patches.T])


def _found(keys: NDArray[np.int64], among: NDArray[np.int64]) -> tuple[NDArray[np.intp], NDArray[np.bool_]]:
    """Where ``keys`` belong in sorted others, and which are there already."""
    place = np.searchsorted(among, keys)
    known = place < len(among)
    known[known] = among[place[known]] == keys[known]
    return place, known


def _centers(keys: NDArray[np.int64]) -> Points:
    cells = np.stack([keys >> 21, keys & ((1 << 21) - 1)], axis=1) - _OFFSET
    return np.asarray((cells + 0.5) * CELL_M)


def _keys(points: Points) -> NDArray[np.int64]:
    return _packed(np.floor(points / CELL_M).astype(np.int64))


def _packed(cells: NDArray[np.int64]) -> NDArray[np.int64]:
    """One integer for each cell (N, 2), sorted by x then y."""
    cells = cells + _OFFSET
    return np.asarray((cells[:, 0] << 21) | cells[:, 1])
