"""Measuring one room: views are collected while the robot moves, then solved for poses and outline together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, diagonal_covariance, wrap
from perception.geometry.walls import Walls
from perception.lidar.slice import OutlineScan
from perception.localization.alignment import Alignment, AlignmentSettings, align
from perception.localization.motion_model import odometry_covariance
from perception.ports import RobotShape
from perception.rooms.outline.freeform import FreeformSettings, freeform_outline
from perception.rooms.outline.outline import Outline, OutlineSettings, find_outline
from perception.rooms.survey.pose_graph import PoseGraphSettings, VotedCorner, optimize
from perception.rooms.views.view import View, ViewSettings

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class MeasurementSettings:
    """How much is kept and how often it is refined, and the stages of it."""

    views: int = 60
    """At most this many are kept. Chosen: for speed."""
    rounds: int = 2
    """Of poses from outline and outline from poses. Chosen."""
    step_m: float = 0.08
    """Views closer together than this, and than the turn, are kept only up to some in a row. Chosen."""
    step_rad: float = 0.10
    """Turn between views."""
    resting_views: int = 12
    """Kept from one place. Chosen."""
    well_matched: float = 0.6
    """Share of returns on the outline from which on a view fits. Chosen: furniture as high as the slice hides some."""
    vague_m: float = 0.4
    """Standard deviation of where a view is searched for that does not fit: after a long way odometry leads astray."""
    vague_rad: float = 0.25
    """And of its heading."""
    turns_rad: tuple[float, ...] = (0.0, 0.08, -0.08, 0.16, -0.16)
    """Headings that such a search begins from. Chosen: an alignment finds what is nearer than half of the steps."""
    view: ViewSettings = field(default_factory=ViewSettings)
    pose_graph: PoseGraphSettings = field(default_factory=PoseGraphSettings)
    alignment: AlignmentSettings = field(default_factory=AlignmentSettings)
    wide: AlignmentSettings = field(
        default_factory=lambda: AlignmentSettings(gates_m=(0.6, 0.4, 0.25, 0.15, 0.10, 0.08))
    )
    """Of the search: from one and a half of its standard deviations down to what noise explains."""
    outline: OutlineSettings = field(default_factory=OutlineSettings)
    freeform: FreeformSettings = field(default_factory=FreeformSettings)


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


class RoomMeasurement:
    """Collects views of one room. ``T_parent_base`` of each view is what the graph said when it was taken."""

    def __init__(self, settings: MeasurementSettings = MeasurementSettings(), shape: RobotShape = RobotShape()) -> None:
        self.settings, self._shape = settings, shape
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
        self._views.append(View.of(scan, first.inverse() @ T_odom_base, T_odom_base, self.settings.view))
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
        solution = optimize(self._views, self.settings.pose_graph)
        views = [view.moved(pose) for view, pose in zip(self._views, solution.poses, strict=True)]
        outline = _find(views, self.settings, self._shape)
        matched = [0.0] * len(views)
        for _ in range(self.settings.rounds):
            if outline is None:
                return None
            views, matched = _align_all(views, outline, self.settings)
            outline = _find(views, self.settings, self._shape)
        if outline is None:
            return None
        return Fit(
            outline=outline,
            views=tuple(views),
            in_parent=tuple(self._in_parent),
            matched=tuple(matched),
            corners=solution.corners,
        )


def _find(views: Sequence[View], settings: MeasurementSettings, shape: RobotShape) -> Outline | None:
    """The rectilinear outline, or where walls are not at right angles what one view shows."""
    outline, closure = find_outline(views, settings.outline, shape), settings.outline.closure
    if outline is not None and outline.rectilinear > closure.rectilinear:
        return outline
    return freeform_outline(views, settings.freeform, closure) or outline


def _search(view: View, walls: Walls, guess: Pose2, settings: MeasurementSettings) -> Alignment | None:
    """The pose near ``guess``, or where the pose graph had the view, at which it fits well; after a long way between
    two views odometry leads astray.
    """
    vague = diagonal_covariance(settings.vague_m, settings.vague_m, settings.vague_rad)
    found = [
        align(view.scan.points_base, walls, origin @ Pose2(0.0, 0.0, turn_rad), vague, settings.wide)
        for origin in (guess, view.T_frame_base)
        for turn_rad in settings.turns_rad
    ]
    best = max((one for one in found if one is not None), key=lambda one: one.matched, default=None)
    return best if best is not None and best.matched >= settings.well_matched else None


def _align_all(
    views: Sequence[View], outline: Outline, settings: MeasurementSettings
) -> tuple[list[View], list[float]]:
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
        found = align(view.scan.points_base, walls, guess, covariance, settings.alignment)
        if found is None or found.matched < settings.well_matched:
            found = _search(view, walls, guess, settings) or found
        placed.append(view.moved(found.pose if found else guess))
        matched.append(found.matched if found and found.conditioned else 0.0)
    return placed[::-1], matched[::-1]
