"""Measuring one room: views are collected while the robot moves, then solved for poses and outline together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, diagonal_covariance, wrap
from perception.geometry.walls import Walls
from perception.lidar.slice import OutlineScan
from perception.localization.alignment import Alignment, AlignmentSettings, align
from perception.localization.motion_model import odometry_covariance
from perception.rooms.outline.freeform import freeform_outline
from perception.rooms.outline.outline import RECTILINEAR, Outline, find_outline
from perception.rooms.survey.pose_graph import VotedCorner, optimize
from perception.rooms.views.view import View

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class MeasurementSettings:
    """How much is kept and how often it is refined.

    ``views``: at most this many are kept. ``rounds``: of poses from outline and outline from poses. Views closer
    together than ``step_m`` and ``step_rad`` are kept only up to ``resting_views`` in a row.
    """

    views: int = 60
    rounds: int = 2
    step_m: float = 0.08
    step_rad: float = 0.10
    resting_views: int = 12


@dataclass(frozen=True, kw_only=True, eq=False)
class Fit:
    """A room as measured: ``outline`` and the poses of ``views`` in one frame, whose origin is the first view.

    ``in_parent``: pose of the base in the robot's parent frame at each view, as the graph had it. ``matched``: share of
    each view's returns that lie on the outline.
    """

    outline: Outline
    views: tuple[View, ...]
    in_parent: tuple[Pose2, ...]
    matched: tuple[float, ...]
    corners: tuple[VotedCorner, ...]

    def anchor(self, least_matched: float) -> int:
        """Index of the earliest view that lies well in the outline."""
        return next((k for k, share in enumerate(self.matched) if share >= least_matched), len(self.views) - 1)


_WELL_MATCHED = 0.6
_VAGUE = diagonal_covariance(0.4, 0.4, 0.25)
_WIDE = AlignmentSettings(gates_m=(0.6, 0.4, 0.25, 0.15, 0.10, 0.08))
_TURNS_RAD = (0.0, 0.08, -0.08, 0.16, -0.16)


class RoomMeasurement:
    """Collects views of one room. ``T_parent_base`` of each view is what the graph said when it was taken."""

    def __init__(self, settings: MeasurementSettings | None = None) -> None:
        self.settings = settings or MeasurementSettings()
        self._views: list[View] = []
        self._in_parent: list[Pose2] = []
        self._resting = 0

    @property
    def views(self) -> Sequence[View]:
        return self._views

    def add(self, scan: OutlineScan, T_odom_base: Pose2, T_parent_base: Pose2) -> bool:
        """Keep the view unless enough were taken from this place; whether it was kept."""
        if self._views and not self._moved(T_odom_base):
            self._resting += 1
            if self._resting > self.settings.resting_views:
                return False
        else:
            self._resting = 0
        first = self._views[0].T_odom_base if self._views else T_odom_base
        self._views.append(View.of(scan, first.inverse() @ T_odom_base, T_odom_base))
        self._in_parent.append(T_parent_base)
        if len(self._views) > self.settings.views:
            self._thin()
        return True

    def _moved(self, T_odom_base: Pose2) -> bool:
        moved = self._views[-1].T_odom_base.inverse() @ T_odom_base
        return bool(
            np.hypot(moved.x_m, moved.y_m) > self.settings.step_m or abs(wrap(moved.yaw_rad)) > self.settings.step_rad
        )

    def _thin(self) -> None:
        """Drop every other view, but not the first few, which tie the room to where the robot came from."""
        kept = [k for k in range(len(self._views)) if k < 6 or k % 2 == 1 or k == len(self._views) - 1]
        self._views = [self._views[k] for k in kept]
        self._in_parent = [self._in_parent[k] for k in kept]

    def solve(self) -> Fit | None:
        """Pose graph first, then outline and poses in turn; ``None`` when no outline comes out."""
        if not self._views:
            return None
        solution = optimize(self._views)
        views = [view.moved(pose) for view, pose in zip(self._views, solution.poses, strict=True)]
        outline = _find(views)
        matched = [0.0] * len(views)
        for _ in range(self.settings.rounds):
            if outline is None:
                return None
            views, matched = _align_all(views, outline)
            outline = _find(views)
        if outline is None:
            return None
        return Fit(
            outline=outline,
            views=tuple(views),
            in_parent=tuple(self._in_parent),
            matched=tuple(matched),
            corners=solution.corners,
        )


def _find(views: Sequence[View]) -> Outline | None:
    """The rectilinear outline, or where walls are not at right angles what one view shows."""
    outline = find_outline(views)
    if outline is not None and outline.rectilinear > RECTILINEAR:
        return outline
    return freeform_outline(views) or outline


def _search(view: View, walls: Walls, guess: Pose2) -> Alignment | None:
    """The pose near ``guess``, or where the pose graph had the view, at which it fits well; after a long way between
    two views odometry leads astray.
    """
    found = [
        align(view.scan.points_base, walls, origin @ Pose2(0.0, 0.0, turn_rad), _VAGUE, _WIDE)
        for origin in (guess, view.T_frame_base)
        for turn_rad in _TURNS_RAD
    ]
    best = max((one for one in found if one is not None), key=lambda one: one.matched, default=None)
    return best if best is not None and best.matched >= _WELL_MATCHED else None


def _align_all(views: Sequence[View], outline: Outline) -> tuple[list[View], list[float]]:
    """Each view put where it fits the outline best, led by odometry from its successor.

    Goes backward from the newest view: the newest stand well inside the room, the oldest may have been taken in the
    doorway, where little of the room is seen.
    """
    walls = Walls.of_polygon(outline.polygon)
    placed: list[View] = []
    matched: list[float] = []
    for view in reversed(views):
        guess, covariance = view.T_frame_base, np.diag([0.05, 0.05, 0.03]) ** 2
        if placed:
            moved = placed[-1].T_odom_base.inverse() @ view.T_odom_base
            guess = placed[-1].T_frame_base @ moved
            covariance = odometry_covariance(moved) + np.diag([2e-3, 2e-3, 5e-4]) ** 2
        found = align(view.scan.points_base, walls, guess, covariance)
        if found is None or found.matched < _WELL_MATCHED:
            found = _search(view, walls, guess) or found
        placed.append(view.moved(found.pose if found else guess))
        matched.append(found.matched if found and found.conditioned else 0.0)
    return placed[::-1], matched[::-1]
