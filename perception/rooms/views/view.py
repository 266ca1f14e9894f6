"""What the robot saw of a room from several places, brought into one frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.lidar.corners import CornerSettings, CornerSighting, WallLine, corners_of, detect_lines
from perception.lidar.slice import OutlineScan

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class ViewSettings:
    """What is made of one view, and how the direction of the walls is told from all."""

    grazing: float = 0.12
    """Cosine of incidence below which a ray says nothing about passing a line. Chosen: seven degrees."""
    near_direction_rad: float = float(np.deg2rad(6.0))
    """Lines this near to the walls' direction refine it. Chosen: several times a line's error."""
    agreeing_rad: float = float(np.deg2rad(3.0))
    """And this near they agree with it. Chosen."""
    corners: CornerSettings = field(default_factory=CornerSettings)


@dataclass(frozen=True, kw_only=True, eq=False)
class View:
    """One outline scan with the pose it was taken from.

    ``T_frame_base``: where the base was, in whatever frame the views share. ``T_odom_base``: by odometry alone.
    ``lines`` and ``corners`` are in the base frame.
    """

    T_frame_base: Pose2
    T_odom_base: Pose2
    scan: OutlineScan
    lines: tuple[WallLine, ...]
    corners: tuple[CornerSighting, ...]
    settings: ViewSettings = ViewSettings()

    @classmethod
    def of(
        cls, scan: OutlineScan, T_frame_base: Pose2, T_odom_base: Pose2, settings: ViewSettings = ViewSettings()
    ) -> View:
        """The view of ``scan``, with its lines and corners detected."""
        corners = settings.corners.for_noise(scan.noise_m)
        lines = detect_lines(scan.points_base, corners)
        return cls(
            T_frame_base=T_frame_base,
            T_odom_base=T_odom_base,
            scan=scan,
            lines=tuple(lines),
            corners=tuple(corners_of(lines, corners)),
            settings=settings,
        )

    def moved(self, T_frame_base: Pose2) -> View:
        """The same view from another pose."""
        return replace(self, T_frame_base=T_frame_base)

    def points_frame(self) -> Array:
        """(N, 2) wall returns in the common frame."""
        return self.T_frame_base.apply(self.scan.points_base)

    def beyond(self, points: Array) -> tuple[Array, Array, Array]:
        """How far (N,) beyond each of (N, 2) ``points`` of the common frame the wall in its direction is.

        ``nan`` where nothing returned. Also the unit directions (N, 2) from the sensor in the common frame, and the
        distances (N,) of the points from it.
        """
        origin = self.T_frame_base.apply(self.scan.origin_base)
        offset = points - origin
        distance = np.linalg.norm(offset, axis=1)
        azimuths = self.scan.azimuths_rad
        step = 2.0 * np.pi / len(azimuths)
        bearing = np.arctan2(offset[:, 1], offset[:, 0]) - self.T_frame_base.yaw_rad
        index = np.rint((bearing - azimuths[0]) / step).astype(np.int64) % len(azimuths)
        ranges = self.scan.ranges_m[index]
        beyond = np.where(np.isfinite(ranges), ranges - distance, np.nan)
        return beyond, offset / np.maximum(distance, 1e-6)[:, None], distance

    def clearance(self, points: Array, normals: Array, margin_m: float) -> tuple[Array, Array]:
        """How far (N,) rays go beyond lines with unit ``normals`` (2,) or (N, 2) at (N, 2) ``points``, across the line.

        ``nan`` where a ray does not tell: nothing returned, it grazes the line, or the point is so near, but for
        ``margin_m``, that the ray may pass below a door's lintel. Also the cosines (N,) between rays and normals.
        """
        beyond, direction, distance = self.beyond(points)
        incidence = (direction * normals).sum(axis=1)
        tells = (np.abs(incidence) > self.settings.grazing) & (distance > self.scan.blind_m + margin_m)
        return np.where(tells, beyond * np.abs(incidence), np.nan), incidence


def dominant_direction(views: Sequence[View]) -> tuple[float, float]:
    """Direction of the walls modulo a quarter turn, in (-pi/4, pi/4], and the share of wall length that agrees.

    Each line votes with its length at four times its angle, which makes the four directions of a rectilinear room one.
    """
    settings = views[-1].settings
    angles = np.array(
        [view.T_frame_base.yaw_rad + np.arctan2(*line.direction[::-1]) for view in views for line in view.lines]
    )
    lengths = np.array([line.length_m for view in views for line in view.lines])
    if len(angles) == 0:
        return 0.0, 0.0
    strongest = 4.0 * angles[int(np.argmax(lengths))]
    phase = float(np.angle((lengths * np.exp(1j * 4.0 * angles)).sum())) if len(angles) > 1 else strongest
    for _ in range(3):
        off = np.angle(np.exp(1j * (4.0 * angles - phase)))
        near = np.abs(off) < 4.0 * settings.near_direction_rad
        if not near.any():
            phase = strongest
            continue
        phase += float((lengths * off)[near].sum() / lengths[near].sum())
    off = np.angle(np.exp(1j * (4.0 * angles - phase)))
    agreeing = np.abs(off) < 4.0 * settings.agreeing_rad
    return float(np.angle(np.exp(1j * phase))) / 4.0, float(lengths[agreeing].sum() / lengths.sum())
