import math
from dataclasses import replace

import numpy as np
import pytest

from scene_graph.checks.invariants import check
from scene_graph.edges import (
    ConnectsEdge,
    EdgeKey,
    EdgeType,
    HasIntentionEdge,
    InEdge,
    IntentionAction,
    MatchEdge,
    RelationEdge,
    RtEdge,
)
from scene_graph.errors import InvariantBroken, ViolationKind
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import (
    AffordanceKind,
    AffordanceNode,
    CornerNode,
    DoorNode,
    ObjectNode,
    ObjectState,
    RobotNode,
    RoomNode,
)


def rt(source, target, covariance=None):
    return RtEdge(
        source=source,
        target=target,
        T_source_target=SE3.identity(),
        covariance=np.zeros((6, 6)) if covariance is None else covariance,
    )


def rt_key(source, target):
    return EdgeKey(EdgeType.RT, source, target)


K = ViolationKind
TABLE = ObjectNode(id="table_1", label="table")
TABLE_IN_ROOM = EdgeKey(EdgeType.IN, "table_1", "room_1")
VISIT = AffordanceNode(id="aff_1", kind=AffordanceKind.VISIT, target="x")
HAS = EdgeKey(EdgeType.HAS, "door_2_0_0", "aff_cross_2_0_0")
REJECTED = [
    ("two parents", K.TWO_PARENTS, [rt("room_2", "table_1")], []),
    (
        "a circle of frames",
        K.FRAME_CYCLE,
        [rt("room_2", "room_1"), rt("room_1", "room_2")],
        [rt_key("root", "room_1"), rt_key("root", "room_2")],
    ),
    (
        "an edge to nothing",
        K.DANGLING_EDGE,
        [InEdge(source="table_1", target="room_9")],
        [EdgeKey(EdgeType.IN, "table_1", "room_1")],
    ),
    (
        "an object in an object",
        K.WRONG_END_TYPE,
        [InEdge(source="bottle_2", target="table_1")],
        [EdgeKey(EdgeType.IN, "bottle_2", "room_1")],
    ),
    ("a wall on the root", K.WRONG_END_TYPE, [rt("root", "wall_1_1")], [rt_key("room_1", "wall_1_1")]),
    ("a frame for an affordance", K.WRONG_END_TYPE, [rt("room_2", "aff_cross_2_0_0")], []),
    ("a table that connects rooms", K.WRONG_END_TYPE, [ConnectsEdge(source="table_1", target="room_1")], []),
    (
        "an intention of a person",
        K.WRONG_END_TYPE,
        [HasIntentionEdge(source="person_1", target="room_1", agent="a", action=IntentionAction.VISIT, priority=1)],
        [],
    ),
    ("a table that turns into a room", K.WRONG_END_TYPE, [RoomNode(id="table_1")], []),
    ("two rooms for one object", K.TWO_ROOMS, [InEdge(source="table_1", target="room_2")], []),
    ("a node without frame", K.NO_PARENT, [CornerNode(id="corner_9_9")], []),
    ("orphaned children", K.NO_PARENT, [], ["wall_1_1"]),
    (
        "an affordance of nobody",
        K.AFFORDANCE_WITHOUT_OWNER,
        [AffordanceNode(id="aff_1", kind=AffordanceKind.VISIT, target="x")],
        [],
    ),
    (
        "an affordance whose owner goes",
        K.AFFORDANCE_WITHOUT_OWNER,
        [],
        [EdgeKey(EdgeType.HAS, "door_2_0_0", "aff_cross_2_0_0")],
    ),
    ("a held object on the table", K.HELD_INCONSISTENT, [RobotNode(holding="table_1")], []),
    ("a state held without gripper", K.HELD_INCONSISTENT, [replace(TABLE, state=ObjectState.HELD)], []),
    ("a gripper holding a room", K.HELD_INCONSISTENT, [RobotNode(holding="room_1")], []),
    (
        "two objects in one gripper",
        K.TWO_HELD,
        [rt("robot", "table_1"), rt("robot", "bottle_2")],
        [rt_key("room_1", "table_1"), rt_key("room_1", "bottle_2")],
    ),
    ("a probability above one", K.NOT_A_PROBABILITY, [RobotNode(battery=1.01)], []),
    (
        "a label probability below zero",
        K.NOT_A_PROBABILITY,
        [replace(TABLE, label_distribution=(("table", -0.1),))],
        [],
    ),
    (
        "a relation that is too sure",
        K.NOT_A_PROBABILITY,
        [RelationEdge(source="table_1", target="bottle_2", predicate="under", probability=2.0)],
        [],
    ),
    ("a size that is no number", K.NOT_FINITE, [replace(TABLE, size_m=(1.0, math.nan, 1.0))], []),
    (
        "a time that never comes",
        K.NOT_FINITE,
        [RelationEdge(source="table_1", target="bottle_2", predicate="under", probability=0.5, stamp_s=math.inf)],
        [],
    ),
    ("a covariance that is no number", K.NOT_FINITE, [rt("room_1", "table_1", np.full((6, 6), math.nan))], []),
    ("a negative size", K.NEGATIVE_LENGTH, [replace(TABLE, size_m=(1.0, -1.0, 1.0))], []),
    ("a covariance that is not symmetric", K.COVARIANCE, [rt("room_1", "table_1", np.triu(np.ones((6, 6))))], []),
    ("a covariance that is not positive", K.COVARIANCE, [rt("room_1", "table_1", np.diag([1, 1, 1, 1, 1, -0.1]))], []),
    ("an identifier with a space", K.MALFORMED_ID, [ObjectNode(id="my cup", label="cup"), rt("room_1", "my cup")], []),
    ("an object called robot", K.ROBOT_MISSING, [ObjectNode(id="robot", label="cup")], []),
    ("no robot", K.ROBOT_MISSING, [], ["robot"]),
    ("no root", K.ROOT_MISSING, [], ["root"]),
    ("a match the wrong way round", K.MATCH_ORDER, [MatchEdge(source="door_2_0_0", target="door_1_1_0")], []),
    (
        "a match within a room",
        K.MATCH_SAME_ROOM,
        [DoorNode(id="door_2_0_0", rooms=("room_1", "room_2"), width_m=0.9)],
        [],
    ),
]


@pytest.mark.parametrize(("name", "kind", "put", "remove"), REJECTED, ids=[case[0] for case in REJECTED])
def test_memory_refuses(memory, house, name, kind, put, remove):
    tx = memory.edit("careless", 11.0)
    tx.remove(*remove)
    tx.put(*put)
    with pytest.raises(InvariantBroken) as caught, tx:
        pass
    assert kind in {violation.kind for violation in caught.value.violations}
    assert str(caught.value).startswith("transaction of 'careless' rejected: ")
    assert memory.snapshot() is house


def test_every_invariant_has_a_test():
    tested = {kind for _, kind, _, _ in REJECTED}
    assert set(ViolationKind) - tested == {ViolationKind.UNKNOWN_ELEMENT}  # see test_memory.py


def test_a_sound_house_has_no_violations(house):
    assert check(house) == ()


def test_picking_and_placing_keep_the_graph_sound(memory):
    with memory.edit("objects", 11.0) as tx:
        tx.put(RobotNode(holding="bottle_2"), replace(tx.snapshot.object("bottle_2"), state=ObjectState.HELD))
        tx.remove(rt_key("room_1", "bottle_2"))
        tx.put(rt("robot", "bottle_2"))
    assert memory.snapshot().parent("bottle_2").source == "robot"
    with memory.edit("objects", 12.0) as tx:
        tx.put(RobotNode(), replace(tx.snapshot.object("bottle_2"), state=ObjectState.PRESENT))
        tx.remove(rt_key("robot", "bottle_2"))
        tx.put(rt("room_1", "bottle_2"))
    assert check(memory.snapshot()) == ()


def test_a_parent_may_go_together_with_its_children(memory):
    with memory.edit("room_concept", 11.0) as tx:
        tx.remove("wall_1_1", "corner_1_1", "door_1_1_0")
    assert "corner_1_1" not in memory.snapshot()


def test_every_violation_is_reported_at_once(memory):
    with pytest.raises(InvariantBroken) as caught, memory.edit("careless", 11.0) as tx:
        tx.put(RoomNode(id="room_9", confidence=7.0))
    assert {violation.kind for violation in caught.value.violations} == {K.NO_PARENT, K.NOT_A_PROBABILITY}


def test_rounding_errors_of_a_covariance_are_forgiven(memory):
    covariance = np.eye(6) * 1e-4
    covariance[0, 1] = 1e-16
    covariance[5, 5] = -1e-14
    with memory.edit("localization", 11.0) as tx:
        tx.put(rt("room_1", "robot", covariance))
    assert check(memory.snapshot()) == ()
