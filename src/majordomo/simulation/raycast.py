"""Exact ray casting among upright solids for a LiDAR, much faster than asking the physics library ray by ray.

Every solid of a house that stands is a prism: a box or a cylinder with a vertical axis. All rays of one azimuth lie in
one vertical plane, so a solid is cut by that plane once, and each ring only decides at what height it passes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
_NEVER = np.float32(np.inf)


@dataclass(frozen=True, kw_only=True)
class Prism:
    """An upright solid in house coordinates: a box with half sides, or a cylinder or ball with its radius as both."""

    center_m: tuple[float, float]
    half_m: tuple[float, float]
    bottom_m: float
    top_m: float
    yaw_rad: float = 0.0
    round: bool = False
    ball: bool = False


class Prisms:
    """Many prisms as arrays."""

    def __init__(self, prisms: Sequence[Prism]) -> None:
        ordered = [prism for prism in prisms if not prism.round] + [prism for prism in prisms if prism.round]
        self._boxes = sum(not prism.round for prism in prisms)
        self._center = _array([prism.center_m for prism in ordered], 2)
        self._half = _array([prism.half_m for prism in ordered], 2)
        self._heights = _array([(prism.bottom_m, prism.top_m) for prism in ordered], 2)
        self.balls = np.array([prism.ball for prism in ordered], dtype=np.bool_)
        yaw = np.array([prism.yaw_rad for prism in ordered])
        self._cos, self._sin = np.cos(yaw).astype(np.float32), np.sin(yaw).astype(np.float32)

    def cut(self, origin_m: tuple[float, float], headings_rad: NDArray[np.float64]) -> tuple[Floats, Floats]:
        """Distances at which each heading enters and leaves each prism, (prisms, headings); missed if enter > leave."""
        cos, sin = np.cos(headings_rad).astype(np.float32), np.sin(headings_rad).astype(np.float32)
        offset = self._center - np.asarray(origin_m, dtype=np.float32)
        boxes = slice(0, self._boxes)
        rounds = slice(self._boxes, None)
        enter_box, leave_box = self._cut_boxes(offset[boxes], cos, sin)
        enter_round, leave_round = _cut_circles(offset[rounds], self._half[rounds, 0], cos, sin)
        return np.concatenate((enter_box, enter_round)), np.concatenate((leave_box, leave_round))

    @property
    def heights_m(self) -> Floats:
        """(prisms, 2): bottom and top."""
        return self._heights

    def _cut_boxes(self, offset: Floats, cos: Floats, sin: Floats) -> tuple[Floats, Floats]:
        """The slab method in each box's own axes."""
        count = self._boxes
        c, s = self._cos[:count, None], self._sin[:count, None]
        enter = np.full((count, len(cos)), -_NEVER, dtype=np.float32)
        leave = np.full((count, len(cos)), _NEVER, dtype=np.float32)
        axes = (
            (c * cos + s * sin, c[:, 0] * offset[:, 0] + s[:, 0] * offset[:, 1]),
            (c * sin - s * cos, c[:, 0] * offset[:, 1] - s[:, 0] * offset[:, 0]),
        )
        for axis, (along, center) in enumerate(axes):
            direction = np.where(np.abs(along) < 1e-9, np.float32(1e-9), along)
            near = (center - self._half[:count, axis])[:, None] / direction
            far = (center + self._half[:count, axis])[:, None] / direction
            np.maximum(enter, np.minimum(near, far), out=enter)
            np.minimum(leave, np.maximum(near, far), out=leave)
        return enter, leave


def cast(
    scenes: Sequence[Prisms],
    origin_m: tuple[float, float, float],
    headings_rad: NDArray[np.float64],
    slopes: NDArray[np.float64],
) -> NDArray[np.float32]:
    """Horizontal distance to the nearest solid or the floor, (slopes, headings); ``inf`` for none.

    Args:
        scenes: all solids.
        origin_m: of all rays, house coordinates.
        headings_rad: (headings,) directions in the plane.
        slopes: (slopes,) rise per meter, none of them zero.
    """
    enter, leave, heights, balls = _cuts(scenes, origin_m, headings_rad)
    heading, solid = np.nonzero((leave > np.maximum(enter, 0.0)).T)
    enter, leave = enter[solid, heading], leave[solid, heading]
    slope = slopes.astype(np.float32)[:, None]
    bottom = (heights[solid, 0] - np.float32(origin_m[2])) / slope
    top = (heights[solid, 1] - np.float32(origin_m[2])) / slope
    hit = np.maximum(np.maximum(enter, np.minimum(bottom, top)), np.float32(0.0))
    hit[hit > np.minimum(leave, np.maximum(bottom, top))] = _NEVER
    ball = balls[solid]
    hit[:, ball] = _on_balls(enter[ball], leave[ball], heights[solid[ball]] - np.float32(origin_m[2]), slope)
    nearest = np.full((len(slopes), len(headings_rad)), _NEVER, dtype=np.float32)
    if len(heading):
        present, first = np.unique(heading, return_index=True)
        nearest[:, present] = np.minimum.reduceat(hit, first, axis=1)
    floor = np.where(slopes < 0, -origin_m[2] / slopes, np.inf).astype(np.float32)
    return np.asarray(np.minimum(nearest, floor[:, None]), dtype=np.float32)


def _cuts(
    scenes: Sequence[Prisms], origin_m: tuple[float, float, float], headings_rad: NDArray[np.float64]
) -> tuple[Floats, Floats, Floats, NDArray[np.bool_]]:
    cuts = [scene.cut((origin_m[0], origin_m[1]), headings_rad) for scene in scenes]
    enter = np.concatenate([enter for enter, _ in cuts])
    leave = np.concatenate([leave for _, leave in cuts])
    heights = np.concatenate([scene.heights_m for scene in scenes])
    return enter, leave, heights, np.concatenate([scene.balls for scene in scenes])


def _on_balls(enter: Floats, leave: Floats, heights: Floats, slope: Floats) -> Floats:
    """Where rays of some slopes meet the circles that are cut out of balls, (slopes, cuts)."""
    along, radius, up = (enter + leave) / 2, (leave - enter) / 2, heights.mean(axis=1)
    a, b = 1.0 + slope**2, along + slope * up
    root = b**2 - a * (along**2 + up**2 - radius**2)
    return np.asarray(np.where(root >= 0.0, (b - np.sqrt(np.maximum(root, 0.0))) / a, _NEVER), dtype=np.float32)


def _cut_circles(offset: Floats, radius: Floats, cos: Floats, sin: Floats) -> tuple[Floats, Floats]:
    along = offset[:, :1] * cos + offset[:, 1:] * sin
    across = offset[:, :1] * sin - offset[:, 1:] * cos
    chord = radius[:, None] ** 2 - across**2
    half = np.sqrt(np.maximum(chord, 0.0))
    missed = chord < 0.0
    return np.where(missed, _NEVER, along - half), np.where(missed, -_NEVER, along + half)


def _array(rows: Sequence[Sequence[float]], width: int) -> Floats:
    return np.asarray(rows, dtype=np.float32).reshape(len(rows), width)
