"""The four edits of which transactions are made. They apply in order; later ones see the effect of earlier ones."""

from __future__ import annotations

from dataclasses import dataclass

from scene_graph.edges import Edge, EdgeKey
from scene_graph.nodes import Node


@dataclass(frozen=True)
class PutNode:
    """Adds a node, or replaces the one of the same identifier; its edges stay."""

    node: Node


@dataclass(frozen=True)
class RemoveNode:
    """Removes a node and its edges.

    Frames that hung from it must be hung elsewhere or removed by the same transaction.
    """

    id: str


@dataclass(frozen=True)
class PutEdge:
    """Adds an edge, or replaces the one of the same key."""

    edge: Edge


@dataclass(frozen=True)
class RemoveEdge:
    """Removes an edge."""

    key: EdgeKey


Edit = PutNode | RemoveNode | PutEdge | RemoveEdge
