"""What is in a room."""

from __future__ import annotations

from scene_graph.edges import EdgeType
from scene_graph.identifiers import natural_key
from scene_graph.nodes import ObjectNode, PersonNode
from scene_graph.snapshot import Snapshot


def in_room(snapshot: Snapshot, room: str) -> tuple[str, ...]:
    """Objects and persons in a room, in natural order."""
    found = {edge.source for edge in snapshot.edges_to(room, EdgeType.IN)}
    hung = list(snapshot.children(room))
    for frame in hung:  # grows while it is walked
        hung += snapshot.children(frame)
    found.update(frame for frame in hung if snapshot.room_of(frame) == room)
    here = (node_id for node_id in found if isinstance(snapshot.get(node_id), ObjectNode | PersonNode))
    return tuple(sorted(here, key=natural_key))
