"""The layout as it stands in the graph: derived from what was measured, the same whenever it is computed."""

from __future__ import annotations

import json
from dataclasses import replace

import numpy as np
import pytest

from perception.crossing import move_robot
from perception.doors.insertion import hang
from perception.doors.posts import MeasuredGap
from perception.geometry.planar import Pose2, diagonal_covariance, spatial_covariance
from perception.localization.room_model import room_model
from perception.memory.dual_doors import place_in, root_pose
from perception.memory.joining import join, put_dual
from perception.memory.room_layout import RoomLayout
from perception.rooms.survey.instance import MeasuredRoom, room_elements
from scene_graph.documents.interchange import to_json
from scene_graph.edges import EdgeType, RtEdge
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.long_term.records import edge_record, read_edge
from scene_graph.memory import Transaction, WorkingMemory
from scene_graph.nodes import ROOT_ID, DoorNode, RoomStatus
from scene_graph.queries.laid_out import laid_out
from scene_graph.snapshot import Snapshot

HALF_M, THICKNESS_M, TOO_LONG_M = 2.0, 0.2, 0.06
SQUARE = np.array([[-HALF_M, -HALF_M], [HALF_M, -HALF_M], [HALF_M, HALF_M], [-HALF_M, HALF_M]])
SOUTH, EAST, NORTH, WEST = range(4)
CENTERS = {1: (0.0, 0.0), 2: (4.2, 0.0), 3: (4.2, 4.2), 4: (0.0, 4.2)}
JOINED = ((1, EAST, 2, WEST), (2, NORTH, 3, SOUTH), (3, WEST, 4, EAST), (4, SOUTH, 1, NORTH))


def put_room(tx: Transaction, number: int) -> None:
    """A room where it is; the east wall of the first was seen badly, too far out."""
    polygon, stds = SQUARE.copy(), np.full(4, 0.001)
    if number == 1:
        polygon[[1, 2], 0] += TOO_LONG_M
        stds[EAST] = 0.1
    measured = MeasuredRoom(
        polygon=polygon,
        wall_seen=np.ones(4),
        wall_std_m=stds,
        T_parent_room=Pose2.identity(),
        covariance=np.eye(3),
        T_room_base=Pose2.identity(),
        confidence=1.0,
    )
    tx.put(*room_elements(measured, f"room_{number}", status=RoomStatus.PERMANENT, height_m=2.5, stamp_s=0.0))
    covariance = spatial_covariance(diagonal_covariance(0.01, 0.01, 0.003))
    pose = Pose2(*CENTERS[number], 0.0).to_se3()
    tx.put(RtEdge(source=ROOT_ID, target=f"room_{number}", T_source_target=pose, covariance=covariance))


def put_door(tx: Transaction, number: int, wall: int) -> DoorNode:
    length_m = HALF_M * 2.0 + (TOO_LONG_M if number == 1 and wall in (SOUTH, NORTH) else 0.0)
    start_m = HALF_M if not (number == 1 and wall == NORTH) else HALF_M + TOO_LONG_M
    gap = MeasuredGap(center_m=start_m, width_m=0.9, std_m=0.003, posts=2)
    door = DoorNode(id=f"door_{number}_{wall}_0", rooms=(f"room_{number}", None), width_m=0.9, provisional=False)
    tx.put(door, hang(door.id, f"wall_{number}_{wall}", length_m, gap, 0.0))
    return door


def square_of_rooms(joined: tuple[tuple[int, int, int, int], ...] = JOINED) -> WorkingMemory:
    """Four rooms; between the first two, the wall was driven through as thick as it is, seen from the wrong face."""
    memory = WorkingMemory(long_term=LongTermStore())
    with memory.edit("test", 0.0) as tx:
        for number in CENTERS:
            put_room(tx, number)
    for near, wall, far, other in joined:
        with memory.edit("test", 0.0) as tx:
            first, second = put_door(tx, near, wall), put_door(tx, far, other)
            T_near_far = Pose2(*(np.array(CENTERS[far]) - CENTERS[near]), 0.0)
            if near == 1:
                T_near_far = Pose2(TOO_LONG_M, 0.0, 0.0) @ T_near_far
            join(tx, first, second, T_near_far)
    with memory.edit("test", 0.0) as tx:
        move_robot(tx, "room_1", Pose2.identity(), 0.0)
    return memory


def laid_out_by(memory: WorkingMemory) -> Snapshot:
    RoomLayout(memory).update(1.0)
    return memory.building()


def misfits_mm(snapshot: Snapshot) -> list[float]:
    """Of each door in the map: how far its two faces are from being a wall's thickness apart."""
    matches = [edge for edge in snapshot.edges.values() if edge.key.type is EdgeType.MATCH]
    between = [root_pose(snapshot, edge.source).inverse() @ root_pose(snapshot, edge.target) for edge in matches]
    return [1e3 * float(np.hypot(pose.x_m, pose.y_m + THICKNESS_M)) for pose in between]


def shape(snapshot: Snapshot, room: str) -> np.ndarray:
    return np.array(snapshot.room(room).polygon_m)


def test_the_map_shows_a_room_of_the_size_with_which_the_loop_closes() -> None:
    building = laid_out_by(square_of_rooms())
    shown = {node["id"]: node for node in to_json(building)["nodes"]}
    assert np.ptp(np.array(shown["room_1"]["polygon_m"]), axis=0) == pytest.approx([4.0, 4.0], abs=0.003)
    assert np.ptp(shape(building, "room_1"), axis=0) == pytest.approx([4.0 + TOO_LONG_M, 4.0])
    assert shown["door_1_1_0"]["position_m"][:2] == pytest.approx([2.1, 0.0], abs=0.003)
    assert max(misfits_mm(laid_out(building))) < 2.0 < 50.0 < max(misfits_mm(building))
    for number, center in CENTERS.items():
        assert root_pose(building, f"room_{number}").position_m == pytest.approx(center, abs=0.003)


def test_without_a_loop_every_room_keeps_its_measured_size() -> None:
    building = laid_out_by(square_of_rooms(JOINED[:3]))
    assert all(building.parent(f"room_{number}").wall_shifts_m == () for number in CENTERS)
    assert laid_out(building) is building


def test_the_layout_stays_the_same_however_often_it_is_computed_and_after_a_restart() -> None:
    memory = square_of_rooms()
    before = laid_out_by(memory)
    places = {f"room_{number}": before.parent(f"room_{number}") for number in CENTERS}
    for _ in range(3):
        edges = [read_edge(json.loads(json.dumps(edge_record(edge))), "edge") for edge in before.edges.values()]
        restarted = WorkingMemory(Snapshot.of(before.nodes.values(), edges), long_term=LongTermStore())
        before = laid_out_by(restarted)
        assert {room: before.parent(room) for room in places} == places


def test_the_way_through_a_door_that_nobody_told_is_kept_once_it_was_looked_up() -> None:
    memory = square_of_rooms()
    with memory.edit("test", 0.0) as tx:
        for edge in tx.snapshot.edges.values():
            if edge.key.type is EdgeType.MATCH:
                tx.put(replace(edge, walked=None, walked_std_m=0.0))
    building = laid_out_by(memory)
    matches = [edge for edge in building.edges.values() if edge.key.type is EdgeType.MATCH]
    assert all(edge.walked is not None and edge.walked_std_m > 0.0 for edge in matches)


def test_an_unloaded_room_is_laid_out_without_being_loaded() -> None:
    memory = square_of_rooms()
    memory.unload("room_3", agent="test", stamp_s=0.5)
    poorly = memory.building().parent("wall_1_1")
    assert poorly is not None
    with memory.edit("test", 0.6) as tx:
        tx.put(replace(poorly, covariance=np.diag([0.02**2] * 6)))
    building = laid_out_by(memory)
    assert memory.unloaded == ("room_3",)
    assert building.parent("room_1").wall_shifts_m != ()
    assert building.parent("room_3").stamp_s == 1.0


def test_a_door_into_a_room_whose_wall_there_was_not_seen_brings_that_wall_along():
    memory = WorkingMemory()
    with memory.edit("test", 0.0) as tx:
        put_room(tx, 2)
        put_room(tx, 3)
        near = put_door(tx, 2, NORTH)
    unseen = f"wall_3_{SOUTH}"
    with memory.edit("test", 0.0) as tx:
        tx.remove(f"corner_3_{SOUTH}")
        tx.remove(unseen)
    snapshot = memory.snapshot()
    T_far_near = root_pose(snapshot, "room_3").inverse() @ root_pose(snapshot, "room_2")
    room = room_model(snapshot, "room_3")
    place = place_in(room, T_far_near @ Pose2.from_se3(snapshot.transform("room_2", near.id)))
    with memory.edit("long_term_memory", 1.0) as tx:
        far = put_dual(tx, near, room, place, 1.0)
        join(tx, near, far, T_far_near.inverse())
    snapshot = memory.snapshot()
    assert snapshot.parent(far.id).source == unseen
    assert snapshot.node(unseen).confidence < 1.0
    assert root_pose(snapshot, far.id).distance_m(root_pose(snapshot, near.id)) == pytest.approx(THICKNESS_M, abs=0.01)
