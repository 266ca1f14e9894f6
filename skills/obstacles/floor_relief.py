"""What rises a few centimeters from the floor: a remote control, a plate. A single return does not tell it from noise,
the mean of many that should have met the floor at the same spot does.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3
from skills.geometry import Points
from skills.obstacles.cells import found, keys_of, moved, neighbor_keys
from skills.obstacles.settings import FloorReliefSettings
from skills.ports import FloorReturns

_SPOT = np.dtype(
    [
        ("key", np.int64),
        ("returns", np.float64),
        ("height_m", np.float64),
        ("square_m2", np.float64),
        ("at_m", np.float64, 2),
        ("seen_s", np.float64),
    ]
)
_MEANS = ("height_m", "square_m2", "at_m")


@dataclass(kw_only=True)
class FloorRelief:
    """Mean height above the floor of spots of ``CELL_M``, by what was returned from there."""

    settings: FloorReliefSettings = field(default_factory=FloorReliefSettings)
    _spots: NDArray[np.void] = field(default_factory=lambda: np.zeros(0, dtype=_SPOT))

    def points(self) -> Points:
        """Where something rises from the floor, (N, 2), in the frame of the observations; single spots do not count."""
        spots, settings = self._spots, self.settings
        variance = np.maximum(spots["square_m2"] - spots["height_m"] ** 2, settings.flattest_m**2)
        error_m = np.sqrt(variance / np.maximum(spots["returns"], 1.0))
        raised = spots[
            (spots["returns"] >= settings.returns)
            & (spots["height_m"] > np.maximum(settings.raised_m, settings.significance * error_m))
        ]
        beside = np.isin(neighbor_keys(raised["key"]), raised["key"]).any(axis=0)
        return np.array(raised["at_m"][beside])

    def observe(self, returns: FloorReturns, T_frame_base: SE3, stamp_s: float) -> None:
        """Take in what should have been the floor."""
        R, t_m = T_frame_base.rotation()[:2, :2], T_frame_base.translation_m[:2]
        keys, index, count = np.unique(keys_of(returns.spots_m @ R.T + t_m), return_inverse=True, return_counts=True)
        seen = np.zeros(len(keys), dtype=_SPOT)
        seen["key"], seen["returns"], seen["seen_s"] = keys, count, stamp_s
        height_m, at_m = returns.points_m[:, 2], returns.points_m[:, :2] @ R.T + t_m
        seen["height_m"] = np.bincount(index, height_m, len(keys)) / count
        seen["square_m2"] = np.bincount(index, height_m**2, len(keys)) / count
        for axis in (0, 1):
            seen["at_m"][:, axis] = np.bincount(index, at_m[:, axis], len(keys)) / count
        self._merge(seen)
        self._spots = self._spots[stamp_s - self._spots["seen_s"] <= self.settings.fade_s]

    def flat_among(self, keys: NDArray[np.int64], stamp_s: float) -> NDArray[np.bool_]:
        """Which of the cells ``keys`` (N,) were seen at ``stamp_s`` to be bare floor."""
        now = self._spots[self._spots["seen_s"] == stamp_s]
        bare = (now["returns"] >= self.settings.returns) & (now["height_m"] < self.settings.raised_m)
        return np.isin(keys, now["key"][bare])

    def move_to(self, T_new_old: SE3 | None) -> None:
        """Carry the memory into another frame, or drop it when the frames are not connected."""
        self._spots = moved(self._spots, T_new_old)

    def _merge(self, seen: NDArray[np.void]) -> None:
        """Take in what was seen, sorted by key and each once."""
        place, known = found(seen["key"], self._spots["key"])
        before, after = self._spots[place[known]], seen[known]
        kept = np.minimum(before["returns"], self.settings.most_returns)
        share = after["returns"] / (kept + after["returns"])
        for name in _MEANS:
            weight = share[:, None] if name == "at_m" else share
            after[name] = before[name] + (after[name] - before[name]) * weight
        after["returns"] += kept
        self._spots[place[known]] = after
        self._spots = np.insert(self._spots, place[~known], seen[~known])
