"""What is taken hold of follows from the robot's description and from one value of settings."""

from __future__ import annotations

from dataclasses import replace

import pytest

from scene_graph.geometry.se3 import SE3
from skills.arm.barring import barring
from skills.arm.grasping import can_grasp
from skills.arm.hand import Hand, HandSettings
from skills.facts import read_state
from skills.furniture.furniture import Entry, Surface
from skills.ports import ArmGeometry, BodyLimits
from skills.registry import load_registry
from skills.settings import SkillSettings

BOTTLE_M = (0.07, 0.07, 0.24)


@pytest.mark.parametrize(("opening_m", "taken"), [(0.12, True), (0.07, False)])
def test_what_a_gripper_can_take_is_as_wide_as_its_fingers_open(opening_m, taken):
    hand = Hand(limits=BodyLimits(gripper_opening_m=(0.0, opening_m)))
    assert can_grasp(BOTTLE_M, SE3.from_xyz_yaw(0.55, 0.0, 0.8, 0.0), hand) is taken


def test_a_longer_hand_needs_more_room_over_a_board():
    short, long = (Hand(geometry=replace(ArmGeometry(), hand_length_m=m)) for m in (0.15, 0.25))
    assert long.usual_headroom_m((0.08, 0.08, 0.1)) > short.usual_headroom_m((0.08, 0.08, 0.1)) + 0.09


@pytest.mark.parametrize(("height_m", "entry", "reached"), [(0.2, Entry.ABOVE, True), (0.2, Entry.LEVEL, False)])
def test_a_low_board_is_out_of_reach_where_a_low_top_is_not(height_m, entry, reached):
    assert Hand().reaches(Surface(height_m=height_m, entry=entry), 0.0) is reached


def test_a_wider_palm_is_barred_by_what_a_narrow_one_passes(flat):
    built = flat().thing("shelf_1", (0.0, 2.3, 0.8), (0.9, 0.35, 1.6), support=True, surfaces_m=(0.4, 0.8, 1.2, 1.6))
    for name, x_m, y_m in (("apple_1", 0.0, 0.08), ("can_1", 0.12, -0.05)):
        built.thing(name, (x_m, 2.3 + y_m, 0.86), (0.066, 0.066, 0.12), on="shelf_1", graspable=True)
    wide = Hand(geometry=replace(ArmGeometry(), palm_half_m=(0.14, 0.02)))
    snapshot = built.memory.snapshot()
    assert barring(snapshot, "apple_1") == ()
    assert barring(snapshot, "apple_1", wide) == read_state(snapshot, wide).in_the_way_of("apple_1") == ("can_1",)


def test_one_value_configures_what_skills_plan_by_and_what_they_act_by(flat):
    settings = SkillSettings(hand=HandSettings(doubtful_width_m=0.06))
    built = flat().table().bottle()
    pick = load_registry([], settings)["PICK"]
    (unmet,) = pick.conditions(read_state(built.memory.snapshot()), ["bottle_1"])
    assert "too wide" in unmet.message
    assert built.context(settings=settings).hand.settings.doubtful_width_m == 0.06
