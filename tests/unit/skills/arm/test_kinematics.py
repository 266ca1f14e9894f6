"""Laws of the arm's closed form, and the choice of grasps."""

from __future__ import annotations

from math import cos, inf, pi, sin

import numpy as np
import pytest
from hypothesis import HealthCheck, assume, given, settings
from hypothesis import strategies as st

from scene_graph.geometry.se3 import SE3
from skills.arm.grasping import can_grasp, choose_grasp, grasp_options
from skills.arm.hand import Hand
from skills.arm.kinematics import arm_target, gripper_pose, reach_band_m
from skills.arm.level_hand import bars_level_hand, level_hand_barred, meets_support_level, prefers_level
from skills.errors import Unreachable
from skills.ports import ArmTarget

HAND = Hand()
LIMITS, GEOMETRY = HAND.limits, HAND.geometry


def within(limits):
    return st.floats(*limits)


joints = st.builds(
    ArmTarget,
    lift_m=within(LIMITS.lift_m),
    extension_m=within(LIMITS.extension_m),
    wrist_pitch_rad=within(LIMITS.wrist_pitch_rad),
    wrist_roll_rad=within(LIMITS.wrist_roll_rad),
)


@given(joints)
def test_inverse_of_forward_gives_the_joints_back(target):
    hand = gripper_pose(target, GEOMETRY)
    back = arm_target(hand.x_m, hand.z_m, target.wrist_pitch_rad, target.wrist_roll_rad, GEOMETRY, LIMITS)
    assert back.lift_m == pytest.approx(target.lift_m, abs=2e-3)
    assert back.extension_m == pytest.approx(target.extension_m, abs=2e-3)


@given(joints)
def test_hand_points_along_the_pitch_and_its_frame_is_a_rotation(target):
    rotation = gripper_pose(target, GEOMETRY).rotation()
    pitch = target.wrist_pitch_rad
    np.testing.assert_allclose(rotation[:, 0], [cos(pitch), 0.0, sin(pitch)], atol=1e-9)
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-9)
    assert np.linalg.det(rotation) == pytest.approx(1.0)


def test_level_unrolled_hand_closes_sideways():
    rotation = gripper_pose(ArmTarget(lift_m=0.5, extension_m=0.2), GEOMETRY).rotation()
    np.testing.assert_allclose(rotation[:, 1], [0.0, 1.0, 0.0], atol=1e-12)


@pytest.mark.parametrize(("top_m", "level"), [(0.6, False), (1.05, False), (1.075, False), (1.1, True)])
def test_what_stands_high_is_taken_from_above_as_long_as_the_finger_tips_get_over_it(top_m, level):
    """A ball on a high cabinet was reached for level, through an apple, as the lift did not bring the hand so high over
    it as it usually comes.
    """
    pose = SE3.from_xyz_yaw(0.6, 0.0, top_m - 0.05, 0.0)
    grasp = choose_grasp((0.08, 0.08, 0.1), pose, hand=HAND, level_first=False)
    assert grasp.is_level is level


@given(st.floats(0.012, 0.1))
def test_the_finger_tips_are_below_the_middle_of_a_thing_and_over_what_it_lies_on(height_m):
    """By no more than its upper edge a phone was not held: the fingers slid up over it."""
    tips_m = HAND.pads_from_above_m((0.07, 0.15, height_m), 0.5 + height_m / 2) - GEOMETRY.pads_to_tips_m
    assert 0.5 + 0.002 < tips_m < 0.5 + 0.4 * height_m


@given(st.floats(0.0, 1.5), st.floats(-0.5, 2.0), st.floats(-pi / 2, 0.5))
def test_out_of_reach_is_said_with_the_joint_and_its_limits(x_m, z_m, pitch):
    low, high = reach_band_m(pitch, GEOMETRY, LIMITS)
    assume(not low - 0.01 <= x_m <= high + 0.01)
    with pytest.raises(Unreachable, match=r"extension would be .* limits 0\.00 to 0\.70|limits"):
        arm_target(x_m, z_m, pitch, 0.0, GEOMETRY, LIMITS)


boxes = st.tuples(st.floats(0.02, 0.10), st.floats(0.02, 0.3), st.floats(0.03, 0.3))


@given(boxes, st.floats(-pi, pi), st.floats(0.0, 0.8))
def test_fingers_close_across_a_side_that_fits_between_them(size, yaw, bottom_m):
    pose = SE3.from_xyz_yaw(0.5, 0.0, bottom_m + size[2] / 2, yaw)
    grasp = grasp_options(size, pose, hand=HAND, level_first=False)[0]
    hand = gripper_pose(
        ArmTarget(lift_m=1.0, extension_m=0.3, wrist_pitch_rad=-pi / 2, wrist_roll_rad=grasp.roll_rad), GEOMETRY
    )
    in_object = pose.rotation().T @ hand.rotation()[:, 1]
    extent = abs(in_object[:2]) @ np.array(size[:2])
    assert extent <= max(HAND.span_m, 1.3 * min(size[:2])) + 1e-3
    assert LIMITS.wrist_roll_rad[0] <= grasp.roll_rad <= LIMITS.wrist_roll_rad[1]
    assert extent < grasp.opening_m <= LIMITS.gripper_opening_m[1] or extent <= HAND.span_m


@given(boxes, st.floats(-pi, pi), st.floats(0.0, 0.8))
def test_fingers_stay_above_what_the_object_stands_on(size, yaw, bottom_m):
    pose = SE3.from_xyz_yaw(0.5, 0.0, bottom_m + size[2] / 2, yaw)
    for grasp in grasp_options(size, pose, hand=HAND, level_first=False):
        assert grasp.pads_z_m >= bottom_m + 0.027
        assert grasp.hover_z_m >= grasp.pads_z_m - 1e-9


def test_the_hand_comes_from_above_or_level_as_asked():
    pose = SE3.from_xyz_yaw(0.55, 0.0, 0.87, 0.3)
    free = choose_grasp((0.07, 0.07, 0.24), pose, hand=HAND, level_first=False)
    under = choose_grasp((0.07, 0.07, 0.24), pose, hand=HAND, level_first=True)
    assert free.pitch_rad == pytest.approx(-pi / 2, abs=1e-3)
    assert abs(free.roll_rad) <= pi / 4
    assert under.pitch_rad == 0.0


def test_something_high_up_is_taken_level_because_the_lift_ends():
    pose = SE3.from_xyz_yaw(0.6, 0.0, 1.2, 0.0)
    grasp = choose_grasp((0.07, 0.07, 0.24), pose, hand=HAND, level_first=False)
    assert grasp.pitch_rad == 0.0


@pytest.mark.parametrize("height_m", [0.01, 0.035, 0.07])
def test_a_level_hand_closes_below_the_top_of_a_thing_or_does_not_come(height_m):
    pose = SE3.from_xyz_yaw(0.55, 0.0, 0.8 + height_m / 2, 0.0)
    options = grasp_options((0.2, 0.085, height_m), pose, hand=HAND, level_first=True)
    tops_m = [0.8 + height_m - grasp.pads_z_m for grasp in options if grasp.is_level]
    assert all(top_m > 0.0 for top_m in tops_m)
    assert bool(tops_m) is (height_m > 0.06)


def test_below_a_board_the_hand_from_above_stays_below_it_and_without_room_it_does_not_come():
    size_m, pose = (0.2, 0.085, 0.035), SE3.from_xyz_yaw(0.55, 0.0, 0.8175, 0.0)
    free, below = (choose_grasp(size_m, pose, hand=HAND, level_first=False, roof_m=roof_m) for roof_m in (inf, 0.07))
    assert below.hover_z_m == pytest.approx(pose.z_m + 0.07)
    assert free.hover_z_m > below.hover_z_m > below.pads_z_m
    with pytest.raises(Unreachable, match="no room for the hand over it"):
        choose_grasp(size_m, pose, hand=HAND, level_first=False, roof_m=0.05)


def test_what_is_too_wide_says_so():
    with pytest.raises(Unreachable, match=r"0\.300 m wide"):
        choose_grasp((0.3, 0.4, 0.2), SE3.from_xyz_yaw(0.5, 0, 0.8, 0), hand=HAND, level_first=False)


@pytest.mark.parametrize(("height_m", "level"), [(0.06, True), (0.088, False), (0.1, False)])
def test_a_bottle_is_taken_level_unless_something_stands_before_it_as_high_as_the_hand(flat, height_m, level):
    built = flat().table().bottle("bottle_1", 1.0, 1.2)
    ahead = SE3.from_xyz_yaw(0.6, 0.0, 0.87, 0.0)  # the base is 0.6 m west of the bottle, facing east
    assert prefers_level(built.memory.snapshot(), "bottle_1", ahead, HAND)
    built.thing("cup_1", (0.8, 1.25, 0.75 + height_m / 2), (0.08, 0.08, height_m), on="table_1")
    assert prefers_level(built.memory.snapshot(), "bottle_1", ahead, HAND) is level


@pytest.mark.parametrize(
    ("label", "high_m", "barred"), [("stool", 0.84, False), ("basket", 0.84, True), ("bench", 1.2, True)]
)
def test_what_was_measured_as_a_part_of_a_stool_bars_no_level_hand_over_it(flat, label, high_m, barred):
    """A bottle beside a clock on a stool: the stool seemed 8 cm higher than it is."""
    built = flat().thing(f"{label}_1", (1.0, 1.2, high_m / 2), (0.4, 0.4, high_m), support=True)
    built.bottle("bottle_1", 1.0, 1.2, on=f"{label}_1")
    ahead = SE3.from_xyz_yaw(0.6, 0.0, 0.87, 0.0)
    assert bars_level_hand(built.memory.snapshot(), "bottle_1", ahead, HAND) is barred


@pytest.mark.parametrize(("yaw_rad", "level"), [(0.0, True), (pi / 2, False), (pi, True)])
def test_a_thin_clock_beside_a_bottle_bars_a_level_hand_only_where_it_stands_across(flat, yaw_rad, level):
    built = flat().table().bottle("bottle_1", 1.0, 1.2)
    built.thing("clock_1", (0.85, 1.32, 0.81), (0.12, 0.03, 0.12), yaw=yaw_rad, on="table_1")
    ahead = SE3.from_xyz_yaw(0.6, 0.0, 0.87, 0.0)
    assert prefers_level(built.memory.snapshot(), "bottle_1", ahead, HAND) is level


@settings(max_examples=40, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(
    st.lists(st.tuples(st.floats(-0.5, 0.5), st.floats(-0.3, 0.3), st.floats(0.04, 0.3)), min_size=1, max_size=4),
    st.floats(-3.0, 3.0),
    st.floats(-3.0, 3.0),
)
def test_from_many_places_a_level_hand_is_barred_as_from_each_of_them(flat, things, yaw_rad, bearing_rad):
    built = flat().table().thing("bottle_1", (1.0, 1.2, 0.87), (0.07, 0.07, 0.24), yaw=yaw_rad, on="table_1")
    for k, (x_m, y_m, height_m) in enumerate(things):
        built.thing(f"box_{k + 1}", (1.0 + x_m, 1.2 + y_m, 0.75 + height_m / 2), (0.1, 0.05, height_m), on="table_1")
    snapshot = built.memory.snapshot()
    facing_rad = bearing_rad + pi
    alone = bars_level_hand(snapshot, "bottle_1", SE3.from_xyz_yaw(0.6, 0.0, 0.87, yaw_rad - facing_rad), HAND)
    places = np.array([(1.0 + 0.6 * cos(bearing_rad), 1.2 + 0.6 * sin(bearing_rad)), (0.4, 1.2)])
    assert bool(level_hand_barred(snapshot, "bottle_1", "room_1", places, HAND)[0]) is alone


@pytest.mark.parametrize(
    ("kind", "back_rad", "bearing_rad", "level"),
    [
        ("chair", pi / 2, -pi / 2, True),
        ("chair", pi / 2, 0.0, True),
        ("chair", pi / 2, pi / 2, False),
        ("chair", None, -pi / 2, False),
        ("sofa", pi / 2, -pi / 2, True),
        ("sofa", pi / 2, 0.0, False),
    ],
)
def test_a_bottle_on_a_seat_is_taken_level_unless_over_its_back_or_an_arm(flat, kind, back_rad, bearing_rad, level):
    size_m = (0.45, 0.45, 0.9) if kind == "chair" else (1.4, 0.9, 0.8)
    built = flat().thing(f"{kind}_1", (0.0, 0.0, size_m[2] / 2), size_m, support=True, back_rad=back_rad)
    z_m = 0.5 * size_m[2] + 0.12
    built.thing("bottle_1", (0.0, 0.0, z_m), (0.07, 0.07, 0.24), on=f"{kind}_1", graspable=True)
    from_there = SE3.from_xyz_yaw(0.65, 0.0, z_m, pi - bearing_rad)
    assert prefers_level(built.memory.snapshot(), "bottle_1", from_there, HAND) is level


@pytest.mark.parametrize(("y_m", "level"), [(0.0, True), (0.1, True), (0.17, False)])
def test_at_the_back_of_a_chair_no_level_hand_closes_however_far_the_bottle_is(flat, y_m, level):
    built = flat().thing("chair_1", (0.0, 0.0, 0.45), (0.45, 0.45, 0.9), support=True, back_rad=pi / 2)
    built.thing("bottle_1", (0.0, y_m, 0.57), (0.07, 0.07, 0.24), on="chair_1", graspable=True)
    far = SE3.from_xyz_yaw(1.0, 0.0, 0.57, -pi / 2)  # so far that only a level hand gets there
    snapshot, size_m = built.memory.snapshot(), (0.07, 0.07, 0.24)
    assert meets_support_level(snapshot, "bottle_1", far, HAND) is not level
    free = not meets_support_level(snapshot, "bottle_1", far, HAND)
    assert can_grasp(size_m, far, hand=HAND)
    assert can_grasp(size_m, far, hand=HAND, level_too=free) is level


def test_a_cup_is_taken_from_above_and_level_under_a_board(flat):
    built = flat().table().thing("cup_1", (1.0, 1.2, 0.8), (0.08, 0.08, 0.1), on="table_1")
    ahead = SE3.from_xyz_yaw(0.6, 0.0, 0.8, 0.0)
    assert not prefers_level(built.memory.snapshot(), "cup_1", ahead, HAND)
    built.thing("board_1", (1.0, 1.2, 1.1), (1.0, 0.4, 0.03))
    assert prefers_level(built.memory.snapshot(), "cup_1", ahead, HAND)


def test_what_lies_on_a_seat_is_taken_from_above_though_arms_and_back_are_higher(flat):
    built = flat().thing("sofa_1", (1.0, 1.2, 0.4), (1.8, 0.9, 0.8), support=True)
    built.thing("cup_1", (1.0, 1.2, 0.47), (0.08, 0.08, 0.1), on="sofa_1")
    assert not prefers_level(built.memory.snapshot(), "cup_1", SE3.from_xyz_yaw(0.6, 0.0, 0.47, 0.0), HAND)


@given(st.floats(0.0, 1.0), st.floats(0.45, 0.7), st.floats(0.3, 0.9))
def test_from_above_the_finger_tips_clear_what_lies_on_the_way(clear_over_m, x_m, z_m):
    grasp = choose_grasp((0.2, 0.08, 0.04), SE3.from_xyz_yaw(x_m, 0.0, z_m, 0.0), hand=HAND, level_first=False)
    *out, final = grasp.approach(x_m, HAND, clear_over_m=clear_over_m)
    heights = {gripper_pose(target, GEOMETRY).z_m - HAND.tip_m for target in out[:2]}
    assert min(heights) >= min(clear_over_m, z_m + 0.02) - 1e-9
    assert max(heights) >= clear_over_m - 1e-9
    assert out[0].extension_m == LIMITS.extension_m[0]
    assert (final.lift_m, final.extension_m) == (grasp.approach(x_m, HAND)[-1].lift_m, out[-1].extension_m)


@given(st.floats(-pi / 2, pi / 2), st.booleans())
def test_the_fingers_close_where_nothing_is_met(yaw_rad, first_side_met):
    pose, hindered = SE3.from_xyz_yaw(0.6, 0.0, 0.8, yaw_rad), yaw_rad + (0.0 if first_side_met else pi / 2)
    grasp = choose_grasp(
        (0.07, 0.07, 0.1), pose, hand=HAND, level_first=False,
        met=lambda direction, pad_m: int(abs(np.sin(direction - hindered)) < 0.1 and pad_m > 0.0),
    )  # fmt: skip
    closing = pi / 2 - grasp.roll_rad
    assert abs(np.sin(closing - hindered)) == pytest.approx(1.0)
