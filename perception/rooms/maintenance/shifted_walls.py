"""Moving walls of a standing room in the graph, parallel to themselves, with all that hangs from them.

The room's frame stays where it is, though it may then be a little off the middle of the room: objects, neighbors and
everything else that was measured in it keep their places. Doors keep theirs along the wall and lie on it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.walls import Walls
from perception.localization.doorways import doors_in
from perception.localization.room_model import RoomModel
from perception.rooms.maintenance.adjustment import WallShifts
from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.identifiers import corner_id_of, wall_id_of
from scene_graph.memory import Transaction
from scene_graph.nodes import WallNode
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]

_ACROSS = 1  # a wall's y axis, into the room


@dataclass(frozen=True, kw_only=True)
class ShiftSettings:
    """Which shifts an outline allows, and how well its walls are known."""

    shortest_m: float = 0.05
    """Shortest wall that may be left. Chosen: shorter ones would turn round."""
    least_sine: float = 0.3
    """Of the angle between two walls that meet in a corner: seventeen degrees. Chosen: flatter ones fix no corner."""
    unseen_std_m: float = 0.02
    """Added for a wall that was not seen at all when it was measured, in part for one that was in part. Chosen."""


def wall_stds(snapshot: Snapshot, model: RoomModel, settings: ShiftSettings = ShiftSettings()) -> Array:
    """(K,) standard deviations in meters of the walls' places across themselves, as the graph has them.

    The less of a wall was seen when it was measured, the less sure it is beyond its covariance.
    """
    stds = np.zeros(len(model.polygon))
    for k in range(len(stds)):
        wall_id = wall_id_of(model.room_id, k)
        wall, edge = snapshot.get(wall_id), snapshot.parent(wall_id)
        if wall is not None and edge is not None:
            std_m = np.sqrt(edge.covariance[_ACROSS, _ACROSS])
            stds[k] = np.hypot(std_m, settings.unseen_std_m * (1.0 - wall.confidence))
    return stds


def shifted_outline(polygon: Array, shift_m: Array, settings: ShiftSettings = ShiftSettings()) -> Array | None:
    """(N, 2) ``polygon`` with each wall moved (N,) into the room; ``None`` when a wall would turn round or vanish."""
    walls = Walls.of_polygon(polygon)
    normals, offsets = walls.normal, walls.offset_m + shift_m
    moved = polygon.copy()
    for k in range(len(polygon)):
        both = normals[[k - 1, k]]
        if abs(np.linalg.det(both)) > settings.least_sine:
            moved[k] = np.linalg.solve(both, offsets[[k - 1, k]])
        elif shift_m[k - 1] != 0.0 or shift_m[k] != 0.0:
            return None
    lengths = ((np.roll(moved, -1, axis=0) - moved) * walls.along).sum(axis=1)
    return moved if (lengths > settings.shortest_m).all() else None


def shift_walls(
    tx: Transaction, model: RoomModel, shifts: WallShifts, stamp_s: float, settings: ShiftSettings = ShiftSettings()
) -> bool:
    """Move walls, the corners at their ends and the doors in them; whether the outline allows it."""
    polygon = shifted_outline(model.polygon, shifts.shift_m, settings)
    if polygon is None:
        return False
    snapshot, room_id = tx.snapshot, model.room_id
    touched = [k for k in range(len(polygon)) if not np.array_equal(_ends(polygon, k), _ends(model.polygon, k))]
    tx.put(replace(snapshot.room(room_id), polygon_m=tuple((float(x), float(y)) for x, y in polygon)))
    walls = Walls.of_polygon(polygon)
    for k in touched:
        std_m = float(shifts.std_m[k]) if shifts.shift_m[k] != 0.0 else None
        tx.put(*_wall_elements(snapshot, room_id, walls, k, std_m, stamp_s))
        tx.put(*_door_edges(snapshot, room_id, walls, k, stamp_s))
    return True


def _door_edges(snapshot: Snapshot, room_id: str, walls: Walls, k: int, stamp_s: float) -> Iterator[RtEdge]:
    """The doors of a wall, hung where they were along it from its new middle; new, so that the layout follows."""
    middle_m = float(walls.start[k] @ walls.along[k] + walls.length_m[k] / 2.0)
    for door, _ in doors_in(snapshot, wall_id_of(room_id, k)):
        place = Pose2.from_se3(snapshot.transform(room_id, door.id)).position_m
        edge = snapshot.parent(door.id)
        if edge is not None:
            station_m = float(place @ walls.along[k]) - middle_m
            yield replace(edge, T_source_target=_at_x(edge.T_source_target, station_m), stamp_s=stamp_s)


def _ends(polygon: Array, wall: int) -> Array:
    """(2, 2) corners where a wall begins and ends."""
    return polygon[[wall, (wall + 1) % len(polygon)]]


def _wall_elements(
    snapshot: Snapshot, room_id: str, walls: Walls, k: int, std_m: float | None, stamp_s: float
) -> Iterator[WallNode | RtEdge]:
    """The wall with new ends, and its corner; its covariance stays unless ``std_m``, across it, is given."""
    wall_id, corner_id, length_m = wall_id_of(room_id, k), corner_id_of(room_id, k), float(walls.length_m[k])
    wall, edge, corner = snapshot.get(wall_id), snapshot.parent(wall_id), snapshot.parent(corner_id)
    if not isinstance(wall, WallNode) or edge is None:
        return
    yield replace(wall, offset_m=float(walls.offset_m[k]), length_m=length_m)
    x_m, y_m = (walls.start[k] + walls.along[k] * length_m / 2.0).tolist()
    yaw_rad = float(np.arctan2(walls.along[k][1], walls.along[k][0]))
    yield _moved(edge, SE3.from_xyz_yaw(x_m, y_m, 0.0, yaw_rad), std_m, stamp_s)
    if corner is not None:
        yield _moved(corner, SE3.from_xyz_yaw(-length_m / 2.0, 0.0, 0.0, 0.0), std_m, stamp_s)


def _moved(edge: RtEdge, T_source_target: SE3, std_m: float | None, stamp_s: float) -> RtEdge:
    covariance = edge.covariance.copy()
    if std_m is not None:
        covariance[_ACROSS, :] = covariance[:, _ACROSS] = 0.0
        covariance[_ACROSS, _ACROSS] = std_m**2
    return replace(edge, T_source_target=T_source_target, covariance=covariance, stamp_s=stamp_s)


def _at_x(transform: SE3, x_m: float) -> SE3:
    """The transform with another x."""
    return SE3.from_xyz_yaw(x_m, float(transform.y_m), float(transform.z_m), float(transform.yaw_rad))
