"""Global localization: in which known room, and where in it, could a scan have been taken?

Lines of the scan are laid on walls of every room in all ways that fit, which covers each turn of a rectangular, L-, T-
or U-shaped room. What the walls leave open is decided by doors. Rooms and poses that explain the views equally well
stay side by side as weighted hypotheses, and nothing is decided between them.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, diagonal_covariance, wrap
from perception.lidar.corners import CornerSettings, detect_lines
from perception.lidar.slice import OutlineScan
from perception.localization.alignment import AlignmentSettings, align
from perception.localization.doorways import DoorwayFit, DoorwayModel, DoorwaySettings, doorway_fit, doorway_model
from perception.localization.measurement_model import MeasurementModelSettings, ScanFit, fit_of
from perception.localization.pose_candidates import PoseCandidateSettings, pose_candidates
from perception.localization.room_model import RoomModel, room_model
from perception.ports import LidarScan
from scene_graph.nodes import RoomNode
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Sight:
    """One scan, its slice above furniture and doors, and where it was taken by odometry alone."""

    scan: LidarScan
    outline: OutlineScan
    T_odom_base: Pose2


@dataclass(frozen=True, kw_only=True, eq=False)
class KnownRoom:
    """A room that the robot may be in, with its doors, and the share of a scan that its outline usually explains."""

    room: RoomModel
    doors: DoorwayModel
    usual: float = 1.0


@dataclass(frozen=True, kw_only=True)
class GlobalLocalizationSettings:
    """What counts how much, and what is asked of a hypothesis to be believed."""

    independent_returns: float = 60.0
    """How many of a scan's returns err independently: neighbors meet the same furniture. Chosen."""
    strange_gap: float = 12.0
    """Natural logarithm of the odds against a gap where a room has wall. Chosen: one decides alone."""
    shut_door: float = 3.0
    """The same against a door found shut. Chosen: one in twenty."""
    shut_doors: float = 5.0
    """The same against any number of them, which must not decide alone."""
    tries: int = 8
    """Poses refined per room: a rectangle has four that look alike. Chosen."""
    plausible: float = 0.6
    """Least share explained of a hypothesis that is kept. Chosen: furniture as high as walls hides some."""
    explained: float = 0.9
    """Of what is usual in the room, for one that is believed. Chosen."""
    passed: float = 0.02
    """Largest share behind walls of one that is believed: grazing rays at corners."""
    weight: float = 0.999
    """Least probability of one that is believed. Chosen: a wrong place is worse than another look."""
    spread_m: float = 0.15
    """Standard deviation of a candidate's position: the cell in which candidates are one."""
    spread_rad: float = 0.05
    """And of its heading: half the angle within which they are one."""
    same_m: float = 0.15
    """Refined positions this near are one place."""
    same_rad: float = 0.06
    """And headings."""
    drift_per_m: float = 0.02
    """Error of odometry between two views, a share of the way: twice the usual one percent (design, section 5)."""
    corners: CornerSettings = field(default_factory=CornerSettings)
    candidates: PoseCandidateSettings = field(default_factory=PoseCandidateSettings)
    alignment: AlignmentSettings = field(
        default_factory=lambda: AlignmentSettings(gates_m=(0.4, 0.25, 0.15, 0.12, 0.12))
    )
    """From twice the distance of candidates down to what noise and the outline's errors explain."""
    model: MeasurementModelSettings = field(default_factory=MeasurementModelSettings)
    doorways: DoorwaySettings = field(default_factory=DoorwaySettings)


@dataclass(frozen=True, kw_only=True)
class Hypothesis:
    """A place where the views could have been taken.

    ``T_room_base``: at the newest view. ``fit``: the worst over the views, ``doorways`` the most over them.
    ``usual``: share that is usually explained in that room. ``evidence``: log-likelihood. ``weight``: probability
    among all hypotheses.
    """

    room_id: str
    T_room_base: Pose2
    fit: ScanFit
    doorways: DoorwayFit
    usual: float
    conditioned: bool
    evidence: float
    weight: float = 0.0

    def same_as(self, other: Hypothesis, settings: GlobalLocalizationSettings = GlobalLocalizationSettings()) -> bool:
        """Whether both name the same place."""
        turned = abs(wrap(self.T_room_base.yaw_rad - other.T_room_base.yaw_rad))
        near = self.T_room_base.distance_m(other.T_room_base) < settings.same_m and turned < settings.same_rad
        return self.room_id == other.room_id and near


def known_rooms(snapshot: Snapshot, usual: Mapping[str, float] | None = None) -> list[KnownRoom]:
    """All rooms that stand; ``usual`` tells for some what share of a scan their outline usually explains."""
    usual = usual or {}
    models = [room_model(snapshot, room.id) for room in snapshot.of_type(RoomNode)]
    return [
        KnownRoom(room=model, doors=doorway_model(snapshot, model), usual=usual.get(model.room_id, 1.0))
        for model in models
        if model is not None
    ]


def hypotheses(
    sights: Sequence[Sight],
    rooms: Sequence[KnownRoom],
    settings: GlobalLocalizationSettings = GlobalLocalizationSettings(),
) -> list[Hypothesis]:
    """All places that explain the views, most likely first. The newest of ``sights`` is last."""
    newest = sights[-1].outline
    if len(newest.points_base) < 20:
        return []
    lines = detect_lines(newest.points_base, settings.corners.for_noise(newest.noise_m))
    found: list[Hypothesis] = []
    for known in rooms:
        for guess in pose_candidates(newest, lines, known.room, settings.candidates)[: settings.tries]:
            one = _judged(sights, known, guess, settings)
            if one is not None and not any(one.same_as(other, settings) for other in found):
                found.append(one)
    return _weighted(found)


def decide(
    found: Sequence[Hypothesis], settings: GlobalLocalizationSettings = GlobalLocalizationSettings()
) -> Hypothesis | None:
    """The one hypothesis that can be believed, ``None`` while several can or none fits."""
    if not found:
        return None
    best = found[0]
    fits = best.fit.explained >= settings.explained * best.usual and best.fit.passed <= settings.passed
    certain = best.weight >= settings.weight and best.conditioned and best.doorways.strange == 0
    return best if fits and certain else None


def _judged(
    sights: Sequence[Sight], known: KnownRoom, guess: Pose2, settings: GlobalLocalizationSettings
) -> Hypothesis | None:
    """The guess, aligned with the newest view and judged by all of them; ``None`` when it is not plausible."""
    newest = sights[-1]
    aligned = align(
        newest.outline.points_base,
        known.room.walls,
        guess,
        diagonal_covariance(settings.spread_m, settings.spread_m, settings.spread_rad),
        settings.alignment,
    )
    if aligned is None or not known.room.contains(aligned.pose.position_m):
        return None
    fits, doorways = [], []
    for sight in sights:
        moved = newest.T_odom_base.inverse() @ sight.T_odom_base
        way_m = float(np.hypot(moved.x_m, moved.y_m))
        model = replace(settings.model, slack_m=settings.model.slack_m + settings.drift_per_m * way_m)
        T_room_base = aligned.pose @ moved
        fits.append(fit_of(sight.outline, known.room.walls, known.doors.openings, T_room_base, model))
        if fits[-1].explained < settings.plausible:
            return None
        doorways.append(doorway_fit(sight.scan, known.doors, T_room_base, settings.doorways))
    worst = ScanFit(
        explained=min(fit.explained for fit in fits),
        passed=max(fit.passed for fit in fits),
        cost=float(np.mean([fit.cost for fit in fits])),
    )
    most = DoorwayFit(
        open=max(one.open for one in doorways),
        shut=max(one.shut for one in doorways),
        strange=max(one.strange for one in doorways),
    )
    return Hypothesis(
        room_id=known.room.room_id,
        T_room_base=aligned.pose,
        fit=worst,
        doorways=most,
        usual=known.usual,
        conditioned=aligned.conditioned,
        evidence=_evidence(worst, most, settings),
    )


def _evidence(fit: ScanFit, doorways: DoorwayFit, settings: GlobalLocalizationSettings) -> float:
    shut = min(settings.shut_door * doorways.shut, settings.shut_doors)
    return -settings.independent_returns * fit.cost - settings.strange_gap * doorways.strange - shut


def _weighted(found: Sequence[Hypothesis]) -> list[Hypothesis]:
    """Normalized over all hypotheses, most likely first."""
    if not found:
        return []
    evidence = np.array([one.evidence for one in found])
    likelihood = np.exp(evidence - evidence.max())
    weights = (likelihood / likelihood.sum()).tolist()
    weighted = [replace(one, weight=weight) for one, weight in zip(found, weights, strict=True)]
    return sorted(weighted, key=lambda one: -one.weight)
