"""Rigid motions of the plane: the robot's base never leaves the floor."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]

FLAT_STD = 1e-3  # meters and radians: how far from flat a floor may be


@dataclass(frozen=True, slots=True)
class Pose2:
    """Pose of a child frame in a parent frame, both on the floor. Meters and radians; yaw in (-pi, pi]."""

    x_m: float
    y_m: float
    yaw_rad: float

    @classmethod
    def identity(cls) -> Pose2:
        return cls(0.0, 0.0, 0.0)

    @classmethod
    def from_se3(cls, transform: SE3) -> Pose2:
        """The planar part of ``transform``."""
        return cls(float(transform.x_m), float(transform.y_m), float(transform.yaw_rad))

    def to_se3(self) -> SE3:
        return SE3.from_xyz_yaw(self.x_m, self.y_m, 0.0, self.yaw_rad)

    def __matmul__(self, other: Pose2) -> Pose2:
        """``T_a_b @ T_b_c`` is ``T_a_c``."""
        cos, sin = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        return Pose2(
            self.x_m + cos * other.x_m - sin * other.y_m,
            self.y_m + sin * other.x_m + cos * other.y_m,
            wrap(self.yaw_rad + other.yaw_rad),
        )

    def inverse(self) -> Pose2:
        cos, sin = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        return Pose2(-cos * self.x_m - sin * self.y_m, sin * self.x_m - cos * self.y_m, wrap(-self.yaw_rad))

    def rotation(self) -> Array:
        """(2, 2) rotation matrix."""
        cos, sin = math.cos(self.yaw_rad), math.sin(self.yaw_rad)
        return np.array([[cos, -sin], [sin, cos]])

    @property
    def position_m(self) -> Array:
        """(2,) origin of the child in the parent."""
        return np.array([self.x_m, self.y_m])

    def apply(self, points: Array) -> Array:
        """Map (..., 2) points of the child into the parent."""
        return np.asarray(points @ self.rotation().T + self.position_m)

    def adjoint(self) -> Array:
        """(3, 3) map of a right perturbation (x, y, yaw) into the left one: ``T exp(xi) = exp(Ad xi) T``."""
        matrix = np.eye(3)
        matrix[:2, :2] = self.rotation()
        matrix[:2, 2] = (self.y_m, -self.x_m)
        return matrix

    def distance_m(self, other: Pose2) -> float:
        return math.hypot(self.x_m - other.x_m, self.y_m - other.y_m)


def wrap(angle_rad: float) -> float:
    """``angle_rad`` in (-pi, pi]."""
    wrapped = math.remainder(angle_rad, 2.0 * math.pi)
    return math.pi if wrapped == -math.pi else wrapped


def spatial_covariance(planar: Array) -> Array:
    """(6, 6) covariance (x, y, z, rx, ry, rz) of a planar pose whose (3, 3) covariance (x, y, yaw) is ``planar``."""
    covariance = np.eye(6) * FLAT_STD**2
    index = np.ix_((0, 1, 5), (0, 1, 5))
    covariance[index] = planar
    return covariance


def planar_covariance(spatial: Array) -> Array:
    """(3, 3) block (x, y, yaw) of a (6, 6) covariance."""
    return np.asarray(spatial[np.ix_((0, 1, 5), (0, 1, 5))])


def diagonal_covariance(x_std_m: float, y_std_m: float, yaw_std_rad: float) -> Array:
    """(3, 3) covariance (x, y, yaw) without correlations."""
    return np.diag([x_std_m**2, y_std_m**2, yaw_std_rad**2])
