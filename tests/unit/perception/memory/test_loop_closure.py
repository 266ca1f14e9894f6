"""Loop closure: a room that is known is recognized though the layout has drifted, and its twin is not."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from perception.geometry.planar import Pose2, wrap
from perception.memory.loop_closure import recognize, same_room
from perception.memory.registration import register_outline
from scene_graph.edges import EdgeType, InEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROOT_ID, CrossingStatus, DoorNode, ObjectNode, RoomNode
from unit.perception.exploring_robot import Exploration
from unit.perception.known_house import frame_of, known_house
from unit.perception.lidar_house import Box, Door, House, l_shape, rectangle
from unit.perception.localization.test_global_localization import offices, sight
from unit.perception.test_kidnapping import agents

DRIFTS = [Pose2(0.0, 0.0, 0.0), Pose2(0.3, 0.0, 0.0), Pose2(-0.2, 0.2, 0.03), Pose2(0.0, -0.3, -0.05)]


def forget_door(memory: WorkingMemory, door_id: str) -> DoorNode:
    """Nobody has gone through a door yet: its far side is gone, and the near one leads nowhere."""
    snapshot = memory.snapshot()
    with memory.edit("test", 0.0) as tx:
        for edge in (*snapshot.edges_from(door_id, EdgeType.MATCH), *snapshot.edges_to(door_id, EdgeType.MATCH)):
            tx.remove(edge.target if edge.source == door_id else edge.source)
        near = snapshot.door(door_id)
        tx.put(replace(near, rooms=(near.rooms[0], None), crossing=CrossingStatus.UNCROSSED))
    return memory.snapshot().door(door_id)


def drift(memory: WorkingMemory, room_id: str, error: Pose2) -> None:
    """The layout has a room elsewhere than it is, by ``error`` in the room's own frame."""
    pose = Pose2.from_se3(memory.snapshot().transform(ROOT_ID, room_id))
    with memory.edit("test", 0.0) as tx:
        tx.put(RtEdge(source=ROOT_ID, target=room_id, T_source_target=(pose @ error).to_se3()))


def shift(memory: WorkingMemory, room_id: str, off_m: float) -> None:
    """The layout has a room farther along the house's x than it is."""
    pose = Pose2.from_se3(memory.snapshot().transform(ROOT_ID, room_id))
    with memory.edit("test", 0.0) as tx:
        place = Pose2(off_m, 0.0, 0.0) @ pose
        tx.put(RtEdge(source=ROOT_ID, target=room_id, T_source_target=place.to_se3()))


def behind(house: House, memory: WorkingMemory, door_id: str, seed: int = 0):
    """What the robot sees 0.9 m behind a door that leads out of the first room, and where it is in that room."""
    T_root_door = Pose2.from_se3(memory.snapshot().transform(ROOT_ID, door_id))
    T_house_base = T_root_door @ Pose2(0.05, -0.9, -np.pi / 2)
    near = memory.snapshot().door(door_id).rooms[0]
    T_root_near = Pose2.from_se3(memory.snapshot().transform(ROOT_ID, near))
    seen = sight(house, T_house_base, np.random.default_rng(seed))
    return seen, T_root_near.inverse() @ T_house_base, T_house_base


@pytest.mark.parametrize("error", DRIFTS)
@pytest.mark.parametrize(("door_id", "name"), [("door_1_0_0", "wide"), ("door_1_0_3", "small"), ("door_1_2_0", "L")])
def test_a_room_entered_by_another_door_is_recognized_though_the_layout_has_drifted(
    door_id: str, name: str, error: Pose2
) -> None:
    house = offices()
    memory = known_house(house, error_m=0.01)
    door = forget_door(memory, door_id)
    seen, T_near_base, T_house_base = behind(house, memory, door_id)
    number = list(house.rooms).index(name) + 1
    drift(memory, f"room_{number}", error)
    known = recognize(memory.snapshot(), T_near_base, seen, door)
    assert known is not None
    assert known.room_id == f"room_{number}"
    truth = frame_of(house.rooms[name], number).inverse() @ T_house_base
    assert known.T_room_base.distance_m(truth) < 0.05
    assert abs(wrap(known.T_room_base.yaw_rad - truth.yaw_rad)) < 0.01


@pytest.mark.parametrize("off_m", [0.0, 0.3, -0.3, 2.0, 3.7])
def test_the_twin_of_a_known_office_is_a_new_room_wherever_the_layout_has_the_known_one(off_m: float) -> None:
    """Even where the layout has the known office in the place of its twin, that office has a door of its own."""
    house = offices()
    memory = known_house(house, but=("twin two",))
    door = memory.snapshot().door("door_1_0_2")
    seen, T_near_base, _ = behind(house, memory, door.id)
    shift(memory, "room_3", off_m)
    assert recognize(memory.snapshot(), T_near_base, seen, door) is None


def test_cabins_narrower_than_the_drift_are_told_apart() -> None:
    cabins = {f"cabin {k}": rectangle(1.2, 1.6, x=1.3 * k) for k in range(4)}
    doors = [Door(rooms=(f"cabin {k}", "hall"), center=(1.3 * k + 0.6, 1.7), width=0.8) for k in range(4)]
    house = House(rooms={"hall": rectangle(5.1, 2.0, y=1.8), **cabins}, doors=doors)
    memory = known_house(house, but=("cabin 2",))
    door = memory.snapshot().door("door_1_0_2")
    seen, T_near_base, _ = behind(house, memory, door.id)
    for error_m in (-1.3, -0.6, 0.0, 0.6, 1.3):
        moved = known_house(house, but=("cabin 2",))
        for room_id in ("room_3", "room_5"):
            shift(moved, room_id, error_m)
        assert recognize(moved.snapshot(), T_near_base, seen, door) is None


def put_again(memory: WorkingMemory, house: House, name: str, error: Pose2) -> str:
    """A room measured a second time: the same outline in a frame of its own, where the layout has it by error."""
    frame = frame_of(house.rooms[name], 9)
    polygon = frame.inverse().apply(house.rooms[name])
    with memory.edit("test", 0.0) as tx:
        tx.put(replace(memory.snapshot().room("room_1"), id="room_9", polygon_m=tuple(map(tuple, polygon.tolist()))))
        tx.put(RtEdge(source=ROOT_ID, target="room_9", T_source_target=(frame @ error).to_se3()))
    return "room_9"


@pytest.mark.parametrize("error", [*DRIFTS, Pose2(0.45, 0.3, 0.0)])
@pytest.mark.parametrize("name", ["wide", "small", "L"])
def test_a_room_measured_twice_is_one_room_and_its_frames_agree(name: str, error: Pose2) -> None:
    house = offices()
    memory = known_house(house, error_m=0.01)
    number = list(house.rooms).index(name) + 1
    door_id = next(
        door.id for door in memory.snapshot().of_type(DoorNode) if door.rooms == ("room_1", f"room_{number}")
    )
    door = forget_door(memory, door_id)
    room_id = put_again(memory, house, name, error)
    same = same_room(memory.snapshot(), room_id, door)
    assert same is not None
    assert same.room_id == f"room_{number}"
    truth = frame_of(house.rooms[name], number).inverse() @ frame_of(house.rooms[name], 9)
    assert same.T_old_new.distance_m(truth) < 0.03


@pytest.mark.parametrize("off_m", [0.0, 0.3, -0.3, 2.0, 3.7])
def test_the_measured_twin_of_a_known_office_is_not_merged_with_it(off_m: float) -> None:
    """Even where the layout has the known office in the place of its twin."""
    house = offices()
    memory = known_house(house, but=("twin two",))
    room_id = put_again(memory, house, "twin two", Pose2.identity())
    shift(memory, "room_3", off_m)
    assert same_room(memory.snapshot(), room_id, memory.snapshot().door("door_1_0_2")) is None


def test_other_furniture_makes_another_room() -> None:
    house = offices()
    memory = known_house(house, error_m=0.01)
    door = forget_door(memory, "door_1_0_0")
    room_id = put_again(memory, house, "wide", Pose2(0.1, 0.0, 0.0))

    def furnish(room: str, node_id: str, point: tuple[float, float]) -> None:
        pose = Pose2.from_se3(memory.snapshot().transform(ROOT_ID, room)).inverse() @ Pose2(*point, 0.0)
        with memory.edit("test", 0.0) as tx:
            tx.put(ObjectNode(id=node_id, label=node_id.partition("_")[0], support=True, size_m=(1.0, 0.6, 0.7)))
            T_room_object = SE3.from_xyz_yaw(pose.x_m, pose.y_m, 0.35, 0.0)
            tx.put(RtEdge(source=room, target=node_id, T_source_target=T_room_object))
            tx.put(InEdge(source=node_id, target=room))

    furnish("room_2", "table_1", (1.0, 0.5))
    assert same_room(memory.snapshot(), room_id, door) is not None
    furnish(room_id, "desk_1", (3.2, 2.5))
    assert same_room(memory.snapshot(), room_id, door) is None
    furnish(room_id, "table_2", (1.1, 0.55))
    assert same_room(memory.snapshot(), room_id, door) is not None


@given(st.floats(-3, 3), st.floats(-3, 3), st.floats(-3.1, 3.1), st.integers(0, 5))
def test_an_outline_is_laid_on_itself_whichever_corner_comes_first(x: float, y: float, yaw: float, first: int) -> None:
    motion = Pose2(x, y, yaw)
    moved = np.roll(motion.inverse().apply(l_shape()), first, axis=0)
    laid = register_outline(l_shape(), moved, Pose2.identity(), most_m=0.01)
    assert laid is not None
    assert laid.distance_m(motion) < 1e-6
    assert abs(wrap(laid.yaw_rad - motion.yaw_rad)) < 1e-6


def test_of_the_ways_to_lay_a_rectangle_the_nearest_is_taken_and_another_shape_has_none() -> None:
    for turn in (0.0, np.pi):
        laid = register_outline(rectangle(4.0, 3.0), rectangle(4.0, 3.0), Pose2(4.0, 3.0, np.pi + turn), most_m=0.1)
        assert laid is not None
        assert abs(wrap(laid.yaw_rad - np.pi - turn)) < 1e-6 or turn == 0.0
    assert register_outline(rectangle(4.0, 3.0), rectangle(4.4, 3.0), Pose2.identity(), most_m=0.12) is None
    assert register_outline(rectangle(4.0, 3.0), l_shape(), Pose2.identity(), most_m=0.12) is None


def two_offices() -> House:
    """Two equal offices, equally furnished, side by side on one corridor."""
    return House(
        rooms={
            "corridor": rectangle(8.0, 1.8, y=3.2),
            "first": rectangle(3.5, 3.0, x=0.2),
            "second": rectangle(3.5, 3.0, x=3.9),
        },
        doors=[
            Door(rooms=("first", "corridor"), center=(1.0, 3.1)),
            Door(rooms=("second", "corridor"), center=(4.7, 3.1)),
        ],
        boxes=[Box(center=(x, 0.4), size=(1.4, 0.7, 0.75)) for x in (1.5, 5.2)],
    )


@pytest.mark.slow
@pytest.mark.long
@pytest.mark.parametrize("seed", range(2))
def test_two_equal_offices_on_one_corridor_become_two_rooms(seed: int) -> None:
    house = two_offices()
    run = Exploration.of(house, Pose2(2.5, 4.1, 0.3), seed, agents, way_error=0.05, turn_error=0.03)
    run.run(200.0, until=lambda one: one.memory.snapshot().root.explored)
    snapshot = run.memory.snapshot()
    assert snapshot.root.explored
    assert len(snapshot.of_type(RoomNode)) == 3
    assert sorted(door.rooms for door in snapshot.of_type(DoorNode)) == [
        ("room_1", "room_2"),
        ("room_1", "room_3"),
        ("room_2", "room_1"),
        ("room_3", "room_1"),
    ]


def ring() -> House:
    """Six rooms around a court: two of them are equal, and the way around is 30 m long."""
    rooms = {
        "a": rectangle(4.0, 3.0),
        "b": rectangle(4.0, 3.0, x=4.2),
        "c": rectangle(3.0, 4.0, x=8.4),
        "d": rectangle(3.0, 3.0, x=8.4, y=4.2),
        "e": rectangle(5.0, 3.0, x=3.2, y=4.2),
        "f": rectangle(3.0, 4.0, y=3.2),
    }
    doors = [
        Door(rooms=("a", "b"), center=(4.1, 1.4)),
        Door(rooms=("b", "c"), center=(8.3, 1.2)),
        Door(rooms=("c", "d"), center=(9.8, 4.1)),
        Door(rooms=("d", "e"), center=(8.3, 5.8)),
        Door(rooms=("e", "f"), center=(3.1, 5.8)),
        Door(rooms=("a", "f"), center=(1.3, 3.1)),
    ]
    return House(rooms=rooms, doors=doors)


@pytest.mark.slow
@pytest.mark.long
def test_a_ring_of_rooms_closes_with_odometry_five_times_as_bad_as_usual() -> None:
    run = Exploration.of(ring(), Pose2(1.5, 1.5, 0.3), 0, agents, way_error=0.05, turn_error=0.05)
    run.run(300.0, until=lambda one: one.memory.snapshot().root.explored)
    snapshot = run.memory.snapshot()
    assert snapshot.root.explored
    assert len(snapshot.of_type(RoomNode)) == 6
    assert len(snapshot.of_type(DoorNode)) == 12
    assert all(door.crossing is CrossingStatus.CROSSED for door in snapshot.of_type(DoorNode))
    assert run.localization_error()[0] < 0.15
