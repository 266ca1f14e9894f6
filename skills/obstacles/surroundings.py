"""A short memory of raw obstacle points around the robot, kept in the frame the robot is placed in.

A ring LiDAR on a mast does not see low things near the robot, so low points stay for a while; tall things are always in
view, so their points (a person walking by) fade at once. What is too low for a single return is in ``floor_relief``.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from scene_graph.geometry.se3 import SE3
from skills.geometry import Point2, Points
from skills.obstacles.cells import CELL_M, found, moved, packed
from skills.obstacles.floor_relief import FloorRelief
from skills.obstacles.settings import SurroundingsSettings
from skills.ports import FloorReturns

_CELL = np.dtype(
    [("key", np.int64), ("at_m", np.float64, 2), ("scans", np.int64), ("seen_s", np.float64), ("tall", "?")]
)
"""A cell in which something was hit: where it lies, the mean of the hits, in how many scans, when last, how high."""
Cells = NDArray[np.void]


@dataclass(kw_only=True)
class Surroundings:
    """Cells of ``CELL_M`` in which something was hit lately.

    ``arm_reach_m``: how far the arm reaches ahead; points on it are not obstacles.
    """

    settings: SurroundingsSettings = field(default_factory=SurroundingsSettings)
    frame: str = ""
    relief: FloorRelief = field(default_factory=FloorRelief)
    _cells: Cells = field(default_factory=lambda: np.zeros(0, dtype=_CELL))
    _last_scan: object = None
    _last_floor: object = None

    def points(self) -> Points:
        """Where cells were hit, (N, 2), in ``frame``: the mean of the hits in each; and where the floor is not flat."""
        return np.concatenate([self._cells["at_m"], self.relief.points()])

    def points_near(self, point: Point2, reach_m: float) -> Points:
        """Those within ``reach_m`` of ``point``."""
        points = self.points()
        return np.asarray(points[np.hypot(*(points - point).T) < reach_m])

    def observe(self, points_base: Points, T_frame_base: SE3, stamp_s: float, arm_reach_m: float = 0.0) -> None:
        """Take in one scan, (N, 3) in the base frame. The same array twice counts once."""
        if points_base is not self._last_scan:
            self._last_scan = points_base
            self._merge(self._seen(points_base, T_frame_base, stamp_s, arm_reach_m))
        away_m = np.hypot(*(self._cells["at_m"] - T_frame_base.translation_m[:2]).T)
        low_s = np.where(away_m < self.settings.blind_m, self.settings.fade_blind_s, self.settings.fade_low_s)
        fade_s = np.where(self._cells["tall"], self.settings.fade_tall_s, low_s)
        self._cells = self._cells[stamp_s - self._cells["seen_s"] <= fade_s]

    def observe_floor(self, returns: FloorReturns, T_frame_base: SE3, stamp_s: float, arm_reach_m: float = 0.0) -> None:
        """Take in what should have been the floor, but beside tall things: a person's feet soon step on."""
        if returns is self._last_floor or not len(returns.spots_m):
            return
        self._last_floor = returns
        returns = returns.where(~self._on_arm(returns.spots_m, arm_reach_m))
        spots = returns.spots_m @ T_frame_base.rotation()[:2, :2].T + T_frame_base.translation_m[:2]
        tall = self._cells["at_m"][self._cells["tall"]]
        if len(tall):
            far = np.isinf(cKDTree(tall).query(spots, distance_upper_bound=self.settings.beside_m)[0])
            returns = returns.where(far)
        self.relief.observe(returns, T_frame_base, stamp_s)
        flat = self.relief.flat_among(self._cells["key"], stamp_s)
        self._cells = self._cells[~flat | (stamp_s - self._cells["seen_s"] < self.settings.settled_s)]

    def move_to(self, frame: str, T_new_old: SE3 | None) -> None:
        """Carry the memory into another frame, or drop it when the frames are not connected."""
        self.frame, self._cells = frame, moved(self._cells, T_new_old)
        self.relief.move_to(T_new_old)

    def forget(self) -> None:
        """Drop everything, for instance after the robot was carried away."""
        self._cells = self._cells[:0]
        self.relief.move_to(None)

    def _seen(self, points: Points, T_frame_base: SE3, stamp_s: float, arm_reach_m: float) -> Cells:
        """What one scan hit, by key: cells with enough hits, and those known already."""
        settings = self.settings
        x, y, z = points.T
        range_m = np.hypot(x, y)
        keep = (z > settings.min_height_m) & (z < settings.max_height_m)
        keep &= (range_m > settings.body_radius_m) & (range_m < settings.max_range_m)
        points = points[keep & ~self._on_arm(points, arm_reach_m)]
        if not len(points):
            return np.zeros(0, dtype=_CELL)
        placed = points @ T_frame_base.rotation()[:2].T + T_frame_base.translation_m[:2]
        raw = np.floor(placed / CELL_M).astype(np.int64)
        corner = raw.min(axis=0)
        columns, rows = raw.max(axis=0) - corner + 1
        index = (raw[:, 0] - corner[0]) * rows + raw[:, 1] - corner[1]
        count = np.bincount(index, minlength=columns * rows)
        hit = np.flatnonzero(count)
        cells = np.stack([hit // rows, hit % rows], axis=1) + corner
        tall = np.bincount(index[points[:, 2] > settings.tall_m], minlength=columns * rows)[hit] > 0
        seen = np.zeros(len(hit), dtype=_CELL)
        seen["key"], seen["scans"], seen["seen_s"] = packed(cells), 1, stamp_s
        for axis in (0, 1):
            seen["at_m"][:, axis] = np.bincount(index, placed[:, axis], minlength=columns * rows)[hit] / count[hit]
        solid = (count[hit] >= settings.min_hits) | found(seen["key"], self._cells["key"])[1]
        seen["tall"][solid] = _beside_tall(cells[solid], tall[solid], settings.patch_cells)
        return np.asarray(seen[solid])

    def _on_arm(self, points_base: Points, arm_reach_m: float) -> NDArray[np.bool_]:
        """Which of (N, 2 or 3) points may be the arm itself, or what it holds."""
        x, y = points_base[:, 0], points_base[:, 1]
        return np.asarray((x > 0) & (x < arm_reach_m) & (np.abs(y) < self.settings.arm_half_width_m))

    def _merge(self, seen: Cells) -> None:
        """Take in what was seen, sorted by key and each once."""
        place, known = found(seen["key"], self._cells["key"])
        at = place[known]
        scans = np.minimum(self._cells["scans"][at] + 1, self.settings.averaged)
        before_m = self._cells["at_m"][at]
        after_m = before_m + (seen["at_m"][known] - before_m) / scans[:, None]
        self._cells[at] = seen[known]
        self._cells["at_m"][at], self._cells["scans"][at] = after_m, scans
        self._cells = np.insert(self._cells, place[~known], seen[~known])


def _beside_tall(cells: NDArray[np.int64], tall: NDArray[np.bool_], patch_cells: int) -> NDArray[np.bool_]:
    """Which of (N, 2) cells are part of something tall: those that are, and those in or next to a patch that has one.

    A person's feet are seen beside the torso; they must fade with it, or every step would leave an obstacle behind.
    """
    if not tall.any():
        return tall
    patches = cells // patch_cells
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
