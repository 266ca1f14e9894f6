"""One attempt to measure a room: the views, the fits so far, whether they suffice, and where to look from next."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.polygon import inside, shared_area
from perception.lidar.slice import OutlineScan
from perception.localization.robot_pose import RobotPose
from perception.localization.room_model import RoomModel
from perception.ports import RobotShape
from perception.rooms.survey.hypotheses import HypothesesSettings, OutlineHypotheses
from perception.rooms.survey.instance import InstanceSettings, MeasuredRoom, measured_room
from perception.rooms.survey.measurement import Fit, MeasurementSettings, RoomMeasurement
from perception.rooms.survey.vantage import VantageSettings, freest_way, next_vantage

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class SurveySettings:
    """Priors and patience, and the stages of a survey."""

    shortest_side_m: float = 0.9
    """Of the bounding rectangle: the robot hardly fits into less."""
    longest_side_m: float = 45.0
    """The same: a LiDAR does not see farther."""
    views: int = 8
    """Least number for a room. Chosen: nearly a second."""
    agree_m: float = 0.012
    """Two successive fits must agree this well. Chosen: about what a room's walls may be off."""
    wall_std_m: float = 0.004
    """Of every wall. Chosen."""
    surrounded: float = 0.7
    """Share of directions with anything in them below which the robot stands outdoors. Chosen."""
    least_matched: float = 0.3
    """Share of returns on the outline in a view that may tie the room to where the robot came from; in a doorway about
    half of them are."""
    solve_every_s: float = 0.5
    """Between fits, more with many views. Chosen: one takes tens to hundreds of milliseconds."""
    feels: int = 4
    """How often the robot drives on where nothing fits. Chosen."""
    shared: float = 0.2
    """Share of the known room that a new one may cover: errors of both outlines and the pose."""
    measurement: MeasurementSettings = field(default_factory=MeasurementSettings)
    hypotheses: HypothesesSettings = field(default_factory=HypothesesSettings)
    vantage: VantageSettings = field(default_factory=VantageSettings)
    instance: InstanceSettings = field(default_factory=InstanceSettings)


class Survey:
    """Collects views of the room that the robot stands in and judges them.

    Attributes:
        fit: newest fit that is plausible, or what ``decide`` chose, in the frame of the first view.
        hypotheses: what the room may look like, with weights.
        places: vantage points proposed so far, same frame.
        known: the room that the robot came from, in its parent frame.
    """

    def __init__(self, settings: SurveySettings = SurveySettings(), shape: RobotShape = RobotShape()) -> None:
        self.settings, self._shape = settings, shape
        self.fit: Fit | None = None
        self.known: RoomModel | None = None
        self.places: list[Array] = []
        self.hypotheses = OutlineHypotheses(settings=settings.hypotheses)
        self._settled = False
        self._measurement = RoomMeasurement(settings.measurement, shape)
        self._first: RobotPose | None = None
        self._solved_s = -np.inf
        self._solved_views = 0
        self._added = 0
        self._felt = 0
        self._surrounded: list[float] = []

    @property
    def started(self) -> bool:
        return self._first is not None

    @property
    def parent(self) -> str | None:
        """The frame in which the robot was when the survey began."""
        return self._first.parent if self._first else None

    def add(self, scan: OutlineScan, pose: RobotPose) -> None:
        """Take in a view."""
        self._first = self._first or pose
        self._added += 1
        self._surrounded.append(scan.surrounded)
        self._measurement.add(scan, pose.T_odom_base, pose.T_parent_base)

    def due(self, stamp_s: float) -> bool:
        """Whether enough is new since the last fit."""
        period_s = self.settings.solve_every_s * (1.0 + len(self._measurement.views) / 20.0)
        return self._added >= 3 and self._added > self._solved_views and stamp_s >= self._solved_s + period_s

    def solve(self, stamp_s: float) -> None:
        """Fit all views (tens to hundreds of milliseconds)."""
        self._solved_s, self._solved_views = stamp_s, self._added
        fit = self._measurement.solve()
        previous = self.fit
        self.fit = fit if fit is not None and self._plausible(fit) else None
        if self.fit is not None:
            self.hypotheses.add(self.fit)
        self._settled = self._agrees_with(previous)
        if self.fit is None or self._settled or self.hypotheses.crowded:
            self.hypotheses.weigh(self._measurement.views)

    def _plausible(self, fit: Fit) -> bool:
        """Whether the outline has the size of a room and the robot is in it, not in front of it."""
        if not inside(fit.outline.polygon, fit.views[-1].T_frame_base.position_m):
            return False
        polygon = Pose2(0.0, 0.0, -fit.outline.direction_rad).apply(fit.outline.polygon)
        sides = np.ptp(polygon, axis=0)
        fits = sides.min() > self.settings.shortest_side_m and sides.max() < self.settings.longest_side_m
        return bool(fits and not self._holds_known_room(fit))

    def _holds_known_room(self, fit: Fit) -> bool:
        """Whether the outline takes in the room that the robot came from; from under a lintel both look like one."""
        if self.known is None:
            return False
        placed = (fit.views[-1].T_frame_base @ fit.in_parent[-1].inverse()).apply(self.known.polygon)
        known, _, both = shared_area(placed, fit.outline.polygon)
        return both > self.settings.shared * known

    @property
    def closed(self) -> bool:
        """Whether the newest fit has walls all around."""
        return self.fit is not None and self.fit.outline.closed and self._added >= self.settings.views

    @property
    def sufficient(self) -> bool:
        """Whether going on would not make the room better: the fits agree, and no other outline is as likely."""
        return self._settled and self.hypotheses.decided and self.hypotheses.best is self.fit

    def _agrees_with(self, previous: Fit | None) -> bool:
        """Whether the newest fit is closed, sharp, and the same as the one before."""
        if self.fit is None or previous is None or not self.closed:
            return False
        now, before = self.fit.outline.polygon, previous.outline.polygon
        if now.shape != before.shape:
            return False
        change = np.linalg.norm(now[:, None] - before[None], axis=2).min(axis=1).max()
        return bool(change < self.settings.agree_m and self.fit.outline.offset_std_m.max() < self.settings.wall_std_m)

    def decide(self) -> None:
        """Let all views decide between the outlines that are possible; the newest stays unless another is clearer."""
        self.hypotheses.weigh(self._measurement.views)
        if self.fit is None or self.hypotheses.decided:
            self.fit = self.hypotheses.best

    @property
    def outdoors(self) -> bool:
        """Whether what is around looks like no room: too few walls within range in the last views."""
        recent = self._surrounded[-5:]
        return not self.closed and len(recent) == 5 and max(recent) < self.settings.surrounded

    def next_place(self, obstacles_base: Array, pose: RobotPose) -> Pose2 | None:
        """The next vantage point as a place in the robot's base frame; remembered as proposed."""
        if self.fit is None:
            return self._feel_the_way(obstacles_base)
        T_frame_base = self._now(self.fit, pose)
        obstacles = T_frame_base.apply(obstacles_base)
        place = next_vantage(
            self.fit.outline, obstacles, self.places, T_frame_base.position_m, self.settings.vantage, self._shape
        )
        if place is None:
            return None
        self.places.append(place)
        local = T_frame_base.inverse().apply(place)
        return Pose2(float(local[0]), float(local[1]), 0.0)

    def _feel_the_way(self, obstacles_base: Array) -> Pose2 | None:
        """Where to look from when the views fit no room yet, a few times."""
        if self._solved_views < self.settings.views or self._felt >= self.settings.feels:
            return None
        place = freest_way(obstacles_base, self.settings.vantage, self._shape)
        if place is None:
            return None
        self._felt += 1
        return Pose2(float(place[0]), float(place[1]), 0.0)

    def measured(self, pose: RobotPose) -> MeasuredRoom | None:
        """The room in its own frame, with the robot at ``pose`` in it."""
        fit = self.fit
        if fit is None or self._first is None:
            return None
        T_view_base = fit.views[-1].T_odom_base.inverse() @ pose.T_odom_base
        return measured_room(
            fit,
            self._first.covariance,
            T_view_base,
            least_matched=self.settings.least_matched,
            settings=self.settings.instance,
        )

    @staticmethod
    def _now(fit: Fit, pose: RobotPose) -> Pose2:
        newest = fit.views[-1]
        return newest.T_frame_base @ newest.T_odom_base.inverse() @ pose.T_odom_base
