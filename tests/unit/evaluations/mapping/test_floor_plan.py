"""Scoring of floor plans: what is the same room, what is missing, and how far off it is."""

from __future__ import annotations

import math

import numpy as np
import pytest

from evaluations.mapping.floor_plan import FloorPlan, PlanDoor, compare, iou, plan_of_house, plan_of_scene
from simulation.houses.house_file import load_house


def rectangle(x0, y0, x1, y1):
    return np.array([[x0, y0], [x1, y0], [x1, y1], [x0, y1]], dtype=float)


def two_rooms():
    return FloorPlan(
        rooms={"a": rectangle(0, 0, 4, 3), "b": rectangle(4.2, 0, 8, 3)},
        doors={"d": PlanDoor(center=np.array([4.1, 1.5]), width_m=0.9, rooms=frozenset({"a", "b"}))},
    )


def renamed(plan):
    names = {"a": "room_1", "b": "room_2"}
    return FloorPlan(
        rooms={names[room]: polygon for room, polygon in plan.rooms.items()},
        doors={
            f"door_{name}": PlanDoor(
                center=door.center, width_m=door.width_m, rooms=frozenset(names[room] for room in door.rooms)
            )
            for name, door in plan.doors.items()
        },
    )


def test_the_same_plan_moved_and_turned_is_right_after_alignment_and_off_before():
    c, s = math.cos(0.01), math.sin(0.01)
    found = renamed(two_rooms()).moved(np.array([[c, -s], [s, c]]), np.array([0.05, -0.02]))
    score = compare(found, two_rooms())
    assert score.topology_right
    assert score.found == {"a": "room_1", "b": "room_2"}
    assert max(score.errors.room_position_m + score.errors.door_position_m) < 1e-9
    assert min(score.errors.iou) > 0.999
    assert max(score.unaligned.room_position_m) > 0.04
    assert max(score.unaligned.room_size_m) < 1e-9


def test_a_room_too_large_counts_in_its_size():
    true = two_rooms()
    found = renamed(true)
    found = FloorPlan(rooms={**found.rooms, "room_1": rectangle(0, 0, 4.04, 3)}, doors=found.doors)
    assert compare(found, true).errors.room_size_m[0] == pytest.approx(0.02)


def test_missing_and_invented_rooms_and_doors_are_named():
    true, found = two_rooms(), renamed(two_rooms())
    wrong_way = {"door_d": PlanDoor(center=np.array([4.1, 1.5]), width_m=0.9, rooms=frozenset({"room_1"}))}
    score = compare(FloorPlan(rooms={"room_1": found.rooms["room_1"]}, doors=wrong_way), true)
    assert (score.rooms_missed, score.rooms_invented) == (("b",), ())
    assert (score.doors_missed, score.doors_invented) == (("d",), ("door_d",))
    assert not score.topology_right
    assert not compare(FloorPlan(rooms={}, doors={}), true).topology_right


def test_a_door_far_from_the_true_one_is_another_door():
    true, found = two_rooms(), renamed(two_rooms())
    far = PlanDoor(center=np.array([4.1, 2.3]), width_m=0.9, rooms=frozenset({"room_1", "room_2"}))
    score = compare(FloorPlan(rooms=found.rooms, doors={"door_d": far}), true)
    assert score.doors_missed == ("d",)
    assert score.doors_invented == ("door_d",)


def test_shared_area():
    assert iou(rectangle(0, 0, 2, 1), rectangle(1, 0, 3, 1)) == pytest.approx(1 / 3, abs=0.01)
    assert iou(rectangle(0, 0, 1, 1), rectangle(2, 0, 3, 1)) == 0.0


def test_the_scene_is_put_where_the_robot_started():
    house = load_house("flat")
    true = plan_of_house(house)
    x, y, yaw = house.robot.pose
    c, s = math.cos(yaw), math.sin(yaw)
    in_map = true.moved(np.array([[c, s], [-s, c]]), np.array([[c, s], [-s, c]]) @ -np.array([x, y]))
    scene = {
        "nodes": [{"id": room, "type": "room", "polygon_m": polygon.tolist()} for room, polygon in in_map.rooms.items()]
        + [
            {
                "id": name,
                "type": "door",
                "position_m": [*door.center, 0.0],
                "width_m": door.width_m,
                "rooms": sorted(door.rooms),
                "provisional": False,
            }
            for name, door in in_map.doors.items()
        ]
    }
    score = compare(plan_of_scene(scene, house.robot.pose), true)
    assert score.topology_right
    assert max(score.unaligned.room_position_m) < 1e-9


def test_what_only_a_closed_door_leads_to_is_not_missed_and_the_door_counts_from_one_side():
    true = two_rooms()
    closed = FloorPlan(rooms=true.rooms, doors={"d": PlanDoor(**{**vars(true.doors["d"]), "optional": True})})
    found = FloorPlan(
        rooms={"room_1": true.rooms["a"]},
        doors={
            "door_d": PlanDoor(
                center=np.array([4.0, 1.52]), width_m=0.9, rooms=frozenset({"room_1"}), along=np.array([0.0, 1.0])
            )
        },
    )
    assert compare(found, closed).topology_right
    assert compare(found, closed).errors.door_position_m == pytest.approx([0.02])
    assert compare(FloorPlan(rooms=found.rooms, doors={}), closed).topology_right
    assert not compare(found, true).topology_right
    assert compare(FloorPlan(rooms={}, doors={}), closed).rooms_missed == ("a", "b")
