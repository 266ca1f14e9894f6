"""Where to look at a room from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label
from scipy.spatial import cKDTree

from perception.geometry.polygon import distance_to_outline, inside, points_inside
from perception.rooms.outline.outline import Outline

Array = NDArray[np.float64]

_CLEARANCE_M = 0.45
_STEP_BACK_M = 0.6
_VISITED_M = 0.5
_CELL_M = 0.05
_BODY_M = 0.29
_ESCAPE_M = 0.45


_WAYS_RAD = np.deg2rad([0, 15, -15, 30, -30, 45, -45, 60, -60, 75, -75, 90, -90, 105, -105])
_LEAST_WAY_M, _LONGEST_WAY_M = 0.4, 1.6
_OWN_BODY_M, _HALF_WAY_M = 0.35, 0.33


def next_vantage(outline: Outline, obstacles: Array, visited: Sequence[Array], robot: Array) -> Array | None:
    """A free place to measure from, frame of the outline, or ``None`` when all useful ones were visited.

    Args:
        outline: what is known so far.
        obstacles: (N, 2) returns at the height of the robot's body.
        visited: (2,) places that were tried.
        robot: (2,) where the robot is.

    With an open outline it is a place before an unseen stretch, longest first; else the middle of the room.
    """
    if outline.closed:
        wishes = [_middle(outline.polygon)]
    else:
        wishes = [center + _STEP_BACK_M * normal for center, normal in outline.frontiers()]
        wishes.append(_middle(outline.polygon))
    reach = _Reach.of(outline.polygon, obstacles, robot)
    for wish in wishes:
        place = _clear_place(wish, outline.polygon, obstacles, robot, reach)
        if place is not None and all(np.linalg.norm(place - other) > _VISITED_M for other in visited):
            return place
    return None


def freest_way(obstacles_base: Array) -> Array | None:
    """A place (2,) in the base frame that the robot can drive to straight ahead or aside, as far as it is free.

    For where too few walls are in view to know the room's shape: a doorway into a narrow corridor. ``None`` when there
    is no way.
    """
    obstacles_base = obstacles_base[np.linalg.norm(obstacles_base, axis=1) > _OWN_BODY_M]
    best_m, best = _LEAST_WAY_M, None
    for angle in _WAYS_RAD:
        along = np.array([np.cos(angle), np.sin(angle)])
        forward = obstacles_base @ along
        aside = np.abs(obstacles_base @ np.array([-along[1], along[0]]))
        ahead = forward[(forward > 0.0) & (aside < _HALF_WAY_M)]
        way_m = min(_LONGEST_WAY_M, float(ahead.min()) - _CLEARANCE_M if len(ahead) else _LONGEST_WAY_M)
        if way_m > best_m + 0.05:
            best_m, best = way_m, way_m * along
    return best


def _middle(polygon: Array) -> Array:
    """Center of the bounding rectangle, or the inner point farthest from the walls where that is not well inside."""
    low, high = polygon.min(axis=0), polygon.max(axis=0)
    center = (low + high) / 2.0
    if inside(polygon, center) and distance_to_outline(polygon, center) > 2.0 * _CLEARANCE_M:
        return np.asarray(center)
    grid = np.stack(np.meshgrid(*np.linspace(low, high, 15).T, indexing="ij"), axis=-1).reshape(-1, 2)
    room = grid[points_inside(polygon, grid)]
    return np.asarray(max(room, key=lambda point: distance_to_outline(polygon, point), default=center))


def _clear_place(wish: Array, polygon: Array, obstacles: Array, robot: Array, reach: _Reach) -> Array | None:
    """The place nearest to ``wish`` where the robot can stand and get to; nearer to the robot first among equals."""
    angles = np.arange(0.0, 2.0 * np.pi, np.pi / 6.0)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    for radius_m in (0.0, 0.3, 0.6, 0.9, 1.3):
        places = wish + radius_m * (circle if radius_m > 0.0 else np.zeros((1, 2)))
        places = places[np.argsort(np.linalg.norm(places - robot, axis=1), kind="stable")]
        for place in places:
            if reach.covers(place) and _stands(place, polygon, obstacles):
                return np.asarray(place)
    return None


def _stands(place: Array, polygon: Array, obstacles: Array) -> bool:
    if not inside(polygon, place) or distance_to_outline(polygon, place) < min(_CLEARANCE_M, 0.35 * _width(polygon)):
        return False
    return len(obstacles) == 0 or float(np.linalg.norm(obstacles - place, axis=1).min()) > _CLEARANCE_M - 0.05


def _width(polygon: Array) -> float:
    """Shortest wall: in a narrow room the robot cannot keep its distance."""
    return float(np.linalg.norm(np.roll(polygon, -1, axis=0) - polygon, axis=1).min())


@dataclass(frozen=True, kw_only=True, eq=False)
class _Reach:
    """Where the robot can get to within the outline: (nx, ny) cells of ``_CELL_M`` from the corner ``low`` (2,)."""

    low: Array
    free: NDArray[np.bool_]

    @classmethod
    def of(cls, polygon: Array, obstacles: Array, robot: Array) -> _Reach:
        """Cells that a way leads to from ``robot`` past (N, 2) ``obstacles``; what stands too near to it now does not
        hold it.
        """
        low, high = np.minimum(polygon.min(axis=0), robot), np.maximum(polygon.max(axis=0), robot)
        count = np.maximum(np.ceil((high - low) / _CELL_M).astype(np.int64), 1) + 1
        sides = zip(polygon, np.roll(polygon, -1, axis=0), strict=True)
        walls = [np.linspace(a, b, 2 + int(np.linalg.norm(b - a) / (0.5 * _CELL_M))) for a, b in sides]
        cells = low + np.moveaxis(np.indices(tuple(count)), 0, -1) * _CELL_M
        nearest_m, _ = cKDTree(np.concatenate([*walls, obstacles])).query(cells, distance_upper_bound=_BODY_M)
        wide = np.isinf(nearest_m)
        wide |= np.linalg.norm(cells - robot, axis=-1) < _ESCAPE_M
        regions, _ = label(wide, np.ones((3, 3)))
        here = tuple(np.rint((robot - low) / _CELL_M).astype(np.int64).tolist())
        return cls(low=low, free=np.asarray(regions == regions[here]))

    def covers(self, place: Array) -> bool:
        """Whether the robot can get to (2,) ``place``."""
        i, j = np.rint((place - self.low) / _CELL_M).astype(np.int64).tolist()
        within = 0 <= i < self.free.shape[0] and 0 <= j < self.free.shape[1]
        return within and bool(self.free[i, j])
