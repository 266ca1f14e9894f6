"""The tables behind a snapshot: nodes, edges, their indexes and revisions, copied on write."""

from __future__ import annotations

from collections.abc import Container, Iterable, Mapping
from types import MappingProxyType
from typing import Any, Self

from scene_graph.edges import Edge, EdgeKey, EdgeType
from scene_graph.nodes import Node, NodeType, node_type
from scene_graph.tables.adjacency import Adjacency
from scene_graph.tables.catalog import Catalog
from scene_graph.tables.edge_tables import EdgeTables
from scene_graph.tables.revisions import Revisions

_PASSAGE_NODES = frozenset({NodeType.ROOM, NodeType.WALL, NodeType.DOOR})
_PASSAGE_EDGES = frozenset({EdgeType.MATCH, EdgeType.CONNECTS})
_HUNG = frozenset({NodeType.WALL, NodeType.DOOR})


class Store:
    """Nodes and edges at one revision. Never changes; ``evolve`` shares everything that stayed the same.

    A commit copies the tables (pointers only) that it writes to, and the indexes of those types that gained or lost an
    element; a pose update on 5,000 nodes copies only the table of rt edges.

    Attributes:
        revision, stamp_s: number of the last edit, and the latest time of belief in seconds.
        elsewhere: identifiers that are known but kept outside of this graph, by long-term memory; none by default.
        passages: what readers computed from rooms, doors and the walls they are in; handed on to the next revision
            until one of these changes.
    """

    __slots__ = (
        "_adjacency",
        "_by_type",
        "_catalog",
        "_edge_revisions",
        "_edges",
        "_node_revisions",
        "_nodes",
        "elsewhere",
        "passages",
        "revision",
        "stamp_s",
    )

    def __init__(self) -> None:
        """Empty, at revision 0; ``of`` makes one with content."""
        self.revision = 0
        self.stamp_s = 0.0
        self.elsewhere: Container[str] = ()
        self.passages: dict[str, Any] = {}
        self._nodes: dict[str, Node] = {}
        self._edges = EdgeTables()
        self._adjacency = Adjacency()
        self._catalog = Catalog()
        self._node_revisions: Revisions[str] = Revisions()
        self._edge_revisions: Revisions[EdgeKey] = Revisions()
        self._by_type: dict[NodeType, tuple[Node, ...]] = {}

    @classmethod
    def of(cls, nodes: Iterable[Node], edges: Iterable[Edge] = (), *, revision: int = 0, stamp_s: float = 0.0) -> Self:
        """From its parts, unchecked; ``invariants.check`` tells what is wrong with it."""
        put_nodes = {node.id: node for node in nodes}
        put_edges = {edge.key: edge for edge in edges}
        return cls().evolve(put_nodes=put_nodes, put_edges=put_edges, revision=revision, stamp_s=stamp_s)

    def evolve(
        self,
        *,
        put_nodes: Mapping[str, Node] | None = None,
        removed_nodes: Iterable[str] = (),
        put_edges: Mapping[EdgeKey, Edge] | None = None,
        removed_edges: Iterable[EdgeKey] = (),
        revision: int,
        stamp_s: float,
    ) -> Self:
        """The next revision, unchecked. What is put stays, whatever is removed; nothing cascades."""
        after = type(self)()
        after.revision, after.stamp_s, after.elsewhere = revision, stamp_s, self.elsewhere
        put_nodes, put_edges = put_nodes or {}, put_edges or {}
        removed_edges = [k for k in removed_edges if k in self._edges and k not in put_edges]
        touched = self._evolve_nodes(
            after, put_nodes, [i for i in removed_nodes if i in self._nodes and i not in put_nodes]
        )
        self._evolve_edges(after, put_edges, removed_edges)
        if touched.isdisjoint(_PASSAGE_NODES) and not any(map(self._leads_somewhere, (*put_edges, *removed_edges))):
            after.passages = self.passages
        return after

    def keeping(self, elsewhere: Container[str]) -> Self:
        """The same graph, beside which ``elsewhere`` is known."""
        same = self.evolve(revision=self.revision, stamp_s=self.stamp_s)
        same.elsewhere = elsewhere
        return same

    def _leads_somewhere(self, key: EdgeKey) -> bool:
        """Whether an edge says where a door is or which rooms it joins."""
        if key.type is EdgeType.RT:
            hung = self._nodes.get(key.target)
            return hung is not None and node_type(hung) in _HUNG
        return key.type in _PASSAGE_EDGES

    def _evolve_nodes(self, after: Store, put: Mapping[str, Node], removed: list[str]) -> set[NodeType]:
        before = self._nodes
        gone = dict.fromkeys((node_type(before[i]), i) for i in (*removed, *put) if i in before)
        come = dict.fromkeys((node_type(node), i) for i, node in put.items())
        touched = {kind for kind, _ in (*gone, *come)}
        cached = self._by_type.copy()  # at once, because readers in other threads may be filling it
        after._by_type = {kind: nodes for kind, nodes in cached.items() if kind not in touched}
        after._catalog = self._catalog.updated(
            [entry for entry in come if entry not in gone], [entry for entry in gone if entry not in come]
        )
        after._nodes = _evolved(before, put, removed)
        after._node_revisions = self._node_revisions.updated(put, removed, after.revision)
        return touched

    def _evolve_edges(self, after: Store, put: Mapping[EdgeKey, Edge], removed: list[EdgeKey]) -> None:
        after._adjacency = self._adjacency.updated([key for key in put if key not in self._edges], removed)
        after._edges = self._edges.evolved(put, removed)
        after._edge_revisions = self._edge_revisions.updated(put, removed, after.revision)

    @property
    def nodes(self) -> Mapping[str, Node]:
        """All nodes by identifier (read-only)."""
        return MappingProxyType(self._nodes)

    @property
    def edges(self) -> Mapping[EdgeKey, Edge]:
        """All edges by key (read-only)."""
        return self._edges

    def __eq__(self, other: object) -> bool:
        return (
            isinstance(other, Store)
            and (self.revision, self.stamp_s) == (other.revision, other.stamp_s)
            and self._nodes == other._nodes
            and self._edges == other._edges
        )

    __hash__ = None  # type: ignore[assignment]  # compared, never a key

    def __repr__(self) -> str:
        name = type(self).__name__
        return f"{name}(revision={self.revision}, {len(self._nodes)} nodes, {len(self._edges)} edges)"


def _evolved(table: dict[str, Node], put: Mapping[str, Node], removed: list[str]) -> dict[str, Node]:
    if not put and not removed:
        return table
    copy = dict(table)
    for node_id in removed:
        del copy[node_id]
    copy.update(put)
    return copy
