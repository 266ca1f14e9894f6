"""How long a door is known to be closed."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from perception.doors.maintenance import DoorMaintenance, DoorMaintenanceSettings
from perception.doors.room_evidence import RoomEvidence
from perception.doors.scene import Scene
from perception.geometry.planar import Pose2
from perception.localization.room_model import room_model
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorNode, DoorState
from unit.perception.known_house import frame_of, known_house
from unit.perception.lidar_house import Door, House, cast, rectangle

FORGET_S = DoorMaintenanceSettings().forget_s
ROOMS = {"a": rectangle(4.0, 3.0), "b": rectangle(5.0, 3.0, x=4.2)}
SHUT = House(rooms=ROOMS, doors=[Door(rooms=("a", "b"), center=(4.1, 1.3), open=False)])
WIDE_OPEN = House(rooms=ROOMS, doors=[Door(rooms=("a", "b"), center=(4.1, 1.3))])


def known_closed() -> WorkingMemory:
    """Two rooms whose door was closed when it was seen last."""
    memory = known_house(WIDE_OPEN)
    with memory.edit("test", 0.5) as tx:
        tx.put(*(replace(door, state=DoorState.CLOSED) for door in memory.snapshot().of_type(DoorNode)))
    return memory


def looked_at(memory: WorkingMemory, house: House | None, stamp_s: float) -> Scene:
    """The scene of room a after some scans of ``house``, or none."""
    snapshot, rng = memory.snapshot(), np.random.default_rng(0)
    room, frame = room_model(snapshot, "room_1"), frame_of(ROOMS["a"], 1)
    assert room is not None
    evidence = RoomEvidence(room.polygon)
    for k in range(20 if house is not None else 0):
        pose = Pose2(2.0 + 0.03 * k, 0.5 + 0.01 * k, 0.3)
        evidence.add(cast(house, pose, rng), frame.inverse() @ pose)
    return Scene(snapshot=snapshot, room=room, evidence=evidence, stamp_s=stamp_s)


@pytest.mark.parametrize(
    ("seen", "state"), [(None, DoorState.UNKNOWN), (SHUT, DoorState.CLOSED), (WIDE_OPEN, DoorState.OPEN)]
)
def test_a_closed_door_that_nobody_looks_at_may_be_open_again(seen: House | None, state: DoorState) -> None:
    memory = known_closed()
    upkeep = DoorMaintenance(memory)
    for stamp_s in (1.0, 0.9 * FORGET_S):
        upkeep.run(looked_at(memory, None, stamp_s))
    assert {door.state for door in memory.snapshot().of_type(DoorNode)} == {DoorState.CLOSED}
    for k in range(6):
        upkeep.run(looked_at(memory, seen, FORGET_S + 2.0 + k))
    assert {door.state for door in memory.snapshot().of_type(DoorNode)} == {state}


def test_a_closed_door_of_a_room_that_nobody_knows_stays_closed() -> None:
    memory = known_house(WIDE_OPEN, but=("b",))
    with memory.edit("test", 0.5) as tx:
        tx.put(*(replace(door, state=DoorState.CLOSED) for door in memory.snapshot().of_type(DoorNode)))
    upkeep = DoorMaintenance(memory)
    for stamp_s in (1.0, 2.0 * FORGET_S, 4.0 * FORGET_S):
        upkeep.run(looked_at(memory, None, stamp_s))
    assert {door.state for door in memory.snapshot().of_type(DoorNode)} == {DoorState.CLOSED}
