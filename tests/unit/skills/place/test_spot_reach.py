"""From where what is held gets to a spot."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from scene_graph.geometry.se3 import SE3
from skills.action import Grip
from skills.anchor import Anchor
from skills.arm.kinematics import gripper_pose
from skills.arm.settings import ReachSettings
from skills.place.place_spot import Spot
from skills.place.spot_choice import ChooseSpot
from skills.place.spot_reach import Placement, admitted, pressing_m

pytestmark = pytest.mark.anyio


REACH = ReachSettings()


@pytest.mark.parametrize(
    ("height_m", "held_at_m", "along_the_book", "beside_it"),
    [
        (0.036, 0.195, False, True),  # a bottle held at its neck: the lift ends before it is over the book
        (0.036, 0.08, True, True),
        (0.005, 0.195, True, True),
    ],
)
async def test_what_the_lift_does_not_bring_over_a_book_is_not_brought_across_it(
    kitchen, height_m, held_at_m, along_the_book, beside_it
):
    def build(built):
        built.thing("counter_1", (-1.0, 0.0, 0.45), (1.4, 0.6, 0.9), support=True)
        return built.thing(
            "book_1", (-1.0, -0.15, 0.9 + height_m / 2), (0.19, 0.09, height_m), on="counter_1", graspable=True
        )

    rehearsal = kitchen(build)
    context = await rehearsal.prepare()
    arm = replace(context.body.arm, wrist_pitch_rad=-pi / 2)
    hand = gripper_pose(arm, context.geometry)
    context.body = replace(context.body, arm=arm, T_base_gripper=hand)
    held = SE3.from_xyz_yaw(hand.x_m, hand.y_m, hand.z_m - held_at_m + 0.12, 0.0)
    context.grip = Grip(object_id="bottle_1", T_gripper_object=hand.inverse() @ held, size_m=(0.07, 0.07, 0.24))
    spot = Spot(anchor=Anchor("counter_1", (0.0, 0.1, 0.45)), room_m=1.0)
    places = np.array([[-1.0, -0.65], [-0.5, -0.5]])
    assert admitted(context, spot, places).tolist() == [along_the_book, beside_it]


@pytest.mark.parametrize(
    ("size_m", "aside_m", "pitch_rad", "pressed"),
    [
        ((0.07, 0.07, 0.12), 0.0, 0.0, True),
        ((0.07, 0.07, 0.12), 0.09, 0.0, True),
        ((0.07, 0.07, 0.12), 0.2, 0.0, False),
        ((0.07, 0.07, 0.06), 0.0, 0.0, False),  # the hand is over it still when the bottle stands
        ((0.07, 0.07, 0.12), 0.0, -pi / 2, False),  # from above, it comes down behind it
    ],
)
async def test_a_level_hand_is_not_lowered_onto_what_stands_before_the_spot(
    kitchen, size_m, aside_m, pitch_rad, pressed
):
    def build(built):
        built.thing("counter_1", (-1.0, 0.0, 0.45), (1.4, 0.6, 0.9), support=True)
        for name, y_m in (("can_1", -0.14), ("can_2", 0.14)):
            at = (-1.0 + aside_m, y_m, 0.9 + size_m[2] / 2)
            built.thing(name, at, size_m, on="counter_1", graspable=True)
        return built

    rehearsal = kitchen(build)
    context = await rehearsal.prepare()
    arm = replace(context.body.arm, wrist_pitch_rad=pitch_rad)
    hand = gripper_pose(arm, context.geometry)
    context.body = replace(context.body, arm=arm, T_base_gripper=hand)
    held = SE3.from_xyz_yaw(hand.x_m, hand.y_m, hand.z_m, 0.0)
    context.grip = Grip(object_id="bottle_1", T_gripper_object=hand.inverse() @ held, size_m=(0.07, 0.07, 0.24))
    behind, beside = (
        Spot(anchor=Anchor("counter_1", (0.0, 0.0, 0.45)), room_m=1.0),
        Spot(anchor=Anchor("counter_1", (-0.4, 0.0, 0.45)), room_m=1.0),
    )
    front = np.array([[-1.0, -0.6]])
    assert (pressing_m(context, behind, front)[0] >= REACH.barred_cost_m) == pressed
    placement = Placement(
        object_id="bottle_1", target="counter_1", spots=lambda: [behind], further=lambda: [[beside]], spot=behind
    )
    if pitch_rad == 0.0:
        assert (placement.price_m(context, front)[0] >= REACH.barred_cost_m) == pressed
        assert await rehearsal.run([ChooseSpot(context, placement)]) is None
        assert placement.spot == (beside if pressed and aside_m == 0.0 else behind)


@pytest.mark.parametrize(("roll_rad", "from_front", "from_side"), [(0.0, True, False), (pi / 2, False, True)])
async def test_what_is_put_before_the_back_of_a_chair_comes_with_the_palm_along_it(
    kitchen, roll_rad, from_front, from_side
):
    """Without a roll the fingers close, and the palm lies, across the arm; with a quarter turn, along it."""
    rehearsal = kitchen(
        lambda built: built.thing("chair_1", (-1.0, 0.0, 0.45), (0.45, 0.45, 0.9), support=True, back_rad=pi / 2)
    )
    context = await rehearsal.prepare()
    arm = replace(context.body.arm, wrist_pitch_rad=-pi / 2, wrist_roll_rad=roll_rad)
    context.body = replace(context.body, arm=arm)
    spot = Spot(anchor=Anchor("chair_1", (0.0, 0.13, 0.0)), room_m=1.0)
    places = np.array([[-1.0, -0.6], [-0.3, 0.13]])
    assert admitted(context, spot, places).tolist() == [from_front, from_side]
    context.body = replace(context.body, arm=replace(arm, wrist_pitch_rad=0.0))
    assert admitted(context, spot, places).tolist() == [True, False], "a level hand is behind what it holds, and broad"
