"""A room that stands but is wrong: what contradicts it is noticed, and it is measured again without losing anything."""

from __future__ import annotations

import numpy as np
import pytest

from perception.geometry.planar import Pose2
from perception.lidar.slice import OutlineSlicer
from perception.rooms.maintenance.outline_fitness import OutlineFitness
from perception.rooms.maintenance.revision import same_place
from perception.rooms.survey.instance import MeasuredRoom
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, ROOT_ID, DoorNode, RoomNode, RoomStatus, WallNode
from unit.perception.exploring_robot import Exploration
from unit.perception.known_house import known_house, put_robot
from unit.perception.lidar_house import Array, Door, House, cast, l_shape, rectangle
from unit.perception.test_kidnapping import agents

DOORS = [Door(rooms=("a", "b"), center=(1.5, -0.1), width=0.9)]
BESIDE = rectangle(4.0, 3.0, x=0.0, y=-3.2)


def l_house() -> House:
    return House(rooms={"a": l_shape(), "b": BESIDE}, doors=DOORS)


def believed_in(actual: House, believed: House, pose: Pose2) -> Exploration:
    """A robot at ``pose`` of a house that it believes to be another one."""
    run = Exploration.of(actual, pose, 0, agents)
    known = known_house(believed).snapshot()
    with run.memory.edit("test", 0.0) as tx:
        tx.put(*(node for node in known.nodes.values() if node.id not in tx.snapshot))
        tx.put(*(edge for edge in known.edges.values() if edge.key.target != ROBOT_ID))
    put_robot(run.memory, believed, "a", pose)
    return run


def polygon_in_house(memory: WorkingMemory, room_id: str) -> Array:
    snapshot = memory.snapshot()
    return Pose2.from_se3(snapshot.transform(ROOT_ID, room_id)).apply(np.array(snapshot.room(room_id).polygon_m))


@pytest.mark.parametrize("place", [Pose2(4.5, 1.2, 0.3), Pose2(1.4, 1.2, 2.0)], ids=["in the leg", "at the corner"])
def test_an_l_shaped_room_taken_for_a_rectangle_is_corrected(place: Pose2) -> None:
    believed = House(rooms={"a": rectangle(6.0, 2.5), "b": BESIDE}, doors=DOORS)
    run = believed_in(l_house(), believed, place)
    run.run(90.0, until=lambda run: len(run.memory.snapshot().room("room_1").polygon_m) == 6)
    snapshot = run.memory.snapshot()
    found = polygon_in_house(run.memory, "room_1")
    assert found.shape == (6, 2)
    assert np.linalg.norm(found[:, None] - l_shape()[None], axis=2).min(axis=1).max() < 0.03
    assert snapshot.room("room_1").status is RoomStatus.PERMANENT
    assert snapshot.current_room == "room_1"
    assert sum(node.parent_room == "room_1" for node in snapshot.of_type(WallNode)) == 6
    assert len(snapshot.of_type(RoomNode)) == 2


def test_doors_and_what_they_lead_to_survive_a_revision() -> None:
    believed = House(rooms={"a": rectangle(6.0, 2.5), "b": BESIDE}, doors=DOORS)
    run = believed_in(l_house(), believed, Pose2(4.5, 1.2, 0.3))
    before = {door.id: door for door in run.memory.snapshot().of_type(DoorNode) if not door.provisional}
    run.run(90.0, until=lambda run: len(run.memory.snapshot().room("room_1").polygon_m) == 6)
    snapshot = run.memory.snapshot()
    for door in before.values():
        assert snapshot.door(door.id).rooms == door.rooms
        place = Pose2.from_se3(snapshot.transform(ROOT_ID, door.id)).position_m
        assert np.linalg.norm(place - np.array([1.5, -0.1])) < 0.15


def test_a_room_that_is_as_it_is_believed_to_be_is_left_alone() -> None:
    run = believed_in(l_house(), l_house(), Pose2(4.5, 1.2, 0.3))
    written = run.memory.snapshot().room("room_1").polygon_m
    run.run(20.0)
    assert run.memory.snapshot().room("room_1").polygon_m == written
    assert run.memory.snapshot().room("room_1").confidence > 0.9


def test_a_room_that_is_not_as_believed_loses_confidence_before_it_is_measured_again() -> None:
    believed = House(rooms={"a": rectangle(6.0, 2.5), "b": BESIDE}, doors=DOORS)
    run = believed_in(l_house(), believed, Pose2(4.5, 1.2, 0.3))
    run.run(30.0, until=lambda run: run.memory.snapshot().room("room_1").status is RoomStatus.TEMPORARY)
    assert run.memory.snapshot().room("room_1").status is RoomStatus.TEMPORARY
    assert run.memory.snapshot().room("room_1").confidence < 0.9


def test_only_what_lies_where_the_room_was_can_replace_it() -> None:
    room = RoomNode(id="room_1", polygon_m=tuple((x, y) for x, y in rectangle(6.0, 2.5).tolist()))

    def measured(polygon: Array) -> MeasuredRoom:
        nothing = np.zeros(len(polygon))
        return MeasuredRoom(
            polygon=polygon,
            wall_seen=nothing,
            wall_std_m=nothing,
            T_parent_room=Pose2(0.0, 0.0, 0.0),
            covariance=np.eye(3),
            T_room_base=Pose2(1.0, 1.0, 0.0),
            confidence=1.0,
        )

    assert same_place(room, measured(l_shape()))
    assert same_place(room, measured(rectangle(3.0, 2.5)))
    assert not same_place(room, measured(rectangle(4.0, 3.0, x=1.0, y=2.6)))
    assert not same_place(room, measured(rectangle(4.0, 3.0, x=4.5, y=0.5)))


def test_the_fitness_of_an_outline_falls_where_rays_pass_and_stays_where_they_end() -> None:
    rng, house = np.random.default_rng(0), l_house()
    wrong, right = OutlineFitness(rectangle(6.0, 2.5)), OutlineFitness(l_shape())
    for x_m in np.arange(1.0, 5.0, 0.2):
        pose = Pose2(float(x_m), 1.2, 0.1)
        scan = OutlineSlicer().cut(cast(house, pose, rng))
        wrong.add(scan, pose)
        right.add(scan, pose)
    assert right.contradicted() == []
    assert right.recent > 0.97
    (stretch,) = wrong.contradicted()
    assert (stretch.wall, round(stretch.end_m - stretch.start_m)) == (2, 3)
    assert wrong.recent < 0.85
