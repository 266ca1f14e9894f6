"""Which doors hang from a wall, and where."""

from __future__ import annotations

from scene_graph.nodes import DoorNode
from scene_graph.snapshot import Snapshot


def doors_in(snapshot: Snapshot, wall_id: str) -> list[tuple[DoorNode, float]]:
    """The doors of a wall, provisional ones included, each with the station of its center from the wall's middle in
    meters; none when the wall is not in the graph.
    """
    found: list[tuple[DoorNode, float]] = []
    for child in snapshot.children(wall_id) if wall_id in snapshot else ():
        door, edge = snapshot.get(child), snapshot.parent(child)
        if isinstance(door, DoorNode) and edge is not None:
            found.append((door, float(edge.T_source_target.x_m)))
    return found
