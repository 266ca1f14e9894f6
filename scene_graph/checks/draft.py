"""The net effect of a list of edits on a snapshot, before anyone has checked it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import assert_never

from scene_graph.edges import Edge, EdgeKey
from scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge, RemoveNode
from scene_graph.errors import Violation, ViolationKind, edge_name
from scene_graph.nodes import Node
from scene_graph.snapshot import Snapshot


class Draft:
    """Edits applied to ``base`` one by one.

    Attributes:
        put_nodes, put_edges: what is written, in its last version.
        removed_nodes, removed_edges: what was in ``base`` and is gone, as insertion-ordered sets.
        violations: removals of what never was there.
    """

    def __init__(self, base: Snapshot, edits: Iterable[Edit]) -> None:
        self.base = base
        self.put_nodes: dict[str, Node] = {}
        self.removed_nodes: dict[str, None] = {}
        self.put_edges: dict[EdgeKey, Edge] = {}
        self.removed_edges: dict[EdgeKey, None] = {}
        self.violations: list[Violation] = []
        for edit in edits:
            self._apply(edit)

    def result(self, *, revision: int, stamp_s: float) -> Snapshot:
        """The snapshot after the edits, unchecked."""
        return self.base.evolve(
            put_nodes=self.put_nodes,
            removed_nodes=self.removed_nodes,
            put_edges=self.put_edges,
            removed_edges=self.removed_edges,
            revision=revision,
            stamp_s=stamp_s,
        )

    @property
    def is_empty(self) -> bool:
        """Whether nothing is written, removed or wrong."""
        return not (self.put_nodes or self.removed_nodes or self.put_edges or self.removed_edges or self.violations)

    def _apply(self, edit: Edit) -> None:
        match edit:
            case PutNode(node):
                self.removed_nodes.pop(node.id, None)
                self.put_nodes[node.id] = node
            case RemoveNode(node_id):
                self._remove_node(node_id)
            case PutEdge(edge):
                self.removed_edges.pop(edge.key, None)
                self.put_edges[edge.key] = edge
            case RemoveEdge(key):
                self._remove_edge(key)
            case _:
                assert_never(edit)

    def _remove_node(self, node_id: str) -> None:
        put = self.put_nodes.pop(node_id, None)
        if node_id in self.base:
            self.removed_nodes[node_id] = None
        elif put is None:
            self._report_unknown(node_id, f"cannot remove node {node_id!r}: there is none")
        for key in [key for key in self.put_edges if node_id in (key.source, key.target)]:
            del self.put_edges[key]
        self.removed_edges.update(dict.fromkeys(edge.key for edge in self.base.edges_at(node_id)))

    def _remove_edge(self, key: EdgeKey) -> None:
        put = self.put_edges.pop(key, None)
        if key in self.base.edges:
            self.removed_edges[key] = None
        elif put is None:
            self._report_unknown(edge_name(key), f"cannot remove edge {edge_name(key)}: there is none")

    def _report_unknown(self, subject: str, message: str) -> None:
        self.violations.append(Violation(kind=ViolationKind.UNKNOWN_ELEMENT, subject=subject, message=message))
