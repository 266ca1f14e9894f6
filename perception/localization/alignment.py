"""Alignment of a scan with the walls of a known outline: point-to-line least squares (Gauss-Newton).

The outline is known exactly enough to need no correspondence search beyond the nearest wall. The result carries the
information that the scan gives about the pose, so that a corridor without visible ends leaves its length uncertain.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, wrap
from perception.geometry.walls import Walls

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class Alignment:
    """Pose of the base in the room that fits the scan best.

    ``information``: (3, 3) of (x, y, yaw) in the base frame, from the scan alone. ``matched``: share of the returns
    that lie on a wall. ``sigma_m``: their spread.
    """

    pose: Pose2
    information: Array
    matched: float
    sigma_m: float

    @property
    def conditioned(self) -> bool:
        """Whether the scan fixes all three coordinates."""
        return bool(np.linalg.eigvalsh(self.information)[0] > 1.0 / 0.05**2)


@dataclass(frozen=True, kw_only=True)
class AlignmentSettings:
    """Gates and floors."""

    gates_m: tuple[float, ...] = (0.25, 0.15, 0.10, 0.08)
    """How far from a wall a return may be, per iteration: down to four standard deviations of the usual range noise."""
    behind_m: float = 0.05
    """Least distance of the robot from the inner side of a wall that it sees. Chosen."""
    end_margin_m: float = 0.05
    """By which a return may lie beyond a wall's end: errors of the outline."""
    least_sigma_m: float = 0.01
    """Least spread of returns, so that a few that agree by chance are not believed too much. Chosen."""
    floor_m: float = 0.002
    """Error of the position that averaging over a scan does not remove. Chosen."""
    floor_rad: float = 0.0004
    """And of the heading."""
    returns: int = 300
    """At most this many are used in all iterations but the last. Chosen: for speed."""


def align(
    points_base: Array,
    walls: Walls,
    guess: Pose2,
    guess_covariance: Array,
    settings: AlignmentSettings = AlignmentSettings(),
) -> Alignment | None:
    """Most probable pose given the scan and a ``guess`` with its (3, 3) covariance; ``None`` when nothing matches."""
    guess_information = np.asarray(np.linalg.inv(guess_covariance))
    some = points_base[:: max(1, len(points_base) // settings.returns)]
    pose = guess
    normal_matrix, matched, sigma_m = np.zeros((3, 3)), 0.0, settings.least_sigma_m
    for points, gate_m in zip([some] * (len(settings.gates_m) - 1) + [points_base], settings.gates_m, strict=True):
        facing = walls.facing(pose.position_m, settings.behind_m)
        residual, jacobian = _residuals(points, pose, facing, gate_m, settings.end_margin_m)
        if len(residual) < 6:
            return None
        weight = (1.0 - (residual / (1.5 * gate_m)) ** 2) ** 2
        sigma_m = max(settings.least_sigma_m, float(np.sqrt((weight * residual**2).sum() / weight.sum())))
        normal_matrix = (jacobian * weight[:, None]).T @ jacobian / sigma_m**2
        gradient = jacobian.T @ (weight * residual) / sigma_m**2
        gradient += guess_information @ log_between(guess, pose)
        step = np.linalg.solve(normal_matrix + guess_information, -gradient)
        pose = pose @ Pose2(float(step[0]), float(step[1]), float(step[2]))
        matched = len(residual) / len(points)
    return Alignment(pose=pose, information=_floored(normal_matrix, settings), matched=matched, sigma_m=sigma_m)


def _residuals(points: Array, pose: Pose2, walls: Walls, gate_m: float, margin_m: float) -> tuple[Array, Array]:
    """Signed distance (M,) of each matched return from its wall, and its derivative (M, 3) by the pose of the base."""
    placed = pose.apply(points)
    distance = placed @ walls.normal.T - walls.offset_m
    station = placed @ walls.along.T - (walls.start * walls.along).sum(axis=1)
    possible = (np.abs(distance) < gate_m) & (station > -margin_m) & (station < walls.length_m + margin_m)
    matched = possible.any(axis=1)
    nearest = (
        np.argmin(np.where(possible, np.abs(distance), np.inf)[matched], axis=1) if matched.any() else np.empty(0, int)
    )
    residual = distance[matched][np.arange(len(nearest)), nearest]
    normal_base = walls.normal[nearest] @ pose.rotation()
    turning = normal_base[:, 1] * points[matched, 0] - normal_base[:, 0] * points[matched, 1]
    return residual, np.column_stack([normal_base, turning])


def _floored(information: Array, settings: AlignmentSettings) -> Array:
    """Information after adding the errors that do not average out."""
    weak = np.linalg.inv(information + 1e-4 * np.eye(3))
    floor = np.diag([settings.floor_m**2, settings.floor_m**2, settings.floor_rad**2])
    return np.asarray(np.linalg.inv(weak + floor))


def log_between(origin: Pose2, pose: Pose2) -> Array:
    """(3,) small motion (x, y, yaw) from ``origin`` to ``pose`` in the frame of ``origin``."""
    difference = origin.inverse() @ pose
    return np.array([difference.x_m, difference.y_m, wrap(difference.yaw_rad)])
