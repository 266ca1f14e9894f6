"""What edits of working memory need of long-term memory before they can be made."""

from __future__ import annotations

from dataclasses import dataclass

from scene_graph.edges import Edge
from scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge, RemoveNode
from scene_graph.long_term.long_term_store import LongTermStore


@dataclass(frozen=True, kw_only=True)
class Demand:
    """What must happen first.

    Attributes:
        rooms: to be loaded, because something in them is written, removed or pointed at.
        replaced: new versions of edges that stay stored, such as the place of an unloaded room.
        edits: the others, which are for working memory.
    """

    rooms: tuple[str, ...] = ()
    replaced: tuple[Edge, ...] = ()
    edits: tuple[Edit, ...] = ()


def demand_of(store: LongTermStore, edits: tuple[Edit, ...]) -> Demand:
    """What the edits need; nothing, when they touch nothing that is stored."""
    homes = [store.room_of(node_id) for edit in edits for node_id in _needed(store, edit)]
    rooms = tuple(dict.fromkeys(home for home in homes if home is not None))
    kept = [_stays_stored(store, edit, rooms) for edit in edits]
    return Demand(
        rooms=rooms,
        replaced=tuple(edge for edge in kept if edge is not None),
        edits=tuple(edit for edit, edge in zip(edits, kept, strict=True) if edge is None),
    )


def _needed(store: LongTermStore, edit: Edit) -> tuple[str, ...]:
    """The nodes that must be in working memory for an edit to be made there."""
    match edit:
        case PutNode(node):
            return (node.id,)
        case RemoveNode(node_id):
            return (node_id,)
        case PutEdge(edge):
            return () if store.edge(edge.key) is not None else (edge.key.source, edge.key.target)
        case RemoveEdge(key):
            return (key.source, key.target)


def _stays_stored(store: LongTermStore, edit: Edit, rooms: tuple[str, ...]) -> Edge | None:
    """The edge of an edit that only writes anew what goes on being stored."""
    if not isinstance(edit, PutEdge) or store.edge(edit.edge.key) is None:
        return None
    homes = (store.room_of(edit.edge.key.source), store.room_of(edit.edge.key.target))
    return edit.edge if any(home is not None and home not in rooms for home in homes) else None
