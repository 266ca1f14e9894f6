"""Differences between snapshots: ``apply(diff(a, b), a) == b``."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TypeVar

from scene_graph.edges import Edge, EdgeKey
from scene_graph.errors import DeltaMismatch
from scene_graph.nodes import Node
from scene_graph.snapshot import Snapshot

K = TypeVar("K")
V = TypeVar("V")


@dataclass(frozen=True, kw_only=True)
class Delta:
    """What one revision writes and removes relative to another. Edges that go with their node are listed too.

    ``loaded`` and ``unloaded``: rooms that came from long-term memory or went there; what is written and removed then
    includes all of them, though the building has not changed by it.
    """

    base_revision: int
    revision: int
    stamp_s: float
    agent: str = ""
    put_nodes: tuple[Node, ...] = ()
    removed_nodes: tuple[str, ...] = ()
    put_edges: tuple[Edge, ...] = ()
    removed_edges: tuple[EdgeKey, ...] = ()
    loaded: tuple[str, ...] = ()
    unloaded: tuple[str, ...] = ()


def diff(a: Snapshot, b: Snapshot) -> Delta:
    """The delta that leads from ``a`` to ``b``; unchanged elements that both share are recognized by identity."""
    return Delta(
        base_revision=a.revision,
        revision=b.revision,
        stamp_s=b.stamp_s,
        put_nodes=_written(a.nodes, b.nodes),
        removed_nodes=tuple(node_id for node_id in a.nodes if node_id not in b.nodes),
        put_edges=_written(a.edges, b.edges),
        removed_edges=tuple(key for key in a.edges if key not in b.edges),
    )


def apply(delta: Delta, a: Snapshot) -> Snapshot:
    """The snapshot after the delta. Unchecked: deltas come from snapshots that were.

    Raises:
        DeltaMismatch: the delta starts from another revision.
    """
    if delta.base_revision != a.revision:
        raise DeltaMismatch(base_revision=delta.base_revision, revision=a.revision)
    return a.evolve(
        put_nodes={node.id: node for node in delta.put_nodes},
        removed_nodes=delta.removed_nodes,
        put_edges={edge.key: edge for edge in delta.put_edges},
        removed_edges=delta.removed_edges,
        revision=delta.revision,
        stamp_s=delta.stamp_s,
    )


def _written(before: Mapping[K, V], after: Mapping[K, V]) -> tuple[V, ...]:
    return tuple(new for key, new in after.items() if (old := before.get(key)) is not new and old != new)
