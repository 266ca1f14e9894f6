"""How high the boards of a shelf are, or a seat: what is flat, faces up and lies inside a piece of furniture.

In every frame, the pixels of the piece whose surface is level are counted by their height; where a good part of its
length and depth is at one height, there is a surface. What many frames agree on is believed.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import cv2
import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.seeing.projection import View, back_project
from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class LevelSettings:
    """What counts as a level surface. Chosen on furniture in simulated houses, where nothing else is said."""

    span_px: int = 2
    """How far apart are the pixels of which a normal is made: less is noise of depth."""
    level: float = 0.85
    """Upward part of the normal from which on a surface counts as level: 32 degrees, as noise of depth tilts it."""
    bin_m: float = 0.01
    """Heights are counted in steps of this."""
    peak_m: float = 0.015
    """So far above and below its height the points of a surface are: two sigmas of depth at a meter and a half."""
    apart_m: float = 0.08
    """Two boards are farther apart than this."""
    lowest_m: float = 0.08
    """Lower over the bottom of a piece is its foot, or the floor."""
    margin_m: float = 0.03
    """How far outside the box of a piece a point of it may be measured."""
    stride_from_px: int = 20_000
    """Of a mask with a larger frame, every second pixel is enough."""
    share: float = 0.1
    """Of the footprint, what must be seen at one height in one frame."""
    length: float = 0.4
    """The same of the length."""
    cell_m: float = 0.05
    """In cells of this size the length is counted."""
    contrast: float = 2.0
    """So many times as much must be at a height as just above and below it: slopes and backs are at every height."""
    hits: int = 3
    """So many frames must agree on a surface."""
    often: float = 0.1
    """Share of the frames of the surest surface that another must be in: the tops of things may be taken for one now
    and then.
    """
    stored_hits: float = 10.0
    """As how many frames counts what is remembered from before a restart."""


@dataclass(frozen=True, kw_only=True)
class Level:
    """A level surface: height in the room, how sure (the inverse of a variance, but for a factor), frames it was in."""

    height_m: float
    weight: float
    hits: float


class LevelMemory:
    """The level surfaces of one piece of furniture, from all frames; heights in the frame of its room."""

    def __init__(self, levels: tuple[Level, ...] = (), settings: LevelSettings = LevelSettings()) -> None:
        self._levels, self._settings = levels, settings

    @classmethod
    def of(cls, heights_m: tuple[float, ...], settings: LevelSettings = LevelSettings()) -> LevelMemory:
        """What is remembered from before."""
        hits = settings.stored_hits
        return cls(tuple(Level(height_m=height_m, weight=hits, hits=hits) for height_m in heights_m), settings)

    @property
    def heights_m(self) -> tuple[float, ...]:
        """Those that enough frames agree on, lowest first."""
        most = max((level.hits for level in self._levels), default=0.0)
        least = max(self._settings.hits, self._settings.often * most)
        return tuple(level.height_m for level in self._levels if level.hits >= least)

    def observe(self, mask: NDArray[np.bool_], view: View, T_room_view: SE3, box: Box) -> None:
        """Take in one frame: what ``mask`` (H, W) shows of the piece in ``box``, which is in the room's frame."""
        for seen in level_surfaces(mask, view, T_room_view, box, self._settings):
            self._merge(seen)

    def absorb(self, other: LevelMemory) -> None:
        """Take in what was seen of a part of the piece."""
        for level in other._levels:
            self._merge(level)

    def raised(self, by_m: float) -> LevelMemory:
        """The same, higher."""
        return LevelMemory(tuple(replace(k, height_m=k.height_m + by_m) for k in self._levels), self._settings)

    def _merge(self, seen: Level) -> None:
        near = [level for level in self._levels if abs(level.height_m - seen.height_m) < self._settings.apart_m / 2.0]
        weight = seen.weight + sum(level.weight for level in near)
        height_m = sum(level.height_m * level.weight for level in (*near, seen)) / weight
        merged = Level(height_m=height_m, weight=weight, hits=seen.hits + max((k.hits for k in near), default=0.0))
        others = [level for level in self._levels if level not in near]
        self._levels = tuple(sorted((*others, merged), key=lambda level: level.height_m))


def level_surfaces(
    mask: NDArray[np.bool_], view: View, T_room_view: SE3, box: Box, settings: LevelSettings = LevelSettings()
) -> list[Level]:
    """The level surfaces that one frame shows inside ``box``, lowest first."""
    points, areas = _level_points(mask, view, T_room_view, settings)
    near = box.contains(points, settings.margin_m)
    bottom_m = float(box.center[2]) - box.size_m[2] / 2.0
    near &= points[:, 2] > bottom_m + settings.lowest_m
    points, areas = points[near], areas[near]
    if len(points) == 0:
        return []
    away_m = float(np.median(np.linalg.norm(points - (T_room_view @ view.T_room_camera).translation_m, axis=1)))
    return [
        Level(height_m=height_m, weight=share / max(away_m, 0.5) ** 2, hits=1.0)
        for height_m, share in _peaks(points, areas, box, settings)
    ]


def _level_points(
    mask: NDArray[np.bool_], view: View, T_room_view: SE3, settings: LevelSettings
) -> tuple[Array, Array]:
    """Points (N, 3) of the mask where its surface is level, and how much of it each stands for, (N,) in square
    meters.
    """
    x, y, width, height = cv2.boundingRect(mask.astype(np.uint8))
    step = 2 if width * height > settings.stride_from_px else 1
    rows, columns = slice(y, y + height, step), slice(x, x + width, step)
    depth_m = cv2.blur(view.depth_m, (3, 3))[rows, columns].astype(np.float64)
    inside = (mask & (view.depth_m > 0.0))[rows, columns]
    span = max(settings.span_px // step, 1)
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
    level = whole[middle, middle] & (normal[..., 2] > settings.level * np.maximum(length, 1e-12))
    chosen = points[middle, middle][level]
    toward = T_room_camera.translation_m - chosen
    chosen_depth_m = depth_m[middle, middle][level]
    slant = np.maximum(np.abs(toward[:, 2]) / np.maximum(np.linalg.norm(toward, axis=1), 1e-9), 0.03)
    areas = (step * chosen_depth_m) ** 2 / (view.intrinsics.fx * view.intrinsics.fy * slant)
    above = toward[:, 2] > 0.0
    return chosen[above], areas[above]


def _peaks(points: Array, areas: Array, box: Box, settings: LevelSettings) -> list[tuple[float, float]]:
    """Heights at which much of the footprint is, lowest first, and how much of it."""
    heights = points[:, 2]
    footprint_m2 = box.size_m[0] * box.size_m[1]
    low_m = float(heights.min()) - 4 * settings.bin_m
    bins = int((float(heights.max()) + 4 * settings.bin_m - low_m) / settings.bin_m) + 1
    counts = np.bincount(((heights - low_m) / settings.bin_m).astype(np.intp), areas, minlength=bins)
    around = np.convolve(counts, np.ones(3), mode="same")
    found: list[tuple[float, float]] = []
    for k in np.argsort(-around, kind="stable"):
        if around[k] < settings.share * footprint_m2:
            break
        center_m = low_m + (k + 0.5) * settings.bin_m
        if any(abs(center_m - height_m) < settings.apart_m for height_m, _ in found):
            continue
        at = np.abs(heights - center_m) < settings.peak_m
        height_m = float(np.average(heights[at], weights=areas[at]))
        off = np.abs(heights - height_m)
        at, beside = off < settings.peak_m, (off >= settings.peak_m) & (off < 2.0 * settings.peak_m)
        if (
            areas[at].sum() < settings.contrast * areas[beside].sum()
            or _length_share(points[at], box, settings.cell_m) < settings.length
        ):
            continue
        found.append((float(np.average(heights[at], weights=areas[at])), float(areas[at].sum() / footprint_m2)))
    return sorted(found)


def _length_share(points: Array, box: Box, cell_m: float) -> float:
    """Share of the box's length along which there are points."""
    along = 0 if box.size_m[0] >= box.size_m[1] else 1
    cells = max(int(box.size_m[along] / cell_m), 1)
    at = ((box.local(points)[:, along] / box.size_m[along] + 0.5) * cells).astype(np.intp)
    return len(np.unique(np.clip(at, 0, cells - 1))) / cells
