"""Identifiers of the nodes of each type in natural order; immutable, and shared between revisions where unchanged."""

from __future__ import annotations

from bisect import bisect_left, insort
from collections.abc import Iterable, Mapping

from scene_graph.identifiers import natural_key
from scene_graph.nodes import NodeType

_BULK = 16
"""Changes above which one sort costs less than inserting each; the outcome is the same."""


class Catalog:
    """Sorted identifiers by node type."""

    __slots__ = ("_ids",)

    def __init__(self, ids: Mapping[NodeType, tuple[str, ...]] | None = None) -> None:
        self._ids = ids or {}

    def ids(self, kind: NodeType) -> tuple[str, ...]:
        """Identifiers of the nodes of a type, in natural order."""
        return self._ids.get(kind, ())

    def updated(self, added: Iterable[tuple[NodeType, str]], removed: Iterable[tuple[NodeType, str]]) -> Catalog:
        """After nodes came and went; inserting a few costs no sort."""
        changes: dict[NodeType, tuple[list[str], list[str]]] = {}
        for kind, node_id in added:
            changes.setdefault(kind, ([], []))[0].append(node_id)
        for kind, node_id in removed:
            changes.setdefault(kind, ([], []))[1].append(node_id)
        if not changes:
            return self
        return Catalog({**self._ids, **{kind: _changed(self.ids(kind), *change) for kind, change in changes.items()}})


def _changed(ids: tuple[str, ...], added: list[str], removed: list[str]) -> tuple[str, ...]:
    if len(added) + len(removed) > _BULK:
        return tuple(sorted(set(ids).difference(removed).union(added), key=_total_key))
    changed = list(ids)
    for node_id in removed:
        del changed[bisect_left(changed, _total_key(node_id), key=_total_key)]
    for node_id in added:
        insort(changed, node_id, key=_total_key)
    return tuple(changed)


def _total_key(node_id: str) -> tuple[object, str]:
    """Breaks the ties of natural order (``a_1`` and ``a_01``), so that removal finds the very identifier."""
    return (natural_key(node_id), node_id)
