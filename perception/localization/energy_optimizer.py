"""The energy optimizer (Concepts, section 3.7): keeps the ``rt`` edge to the robot, ten times a second.

Odometry ties successive poses. Where a room stands, the scan is aligned with its walls, and corners that pass the gate
tie poses to nominal landmarks. Without a room, or outside of it, the pose is dead-reckoned and its covariance grows.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, planar_covariance, spatial_covariance
from perception.lidar.corners import CornerSettings, confirm_lines, corners_of
from perception.lidar.slice import OutlineSlicer
from perception.localization.alignment import Alignment, AlignmentSettings, align, log_between
from perception.localization.landmarks import LandmarkSettings, match_corners
from perception.localization.motion_model import odometry_covariance
from perception.localization.pose_window import LandmarkSighting, PoseWindow, PoseWindowSettings
from perception.localization.room_model import RoomModel, room_model
from perception.ports import LidarScan
from perception.sensing import SensorBuffer
from scene_graph.edges import RtEdge
from scene_graph.errors import TransactionRejected
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]

logger = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class EnergyOptimizerSettings:
    """When a scan's alignment is believed, and what the stages of the estimate are tuned to."""

    least_matched: float = 0.25
    """Share of the returns that must lie on walls. Chosen: in a doorway about half of them do."""
    wide_gate_m: float = 0.2
    """From wider gates down to here each is six tenths of the one before. Chosen."""
    last_gates_m: tuple[float, float] = (0.12, 0.08)
    """Then these, down to four standard deviations of the usual range noise."""
    doorstep_m: float = 0.05
    """So far outside of the room the scan is still laid on its walls: errors of its outline and of the pose."""
    innovation_gate: float = 30.0
    """Chi-square of three degrees of freedom, far beyond 99.99 %: only what cannot be is refused."""
    slip: float = 0.02
    """Standard deviation, meters and radians, of what wheels may slip beyond the odometry's covariance. Chosen."""
    start_std: float = 1e-3
    """Meters and radians, added to the covariance of a pose that somebody else wrote; it may be exact."""
    floor_m: float = 0.003
    """Added to the standard deviation that is written: errors that all scans share."""
    floor_rad: float = 0.001
    """The same of the heading."""
    alignment: AlignmentSettings = field(default_factory=lambda: AlignmentSettings(floor_m=0.004))
    """``gates_m`` follow from how far off the pose may be."""
    corners: CornerSettings = field(default_factory=CornerSettings)
    landmarks: LandmarkSettings = field(default_factory=LandmarkSettings)
    window: PoseWindowSettings = field(default_factory=PoseWindowSettings)


class EnergyOptimizer:
    """Agent that localizes the robot in its parent frame."""

    name = "energy_optimizer"

    def __init__(
        self,
        memory: WorkingMemory,
        buffer: SensorBuffer,
        *,
        settings: EnergyOptimizerSettings = EnergyOptimizerSettings(),
        slicer: OutlineSlicer | None = None,
        period_s: float = 0.1,
    ) -> None:
        self.period_s = period_s
        self._memory = memory
        self._buffer = buffer
        self._settings = settings
        self._slicer = slicer or OutlineSlicer()
        self._window: PoseWindow | None = None
        self._model: RoomModel | None = None
        self._own_revision = -1
        self._odometry = Pose2.identity()
        self._stamp_s = -np.inf

    async def step(self, stamp_s: float) -> None:
        """Add the newest scan or odometry to the window and write the pose."""
        if not self._buffer.odometry or self._buffer.odometry[0].stamp_s > stamp_s:
            return
        snapshot = self._memory.snapshot()
        edge = snapshot.parent(ROBOT_ID)
        if edge is None:
            return
        newest_s = self._buffer.odometry[-1].stamp_s
        scan = self._buffer.scan
        measured_s = newest_s
        if scan is not None and self._stamp_s < scan.stamp_s <= newest_s:
            measured_s = scan.stamp_s
        else:
            scan = None
        window = self._window
        if window is None or snapshot.revision_of(edge.key) != self._own_revision:
            window = self._window = self._restart(snapshot, edge)
        if measured_s > self._stamp_s:
            self._advance(window, measured_s, scan)
        self._write(window, edge, snapshot, newest_s)

    def _restart(self, snapshot: Snapshot, edge: RtEdge) -> PoseWindow:
        """Somebody else wrote the pose: believe it."""
        oldest_s, newest_s = self._buffer.odometry[0].stamp_s, self._buffer.odometry[-1].stamp_s
        self._stamp_s = min(max(edge.stamp_s, oldest_s), newest_s)
        self._odometry = Pose2.from_se3(self._buffer.odometry_at(self._stamp_s))
        self._model = room_model(snapshot, edge.source)
        covariance = planar_covariance(edge.covariance) + np.eye(3) * self._settings.start_std**2
        landmarks = self._model.polygon if self._model else None
        return PoseWindow(Pose2.from_se3(edge.T_source_target), covariance, landmarks, self._settings.window)

    def _advance(self, window: PoseWindow, measured_s: float, scan: LidarScan | None) -> None:
        odometry = Pose2.from_se3(self._buffer.odometry_at(measured_s))
        moved = self._odometry.inverse() @ odometry
        noise = odometry_covariance(moved)
        predicted, covariance = window.predict(moved, noise)
        alignment, sightings = None, list[LandmarkSighting]()
        model = self._model
        if scan is not None and model is not None and model.depth_m(predicted.position_m) > -self._settings.doorstep_m:
            alignment, sightings = self._measure(scan, model, predicted, covariance)
        window.advance(moved, noise, sightings, alignment)
        self._odometry, self._stamp_s = odometry, measured_s

    def _measure(
        self, scan: LidarScan, model: RoomModel, predicted: Pose2, covariance: Array
    ) -> tuple[Alignment | None, list[LandmarkSighting]]:
        """What the scan says about the pose: alignment with the walls, and corners."""
        outline = self._slicer.cut(scan)
        if len(outline.points_base) < 20:
            return None, []
        settings = self._settings
        reach_m = float(np.clip(4.0 * np.sqrt(np.trace(covariance[:2, :2])), 0.2, 0.8))
        narrowing = replace(settings.alignment, gates_m=_narrowing(reach_m, settings))
        found = align(outline.points_base, model.walls, predicted, covariance, narrowing)
        if found is None or found.matched < settings.least_matched:
            return None, []
        if not _plausible(found, predicted, covariance, settings):
            return None, []
        lines = confirm_lines(outline.points_base, *_expected_lines(model, found.pose), settings.corners)
        seen = corners_of(lines, settings.corners)
        spread = np.asarray(np.linalg.inv(found.information + np.linalg.inv(covariance)), dtype=np.float64)
        return found, match_corners(model.polygon, seen, found.pose, spread, settings.landmarks)

    def _write(self, window: PoseWindow, edge: RtEdge, snapshot: Snapshot, newest_s: float) -> None:
        moved = self._odometry.inverse() @ Pose2.from_se3(self._buffer.odometry_at(newest_s))
        pose, covariance = window.predict(moved, odometry_covariance(moved))
        floor_m, floor_rad = self._settings.floor_m, self._settings.floor_rad
        written = RtEdge(
            source=edge.source,
            target=ROBOT_ID,
            T_source_target=pose.to_se3(),
            covariance=spatial_covariance(covariance + np.diag([floor_m, floor_m, floor_rad]) ** 2),
            stamp_s=newest_s,
        )
        try:
            with self._memory.edit(self.name, newest_s, expected={edge.key: snapshot.revision_of(edge.key)}) as tx:
                tx.put(written)
        except TransactionRejected as conflict:
            logger.debug("pose not written: %s", conflict)
            return
        self._own_revision = tx.snapshot.revision_of(written.key)


def _expected_lines(model: RoomModel, pose: Pose2) -> tuple[Array, Array]:
    """Normals (K, 2) and offsets (K,) of the room's walls, in the base frame at ``pose``."""
    normals = model.walls.normal @ pose.rotation()
    return normals, model.walls.offset_m - model.walls.normal @ pose.position_m


def _narrowing(reach_m: float, settings: EnergyOptimizerSettings) -> tuple[float, ...]:
    """Gates in meters from how far off the pose may be down to what noise explains."""
    gates_m = [reach_m]
    while gates_m[-1] > settings.wide_gate_m:
        gates_m.append(0.6 * gates_m[-1])
    return (*gates_m, *settings.last_gates_m)


def _plausible(found: Alignment, predicted: Pose2, covariance: Array, settings: EnergyOptimizerSettings) -> bool:
    """Mahalanobis gate on the innovation, with a tolerance for wheel slip."""
    innovation = log_between(predicted, found.pose)
    slack = covariance + np.eye(3) * settings.slip**2
    return float(innovation @ np.linalg.solve(slack, innovation)) < settings.innovation_gate
