"""What one scan says about how far the walls of a known room are from where they are believed to be.

A wall is the surface that the rays end on where it should be; where there is none, the one with nothing behind it.
What stands before a wall, a wardrobe or a person, is none. As the scan's own pose may be off as well, it is an unknown
of the view, eliminated from it (Schur complement): what is left is a quadratic cost of the walls' shifts alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.walls import Walls
from perception.lidar.slice import OutlineScan
from perception.localization.robot_pose import RobotPose

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class SightingSettings:
    """What is a wall in a scan, and how well it tells where the wall is."""

    reach_m: float = 0.32
    """How far from its place a wall is looked for: four steps."""
    step_m: float = 0.08
    """Between places where it is looked for: less than twice the gate."""
    gate_m: float = 0.045
    """Returns this near to a surface, or three standard deviations of the ranges, are on it. Chosen."""
    place_m: float = 0.03
    """A wall is in its place to so much. Chosen: errors of the pose."""
    share: float = 0.35
    """Of a wall's length that a scan must see of it. Chosen: furniture hides the rest."""
    other_share: float = 0.6
    """The same where it is not in its place: it may as well be furniture."""
    least_m: float = 0.4
    """Length that must be seen of a short wall. Chosen: as wide as a narrow cupboard."""
    behind_m: float = 0.15
    """Length of another surface behind it that makes it none. Chosen: one and a half bins."""
    flat_m: float = 0.015
    """A line about which returns spread more is of two surfaces. Chosen."""
    flat: float = 1.5
    """Or more than so many times the noise of the ranges."""
    floor_m: float = 0.004
    """Error of a wall's distance that averaging over a scan does not remove. Chosen."""
    correlated: float = 9.0
    """How many neighboring returns err together. Chosen."""
    slack_m: float = 0.1
    """What walls that are off may have done to the pose, which was told from them. Chosen: a third of the reach."""
    slack_rad: float = 0.02
    """The same of its heading."""
    corner_m: float = 0.12
    """So near to its ends a wall is not looked at: returns there may be the next wall's. Chosen: two gates and more."""
    bin_m: float = 0.1
    """Stations in which returns make a wall seen. Chosen: about the spacing of rays that graze it."""
    huber: float = 1.5
    """Standard deviations from which on a return counts less: near the usual 1.345."""
    fit_rounds: int = 3
    """Of fitting anew. Chosen."""
    fewest: int = 8
    """Returns of a wall, as of a line in ``lidar.corners``."""
    least_sigma_m: float = 0.005
    """Least spread of returns, so that a few that agree by chance are not believed too much. Chosen."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WallLines:
    """Lines that a scan shows of walls, (M,) each, in the room's frame at the believed pose.

    ``wall``: index. ``offset_m``: how far into the room the line is from the wall's plane, at its returns' mean.
    ``slope``: how it turns from the wall. ``mean_base``: (M, 2) of the returns, base frame. ``offset_std_m``,
    ``slope_std``. ``mixed``: (K,) of all walls, those that show more than one surface and therefore nothing.
    """

    wall: NDArray[np.int64]
    offset_m: Array
    slope: Array
    mean_base: Array
    offset_std_m: Array
    slope_std: Array
    mixed: Mask

    @classmethod
    def of(cls, rows: Sequence[tuple[float, ...]], mixed: Mask) -> WallLines:
        """Lines from ``rows`` of wall, offset, slope, standard deviations of both, and mean return."""
        table = np.array(rows).reshape(-1, 7)
        return cls(
            wall=table[:, 0].astype(np.int64),
            offset_m=table[:, 1],
            slope=table[:, 2],
            offset_std_m=table[:, 3],
            slope_std=table[:, 4],
            mean_base=table[:, 5:],
            mixed=mixed,
        )


def wall_lines(
    scan: OutlineScan, T_room_base: Pose2, walls: Walls, settings: SightingSettings = SightingSettings()
) -> WallLines:
    """The lines of ``walls`` that ``scan``, taken at ``T_room_base``, shows."""
    points = T_room_base.apply(scan.points_base)
    offset = points @ walls.normal.T - walls.offset_m
    station = points @ walls.along.T - (walls.start * walls.along).sum(axis=1)
    gate_m = max(settings.gate_m, 3.0 * scan.noise_m)
    flat_m = max(settings.flat_m, settings.flat * scan.noise_m)
    within = (np.abs(offset) < settings.reach_m + gate_m) & (station > settings.corner_m)
    within &= station < walls.length_m - settings.corner_m
    within &= walls.normal @ T_room_base.position_m - walls.offset_m > settings.reach_m
    rows: list[tuple[float, ...]] = []
    mixed = np.zeros(len(walls.offset_m), dtype=bool)
    for k in np.flatnonzero(within.sum(axis=0) >= settings.fewest).tolist():
        near = np.flatnonzero(within[:, k])
        found, mixed[k] = _surface(offset[near, k], station[near, k], float(walls.length_m[k]), gate_m, settings)
        if found is not None:
            chosen = near[found]
            *line, sigma_m = _line(offset[chosen, k], station[chosen, k], settings)
            if sigma_m < flat_m:
                rows.append((k, *line, *scan.points_base[chosen].mean(axis=0)))
    return WallLines.of(rows, mixed)


def _surface(
    offset: Array, station: Array, length_m: float, gate_m: float, settings: SightingSettings
) -> tuple[Mask | None, bool]:
    """(N,) returns on the wall, ``None`` when too little is seen of it, and whether another surface is behind it."""
    bins = (station / settings.bin_m).astype(np.int64)
    starts = np.arange(-settings.reach_m, settings.reach_m + 1e-6, settings.step_m)
    for start_m in starts[np.argsort(np.abs(starts))].tolist():
        center_m = start_m
        for _ in range(settings.fit_rounds):
            on = np.abs(offset - center_m) < gate_m
            center_m = float(np.median(offset[on])) if on.any() else center_m
        in_place = abs(center_m) < settings.place_m
        share = settings.share if in_place else settings.other_share
        if _length_m(bins[on], settings) < max(settings.least_m, share * (length_m - 2.0 * settings.corner_m)):
            continue
        mixed = not in_place and _length_m(bins[offset < center_m - 2.0 * gate_m], settings) >= settings.behind_m
        return (None, True) if mixed else (on, False)
    return None, False


def _length_m(bins: NDArray[np.int64], settings: SightingSettings) -> float:
    """Length of wall on which returns with these station bins lie."""
    return settings.bin_m * len(np.unique(bins))


def _line(offset: Array, station: Array, settings: SightingSettings) -> tuple[float, float, float, float, float]:
    """Offset at the mean station, slope, the standard deviations of both, and the returns' spread; Huber's weights."""
    lever = station - station.mean()
    mean_m, slope = float(np.median(offset)), 0.0
    for _ in range(settings.fit_rounds):
        residual = offset - mean_m - slope * lever
        sigma_m = max(settings.least_sigma_m, 1.4826 * float(np.median(np.abs(residual))))
        weight = np.minimum(1.0, settings.huber * sigma_m / np.maximum(np.abs(residual), 1e-9))
        total, first, second = weight.sum(), (weight * lever).sum(), (weight * lever**2).sum()
        moments = np.array([[total, first], [first, second]])
        mean_m, slope = np.linalg.solve(moments, [(weight * offset).sum(), (weight * lever * offset).sum()]).tolist()
    variance = settings.correlated * sigma_m**2
    half_m = max(float(station.max() - station.min()) / 2.0, settings.bin_m)
    return (
        mean_m,
        slope,
        float(np.sqrt(variance / total + settings.floor_m**2)),
        float(np.sqrt(variance / second + (settings.floor_m / half_m) ** 2)),
        sigma_m,
    )


@dataclass(frozen=True, kw_only=True, eq=False)
class ShiftCost:
    """Cost of one view as a function of the walls' shifts s (K,) into the room, for the best pose of the view.

    ``s J s - 2 b s + c`` in units of the standard deviation, with ``information`` J (K, K), ``vector`` b (K,) and
    ``constant`` c. The best correction (3,) of the pose, base frame, is ``motion - gain s``. ``lines``: what was seen,
    ``jacobian`` (M, 3) of their offsets by that motion. ``position_m``: (2,) of the base.
    """

    information: Array
    vector: Array
    constant: float
    motion: Array
    gain: Array
    lines: WallLines
    jacobian: Array
    position_m: Array

    @classmethod
    def of(
        cls, scan: OutlineScan, pose: RobotPose, walls: Walls, settings: SightingSettings = SightingSettings()
    ) -> ShiftCost:
        """The cost of ``scan``, taken at ``pose`` in the room's frame."""
        lines = wall_lines(scan, pose.T_parent_base, walls, settings)
        seen, jacobian = np.eye(len(walls.offset_m))[lines.wall], _by_pose(lines, walls, pose.T_parent_base)
        weight, turned = lines.offset_std_m**-2.0, lines.slope_std**-2.0
        slack = np.diag([settings.slack_m, settings.slack_m, settings.slack_rad]) ** 2
        pose_information = np.linalg.inv(pose.covariance + slack) + (jacobian * weight[:, None]).T @ jacobian
        pose_information[2, 2] += turned.sum()
        pull = -jacobian.T @ (weight * lines.offset_m)
        pull[2] -= (turned * lines.slope).sum()
        coupling = -(seen * weight[:, None]).T @ jacobian
        motion = np.asarray(np.linalg.solve(pose_information, pull), dtype=np.float64)
        gain = np.asarray(np.linalg.solve(pose_information, coupling.T), dtype=np.float64)
        return cls(
            information=np.diag(seen.T @ weight) - coupling @ gain,
            vector=seen.T @ (weight * lines.offset_m) - coupling @ motion,
            constant=float(weight @ lines.offset_m**2 + turned @ lines.slope**2 - pull @ motion),
            motion=motion,
            gain=gain,
            lines=lines,
            jacobian=jacobian,
            position_m=pose.T_parent_base.position_m,
        )

    def correction(self, shifts: Array) -> Pose2:
        """Small motion of the base, in its own frame, that fits best when the walls are shifted."""
        x_m, y_m, yaw_rad = (self.motion - self.gain @ shifts).tolist()
        return Pose2(x_m, y_m, yaw_rad)

    def misfit(self, shifts: Array) -> float:
        """Root mean square of what is left, in standard deviations, when the walls are shifted."""
        left = float(shifts @ self.information @ shifts - 2.0 * self.vector @ shifts) + self.constant
        return float(np.sqrt(max(left, 0.0) / max(2 * len(self.lines.wall) - 3, 1)))

    def agreeing(self, shifts: Array, gate_m: float) -> tuple[Mask, Mask]:
        """(K,) walls that this view saw within ``gate_m`` of where they are then, and those it says anything about."""
        motion = self.motion - self.gain @ shifts
        lines, agree = self.lines, np.zeros(len(shifts), dtype=bool)
        left = lines.offset_m + self.jacobian @ motion - shifts[lines.wall]
        told = lines.mixed.copy()
        told[lines.wall] = True
        agree[lines.wall] = np.abs(left) < np.maximum(gate_m, 3.0 * lines.offset_std_m)
        return agree, told


def _by_pose(lines: WallLines, walls: Walls, T_room_base: Pose2) -> Array:
    """(M, 3) derivative of the lines' offsets by a small motion of the base in its own frame."""
    normal_base = walls.normal[lines.wall] @ T_room_base.rotation()
    turning = normal_base[:, 1] * lines.mean_base[:, 0] - normal_base[:, 0] * lines.mean_base[:, 1]
    return np.column_stack([normal_base, turning])
