"""How high the boards of a shelf are, or a seat: what is flat, faces up and lies inside a piece of furniture.

In every frame, the pixels of the piece whose surface is level are counted by their height; where a good part of its
length and depth is at one height, there is a surface. What many frames agree on is believed.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.seeing.projection import View, back_project
from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]
_SPAN_PX = 2
_LEVEL = 0.85
"""Upward part of the normal from which on a surface counts as level."""
_BIN_M = 0.01
_PEAK_M = 0.015
_APART_M = 0.08
"""Two boards are farther apart than this."""
_LOWEST_M = 0.08
_MARGIN_M = 0.03
_NEAR_M = 3.5
_STRIDE_FROM_PX = 20_000
_SHARE = 0.1
"""Of the footprint, what must be seen at one height in one frame; of the length, ``_LENGTH``."""
_LENGTH = 0.4
_CELL_M = 0.05
_CONTRAST = 2.0
"""So many times as much must be at a height as just above and below it: slopes and backs are at every height."""
_HITS = 3
_OFTEN = 0.1
"""Share of the frames of the surest surface that another must be in: the tops of things may be taken for one now and
then.
"""
_STORED_HITS = 10.0


@dataclass(frozen=True, kw_only=True)
class Level:
    """A level surface: height in the room, how sure (the inverse of a variance, but for a factor), frames it was in."""

    height_m: float
    weight: float
    hits: float


class LevelMemory:
    """The level surfaces of one piece of furniture, from all frames; heights in the frame of its room."""

    def __init__(self, levels: tuple[Level, ...] = ()) -> None:
        self._levels = levels

    @classmethod
    def of(cls, heights_m: tuple[float, ...]) -> LevelMemory:
        """What is remembered from before."""
        return cls(tuple(Level(height_m=height_m, weight=_STORED_HITS, hits=_STORED_HITS) for height_m in heights_m))

    @property
    def heights_m(self) -> tuple[float, ...]:
        """Those that enough frames agree on, lowest first."""
        most = max((level.hits for level in self._levels), default=0.0)
        return tuple(level.height_m for level in self._levels if level.hits >= max(_HITS, _OFTEN * most))

    def observe(self, mask: NDArray[np.bool_], view: View, T_room_view: SE3, box: Box) -> None:
        """Take in one frame: what ``mask`` (H, W) shows of the piece in ``box``, which is in the room's frame."""
        for seen in level_surfaces(mask, view, T_room_view, box):
            self._merge(seen)

    def absorb(self, other: LevelMemory) -> None:
        """Take in what was seen of a part of the piece."""
        for level in other._levels:
            self._merge(level)

    def raised(self, by_m: float) -> LevelMemory:
        """The same, higher."""
        return LevelMemory(tuple(Level(height_m=k.height_m + by_m, weight=k.weight, hits=k.hits) for k in self._levels))

    def _merge(self, seen: Level) -> None:
        near = [level for level in self._levels if abs(level.height_m - seen.height_m) < _APART_M / 2.0]
        weight = seen.weight + sum(level.weight for level in near)
        height_m = sum(level.height_m * level.weight for level in (*near, seen)) / weight
        merged = Level(height_m=height_m, weight=weight, hits=seen.hits + max((k.hits for k in near), default=0.0))
        others = [level for level in self._levels if level not in near]
        self._levels = tuple(sorted((*others, merged), key=lambda level: level.height_m))


def level_surfaces(mask: NDArray[np.bool_], view: View, T_room_view: SE3, box: Box) -> list[Level]:
    """The level surfaces that one frame shows inside ``box``, lowest first."""
    points, areas = _level_points(mask, view, T_room_view)
    near = box.contains(points, _MARGIN_M)
    bottom_m = float(box.center[2]) - box.size_m[2] / 2.0
    near &= points[:, 2] > bottom_m + _LOWEST_M
    points, areas = points[near], areas[near]
    if len(points) == 0:
        return []
    away_m = float(np.median(np.linalg.norm(points - (T_room_view @ view.T_room_camera).translation_m, axis=1)))
    return [
        Level(height_m=height_m, weight=share / max(away_m, 0.5) ** 2, hits=1.0)
        for height_m, share in _peaks(points, areas, box)
    ]


def _level_points(mask: NDArray[np.bool_], view: View, T_room_view: SE3) -> tuple[Array, Array]:
    """Points (N, 3) of the mask where its surface is level, and how much of it each stands for, (N,) in square
    meters.
    """
    x, y, width, height = cv2.boundingRect(mask.astype(np.uint8))
    step = 2 if width * height > _STRIDE_FROM_PX else 1
    rows, columns = slice(y, y + height, step), slice(x, x + width, step)
    depth_m = cv2.blur(view.depth_m, (3, 3))[rows, columns].astype(np.float64)
    inside = (mask & (view.depth_m > 0.0))[rows, columns]
    span = max(_SPAN_PX // step, 1)
    if min(inside.shape) <= 2 * span:
        return np.zeros((0, 3)), np.zeros(0)
    v, u = np.mgrid[rows, columns]
    T_room_camera = T_room_view @ view.T_room_camera
    flat = back_project(u.ravel().astype(np.float64), v.ravel().astype(np.float64), depth_m.ravel(), view.intrinsics)
    points = T_room_camera.apply(flat).reshape(*inside.shape, 3)
    middle = slice(span, -span)
    across = points[middle, 2 * span :] - points[middle, : -2 * span]
    down = points[2 * span :, middle] - points[: -2 * span, middle]
    normal = np.cross(down, across)  # toward the camera: what gets farther downward in the image is two things
    length = np.linalg.norm(normal, axis=2)
    whole = cv2.erode(inside.astype(np.uint8), np.ones((2 * span + 1, 2 * span + 1), np.uint8)) > 0
    level = whole[middle, middle] & (normal[..., 2] > _LEVEL * np.maximum(length, 1e-12))
    chosen = points[middle, middle][level]
    toward = T_room_camera.translation_m - chosen
    chosen_depth_m = depth_m[middle, middle][level]
    slant = np.maximum(np.abs(toward[:, 2]) / np.maximum(np.linalg.norm(toward, axis=1), 1e-9), 0.03)
    areas = (step * chosen_depth_m) ** 2 / (view.intrinsics.fx * view.intrinsics.fy * slant)
    above = toward[:, 2] > 0.0
    return chosen[above], areas[above]


def _peaks(points: Array, areas: Array, box: Box) -> list[tuple[float, float]]:
    """Heights at which much of the footprint is, lowest first, and how much of it."""
    heights = points[:, 2]
    footprint_m2 = box.size_m[0] * box.size_m[1]
    low_m = float(heights.min()) - 4 * _BIN_M
    bins = int((float(heights.max()) + 4 * _BIN_M - low_m) / _BIN_M) + 1
    counts = np.bincount(((heights - low_m) / _BIN_M).astype(np.intp), areas, minlength=bins)
    around = np.convolve(counts, np.ones(3), mode="same")
    found: list[tuple[float, float]] = []
    for k in np.argsort(-around, kind="stable"):
        if around[k] < _SHARE * footprint_m2:
            break
        center_m = low_m + (k + 0.5) * _BIN_M
        if any(abs(center_m - height_m) < _APART_M for height_m, _ in found):
            continue
        at = np.abs(heights - center_m) < _PEAK_M
        height_m = float(np.average(heights[at], weights=areas[at]))
        off = np.abs(heights - height_m)
        at, beside = off < _PEAK_M, (off >= _PEAK_M) & (off < 2.0 * _PEAK_M)
        if areas[at].sum() < _CONTRAST * areas[beside].sum() or _length_share(points[at], box) < _LENGTH:
            continue
        found.append((float(np.average(heights[at], weights=areas[at])), float(areas[at].sum() / footprint_m2)))
    return sorted(found)


def _length_share(points: Array, box: Box) -> float:
    """Share of the box's length along which there are points."""
    along = 0 if box.size_m[0] >= box.size_m[1] else 1
    cells = max(int(box.size_m[along] / _CELL_M), 1)
    at = ((box.local(points)[:, along] / box.size_m[along] + 0.5) * cells).astype(np.intp)
    return len(np.unique(np.clip(at, 0, cells - 1))) / cells
