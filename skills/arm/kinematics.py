"""Closed form kinematics of the arm: lift, telescope along x, wrist pitch and roll (see ``ArmGeometry``).

With pitch p (0 level, -pi/2 down) the pads are at x = wrist_x + extension + hand cos p and z = lift + hand sin p.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np

from scene_graph.geometry.se3 import SE3
from skills.errors import Unreachable
from skills.ports import ArmGeometry, ArmTarget, BodyLimits


def gripper_pose(target: ArmTarget, geometry: ArmGeometry) -> SE3:
    """``T_base_gripper``: frame between the finger pads, x out of the hand, y the closing direction."""
    pitch, roll = target.wrist_pitch_rad, target.wrist_roll_rad
    turn_down = np.array([[cos(pitch), 0.0, -sin(pitch)], [0.0, 1.0, 0.0], [sin(pitch), 0.0, cos(pitch)]])
    about_hand = np.array([[1.0, 0.0, 0.0], [0.0, cos(roll), -sin(roll)], [0.0, sin(roll), cos(roll)]])
    x_m = geometry.wrist_x_m + target.extension_m + geometry.hand_length_m * cos(pitch)
    z_m = target.lift_m + geometry.hand_length_m * sin(pitch)
    return SE3.from_rotation(turn_down @ about_hand, np.array([x_m, 0.0, z_m]))


def arm_target(
    x_m: float, z_m: float, pitch_rad: float, roll_rad: float, geometry: ArmGeometry, limits: BodyLimits
) -> ArmTarget:
    """Joint targets that bring the pads to (``x_m``, 0, ``z_m``) in the base frame with the given wrist angles.

    Raises:
        Unreachable: a joint would leave its limits.
    """
    extension_m = x_m - geometry.wrist_x_m - geometry.hand_length_m * cos(pitch_rad)
    lift_m = z_m - geometry.hand_length_m * sin(pitch_rad)
    joints = (
        ("extension", extension_m, limits.extension_m, "m"),
        ("lift", lift_m, limits.lift_m, "m"),
        ("wrist pitch", pitch_rad, limits.wrist_pitch_rad, "rad"),
        ("wrist roll", roll_rad, limits.wrist_roll_rad, "rad"),
    )
    for joint, value, (low, high), unit in joints:
        if not low - 1e-3 <= value <= high + 1e-3:
            why = f"{joint} would be {value:.2f} {unit}, limits {low:.2f} to {high:.2f}"
            raise Unreachable(x_m, z_m, pitch_rad, why)
    clamped = [min(max(value, low), high) for _, value, (low, high), _ in joints]
    return ArmTarget(extension_m=clamped[0], lift_m=clamped[1], wrist_pitch_rad=clamped[2], wrist_roll_rad=clamped[3])


def reach_band_m(pitch_rad: float, geometry: ArmGeometry, limits: BodyLimits) -> tuple[float, float]:
    """Nearest and farthest horizontal distance of the pads from the base's axis at this wrist pitch."""
    offset_m = geometry.wrist_x_m + geometry.hand_length_m * cos(pitch_rad)
    return offset_m + limits.extension_m[0], offset_m + limits.extension_m[1]
