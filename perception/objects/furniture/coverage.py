"""How much of a support has been seen well enough to show the smallest things that may lie on it or in it.

What counts is surface that was measured: a seat behind its backrest and the bottom of a basin behind its rim are not
seen, wherever in the picture they would be.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.seeing.projection import View, back_project

Array = NDArray[np.float64]
_COLUMNS, _ROWS = 6, 5


@dataclass(frozen=True, kw_only=True)
class CoverageSettings:
    """What counts as seen. ``pixels_per_m2``: with so many pixels by its area something flat is recognized: a remote
    control has a hundred. ``frames``: so many must have shown a part.
    """

    pixels_per_m2: float = 12500.0
    frames: int = 2
    step_px: int = 2
    """Of every second pixel of every second row depth is looked at: a part of a support has hundreds."""
    inner: float = 0.8
    """Share of a side that is asked for: rims are seldom in view, and nothing stays on them."""
    foot_m: float = 0.1
    """What is lower is floor, seen between legs."""
    rim_m: float = 0.04
    """So far below its rim begins the inside of a container."""
    least_points: int = 2
    """A single point may be noise."""
    turned_away: float = 0.5
    """How much it counts, against where most was not seen, not to look from where one looked last. Chosen."""


@dataclass(frozen=True, kw_only=True, eq=False)
class SeenSurface:
    """What a depth image shows finely enough: ``points`` (N, 3) and ``camera`` (3,) in the room frame of its view."""

    camera: Array
    points: Array

    @classmethod
    def of(cls, view: View, settings: CoverageSettings = CoverageSettings()) -> SeenSurface:
        """Of every second pixel of every second row what is near enough to have that many pixels by its area."""
        camera = view.T_room_camera.translation_m
        densest = view.intrinsics.fx * view.intrinsics.fy
        reach_m = np.cbrt(densest * max(camera[2] + settings.foot_m, 0.0) / settings.pixels_per_m2)
        depth_m = view.depth_m[:: settings.step_px, :: settings.step_px]
        v, u = np.nonzero((depth_m > 0.0) & (depth_m < reach_m))
        points_camera = back_project(
            u.astype(np.float64) * settings.step_px,
            v.astype(np.float64) * settings.step_px,
            depth_m[v, u].astype(np.float64),
            view.intrinsics,
        )
        points = view.T_room_camera.apply(points_camera)
        fine = densest * (camera[2] - points[:, 2]) >= settings.pixels_per_m2 * (points_camera**2).sum(axis=1) ** 1.5
        return cls(camera=camera, points=points[fine])


class Coverage:
    """Frames that showed each part of one support well enough; parts lie across its footprint, whatever its size."""

    def __init__(self, settings: CoverageSettings = CoverageSettings()) -> None:
        self._settings = settings
        self._seen = np.zeros((_COLUMNS, _ROWS), dtype=np.int64)
        self._camera = np.zeros(3)

    def add(self, box: Box, seen: SeenSurface, *, inside: bool = False) -> None:
        """One frame; ``box`` is in the room frame of its view. ``inside``: only what is below its rim counts."""
        self._camera = seen.camera
        away_m = np.hypot(seen.points[:, 0] - box.center[0], seen.points[:, 1] - box.center[1])
        local = box.local(seen.points[away_m < max(box.size_m[:2])])
        height_m = local[:, 2] + box.size_m[2] / 2.0
        share = local[:, :2] / np.maximum(self._settings.inner * np.asarray(box.size_m[:2]), 1e-6) + 0.5
        over = (share >= 0.0).all(axis=1) & (share < 1.0).all(axis=1) & (height_m > self._settings.foot_m)
        over &= (height_m < box.size_m[2] - self._settings.rim_m) if inside else True
        cells = (share[over] * (_COLUMNS, _ROWS)).astype(np.int64)
        count = np.bincount(cells[:, 0] * _ROWS + cells[:, 1], minlength=_COLUMNS * _ROWS)
        self._seen += count.reshape(self._seen.shape) >= self._settings.least_points

    @property
    def share(self) -> float:
        """Part of the support, 0 to 1, that was seen well enough."""
        return float(np.mean(self._seen >= self._settings.frames))

    def hidden_side_rad(self, box: Box) -> float:
        """From which side, in the support's own frame, to look for what was not seen: where most of it is, and not from
        where one looked last.
        """
        unseen = np.argwhere(self._seen < self._settings.frames)
        middle = (unseen.mean(axis=0) + 0.5) / (_COLUMNS, _ROWS) - 0.5 if len(unseen) else np.zeros(2)
        from_last = box.local(self._camera[None])[0, :2]
        x, y = 2.0 * middle - self._settings.turned_away * from_last / max(float(np.hypot(*from_last)), 1e-6)
        return float(np.arctan2(y, x))
