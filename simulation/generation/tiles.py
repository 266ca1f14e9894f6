"""Rectilinear ground in whole millimeters: rectangles, their common outline, its shape, and how narrow it gets."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from itertools import pairwise, product
from typing import NamedTuple

Corner = tuple[int, int]
Outline = tuple[Corner, ...]
"""Corners counter-clockwise, sides along x and y in turn."""


class Tile(NamedTuple):
    """A rectangle with its sides along the axes."""

    left: int
    low: int
    right: int
    high: int

    @property
    def width(self) -> int:
        """Extent along x."""
        return self.right - self.left

    @property
    def height(self) -> int:
        """Extent along y."""
        return self.high - self.low

    def overlaps(self, other: Tile) -> bool:
        """Whether the two share area."""
        return self.left < other.right and other.left < self.right and self.low < other.high and other.low < self.high

    def touches(self, other: Tile) -> bool:
        """Whether the two share a piece of a side."""
        beside = (self.right == other.left or other.right == self.left) and self.low < other.high
        stacked = (self.high == other.low or other.high == self.low) and self.left < other.right
        return (beside and other.low < self.high) or (stacked and other.left < self.right)


class Shape(Enum):
    """What a room looks like from above; the value is its cyclic sequence of left (L) and right (R) turns."""

    RECTANGLE = "LLLL"
    L = "LLLLLR"
    T = "LLLLRLLR"
    U = "LLLLLLRR"


def shape_of(outline: Outline) -> Shape | None:
    """The shape of a rectilinear outline, turned and mirrored as it may be; None for any other."""
    turns = "".join(
        "L" if _turn(outline[i - 1], corner, outline[(i + 1) % len(outline)]) > 0 else "R"
        for i, corner in enumerate(outline)
    )
    return next((shape for shape in Shape if len(shape.value) == len(turns) and turns in shape.value * 2), None)


def area(tiles: Iterable[Tile]) -> int:
    """Square millimeters of tiles that do not overlap."""
    return sum(tile.width * tile.height for tile in tiles)


def outline_of(tiles: Sequence[Tile]) -> Outline | None:
    """The outline around all tiles; None unless they form one piece without holes or pinched corners."""
    ends: dict[Corner, Corner] = {}
    for side in _border(tiles):
        if side[0] in ends:
            return None
        ends[side[0]] = side[1]
    start = min(ends)
    loop = [start]
    while (corner := ends.pop(loop[-1])) != start:
        loop.append(corner)
    if ends:
        return None
    return tuple(corner for i, corner in enumerate(loop) if _turn(loop[i - 1], corner, loop[(i + 1) % len(loop)]) != 0)


def narrowest(tiles: Sequence[Tile]) -> int:
    """The shortest way straight across, from border to border, along x or y."""
    xs, ys, cells = _cells(tiles)
    across = [xs[b] - xs[a] for j in range(len(ys)) for a, b in _runs([(i, j) in cells for i in range(len(xs))])]
    across += [ys[b] - ys[a] for i in range(len(xs)) for a, b in _runs([(i, j) in cells for j in range(len(ys))])]
    return min(across)


def without(tiles: Iterable[Tile], hole: Tile) -> tuple[Tile, ...]:
    """What is left of the tiles when ``hole`` is taken away."""
    left = []
    for tile in tiles:
        if not tile.overlaps(hole):
            left.append(tile)
            continue
        low, high = max(tile.low, hole.low), min(tile.high, hole.high)
        parts = (
            Tile(tile.left, tile.low, tile.right, low),
            Tile(tile.left, high, tile.right, tile.high),
            Tile(tile.left, low, hole.left, high),
            Tile(hole.right, low, tile.right, high),
        )
        left += [part for part in parts if part.width > 0 and part.height > 0]
    return tuple(left)


def inset(outline: Outline, by: int) -> Outline:
    """The outline with every side moved inward."""
    corners = []
    for i, (x, y) in enumerate(outline):
        before, after = outline[i - 1], outline[(i + 1) % len(outline)]
        inward = [(-_sign(b[1] - a[1]), _sign(b[0] - a[0])) for a, b in ((before, (x, y)), ((x, y), after))]
        corners.append((x + by * (inward[0][0] + inward[1][0]), y + by * (inward[0][1] + inward[1][1])))
    return tuple(corners)


def sides(outline: Outline) -> Iterator[tuple[Corner, Corner]]:
    """Each side as (from, to)."""
    yield from pairwise((*outline, outline[0]))


def _border(tiles: Sequence[Tile]) -> Iterator[tuple[Corner, Corner]]:
    """Sides of the cells that have no neighbor there, with the ground on their left."""
    xs, ys, cells = _cells(tiles)
    for i, j in sorted(cells):
        a, b, c, d = (xs[i], ys[j]), (xs[i + 1], ys[j]), (xs[i + 1], ys[j + 1]), (xs[i], ys[j + 1])
        around = (((i, j - 1), (a, b)), ((i + 1, j), (b, c)), ((i, j + 1), (c, d)), ((i - 1, j), (d, a)))
        yield from (side for neighbor, side in around if neighbor not in cells)


def _cells(tiles: Sequence[Tile]) -> tuple[list[int], list[int], set[tuple[int, int]]]:
    """All x and y at which a tile begins or ends, and the cells of that uneven grid which some tile covers."""
    xs = sorted({x for tile in tiles for x in (tile.left, tile.right)})
    ys = sorted({y for tile in tiles for y in (tile.low, tile.high)})
    cells = {
        cell
        for tile in tiles
        for cell in product(
            range(xs.index(tile.left), xs.index(tile.right)), range(ys.index(tile.low), ys.index(tile.high))
        )
    }
    return xs, ys, cells


def _runs(filled: Sequence[bool]) -> Iterator[tuple[int, int]]:
    """Start and end of each unbroken stretch."""
    start: int | None = None
    for index, inside in enumerate((*filled, False)):
        if inside and start is None:
            start = index
        elif not inside and start is not None:
            yield start, index
            start = None


def _turn(a: Corner, b: Corner, c: Corner) -> int:
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0])


def _sign(number: int) -> int:
    return (number > 0) - (number < 0)
