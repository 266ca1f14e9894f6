"""What always holds in the graph (design, section 3); checked in full, or only where a transaction touched it.

Every invariant belongs to one node, one edge or one cycle of frames, and can only be broken by a transaction that
touches that node, an end of that edge, or an edge of that cycle. That is why the cheap check suffices.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from scene_graph.checks.draft import Draft
from scene_graph.checks.edge_checks import edge_violations
from scene_graph.checks.node_checks import grip_violations, held_violations, structure_violations, value_violations
from scene_graph.edges import EdgeKey, EdgeType
from scene_graph.errors import Violation, ViolationKind
from scene_graph.nodes import ROBOT_ID, ROOT_ID, ObjectNode, RobotNode, RootNode, node_type
from scene_graph.snapshot import Snapshot


def check(snapshot: Snapshot) -> tuple[Violation, ...]:
    """All violations in a snapshot, sorted; empty when it is sound."""
    nodes = dict(snapshot.nodes)
    found = [violation for node_id, node in nodes.items() for violation in value_violations(node_id, node)]
    found.extend(_structure(snapshot, nodes, snapshot.edges))
    return tuple(sorted(found))


def check_draft(draft: Draft, after: Snapshot) -> tuple[Violation, ...]:
    """All violations that the edits bring into a sound snapshot, sorted; the same ones that ``check`` would find."""
    found = [violation for node_id, node in draft.put_nodes.items() for violation in value_violations(node_id, node)]
    found.extend(_structure(after, _touched_nodes(draft), _touched_edges(draft, after)))
    return tuple(sorted((*draft.violations, *found)))


def _touched_nodes(draft: Draft) -> Iterable[str]:
    ends = (end for key in (*draft.put_edges, *draft.removed_edges) for end in (key.source, key.target))
    return dict.fromkeys((*draft.put_nodes, *ends))


def _touched_edges(draft: Draft, after: Snapshot) -> Iterable[EdgeKey]:
    """Written edges, and those that look at what changed in the nodes at their ends: type, and room of a door."""
    touched = dict.fromkeys(draft.put_edges)
    for node_id, node in draft.put_nodes.items():
        before = draft.base.get(node_id)
        if before is not None and node_type(before) is not node_type(node):
            touched.update(dict.fromkeys(edge.key for edge in after.edges_at(node_id)))
        for edge in (*after.edges_from(node_id, EdgeType.MATCH), *after.edges_to(node_id, EdgeType.MATCH)):
            touched[edge.key] = None
    return touched


def _structure(snapshot: Snapshot, nodes: Iterable[str], edges: Iterable[EdgeKey]) -> Iterator[Violation]:
    present = dict.fromkeys(node_id for node_id in nodes if node_id in snapshot)
    yield from _presence(snapshot)
    for node_id in present:
        yield from structure_violations(snapshot, node_id)
    for key in edges:
        yield from edge_violations(snapshot, key)
    yield from _cycles(snapshot, [key.target for key in edges if key.type is EdgeType.RT])
    yield from _grip(snapshot, present)


def _presence(snapshot: Snapshot) -> Iterator[Violation]:
    if not isinstance(snapshot.get(ROOT_ID), RootNode):
        yield Violation(kind=ViolationKind.ROOT_MISSING, subject=ROOT_ID, message="there must always be a root")
    if not isinstance(snapshot.get(ROBOT_ID), RobotNode):
        yield Violation(kind=ViolationKind.ROBOT_MISSING, subject=ROBOT_ID, message="there must always be a robot")


def _grip(snapshot: Snapshot, touched: dict[str, None]) -> Iterator[Violation]:
    suspects = dict(touched)
    robot = snapshot.robot
    if ROBOT_ID in touched and robot is not None:
        yield from grip_violations(snapshot)
        suspects.update(dict.fromkeys(snapshot.children(ROBOT_ID)))
        suspects.update({robot.holding: None} if robot.holding is not None else {})
    for node_id in suspects:
        node = snapshot.get(node_id)
        if isinstance(node, ObjectNode):
            yield from held_violations(snapshot, node)


def _cycles(snapshot: Snapshot, starts: Iterable[str]) -> Iterator[Violation]:
    """Every cycle of rt edges above the starting frames, once, named from its first frame in alphabetical order.

    Frames with two parents end the walk: they are violations of their own.
    """
    settled: set[str] = set()
    for start in starts:
        walk: dict[str, None] = {}
        frame = start
        while frame not in settled and frame not in walk:
            walk[frame] = None
            parents = snapshot.edges_to(frame, EdgeType.RT)
            if len(parents) != 1:
                break
            frame = parents[0].source
        else:
            if frame in walk:
                yield _cycle_violation(list(walk)[list(walk).index(frame) :])
        settled.update(walk)


def _cycle_violation(cycle: list[str]) -> Violation:
    first = cycle.index(min(cycle))
    ordered = [*cycle[first:], *cycle[:first]]
    message = f"frames hang from each other in a circle: {' < '.join([*ordered, ordered[0]])}"
    return Violation(kind=ViolationKind.FRAME_CYCLE, subject=ordered[0], message=message)
