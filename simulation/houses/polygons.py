"""Plane geometry of simple polygons: corners in order, meters, last joined to first."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

Point2 = tuple[float, float]
Polygon = Sequence[Point2]

_TOUCH_M = 1e-6


def edges(polygon: Polygon) -> Iterator[tuple[Point2, Point2]]:
    """Each side as (from, to)."""
    for index, start in enumerate(polygon):
        yield start, polygon[(index + 1) % len(polygon)]


def cross(a: Point2, b: Point2, c: Point2) -> float:
    """Twice the signed area of the triangle abc, in square meters; positive when it turns left."""
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])


def signed_area(polygon: Polygon) -> float:
    """Square meters, positive when counter-clockwise (shoelace formula)."""
    return 0.5 * sum(a[0] * b[1] - b[0] * a[1] for a, b in edges(polygon))


def distance_to_segment(point: Point2, a: Point2, b: Point2) -> float:
    """Meters from ``point`` to the nearest point of ab."""
    along = (b[0] - a[0], b[1] - a[1])
    length2 = along[0] ** 2 + along[1] ** 2
    share = 0.0 if length2 == 0.0 else ((point[0] - a[0]) * along[0] + (point[1] - a[1]) * along[1]) / length2
    share = min(1.0, max(0.0, share))
    return math.dist(point, (a[0] + share * along[0], a[1] + share * along[1]))


def distance_to_boundary(point: Point2, polygon: Polygon) -> float:
    """Meters from ``point``, inside or outside, to the nearest side."""
    return min(distance_to_segment(point, a, b) for a, b in edges(polygon))


def contains(polygon: Polygon, point: Point2) -> bool:
    """Whether ``point`` is inside (even-odd rule); on the boundary either answer may come."""
    inside = False
    for a, b in edges(polygon):
        if (a[1] > point[1]) != (b[1] > point[1]):
            at_x = a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])
            inside ^= point[0] < at_x
    return inside


def strictly_contains(polygon: Polygon, point: Point2, margin_m: float = _TOUCH_M) -> bool:
    """Whether ``point`` is inside and farther than ``margin_m`` from every side."""
    return contains(polygon, point) and distance_to_boundary(point, polygon) > margin_m


def ray_to_segment(origin: Point2, direction: Point2, a: Point2, b: Point2) -> float:
    """Meters along the unit vector ``direction`` to ab; infinite when it misses or runs parallel."""
    along = (b[0] - a[0], b[1] - a[1])
    turn = direction[0] * along[1] - direction[1] * along[0]
    if abs(turn) < 1e-12:
        return math.inf
    to_a = (a[0] - origin[0], a[1] - origin[1])
    range_m = (to_a[0] * along[1] - to_a[1] * along[0]) / turn
    share = (to_a[0] * direction[1] - to_a[1] * direction[0]) / turn
    return range_m if range_m > 0.0 and -1e-9 <= share <= 1.0 + 1e-9 else math.inf


def crossing_sides(polygon: Polygon) -> tuple[int, int] | None:
    """Indices of two sides that cross, touch or fold back on each other; None for a simple polygon."""
    sides = list(edges(polygon))
    for i, first in enumerate(sides):
        for j in range(i + 1, len(sides)):
            if j == i + 1:
                bad = _folds_back(first, sides[j])
            elif i == 0 and j == len(sides) - 1:
                bad = _folds_back(sides[j], first)
            else:
                bad = _meet(first, sides[j])
            if bad:
                return i, j
    return None


def overlap(first: Polygon, second: Polygon) -> bool:
    """Whether two simple polygons share area; a shared side or corner is none."""
    if any(_cross_properly(one, two) for one in edges(first) for two in edges(second)):
        return True
    return any(strictly_contains(second, p) for p in _probes(first)) or any(
        strictly_contains(first, p) for p in _probes(second)
    )


def _probes(polygon: Polygon) -> Iterator[Point2]:
    """Corners, middles of sides, and a point just inside each side."""
    for a, b in edges(polygon):
        length_m = math.dist(a, b)
        middle = ((a[0] + b[0]) / 2, (a[1] + b[1]) / 2)
        inset_m = min(0.005, length_m / 10)
        yield a
        yield middle
        yield middle[0] - (b[1] - a[1]) / length_m * inset_m, middle[1] + (b[0] - a[0]) / length_m * inset_m


def _cross_properly(one: tuple[Point2, Point2], two: tuple[Point2, Point2]) -> bool:
    """Each segment's ends lie clearly on both sides of the other."""
    margins = [cross(*one, end) / math.dist(*one) for end in two] + [cross(*two, end) / math.dist(*two) for end in one]
    a, b, c, d = margins
    return min(map(abs, margins)) > _TOUCH_M and a * b < 0.0 and c * d < 0.0


def _meet(one: tuple[Point2, Point2], two: tuple[Point2, Point2]) -> bool:
    """The segments cross or come within a micrometer."""
    ends = [distance_to_segment(end, *two) for end in one] + [distance_to_segment(end, *one) for end in two]
    return min(ends) <= _TOUCH_M or _cross_properly(one, two)


def _folds_back(one: tuple[Point2, Point2], two: tuple[Point2, Point2]) -> bool:
    """``two``, which starts where ``one`` ends, lies on it."""
    (a, b), (_, c) = one, two
    backwards = (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]) > 0.0
    return backwards and abs(cross(a, b, c)) <= _TOUCH_M * math.dist(a, b)
