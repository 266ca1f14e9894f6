"""Room for fingers and palm around what is taken or put down from above."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest

from skills.arm.finger_room import fingers_met, palm_meets
from skills.arm.grasping import choose_grasp
from skills.arm.hand import Hand
from skills.doubles import FakeBody, Rehearsal
from skills.furniture.furniture import Furniture
from skills.geometry import Pose2
from skills.navigation.pose import in_base

pytestmark = pytest.mark.anyio


@pytest.mark.parametrize(
    ("glass_y_m", "height_m", "across"),
    [(0.06, 0.14, 2), (0.0, 0.14, 2), (-0.03, 0.14, 1), (-0.03, 0.34, 0), (0.0, 0.34, 1), (-0.3, 0.14, 0)],
)
async def test_neither_a_finger_nor_the_palm_comes_down_on_the_arm_of_a_sofa(flat, glass_y_m, height_m, across):
    built = flat().thing("sofa_1", (0.7, -0.7, 0.4), (1.9, 0.9, 0.8), yaw=pi / 2, support=True)
    size_m = (0.074, 0.074, height_m)
    built.thing("glass_1", (0.6, glass_y_m, 0.4 + height_m / 2), size_m, on="sofa_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody()).prepare()
    met = fingers_met(context, "glass_1")
    assert (met(0.0, 0.04), met(pi / 2, 0.04)) == (0, across)


async def test_of_a_chair_whose_back_nobody_has_seen_it_may_be_at_either_end(flat):
    built = flat().thing("chair_1", (0.62, 0.0, 0.45), (0.5, 0.45, 0.9), support=True)
    built.thing("can_1", (0.785, 0.0, 0.51), (0.066, 0.066, 0.12), on="chair_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody()).prepare()
    met = fingers_met(context, "can_1")
    assert (met(0.0, 0.06), met(pi / 2, 0.06)) == (2, 0)


@pytest.mark.parametrize(("x_m", "along"), [(0.6, 0), (0.72, 1), (0.745, 2)])
async def test_neither_a_finger_nor_the_palm_comes_down_on_the_back_of_a_chair(flat, x_m, along):
    built = flat().thing("chair_1", (0.62, 0.0, 0.45), (0.45, 0.45, 0.9), support=True)
    with built.memory.edit("test", 0.0) as tx:
        tx.put(replace(built.memory.snapshot().object("chair_1"), back_rad=0.0))
    built.thing("bottle_1", (x_m, 0.0, 0.57), (0.07, 0.07, 0.24), on="chair_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody()).prepare()
    met = fingers_met(context, "bottle_1")
    assert (met(0.0, 0.06), met(pi / 2, 0.06)) == (along, 0)


async def test_where_a_neighbor_stands_close_the_fingers_open_less(flat):
    built = flat().thing("table_1", (0.9, 0.0, 0.375), (1.2, 0.8, 0.75), support=True)
    for name, at in (("bottle_1", (0.6, 0.0)), ("bottle_2", (0.6, 0.105)), ("bottle_3", (0.705, 0.0))):
        built.thing(name, (*at, 0.87), (0.07, 0.07, 0.24), on="table_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody()).prepare()
    grasp = choose_grasp(
        (0.07, 0.07, 0.24), in_base(context, "bottle_1"), context.hand, level_first=False,
        met=fingers_met(context, "bottle_1"),
    )  # fmt: skip
    assert grasp.opening_m == pytest.approx(0.1)
    assert fingers_met(context, "bottle_1")(pi / 2, 0.06) == 1


@pytest.mark.parametrize(
    ("y_m", "toward_rad", "low_m", "met"),
    [
        (0.0, pi / 2, 0.6, False),
        (0.13, 0.0, 0.6, False),
        (0.13, pi / 2, 0.6, True),
        (0.13, -pi / 2, 0.6, True),
        (0.13, pi / 4, 0.6, True),
        (0.13, pi / 2, 0.95, False),  # over the back
        (0.18, 0.0, 0.6, True),
    ],
)
def test_the_palm_over_what_is_put_down_keeps_off_the_back_of_a_chair(flat, y_m, toward_rad, low_m, met):
    built = flat().thing("chair_1", (1.0, 2.0, 0.45), (0.45, 0.45, 0.9), support=True, back_rad=pi / 2, yaw=0.3)
    snapshot, frame = built.memory.snapshot(), "room_1"
    pose = Pose2.of(snapshot.transform(frame, "chair_1"))
    (middle,) = pose.apply(np.array([[0.0, y_m]]))
    chair, toward = Furniture.of(snapshot.object("chair_1")), np.array([toward_rad + 0.3])
    assert palm_meets(chair, pose, middle, toward, low_m - 0.45, Hand()).tolist() == [met]


@pytest.mark.parametrize(("back_m", "met"), [(0.185, True), (0.23, False), (None, False)])
def test_the_back_is_where_it_was_measured_however_deep_the_chair_is_believed_to_be(flat, back_m, met):
    """The box of a chair that was seen often is centimeters too deep: its back is not at the rim of it."""
    chair = {"support": True, "back_rad": -pi / 2, "back_m": back_m}
    snapshot = flat().thing("chair_1", (1.0, 2.0, 0.45), (0.49, 0.52, 0.9), **chair).memory.snapshot()
    pose, middle = Pose2.of(snapshot.transform("room_1", "chair_1")), np.array([0.87, 1.9])
    toward_rad = np.array([pi / 3])
    chair = Furniture.of(snapshot.object("chair_1"))
    assert palm_meets(chair, pose, middle, toward_rad, 0.15, Hand()).tolist() == [met]
