"""What of the picture is the robot itself: checked against the boxes that its fingers are."""

from __future__ import annotations

import numpy as np
import pytest

from perception.objects.seeing.body import OwnBody
from perception.ports import JointState
from scene_graph.geometry.se3 import SE3

DOWN = SE3.from_xyz_yaw(0.7, 0.0, 0.8, 0.0) @ SE3(quat_wxyz=(np.sqrt(0.5), 0.0, np.sqrt(0.5), 0.0))
"""The hand above a table: x, out of the hand, points to the floor."""


def joints(opening_m):
    return JointState(
        stamp_s=0.0,
        lift_m=0.98,
        extension_m=0.6,
        wrist_pitch_rad=-np.pi / 2,
        wrist_roll_rad=0.0,
        gripper_opening_m=opening_m,
        pan_rad=0.0,
        tilt_rad=0.0,
        finger_contacts=(False, False),
        T_base_gripper=DOWN,
    )


def finger_points(opening_m):
    """Points (N, 3) on both fingers, base frame: 10 cm long, 12 mm thick, 3 cm wide, pads 2 cm before their ends."""
    x_m, y_m, z_m = np.meshgrid(np.linspace(-0.08, 0.02, 6), np.linspace(0.0, 0.012, 3), np.linspace(-0.015, 0.015, 3))
    one = np.stack((x_m.ravel(), y_m.ravel() + opening_m / 2, z_m.ravel()), axis=1)
    return DOWN.apply(np.concatenate((one, one * (1.0, -1.0, 1.0))))


@pytest.mark.parametrize("opening_m", [0.02, 0.07, 0.12])
def test_open_fingers_are_the_robot_and_what_lies_between_them_is_not(opening_m):
    body = OwnBody(joints(opening_m))
    assert body.covers(finger_points(opening_m)).all()
    between = DOWN.apply(np.array(((0.03, 0.0, 0.0), (0.025, 0.0, 0.05), (0.06, opening_m / 2, 0.0))))
    assert body.covers(between).tolist() == [opening_m < 0.03, False, False]


def test_the_palm_is_the_robot_to_its_ends():
    ends = [(-0.1 + x_m, side * 0.08, z_m) for x_m in (-0.02, 0.02) for side in (-1, 1) for z_m in (-0.02, 0.02)]
    assert OwnBody(joints(0.07)).covers(DOWN.apply(np.array(ends))).all()
    assert not OwnBody(joints(0.07)).covers(DOWN.apply(np.array(((-0.1, 0.11, 0.0),)))).any()


def test_around_what_is_held_all_is_the_hand_and_what_it_holds():
    body = OwnBody(joints(0.07), held_m=(0.07, 0.07, 0.2))
    assert body.covers(DOWN.apply(np.array(((0.015, 0.0, 0.0), (0.05, 0.03, 0.0))))).all()
    assert not body.covers(DOWN.apply(np.array(((0.4, 0.0, 0.0),)))).any()
