"""Exact ray casting among upright solids for a LiDAR, much faster than asking the physics library ray by ray.

Every solid of a house that stands is a prism: a box or a cylinder with a vertical axis. All rays of one azimuth lie in
one vertical plane, so a solid is cut by the planes that meet it, once each, and each ring only decides at what height
it passes.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]
Indices = NDArray[np.int64]
_NEVER = np.float32(np.inf)
_CORNERS = np.array([[1, 1], [-1, 1], [-1, -1], [1, -1]], dtype=np.float32)
_MARGIN_RAD = 1e-3
_NEAR_M = 1e-3


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

    def cut(
        self, origin_m: tuple[float, float], headings_rad: NDArray[np.float64]
    ) -> tuple[Indices, Indices, Floats, Floats]:
        """Where headings enter and leave prisms: prism, heading, and the two distances of each cut, (cuts,) each.

        ``headings_rad``: ascending, within one turn.
        """
        cos, sin = np.cos(headings_rad).astype(np.float32), np.sin(headings_rad).astype(np.float32)
        offset = self._center - np.asarray(origin_m, dtype=np.float32)
        prism, heading = _pairs(*self._bearings(offset), headings_rad)
        boxes = prism < self._boxes
        enter, leave = np.empty(len(prism), dtype=np.float32), np.empty(len(prism), dtype=np.float32)
        enter[boxes], leave[boxes] = self._cut_boxes(offset, cos, sin, prism[boxes], heading[boxes])
        enter[~boxes], leave[~boxes] = _cut_circles(
            offset[prism[~boxes]], self._half[prism[~boxes], 0], cos[heading[~boxes]], sin[heading[~boxes]]
        )
        met = leave > np.maximum(enter, 0.0)
        return prism[met], heading[met], enter[met], leave[met]

    @property
    def heights_m(self) -> Floats:
        """(prisms, 2): bottom and top."""
        return self._heights

    def _bearings(self, offset: Floats) -> tuple[Floats, Floats]:
        """First bearing of each prism in radians, and how far it reaches counter-clockwise from there."""
        c, s = self._cos[:, None], self._sin[:, None]
        sides = self._half[:, None, :] * _CORNERS
        x = offset[:, :1] + c * sides[..., 0] - s * sides[..., 1]
        y = offset[:, 1:] + s * sides[..., 0] + c * sides[..., 1]
        middle = np.arctan2(offset[:, 1], offset[:, 0])
        turned = np.arctan2(y, x) - middle[:, None]
        turned -= np.float32(math.tau) * np.round(turned / np.float32(math.tau))
        first, last = turned.min(axis=1) - _MARGIN_RAD, turned.max(axis=1) + _MARGIN_RAD
        local_x = np.abs(self._cos * offset[:, 0] + self._sin * offset[:, 1])
        local_y = np.abs(self._cos * offset[:, 1] - self._sin * offset[:, 0])
        within = (local_x <= self._half[:, 0] + _NEAR_M) & (local_y <= self._half[:, 1] + _NEAR_M)
        return middle + np.where(within, 0.0, first), np.where(within, math.tau, last - first)

    def _cut_boxes(
        self, offset: Floats, cos: Floats, sin: Floats, prism: Indices, heading: Indices
    ) -> tuple[Floats, Floats]:
        """The slab method in each box's own axes."""
        c, s = self._cos[prism], self._sin[prism]
        x, y = offset[prism, 0], offset[prism, 1]
        cos, sin = cos[heading], sin[heading]
        enter = np.full(len(prism), -_NEVER, dtype=np.float32)
        leave = np.full(len(prism), _NEVER, dtype=np.float32)
        for axis, (along, center) in enumerate(
            ((c * cos + s * sin, c * x + s * y), (c * sin - s * cos, c * y - s * x))
        ):
            direction = np.where(np.abs(along) < 1e-9, np.float32(1e-9), along)
            half = self._half[prism, axis]
            near, far = (center - half) / direction, (center + half) / direction
            np.maximum(enter, np.minimum(near, far), out=enter)
            np.minimum(leave, np.maximum(near, far), out=leave)
        return enter, leave


def _pairs(first: Floats, width: Floats, headings_rad: NDArray[np.float64]) -> tuple[Indices, Indices]:
    """Every prism with every heading in its range of bearings, (pairs,) each."""
    count, start = len(headings_rad), headings_rad[0]
    begin = start + np.mod(first - start, math.tau)
    end = begin + np.minimum(width, math.tau)
    low = np.searchsorted(headings_rad, begin, side="left")
    high = np.where(
        end < start + math.tau,
        np.searchsorted(headings_rad, end, side="right"),
        count + np.searchsorted(headings_rad, end - math.tau, side="right"),
    )
    many = np.minimum(high - low, count)
    prism = np.repeat(np.arange(len(first)), many)
    steps = np.arange(len(prism)) - np.repeat(np.cumsum(many) - many, many)
    return prism, (np.repeat(low, many) + steps) % count


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
    solid, heading, enter, leave, heights, balls = _cuts(scenes, origin_m, headings_rad)
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
) -> tuple[Indices, Indices, Floats, Floats, Floats, NDArray[np.bool_]]:
    """All cuts of all scenes in the order of their headings; solids are numbered through."""
    cuts = [scene.cut((origin_m[0], origin_m[1]), headings_rad) for scene in scenes]
    sizes = [len(scene.balls) for scene in scenes]
    before = np.cumsum([0, *sizes[:-1]])
    solid = np.concatenate([prism + start for (prism, _, _, _), start in zip(cuts, before, strict=True)])
    heading, enter, leave = (np.concatenate([cut[part] for cut in cuts]) for part in (1, 2, 3))
    order = np.argsort(heading, kind="stable")
    heights = np.concatenate([scene.heights_m for scene in scenes])
    balls = np.concatenate([scene.balls for scene in scenes])
    return solid[order], heading[order], enter[order], leave[order], heights, balls


def _on_balls(enter: Floats, leave: Floats, heights: Floats, slope: Floats) -> Floats:
    """Where rays of some slopes meet the circles that are cut out of balls, (slopes, cuts)."""
    along, radius, up = (enter + leave) / 2, (leave - enter) / 2, heights.mean(axis=1)
    a, b = 1.0 + slope**2, along + slope * up
    root = b**2 - a * (along**2 + up**2 - radius**2)
    return np.asarray(np.where(root >= 0.0, (b - np.sqrt(np.maximum(root, 0.0))) / a, _NEVER), dtype=np.float32)


def _cut_circles(offset: Floats, radius: Floats, cos: Floats, sin: Floats) -> tuple[Floats, Floats]:
    along = offset[:, 0] * cos + offset[:, 1] * sin
    across = offset[:, 0] * sin - offset[:, 1] * cos
    chord = radius**2 - across**2
    half = np.sqrt(np.maximum(chord, 0.0))
    missed = chord < 0.0
    return np.where(missed, _NEVER, along - half), np.where(missed, -_NEVER, along + half)


def _array(rows: Sequence[Sequence[float]], width: int) -> Floats:
    return np.asarray(rows, dtype=np.float32).reshape(len(rows), width)
