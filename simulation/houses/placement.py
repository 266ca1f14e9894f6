"""Where a thing stands when it is put on or into another: at an offset, or at a free spot that is found."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass

Point2 = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class PlacementSettings:
    """Where a free spot is looked for; chosen."""

    edge_m: float = 0.06
    """Things keep this far from the edge of what they stand on, if it is large enough."""
    gap_m: float = 0.05
    """Between two things."""
    grid_m: float = 0.05


@dataclass(frozen=True, kw_only=True)
class Standing:
    """Something that stands or lies somewhere: its center and its extent as a disc, house coordinates, meters."""

    center_m: Point2
    radius_m: float


def to_house(pose: tuple[float, float, float], offset_m: Point2) -> Point2:
    """A point in the frame of what stands at ``pose`` in house coordinates."""
    x_m, y_m, yaw_rad = pose
    cos_yaw, sin_yaw = math.cos(yaw_rad), math.sin(yaw_rad)
    return x_m + offset_m[0] * cos_yaw - offset_m[1] * sin_yaw, y_m + offset_m[0] * sin_yaw + offset_m[1] * cos_yaw


def free_spot(
    pose: tuple[float, float, float],
    top_m: Point2,
    radius_m: float,
    others: Iterable[Standing],
    free: Iterable[Point2],
    settings: PlacementSettings = PlacementSettings(),
) -> Point2 | None:
    """The offset of a free spot on a top of extent ``top_m``; the same for the same surroundings.

    Args:
        pose: of what carries it, house coordinates.
        top_m: extent of its top.
        radius_m: of the thing to be put.
        others: what stands there already.
        free: floor points from which an arm could reach; nearer spots are better.
        settings: how close things stand.
    """
    standing, reachable = list(others), list(free)
    best: tuple[float, Point2] | None = None
    for offset in _grid(top_m, radius_m, settings):
        spot = to_house(pose, offset)
        if any(math.dist(spot, other.center_m) < other.radius_m + radius_m + settings.gap_m for other in standing):
            continue
        nearest_m = min((math.dist(spot, point) for point in reachable), default=0.0)
        if best is None or nearest_m < best[0] - 1e-6:
            best = (nearest_m, offset)
    return best[1] if best is not None else None


def _grid(top_m: Point2, radius_m: float, settings: PlacementSettings) -> Iterator[Point2]:
    """Offsets within the edges, nearest the center of each side first."""
    spans = [max(0.0, side / 2 - max(radius_m, 0.02) - settings.edge_m) for side in top_m]
    counts = [int(span / settings.grid_m) for span in spans]
    offsets = [
        (i * spans[0] / max(1, counts[0]), j * spans[1] / max(1, counts[1]))
        for i in range(-counts[0], counts[0] + 1)
        for j in range(-counts[1], counts[1] + 1)
    ]
    yield from sorted(offsets, key=lambda offset: (abs(offset[0]) + abs(offset[1]), offset))
