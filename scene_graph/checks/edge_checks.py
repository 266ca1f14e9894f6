"""Invariants of single edges: what they may join, and their values."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from scene_graph.edges import Edge, EdgeKey, EdgeType, HasIntentionEdge, MatchEdge, RelationEdge, RtEdge
from scene_graph.errors import Violation, ViolationKind, edge_name
from scene_graph.nodes import DoorNode, NodeType, node_type
from scene_graph.snapshot import Snapshot

_T = NodeType
_RELATIVE_TOLERANCE = 1e-9
_ABSOLUTE_TOLERANCE = 1e-12
"""Rounding that a covariance gathers on its way through transforms."""

# Source types and target types of every edge type; rt is listed by child, because the child decides, and so is what a
# room is in.
PARENT_TYPES: dict[NodeType, frozenset[NodeType]] = {
    _T.ROOM: frozenset({_T.ROOT, _T.ROOM}),
    _T.WALL: frozenset({_T.ROOM}),
    _T.CORNER: frozenset({_T.WALL, _T.ROOM}),
    _T.DOOR: frozenset({_T.WALL, _T.ROOM}),
    _T.OBJECT: frozenset({_T.ROOT, _T.ROOM, _T.ROBOT}),
    _T.PERSON: frozenset({_T.ROOT, _T.ROOM}),
    _T.ROBOT: frozenset({_T.ROOT, _T.ROOM}),
}
END_TYPES: dict[EdgeType, tuple[frozenset[NodeType], frozenset[NodeType]]] = {
    EdgeType.IN: (frozenset({_T.OBJECT, _T.PERSON, _T.ROBOT}), frozenset({_T.ROOM})),
    EdgeType.RELATION: (frozenset({_T.OBJECT, _T.PERSON}), frozenset({_T.OBJECT, _T.PERSON})),
    EdgeType.CONNECTS: (frozenset({_T.DOOR}), frozenset({_T.ROOM})),
    EdgeType.MATCH: (frozenset({_T.DOOR}), frozenset({_T.DOOR})),
    EdgeType.HAS: (frozenset({_T.ROOM, _T.WALL, _T.DOOR, _T.OBJECT, _T.PERSON}), frozenset({_T.AFFORDANCE})),
    EdgeType.HAS_INTENTION: (frozenset({_T.ROBOT}), frozenset(_T)),
}


def edge_violations(snapshot: Snapshot, key: EdgeKey) -> Iterator[Violation]:
    """What is wrong with an edge."""
    edge = snapshot.edges[key]
    if edge.key != key:
        message = f"{edge_name(edge.key)} is stored as {edge_name(key)}"
        yield Violation(kind=ViolationKind.MALFORMED_ID, subject=edge_name(key), message=message)
    missing = [end for end in dict.fromkeys((key.source, key.target)) if end not in snapshot]
    for end in missing:
        message = f"edge {edge_name(key)} leads {'from' if end == key.source else 'to'} nothing: no node {end!r}"
        yield Violation(kind=ViolationKind.DANGLING_EDGE, subject=edge_name(key), message=message)
    if not missing:
        yield from _end_violations(snapshot, key)
    yield from edge_value_violations(key, edge)


def _end_violations(snapshot: Snapshot, key: EdgeKey) -> Iterator[Violation]:
    source, target = snapshot.node(key.source), snapshot.node(key.target)
    if key.type is EdgeType.RT:
        sources, targets = PARENT_TYPES.get(node_type(target), frozenset()), frozenset(PARENT_TYPES)
    elif key.type is EdgeType.IN and node_type(source) is NodeType.ROOM:
        sources, targets = frozenset({NodeType.ROOM}), frozenset({NodeType.REGION})
    else:
        sources, targets = END_TYPES[key.type]
    if node_type(source) not in sources or node_type(target) not in targets:
        message = (
            f"edge {edge_name(key)} leads from {node_type(source)} to {node_type(target)}; "
            f"it may lead from {_listed(sources)} to {_listed(targets)}"
        )
        yield Violation(kind=ViolationKind.WRONG_END_TYPE, subject=edge_name(key), message=message)
    elif isinstance(source, DoorNode) and isinstance(target, DoorNode):
        yield from _match_violations(key, source, target)


def _match_violations(key: EdgeKey, source: DoorNode, target: DoorNode) -> Iterator[Violation]:
    if key.source >= key.target:
        message = f"edge {edge_name(key)} is the wrong way round: a match goes from the lower identifier to the higher"
        yield Violation(kind=ViolationKind.MATCH_ORDER, subject=edge_name(key), message=message)
    if source.rooms[0] == target.rooms[0]:
        message = f"edge {edge_name(key)} joins two doors of {source.rooms[0]}; a match joins doors of two rooms"
        yield Violation(kind=ViolationKind.MATCH_SAME_ROOM, subject=edge_name(key), message=message)


def edge_value_violations(key: EdgeKey, edge: Edge) -> Iterator[Violation]:
    """What is wrong with the numbers of an edge."""
    match edge:
        case RtEdge():
            yield from _covariance_violations(key, edge)
            numbers: tuple[float, ...] = (edge.stamp_s, *edge.wall_shifts_m)
        case RelationEdge():
            if not 0.0 <= edge.probability <= 1.0:
                message = f"probability of {edge_name(key)} is no probability: {edge.probability}"
                yield Violation(kind=ViolationKind.NOT_A_PROBABILITY, subject=edge_name(key), message=message)
            numbers = (edge.stamp_s,)
        case MatchEdge():
            numbers = (edge.walked_std_m, *(edge.walked or ()))
        case HasIntentionEdge():
            numbers = (edge.standoff_m, edge.side_rad or 0.0, edge.proposed_s, edge.priority)
        case _:
            numbers = ()
    if not all(map(math.isfinite, numbers)):
        message = f"edge {edge_name(key)} has numbers that are not finite: {numbers}"
        yield Violation(kind=ViolationKind.NOT_FINITE, subject=edge_name(key), message=message)


def _covariance_violations(key: EdgeKey, edge: RtEdge) -> Iterator[Violation]:
    covariance = edge.covariance
    if not np.isfinite(covariance).all():
        message = f"covariance of {edge_name(key)} is not finite"
        yield Violation(kind=ViolationKind.NOT_FINITE, subject=edge_name(key), message=message)
        return
    tolerance = _RELATIVE_TOLERANCE * float(np.abs(covariance).max()) + _ABSOLUTE_TOLERANCE
    if float(np.abs(covariance - covariance.T).max()) > tolerance:
        message = f"covariance of {edge_name(key)} is not symmetric"
        yield Violation(kind=ViolationKind.COVARIANCE, subject=edge_name(key), message=message)
    elif float(np.linalg.eigvalsh(covariance)[0]) < -tolerance:
        message = f"covariance of {edge_name(key)} has a negative eigenvalue"
        yield Violation(kind=ViolationKind.COVARIANCE, subject=edge_name(key), message=message)


def _listed(kinds: frozenset[NodeType]) -> str:
    return " or ".join(kind for kind in NodeType if kind in kinds) or "nothing"
