"""Upright boxes on the floor plan, and cutting a hole through them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

_TOUCH_M = 1e-6

Point2 = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class Block:
    """An upright box in house coordinates (m). ``size_m``: along its own x (turned by ``yaw_rad``), its y, and z."""

    center_m: tuple[float, float, float]
    size_m: tuple[float, float, float]
    yaw_rad: float

    def corners(self) -> tuple[Point2, ...]:
        """Its outline seen from above, counter-clockwise."""
        x, y = self.size_m[0] / 2, self.size_m[1] / 2
        return tuple(self.outward((sx * x, sy * y)) for sx, sy in ((-1, -1), (1, -1), (1, 1), (-1, 1)))

    def outward(self, point: Point2) -> Point2:
        """A point of its own frame in house coordinates."""
        c, s = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        return self.center_m[0] + c * point[0] - s * point[1], self.center_m[1] + s * point[0] + c * point[1]

    def inward(self, point: Point2) -> Point2:
        """A point of the house in its own frame."""
        c, s = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        x, y = point[0] - self.center_m[0], point[1] - self.center_m[1]
        return c * x + s * y, c * y - s * x

    def part(self, low: Point2, high: Point2) -> Block:
        """What lies between two opposite corners of its own frame, of the same height."""
        x, y = self.outward(((low[0] + high[0]) / 2, (low[1] + high[1]) / 2))
        size = (high[0] - low[0], high[1] - low[1], self.size_m[2])
        return Block(center_m=(x, y, self.center_m[2]), size_m=size, yaw_rad=self.yaw_rad)


def overlapping(one: Block, two: Block) -> bool:
    """Whether the outlines share area (separating axis theorem for two rectangles)."""
    return not (_apart(one, two) or _apart(two, one))


def without(block: Block, hole: Block) -> Iterator[Block]:
    """What is left of ``block`` when ``hole`` is cut through its height; a little less where sides are not parallel."""
    if not overlapping(block, hole):
        yield block
        return
    (low_x, low_y), (high_x, high_y) = _bounds(block, hole)
    x, y = block.size_m[0] / 2, block.size_m[1] / 2
    low_x, high_x = max(low_x, -x), min(high_x, x)
    yield from _solid(block, (-x, -y), (low_x, y))
    yield from _solid(block, (high_x, -y), (x, y))
    yield from _solid(block, (low_x, -y), (high_x, low_y))
    yield from _solid(block, (low_x, high_y), (high_x, y))


def _solid(block: Block, low: Point2, high: Point2) -> Iterator[Block]:
    if min(high[0] - low[0], high[1] - low[1]) > _TOUCH_M:
        yield block.part(low, high)


def _bounds(block: Block, other: Block) -> tuple[Point2, Point2]:
    """Lowest and highest coordinates of ``other`` in the frame of ``block``."""
    points = [block.inward(corner) for corner in other.corners()]
    xs, ys = [x for x, _ in points], [y for _, y in points]
    return (min(xs), min(ys)), (max(xs), max(ys))


def _apart(one: Block, two: Block) -> bool:
    """A side of ``one`` separates them."""
    (low_x, low_y), (high_x, high_y) = _bounds(one, two)
    x, y = one.size_m[0] / 2 - _TOUCH_M, one.size_m[1] / 2 - _TOUCH_M
    return low_x >= x or high_x <= -x or low_y >= y or high_y <= -y
