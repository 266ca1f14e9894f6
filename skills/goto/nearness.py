"""When the robot counts as being *at* something: one rule for the state that plans start from and for GOTO."""

from __future__ import annotations

from math import hypot

from scene_graph.nodes import ROBOT_ID, DoorNode, Node, ObjectNode, ObjectState, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.goto.settings import NearnessSettings
from skills.obstacles.walls import robot_beyond_m


def excess_m(snapshot: Snapshot, node_id: str, settings: NearnessSettings = NearnessSettings()) -> float | None:
    """How much too far the robot is from a node to be at it: 0 or less when it is, ``None`` when in another room.

    A room needs nothing but being within its walls; something missing is nowhere.
    """
    node, room = snapshot.get(node_id), snapshot.current_room
    if node is None or room is None or snapshot.room_of(node_id) != room:
        return None
    if isinstance(node, RoomNode):
        return robot_beyond_m(snapshot)
    if isinstance(node, ObjectNode):
        return (
            None if node.state is ObjectState.MISSING else extent_distance_m(snapshot, node) - _reach_m(node, settings)
        )
    x_m, y_m, _ = snapshot.transform(node_id, ROBOT_ID).translation_m
    return hypot(x_m, y_m) - _reach_m(node, settings)


def is_at(snapshot: Snapshot, node_id: str, settings: NearnessSettings = NearnessSettings()) -> bool:
    """Whether the robot is at an object or a person, and beside it: a graph that has both in one place was never told
    where they are.
    """
    gap_m, node = excess_m(snapshot, node_id, settings), snapshot.get(node_id)
    return gap_m is not None and node is not None and -_reach_m(node, settings) < gap_m <= 0.0


def extent_distance_m(snapshot: Snapshot, node: ObjectNode) -> float:
    """Horizontal distance from the base's axis to the extent of a thing; 0 over it."""
    x_m, y_m, _ = snapshot.transform(node.id, ROBOT_ID).translation_m
    return hypot(max(abs(x_m) - node.size_m[0] / 2, 0.0), max(abs(y_m) - node.size_m[1] / 2, 0.0))


def _reach_m(node: Node, settings: NearnessSettings) -> float:
    if isinstance(node, ObjectNode):
        return settings.graspable_m if node.graspable else settings.object_m
    return {PersonNode: settings.person_m, DoorNode: settings.door_m}.get(type(node), settings.object_m)
