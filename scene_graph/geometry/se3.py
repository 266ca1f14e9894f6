"""Rigid transforms in three dimensions.

Equation numbers refer to Sola, Deray, Atchuthan, "A micro Lie theory for state estimation in robotics" (2018).
Tangent vectors are ordered (x, y, z, rx, ry, rz): translation in meters, then rotation in radians.
"""

from __future__ import annotations

import math
import sys
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from scene_graph.geometry.errors import InvalidTransform
from scene_graph.geometry.rotation import matrix_of, product, quaternion_of, rotate, sinc, skew, wrap_angle

__all__ = ["SE3", "wrap_angle"]

Array = NDArray[np.float64]

_SMALL_ANGLE = 0.1
"""Below it the series, cut off after four terms, are exact in double precision, and the closed forms are not."""
_ORTHONORMAL_TOLERANCE = 1e-6
_UNIT_TOLERANCE = 8.0 * sys.float_info.epsilon


class SE3:
    """A rigid transform ``T_a_b``: maps coordinates in frame b to coordinates in frame a. Immutable.

    Attributes:
        quat_wxyz: (4,) read-only unit quaternion with w >= 0.
        translation_m: (3,) read-only origin of b in a.
    """

    __slots__ = ("_q", "_rotation", "_t", "quat_wxyz", "translation_m")
    __array_ufunc__ = None  # numpy must not take SE3 @ array for a product of object arrays

    quat_wxyz: Array
    translation_m: Array
    _q: tuple[float, float, float, float]
    _t: tuple[float, float, float]
    _rotation: Array | None

    def __init__(self, quat_wxyz: ArrayLike = (1.0, 0.0, 0.0, 0.0), translation_m: ArrayLike = (0.0, 0.0, 0.0)) -> None:
        quat = np.asarray(quat_wxyz, dtype=np.float64)
        translation = np.asarray(translation_m, dtype=np.float64)
        if quat.shape != (4,) or translation.shape != (3,):
            raise InvalidTransform(f"need shapes (4,) and (3,), not {quat.shape} and {translation.shape}")
        self._store(*quat.tolist(), *translation.tolist())

    def _store(self, w: float, x: float, y: float, z: float, tx: float, ty: float, tz: float) -> None:
        squared_norm = w * w + x * x + y * y + z * z
        if not math.isfinite(squared_norm + abs(tx) + abs(ty) + abs(tz)):
            raise InvalidTransform(f"not finite: quaternion {(w, x, y, z)}, translation {(tx, ty, tz)}")
        if squared_norm < 1e-12:
            raise InvalidTransform(f"quaternion {(w, x, y, z)} has no direction")
        scale = 1.0 if abs(squared_norm - 1.0) <= _UNIT_TOLERANCE else 1.0 / math.sqrt(squared_norm)
        w, x, y, z = w * scale, x * scale, y * scale, z * scale
        if (w, x, y, z) < (0.0, 0.0, 0.0, 0.0):  # q and -q are one rotation; keep the one that sorts first positive
            w, x, y, z = -w, -x, -y, -z
        # Adding 0.0 turns -0.0 into 0.0, so that equal transforms have equal bytes and equal hashes.
        self._set("_q", (w + 0.0, x + 0.0, y + 0.0, z + 0.0))
        self._set("_t", (tx + 0.0, ty + 0.0, tz + 0.0))
        self._set("_rotation", None)
        self._set("quat_wxyz", _read_only(self._q))
        self._set("translation_m", _read_only(self._t))

    def _set(self, name: str, value: object) -> None:
        object.__setattr__(self, name, value)

    def __setattr__(self, name: str, value: object) -> None:
        raise AttributeError(f"SE3 is immutable; cannot set {name}")

    def __delattr__(self, name: str) -> None:
        raise AttributeError(f"SE3 is immutable; cannot delete {name}")

    def __reduce__(self) -> tuple[Any, ...]:
        return (SE3, (self._q, self._t))

    @classmethod
    def _of(cls, quat: tuple[float, float, float, float], translation: tuple[float, float, float]) -> Self:
        transform = cls.__new__(cls)
        cls._store(transform, *quat, *translation)
        return transform

    @classmethod
    def identity(cls) -> Self:
        """The transform that changes nothing."""
        return cls._of((1.0, 0.0, 0.0, 0.0), (0.0, 0.0, 0.0))

    @classmethod
    def from_xyz_yaw(cls, x: float, y: float, z: float, yaw: float) -> Self:
        """Translation in meters and a turn by ``yaw`` radians about z."""
        return cls._of((math.cos(yaw / 2.0), 0.0, 0.0, math.sin(yaw / 2.0)), (float(x), float(y), float(z)))

    @classmethod
    def from_rotation(cls, rotation: ArrayLike, translation_m: ArrayLike = (0.0, 0.0, 0.0)) -> Self:
        """From a (3, 3) rotation matrix and a (3,) translation.

        Raises:
            InvalidTransform: the matrix is not orthonormal and right-handed within 1e-6.
        """
        R = np.asarray(rotation, dtype=np.float64)
        t = np.asarray(translation_m, dtype=np.float64)
        if R.shape != (3, 3) or t.shape != (3,):
            raise InvalidTransform(f"need shapes (3, 3) and (3,), not {R.shape} and {t.shape}")
        orthonormal = np.abs(R @ R.T - np.eye(3)).max() <= _ORTHONORMAL_TOLERANCE
        if not (orthonormal and np.linalg.det(R) > 0.0):
            raise InvalidTransform(f"not a rotation matrix: {R.tolist()}")
        return cls(quaternion_of(R), t)

    @classmethod
    def from_matrix(cls, matrix: ArrayLike) -> Self:
        """From a (4, 4) homogeneous matrix."""
        M = np.asarray(matrix, dtype=np.float64)
        if M.shape != (4, 4) or not np.allclose(M[3], (0.0, 0.0, 0.0, 1.0), atol=_ORTHONORMAL_TOLERANCE):
            raise InvalidTransform(f"not a homogeneous rigid transform: {M.tolist()}")
        return cls.from_rotation(M[:3, :3], M[:3, 3])

    @classmethod
    def exp(cls, xi: ArrayLike) -> Self:
        """From a tangent vector (6,): eqs. (133) and (172), t = V(theta) rho with V of eq. (174)."""
        tangent = np.asarray(xi, dtype=np.float64)
        if tangent.shape != (6,) or not np.isfinite(tangent).all():
            raise InvalidTransform(f"need six finite numbers, not {tangent.tolist()}")
        rho, theta = tangent[:3], tangent[3:]
        angle = math.hypot(*theta.tolist())
        half_sinc = sinc(angle / 2.0) / 2.0
        quat = np.concatenate(([math.cos(angle / 2.0)], half_sinc * theta))
        b = 2.0 * half_sinc * half_sinc
        if angle < _SMALL_ANGLE:
            c = 1.0 / 6.0 - angle**2 / 120.0 + angle**4 / 5040.0 - angle**6 / 362880.0
        else:
            c = (angle - math.sin(angle)) / angle**3
        turned = np.cross(theta, rho)
        return cls(quat, rho + b * turned + c * np.cross(theta, turned))

    def log(self) -> Array:
        """The tangent vector (6,) with rotation angle at most pi: eqs. (135), (173), with the inverse of eq. (174)."""
        w, *vector = self._q
        half = math.atan2(math.hypot(*vector), w)
        angle = 2.0 * half
        theta = np.array(vector) * (2.0 / sinc(half))
        if angle < _SMALL_ANGLE:
            c = 1.0 / 12.0 + angle**2 / 720.0 + angle**4 / 30240.0 + angle**6 / 1209600.0
        else:
            c = 1.0 / angle**2 - 1.0 / (2.0 * angle * math.tan(half))
        turned = np.cross(theta, self.translation_m)
        return np.concatenate((self.translation_m - 0.5 * turned + c * np.cross(theta, turned), theta))

    def inverse(self) -> Self:
        """``T_b_a``, eq. (170)."""
        w, x, y, z = self._q
        tx, ty, tz = rotate((w, -x, -y, -z), self._t)
        return self._of((w, -x, -y, -z), (-tx, -ty, -tz))

    def __matmul__(self, other: SE3) -> Self:
        """``T_a_b @ T_b_c = T_a_c``, eq. (171)."""
        if not isinstance(other, SE3):
            return NotImplemented
        tx, ty, tz = rotate(self._q, other._t)
        ox, oy, oz = self._t
        return self._of(product(self._q, other._q), (tx + ox, ty + oy, tz + oz))

    def apply(self, points: ArrayLike) -> Array:
        """Maps points (..., 3) in frame b to frame a."""
        return np.asarray(points, dtype=np.float64) @ self.rotation().T + self.translation_m

    def rotation(self) -> Array:
        """The (3, 3) rotation matrix, read-only."""
        if self._rotation is None:
            matrix = matrix_of(self._q)
            matrix.flags.writeable = False
            self._set("_rotation", matrix)
            return matrix
        return self._rotation

    def matrix(self) -> Array:
        """The (4, 4) homogeneous matrix."""
        M = np.eye(4)
        M[:3, :3] = self.rotation()
        M[:3, 3] = self.translation_m
        return M

    def adjoint(self) -> Array:
        """(6, 6) with ``T Exp(xi) = Exp(Ad_T xi) T``, eq. (175)."""
        R = self.rotation()
        Ad = np.zeros((6, 6))
        Ad[:3, :3] = Ad[3:, 3:] = R
        Ad[:3, 3:] = skew(self.translation_m) @ R
        return Ad

    @property
    def x_m(self) -> float:
        return self._t[0]

    @property
    def y_m(self) -> float:
        return self._t[1]

    @property
    def z_m(self) -> float:
        return self._t[2]

    @property
    def yaw_rad(self) -> float:
        """Heading of b's x axis in a's horizontal plane, in (-pi, pi]."""
        w, x, y, z = self._q
        return wrap_angle(math.atan2(2.0 * (x * y + w * z), 1.0 - 2.0 * (y * y + z * z)))

    def __eq__(self, other: object) -> bool:
        return isinstance(other, SE3) and self._q == other._q and self._t == other._t

    def __hash__(self) -> int:
        return hash((self._q, self._t))

    def is_close(self, other: SE3, tol: float = 1e-9) -> bool:
        """Whether translations (meters) and rotations (radians) differ by at most ``tol``."""
        return bool(np.abs((self.inverse() @ other).log()).max() <= tol)

    def __repr__(self) -> str:
        return f"SE3(quat_wxyz={self._q}, translation_m={self._t})"


def _read_only(values: tuple[float, ...]) -> Array:
    array = np.array(values)
    array.flags.writeable = False
    return array
