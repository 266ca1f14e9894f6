"""Arithmetic of rotations, as plain functions over floats and small arrays."""

from __future__ import annotations

import math
from typing import overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]
Quaternion = tuple[float, float, float, float]
Vector = tuple[float, float, float]


@overload
def wrap_angle(angle_rad: float) -> float: ...
@overload
def wrap_angle(angle_rad: Array) -> Array: ...
def wrap_angle(angle_rad: float | Array) -> float | Array:
    """Wraps radians to (-pi, pi]; angles already there are returned exactly."""
    if isinstance(angle_rad, np.ndarray):
        wrapped = angle_rad - 2.0 * np.pi * np.round(angle_rad / (2.0 * np.pi))
        return np.where(wrapped <= -np.pi, wrapped + 2.0 * np.pi, wrapped)
    scalar = math.remainder(float(angle_rad), 2.0 * math.pi)
    return math.pi if scalar <= -math.pi else scalar


def skew(v: ArrayLike) -> Array:
    """The (3, 3) matrix with ``skew(v) @ u = v x u``."""
    x, y, z = np.asarray(v, dtype=np.float64)
    return np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))


def sinc(x: float) -> float:
    """``sin(x) / x``, 1 at 0."""
    return 1.0 - x * x / 6.0 + x**4 / 120.0 if abs(x) < 1e-3 else math.sin(x) / x


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    """The quaternion product ``a b``, components wxyz."""
    aw, ax, ay, az = a
    bw, bx, by, bz = b
    return (
        aw * bw - ax * bx - ay * by - az * bz,
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
    )


def rotate(q: Quaternion, v: Vector) -> Vector:
    """The vector part of ``q v q*``: v + 2 w (u x v) + 2 u x (u x v) for a unit quaternion (w, u)."""
    w, ux, uy, uz = q
    vx, vy, vz = v
    cx, cy, cz = uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx
    return (
        vx + 2.0 * (w * cx + uy * cz - uz * cy),
        vy + 2.0 * (w * cy + uz * cx - ux * cz),
        vz + 2.0 * (w * cz + ux * cy - uy * cx),
    )


def matrix_of(q: Quaternion) -> Array:
    """The (3, 3) rotation matrix of a unit quaternion."""
    w, x, y, z = q
    return np.array(
        (
            (1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - w * z), 2.0 * (x * z + w * y)),
            (2.0 * (x * y + w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - w * x)),
            (2.0 * (x * z - w * y), 2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + y * y)),
        )
    )


def quaternion_of(R: Array) -> Quaternion:
    """A quaternion, not normalized, of a rotation matrix.

    Shepperd's method: the largest of the four components is computed first, so that no angle is ill-conditioned.
    """
    (r00, r01, r02), (r10, r11, r12), (r20, r21, r22) = R.tolist()
    trace = r00 + r11 + r22
    largest = max(trace, r00, r11, r22)
    if largest == trace:
        return (1.0 + trace, r21 - r12, r02 - r20, r10 - r01)
    if largest == r00:
        return (r21 - r12, 1.0 + r00 - r11 - r22, r01 + r10, r02 + r20)
    if largest == r11:
        return (r02 - r20, r01 + r10, 1.0 + r11 - r00 - r22, r12 + r21)
    return (r10 - r01, r02 + r20, r12 + r21, 1.0 + r22 - r00 - r11)
