"""The outline of a room whose walls are not at right angles: what one good view shows, as straight walls.

Outside the room concept's priors (Concepts assume rectangles). The result is used for a partial room, so that the robot
can localize and go on; it does not count as closed.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from perception.geometry.polygon import signed_area, wall_lengths
from perception.lidar.corners import fit_line
from perception.rooms.outline.outline import ClosureSettings, Outline
from perception.rooms.views.view import View, dominant_direction

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class FreeformSettings:
    """How the contour of one view becomes straight walls."""

    straight_m: float = 0.12
    """How far from a straight wall its contour may be: six standard deviations of the usual range noise."""
    on_wall_m: float = 0.08
    """And its returns, when it is fitted: four of them."""
    least_coverage: float = 0.5
    """Share of the directions in which the view must see walls. Chosen: half."""
    same_wall: float = 0.2
    """Sine of the angle below which two neighboring walls have no sharp corner. Chosen: twelve degrees."""
    bin_m: float = 0.2
    """Stations in which returns make a wall seen. Chosen."""
    offset_std_m: float = 0.01
    """Of every wall: one view tells no better."""
    sigma_m: float = 0.02
    """Spread of the returns: range noise of the usual LiDAR (design, section 5)."""


def freeform_outline(
    views: Sequence[View], settings: FreeformSettings = FreeformSettings(), closure: ClosureSettings = ClosureSettings()
) -> Outline | None:
    """The outline as the clearest view shows it, or ``None`` when none shows half of the walls."""
    best = _clearest(views)
    points = best.points_frame()
    if best.scan.coverage < settings.least_coverage or len(points) < 20:
        return None
    rough = cv2.approxPolyDP(points.astype(np.float32).reshape(-1, 1, 2), settings.straight_m, closed=True)
    vertices = np.asarray(rough, dtype=np.float64).reshape(-1, 2)
    if len(vertices) < 3 or signed_area(vertices) <= 0.0:
        return None
    lines = [
        _wall(points, start, end, settings) for start, end in zip(vertices, np.roll(vertices, -1, axis=0), strict=True)
    ]
    polygon = np.array([_corner(lines[k - 1], lines[k], vertices[k], settings.same_wall) for k in range(len(vertices))])
    support = np.array([line[2] for line in lines])
    direction_rad, rectilinear = dominant_direction(views)
    return Outline(
        polygon=polygon,
        support=support,
        gap_m=(1.0 - support) * wall_lengths(polygon),
        gap_center=(polygon + np.roll(polygon, -1, axis=0)) / 2.0,
        offset_std_m=np.full(len(polygon), settings.offset_std_m),
        sigma_m=settings.sigma_m,
        direction_rad=direction_rad,
        rectilinear=min(rectilinear, 0.5),
        closure=closure,
    )


def _clearest(views: Sequence[View]) -> View:
    """Of the views that see most of the walls, the one whose ranges jump least: in a doorway they jump a lot."""
    most = max(view.scan.coverage for view in views)
    wide = [view for view in views if view.scan.coverage > most - 0.03]
    return min(wide, key=lambda view: float(np.abs(np.diff(view.scan.ranges_m[np.isfinite(view.scan.ranges_m)])).sum()))


def _wall(points: Array, start: Array, end: Array, settings: FreeformSettings) -> tuple[Array, float, float]:
    """Normal, offset and seen share of the wall along a rough edge."""
    length = float(np.linalg.norm(end - start))
    along = (end - start) / length
    normal = np.array([-along[1], along[0]])
    station = (points - start) @ along
    near = (np.abs((points - start) @ normal) < settings.on_wall_m) & (station > 0.0) & (station < length)
    if near.sum() < 5:
        return normal, float(normal @ start), 0.0
    filled = np.unique((station[near] / settings.bin_m).astype(np.int64))
    fitted, offset = fit_line(points[near])
    if float(fitted @ normal) < 0.0:
        fitted, offset = -fitted, -offset
    return fitted, offset, float(min(1.0, len(filled) * settings.bin_m / length))


def _corner(
    before: tuple[Array, float, float], after: tuple[Array, float, float], rough: Array, same_wall: float
) -> Array:
    """Where two walls meet, or the rough corner where they hardly bend."""
    normals = np.stack([before[0], after[0]])
    if abs(float(np.linalg.det(normals))) < same_wall:
        return rough
    meeting = np.asarray(np.linalg.solve(normals, np.array([before[1], after[1]])), dtype=np.float64)
    return meeting if float(np.linalg.norm(meeting - rough)) < 0.5 else rough
