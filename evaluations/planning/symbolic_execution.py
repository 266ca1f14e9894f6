"""What comes of a plan: its steps carried out symbolically, and written into the graph for the next request."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from planner.tasks.tasks import StepReport
from scene_graph.edges import Edge, EdgeType, InEdge, RelationEdge, RtEdge
from scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID, ObjectNode, ObjectState, RobotNode
from scene_graph.snapshot import Snapshot
from skills.skill import Skill
from skills.state.state import PlaceRelation, PlanState

BESIDE_M = 0.3
"""From the middle of what is no support, a person or a room, a thing is put down beside; any place would do."""
_GRIPPER = SE3.from_xyz_yaw(0.3, 0.0, 0.8, 0.0)


def perform(
    steps: Sequence[StepReport], start: PlanState, skills: Mapping[str, Skill]
) -> tuple[tuple[PlanState, ...], str]:
    """The states from ``start`` on, one after each step, and what stood in the way of the next, ``""`` if nothing."""
    trail = [start]
    for step in steps:
        unmet = skills[step.skill].conditions(trail[-1], step.args)
        if unmet:
            return tuple(trail), f"{step.text}: {unmet[0].message}"
        trail.append(skills[step.skill].effects(trail[-1], step.args))
    return tuple(trail), ""


def write(start: PlanState, end: PlanState, memory: WorkingMemory, stamp_s: float) -> None:
    """Make the graph, which believes ``start``, believe ``end``, as perception would after the robot has acted."""
    snapshot = memory.building()
    edits: list[Edit] = []
    if end.robot_at != start.robot_at and end.robot_room is not None:
        edits += _robot_to(end, snapshot)
    for object_id, place in end.places.items():
        if start.places.get(object_id) != place:
            edits += _object_to(object_id, place, end, snapshot, stamp_s)
    if end.holding is not None and end.holding != start.holding:
        edits += _into_hand(end, snapshot, stamp_s)
    if end.holding != start.holding:
        edits.append(PutNode(replace(snapshot.robot or RobotNode(), holding=end.holding)))
    if edits:
        memory.commit(edits, agent="evaluation", stamp_s=stamp_s)


def _robot_to(end: PlanState, snapshot: Snapshot) -> list[Edit]:
    room = end.robot_room or ROBOT_ID
    return [*_loosen(ROBOT_ID, snapshot), *_stand(ROBOT_ID, room, _point(end.robot_at, room, snapshot), 0.0)]


def _object_to(
    object_id: str, place: tuple[PlaceRelation, str], end: PlanState, snapshot: Snapshot, stamp_s: float
) -> list[Edit]:
    relation, target = place
    room = end.room_of(object_id) or target
    x_m, y_m = _point(target, room, snapshot)
    node, support = snapshot.object(object_id), snapshot.get(target)
    on = isinstance(support, ObjectNode)
    z_m = node.size_m[2] / 2 + (support.size_m[2] if isinstance(support, ObjectNode) else 0.0)
    seen = replace(node, state=ObjectState.PRESENT, last_seen_s=stamp_s)
    edits = [*_loosen(object_id, snapshot), PutNode(seen)]
    edits += _stand(object_id, room, (x_m + (0.0 if on else BESIDE_M), y_m), z_m)
    if on:
        predicate = relation.value
        edits.append(PutEdge(RelationEdge(source=object_id, target=target, predicate=predicate, probability=0.95)))
    return edits


def _into_hand(end: PlanState, snapshot: Snapshot, stamp_s: float) -> list[Edit]:
    held = end.holding or ""
    room = end.robot_room or snapshot.current_room or ""
    node = replace(snapshot.object(held), state=ObjectState.HELD, last_seen_s=stamp_s)
    grip: list[Edge] = [
        RtEdge(source=ROBOT_ID, target=held, T_source_target=_GRIPPER),
        InEdge(source=held, target=room),
    ]
    return [*_loosen(held, snapshot), PutNode(node), *map(PutEdge, grip)]


def _point(node_id: str, room: str, snapshot: Snapshot) -> tuple[float, float]:
    x_m, y_m, _ = (float(value) for value in snapshot.position(node_id, room))
    return x_m, y_m


def _stand(node_id: str, room: str, at: tuple[float, float], z_m: float) -> list[Edit]:
    pose = SE3.from_xyz_yaw(*at, z_m, 0.0)
    edges: list[Edge] = [
        RtEdge(source=room, target=node_id, T_source_target=pose),
        InEdge(source=node_id, target=room),
    ]
    return [PutEdge(edge) for edge in edges]


def _loosen(node_id: str, snapshot: Snapshot) -> list[Edit]:
    own = [edge for edge in snapshot.edges_from(node_id) if isinstance(edge, InEdge | RelationEdge)]
    return [RemoveEdge(edge.key) for edge in (*snapshot.edges_to(node_id, EdgeType.RT), *own)]
