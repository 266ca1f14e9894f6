"""Working memory holds the rooms around the robot; whatever it lets go, the building is explored as if it did not."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from perception.geometry.planar import Pose2
from perception.memory.working_set import WorkingSet, WorkingSetSettings, neighbors
from perception.sensing import Sensing, SensorBuffer
from scene_graph.documents.interchange import to_json
from scene_graph.edges import (
    ConnectsEdge,
    HasIntentionEdge,
    InEdge,
    IntentionAction,
    IntentionStatus,
    MatchEdge,
    RtEdge,
)
from scene_graph.edits import PutEdge, PutNode, RemoveEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import CrossingStatus, DoorNode, ObjectNode, RobotNode, RoomNode, RoomStatus, RootNode
from scene_graph.snapshot import Snapshot
from unit.perception.exploring_robot import Driver, Exploration, HousePort
from unit.perception.lidar_house import Door, House, rectangle
from unit.perception.test_crossing_exploration import agents, four_rooms

SQUARE = ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0))


def hang(parent: str, child: str, x_m: float = 0.0) -> RtEdge:
    return RtEdge(source=parent, target=child, T_source_target=SE3.from_xyz_yaw(x_m, 0.0, 0.0, 0.0))


def corridor(count: int = 6) -> Snapshot:
    """Rooms in a row, each with a cup; the robot is in the first."""
    rooms = [f"room_{i}" for i in range(1, count + 1)]
    nodes = [RootNode(), RobotNode()]
    edges = [hang("room_1", "robot"), InEdge(source="robot", target="room_1")]
    for i, room in enumerate(rooms):
        cup = ObjectNode(id=f"cup_{i + 1}", label="cup")
        nodes += [RoomNode(id=room, polygon_m=SQUARE, status=RoomStatus.PERMANENT), cup]
        edges += [hang("root", room, 4.2 * i), hang(room, cup.id), InEdge(source=cup.id, target=room)]
    for i in range(1, count):
        pair = (f"door_{i}_0_0", f"room_{i}"), (f"door_{i + 1}_1_0", f"room_{i + 1}")
        for (door, near), (_, far) in (pair, pair[::-1]):
            crossed = CrossingStatus.CROSSED
            nodes.append(DoorNode(id=door, rooms=(near, far), width_m=0.9, provisional=False, crossing=crossed))
            edges += [hang(near, door, 2.0 if near == pair[0][1] else -2.0)]
            edges += [ConnectsEdge(source=door, target=room) for room in (near, far)]
        edges.append(MatchEdge(source=min(pair)[0], target=max(pair)[0]))
    return Snapshot.of(nodes, edges)


class Paged:
    """A corridor in working memory and its working set; time goes on with every step."""

    def __init__(self, snapshot: Snapshot | None = None) -> None:
        self.memory = WorkingMemory(snapshot or corridor(), long_term=LongTermStore())
        self.working_set = WorkingSet("ltsm", self.memory, WorkingSetSettings(linger_s=1.0))
        self.stamp_s = 0.0

    def loaded(self, seconds: float = 2.0) -> set[str]:
        for _ in range(round(seconds / 0.1)):
            self.stamp_s += 0.1
            self.working_set.update(self.stamp_s)
        return {room.id for room in self.memory.snapshot().of_type(RoomNode)}

    def go_to(self, room: str) -> None:
        snapshot = self.memory.snapshot()
        old = [RemoveEdge(edge.key) for edge in (*snapshot.edges_to("robot"), *snapshot.edges_from("robot"))]
        new = [PutEdge(hang(room, "robot")), PutEdge(InEdge(source="robot", target=room))]
        self.memory.commit([*old, *new], agent="test", stamp_s=self.stamp_s)

    def ask(self, target: str = "robot", *, needs: tuple[str, ...] = (), **more: object) -> None:
        edge = HasIntentionEdge(
            source="robot", target=target, agent="task:1", action=IntentionAction.TASK, priority=100, needs=needs
        )
        self.memory.commit([PutEdge(replace(edge, **more))], agent="test", stamp_s=self.stamp_s)


def test_the_robot_s_room_and_those_behind_its_doors_are_held() -> None:
    paged = Paged()
    assert paged.loaded() == {"room_1", "room_2"}
    paged.go_to("room_2")
    assert paged.loaded() == {"room_1", "room_2", "room_3"}
    paged.go_to("room_3")
    assert paged.loaded() == {"room_2", "room_3", "room_4"}


def test_what_lies_behind_a_door_is_there_at_the_first_step_in_front_of_it() -> None:
    paged = Paged()
    paged.loaded()
    paged.go_to("room_2")
    assert "room_3" in paged.loaded(0.1)
    assert neighbors(paged.memory.snapshot(), "room_2") == ["room_1", "room_3"]


def test_turning_back_in_a_door_loads_nothing() -> None:
    paged = Paged()
    paged.loaded()
    paged.go_to("room_2")
    paged.loaded()
    revision = paged.memory.snapshot().revision
    paged.go_to("room_3")
    paged.loaded(0.5)
    paged.go_to("room_2")
    paged.loaded(0.5)
    assert paged.memory.snapshot().revision == revision + 3  # two moves, and room 4 that came


def test_a_task_keeps_the_rooms_of_what_it_names_and_those_on_the_way() -> None:
    paged = Paged()
    paged.loaded()
    paged.ask(needs=("cup_4", "nothing_1"))
    assert paged.loaded() == {"room_1", "room_2", "room_3", "room_4"}
    paged.ask(needs=("cup_4",), status=IntentionStatus.DONE)
    assert paged.loaded() == {"room_1", "room_2"}


def test_a_room_that_an_open_intention_names_stays() -> None:
    paged = Paged()
    paged.ask("cup_5")
    assert paged.loaded() == {"room_1", "room_2", "room_5"}


def test_a_room_with_a_door_to_cross_stays_until_it_is_crossed() -> None:
    paged = Paged()
    door = paged.memory.snapshot().door("door_6_1_0")
    open_end = replace(door, id="door_6_0_0", rooms=("room_6", None), crossing=CrossingStatus.UNCROSSED)
    paged.memory.commit([PutNode(open_end), PutEdge(hang("room_6", open_end.id))], agent="test", stamp_s=0.0)
    assert paged.loaded() == {"room_1", "room_2", "room_6"}
    given_up = replace(open_end, crossing=CrossingStatus.GIVEN_UP)
    paged.memory.commit([PutNode(given_up)], agent="test", stamp_s=3.0)
    assert paged.loaded() == {"room_1", "room_2"}


def test_while_the_robot_is_in_no_room_nothing_comes_or_goes() -> None:
    paged = Paged()
    before = paged.loaded()
    old = paged.memory.snapshot()
    lost = [RemoveEdge(edge.key) for edge in (*old.edges_to("robot"), *old.edges_from("robot"))]
    paged.memory.commit([*lost, PutEdge(hang("root", "robot"))], agent="test", stamp_s=2.0)
    assert paged.loaded() == before
    paged.memory.commit(
        [RemoveEdge(hang("root", "robot").key), PutEdge(hang("room_5", "robot"))], agent="test", stamp_s=4.0
    )
    assert paged.loaded() == {"room_4", "room_5", "room_6"}


def test_working_memory_is_as_small_in_a_large_building_as_in_a_small_one() -> None:
    sizes = []
    for count in (6, 60):
        paged = Paged(corridor(count))
        paged.loaded()
        sizes.append((len(paged.memory.snapshot().nodes), len(paged.memory.snapshot().edges)))
    assert sizes[0] == sizes[1]


def explore(house: House, *, long_term: LongTermStore | None) -> Exploration:
    """As in the tests of exploration, with a long-term memory or without."""
    memory = WorkingMemory(long_term=long_term)
    port = HousePort(house=house, pose=Pose2(1.0, 1.0, 0.7), rng=np.random.default_rng(0))
    buffer = SensorBuffer(port)
    run = Exploration(
        memory=memory,
        port=port,
        buffer=buffer,
        agents=[Sensing(buffer), *agents(memory, buffer)],
        driver=Driver(memory, port),
        start=port.pose,
    )
    run.run(240.0, until=lambda one: one.memory.snapshot().root.explored)
    run.run(8.0)
    return run


def in_a_row(names: str) -> House:
    rooms = {name: rectangle(3.6, 3.0, x=3.8 * i) for i, name in enumerate(names)}
    pairs = enumerate(pairwise(names), start=1)
    doors = [Door(rooms=pair, center=(3.8 * i - 0.1, 1.3)) for i, pair in pairs]
    return House(rooms=rooms, doors=doors)


@pytest.mark.slow
@pytest.mark.parametrize(
    "house",
    [
        pytest.param(in_a_row("abc"), id="three"),
        pytest.param(in_a_row("abcde"), id="five", marks=pytest.mark.long),
        pytest.param(four_rooms(), id="loop", marks=pytest.mark.long),
    ],
)
def test_a_building_is_explored_as_if_nothing_were_ever_unloaded(house: House) -> None:
    plain, paged = explore(house, long_term=None), explore(house, long_term=LongTermStore())
    assert paged.memory.building().root.explored
    assert paged.memory.unloaded
    assert paged.log == plain.log
    assert paged.driver.finished == plain.driver.finished
    known, expected = to_json(paged.memory.building()), to_json(plain.memory.snapshot())
    assert sorted(known["edges"], key=str) == sorted(expected["edges"], key=str)
    assert known["nodes"] == expected["nodes"]
