"""Invariants of single nodes: their values, and the edges that every node of their type must have."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import fields

from scene_graph.edges import EdgeKey, EdgeType
from scene_graph.errors import Violation, ViolationKind
from scene_graph.identifiers import is_well_formed
from scene_graph.nodes import (
    NODE_CLASSES,
    ROBOT_ID,
    ROOT_ID,
    AffordanceNode,
    DoorNode,
    Node,
    ObjectNode,
    ObjectState,
    RegionNode,
    RobotNode,
    RoomNode,
    RootNode,
    WallNode,
    node_type,
)
from scene_graph.snapshot import Snapshot

_PROBABILITIES: dict[type[Node], tuple[str, ...]] = {
    RoomNode: ("label_probability",),
    ObjectNode: ("existence",),
    RobotNode: ("battery",),
}
_LENGTHS: dict[type[Node], tuple[str, ...]] = {
    RoomNode: ("height_m",),
    WallNode: ("length_m",),
    DoorNode: ("width_m", "height_m"),
    ObjectNode: ("size_m", "surfaces_m"),
}
_FIELD_NAMES: dict[type[Node], tuple[str, ...]] = {
    cls: tuple(field.name for field in fields(cls) if field.name not in {"id", "label"})
    for cls in NODE_CLASSES.values()
}


def value_violations(node_id: str, node: Node) -> Iterator[Violation]:
    """What is wrong with a node by itself."""
    if node.id != node_id or not is_well_formed(node.id) or _misnamed(node):
        message = f"{node.id!r} is not an identifier for the {node_type(node)} at {node_id!r}"
        yield Violation(kind=ViolationKind.MALFORMED_ID, subject=node_id, message=message)
    for name in _FIELD_NAMES[type(node)]:
        if not all(map(math.isfinite, _numbers(getattr(node, name)))):
            message = f"{name} of {node_id} is not finite: {getattr(node, name)}"
            yield Violation(kind=ViolationKind.NOT_FINITE, subject=node_id, message=message)
    for name, probability in _probabilities(node):
        if not 0.0 <= probability <= 1.0:
            message = f"{name} of {node_id} is no probability: {probability}"
            yield Violation(kind=ViolationKind.NOT_A_PROBABILITY, subject=node_id, message=message)
    for name in _LENGTHS.get(type(node), ()):
        if any(number < 0.0 for number in _numbers(getattr(node, name))):
            message = f"{name} of {node_id} is negative: {getattr(node, name)}"
            yield Violation(kind=ViolationKind.NEGATIVE_LENGTH, subject=node_id, message=message)


def structure_violations(snapshot: Snapshot, node_id: str) -> Iterator[Violation]:
    """What is wrong with the frames, rooms and owners of a node."""
    node = snapshot.node(node_id)
    parents = [edge.source for edge in snapshot.edges_to(node_id, EdgeType.RT)]
    if len(parents) > 1:
        message = f"{node_id} has {len(parents)} parent frames: {', '.join(sorted(parents))}"
        yield Violation(kind=ViolationKind.TWO_PARENTS, subject=node_id, message=message)
    if not parents and not isinstance(node, RootNode | AffordanceNode | RegionNode):
        message = f"{node_id} has no parent frame: no rt edge leads to it"
        yield Violation(kind=ViolationKind.NO_PARENT, subject=node_id, message=message)
    if isinstance(node, AffordanceNode) and not snapshot.edges_to(node_id, EdgeType.HAS):
        message = f"affordance {node_id} has no owner: no has edge leads to it"
        yield Violation(kind=ViolationKind.AFFORDANCE_WITHOUT_OWNER, subject=node_id, message=message)
    rooms = [edge.target for edge in snapshot.edges_from(node_id, EdgeType.IN)]
    if len(rooms) > 1:
        what = "regions" if isinstance(node, RoomNode) else "rooms"
        message = f"{node_id} is in {len(rooms)} {what}: {', '.join(sorted(rooms))}"
        yield Violation(kind=ViolationKind.TWO_ROOMS, subject=node_id, message=message)


def grip_violations(snapshot: Snapshot) -> Iterator[Violation]:
    """What is wrong with the gripper as a whole: at most one object hangs from it, and it is the one held."""
    robot = snapshot.robot
    hanging = [child for child in snapshot.children(ROBOT_ID) if isinstance(snapshot.get(child), ObjectNode)]
    if len(hanging) > 1:
        message = f"{len(hanging)} objects in one gripper: {', '.join(sorted(hanging))}"
        yield Violation(kind=ViolationKind.TWO_HELD, subject=ROBOT_ID, message=message)
    if robot and robot.holding is not None and not isinstance(snapshot.get(robot.holding), ObjectNode):
        message = f"robot.holding is {robot.holding!r}, which is no object"
        yield Violation(kind=ViolationKind.HELD_INCONSISTENT, subject=ROBOT_ID, message=message)


def held_violations(snapshot: Snapshot, held: ObjectNode) -> Iterator[Violation]:
    """An object is held when its state, ``robot.holding`` and its parent frame all say so, or none of them."""
    robot = snapshot.robot
    hangs = EdgeKey(EdgeType.RT, ROBOT_ID, held.id) in snapshot.edges
    named = robot is not None and robot.holding == held.id
    if not (hangs == named == (held.state is ObjectState.HELD)):
        message = (
            f"{held.id} has state {held.state}, robot.holding is {robot.holding if robot else None} and its frame "
            f"{'hangs' if hangs else 'does not hang'} from the robot; all three or none must say that it is held"
        )
        yield Violation(kind=ViolationKind.HELD_INCONSISTENT, subject=held.id, message=message)


def _misnamed(node: Node) -> bool:
    """The root and the robot, and nothing else, have the identifiers reserved for them."""
    return (node.id == ROOT_ID) != isinstance(node, RootNode) or (node.id == ROBOT_ID) != isinstance(node, RobotNode)


def _numbers(value: object) -> Iterator[float]:
    if isinstance(value, tuple):
        for item in value:
            yield from _numbers(item)
    elif isinstance(value, int | float):
        yield value


def _probabilities(node: Node) -> Iterator[tuple[str, float]]:
    yield "confidence", node.confidence
    for name in _PROBABILITIES.get(type(node), ()):
        yield name, getattr(node, name)
    if isinstance(node, ObjectNode):
        for label, probability in node.label_distribution:
            yield f"probability of {label!r}", probability
