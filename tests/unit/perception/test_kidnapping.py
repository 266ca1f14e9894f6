"""The robot is picked up and set down elsewhere: it notices, says so, and finds out where it is or keeps on asking."""

from __future__ import annotations

import logging

import numpy as np
import pytest

from perception.crossing import door_being_crossed, is_lost, lose_robot
from perception.doors.door_concept import DoorConcept
from perception.geometry.planar import Pose2
from perception.localization.energy_optimizer import EnergyOptimizer
from perception.localization.relocalization import Relocalization
from perception.memory.long_term_memory import LongTermMemory
from perception.rooms.room_concept import RoomConcept
from perception.sensing import SensorBuffer
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, DoorNode, RoomNode, RoomStatus
from unit.perception.exploring_robot import Agent, Exploration
from unit.perception.known_house import frame_of, known_house, put_robot, room_ids
from unit.perception.lidar_house import Box, Door, House, rectangle
from unit.perception.localization.test_global_localization import offices
from unit.perception.test_crossing_exploration import assert_aims_met, four_rooms


def agents(memory: WorkingMemory, buffer: SensorBuffer) -> list[Agent]:
    return [
        EnergyOptimizer(memory, buffer),
        Relocalization(memory, buffer),
        RoomConcept(memory, buffer),
        DoorConcept(memory, buffer),
        LongTermMemory(memory, buffer),
    ]


class Kidnapping:
    """A robot that stands in a known house, is carried to another place, and is watched for a while."""

    def __init__(self, house: House, name: str, pose: Pose2, *, but: tuple[str, ...] = (), **noise: float) -> None:
        self.house = house
        self.run = Exploration.of(house, pose, 0, agents, **noise)
        self.memory = self.run.memory
        known = known_house(house, but=but, error_m=0.005).snapshot()
        with self.memory.edit("test", 0.0) as tx:
            tx.put(*(node for node in known.nodes.values() if node.id not in tx.snapshot))
            tx.put(*(edge for edge in known.edges.values() if edge.key.target != ROBOT_ID))
        put_robot(self.memory, house, name, pose)
        self.run.run(2.0)

    @property
    def localized(self) -> bool:
        robot = self.memory.snapshot().robot
        assert robot is not None
        return robot.localized

    def carry(self, pose: Pose2, seconds: float = 6.0) -> Kidnapping:
        """Set the robot down at ``pose``; the wheels do not tell. Watch until it knows again, or ``seconds`` long."""
        self.run.port.pose = pose
        self.run.run(2.0, until=lambda run: not self.localized)
        self.run.run(seconds, until=lambda run: self.localized)
        return self

    def error_m(self, name: str) -> float:
        """How far the belief is off, the room included."""
        if self.memory.snapshot().current_room != room_ids(self.house)[name]:
            return np.inf
        frame = frame_of(self.house.rooms[name], list(self.house.rooms).index(name) + 1)
        edge = self.memory.snapshot().parent(ROBOT_ID)
        assert edge is not None
        return (frame @ Pose2.from_se3(edge.T_source_target)).distance_m(self.run.port.pose)


def carried(name: str, start: Pose2, pose: Pose2, **options: object) -> Kidnapping:
    return Kidnapping(offices(), name, start, **options).carry(pose)  # type: ignore[arg-type]


IN_WIDE, IN_L, IN_SMALL = Pose2(2.2, 1.5, 0.4), Pose2(1.5, 6.5, 2.0), Pose2(12.6, 1.6, -1.0)
IN_CORRIDOR, IN_TWIN = Pose2(6.5, 4.1, 0.1), Pose2(6.2, 1.8, 1.0)


@pytest.mark.parametrize(
    ("name", "pose"),
    [("L", IN_L), ("small", IN_SMALL), ("corridor", IN_CORRIDOR), ("U", Pose2(7.2, 9.0, 0.3))],
    ids=["L", "small", "corridor", "U"],
)
@pytest.mark.parametrize("sigma_m", [0.02, 0.05])
def test_carried_into_another_room_the_robot_finds_out_where_it_is(name: str, pose: Pose2, sigma_m: float) -> None:
    kidnapping = carried("wide", IN_WIDE, pose, sigma_m=sigma_m)
    assert kidnapping.localized
    assert kidnapping.error_m(name) < 0.03


@pytest.mark.parametrize("shift", [Pose2(1.0, 0.6, 0.0), Pose2(0.0, 0.0, 1.2), Pose2(0.9, -0.2, np.pi)])
def test_carried_within_a_room_the_robot_finds_out_where_it_is(shift: Pose2) -> None:
    kidnapping = carried("wide", IN_WIDE, IN_WIDE @ shift)
    assert kidnapping.localized
    assert kidnapping.error_m("wide") < 0.03


def test_being_lost_is_noticed_within_a_second_and_a_half_and_said(caplog: pytest.LogCaptureFixture) -> None:
    caplog.set_level(logging.INFO)
    kidnapping = Kidnapping(offices(), "wide", IN_WIDE)
    kidnapping.run.port.pose = IN_TWIN
    kidnapping.run.run(1.5, until=lambda run: not kidnapping.localized)
    snapshot = kidnapping.memory.snapshot()
    assert not kidnapping.localized
    assert (snapshot.current_room, snapshot.room_of(ROBOT_ID)) == (None, None)
    assert "I do not know where I am" in caplog.text


@pytest.mark.parametrize("name", ["twin one", "twin two"])
def test_carried_into_one_of_two_twins_the_robot_says_that_it_does_not_know(
    name: str, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO)
    offset_m = 0.0 if name == "twin one" else 3.7
    kidnapping = carried("wide", IN_WIDE, Pose2(IN_TWIN.x_m + offset_m, IN_TWIN.y_m, 1.0))
    assert not kidnapping.localized
    assert "this could be room_3 or room_4" in caplog.text


@pytest.mark.parametrize("name", ["L", "U", "corridor"])
def test_carried_into_a_room_that_is_not_known_the_robot_says_that_it_does_not_know(name: str) -> None:
    pose = {"L": IN_L, "U": Pose2(7.2, 9.0, 0.3), "corridor": IN_CORRIDOR}[name]
    kidnapping = carried("wide", IN_WIDE, pose, but=(name,))
    assert not kidnapping.localized
    assert len(kidnapping.memory.snapshot().of_type(RoomNode)) == len(offices().rooms) - 1


def test_lost_behind_a_door_a_robot_that_nobody_carried_goes_on_from_where_its_wheels_say() -> None:
    """It stood for ever in a room that it did not know: it had been about to enter it."""
    kidnapping = Kidnapping(offices(), "wide", IN_WIDE, but=("L",))
    memory, (agent,) = kidnapping.memory, [one for one in kidnapping.run.agents if isinstance(one, Relocalization)]
    kidnapping.run.port.pose, agent._view = IN_L, type(agent._view)()
    put_robot(memory, kidnapping.house, "wide", IN_L)
    agent._lose(room_ids(kidnapping.house)["wide"], kidnapping.run.port.stamp_s, carried=False)
    kidnapping.run.run(15.0, until=lambda run: kidnapping.localized)
    assert not kidnapping.localized
    kidnapping.run.run(30.0, until=lambda run: kidnapping.localized)
    assert kidnapping.error_m("wide") < 0.3
    assert memory.snapshot().room(room_ids(kidnapping.house)["wide"]).status is RoomStatus.PERMANENT


def test_from_a_room_that_is_not_known_it_is_found_again_when_carried_back() -> None:
    kidnapping = carried("wide", IN_WIDE, IN_L, but=("L",)).carry(IN_SMALL)
    assert kidnapping.localized
    assert kidnapping.error_m("small") < 0.03


@pytest.mark.parametrize("open_door", [True, False])
def test_a_symmetrical_room_leaves_the_robot_right_or_without_a_decision(open_door: bool) -> None:
    house = House(
        rooms={"a": rectangle(5.0, 3.0), "b": rectangle(6.0, 4.0, x=5.2)},
        doors=[Door(rooms=("a", "b"), center=(5.1, 1.5), open=open_door)],
    )
    kidnapping = Kidnapping(house, "a", Pose2(1.5, 1.2, 0.3)).carry(Pose2(9.0, 2.5, 2.0))
    assert kidnapping.localized == open_door
    assert not open_door or kidnapping.error_m("b") < 0.03


def test_turned_by_half_in_a_symmetrical_room_only_the_door_gives_it_away() -> None:
    house = House(
        rooms={"a": rectangle(5.0, 3.0), "b": rectangle(6.0, 4.0, x=5.2)},
        doors=[Door(rooms=("a", "b"), center=(5.1, 1.0))],
    )
    kidnapping = Kidnapping(house, "a", Pose2(2.0, 1.2, 0.3)).carry(Pose2(3.0, 1.8, 0.3 - np.pi))
    assert kidnapping.error_m("a") < 0.03


def test_while_lost_nothing_is_mapped_and_afterwards_the_doors_are_as_before() -> None:
    kidnapping = Kidnapping(offices(), "wide", IN_WIDE)
    before = [(door.id, door.state, door.crossing) for door in kidnapping.memory.snapshot().of_type(DoorNode)]
    for pose in (IN_TWIN, IN_SMALL, IN_L, IN_WIDE):
        kidnapping.carry(pose)
    assert kidnapping.error_m("wide") < 0.03
    after = kidnapping.memory.snapshot()
    assert [(door.id, door.state, door.crossing) for door in after.of_type(DoorNode) if not door.provisional] == before
    assert len(after.of_type(RoomNode)) == len(offices().rooms)


def test_a_robot_that_starts_anywhere_in_a_known_building_finds_out_where() -> None:
    """What a service does that restored a stored building: it says that the place is not known."""
    kidnapping = Kidnapping(offices(), "wide", IN_WIDE)
    kidnapping.run.port.pose = IN_L
    with kidnapping.memory.edit("test", kidnapping.run.port.stamp_s) as tx:
        lose_robot(tx)
    kidnapping.run.run(3.0)
    assert kidnapping.error_m("L") < 0.03


@pytest.mark.long
def test_exploration_goes_on_after_a_kidnapping_and_the_map_is_as_good_as_ever() -> None:
    house = four_rooms()
    run = Exploration.of(house, Pose2(1.0, 1.0, 0.7), 0, agents)
    run.run(60.0, until=lambda one: len(one.memory.snapshot().of_type(RoomNode)) >= 3)
    run.run(3.0)
    run.port.pose = Pose2(3.0, 1.8, 2.0)
    run.run(200.0, until=lambda one: one.memory.snapshot().root.explored)
    assert run.memory.snapshot().root.explored
    assert_aims_met(run, house)


def test_carried_from_one_twin_to_the_other_the_robot_does_not_take_one_for_the_other() -> None:
    kidnapping = Kidnapping(offices(), "twin one", IN_TWIN)
    kidnapping.carry(Pose2(10.2, 1.4, 0.5))
    assert not kidnapping.localized


@pytest.mark.long
def test_carried_off_while_it_enters_an_unknown_room_it_starts_over_and_the_map_is_as_good_as_ever() -> None:
    house = four_rooms()
    run = Exploration.of(house, Pose2(1.0, 1.0, 0.7), 0, agents)
    run.run(60.0, until=lambda one: len(one.memory.snapshot().of_type(RoomNode)) >= 2)
    run.run(60.0, until=lambda one: door_being_crossed(one.memory.snapshot()) is not None)
    run.port.pose = Pose2(3.0, 1.8, 2.0)
    run.run(1.0, until=lambda one: is_lost(one.memory.snapshot()))
    assert door_being_crossed(run.memory.snapshot()) is None
    run.run(200.0, until=lambda one: one.memory.snapshot().root.explored)
    assert run.memory.snapshot().root.explored
    assert_aims_met(run, house)


@pytest.mark.long
@pytest.mark.parametrize("sigma_m", [0.02, 0.05])
@pytest.mark.parametrize("seed", range(2))
def test_nothing_alarms_while_exploring_furnished_rooms(sigma_m: float, seed: int, caplog) -> None:
    house = four_rooms()
    house.boxes.append(Box(center=(5.2, 4.3), size=(1.2, 0.6, 2.2)))
    house.boxes.append(Box(center=(3.4, 0.5), size=(0.6, 0.6, 1.9)))
    caplog.set_level(logging.INFO)
    run = Exploration.of(house, Pose2(1.0, 1.0, 0.7), seed, agents, sigma_m=sigma_m)
    run.run(150.0, until=lambda one: one.memory.snapshot().root.explored)
    assert run.memory.snapshot().root.explored
    assert "I do not know" not in caplog.text
