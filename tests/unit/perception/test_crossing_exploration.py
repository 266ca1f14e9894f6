"""All LiDAR agents together: a scripted robot explores houses, and the graph is compared with the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from perception.crossing import DOOR_AGENT, OUTDOORS, given_up
from perception.doors.door_concept import DoorConcept
from perception.geometry.planar import Pose2
from perception.localization.energy_optimizer import EnergyOptimizer
from perception.memory.long_term_memory import LongTermMemory
from perception.rooms.room_concept import RoomConcept
from perception.sensing import SensorBuffer
from scene_graph.documents.interchange import to_json
from scene_graph.edges import EdgeType
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import CrossingStatus, DoorNode, DoorState, RoomNode, RoomStatus
from unit.perception.exploring_robot import Agent, Exploration
from unit.perception.lidar_house import Array, Box, Door, House, l_shape, rectangle, turned


def agents(memory: WorkingMemory, buffer: SensorBuffer) -> list[Agent]:
    return [
        EnergyOptimizer(memory, buffer),
        RoomConcept(memory, buffer),
        DoorConcept(memory, buffer),
        LongTermMemory(memory, buffer),
    ]


def explore(house: House, start: Pose2, seed: int = 0, limit_s: float = 150.0) -> Exploration:
    exploration = Exploration.of(house, start, seed, agents)
    exploration.run(limit_s, until=lambda run: run.memory.snapshot().root.explored)
    return exploration


@dataclass(frozen=True, kw_only=True)
class Score:
    """Errors in millimeters against the truth, over all rooms and doors."""

    rooms: dict[str, str]
    position: list[float]
    dimension: list[float]
    door_position: list[float]
    door_width: list[float]


def center(polygon: Array) -> Array:
    return np.asarray((polygon.min(axis=0) + polygon.max(axis=0)) / 2)


def sides(polygon: Array) -> Array:
    return np.sort(np.linalg.norm(np.roll(polygon, -1, axis=0) - polygon, axis=1))


def score(run: Exploration, house: House) -> Score:
    snapshot = run.memory.snapshot()
    found, position, dimension, door_position, door_width = {}, [], [], [], []
    for room in snapshot.of_type(RoomNode):
        polygon = run.truth_of(room.id).apply(np.array(room.polygon_m))
        name = min(
            house.rooms, key=lambda key: float(np.linalg.norm(house.rooms[key].mean(axis=0) - polygon.mean(axis=0)))
        )
        found[room.id] = name
        position.append(1e3 * float(np.linalg.norm(polygon.mean(axis=0) - house.rooms[name].mean(axis=0))))
        dimension.extend((1e3 * np.abs(sides(polygon) - sides(house.rooms[name]))).tolist())
    for door in snapshot.of_type(DoorNode):
        pose = run.truth_of(door.id)
        truth = min(house.doors, key=lambda one: float(np.linalg.norm(np.array(one.center) - pose.position_m)))
        face = np.array(truth.center) + pose.rotation()[:, 1] * house.wall_thickness / 2
        door_position.append(1e3 * float(np.linalg.norm(pose.position_m - face)))
        door_width.append(1e3 * abs(door.width_m - truth.width))
    return Score(
        rooms=found, position=position, dimension=dimension, door_position=door_position, door_width=door_width
    )


def assert_aims_met(run: Exploration, house: House) -> None:
    """Design, section 11: room position 15 mm, dimensions 20 mm, door position 15 mm, width 12 mm; each on average."""
    result = score(run, house)
    assert sorted(result.rooms.values()) == sorted(house.rooms)
    assert np.mean(result.position) < 15.0
    assert np.mean(result.dimension) < 20.0
    assert len(result.door_position) == sum(2 - one.rooms.count("outside") for one in house.doors)
    if house.doors:
        assert np.mean(result.door_position) < 15.0
        assert np.mean(result.door_width) < 12.0


def two_rooms(thickness_m: float = 0.2) -> House:
    return House(
        rooms={"a": rectangle(4.0, 3.0), "b": rectangle(5.0, 3.0, x=4.0 + thickness_m)},
        doors=[Door(rooms=("a", "b"), center=(4.0 + thickness_m / 2, 1.3))],
        wall_thickness=thickness_m,
    )


def four_rooms() -> House:
    return House(
        rooms={
            "a": rectangle(4.0, 3.0),
            "b": rectangle(5.0, 3.0, x=4.2),
            "c": rectangle(5.0, 4.0, x=4.2, y=3.2),
            "d": rectangle(4.0, 4.0, y=3.2),
        },
        doors=[
            Door(rooms=("a", "b"), center=(4.1, 1.3)),
            Door(rooms=("b", "c"), center=(6.5, 3.1), width=0.8),
            Door(rooms=("c", "d"), center=(4.1, 5.0), width=1.0),
            Door(rooms=("a", "d"), center=(1.2, 3.1)),
        ],
        boxes=[Box(center=(2.8, 2.5), size=(0.6, 0.5, 0.8)), Box(center=(8.0, 1.0), size=(0.8, 1.6, 0.75))],
    )


@pytest.mark.parametrize("polygon", [rectangle(4.0, 3.0), l_shape()], ids=["rectangle", "L"])
@pytest.mark.parametrize("angle_rad", [0.0, 1.0])
def test_a_closed_room_is_measured_and_then_nothing_is_left(polygon: Array, angle_rad: float) -> None:
    house = turned(House(rooms={"a": polygon}), angle_rad)
    run = explore(house, Pose2(0.0, 0.0, angle_rad) @ Pose2(2.0, 1.0, 2.5), limit_s=40.0)
    snapshot = run.memory.snapshot()
    assert snapshot.root.explored
    assert snapshot.current_room == "room_1"
    assert snapshot.room("room_1").status is RoomStatus.PERMANENT
    assert snapshot.room("room_1").height_m == pytest.approx(2.5, abs=0.06)
    assert snapshot.intentions() == ()
    assert_aims_met(run, house)


@pytest.mark.slow
@pytest.mark.parametrize("thickness_m", [0.05, 0.4])
def test_two_rooms_become_two_rooms_with_one_door_known_from_both_sides(thickness_m: float) -> None:
    house = two_rooms(thickness_m)
    run = explore(house, Pose2(1.0, 1.0, 0.7))
    snapshot = run.memory.snapshot()
    near, far = snapshot.of_type(DoorNode)
    assert (near.rooms, far.rooms) == (("room_1", "room_2"), ("room_2", "room_1"))
    assert near.crossing is far.crossing is CrossingStatus.CROSSED
    assert [edge.target for edge in snapshot.edges_from(near.id, EdgeType.MATCH)] == [far.id]
    assert {edge.target for edge in snapshot.edges_from(near.id, EdgeType.CONNECTS)} == {"room_1", "room_2"}
    assert_aims_met(run, house)


@pytest.mark.slow
def test_a_loop_of_four_rooms_closes_into_four_rooms_and_four_doors() -> None:
    house = four_rooms()
    run = explore(house, Pose2(1.0, 1.0, 0.7))
    assert run.memory.snapshot().root.explored
    assert_aims_met(run, house)
    inside = [error for stamp_s, error, _ in run.log if stamp_s > 3.0]
    assert np.mean(inside) < 0.02


@pytest.mark.slow
def test_the_same_seed_writes_the_same_log() -> None:
    first, second = (explore(two_rooms(), Pose2(1.0, 1.0, 0.7), seed=5) for _ in range(2))
    assert first.log == second.log
    assert first.driver.finished == second.driver.finished
    assert to_json(first.memory.snapshot()) == to_json(second.memory.snapshot())


def test_a_door_that_leads_outdoors_is_given_up_with_a_reason() -> None:
    house = House(rooms={"a": rectangle(4.0, 3.0)}, doors=[Door(rooms=("a", "outside"), center=(4.1, 1.3))])
    run = explore(house, Pose2(1.0, 1.0, 0.7), limit_s=60.0)
    (door,) = run.memory.snapshot().of_type(DoorNode)
    assert (door.crossing, door.crossing_reason) == (CrossingStatus.GIVEN_UP, OUTDOORS)
    assert len(run.memory.snapshot().of_type(RoomNode)) == 1
    assert run.memory.snapshot().root.explored


def test_exploring_does_not_end_outdoors() -> None:
    house = House(rooms={"a": rectangle(4.0, 3.0)}, doors=[Door(rooms=("a", "outside"), center=(4.1, 1.3))])
    run = explore(house, Pose2(1.0, 1.0, 0.7), limit_s=60.0)
    assert run.memory.snapshot().root.explored
    assert run.port.pose.position_m[0] < 4.0
    assert not run.memory.snapshot().intentions()
    assert [(action, what) for _, action, what, _ in run.driver.finished][-1] == ("visit", "room_1")


def test_a_robot_that_cannot_come_back_in_is_not_asked_for_ever() -> None:
    house = House(rooms={"a": rectangle(4.0, 3.0)}, doors=[Door(rooms=("a", "outside"), center=(4.1, 1.3))])
    run = Exploration.of(house, Pose2(1.0, 1.0, 0.7), 0, agents)
    run.driver.refused.add("room_1")
    run.run(60.0, until=lambda one: one.memory.snapshot().root.explored)
    assert run.memory.snapshot().root.explored
    assert not run.memory.snapshot().intentions()


def test_a_crossing_that_fails_twice_and_once_more_at_the_end_is_given_up_with_the_executor_s_reason() -> None:
    run = Exploration.of(two_rooms(), Pose2(1.0, 1.0, 0.7), 0, agents)
    run.driver.refused |= {f"aff_cross_1_{wall}_0" for wall in range(4)}
    run.run(60.0, until=lambda one: one.memory.snapshot().root.explored)
    (door,) = run.memory.snapshot().of_type(DoorNode)
    assert (door.crossing, door.crossing_reason) == (CrossingStatus.GIVEN_UP, "no way")
    assert [what for _, action, what, status in run.driver.finished if status == "failed"] == [
        f"aff_cross_{door.id.removeprefix('door_')}"
    ] * 3


def test_a_door_that_was_given_up_is_tried_again_when_nothing_else_is_left() -> None:
    run = Exploration.of(two_rooms(), Pose2(1.0, 1.0, 0.7), 0, agents)
    run.driver.refused |= {f"aff_cross_1_{wall}_0" for wall in range(4)}
    run.run(60.0, until=lambda one: any(door.crossing is CrossingStatus.GIVEN_UP for door in doors_of(one)))
    run.driver.refused.clear()
    run.run(60.0, until=lambda one: one.memory.snapshot().root.explored)
    assert {door.crossing for door in doors_of(run)} == {CrossingStatus.CROSSED}
    assert len(run.memory.snapshot().of_type(RoomNode)) == 2


def test_a_door_whose_far_side_was_not_understood_is_tried_again_whoever_gave_it_up() -> None:
    run = Exploration.of(two_rooms(), Pose2(1.0, 1.0, 0.7), 0, agents)
    run.run(60.0, until=lambda one: any(not door.provisional for door in doors_of(one)))
    with run.memory.edit(DOOR_AGENT, run.port.stamp_s) as tx:
        for door in doors_of(run):
            tx.put(given_up(door, "no wall of the room behind it has this door"))
    run.run(60.0, until=lambda one: one.memory.snapshot().root.explored)
    assert {door.crossing for door in doors_of(run)} == {CrossingStatus.CROSSED}
    assert len(run.memory.snapshot().of_type(RoomNode)) == 2


def doors_of(run: Exploration) -> tuple[DoorNode, ...]:
    return tuple(run.memory.snapshot().of_type(DoorNode))


def test_a_door_that_closes_is_noticed_and_so_is_its_opening() -> None:
    house = two_rooms()
    run = Exploration.of(house, Pose2(1.0, 1.0, 0.7), 0, agents)
    run.driver.refused |= {f"aff_cross_1_{wall}_0" for wall in range(4)}
    run.run(60.0, until=lambda one: one.memory.snapshot().root.explored)
    panel = House(rooms=house.rooms, doors=[Door(rooms=("a", "b"), center=(4.1, 1.3), open=False)])
    for walls, state in ((panel, DoorState.CLOSED), (house, DoorState.OPEN)):
        run.port.house = walls
        run.run(2.0)
        assert run.memory.snapshot().of_type(DoorNode)[0].state is state


@pytest.mark.slow
@pytest.mark.parametrize("start", [Pose2(2.0, 2.0, 0.5), Pose2(7.0, 1.5, 0.5)], ids=["inside", "through the door"])
def test_a_room_with_a_slanted_wall_stands_as_partial_and_is_joined(start: Pose2) -> None:
    slanted = np.array([[0.0, 0.0], [5.0, 0.0], [5.0, 3.0], [3.0, 4.5], [0.0, 4.5]])
    door = Door(rooms=("a", "b"), center=(5.1, 1.5))
    house = House(rooms={"a": slanted, "b": rectangle(4.0, 3.0, x=5.2)}, doors=[door])
    run = explore(house, start)
    statuses = {score(run, house).rooms[room.id]: room.status for room in run.memory.snapshot().of_type(RoomNode)}
    assert statuses == {"a": RoomStatus.PARTIAL, "b": RoomStatus.PERMANENT}
    assert_aims_met(run, house)


@pytest.mark.slow
def test_a_partly_hidden_wall_is_looked_at_before_the_room_is_called_explored() -> None:
    house = two_rooms()
    house.boxes.append(Box(center=(2.6, 1.3), size=(0.3, 1.8, 1.95)))
    run = explore(house, Pose2(0.7, 1.3, 0.0))
    assert_aims_met(run, house)


@pytest.mark.benchmark
def test_a_step_of_all_agents_costs_less_than_a_tenth_of_its_period() -> None:
    run = Exploration.of(two_rooms(), Pose2(1.0, 1.0, 0.7), 0, agents)
    run.run(20.0)
    typical = {name: float(np.median(seconds)) for name, seconds in run.seconds.items() if name != "sensing"}
    assert sum(typical.values()) < 0.03
    assert typical["energy_optimizer"] < 0.015
