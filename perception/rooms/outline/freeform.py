"""The outline of a room whose walls are not at right angles: what one good view shows, as straight walls.

Outside the room concept's priors (Concepts assume rectangles). The result is used for a partial room, so that the robot
can localize and go on; it does not count as closed.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from perception.geometry.polygon import signed_area, wall_lengths
from perception.lidar.corners import fit_line
from perception.rooms.outline.outline import Outline
from perception.rooms.views.view import View, dominant_direction

Array = NDArray[np.float64]

_STRAIGHT_M = 0.12
_ON_WALL_M = 0.08
_LEAST_COVERAGE = 0.5
_SAME_WALL = 0.2  # sine of the angle below which two neighboring walls have no sharp corner


def freeform_outline(views: Sequence[View]) -> Outline | None:
    """The outline as the clearest view shows it, or ``None`` when none shows half of the walls."""
    best = _clearest(views)
    points = best.points_frame()
    if best.scan.coverage < _LEAST_COVERAGE or len(points) < 20:
        return None
    rough = cv2.approxPolyDP(points.astype(np.float32).reshape(-1, 1, 2), _STRAIGHT_M, closed=True)
    vertices = np.asarray(rough, dtype=np.float64).reshape(-1, 2)
    if len(vertices) < 3 or signed_area(vertices) <= 0.0:
        return None
    lines = [_wall(points, start, end) for start, end in zip(vertices, np.roll(vertices, -1, axis=0), strict=True)]
    polygon = np.array([_corner(lines[k - 1], lines[k], vertices[k]) for k in range(len(vertices))])
    support = np.array([line[2] for line in lines])
    direction_rad, rectilinear = dominant_direction(views)
    return Outline(
        polygon=polygon,
        support=support,
        gap_m=(1.0 - support) * wall_lengths(polygon),
        gap_center=(polygon + np.roll(polygon, -1, axis=0)) / 2.0,
        offset_std_m=np.full(len(polygon), 0.01),
        sigma_m=0.02,
        direction_rad=direction_rad,
        rectilinear=min(rectilinear, 0.5),
    )


def _clearest(views: Sequence[View]) -> View:
    """Of the views that see most of the walls, the one whose ranges jump least: in a doorway they jump a lot."""
    most = max(view.scan.coverage for view in views)
    wide = [view for view in views if view.scan.coverage > most - 0.03]
    return min(wide, key=lambda view: float(np.abs(np.diff(view.scan.ranges_m[np.isfinite(view.scan.ranges_m)])).sum()))


def _wall(points: Array, start: Array, end: Array) -> tuple[Array, float, float]:
    """Normal, offset and seen share of the wall along a rough edge."""
    length = float(np.linalg.norm(end - start))
    along = (end - start) / length
    normal = np.array([-along[1], along[0]])
    station = (points - start) @ along
    near = (np.abs((points - start) @ normal) < _ON_WALL_M) & (station > 0.0) & (station < length)
    if near.sum() < 5:
        return normal, float(normal @ start), 0.0
    filled = np.unique((station[near] / 0.2).astype(np.int64))
    fitted, offset = fit_line(points[near])
    if float(fitted @ normal) < 0.0:
        fitted, offset = -fitted, -offset
    return fitted, offset, float(min(1.0, len(filled) * 0.2 / length))


def _corner(before: tuple[Array, float, float], after: tuple[Array, float, float], rough: Array) -> Array:
    """Where two walls meet, or the rough corner where they hardly bend."""
    normals = np.stack([before[0], after[0]])
    if abs(float(np.linalg.det(normals))) < _SAME_WALL:
        return rough
    meeting = np.asarray(np.linalg.solve(normals, np.array([before[1], after[1]])), dtype=np.float64)
    return meeting if float(np.linalg.norm(meeting - rough)) < 0.5 else rough
