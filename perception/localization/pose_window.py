"""Sliding window of robot poses over fixed landmarks (Concepts, section 3.7): iSAM2 with a fixed lag."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import SupportsFloat, SupportsIndex, SupportsInt

import gtsam
import numpy as np
from gtsam.symbol_shorthand import L, X
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.localization.alignment import Alignment

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PoseWindowSettings:
    """Size of the window and what its factors are worth."""

    poses: int = 30
    """As many as are kept, three seconds of them. Chosen."""
    nominal_std_m: float = 0.003
    """How far a corner of a measured room may be off. Chosen: some millimeters."""
    relinearize_at: float = 0.002
    """Change of a variable, meters or radians, from which iSAM2 linearizes anew. Chosen: below what is measured."""
    huber: float = 1.5
    """Standard deviations from which on a corner counts less: near the usual 1.345."""


@dataclass(frozen=True, kw_only=True, eq=False)
class LandmarkSighting:
    """Landmark ``index`` seen at ``point`` (2,) of the base frame with standard deviation ``std_m``."""

    index: int
    point: Array
    std_m: float


class PoseWindow:
    """The last poses of the robot in one parent frame, tied by odometry, landmarks and scan alignments."""

    def __init__(
        self,
        pose: Pose2,
        covariance: Array,
        landmarks: Array | None = None,
        settings: PoseWindowSettings = PoseWindowSettings(),
    ) -> None:
        """``covariance``: (3, 3) of ``pose`` in the base frame. ``landmarks``: (N, 2) nominal, parent frame."""
        parameters = gtsam.ISAM2Params()
        parameters.setRelinearizeThreshold(settings.relinearize_at)
        parameters.relinearizeSkip = 1
        parameters.setFactorization("QR")  # Cholesky fails where a vague pose meets sharp odometry
        self._smoother = gtsam.IncrementalFixedLagSmoother(settings.poses - 0.5, parameters)
        self._settings = settings
        self._landmarks = np.empty((0, 2)) if landmarks is None else landmarks
        self._known: set[int] = set()
        self._count = 0
        self.pose = pose
        self.covariance = covariance
        graph, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        graph.add(gtsam.PriorFactorPose2(X(0), to_gtsam(pose), gtsam.noiseModel.Gaussian.Covariance(covariance)))
        values.insert(X(0), to_gtsam(pose))
        self._update(graph, values)

    def predict(self, moved: Pose2, covariance: Array) -> tuple[Pose2, Array]:
        """Pose after a motion with (3, 3) covariance, and its covariance, before anything was measured."""
        adjoint = moved.inverse().adjoint()
        return self.pose @ moved, adjoint @ self.covariance @ adjoint.T + covariance

    def advance(
        self,
        moved: Pose2,
        covariance: Array,
        sightings: Sequence[LandmarkSighting] = (),
        alignment: Alignment | None = None,
    ) -> None:
        """Add the pose after ``moved`` with what was measured there; the oldest pose leaves the window."""
        self._count += 1
        key = X(self._count)
        graph, values = gtsam.NonlinearFactorGraph(), gtsam.Values()
        noise = gtsam.noiseModel.Gaussian.Covariance(covariance)
        graph.add(gtsam.BetweenFactorPose2(X(self._count - 1), key, to_gtsam(moved), noise))
        values.insert(key, to_gtsam(alignment.pose if alignment else self.pose @ moved))
        if alignment is not None:
            information = gtsam.noiseModel.Gaussian.Information(alignment.information)
            graph.add(gtsam.PriorFactorPose2(key, to_gtsam(alignment.pose), information))
        for sighting in sightings:
            self._add_landmark(graph, values, sighting.index)
            graph.add(_sighting_factor(key, sighting, self._settings.huber))
        self._update(graph, values)

    def _add_landmark(self, graph: gtsam.NonlinearFactorGraph, values: gtsam.Values, index: int) -> None:
        if index in self._known:
            return
        self._known.add(index)
        nominal = self._landmarks[index]
        values.insert(L(index), nominal)
        noise = gtsam.noiseModel.Isotropic.Sigma(2, self._settings.nominal_std_m)
        graph.add(gtsam.PriorFactorPoint2(L(index), nominal, noise))

    def _update(self, graph: gtsam.NonlinearFactorGraph, values: gtsam.Values) -> None:
        now = float(self._count)
        stamps: dict[SupportsInt | SupportsIndex, SupportsFloat | SupportsIndex] = {X(self._count): now}
        stamps.update({L(index): now for index in sorted(self._known)})
        self._smoother.update(graph, values, stamps)
        self.pose = from_gtsam(self._smoother.calculateEstimatePose2(X(self._count)))
        covariance = np.asarray(self._smoother.marginalCovariance(X(self._count)))
        self.covariance = (covariance + covariance.T) / 2.0


def _sighting_factor(key: int, sighting: LandmarkSighting, huber: float) -> gtsam.BearingRangeFactor2D:
    distance = max(float(np.linalg.norm(sighting.point)), 0.2)
    noise = gtsam.noiseModel.Robust.Create(
        gtsam.noiseModel.mEstimator.Huber.Create(huber),
        gtsam.noiseModel.Diagonal.Sigmas(np.array([sighting.std_m / distance, sighting.std_m])),
    )
    bearing = gtsam.Rot2(float(np.arctan2(sighting.point[1], sighting.point[0])))
    return gtsam.BearingRangeFactor2D(key, L(sighting.index), bearing, distance, noise)


def to_gtsam(pose: Pose2) -> gtsam.Pose2:
    """The pose in GTSAM's own type."""
    return gtsam.Pose2(pose.x_m, pose.y_m, pose.yaw_rad)


def from_gtsam(pose: gtsam.Pose2) -> Pose2:
    """A pose of GTSAM in ours."""
    return Pose2(pose.x(), pose.y(), pose.theta())
