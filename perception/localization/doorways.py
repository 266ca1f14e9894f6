"""Doors as evidence of where the robot is: gaps that a scan shows, against the doors that a room has.

Walls alone leave a rectangular room the same when turned by half. A gap where the room has wall speaks strongly against
a pose; wall where it has a door speaks weakly, since doors get closed.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.walls import Walls
from perception.lidar.wall_rays import RaySettings, WallRays, rays_by_wall
from perception.localization.room_model import RoomModel
from perception.ports import LidarScan
from scene_graph.identifiers import wall_id_of
from scene_graph.nodes import DoorNode, DoorState
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class DoorSizes:
    """What is wide enough for a door, and what is too wide for one."""

    narrowest_m: float = 0.5
    """``D_min`` of algorithm 2: the robot, which is 0.56 m wide, does not get through less."""
    widest_m: float = 1.3
    """What is wider is an opening, whatever it leads to. Chosen: more than a single leaf's."""


@dataclass(frozen=True, kw_only=True)
class DoorwaySettings:
    """What one scan must show of a door, or of a gap where none is known."""

    narrowest_m: float = 0.4
    """Of a gap that speaks against a pose; seen at an angle, the reveals of a thick wall take their share of a door."""
    fewest_rays: int = 6
    """In a doorway or a gap. Chosen: two of them at the edges may be wrong."""
    widest_step_m: float = 0.3
    """Between neighboring rays of one gap. Chosen: half a door."""
    post_m: float = 0.2
    """So near beside a known door a gap belongs to it: errors of the pose and of its width."""
    clear: float = 0.6
    """Share of the rays that must agree on a doorway's state. Chosen: clearly more than half."""
    rays: RaySettings = field(default_factory=RaySettings)


@dataclass(frozen=True, kw_only=True)
class Doorway:
    """A door of a room: its wall's index, the station of its center from the wall's start, its width, its state."""

    wall: int
    center_m: float
    width_m: float
    state: DoorState


@dataclass(frozen=True, kw_only=True, eq=False)
class DoorwayModel:
    """All wall faces of a room, which of them are ``known``, and its doors."""

    walls: Walls
    known: tuple[bool, ...]
    doorways: tuple[Doorway, ...]

    @cached_property
    def openings(self) -> Array:
        """(D, 2, 2) ends of the gaps where doors are known or presumed, room frame; some are as high as the walls."""
        ends = np.array([[-0.5], [0.5]])
        return np.array(
            [
                self.walls.start[door.wall] + (door.center_m + ends * door.width_m) * self.walls.along[door.wall]
                for door in self.doorways
            ]
        ).reshape(-1, 2, 2)


@dataclass(frozen=True, kw_only=True)
class DoorwayFit:
    """What a scan says about a room's doors: how many open ones it shows open, how many it shows shut, and in how many
    places it passes where the room has wall.
    """

    open: int
    shut: int
    strange: int


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


def doorway_model(snapshot: Snapshot, room: RoomModel) -> DoorwayModel:
    """The doors of a room as the graph has them, provisional ones included."""
    walls = Walls.of_polygon(room.polygon)
    wall_ids = [wall_id_of(room.room_id, k) for k in range(len(room.polygon))]
    found: list[Doorway] = []
    for k, wall_id in enumerate(wall_ids):
        for door, station_m in doors_in(snapshot, wall_id):
            center_m = float(station_m + walls.length_m[k] / 2.0)
            found.append(Doorway(wall=k, center_m=center_m, width_m=door.width_m, state=door.state))
    return DoorwayModel(walls=walls, known=tuple(w in snapshot for w in wall_ids), doorways=tuple(found))


def doorway_fit(
    scan: LidarScan, model: DoorwayModel, T_room_base: Pose2, settings: DoorwaySettings = DoorwaySettings()
) -> DoorwayFit:
    """What ``scan``, taken at ``T_room_base``, says about the room's doors."""
    seen_open = shut = strange = 0
    for k, rays in enumerate(rays_by_wall(scan, T_room_base, model.walls, settings.rays)):
        doorways = [one for one in model.doorways if one.wall == k]
        for doorway in (one for one in doorways if one.state is DoorState.OPEN):
            looks_open = _looks_open(rays, doorway, settings)
            seen_open += looks_open is True
            shut += looks_open is False
        strange += _strange_gaps(rays, doorways, settings) if model.known[k] else 0
    return DoorwayFit(open=seen_open, shut=shut, strange=strange)


def _looks_open(rays: WallRays, doorway: Doorway, settings: DoorwaySettings) -> bool | None:
    """Whether rays pass in the middle of a doorway, or end on its wall's face; ``None`` when they do not tell."""
    near = np.abs(rays.station_m - doorway.center_m) < 0.3 * doorway.width_m
    if near.sum() < settings.fewest_rays:
        return None
    if float(rays.passed[near].mean()) > settings.clear:
        return True
    return False if float((rays.on_face & ~rays.passed)[near].mean()) > settings.clear else None


def _strange_gaps(rays: WallRays, doorways: list[Doorway], settings: DoorwaySettings) -> int:
    """How many stretches of wall, wide enough for a door, the rays pass where there is none."""
    order = np.argsort(rays.station_m, kind="stable")
    station, passed = rays.station_m[order], rays.passed[order]
    for doorway in doorways:
        away = np.abs(station - doorway.center_m) > doorway.width_m / 2.0 + settings.post_m
        station, passed = station[away], passed[away]
    stops = np.flatnonzero((np.diff(station) > settings.widest_step_m) | (np.diff(passed.astype(np.int8)) != 0)) + 1
    runs = [
        part
        for part, through in zip(np.split(station, stops), np.split(passed, stops), strict=True)
        if len(part) and through[0]
    ]
    return sum(bool(len(run) >= settings.fewest_rays and np.ptp(run) > settings.narrowest_m) for run in runs)
