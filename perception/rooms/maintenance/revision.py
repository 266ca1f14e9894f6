"""Taking back a room that contradicts what is seen, and writing it anew when it was measured again.

The room keeps its name, its label and its frame, so that everything that hangs from it stays where it is; walls and
corners are replaced, and doors move to the wall that is now where they are.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from perception.crossing import cross_affordance, match_of, move_robot
from perception.geometry.planar import Pose2, diagonal_covariance, spatial_covariance
from perception.geometry.polygon import shared_area, wall_lengths
from perception.localization.doorways import DoorSizes, doors_in
from perception.rooms.maintenance.outline_fitness import OutlineFitness, Stretch
from perception.rooms.survey.insertion import withdraw
from perception.rooms.survey.instance import InstanceSettings, MeasuredRoom, room_elements
from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.identifiers import wall_id_of
from scene_graph.memory import Transaction
from scene_graph.nodes import DoorNode, RoomNode, RoomStatus, WallNode
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class RevisionSettings:
    """When a stretch of wall is missing, and what of the old outline is found in the new one."""

    corner_m: float = 0.35
    """A contradicted stretch that ends so near to a corner goes on to it. Chosen: rays near corners tell nothing."""
    widest_door_m: float = DoorSizes.widest_m
    """Such a stretch, if it is wider, is no door: a part of the room is behind it."""
    shared: float = 0.6
    """Share of the smaller outline that must lie in the other for both to be one room. Chosen: clearly most."""
    same_wall_m: float = 0.3
    """Farthest that a door moves to a wall; one that leads nowhere and is farther from all was none. Chosen."""
    parallel: float = 0.95
    """Cosine of the angle between a door and its wall: eighteen degrees. Chosen: walls are at right angles."""


def missing_walls(
    snapshot: Snapshot, room_id: str, fitness: OutlineFitness, settings: RevisionSettings = RevisionSettings()
) -> list[Stretch]:
    """Contradicted stretches of a room's walls that no door explains, not even a suspected one.

    An opening wider than a door that goes on to a corner is no door: a part of the room is behind it.
    """
    lengths = wall_lengths(fitness.polygon)
    found: list[Stretch] = []
    for stretch in fitness.contradicted():
        wall_id, length_m = wall_id_of(room_id, stretch.wall), float(lengths[stretch.wall])
        if wall_id not in snapshot:
            continue
        to_corner = stretch.start_m < settings.corner_m or stretch.end_m > length_m - settings.corner_m
        wide = stretch.end_m - stretch.start_m > settings.widest_door_m
        if (wide and to_corner) or not any(
            start_m < stretch.end_m and stretch.start_m < end_m
            for start_m, end_m in _door_spans(snapshot, wall_id, length_m)
        ):
            found.append(stretch)
    return found


def _door_spans(snapshot: Snapshot, wall_id: str, length_m: float) -> list[tuple[float, float]]:
    """Where doors begin and end along a wall, in meters from its start."""
    middle_m = length_m / 2.0
    return [
        (middle_m + station_m - door.width_m / 2.0, middle_m + station_m + door.width_m / 2.0)
        for door, station_m in doors_in(snapshot, wall_id)
    ]


def same_place(before: RoomNode, measured: MeasuredRoom, settings: RevisionSettings = RevisionSettings()) -> bool:
    """Whether what was measured anew lies, for the most part, where the room was thought to be.

    The smaller of the two must be mostly within the other: a part may turn out to be missing, or to have been missed.
    """
    old, new = np.array(before.polygon_m), measured.T_parent_room.apply(measured.polygon)
    before_area, area, shared = shared_area(old, new)
    return shared > settings.shared * max(1, min(before_area, area))


def let_stand(tx: Transaction, room: RoomNode) -> None:
    """Nothing better was found: the room stands as it was, but only as partial."""
    withdraw(tx)
    tx.put(replace(room, status=RoomStatus.PARTIAL))


def revise_room(
    tx: Transaction,
    measured: MeasuredRoom,
    room_id: str,
    *,
    status: RoomStatus,
    height_m: float,
    stamp_s: float,
    settings: RevisionSettings = RevisionSettings(),
    instance: InstanceSettings = InstanceSettings(),
) -> None:
    """Replace the outline of a room that was taken back. ``measured.T_parent_room`` is relative to its old frame.

    What the layout shifted of the old outline says nothing about the new one.
    """
    withdraw(tx)
    snapshot = tx.snapshot
    before = snapshot.room(room_id)
    T_room_measured = measured.T_parent_room
    renewed = replace(measured, polygon=T_room_measured.apply(measured.polygon))
    elements = room_elements(renewed, room_id, status=status, height_m=height_m, stamp_s=stamp_s, settings=instance)
    written = {element.id for element in elements if not isinstance(element, RtEdge)}
    walls = [node.id for node in snapshot.of_type(WallNode) if node.parent_room == room_id]
    doors = [
        (door, Pose2.from_se3(snapshot.transform(room_id, door.id)))
        for wall_id in walls
        for door, _ in doors_in(snapshot, wall_id)
    ]
    tx.put(*(_like(before, element) if isinstance(element, RoomNode) else element for element in elements))
    place = snapshot.parent(room_id)
    if place is not None and place.wall_shifts_m:
        tx.put(replace(place, wall_shifts_m=()))
    for door, T_room_door in doors:
        _rehang(tx, door, T_room_door, renewed.polygon, room_id, written, stamp_s, settings)
    for wall_id in walls:
        corner_id = "corner_" + wall_id.removeprefix("wall_")
        for stale in (corner_id, wall_id):
            if stale not in written and stale in snapshot:
                tx.remove(stale)
    move_robot(tx, room_id, T_room_measured @ measured.T_room_base, stamp_s)


def _like(before: RoomNode, measured: RoomNode) -> RoomNode:
    """The room as measured now, with what was known of it otherwise."""
    return replace(
        before,
        polygon_m=measured.polygon_m,
        confidence=measured.confidence,
        height_m=measured.height_m,
        status=measured.status,
    )


def _rehang(
    tx: Transaction,
    door: DoorNode,
    T_room_door: Pose2,
    polygon: Array,
    room_id: str,
    written: set[str],
    stamp_s: float,
    settings: RevisionSettings,
) -> None:
    """Hang a door from the nearest wall that runs along it; without one it was none, unless it leads somewhere."""
    starts, ends = polygon, np.roll(polygon, -1, axis=0)
    lengths = np.linalg.norm(ends - starts, axis=1)
    along = (ends - starts) / lengths[:, None]
    offset = T_room_door.position_m - starts
    station = np.clip((offset * along).sum(axis=1), 0.0, lengths)
    away = np.linalg.norm(offset - station[:, None] * along, axis=1)
    heading = np.array([np.cos(T_room_door.yaw_rad), np.sin(T_room_door.yaw_rad)])
    exists = np.array([wall_id_of(room_id, k) in written for k in range(len(polygon))])
    away = np.where((along @ heading > settings.parallel) & exists, away, np.inf)
    wall = int(np.argmin(away))
    leads_somewhere = match_of(tx.snapshot, door.id) is not None
    if not np.isfinite(away[wall]) or (away[wall] > settings.same_wall_m and not leads_somewhere):
        for gone in (cross_affordance(door.id), door.id):
            if gone in tx.snapshot:
                tx.remove(gone)
        return
    wall_id, old = wall_id_of(room_id, wall), tx.snapshot.parent(door.id)
    if old is not None and old.source != wall_id:
        tx.remove(old.key)
    tx.put(
        RtEdge(
            source=wall_id,
            target=door.id,
            T_source_target=SE3.from_xyz_yaw(float(station[wall] - lengths[wall] / 2.0), 0.0, 0.0, 0.0),
            covariance=spatial_covariance(diagonal_covariance(0.01, 0.01, 0.01)),
            stamp_s=stamp_s,
        )
    )
