"""Closing the fingers on a thing."""

from __future__ import annotations

from dataclasses import replace

import pytest

from scene_graph.nodes import ObjectState
from skills.arm.gripper import CloseGripper
from skills.failures import FailureCode
from skills.registry import load_registry

pytestmark = pytest.mark.anyio


SKILLS = load_registry([])


@pytest.mark.parametrize("seen_m", [0.18, 0.24])
async def test_the_bottom_of_what_is_held_is_where_it_stood_though_only_its_upper_part_was_seen(kitchen, seen_m):
    rehearsal = kitchen()
    with rehearsal.memory.edit("objects", 0.0) as tx:
        tx.put(replace(rehearsal.memory.snapshot().object("bottle_1"), size_m=(0.07, 0.07, seen_m)))
    context = await rehearsal.prepare()
    assert await rehearsal.run(SKILLS["PICK"].actions(context, ["bottle_1"]), 900.0) is None
    assert context.grip.size_m[2] == pytest.approx(0.24, abs=0.01)


async def test_fingers_that_meet_are_an_empty_grasp(kitchen, carry_out):
    rehearsal = kitchen()
    rehearsal.body.grasped_width_m = lambda body: None
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.GRASP_EMPTY
    assert "contacts (False, False)" in failure.evidence.observation


async def test_one_finger_alone_holds_nothing(kitchen):
    rehearsal = kitchen()
    context = await rehearsal.prepare()

    def one_finger(r):
        r.context.body = replace(r.context.body, gripper_opening_m=0.05, finger_contacts=(True, False))

    rehearsal.observe = one_finger
    failure = await rehearsal.run([CloseGripper(context, "bottle_1")])
    assert failure.code is FailureCode.GRASP_EMPTY


async def test_fingers_that_come_to_no_rest_with_one_at_the_thing_push_on_and_then_let_go_of_it(kitchen):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    sent, grip = [], rehearsal.body.grip

    async def told(opening_m, effort_n=15.0):
        sent.append((opening_m, effort_n))
        await grip(opening_m, effort_n)

    def to_and_fro(r):
        rocks_m = 0.002 * (int(r.context.stamp_s / 0.4) % 2)  # it gives way to the force, and comes back
        r.context.body = replace(r.context.body, gripper_opening_m=0.07 + rocks_m, finger_contacts=(True, False))

    rehearsal.body.grip, rehearsal.observe = told, to_and_fro
    failure = await rehearsal.run([CloseGripper(context, "bottle_1")])
    assert failure.code is FailureCode.GRASP_EMPTY
    efforts_n = [effort_n for opening_m, effort_n in sent if opening_m == 0.0]
    assert efforts_n == sorted(efforts_n)
    assert efforts_n[-1] > efforts_n[0]
    assert sent[-1][0] > 0.069


async def test_what_slips_while_lifting_is_told(kitchen, carry_out):
    rehearsal = kitchen()
    firm, lifted = rehearsal.body.grasped_width_m, []

    def slippery(body):
        if body.arm.lift_m > 0.92 and body.opening_m < 0.08:
            lifted.append(True)
        return None if lifted else firm(body)

    rehearsal.body.grasped_width_m = slippery
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.SLIPPED


async def test_the_fingers_do_not_close_on_what_stands_beside_a_thing_that_went_while_they_came(
    kitchen, onlooker, carry_out
):
    rehearsal = kitchen()
    opening_m = rehearsal.body.opening_m

    def taken(r):
        onlooker(r)
        node = r.memory.snapshot().object("bottle_1")
        if r.body.arm.extension_m > 0.15 and node.state is ObjectState.PRESENT:
            with r.memory.edit("objects", r.body.stamp_s) as tx:
                tx.put(replace(node, state=ObjectState.MISSING))

    rehearsal.observe = taken
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.OBJECT_GONE
    assert "while I reached for it" in failure.message
    assert rehearsal.body.opening_m > 0.8 * opening_m
    assert rehearsal.body.arm.extension_m < 0.25
