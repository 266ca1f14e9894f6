"""The building as its layout has it: rooms of the size with which doors meet (Concepts, 3.6; design, section 9).

A room is kept as it was measured. Where the layout shifts walls so that loops of doors close, the room's ``rt`` edge
from the root says by how much, and whoever asks for the metric layout gets the room with its walls shifted.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.identifiers import wall_id_of
from scene_graph.nodes import CornerNode, Node, RoomNode, WallNode
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class LaidOutSettings:
    """How shifted walls meet."""

    nearly_parallel: float = 0.1
    """Tangent of half the angle between two walls below which they make no corner. Chosen: about 11 degrees, where a
    wall's shift would move the corner ten times as far.
    """


def laid_out(snapshot: Snapshot, *, settings: LaidOutSettings = LaidOutSettings()) -> Snapshot:
    """The snapshot with shifted walls in their places, and corners and doors on them; itself when none is shifted.

    A door goes along with its wall but keeps its station: that was measured in the room, not from the wall's ends.
    Things in the room stay where they are.
    """
    shifted = [element for room in snapshot.of_type(RoomNode) for element in _shifted_room(snapshot, room, settings)]
    if not shifted:
        return snapshot
    return snapshot.evolve(
        put_nodes={element.id: element for element in shifted if not isinstance(element, RtEdge)},
        put_edges={element.key: element for element in shifted if isinstance(element, RtEdge)},
        revision=snapshot.revision,
        stamp_s=snapshot.stamp_s,
    )


def inward_normals(polygon: Array) -> Array:
    """(N, 2) unit normals of the walls of (N, 2) ``polygon``, whose corners run counter-clockwise."""
    along = np.roll(polygon, -1, axis=0) - polygon
    normals = np.stack([-along[:, 1], along[:, 0]], axis=1) / np.linalg.norm(along, axis=1)[:, None]
    return np.asarray(normals, dtype=np.float64)


def shifted_polygon(polygon: Array, shifts_m: Array, *, settings: LaidOutSettings = LaidOutSettings()) -> Array:
    """(N, 2) corners after each wall, which starts at the corner of its index, was shifted by (N,) along its normal.

    Two walls meet in the corner between them: ``normal · displacement = shift`` for both. Where they are nearly
    parallel, that would send the corner far along them, and it takes the mean of both shifts instead.
    """
    normals = inward_normals(polygon)
    pairs = np.stack([np.roll(normals, 1, axis=0), normals], axis=1)
    wanted = np.stack([np.roll(shifts_m, 1), shifts_m], axis=1)
    displacement = np.linalg.pinv(pairs, rcond=settings.nearly_parallel) @ wanted[:, :, None]
    return np.asarray(polygon + displacement[:, :, 0], dtype=np.float64)


def _shifted_room(snapshot: Snapshot, room: RoomNode, settings: LaidOutSettings) -> Iterator[Node | RtEdge]:
    """The room, its walls and what hangs from them after the shifts; nothing for a room whose walls stay.

    A room too small for its shifts, in which a wall would turn around, stays as well.
    """
    place = snapshot.parent(room.id)
    shifts_m = np.array(place.wall_shifts_m) if place is not None else np.empty(0)
    if len(shifts_m) != len(room.polygon_m) or not shifts_m.any():
        return
    measured = np.array(room.polygon_m)
    shifted = shifted_polygon(measured, shifts_m, settings=settings)
    steps = inward_normals(measured) * shifts_m[:, None]
    if ((inward_normals(measured) * inward_normals(shifted)).sum(axis=1) < 0.0).any():
        return
    yield replace(room, polygon_m=tuple((float(x), float(y)) for x, y in shifted))
    for index, (start, end) in enumerate(zip(shifted, np.roll(shifted, -1, axis=0), strict=True)):
        wall, hung = snapshot.get(wall_id_of(room.id, index)), snapshot.parent(wall_id_of(room.id, index))
        if isinstance(wall, WallNode) and hung is not None:
            yield from _shifted_wall(snapshot, wall, hung, (start, end), steps[index])


def _shifted_wall(
    snapshot: Snapshot, wall: WallNode, hung: RtEdge, ends: tuple[Array, Array], step: Array
) -> Iterator[Node | RtEdge]:
    """A wall between its new ``ends``, each (2,), with its corner at its start, and its doors (2,) ``step`` further.

    ``hung``: the edge from the room to the wall as measured. All in the room's frame.
    """
    length_m = float(np.linalg.norm(ends[1] - ends[0]))
    yield replace(wall, length_m=length_m, offset_m=wall.offset_m + float(step @ np.array(wall.normal)))
    middle = (ends[0] + ends[1]) / 2.0
    T_room_wall = SE3(hung.T_source_target.quat_wxyz, [*middle, hung.T_source_target.z_m])
    yield replace(hung, T_source_target=T_room_wall)
    T_wall_before = T_room_wall.inverse() @ SE3.from_xyz_yaw(float(step[0]), float(step[1]), 0.0, 0.0)
    T_wall_before = T_wall_before @ hung.T_source_target
    for child in snapshot.children(wall.id):
        edge = snapshot.parent(child)
        if edge is None:
            continue
        T_wall_child = T_wall_before @ edge.T_source_target
        if isinstance(snapshot.get(child), CornerNode):
            T_wall_child = SE3(edge.T_source_target.quat_wxyz, [-length_m / 2.0, 0.0, edge.T_source_target.z_m])
        yield replace(edge, T_source_target=T_wall_child)
