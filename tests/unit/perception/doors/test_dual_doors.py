"""One physical door known from two rooms: what is measured from one side completes the other."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from perception.crossing import match_of
from perception.doors.dual_measurement import completed
from perception.doors.maintenance import DoorMaintenance
from perception.doors.posts import MeasuredGap
from perception.doors.room_evidence import RoomEvidence, Span
from perception.doors.scene import Scene
from perception.geometry.planar import Pose2
from perception.localization.room_model import room_model
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorNode
from unit.perception.known_house import frame_of, known_house
from unit.perception.lidar_house import Box, Door, House, cast, rectangle

WIDTH_M, CENTER_M = 1.2, 1.3
HOUSE = House(
    rooms={"a": rectangle(4.0, 3.0), "b": rectangle(5.0, 3.0, x=4.2)},
    doors=[Door(rooms=("a", "b"), center=(4.1, CENTER_M), width=WIDTH_M)],
)
TALL_BOX = Box(center=(3.7, 2.0), size=(0.3, 0.9, 1.95))


def scene_of(memory: WorkingMemory, evidence: RoomEvidence) -> Scene:
    snapshot = memory.snapshot()
    room = room_model(snapshot, "room_1")
    assert room is not None
    return Scene(snapshot=snapshot, room=room, evidence=evidence, stamp_s=1.0)


def evidence_from(memory: WorkingMemory, house: House) -> RoomEvidence:
    """What was seen of room a from a place in it, while the robot drove on a little."""
    room, rng = room_model(memory.snapshot(), "room_1"), np.random.default_rng(0)
    assert room is not None
    evidence, frame = RoomEvidence(room.polygon), frame_of(house.rooms["a"], 1)
    for k in range(20):
        pose = Pose2(2.0 + 0.03 * k, 0.5 + 0.01 * k, 0.3)
        evidence.add(cast(house, pose, rng), frame.inverse() @ pose)
    return evidence


def half_known(memory: WorkingMemory, *, confidence: float, width_m: float, off_m: float) -> tuple[str, str]:
    """Make the door as known from room a worse than its dual; the names of the two."""
    near = next(door for door in memory.snapshot().of_type(DoorNode) if door.rooms[0] == "room_1")
    far = match_of(memory.snapshot(), near.id)
    assert far is not None
    with memory.edit("test", 0.5) as tx:
        edge = tx.snapshot.parent(near.id)
        assert edge is not None
        aside = SE3.from_xyz_yaw(off_m, 0.0, 0.0, 0.0)
        tx.put(replace(near, confidence=confidence, width_m=width_m))
        tx.put(replace(edge, T_source_target=edge.T_source_target @ aside))
        tx.put(replace(tx.snapshot.door(far), confidence=0.95, width_m=WIDTH_M))
    return near.id, far


def place_of(memory: WorkingMemory, door_id: str) -> float:
    """Station of a door in the house, along the wall between the rooms."""
    x_m, y_m, _ = memory.snapshot().position(door_id, "room_1")
    return float(frame_of(HOUSE.rooms["a"], 1).apply(np.array([x_m, y_m]))[1])


@pytest.mark.parametrize("boxes", [[TALL_BOX], []])
def test_a_door_with_a_hidden_post_is_completed_by_its_width_as_measured_from_the_other_room(boxes: list[Box]) -> None:
    memory = known_house(HOUSE)
    door_id, _ = half_known(memory, confidence=0.75, width_m=0.9, off_m=-0.15)
    DoorMaintenance(memory).learn(scene_of(memory, evidence_from(memory, replace(HOUSE, boxes=boxes))))
    door = memory.snapshot().door(door_id)
    assert door.width_m == pytest.approx(WIDTH_M, abs=0.01)
    assert place_of(memory, door_id) == pytest.approx(CENTER_M, abs=0.01)
    assert door.confidence > 0.9


def test_a_door_that_nobody_saw_from_here_is_where_the_layout_has_its_twin() -> None:
    memory = known_house(HOUSE)
    door_id, _ = half_known(memory, confidence=0.7, width_m=0.9, off_m=0.1)
    room = room_model(memory.snapshot(), "room_1")
    assert room is not None
    DoorMaintenance(memory).learn(scene_of(memory, RoomEvidence(room.polygon)))
    assert memory.snapshot().door(door_id).width_m == pytest.approx(WIDTH_M)
    assert place_of(memory, door_id) == pytest.approx(CENTER_M, abs=0.001)
    assert memory.snapshot().door(door_id).confidence == 0.7


def test_a_well_measured_door_learns_nothing_from_its_twin() -> None:
    memory = known_house(HOUSE)
    door_id, _ = half_known(memory, confidence=0.95, width_m=1.21, off_m=0.0)
    DoorMaintenance(memory).learn(scene_of(memory, evidence_from(memory, HOUSE)))
    assert memory.snapshot().door(door_id).width_m == 1.21


@pytest.mark.parametrize(("known_m", "seen_m"), [(0.8, 0.96), (WIDTH_M, WIDTH_M)])
def test_an_unmeasured_end_is_only_ever_seen_to_be_farther_away(known_m: float, seen_m: float) -> None:
    memory = known_house(HOUSE, but=("b",))
    door = memory.snapshot().of_type(DoorNode)[0]
    with memory.edit("test", 0.5) as tx:
        tx.put(replace(door, confidence=0.75, width_m=known_m))
    DoorMaintenance(memory).run(scene_of(memory, evidence_from(memory, replace(HOUSE, boxes=[TALL_BOX]))))
    assert memory.snapshot().door(door.id).width_m == pytest.approx(seen_m, abs=0.03)


def test_a_gap_wider_than_the_twin_is_left_as_it_is() -> None:
    measured = MeasuredGap(center_m=1.0, width_m=1.4, std_m=0.025, posts=1, start_std_m=0.003)
    assert completed(measured, Span(center_m=1.0, width_m=1.2)) is measured


@pytest.mark.parametrize(("start_std_m", "end_std_m", "center_m"), [(0.003, 0.05, 1.1), (0.05, 0.003, 0.9)])
def test_the_measured_post_stays_where_it_is(start_std_m: float, end_std_m: float, center_m: float) -> None:
    measured = MeasuredGap(
        center_m=1.0, width_m=1.0, std_m=0.025, posts=1, start_std_m=start_std_m, end_std_m=end_std_m
    )
    whole = completed(measured, Span(center_m=5.0, width_m=1.2))
    assert (whole.center_m, whole.width_m, whole.posts) == (pytest.approx(center_m), 1.2, 2)
