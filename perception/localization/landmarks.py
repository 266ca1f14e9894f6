"""Nominal corners and door posts of the current room, and their association with what the scan shows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.lidar.corners import CornerSighting
from perception.localization.pose_window import LandmarkSighting

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class LandmarkSettings:
    """How corners are taken for those of the room."""

    gate: float = 9.21
    """Chi-square of two degrees of freedom at 99 %."""
    sighting_floor_m: float = 0.008
    """Error of a corner that its lines' returns do not tell: measured walls are off by some millimeters."""


def match_corners(
    nominal: Array,
    sightings: Sequence[CornerSighting],
    pose: Pose2,
    covariance: Array,
    settings: LandmarkSettings = LandmarkSettings(),
) -> list[LandmarkSighting]:
    """Sightings that pass the Mahalanobis gate of a nominal corner, at most one for each (Concepts, section 3.7)."""
    matches: list[LandmarkSighting] = []
    if len(sightings) == 0:
        return matches
    points = np.array([sighting.point for sighting in sightings])
    stds = np.hypot([sighting.std_m for sighting in sightings], settings.sighting_floor_m)
    predicted = pose.inverse().apply(nominal)
    for index, expected in enumerate(predicted):
        jacobian = np.array([[-1.0, 0.0, expected[1]], [0.0, -1.0, -expected[0]]])
        (xx, xy), (_, yy) = jacobian @ covariance @ jacobian.T
        dx, dy = (points - expected).T
        var_x, var_y = xx + stds**2, yy + stds**2
        distances = 2.0 * (var_y * dx**2 - 2.0 * xy * dx * dy + var_x * dy**2) / (var_x * var_y - xy**2)
        best = int(np.argmin(distances))
        if distances[best] < settings.gate:
            matches.append(LandmarkSighting(index=index, point=points[best], std_m=float(stds[best])))
    return matches
