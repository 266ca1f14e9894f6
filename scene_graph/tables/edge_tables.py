"""All edges by key, in one table per type; immutable, shared between revisions except for the types that change."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from scene_graph.edges import Edge, EdgeKey, EdgeType

_Table = Mapping[EdgeKey, Edge]


class EdgeTables(Mapping[EdgeKey, Edge]):
    """A read-only mapping. A pose update copies the pointers of the rt edges, not those of all relations too."""

    __slots__ = ("_tables",)

    def __init__(self, tables: Mapping[EdgeType, _Table] | None = None) -> None:
        self._tables = tables or {kind: {} for kind in EdgeType}

    def __getitem__(self, key: EdgeKey) -> Edge:
        return self._tables[key.type][key]

    def __contains__(self, key: object) -> bool:
        return isinstance(key, EdgeKey) and key in self._tables[key.type]

    def __iter__(self) -> Iterator[EdgeKey]:
        for table in self._tables.values():
            yield from table

    def __len__(self) -> int:
        return sum(map(len, self._tables.values()))

    def evolved(self, put: Mapping[EdgeKey, Edge], removed: Iterable[EdgeKey]) -> EdgeTables:
        """After writing some edges and removing others."""
        copies: dict[EdgeType, dict[EdgeKey, Edge]] = {}
        for key in removed:
            self._copy(copies, key.type).pop(key)
        for key, edge in put.items():
            self._copy(copies, key.type)[key] = edge
        return EdgeTables({**self._tables, **copies}) if copies else self

    def _copy(self, copies: dict[EdgeType, dict[EdgeKey, Edge]], kind: EdgeType) -> dict[EdgeKey, Edge]:
        if kind not in copies:
            copies[kind] = dict(self._tables[kind])
        return copies[kind]
