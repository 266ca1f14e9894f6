"""What edits of working memory need of long-term memory before they can be made."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import TypeGuard

from majordomo.scene_graph.edges import Edge, EdgeKey, EdgeType, RtEdge
from majordomo.scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge, RemoveNode
from majordomo.scene_graph.long_term.long_term_store import LongTermStore
from majordomo.scene_graph.nodes import ObjectNode, PersonNode


@dataclass(frozen=True, kw_only=True)
class Demand:
    """What must happen first.

    Attributes:
        rooms: to be loaded, because something in them is written or pointed at.
        moved: things of rooms that stay stored, which the edits hang from a frame of working memory: what is written
            anew replaces what was stored.
        replaced: new versions of edges that stay stored.
        edits: the others, which are for working memory.
    """

    rooms: tuple[str, ...] = ()
    moved: tuple[str, ...] = ()
    replaced: tuple[Edge, ...] = ()
    edits: tuple[Edit, ...] = ()


def demand_of(store: LongTermStore, edits: tuple[Edit, ...]) -> Demand:
    """What the edits need; nothing, when they touch nothing that is stored."""
    if not any(_touches(store, edit) for edit in edits):
        return Demand(edits=edits)
    moved = _moved(store, edits)
    needed = (node_id for edit in edits for node_id in _needed(store, edit, moved) if node_id not in moved)
    homes = (store.room_of(node_id) for node_id in needed)
    rooms = tuple(dict.fromkeys(home for home in homes if home is not None))
    come_along = [node_id for node_id in moved if store.room_of(node_id) in rooms]
    replaced = [_stays_stored(store, edit, moved, rooms) for edit in edits]
    return Demand(
        rooms=rooms,
        moved=tuple(node_id for node_id in moved if node_id not in come_along),
        replaced=tuple(edge for edge in replaced if edge is not None),
        edits=(
            *(RemoveEdge(key) for node_id in come_along for key in _old_place(store, node_id, edits)),
            *(edit for edit, edge in zip(edits, replaced, strict=True) if edge is None),
        ),
    )


def _touches(store: LongTermStore, edit: Edit) -> bool:
    match edit:
        case PutNode(node):
            return node.id in store
        case RemoveNode(node_id):
            return node_id in store
        case PutEdge(edge):
            return edge.key.source in store or edge.key.target in store
        case RemoveEdge(key):
            return key.source in store or key.target in store


def _needed(store: LongTermStore, edit: Edit, moved: Collection[str]) -> tuple[str, ...]:
    """The nodes that must be in working memory for an edit to be made there."""
    match edit:
        case PutNode(node):
            return (node.id,)
        case RemoveNode(node_id):
            return (node_id,)
        case PutEdge(edge):
            return () if _is_kept(store, edge, moved) else (edge.key.source, edge.key.target)
        case RemoveEdge(key):
            return (key.source, key.target)


def _moved(store: LongTermStore, edits: tuple[Edit, ...]) -> tuple[str, ...]:
    """Stored things that the edits write and hang from another frame than before."""
    hung = {
        edit.edge.target
        for edit in edits
        if isinstance(edit, PutEdge) and isinstance(edit.edge, RtEdge) and store.edge(edit.edge.key) is None
    }
    put = (edit.node for edit in edits if isinstance(edit, PutNode))
    things = (node.id for node in put if isinstance(node, ObjectNode | PersonNode))
    return tuple(dict.fromkeys(node_id for node_id in things if node_id in store and node_id in hung))


def _old_place(store: LongTermStore, node_id: str, edits: tuple[Edit, ...]) -> list[EdgeKey]:
    """Edges that say where a thing was, and that the edits replace by others without removing them."""
    dealt_with = {edit.key if isinstance(edit, RemoveEdge) else edit.edge.key for edit in edits if _is_of_edge(edit)}
    new = {edit.edge.key.type for edit in edits if isinstance(edit, PutEdge) and _places(edit.edge.key, node_id)}
    return [
        key for key in store.keys_at(node_id) if _places(key, node_id) and key.type in new and key not in dealt_with
    ]


def _places(key: EdgeKey, node_id: str) -> bool:
    return (key.type is EdgeType.RT and key.target == node_id) or (key.type is EdgeType.IN and key.source == node_id)


def _is_of_edge(edit: Edit) -> TypeGuard[PutEdge | RemoveEdge]:
    return isinstance(edit, PutEdge | RemoveEdge)


def _is_kept(store: LongTermStore, edge: Edge, moved: Collection[str]) -> bool:
    """Whether an edge is stored already, and not one of a thing that moves out."""
    return store.edge(edge.key) is not None and edge.key.source not in moved and edge.key.target not in moved


def _stays_stored(store: LongTermStore, edit: Edit, moved: Collection[str], rooms: Collection[str]) -> Edge | None:
    """The edge of an edit that only writes anew what goes on being stored."""
    if not isinstance(edit, PutEdge) or not _is_kept(store, edit.edge, moved):
        return None
    homes = (store.room_of(edit.edge.key.source), store.room_of(edit.edge.key.target))
    return edit.edge if any(home is not None and home not in rooms for home in homes) else None
