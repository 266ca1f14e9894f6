"""A room as the graph has it, for what looks at its walls."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from perception.geometry.polygon import distance_to_outline, inside
from perception.geometry.walls import Walls
from scene_graph.identifiers import wall_id_of
from scene_graph.nodes import Point2, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class RoomModel:
    """What the scan should show in a room: its wall faces and corners, room frame."""

    room_id: str
    polygon: Array
    walls: Walls

    def contains(self, point: Array) -> bool:
        """Whether (2,) ``point`` lies inside the outline."""
        return inside(self.polygon, point)

    def depth_m(self, point: Array) -> float:
        """Distance of (2,) ``point`` from the outline, positive inside."""
        distance = distance_to_outline(self.polygon, point)
        return distance if inside(self.polygon, point) else -distance


def room_model(snapshot: Snapshot, room_id: str | None) -> RoomModel | None:
    """The model of a room that stands in the graph; ``None`` for a room still being measured or none at all.

    Of a partial room only the walls that are in the graph are used.
    """
    room = snapshot.get(room_id) if room_id is not None else None
    if not isinstance(room, RoomNode) or room.status is RoomStatus.TEMPORARY or len(room.polygon_m) < 3:
        return None
    known = tuple(wall_id_of(room.id, k) in snapshot for k in range(len(room.polygon_m)))
    return _model_of(room.id, room.polygon_m, known)


@lru_cache(maxsize=256)
def _model_of(room_id: str, polygon_m: tuple[Point2, ...], known: tuple[bool, ...]) -> RoomModel:
    polygon = np.array(polygon_m)
    polygon.setflags(write=False)
    return RoomModel(room_id=room_id, polygon=polygon, walls=Walls.of_polygon(polygon, np.array(known)))
