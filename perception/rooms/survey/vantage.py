"""Where to look at a room from."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label
from scipy.spatial import cKDTree

from perception.geometry.polygon import distance_to_outline, inside, points_inside
from perception.ports import RobotShape
from perception.rooms.outline.outline import Outline

Array = NDArray[np.float64]

_WAYS_RAD = np.deg2rad([0, 15, -15, 30, -30, 45, -45, 60, -60, 75, -75, 90, -90, 105, -105])


@dataclass(frozen=True, kw_only=True)
class VantageSettings:
    """Where the robot can stand and drive, beyond the shape of its body."""

    clearance_m: float = 0.45
    """From walls and furniture where it stands: it turns there, and comes to stand a little elsewhere. Chosen."""
    step_back_m: float = 0.6
    """Before an unseen stretch of wall. Chosen: some more than the clearance."""
    visited_m: float = 0.5
    """Nearer places are one: the same is seen from there."""
    cell_m: float = 0.05
    """Of the grid on which ways are looked for. Chosen: a fifth of the body."""
    spare_m: float = 0.01
    """Between body and obstacles on these ways. Chosen: the navigation keeps its own distance."""
    escape_m: float = 0.45
    """What stands nearer now does not hold the robot: it came there."""
    least_way_m: float = 0.4
    """Shortest way worth driving when nothing is known yet. Chosen."""
    longest_way_m: float = 1.6
    """And the longest: then it looks again."""
    own_m: float = 0.07
    """Returns this near around the body are of itself. Chosen: the arm at rest."""
    beside_m: float = 0.05
    """Beside the body that must be free to drive straight. Chosen: more than it drifts aside on the way."""


def next_vantage(
    outline: Outline,
    obstacles: Array,
    visited: Sequence[Array],
    robot: Array,
    settings: VantageSettings = VantageSettings(),
    shape: RobotShape = RobotShape(),
) -> Array | None:
    """A free place to measure from, frame of the outline, or ``None`` when all useful ones were visited.

    Args:
        outline: what is known so far.
        obstacles: (N, 2) returns at the height of the robot's body.
        visited: (2,) places that were tried.
        robot: (2,) where the robot is.
        settings: how much room it needs.
        shape: of its body.

    With an open outline it is a place before an unseen stretch, longest first; else the middle of the room.
    """
    if outline.closed:
        wishes = [_middle(outline.polygon, settings.clearance_m)]
    else:
        wishes = [center + settings.step_back_m * normal for center, normal in outline.frontiers()]
        wishes.append(_middle(outline.polygon, settings.clearance_m))
    reach = _Reach.of(outline.polygon, obstacles, robot, settings, shape)
    for wish in wishes:
        place = _clear_place(wish, outline.polygon, obstacles, robot, reach, settings.clearance_m)
        if place is not None and all(np.linalg.norm(place - other) > settings.visited_m for other in visited):
            return place
    return None


def freest_way(
    obstacles_base: Array, settings: VantageSettings = VantageSettings(), shape: RobotShape = RobotShape()
) -> Array | None:
    """A place (2,) in the base frame that the robot can drive to straight ahead or aside, as far as it is free.

    For where too few walls are in view to know the room's shape: a doorway into a narrow corridor. ``None`` when there
    is no way.
    """
    radius_m, longest_m = shape.footprint_radius_m, settings.longest_way_m
    obstacles_base = obstacles_base[np.linalg.norm(obstacles_base, axis=1) > radius_m + settings.own_m]
    best_m, best = settings.least_way_m, None
    for angle in _WAYS_RAD:
        along = np.array([np.cos(angle), np.sin(angle)])
        forward = obstacles_base @ along
        aside = np.abs(obstacles_base @ np.array([-along[1], along[0]]))
        ahead = forward[(forward > 0.0) & (aside < radius_m + settings.beside_m)]
        way_m = min(longest_m, float(ahead.min()) - settings.clearance_m if len(ahead) else longest_m)
        if way_m > best_m + 0.05:
            best_m, best = way_m, way_m * along
    return best


def _middle(polygon: Array, clearance_m: float) -> Array:
    """Center of the bounding rectangle, or the inner point farthest from the walls where that is not well inside."""
    low, high = polygon.min(axis=0), polygon.max(axis=0)
    center = (low + high) / 2.0
    if inside(polygon, center) and distance_to_outline(polygon, center) > 2.0 * clearance_m:
        return np.asarray(center)
    grid = np.stack(np.meshgrid(*np.linspace(low, high, 15).T, indexing="ij"), axis=-1).reshape(-1, 2)
    room = grid[points_inside(polygon, grid)]
    return np.asarray(max(room, key=lambda point: distance_to_outline(polygon, point), default=center))


def _clear_place(
    wish: Array, polygon: Array, obstacles: Array, robot: Array, reach: _Reach, clearance_m: float
) -> Array | None:
    """The place nearest to ``wish`` where the robot can stand and get to; nearer to the robot first among equals."""
    angles = np.arange(0.0, 2.0 * np.pi, np.pi / 6.0)
    circle = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    for radius_m in (0.0, 0.3, 0.6, 0.9, 1.3):
        places = wish + radius_m * (circle if radius_m > 0.0 else np.zeros((1, 2)))
        places = places[np.argsort(np.linalg.norm(places - robot, axis=1), kind="stable")]
        for place in places:
            if reach.covers(place) and _stands(place, polygon, obstacles, clearance_m):
                return np.asarray(place)
    return None


def _stands(place: Array, polygon: Array, obstacles: Array, clearance_m: float) -> bool:
    if not inside(polygon, place) or distance_to_outline(polygon, place) < min(clearance_m, 0.35 * _width(polygon)):
        return False
    return len(obstacles) == 0 or float(np.linalg.norm(obstacles - place, axis=1).min()) > clearance_m - 0.05


def _width(polygon: Array) -> float:
    """Shortest wall: in a narrow room the robot cannot keep its distance."""
    return float(np.linalg.norm(np.roll(polygon, -1, axis=0) - polygon, axis=1).min())


@dataclass(frozen=True, kw_only=True, eq=False)
class _Reach:
    """Where the robot can get to within the outline: (nx, ny) cells of ``cell_m`` from the corner ``low`` (2,)."""

    low: Array
    cell_m: float
    free: NDArray[np.bool_]

    @classmethod
    def of(cls, polygon: Array, obstacles: Array, robot: Array, settings: VantageSettings, shape: RobotShape) -> _Reach:
        """Cells that a way leads to from ``robot`` past (N, 2) ``obstacles``; what stands too near to it now does not
        hold it.
        """
        cell_m, body_m = settings.cell_m, shape.footprint_radius_m + settings.spare_m
        low, high = np.minimum(polygon.min(axis=0), robot), np.maximum(polygon.max(axis=0), robot)
        count = np.maximum(np.ceil((high - low) / cell_m).astype(np.int64), 1) + 1
        sides = zip(polygon, np.roll(polygon, -1, axis=0), strict=True)
        walls = [np.linspace(a, b, 2 + int(np.linalg.norm(b - a) / (0.5 * cell_m))) for a, b in sides]
        cells = low + np.moveaxis(np.indices(tuple(count)), 0, -1) * cell_m
        nearest_m, _ = cKDTree(np.concatenate([*walls, obstacles])).query(cells, distance_upper_bound=body_m)
        wide = np.isinf(nearest_m)
        wide |= np.linalg.norm(cells - robot, axis=-1) < settings.escape_m
        regions, _ = label(wide, np.ones((3, 3)))
        here = tuple(np.rint((robot - low) / cell_m).astype(np.int64).tolist())
        return cls(low=low, cell_m=cell_m, free=np.asarray(regions == regions[here]))

    def covers(self, place: Array) -> bool:
        """Whether the robot can get to (2,) ``place``."""
        i, j = np.rint((place - self.low) / self.cell_m).astype(np.int64).tolist()
        within = 0 <= i < self.free.shape[0] and 0 <= j < self.free.shape[1]
        return within and bool(self.free[i, j])
