"""Temporal pose graph of the approach to a room: odometry between views, corners as landmarks (Concepts, 3.5.1)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import gtsam
import numpy as np
from gtsam.symbol_shorthand import L, X
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.localization.motion_model import odometry_covariance
from perception.rooms.views.view import View

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PoseGraphSettings:
    """Which sightings are of one corner, and what they are worth."""

    same_corner_m: float = 0.35
    """Farthest from a track's mean, by dead reckoning. Chosen: less than a nook is wide."""
    sighting_floor_m: float = 0.005
    """Error of a corner that its lines' returns do not tell. Chosen."""
    huber: float = 1.5
    """Standard deviations from which on a sighting counts less: near the usual 1.345."""


@dataclass(frozen=True, kw_only=True, eq=False)
class VotedCorner:
    """A corner landmark after optimization: ``point`` (2,) in the frame of the views, and how many views saw it."""

    point: Array
    votes: int


@dataclass(frozen=True, kw_only=True, eq=False)
class Solution:
    """Optimized poses, one per view, and corners."""

    poses: tuple[Pose2, ...]
    corners: tuple[VotedCorner, ...]


def optimize(views: Sequence[View], settings: PoseGraphSettings = PoseGraphSettings()) -> Solution:
    """Poses and corners that explain odometry and corner sightings best; the first view stays where it is."""
    tracks = _associate(views, settings.same_corner_m)
    graph = gtsam.NonlinearFactorGraph()
    values = gtsam.Values()
    graph.add(gtsam.PriorFactorPose2(X(0), _pose(views[0].T_frame_base), gtsam.noiseModel.Isotropic.Sigma(3, 1e-5)))
    for k, view in enumerate(views):
        values.insert(X(k), _pose(view.T_frame_base))
        if k > 0:
            moved = views[k - 1].T_odom_base.inverse() @ view.T_odom_base
            noise = gtsam.noiseModel.Gaussian.Covariance(odometry_covariance(moved))
            graph.add(gtsam.BetweenFactorPose2(X(k - 1), X(k), _pose(moved), noise))
    for j, track in enumerate(tracks):
        values.insert(L(j), track.point)
        for k, index in track.sightings:
            _add_sighting(graph, views[k], k, index, j, settings)
    result = gtsam.LevenbergMarquardtOptimizer(graph, values).optimize()
    poses = [result.atPose2(X(k)) for k in range(len(views))]
    return Solution(
        poses=tuple(Pose2(pose.x(), pose.y(), pose.theta()) for pose in poses),
        corners=tuple(
            VotedCorner(point=np.asarray(result.atPoint2(L(j))), votes=len(track.sightings))
            for j, track in enumerate(tracks)
        ),
    )


@dataclass(kw_only=True)
class _Track:
    """Sightings (view, index of the corner in it) taken for the same corner; ``point`` is their running mean."""

    point: Array
    sightings: list[tuple[int, int]]


def _associate(views: Sequence[View], same_corner_m: float) -> list[_Track]:
    """Corners of successive views that lie close together by dead reckoning; tracks with one sighting are dropped."""
    tracks: list[_Track] = []
    for k, view in enumerate(views):
        for index, sighting in enumerate(view.corners):
            point = view.T_frame_base.apply(sighting.point)
            nearest = min(tracks, key=lambda track: float(np.linalg.norm(track.point - point)), default=None)
            if nearest is None or float(np.linalg.norm(nearest.point - point)) > same_corner_m:
                tracks.append(_Track(point=point, sightings=[(k, index)]))
            elif all(seen != k for seen, _ in nearest.sightings):
                nearest.sightings.append((k, index))
                nearest.point = nearest.point + (point - nearest.point) / len(nearest.sightings)
    return [track for track in tracks if len(track.sightings) > 1]


def _add_sighting(
    graph: gtsam.NonlinearFactorGraph, view: View, k: int, index: int, landmark: int, settings: PoseGraphSettings
) -> None:
    sighting = view.corners[index]
    distance = max(float(np.linalg.norm(sighting.point)), 0.2)
    std_m = float(np.hypot(sighting.std_m, settings.sighting_floor_m))
    noise = gtsam.noiseModel.Robust.Create(
        gtsam.noiseModel.mEstimator.Huber.Create(settings.huber),
        gtsam.noiseModel.Diagonal.Sigmas(np.array([std_m / distance, std_m])),
    )
    bearing = gtsam.Rot2(float(np.arctan2(sighting.point[1], sighting.point[0])))
    graph.add(gtsam.BearingRangeFactor2D(X(k), L(landmark), bearing, distance, noise))


def _pose(pose: Pose2) -> gtsam.Pose2:
    return gtsam.Pose2(pose.x_m, pose.y_m, pose.yaw_rad)
