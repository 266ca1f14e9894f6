"""Who interferes how, and when; boxes all over a piece of furniture."""

from __future__ import annotations

import math
from itertools import combinations

import numpy as np
import pytest

from evaluations.missions.clutter import boxes_over
from evaluations.missions.disturbances import DISTURBANCES, Moment
from evaluations.missions.mission import Mission
from evaluations.missions.outcome import HAND, Outcome, Placed
from evaluations.missions.ways import Ways
from mission_scenes import CUP, CUP_ON_TABLE, FLAT, scene, task
from planner.tasks.tasks import TaskStatus
from simulation.furnishing.catalog import category_named
from simulation.houses.disturbances import parse_disturbance
from simulation.world.blocks import Block, overlapping


def moment(name, **where):
    mission = Mission(
        house="flat", kind="to a place", request="", disturbance=name,
        outcomes=(Outcome(states=(Placed(things=("cup_1",), places=("desk_1",)),)),),
    )  # fmt: skip
    now = scene(CUP_ON_TABLE, **where)
    running = task(TaskStatus.RUNNING)
    rng = np.random.default_rng(0)
    return Moment(scene=now, mission=mission, task=running, ways=Ways(now), since_s=5.0, rng=rng)


@pytest.mark.parametrize("name", [*DISTURBANCES])
def test_every_disturbance_has_its_time_and_deeds_that_the_simulator_understands(name):
    carrying = name in ("slipped", "support_full", "support_gone")
    pose = (1.4, 1.6, 0.0) if name == "moved_in_view" else None
    now = moment(name, holding="cup_1" if carrying else None, pose=pose)
    assert DISTURBANCES[name].due(now)
    deeds = DISTURBANCES[name].deeds(now)
    assert deeds
    for events in deeds:
        for event in events:
            parse_disturbance(event)


def test_a_thing_is_moved_only_to_where_the_robot_can_be_asked_to_go():
    doors, in_kitchen = [door.id for door in FLAT.doors], (1.4, 1.6, 0.0)
    assert DISTURBANCES["moved_unseen"].deeds(moment("moved_unseen", pose=in_kitchen))
    assert not DISTURBANCES["moved_unseen"].deeds(moment("moved_unseen", pose=in_kitchen, shut=doors))
    assert DISTURBANCES["moved_in_view"].deeds(moment("moved_in_view", pose=in_kitchen, shut=doors))


@pytest.mark.parametrize("name", ["kidnapped", "pushed"])
@pytest.mark.parametrize("what", ["people", "objects"])
def test_the_robot_is_never_set_down_on_somebodys_feet_nor_on_what_lies_on_the_floor(name, what):
    def spots(now):
        return [event["to"]["pose"][:2] for events in DISTURBANCES[name].deeds(now) for event in events]

    now, same = moment(name), moment(name)
    crowded = spots(now)[0]
    same.scene.truth[what].append({"id": "guest", "position_m": crowded, "on": None, "in": None})
    left = spots(same)
    assert left
    assert len(left) < len(spots(moment(name)))
    assert all(math.dist(spot, crowded) > 0.4 for spot in left)


def test_a_mission_gets_only_what_can_happen_to_it():
    def fitting(*places):
        placed = Placed(things=("cup_1",), places=places)
        mission = Mission(house="flat", kind="", request="", outcomes=(Outcome(states=(placed,)),))
        return {name for name, each in DISTURBANCES.items() if each.fits(mission, FLAT)}

    assert fitting("desk_1") == {*DISTURBANCES}
    assert fitting("office") == {*DISTURBANCES} - {"support_full", "support_gone"}
    assert fitting(HAND) == {*DISTURBANCES} - {"support_full", "support_gone", "slipped"}
    assert not any(each.fits(Mission(house="flat", kind="", request=""), FLAT) for each in DISTURBANCES.values())


def test_nothing_is_moved_before_the_robot_is_under_way_and_nothing_slips_from_an_empty_hand():
    early = moment("moved_unseen")
    early = Moment(**{**vars(early), "since_s": 0.0})
    assert not DISTURBANCES["moved_unseen"].due(early)
    assert not DISTURBANCES["slipped"].due(moment("slipped"))


@pytest.mark.parametrize("item", [item for item in FLAT.furniture if item.id in ("desk_1", "shelf_1", "sofa_1")])
def test_boxes_fill_every_level_around_what_stands_there_and_touch_nothing(item):
    kind = category_named(item.category, static=True)
    width_m, depth_m, height_m = item.size or kind.size_m
    alone = boxes_over(item, scene())
    *at, z_m = alone[0].center_m
    around = Block(center_m=(*at, z_m), size_m=(0.08, 0.08, 0.1), yaw_rad=item.pose[2])
    beside = boxes_over(item, scene({**CUP, "on": item.id, "position_m": [*at, z_m]}))
    for boxes in (alone, beside):
        bottoms_m = [box.center_m[2] - box.size_m[2] / 2 for box in boxes]
        for level in kind.levels:
            assert any(0.0 < bottom_m - level * height_m < 0.01 for bottom_m in bottoms_m)
        apart = [(a, b) for a, b in combinations(boxes, 2) if abs(a.center_m[2] - b.center_m[2]) < 0.2]
        assert not any(overlapping(a, b) for a, b in apart)
    met = [box for box in beside if overlapping(box, around) and abs(box.center_m[2] - z_m) < 0.2]
    assert not met
    covered = sum(box.size_m[0] * box.size_m[1] for box in beside) / (width_m * depth_m * len(kind.levels))
    assert covered > (0.4 if item.category == "sofa" else 0.6)
