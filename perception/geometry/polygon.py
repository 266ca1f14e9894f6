"""Polygons as (N, 2) arrays of corners in meters, counter-clockwise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def inside(polygon: Array, point: Array) -> bool:
    """Whether (2,) ``point`` lies in (N, 2) ``polygon``."""
    return bool(points_inside(polygon, point[None])[0])


def points_inside(polygon: Array, points: Array) -> NDArray[np.bool_]:
    """(P,) which of (P, 2) ``points`` lie in (N, 2) ``polygon``: as many edges to the right as make an odd number."""
    x, y = polygon[:, 0], polygon[:, 1]
    x_next, y_next = np.append(x[1:], x[0]), np.append(y[1:], y[0])
    right, up = points[:, :1], points[:, 1:]
    straddles = (y > up) != (y_next > up)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = x + (up - y) / (y_next - y) * (x_next - x)
    return np.asarray(np.count_nonzero(straddles & (right < crossing), axis=1) % 2 == 1)


def shared_area(first: Array, second: Array, *, samples: int = 32) -> tuple[int, int, int]:
    """Areas of two (N, 2) polygons and of what they share, as numbers of points of a grid over both."""
    low, high = np.minimum(first.min(axis=0), second.min(axis=0)), np.maximum(first.max(axis=0), second.max(axis=0))
    axes = [
        np.linspace(a, b, samples, endpoint=False) + (b - a) / (2 * samples) for a, b in zip(low, high, strict=True)
    ]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    in_first, in_second = points_inside(first, points), points_inside(second, points)
    return int(in_first.sum()), int(in_second.sum()), int((in_first & in_second).sum())


def distance_to_outline(polygon: Array, point: Array) -> float:
    """Distance of (2,) ``point`` from the nearest edge of (N, 2) ``polygon``."""
    edges = np.concatenate([polygon[1:], polygon[:1]]) - polygon
    offset = point - polygon
    station = np.clip((offset * edges).sum(axis=1) / (edges**2).sum(axis=1), 0.0, 1.0)
    return float(np.linalg.norm(offset - station[:, None] * edges, axis=1).min())


def wall_lengths(polygon: Array) -> Array:
    """(N,) length of each wall."""
    return np.asarray(np.linalg.norm(np.roll(polygon, -1, axis=0) - polygon, axis=1))


def inward_normal(start: Array, end: Array) -> Array:
    """Unit normal to the left of the way from ``start`` to ``end``: into a counter-clockwise polygon."""
    along = (end - start) / np.linalg.norm(end - start)
    return np.array([-along[1], along[0]])


def signed_area(polygon: Array) -> float:
    """Area in square meters, positive when counter-clockwise."""
    x, y = polygon[:, 0], polygon[:, 1]
    return float(0.5 * (x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
