import math

import numpy as np
import pytest

from scene_graph.edges import (
    ConnectsEdge,
    HasEdge,
    HasIntentionEdge,
    InEdge,
    IntentionAction,
    MatchEdge,
    Priority,
    RelationEdge,
    RtEdge,
)
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import (
    AffordanceKind,
    AffordanceNode,
    CornerNode,
    CrossingStatus,
    DoorNode,
    ObjectNode,
    ObjectState,
    PersonNode,
    RobotNode,
    RoomNode,
    RoomStatus,
    WallNode,
)

SQUARE = ((-2.0, -2.0), (2.0, -2.0), (2.0, 2.0), (-2.0, 2.0))


def hang(parent, child, x, y, z=0.0, yaw=0.0, std_m=0.0):
    return RtEdge(
        source=parent,
        target=child,
        T_source_target=SE3.from_xyz_yaw(x, y, z, yaw),
        covariance=np.diag([std_m**2] * 3 + [0.0] * 3),
        stamp_s=1.0,
    )


def thing(object_id, label, room, x, y, z, size_m, **more):
    node = ObjectNode(
        id=object_id, label=label, size_m=size_m, label_distribution=((label, 0.9), ("vase", 0.1)), **more
    )
    return (node, hang(room, object_id, x, y, z, std_m=0.01), InEdge(source=object_id, target=room))


@pytest.fixture
def memory():
    """A kitchen and, 4.2 m to its right and turned by a right angle, an office; one open door between them."""
    memory = WorkingMemory()
    with memory.edit("builder", 10.0) as tx:
        tx.put(
            RoomNode(
                id="room_1", label="kitchen", label_probability=0.8, polygon_m=SQUARE, status=RoomStatus.PERMANENT
            ),
            RoomNode(id="room_2", label="office", polygon_m=SQUARE, status=RoomStatus.PERMANENT),
            hang("root", "room_1", 0.5, 0.0),
            hang("root", "room_2", 4.7, 0.0, yaw=math.pi / 2),
            WallNode(id="wall_1_1", parent_room="room_1", normal=(-1.0, 0.0), offset_m=-2.0, length_m=4.0),
            WallNode(id="wall_2_0", parent_room="room_2", normal=(0.0, -1.0), offset_m=-2.0, length_m=4.0),
            hang("room_1", "wall_1_1", 2.0, 0.0, yaw=math.pi / 2),
            hang("room_2", "wall_2_0", 0.0, 2.0, yaw=math.pi),
            CornerNode(id="corner_1_1"),
            hang("wall_1_1", "corner_1_1", -2.0, 0.0),
            DoorNode(
                id="door_1_1_0",
                rooms=("room_1", "room_2"),
                width_m=0.9,
                provisional=False,
                crossing=CrossingStatus.CROSSED,
            ),
            DoorNode(
                id="door_2_0_0",
                rooms=("room_2", "room_1"),
                width_m=0.91,
                provisional=False,
                crossing=CrossingStatus.CROSSED,
            ),
            hang("wall_1_1", "door_1_1_0", 1.0, 0.0),
            hang("wall_2_0", "door_2_0_0", -1.0, 0.0),
            MatchEdge(source="door_1_1_0", target="door_2_0_0"),
            ConnectsEdge(source="door_1_1_0", target="room_1"),
            ConnectsEdge(source="door_1_1_0", target="room_2"),
            ConnectsEdge(source="door_2_0_0", target="room_1"),
            ConnectsEdge(source="door_2_0_0", target="room_2"),
            AffordanceNode(id="aff_cross_2_0_0", kind=AffordanceKind.CROSS, target="door_2_0_0"),
            HasEdge(source="door_2_0_0", target="aff_cross_2_0_0"),
            *thing("table_1", "table", "room_1", 1.0, 1.0, 0.375, (1.2, 0.8, 0.75), support=True, last_seen_s=9.0),
            *thing(
                "bottle_2",
                "bottle",
                "room_1",
                1.0,
                1.2,
                0.85,
                (0.07, 0.07, 0.2),
                color="blue",
                graspable=True,
                last_seen_s=9.5,
                categories=("drink", "fragile"),
            ),
            *thing(
                "bottle_10",
                "bottle",
                "room_2",
                0.0,
                0.0,
                0.1,
                (0.07, 0.07, 0.3),
                color="red",
                state=ObjectState.MISSING,
            ),
            RelationEdge(source="bottle_2", target="table_1", predicate="on", probability=0.9, stamp_s=9.0),
            RelationEdge(source="bottle_2", target="bottle_10", predicate="in", probability=0.2),
            PersonNode(id="person_1", name="Ada", last_seen_s=8.0),
            hang("room_2", "person_1", 1.0, 0.0),
            InEdge(source="person_1", target="room_2"),
            RobotNode(battery=0.5),
            HasIntentionEdge(
                source="robot",
                target="room_2",
                agent="objects",
                action=IntentionAction.LOOK,
                priority=Priority.LOOK_AROUND,
            ),
            InEdge(source="robot", target="room_1"),
        )
        tx.remove(memory.snapshot().parent("robot").key)
        tx.put(hang("room_1", "robot", -0.5, 0.0))
    return memory


@pytest.fixture
def house(memory):
    return memory.snapshot()
