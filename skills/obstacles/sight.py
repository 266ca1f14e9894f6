"""What would be hidden from where: by the corners of the room, and by what stands or lies in between."""

from __future__ import annotations

from collections.abc import Collection

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.geometry import Points, inside_polygon
from skills.obstacles.local_map import footprint
from skills.obstacles.walls import whole_room

_ALONG = np.linspace(0.1, 0.92, 14)
"""Shares of a line of sight that are looked at; what is nearer to its end is what one looks at."""


def hidden_share(
    snapshot: Snapshot,
    frame: str,
    places: Points,
    targets: Points,
    *,
    camera_height_m: float,
    spared: Collection[str] = (),
) -> NDArray[np.float64]:
    """Share of ``targets`` (M, 3) that a camera over each of ``places`` (N, 2) cannot see, (N,), as far as the graph
    knows. Both in the room ``frame``; ``spared`` things hide nothing.
    """
    start, end = places[:, None, None, :], targets[None, :, None, :2]
    along = _ALONG[None, None, :, None]
    points = start + along * (end - start)
    shape = points.shape[:3]
    line_m = camera_height_m + _ALONG * (targets[:, 2, None] - camera_height_m)
    hidden = np.zeros(shape, dtype=bool)
    flat = points.reshape(-1, 2)
    room = whole_room(snapshot, frame)
    if room is not None:
        hidden |= ~inside_polygon(room.polygon_m, flat).reshape(shape)
    for node in snapshot.of_type(ObjectNode):
        if node.id in spared or node.state is not ObjectState.PRESENT or snapshot.room_of(node.id) != frame:
            continue
        top_m = snapshot.position(node.id, frame)[2] + node.size_m[2] / 2.0
        if (line_m < top_m).any():
            hidden |= footprint(snapshot, node, frame).contains(flat).reshape(shape) & (line_m < top_m)
    return np.asarray(hidden.any(axis=2).mean(axis=1))
