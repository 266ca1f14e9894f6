"""Which edges leave and enter a node; immutable, and shared between revisions except for what changed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from scene_graph.edges import EdgeKey, EdgeType

_Table = Mapping[str, tuple[EdgeKey, ...]]
_Tables = Mapping[EdgeType, _Table]
_End = Callable[[EdgeKey], str]


class Adjacency:
    """Edge keys by type and end. Keys stand in the order in which their edges were first put."""

    __slots__ = ("_incoming", "_outgoing")

    def __init__(self, outgoing: _Tables | None = None, incoming: _Tables | None = None) -> None:
        self._outgoing = outgoing or {kind: {} for kind in EdgeType}
        self._incoming = incoming or {kind: {} for kind in EdgeType}

    def outgoing(self, node_id: str, kind: EdgeType) -> tuple[EdgeKey, ...]:
        """Keys of the edges of this type whose source is the node."""
        return self._outgoing[kind].get(node_id, ())

    def incoming(self, node_id: str, kind: EdgeType) -> tuple[EdgeKey, ...]:
        """Keys of the edges of this type whose target is the node."""
        return self._incoming[kind].get(node_id, ())

    def of_type(self, kind: EdgeType) -> tuple[EdgeKey, ...]:
        """Keys of all edges of a type, grouped by source."""
        return tuple(key for keys in self._outgoing[kind].values() for key in keys)

    def touching(self, node_id: str) -> tuple[EdgeKey, ...]:
        """Keys of all edges at the node, loops once."""
        found: dict[EdgeKey, None] = {}
        for kind in EdgeType:
            found.update(dict.fromkeys(self.outgoing(node_id, kind)))
            found.update(dict.fromkeys(self.incoming(node_id, kind)))
        return tuple(found)

    def updated(self, added: Iterable[EdgeKey], removed: Iterable[EdgeKey]) -> Adjacency:
        """After adding and removing edges. Copies only the tables of the types that change."""
        added, removed = tuple(added), tuple(removed)
        if not added and not removed:
            return self
        outgoing = _updated(self._outgoing, added, removed, lambda key: key.source)
        incoming = _updated(self._incoming, added, removed, lambda key: key.target)
        return Adjacency(outgoing, incoming)


def _updated(tables: _Tables, added: Iterable[EdgeKey], removed: Iterable[EdgeKey], end: _End) -> _Tables:
    changes: dict[EdgeType, dict[str, tuple[list[EdgeKey], set[EdgeKey]]]] = {}
    for key in added:
        changes.setdefault(key.type, {}).setdefault(end(key), ([], set()))[0].append(key)
    for key in removed:
        changes.setdefault(key.type, {}).setdefault(end(key), ([], set()))[1].add(key)
    return {kind: _updated_table(table, changes[kind]) if kind in changes else table for kind, table in tables.items()}


def _updated_table(table: _Table, changes: Mapping[str, tuple[list[EdgeKey], set[EdgeKey]]]) -> _Table:
    copy = dict(table)
    for node_id, (added, removed) in changes.items():
        before = copy.get(node_id, ())
        kept = tuple(key for key in before if key not in removed) if removed else before
        keys = (*kept, *added)
        if keys:
            copy[node_id] = keys
        else:
            copy.pop(node_id, None)
    return copy
