"""PICK and PLACE with a body that moves perfectly and perception that is played."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from math import atan2, cos, inf, pi, sin

import numpy as np
import pytest

from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectState
from skills.action import Grip
from skills.anchor import Anchor
from skills.arm.approach import STOPPED_RAD, ApproachForReach
from skills.arm.arm import CARRY_LIFT_M, Retract
from skills.arm.arm_way import BARRED_COST_M, IN_THE_WAY_COST_M, MET_COST_M, clear_over_m, passing_over, routes_around
from skills.arm.finger_room import fingers_met, palm_meets_rims
from skills.arm.grasping import DOWN_RAD, choose_grasp
from skills.arm.kinematics import gripper_pose
from skills.arm.spot_reach import Placement, admitted, pressing_m
from skills.doubles import BoxWorld, FakeBody, Rehearsal
from skills.failures import FailureCode
from skills.geometry import Box2, Pose2
from skills.navigation.pose import bearing_rad, in_base
from skills.pick.grasp import CloseGripper
from skills.place.place_search import free_spots
from skills.place.place_spot import Spot
from skills.place.put_down import LowerToPlace
from skills.place.seen_in_way import Seen
from skills.place.spot_choice import CheckSpot, ChooseSpot
from skills.ports import ArmTarget
from skills.registry import load_registry
from skills.state.state import PlanState

pytestmark = pytest.mark.anyio
SKILLS = load_registry([])
TABLES = (Box2(Pose2(1.0, 1.2), 1.2, 0.8), Box2(Pose2(-1.5, -1.5), 1.2, 0.8))


@pytest.fixture
def kitchen(flat, onlooker, fingers):
    """A rehearsal at a bottle on a table, with a second table."""

    def build(change=lambda built: built):
        built = change(flat().table().bottle().table("table_2", -1.5, -1.5))
        body = FakeBody(pose=Pose2(0.9, 0.35, 1.5), grasped_width_m=fingers(built.memory))
        world = BoxWorld(boxes=TABLES, heights_m=(0.3, 0.6))
        return Rehearsal(memory=built.memory, body=body, world=world, observe=onlooker)

    return build


async def carry_out(rehearsal, *steps):
    context = await rehearsal.prepare()
    for skill, *args in steps:
        began_s = rehearsal.body.stamp_s
        failure = await rehearsal.run(SKILLS[skill].actions(context, args), 900.0)
        failure = failure or SKILLS[skill].confirmed(rehearsal.memory.snapshot(), args, began_s)
        if failure is not None:
            return failure
    return None


async def test_a_bottle_is_fetched_from_one_table_to_the_other(kitchen):
    rehearsal = kitchen()
    steps = (("GOTO", "bottle_1"), ("PICK", "bottle_1"), ("GOTO", "table_2"), ("PLACE", "bottle_1", "table_2"))
    assert await carry_out(rehearsal, *steps) is None
    snapshot = rehearsal.memory.snapshot()
    assert snapshot.support_of("bottle_1") == "table_2"
    assert snapshot.robot.holding is None
    assert rehearsal.body.arm.extension_m == pytest.approx(0.0, abs=0.01)
    assert rehearsal.least_clearance_m > 0.28


@pytest.mark.parametrize("target", ["room_1", "person_1", "table_1"])
async def test_what_is_held_can_be_put_down_for_any_kind_of_target(kitchen, target):
    rehearsal = kitchen(lambda built: built.person(0.0, 1.8))
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", target), ("PLACE", "bottle_1", target)) is None
    assert rehearsal.memory.snapshot().support_of("bottle_1") == "table_1"


@pytest.mark.parametrize("tables", [0, 1])
async def test_in_a_room_what_is_not_known_by_name_carries_things_only_where_nothing_else_does(flat, tables):
    built = flat().thing("unknown_1", (0.9, 0.0, 0.4), (0.6, 0.5, 0.8), support=True)
    built.thing("cup_1", (0.0, 1.0, 0.05), (0.08, 0.08, 0.1), graspable=True)
    built = built.table() if tables else built
    context = await Rehearsal(memory=built.memory).prepare()
    spots = free_spots(context, "cup_1", "room_1")
    assert {spot.anchor.node_id for spot in spots} == {"table_1" if tables else "unknown_1"}


async def test_where_the_arm_was_stopped_on_its_way_to_the_floor_it_does_not_go_again_soon(flat):
    built = flat().thing("cup_1", (0.0, 1.0, 0.05), (0.08, 0.08, 0.1), graspable=True)
    context = await Rehearsal(memory=built.memory).prepare()
    stopped, *others = [spot.anchor for spot in free_spots(context, "cup_1", "room_1")]
    context.blocked_spots[stopped.node_id, stopped.point_m] = context.stamp_s
    again = [spot.anchor for spot in free_spots(context, "cup_1", "room_1")]
    assert again
    assert set(again) <= set(others)
    assert min(np.hypot(*np.subtract(on.point_m, stopped.point_m)[:2]) for on in again) > 0.1


async def test_with_no_table_near_it_is_put_on_the_floor_beside_the_person(kitchen):
    rehearsal = kitchen(lambda built: built.person(-2.0, 1.5))
    steps = (("PICK", "bottle_1"), ("GOTO", "person_1"), ("PLACE", "bottle_1", "person_1"))
    assert await carry_out(rehearsal, *steps) is None
    snapshot = rehearsal.memory.snapshot()
    assert snapshot.support_of("bottle_1") is None
    assert snapshot.position("bottle_1", "room_1")[2] == pytest.approx(0.12)


async def test_where_something_stands_before_a_thing_the_arm_comes_from_another_side(kitchen):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    bottle = rehearsal.memory.snapshot().position("bottle_1", "room_1")
    x_m, y_m = 0.6 * bottle[:2] + 0.4 * np.array(rehearsal.body.pose.point)
    built[0].thing("can_1", (float(x_m), float(y_m), 0.82), (0.07, 0.07, 0.13), on="table_1", graspable=True)
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    base = np.array(rehearsal.body.pose.point)
    places, snapshot = base[None, :], rehearsal.memory.snapshot()
    assert passing_over(snapshot, "room_1", bottle, 0.8, places, {"bottle_1", "table_1"}, stamp_s=0.0) == 0.0


@pytest.mark.parametrize("beside", [False, True])
async def test_a_tall_thing_is_taken_level_from_another_side_rather_than_from_above(kitchen, beside):
    """Hanging from the hand it is lifted onto nothing high: a bottle could not be put on a cabinet."""
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat.bottle("bottle_2", 0.6, 1.0)) or flat)
    if beside:  # so far off that the arm passes, but not surely the hand
        built[0].thing("box_1", (0.7, 1.0, 0.85), (0.04, 0.2, 0.2), on="table_1", graspable=True)
    rehearsal.body.pose = Pose2(0.6, 0.4, pi / 2)
    assert await carry_out(rehearsal, ("PICK", "bottle_2")) is None
    assert abs(rehearsal.body.arm.wrist_pitch_rad) < 0.1
    assert bool(rehearsal.body.pose.x_m < 0.3) is beside


@pytest.mark.parametrize("crowded", [False, True])
async def test_to_what_only_a_hand_from_above_gets_the_robot_comes_near_enough_for_that(flat, crowded):
    built = flat().table().bottle("bottle_1", 1.0, 1.0)
    for k in range(4 if crowded else 0):
        x_m, y_m = 1.0 + 0.1 * cos(pi / 4 + k * pi / 2), 1.0 + 0.1 * sin(pi / 4 + k * pi / 2)
        built.thing(f"can_{k}", (x_m, y_m, 0.815), (0.05, 0.05, 0.13), on="table_1", graspable=True)
    context = await Rehearsal(memory=built.memory).prepare()
    action = ApproachForReach(context, "bottle_1", Anchor("bottle_1"))
    routes = routes_around(context, (0.0, 0.0), [(1.0, 1.0)])
    away_m = [np.hypot(goal.point[0] - 1.0, goal.point[1] - 1.0) for goal in action._goals_around(routes)]
    assert bool(max(away_m) > 0.95) is not crowded


@pytest.mark.parametrize("high_m", [0.12, 0.24])
async def test_what_the_lift_does_not_bring_over_a_bottle_is_not_taken_across_it(flat, high_m):
    built = flat().thing("counter_1", (1.0, 1.2, 0.43), (1.2, 0.8, 0.86), support=True)
    built.thing("ball_1", (1.0, 1.1, 0.9), (0.08, 0.08, 0.08), on="counter_1", graspable=True)
    built.thing("bottle_1", (1.0, 0.9, 0.86 + high_m / 2), (0.07, 0.07, high_m), on="counter_1", graspable=True)
    rehearsal = Rehearsal(memory=built.memory, body=FakeBody(pose=Pose2(1.0, 0.35, pi / 2)))
    context = await rehearsal.prepare()
    action = ApproachForReach(context, "ball_1", Anchor("ball_1"))
    assert action._reaches_from_here(BARRED_COST_M) is (high_m < 0.2)
    goals = action._goals_around(routes_around(context, (1.0, 0.35), [(1.0, 1.1)]))
    sides_rad = [abs(atan2(goal.point[0] - 1.0, 1.1 - goal.point[1])) for goal in goals]
    assert bool(min(sides_rad) < 0.1) is (high_m < 0.2)
    assert min(sides_rad) < pi / 4


@pytest.mark.parametrize("bearing_rad", [pi, 5 * pi / 4, 3 * pi / 2])
async def test_who_is_handed_something_stands_where_the_arm_does_not_go(kitchen, bearing_rad):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    x_m, y_m, _ = rehearsal.memory.snapshot().position("table_1", "room_1")
    built[0].person(float(x_m + 0.5 * cos(bearing_rad)), float(y_m + 0.5 * sin(bearing_rad)), stamp_s=1e6)
    assert await carry_out(rehearsal, ("GOTO", "person_1"), ("PLACE", "bottle_1", "person_1")) is None


@pytest.mark.parametrize("seen_m", [0.18, 0.24])
async def test_the_bottom_of_what_is_held_is_where_it_stood_though_only_its_upper_part_was_seen(kitchen, seen_m):
    rehearsal = kitchen()
    with rehearsal.memory.edit("objects", 0.0) as tx:
        tx.put(replace(rehearsal.memory.snapshot().object("bottle_1"), size_m=(0.07, 0.07, seen_m)))
    context = await rehearsal.prepare()
    assert await rehearsal.run(SKILLS["PICK"].actions(context, ["bottle_1"]), 900.0) is None
    assert context.grip.size_m[2] == pytest.approx(0.24, abs=0.01)


async def test_the_state_read_after_goto_allows_pick(kitchen):
    rehearsal = kitchen()
    rehearsal.body.pose = Pose2(-1.0, 1.0)
    assert await carry_out(rehearsal, ("GOTO", "bottle_1")) is None
    state = PlanState.from_snapshot(rehearsal.memory.snapshot())
    assert SKILLS["PICK"].conditions(state, ("bottle_1",)) == []
    assert await carry_out(rehearsal, ("GOTO", "table_2")) is None
    state = PlanState.from_snapshot(rehearsal.memory.snapshot())
    assert SKILLS["PICK"].conditions(state, ("bottle_1",)) != []
    assert state.is_at("table_2")


async def test_fingers_that_meet_are_an_empty_grasp(kitchen):
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


async def test_what_slips_while_lifting_is_told(kitchen):
    rehearsal = kitchen()
    firm, lifted = rehearsal.body.grasped_width_m, []

    def slippery(body):
        if body.arm.lift_m > 0.92 and body.opening_m < 0.08:
            lifted.append(True)
        return None if lifted else firm(body)

    rehearsal.body.grasped_width_m = slippery
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.SLIPPED


async def test_an_object_that_perception_misses_is_gone(kitchen, onlooker):
    rehearsal = kitchen()

    def vanish(r):
        onlooker(r)
        node = r.memory.snapshot().object("bottle_1")
        if r.body.stamp_s > 1.0 and node.state is ObjectState.PRESENT:
            with r.memory.edit("objects", r.body.stamp_s) as tx:
                tx.put(replace(node, state=ObjectState.MISSING))

    rehearsal.observe = vanish
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.OBJECT_GONE


async def test_the_fingers_do_not_close_on_what_stands_beside_a_thing_that_went_while_they_came(kitchen, onlooker):
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


async def test_what_the_lift_only_brings_level_to_a_thing_that_others_bar_is_left(flat):
    """A tall bottle on a high counter, with others all around it, was pushed at."""
    built = flat().thing("counter_1", (1.0, 1.2, 0.485), (1.2, 0.8, 0.97), support=True)
    built.thing("bottle_1", (1.0, 1.1, 1.09), (0.07, 0.07, 0.24), on="counter_1", graspable=True)
    for k in range(6):
        x_m, y_m = 1.0 + 0.16 * cos(k * pi / 3), 1.1 + 0.16 * sin(k * pi / 3)
        built.thing(f"can_{k}", (x_m, y_m, 1.035), (0.07, 0.07, 0.13), on="counter_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody(pose=Pose2(1.0, 0.35, pi / 2))).prepare()
    action = ApproachForReach(context, "bottle_1", Anchor("bottle_1"))
    assert action._goals_around(routes_around(context, (1.0, 0.35), [(1.0, 1.1)])) == []


async def test_an_object_that_is_not_seen_again_is_gone_and_looked_at_from_another_side_next_time(kitchen, onlooker):
    onlooker.blind_to.add("bottle_1")
    rehearsal = kitchen()
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.OBJECT_GONE
    assert "not seen for 8 s" in failure.message
    context = await rehearsal.prepare()
    first_rad = bearing_rad(context, "bottle_1")
    onlooker.blind_to.clear()
    assert await rehearsal.run(SKILLS["PICK"].actions(context, ["bottle_1"])[:5], 900.0) is None
    assert abs(np.angle(np.exp(1j * (bearing_rad(context, "bottle_1") - first_rad)))) > STOPPED_RAD


def moved_to(x, y):
    def move(rehearsal):
        status = rehearsal.memory.snapshot().robot.status
        if status.startswith("driving") and rehearsal.body.stamp_s > 0.5:
            with rehearsal.memory.edit("objects", rehearsal.body.stamp_s) as tx:
                pose = SE3.from_xyz_yaw(x, y, 0.87, 0.0)
                tx.put(RtEdge(source="room_1", target="bottle_1", T_source_target=pose))

    return move


@pytest.mark.parametrize(("place", "code"), [((1.1, 1.05), None), ((-1.5, -1.3), FailureCode.OBJECT_MOVED)])
async def test_a_moved_object_is_followed_within_reach_and_told_beyond(kitchen, onlooker, place, code):
    rehearsal = kitchen()
    rehearsal.body.pose = Pose2(-0.5, 0.3)
    rehearsal.memory.snapshot()
    context = await rehearsal.prepare()
    actions = SKILLS["PICK"].actions(context, ["bottle_1"])
    assert await rehearsal.run(actions[:3]) is None
    with rehearsal.memory.edit("objects", 0.0) as tx:
        tx.put(RtEdge(source="room_1", target="bottle_1", T_source_target=SE3.from_xyz_yaw(*place, 0.87, 0.0)))
    failure = await rehearsal.run(actions[3:], 900.0)
    assert (failure.code if failure else None) is code


async def test_a_full_table_is_told_before_anything_moves(kitchen):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    with rehearsal.memory.edit("test", 0.0) as tx:
        table = rehearsal.memory.snapshot().object("table_2")
        tx.put(replace(table, size_m=(0.1, 0.1, 0.75)))
    failure = await carry_out(rehearsal, ("PLACE", "bottle_1", "table_2"))
    assert failure.code is FailureCode.SUPPORT_FULL


async def test_where_things_leave_free_only_what_cannot_be_reached_the_table_is_full(kitchen):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    spot = free_spots(context, "bottle_1", "table_1")[0]
    placement = Placement(
        object_id="bottle_1",
        target="table_2",
        spots=lambda: [replace(spot, anchor=Anchor("table_2", (0.0, 0.0, 3.0)))],
        spots_if_empty=lambda: free_spots(context, "bottle_1", "table_2", as_empty=True),
    )
    assert (await rehearsal.run([ChooseSpot(context, placement)])).code is FailureCode.SUPPORT_FULL
    placement.spots_if_empty = list
    assert (await rehearsal.run([ChooseSpot(context, placement)])).code is FailureCode.UNREACHABLE


@pytest.mark.parametrize(
    ("label", "graspable", "code"),
    [("plant", False, FailureCode.UNREACHABLE), ("plant", True, FailureCode.UNREACHABLE), ("unknown", True, None)],
)
async def test_a_spot_is_chosen_to_which_the_arm_gets_past_what_is_higher(kitchen, label, graspable, code):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    spots = free_spots(context, "bottle_1", "table_2")
    placement = Placement(object_id="bottle_1", target="table_2", spots=lambda: spots, spots_if_empty=list)
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    cheapest = placement.spot
    x_m, y_m, _ = cheapest.anchor.position(rehearsal.memory.snapshot(), "room_1")
    built[0].thing(f"{label}_1", (x_m, y_m, 1.15), (0.1, 0.1, 0.3), graspable=graspable)
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    x2_m, y2_m, _ = placement.spot.anchor.position(rehearsal.memory.snapshot(), "room_1")
    assert np.hypot(x2_m - x_m, y2_m - y_m) > 0.1
    placement.spots = lambda: [cheapest]
    failure = await rehearsal.run([ChooseSpot(context, placement)])
    assert (failure.code if failure else None) is code


async def test_nothing_is_put_before_another_thing_on_a_board_where_there_is_a_spot_beside_it(kitchen):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    spots = free_spots(context, "bottle_1", "table_2")
    placement = Placement(object_id="bottle_1", target="table_2", spots=lambda: spots)
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    first = placement.spot
    spots[spots.index(first)] = replace(first, bars=1)
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    assert placement.spot.bars == 0
    placement.spots = lambda: [replace(first, bars=1)]
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None


async def test_things_that_keep_the_arm_from_every_spot_of_a_table_make_it_full(kitchen):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    spot = free_spots(context, "bottle_1", "table_2")[0]
    x_m, y_m, _ = spot.anchor.position(rehearsal.memory.snapshot(), "room_1")
    built[0].thing("plant_1", (x_m, y_m, 1.1), (0.1, 0.1, 0.7), on="table_2")
    placement = Placement(object_id="bottle_1", target="table_2", spots=lambda: [spot], spots_if_empty=lambda: [spot])
    assert (await rehearsal.run([ChooseSpot(context, placement)])).code is FailureCode.SUPPORT_FULL


async def test_where_no_good_spot_is_within_reach_the_next_best_is_taken(kitchen):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    low, *others = free_spots(context, "bottle_1", "table_2")
    high = replace(low, anchor=Anchor("table_2", (0.0, 0.0, 3.0)))
    placement = Placement(
        object_id="bottle_1", target="room_1", spots=lambda: [high], further=lambda: [[high], [low], others]
    )
    assert await rehearsal.run([ChooseSpot(context, placement)]) is None
    assert placement.spot == low
    assert low in placement.spots_at("table_2")


async def test_a_place_taken_meanwhile_is_exchanged_for_a_free_one(kitchen, onlooker):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "table_2"])
    assert await rehearsal.run(actions[:3], 900.0) is None
    x, y, _ = actions[1]._placement.spot.anchor.position(rehearsal.memory.snapshot(), "room_1")
    with rehearsal.memory.edit("test", 0.0) as tx:
        cup = replace(rehearsal.memory.snapshot().object("bottle_1"), id="cup_1", state=ObjectState.PRESENT)
        tx.put(cup, RtEdge(source="room_1", target="cup_1", T_source_target=SE3.from_xyz_yaw(x, y, 0.87, 0.0)))
        from scene_graph.edges import InEdge

        tx.put(InEdge(source="cup_1", target="room_1"))
    assert await rehearsal.run(actions[3:], 900.0) is None
    a, b = (rehearsal.memory.snapshot().position(node, "room_1") for node in ("bottle_1", "cup_1"))
    assert abs(a - b)[:2].max() > 0.05


async def test_the_robot_says_what_it_tries(kitchen, onlooker):
    rehearsal, said = kitchen(), []

    def listen(r):
        onlooker(r)
        status = r.memory.snapshot().robot.status
        if not said or said[-1] != status:
            said.append(status)

    rehearsal.observe = listen
    await carry_out(rehearsal, ("PICK", "bottle_1"), ("PLACE", "bottle_1", "table_1"))
    assert said == [
        "idle",
        "driving to bottle_1",
        "grasping bottle_1",
        "driving to table_1",
        "releasing bottle_1 table_1",
    ]


async def test_an_object_out_of_reach_in_the_middle_of_a_wide_table_is_told(flat, onlooker, fingers):
    built = flat().thing("table_1", (0.0, 1.2, 0.375), (3.0, 2.2, 0.75), support=True).bottle("bottle_1", 0.0, 1.2)
    world = BoxWorld(boxes=(Box2(Pose2(0.0, 1.2), 3.0, 2.2),), heights_m=(0.3, 0.6))
    body = FakeBody(pose=Pose2(0.0, -1.0), grasped_width_m=fingers(built.memory))
    rehearsal = Rehearsal(memory=built.memory, body=body, world=world, observe=onlooker)
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.UNREACHABLE
    assert "places tried" in failure.evidence.observation


async def test_an_object_not_in_the_arms_plane_is_not_reached_for(kitchen):
    rehearsal = kitchen()
    rehearsal.body.pose = Pose2(0.9, 0.35, 1.2)
    context = await rehearsal.prepare()
    reach = SKILLS["PICK"].actions(context, ["bottle_1"])[5]
    failure = await rehearsal.run([reach])
    assert failure.code is FailureCode.UNREACHABLE
    assert "beside the arm's plane" in failure.message


async def test_with_something_in_the_hand_the_base_speeds_up_slowly(kitchen):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    speeds = []
    onlooker = rehearsal.observe

    def measure(r):
        onlooker(r)
        speeds.append(r.body.velocity[0])

    rehearsal.observe = measure
    assert await carry_out(rehearsal, ("GOTO", "table_2")) is None
    gains = [b - a for a, b in pairwise(speeds)]
    assert max(gains) / rehearsal.dt_s < 0.5
    assert max(speeds) <= 0.6 * rehearsal.body.limits.linear_mps + 1e-9


async def test_a_table_higher_than_the_lift_is_told_before_driving_there(kitchen):
    rehearsal = kitchen(lambda built: built.thing("shelf_1", (-1.5, 1.5, 0.7), (0.8, 0.4, 1.4), support=True))
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    failure = await carry_out(rehearsal, ("PLACE", "bottle_1", "shelf_1"))
    assert failure.code is FailureCode.UNREACHABLE


async def test_what_is_too_high_for_a_hand_from_above_is_taken_from_the_side_that_fits_between_the_fingers(
    flat, onlooker, fingers
):
    built = flat().thing("counter_1", (1.0, 1.2, 0.5), (0.5, 0.5, 1.0), support=True)
    built.thing("bear_1", (1.0, 1.2, 1.1), (0.14, 0.07, 0.2), on="counter_1", graspable=True)
    body = FakeBody(pose=Pose2(1.0, 0.3, 1.57), grasped_width_m=fingers(built.memory))
    world = BoxWorld(boxes=(Box2(Pose2(1.0, 1.2), 0.5, 0.5),), heights_m=(0.3, 0.6))
    rehearsal = Rehearsal(memory=built.memory, body=body, world=world, observe=onlooker)
    assert await carry_out(rehearsal, ("GOTO", "bear_1"), ("PICK", "bear_1")) is None
    assert abs(rehearsal.body.pose.y_m - 1.2) < 0.3


async def test_where_something_unseen_stopped_the_arm_nothing_is_put_next_time(kitchen, onlooker):
    rehearsal = kitchen()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "table_2"])
    assert await rehearsal.run(actions[:5], 900.0) is None
    spot = actions[1]._placement.spot.anchor.position(rehearsal.memory.snapshot(), "room_1")[:2]

    def stop_the_arm(r):
        onlooker(r)
        hand = gripper_pose(r.body.arm, r.body.geometry)
        if np.hypot(*(r.body.pose.apply(np.array([[hand.x_m, hand.y_m]]))[0] - spot)) < 0.1:
            r.body.arm = replace(r.body.arm, lift_m=max(r.body.arm.lift_m, 1.0))

    rehearsal.observe = stop_the_arm
    assert (await rehearsal.run(actions[5:], 900.0)).code is FailureCode.UNREACHABLE
    left = [each.anchor.position(rehearsal.memory.snapshot(), "room_1")[:2] for each in actions[1]._placement.spots()]
    assert min(np.hypot(*(at - spot)) for at in left) > 0.1
    assert await carry_out(rehearsal, ("PLACE", "bottle_1", "table_2")) is None


async def test_from_where_the_arm_was_stopped_it_is_not_reached_again_while_there_is_another_side(kitchen, onlooker):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    bottle, sides = np.array((1.0, 0.95)), []

    def stop_the_arm(r):
        onlooker(r)
        side = bearing_rad(context, "bottle_1")
        hand = gripper_pose(r.body.arm, r.body.geometry)
        near = np.hypot(*(r.body.pose.apply(np.array([[hand.x_m, hand.y_m]]))[0] - bottle)) < 0.1
        if near and abs(np.angle(np.exp(1j * (side - (sides or [side])[0])))) < 0.3:
            sides.append(side)
            r.body.arm = replace(r.body.arm, lift_m=max(r.body.arm.lift_m, 1.2))

    rehearsal.observe = stop_the_arm
    assert (await carry_out(rehearsal, ("PICK", "bottle_1"))).code is FailureCode.UNREACHABLE
    assert sides
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None


@pytest.mark.parametrize(("gap_m", "code"), [(0.165, FailureCode.UNREACHABLE), (0.24, None)])
async def test_between_boxes_on_a_board_that_leave_no_room_for_the_hand_it_does_not_even_begin(
    flat, onlooker, fingers, gap_m, code
):
    built = flat().thing("shelf_1", (1.0, 2.3, 0.8), (0.9, 0.35, 1.6), support=True, surfaces_m=(0.4, 0.8, 1.2))
    built.thing("glass_1", (1.0, 2.35, 0.87), (0.07, 0.07, 0.14), on="shelf_1", graspable=True)
    for name, side in (("box_1", -1), ("box_2", 1)):
        x_m = 1.0 + side * (gap_m / 2 + 0.05)
        built.thing(name, (x_m, 2.25, 0.85), (0.1, 0.08, 0.1), on="shelf_1", graspable=True)
    body = FakeBody(pose=Pose2(1.0, 1.0, 1.5), grasped_width_m=fingers(built.memory))
    rehearsal, farthest_m = Rehearsal(memory=built.memory, body=body, observe=onlooker), []

    def measure(r):
        onlooker(r)
        farthest_m.append(r.body.arm.extension_m)

    rehearsal.observe = measure
    failure = await carry_out(rehearsal, ("PICK", "glass_1"))
    assert (failure.code if failure else None) is code
    assert (max(farthest_m) > 0.1) is (code is None)


async def test_what_stops_the_arm_on_its_way_in_between_boards_is_not_the_board(flat, onlooker, fingers):
    built = flat().table().bottle()
    built.thing("shelf_1", (-1.5, 2.3, 0.8), (0.9, 0.35, 1.6), support=True, surfaces_m=(0.4, 0.8, 1.2))
    body = FakeBody(pose=Pose2(0.9, 0.35, 1.5), grasped_width_m=fingers(built.memory))
    rehearsal = Rehearsal(memory=built.memory, body=body, observe=onlooker)
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "shelf_1")) is None
    context = await rehearsal.prepare()
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "shelf_1"])
    lowering = next(index for index, action in enumerate(actions) if isinstance(action, LowerToPlace))
    assert await rehearsal.run(actions[:lowering], 900.0) is None

    def stop_the_arm(r):
        onlooker(r)
        r.body.arm = replace(r.body.arm, extension_m=min(r.body.arm.extension_m, 0.15))

    rehearsal.observe = stop_the_arm
    assert (await rehearsal.run(actions[lowering:], 900.0)).code is FailureCode.UNREACHABLE


async def test_what_is_put_down_near_the_end_of_the_lift_is_lowered_to_where_it_stands(kitchen):
    """A target above the lift's end stalls the arm, which then is taken to have met the surface."""
    rehearsal = kitchen()
    low_m, high_m = rehearsal.body.limits.lift_m
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    context = await rehearsal.prepare()
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "table_2"])
    lowering = next(index for index, action in enumerate(actions) if isinstance(action, LowerToPlace))
    assert await rehearsal.run(actions[:lowering], 900.0) is None
    released_m = []

    def end_the_lift(r):
        r.body.arm = replace(r.body.arm, lift_m=min(r.body.arm.lift_m, r.context.limits.lift_m[1]))
        released_m.append(r.body.arm.lift_m)

    actions[lowering].begin()
    standing_m = actions[lowering]._standing.lift_m
    rehearsal.context.limits = replace(context.limits, lift_m=(low_m, standing_m + 0.025))
    rehearsal.observe = end_the_lift
    assert high_m > standing_m + 0.1
    assert await rehearsal.run([actions[lowering]], 900.0) is None
    assert rehearsal.body.arm.lift_m == pytest.approx(standing_m, abs=0.006)


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


@pytest.mark.parametrize(
    ("beside", "along", "across"),
    [((0.0, 0.09), 0, 1), ((0.09, 0.0), 1, 0), ((0.0, 0.2), 0, 0)],
)
async def test_a_finger_does_not_come_down_on_a_neighbor(flat, beside, along, across):
    built = flat().thing("table_1", (0.9, 0.0, 0.375), (1.2, 0.8, 0.75), support=True)
    built.thing("can_1", (0.6, 0.0, 0.81), (0.066, 0.066, 0.12), on="table_1", graspable=True)
    built.thing("cup_1", (0.6 + beside[0], beside[1], 0.8), (0.06, 0.06, 0.1), on="table_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody()).prepare()
    met = fingers_met(context, "can_1")
    assert (met(0.0, 0.06), met(pi / 2, 0.06)) == (along, across)


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
        (0.07, 0.07, 0.24), in_base(context, "bottle_1"), level_first=False, geometry=context.geometry,
        limits=context.limits, met=fingers_met(context, "bottle_1"),
    )  # fmt: skip
    assert grasp.opening_m == pytest.approx(0.1)
    assert fingers_met(context, "bottle_1")(pi / 2, 0.06) == 1


@pytest.mark.parametrize(
    ("cup_x_m", "cup_y_m", "clear_m"), [(0.45, 0.0, 0.89), (0.45, 0.11, 0.89), (0.45, 0.2, 0.0), (0.9, 0.0, 0.0)]
)
async def test_the_hand_goes_over_the_small_things_on_its_way(flat, cup_x_m, cup_y_m, clear_m):
    built = flat().thing("table_1", (0.9, 0.0, 0.375), (1.2, 0.8, 0.75), support=True)
    built.thing("book_1", (0.7, 0.0, 0.77), (0.2, 0.08, 0.04), on="table_1", graspable=True)
    built.thing("cup_1", (cup_x_m, cup_y_m, 0.8), (0.08, 0.08, 0.1), on="table_1", graspable=True)
    context = await Rehearsal(memory=built.memory, body=FakeBody()).prepare()
    assert clear_over_m(context, 0.7, "book_1") == pytest.approx(clear_m)


@pytest.mark.parametrize(
    ("height_m", "aside_m", "cost_m"),
    [(0.96, 0.0, inf), (0.96, -0.01, BARRED_COST_M), (0.96, -0.15, 0.0), (0.4, 0.0, 0.0)],
)
async def test_the_end_of_something_long_bars_the_arm_if_it_is_higher_than_the_hand(flat, height_m, aside_m, cost_m):
    built = flat().thing("stool_1", (0.12, 0.08, 0.25), (0.4, 0.4, 0.5), yaw=-2.08, support=True)
    built.thing("bottle_1", (0.0, 0.0, 0.62), (0.07, 0.07, 0.24), on="stool_1", graspable=True)
    built.thing("cabinet_1", (-0.31, -0.64 + aside_m, height_m / 2), (0.98, 0.44, height_m), yaw=-2.08, support=True)
    places = np.array(((-0.70, -0.13), (0.70, 0.13)))  # past the end of the cabinet, whose middle is far, and opposite
    snapshot = built.memory.snapshot()
    costs = passing_over(snapshot, "room_1", np.zeros(3), 0.5, places, {"bottle_1", "stool_1"}, stamp_s=0.0)
    assert costs.tolist() == [cost_m, 0.0]


@pytest.mark.parametrize(("name", "cost_m"), [("unknown_1", MET_COST_M), ("cup_1", MET_COST_M), ("plant_1", inf)])
async def test_a_small_thing_without_a_name_does_not_keep_the_hand_from_what_it_may_be_a_part_of(flat, name, cost_m):
    built = flat().thing("book_1", (0.0, 0.0, 0.47), (0.2, 0.08, 0.03), graspable=True)
    built.thing(name, (0.02, 0.0, 0.6), (0.14, 0.13, 0.2), graspable=name == "cup_1")
    places = np.array(((0.6, 0.0), (-0.6, 0.3)))
    costs = passing_over(built.memory.snapshot(), "room_1", np.zeros(3), 0.5, places, {"book_1"}, stamp_s=0.0)
    assert costs.tolist() == [cost_m, cost_m]


def test_what_the_arm_would_meet_in_the_middle_costs_more_than_what_it_would_graze(flat):
    built = flat().thing("book_1", (0.0, 0.0, 0.47), (0.2, 0.08, 0.03), graspable=True)
    snapshot = built.thing("bottle_1", (0.25, 0.0, 0.6), (0.07, 0.07, 0.24), graspable=True).memory.snapshot()
    places = np.array([(0.6 * cos(turn), 0.6 * sin(turn)) for turn in (0.0, 0.2, 0.4, 0.8)])
    costs = passing_over(snapshot, "room_1", np.zeros(3), 0.5, places, {"book_1"}, stamp_s=0.0)
    assert costs[0] == MET_COST_M > costs[1] > costs[2] > IN_THE_WAY_COST_M > costs[3] == 0.0


def test_no_arm_reaches_through_a_wall_and_one_does_through_a_door(flat):
    snapshot = flat().memory.snapshot()
    behind_the_wall, behind_the_door, at_the_wall = (3.3, 1.2, 0.0), (3.3, 0.0, 0.0), (2.9, 1.2, 0.0)
    for target, free in ((behind_the_wall, False), (behind_the_door, True), (at_the_wall, True)):
        places = np.array([[2.5, target[1]]])
        costs = passing_over(snapshot, "room_1", np.array(target), 0.5, places, set(), stamp_s=0.0)
        assert bool(np.isfinite(costs[0])) is free


@pytest.mark.parametrize(
    ("kind", "back_rad", "from_back", "from_side", "from_front"),
    [
        ("chair", pi / 2, inf, 0.0, 0.0),
        ("chair", -pi / 2, 0.0, 0.0, inf),
        ("chair", None, 0.0, 0.0, 0.0),
        ("sofa", pi / 2, inf, inf, 0.0),
        ("stool", None, 0.0, 0.0, 0.0),
    ],
)
async def test_the_hand_comes_to_a_seat_neither_over_its_back_nor_over_an_arm_of_it(
    flat, kind, back_rad, from_back, from_side, from_front
):
    long_m = 1.9 if kind == "sofa" else 0.5
    built = flat().thing(f"{kind}_1", (0.0, 0.0, 0.45), (long_m, 0.5, 0.9), support=True, back_rad=back_rad)
    built.thing("cup_1", (0.0, 0.0, 0.5), (0.08, 0.08, 0.1), on=f"{kind}_1", graspable=True)
    places = np.array(((0.0, 0.6), (long_m / 2 + 0.35, 0.0), (0.0, -0.6)))
    spared = {"cup_1", f"{kind}_1"}
    costs = passing_over(built.memory.snapshot(), "room_1", np.array((0.0, 0.0, 0.5)), 0.6, places, spared, stamp_s=0.0)
    assert costs.tolist() == [from_back, from_side, from_front]


@pytest.mark.parametrize(
    ("at_m", "along", "aslant"), [(0.0, 0.0, 0.0), (0.11, BARRED_COST_M, 0.0), (0.17, BARRED_COST_M, BARRED_COST_M)]
)
async def test_to_what_is_close_to_the_back_of_a_chair_the_hand_comes_from_the_front(flat, at_m, along, aslant):
    built = flat().thing("chair_1", (0.0, 0.0, 0.45), (0.45, 0.45, 0.9), support=True, back_rad=pi / 2)
    built.thing("cup_1", (0.0, at_m, 0.5), (0.08, 0.08, 0.1), on="chair_1", graspable=True)
    places = np.array(((0.6, at_m), (0.5, at_m - 0.35), (0.0, at_m - 0.6)))
    target, spared = np.array((0.0, at_m, 0.5)), {"cup_1", "chair_1"}
    costs = passing_over(built.memory.snapshot(), "room_1", target, 0.6, places, spared, stamp_s=0.0)
    assert costs.tolist() == [along, aslant, 0.0]


@pytest.mark.parametrize(
    ("aside_m", "stamp_s", "cost_m"),
    [(0.1, 0.0, inf), (0.25, 0.0, inf), (0.4, 0.0, 0.0), (0.25, 60.0, BARRED_COST_M), (0.4, 60.0, 0.0)],
)
async def test_the_arm_does_not_pass_where_somebody_stands_or_was_seen(flat, aside_m, stamp_s, cost_m):
    snapshot = flat().person(0.4, aside_m).memory.snapshot()
    places = np.array(((0.8, 0.0), (-0.8, 0.0)))
    costs = passing_over(snapshot, "room_1", np.zeros(3), 0.5, places, set(), stamp_s=stamp_s)
    assert costs.tolist() == [cost_m, 0.0]


async def test_who_stands_at_a_thing_is_the_reason_why_nothing_gets_there(kitchen):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    bottle = rehearsal.memory.snapshot().position("bottle_1", "room_1")
    built[0].person(bottle[0] + 0.2, bottle[1])
    failure = await carry_out(rehearsal, ("PICK", "bottle_1"))
    assert failure.code is FailureCode.PERSON_IN_WAY
    assert failure.evidence.nodes[0] == "person_1"


@pytest.mark.parametrize("as_empty", [False, True])
async def test_who_stands_at_the_only_free_spot_is_the_reason_why_nothing_is_put_there(kitchen, as_empty):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    context = await rehearsal.prepare()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    spot = free_spots(context, "bottle_1", "table_2")[0]
    x_m, y_m, _ = spot.anchor.position(rehearsal.memory.snapshot(), "room_1")
    built[0].person(float(x_m) + 0.1, float(y_m), stamp_s=context.stamp_s)
    placement = Placement(
        object_id="bottle_1",
        target="table_2",
        spots=lambda: [spot],
        spots_if_empty=lambda: free_spots(context, "bottle_1", "table_2", as_empty=True) if as_empty else [],
    )
    failure = await rehearsal.run([ChooseSpot(context, placement)])
    assert (failure.code, failure.evidence.nodes) == (FailureCode.PERSON_IN_WAY, ("person_1", "table_2"))


@pytest.mark.parametrize(
    ("across_m", "high_m", "taken"),
    [(0.02, 0.2, "another"), (0.02, 0.02, "the same"), (0.3, 0.2, "the same"), (3.0, 0.2, "none")],
)
async def test_where_the_camera_sees_what_is_not_in_the_graph_nothing_is_put(kitchen, across_m, high_m, taken):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    assert await carry_out(rehearsal, ("PICK", "bottle_1"), ("GOTO", "table_2")) is None
    actions = SKILLS["PLACE"].actions(context, ["bottle_1", "table_2"])
    check = next(action for action in actions if isinstance(action, CheckSpot))
    assert await rehearsal.run(actions[: actions.index(check)], 900.0) is None
    placement = check._placement
    assert await rehearsal.run([check]) is None
    chosen = placement.spot.anchor
    x_m, y_m, z_m = chosen.in_base(context)
    sides = np.linspace(-3.0, 3.0, 600) if taken == "none" else np.linspace(across_m, across_m + 0.05, 12)
    along, aside, up = np.meshgrid(np.linspace(-0.05, 0.05, 20), sides, [0.5, 0.9, 1.0], indexing="ij")
    turn_rad, away_m = np.arctan2(y_m, x_m), np.hypot(x_m, y_m)
    along = along.ravel() + away_m if taken != "none" else along.ravel() + 0.5
    x, y = (
        along * np.cos(turn_rad) - aside.ravel() * np.sin(turn_rad),
        along * np.sin(turn_rad) + aside.ravel() * np.cos(turn_rad),
    )
    context.seen_base = lambda: np.column_stack((x, y, z_m + high_m * up.ravel()))
    failure = await rehearsal.run([check])
    if taken == "none":
        assert failure.code is FailureCode.SUPPORT_FULL
        assert (chosen.node_id, chosen.point_m) in context.blocked_spots
    else:
        assert failure is None
        assert (placement.spot.anchor == chosen) is (taken == "the same")


@pytest.mark.parametrize(
    ("before_m", "high_m", "free_m", "met"),
    [
        (0.1, 0.15, inf, True),
        (0.1, 0.06, inf, False),  # the hand passes over it
        (0.1, 0.06, 0.4, True),  # below a board it does not
        (0.1, 0.39, 0.4, False),  # that is the board
        (-0.2, 0.15, inf, False),
        (0.0, 0.06, inf, True),
    ],
)
async def test_what_is_seen_bars_the_hand_where_it_passes_or_what_it_holds_is_to_stand(
    kitchen, before_m, high_m, free_m, met
):
    rehearsal = kitchen()
    context = await rehearsal.prepare()
    assert await carry_out(rehearsal, ("PICK", "bottle_1")) is None
    x_m, y_m, yaw_rad = rehearsal.body.pose.x_m, rehearsal.body.pose.y_m, rehearsal.body.pose.yaw_rad
    at = (x_m + 0.75 * cos(yaw_rad), y_m + 0.75 * sin(yaw_rad), 0.75)
    spot = Spot(anchor=Anchor("room_1", at), room_m=1.0, free_m=free_m)
    along, across = np.meshgrid(np.linspace(-0.01, 0.01, 5), np.linspace(-0.05, 0.05, 9))
    heights = np.full(along.size, 0.75 + high_m)
    context.seen_base = lambda: np.column_stack((along.ravel() + 0.75 - before_m, across.ravel(), heights))
    assert Seen(context, "room_1").is_in_way_to(spot) is met
    assert not Seen(context, "room_1").shows(spot)
    context.seen_base = lambda: np.column_stack((along.ravel() + 0.75, across.ravel(), np.full(along.size, 0.76)))
    assert Seen(context, "room_1").shows(spot)
    context.seen_base = lambda: np.zeros((0, 3))
    assert Seen(context, "room_1").shows(spot)


@pytest.mark.parametrize(("ago_s", "waits"), [(0.0, True), (10.0, True), (30.0, False)])
async def test_somebody_who_steps_before_the_arm_is_not_touched_and_the_arm_waits(kitchen, ago_s, waits):
    built = []
    rehearsal = kitchen(lambda flat: built.append(flat) or flat)
    context = await rehearsal.prepare()
    actions = SKILLS["PICK"].actions(context, ["bottle_1"])
    assert await rehearsal.run(actions[:5], 900.0) is None
    base, bottle = rehearsal.body.pose.point, rehearsal.memory.snapshot().position("bottle_1", "room_1")
    between = 0.3 * np.array(base) + 0.7 * bottle[:2]
    built[0].person(*(float(each) for each in between), stamp_s=context.stamp_s - ago_s)
    failure = await rehearsal.run(actions[5:], 900.0)
    if waits:
        assert failure.code is FailureCode.PERSON_IN_WAY
        assert rehearsal.body.arm.extension_m < 0.05
    else:
        assert failure is None


async def test_a_hand_that_let_go_rises_over_the_arm_of_a_sofa_before_it_is_drawn_back(flat):
    arm = ArmTarget(lift_m=0.6, extension_m=0.5, wrist_pitch_rad=DOWN_RAD, wrist_roll_rad=0.0)
    rehearsal = Rehearsal(memory=flat().memory, body=FakeBody(arm=arm))
    highest_m = []
    rehearsal.observe = lambda r: highest_m.append(r.body.arm.lift_m) if r.body.arm.extension_m > 0.4 else None
    assert await rehearsal.run([Retract(await rehearsal.prepare())]) is None
    assert max(highest_m) == pytest.approx(CARRY_LIFT_M, abs=0.01)


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
    chair = snapshot.object("chair_1")
    assert palm_meets_rims(chair, pose, 0.45, middle, np.array([toward_rad + 0.3]), low_m).tolist() == [met]


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
    assert (pressing_m(context, behind, front)[0] >= BARRED_COST_M) == pressed
    placement = Placement(
        object_id="bottle_1", target="counter_1", spots=lambda: [behind], further=lambda: [[beside]], spot=behind
    )
    if pitch_rad == 0.0:
        assert (placement.price_m(context, front)[0] >= BARRED_COST_M) == pressed
        assert await rehearsal.run([ChooseSpot(context, placement)]) is None
        assert placement.spot == (beside if pressed and aside_m == 0.0 else behind)


@pytest.mark.parametrize(("back_m", "met"), [(0.185, True), (0.23, False), (None, False)])
def test_the_back_is_where_it_was_measured_however_deep_the_chair_is_believed_to_be(flat, back_m, met):
    """The box of a chair that was seen often is centimeters too deep: its back is not at the rim of it."""
    chair = {"support": True, "back_rad": -pi / 2, "back_m": back_m}
    snapshot = flat().thing("chair_1", (1.0, 2.0, 0.45), (0.49, 0.52, 0.9), **chair).memory.snapshot()
    pose, middle = Pose2.of(snapshot.transform("room_1", "chair_1")), np.array([0.87, 1.9])
    toward_rad = np.array([pi / 3])
    assert palm_meets_rims(snapshot.object("chair_1"), pose, 0.45, middle, toward_rad, 0.6).tolist() == [met]


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
