"""Everything the rays have told about the walls of one room, and which gaps no known door explains (algorithm 2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.doors.posts import MeasuredGap, PostSettings, measure_gap
from perception.doors.wall_evidence import EvidenceSettings, Gap, WallEvidence
from perception.geometry.planar import Pose2, wrap
from perception.geometry.walls import Walls
from perception.lidar.wall_rays import RaySettings, WallRays, rays_by_wall
from perception.ports import LidarScan

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class RoomEvidenceSettings:
    """Which scans are kept, when a known door looks open, and what rays, walls and posts are told by."""

    step_m: float = 0.03
    """Way between scans whose rays are kept one by one. Chosen: what nearer ones would add is the same."""
    step_rad: float = 0.05
    """Or turn between them."""
    first_scans: int = 10
    """Are kept though the robot stands still: it may stand still for long at first. Chosen: a second."""
    steep: float = 0.7
    """Way along the wall per way into it, beyond which a thick wall's reveals fill the view of a door."""
    fewest_rays: int = 8
    """In a door that is judged. Chosen."""
    nearest_m: float = 0.3
    """A door that the robot stands in shows nothing of its state."""
    open_from: float = 0.4
    """Share of the rays that pass an open door. Chosen: much of the view may be of what stands behind it."""
    closed_to: float = 0.1
    """Share of the rays that may pass a closed one. Chosen."""
    rays: RaySettings = field(default_factory=RaySettings)
    walls: EvidenceSettings = field(default_factory=EvidenceSettings)
    posts: PostSettings = field(default_factory=PostSettings)


@dataclass(frozen=True, kw_only=True)
class Span:
    """A known door's place in its wall, stations in meters from the wall's start."""

    center_m: float
    width_m: float

    def overlaps(self, gap: Gap) -> bool:
        """Whether the gap is, for the most part, this door."""
        low = max(gap.start_m, self.center_m - self.width_m / 2.0)
        high = min(gap.end_m, self.center_m + self.width_m / 2.0)
        return high - low > 0.3 * min(gap.width_m, self.width_m)

    def covers(self, other: Span) -> bool:
        """Whether the middle of another door lies in this one."""
        return abs(other.center_m - self.center_m) < self.width_m / 2.0


class RoomEvidence:
    """Evidence along each wall of a room, fed with scans taken inside it.

    Attributes:
        settings: what evidence is told by.
        scans: how many were counted.
        checked: (wall, station in meters) of unseen stretches that were looked at from the front, in vain.
    """

    def __init__(self, polygon: Array, settings: RoomEvidenceSettings = RoomEvidenceSettings()) -> None:
        self.settings = settings
        self.polygon = polygon
        self.walls = Walls.of_polygon(polygon)
        self._evidence = [WallEvidence(float(length), settings.walls) for length in self.walls.length_m]
        self._latest: list[WallRays] | None = None
        self._kept: Pose2 | None = None
        self.scans = 0
        self.checked: list[tuple[int, float]] = []

    def add(self, scan: LidarScan, T_room_base: Pose2) -> None:
        """Count a scan's rays; keep them one by one when the robot has moved since the last kept ones."""
        settings = self.settings
        moved = self._kept is None or (
            self._kept.distance_m(T_room_base) > settings.step_m
            or abs(wrap(self._kept.yaw_rad - T_room_base.yaw_rad)) > settings.step_rad
        )
        keep = moved or self.scans < settings.first_scans
        if keep:
            self._kept = T_room_base
        self.scans += 1
        self._latest = rays_by_wall(scan, T_room_base, self.walls, settings.rays)
        for evidence, rays in zip(self._evidence, self._latest, strict=True):
            evidence.add(rays, keep=keep)

    def gaps(self, wall: int) -> list[Gap]:
        """Open stretches of a wall."""
        return self._evidence[wall].gaps()

    def recesses(self, wall: int) -> list[Gap]:
        """Closed doors in a wall, as far as they can be told from it."""
        return self._evidence[wall].recesses()

    def unseen(self, wall: int, doors: Sequence[Span] = ()) -> list[Gap]:
        """Stretches of a wall, beside its known ``doors``, that could hide another and were not looked at yet."""
        explained = [(door.center_m - door.width_m / 2.0, door.center_m + door.width_m / 2.0) for door in doors]
        checked = [station_m for other, station_m in self.checked if other == wall]
        return [
            gap
            for gap in self._evidence[wall].unseen(explained=explained)
            if not any(gap.start_m - 0.3 < station_m < gap.end_m + 0.3 for station_m in checked)
        ]

    def gap_at(self, wall: int, span: Span) -> Gap | None:
        """The open stretch, or else the closed leaf, where a door is known, if there is one."""
        for found in (self.gaps, self.recesses):
            for gap in found(wall):
                if span.overlaps(gap):
                    return gap
        return None

    def measure(self, wall: int, gap: Gap) -> MeasuredGap:
        """A gap with both ends refined."""
        return measure_gap(self._evidence[wall], gap, self.settings.posts)

    def looks_open(self, wall: int, span: Span) -> bool | None:
        """Whether the newest scan sees through a known door; ``None`` when it does not see enough of it."""
        if self._latest is None:
            return None
        rays, settings = self._latest[wall], self.settings
        margin_m = min(0.12, 0.2 * span.width_m)
        inner = span.width_m / 2.0 - margin_m
        near = (np.abs(rays.station_m - span.center_m) < inner) & (np.abs(rays.slope) < settings.steep)
        if near.sum() < settings.fewest_rays or np.ptp(rays.station_m[near]) < 1.2 * inner:
            return None
        if rays.distance_m[near].min() < settings.nearest_m:
            return None
        passed = float(rays.passed[near].mean())
        if passed > settings.open_from:
            return True
        return False if passed < settings.closed_to else None
