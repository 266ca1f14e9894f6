"""Everything known as one snapshot: working memory and the rooms it does not hold."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from scene_graph.checks.draft import Draft
from scene_graph.edges import Edge, EdgeKey
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.nodes import Node
from scene_graph.snapshot import Snapshot


@dataclass(kw_only=True)
class _Changes:
    """The net effect of the edits since the view was last brought up to date."""

    put_nodes: dict[str, Node] = field(default_factory=dict)
    removed_nodes: dict[str, None] = field(default_factory=dict)
    put_edges: dict[EdgeKey, Edge] = field(default_factory=dict)
    removed_edges: dict[EdgeKey, None] = field(default_factory=dict)

    def add(self, draft: Draft) -> None:
        for node_id in draft.removed_nodes:
            self.put_nodes.pop(node_id, None)
            self.removed_nodes[node_id] = None
        for key in draft.removed_edges:
            self.remove_edge(key)
        for node_id, node in draft.put_nodes.items():
            self.removed_nodes.pop(node_id, None)
            self.put_nodes[node_id] = node
        for edge in draft.put_edges.values():
            self.put_edge(edge)

    def put_edge(self, edge: Edge) -> None:
        self.removed_edges.pop(edge.key, None)
        self.put_edges[edge.key] = edge

    def remove_edge(self, key: EdgeKey) -> None:
        self.put_edges.pop(key, None)
        self.removed_edges[key] = None


class Building:
    """The whole building, brought up to date only when somebody asks for it.

    A room that moves between working memory and long-term memory changes nothing here. What edits change is noted as
    they are made, which costs no more than the edits themselves, and folded in at the next question: that copies the
    tables (pointers only) that the edits have written to.
    """

    def __init__(self) -> None:
        self._view: Snapshot | None = None
        self._changes = _Changes()

    def note(self, draft: Draft, *, replaced: Iterable[Edge] = (), dropped: Iterable[EdgeKey] = ()) -> None:
        """Take in an edit of working memory, and what it changed in stored rooms: edges written anew and dropped."""
        if self._view is None:
            return
        for key in dropped:
            self._changes.remove_edge(key)
        self._changes.add(draft)
        for edge in replaced:
            self._changes.put_edge(edge)

    def view(self, working: Snapshot, store: LongTermStore) -> Snapshot:
        """Everything known, at the revision of working memory."""
        if self._view is None:
            self._view = Snapshot.of(
                [*working.nodes.values(), *store.nodes()],
                [*working.edges.values(), *store.edges()],
                revision=working.revision,
                stamp_s=working.stamp_s,
            )
        elif self._view.revision != working.revision:
            changes, self._changes = self._changes, _Changes()
            self._view = self._view.evolve(
                put_nodes=changes.put_nodes,
                removed_nodes=changes.removed_nodes,
                put_edges=changes.put_edges,
                removed_edges=changes.removed_edges,
                revision=working.revision,
                stamp_s=working.stamp_s,
            )
        return self._view
