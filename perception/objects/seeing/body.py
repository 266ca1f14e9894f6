"""Where the robot's own body is in the image: what the camera sees there is no object."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.ports import JointState

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class BodyGeometry:
    """Radii around the arm and hand, and of the base, in meters. ``fingers_m``: the free end of the hand, where
    things are held. ``finger_m``: length, thickness and width of a finger; ``pad_m``: how far it reaches beyond the
    middle of its pad. ``palm_m``: length, breadth and height of the palm, ``behind_m``: how far behind the pads its
    middle is. ``margin_m``: by how much finger and palm may seem thicker.
    """

    base_radius_m: float = 0.25
    arm_radius_m: float = 0.07
    wrist_x_m: float = 0.10
    fingers_m: float = 0.05
    finger_m: tuple[float, float, float] = (0.10, 0.012, 0.03)
    pad_m: float = 0.02
    palm_m: tuple[float, float, float] = (0.04, 0.16, 0.04)
    behind_m: float = 0.10
    margin_m: float = 0.015
    held_margin_m: float = 0.05
    """By how much what is held may seem larger, and be held off its middle."""


class OwnBody:
    """The volume of base, telescope, palm and empty fingers for one joint state, in the base frame."""

    def __init__(
        self,
        joints: JointState,
        geometry: BodyGeometry | None = None,
        *,
        held_m: tuple[float, float, float] | None = None,
    ) -> None:
        """``held_m``: size of what the hand holds, upright around the grip."""
        geometry = geometry or BodyGeometry()
        self._geometry = geometry
        grip = joints.T_base_gripper
        self._T_gripper_base = grip.inverse()
        self._opening_m = joints.gripper_opening_m
        wrist = np.array((geometry.wrist_x_m + joints.extension_m, 0.0, joints.lift_m))
        shoulder = np.array((0.0, 0.0, joints.lift_m))
        palm = grip.translation_m - geometry.fingers_m * grip.rotation()[:, 0]
        self._segments = ((shoulder, wrist), (wrist, palm))
        self.grip = grip.translation_m
        self._held_m = held_m

    def covers(self, points_base: Array) -> NDArray[np.bool_]:
        """Which of the points (N, 3) belong to the robot."""
        inside = np.hypot(points_base[:, 0], points_base[:, 1]) < self._geometry.base_radius_m
        inside |= self._of_palm(points_base)
        for start, end in self._segments:
            inside |= _distance(points_base, start, end) < self._geometry.arm_radius_m
        if self._held_m is not None:
            away = np.abs(points_base - self.grip)
            beside = np.hypot(away[:, 0], away[:, 1]) < max(self._held_m[:2]) / 2.0 + self._geometry.held_margin_m
            inside |= beside & (away[:, 2] < self._held_m[2] / 2.0 + self._geometry.held_margin_m)
        else:
            inside |= self._of_fingers(points_base)
        return np.asarray(inside)

    def _of_palm(self, points_base: Array) -> NDArray[np.bool_]:
        """Which of the points (N, 3) are of the palm, which is broader than the arm."""
        center, half = (-self._geometry.behind_m, 0.0, 0.0), np.array(self._geometry.palm_m) / 2.0
        away = np.abs(self._T_gripper_base.apply(points_base) - center)
        return np.asarray((away < half + self._geometry.margin_m).all(axis=1))

    def _of_fingers(self, points_base: Array) -> NDArray[np.bool_]:
        """Which of the points (N, 3) are of a finger; what lies between open fingers is of something else."""
        geometry = self._geometry
        length_m, thick_m, wide_m = geometry.finger_m
        x_m, y_m, z_m = self._T_gripper_base.apply(points_base).T
        along = np.abs(x_m - geometry.pad_m + length_m / 2.0) < length_m / 2.0 + geometry.margin_m
        across = np.abs(np.abs(y_m) - (self._opening_m + thick_m) / 2.0) < thick_m / 2.0 + geometry.margin_m
        return np.asarray(along & across & (np.abs(z_m) < wide_m / 2.0 + geometry.margin_m))


def _distance(points: Array, start: Array, end: Array) -> Array:
    """Distances of points (N, 3) from a segment."""
    axis = end - start
    along = np.clip((points - start) @ axis / max(float(axis @ axis), 1e-12), 0.0, 1.0)
    distances: Array = np.linalg.norm(points - start - along[:, None] * axis, axis=1)
    return distances
