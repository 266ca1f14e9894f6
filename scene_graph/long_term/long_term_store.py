"""The rooms that working memory does not hold, each with everything in it."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator

from scene_graph.edges import Edge, EdgeKey
from scene_graph.errors import RoomNotStored
from scene_graph.long_term.room_parts import RoomParts, unfinished
from scene_graph.nodes import Node


class LongTermStore:
    """Immutable nodes and edges by room; knows of every identifier in which room it is.

    An edge may only be in working memory when both its ends are. So an edge that leaves a stored room is kept here,
    with the room, until both ends are back: a door of a loaded room lacks its ``match`` and its ``connects`` edge to
    the stored side, while its own ``rooms`` go on to say where it leads.
    """

    def __init__(self, rooms: Iterable[RoomParts] = ()) -> None:
        self._nodes: dict[str, dict[str, Node]] = {}
        self._home: dict[str, str] = {}
        self._edges: dict[EdgeKey, Edge] = {}
        self._at: dict[str, dict[EdgeKey, None]] = {}
        self._unfinished: dict[str, None] = {}
        for parts in rooms:
            self.store(parts)

    def __contains__(self, node_id: object) -> bool:
        return node_id in self._home

    def __len__(self) -> int:
        return len(self._home)

    @property
    def rooms(self) -> Collection[str]:
        """Identifiers of the stored rooms, in the order in which they were stored."""
        return self._nodes.keys()

    @property
    def unfinished(self) -> tuple[str, ...]:
        """Stored rooms in which something is left to explore, in the order in which they were stored."""
        return tuple(self._unfinished)

    def room_of(self, node_id: str) -> str | None:
        """The stored room that holds a node, if any."""
        return self._home.get(node_id)

    def get(self, node_id: str) -> Node | None:
        """The stored node, if any."""
        room = self._home.get(node_id)
        return self._nodes[room][node_id] if room is not None else None

    def edge(self, key: EdgeKey) -> Edge | None:
        """The stored edge, if any."""
        return self._edges.get(key)

    def keys_at(self, node_id: str) -> tuple[EdgeKey, ...]:
        """Keys of all stored edges that leave or enter a node."""
        return tuple(self._at.get(node_id, ()))

    def nodes(self) -> Iterator[Node]:
        """All stored nodes, room by room."""
        for members in self._nodes.values():
            yield from members.values()

    def edges(self) -> Iterator[Edge]:
        """All stored edges."""
        return iter(self._edges.values())

    def store(self, parts: RoomParts) -> None:
        """Keep a room that leaves working memory."""
        self._nodes[parts.room_id] = {node.id: node for node in parts.nodes}
        self._home.update(dict.fromkeys(self._nodes[parts.room_id], parts.room_id))
        for edge in parts.edges:
            self._put(edge)
        if any(map(unfinished, parts.nodes)):
            self._unfinished[parts.room_id] = None

    def peek(self, rooms: Collection[str]) -> tuple[list[Node], list[Edge]]:
        """What ``load`` would bring back if all these rooms came together.

        Raises:
            RoomNotStored: one of them is not here.
        """
        self._require(rooms)
        nodes = [node for room in rooms for node in self._nodes[room].values()]
        keys = dict.fromkeys(key for node in nodes for key in self._at.get(node.id, ()))
        return nodes, [self._edges[key] for key in keys if self._complete_with(key, rooms)]

    def load(self, *rooms: str) -> tuple[list[Node], list[Edge]]:
        """Take rooms out: their nodes, and the edges whose two ends are then outside.

        Raises:
            RoomNotStored: one of them is not here.
        """
        nodes, edges = self.peek(rooms)
        for room in rooms:
            self._unfinished.pop(room, None)
            for node_id in self._nodes.pop(room):
                del self._home[node_id]
        for edge in edges:
            self._drop(edge.key)
        return nodes, edges

    def replace(self, edge: Edge) -> None:
        """Write a stored edge anew, in its place."""
        self._edges[edge.key] = edge

    def forget(self, node_id: str) -> tuple[EdgeKey, ...]:
        """Forget all stored edges at a node that is no more, wherever it was; their keys."""
        keys = self.keys_at(node_id)
        for key in keys:
            self._drop(key)
        return keys

    def _require(self, rooms: Iterable[str]) -> None:
        for room in rooms:
            if room not in self._nodes:
                raise RoomNotStored(room, self._nodes)

    def _complete_with(self, key: EdgeKey, rooms: Collection[str]) -> bool:
        """Whether neither end of an edge would still be stored if the rooms were not."""
        return all(home is None or home in rooms for home in map(self._home.get, (key.source, key.target)))

    def _put(self, edge: Edge) -> None:
        self._edges[edge.key] = edge
        for end in (edge.key.source, edge.key.target):
            self._at.setdefault(end, {})[edge.key] = None

    def _drop(self, key: EdgeKey) -> None:
        del self._edges[key]
        for end in dict.fromkeys((key.source, key.target)):
            del self._at[end][key]
            if not self._at[end]:
                del self._at[end]
