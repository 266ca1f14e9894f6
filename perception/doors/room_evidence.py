"""Everything the rays have told about the walls of one room, and which gaps no known door explains (algorithm 2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.doors.posts import MeasuredGap, measure_gap
from perception.doors.wall_evidence import Gap, WallEvidence
from perception.geometry.planar import Pose2, wrap
from perception.geometry.walls import Walls
from perception.lidar.wall_rays import WallRays, rays_by_wall
from perception.ports import LidarScan

Array = NDArray[np.float64]

_STEP_M = 0.03
_STEP_RAD = 0.05
_FIRST_SCANS = 10
_STEEP = 0.7  # way along the wall per way into it, beyond which a thick wall's reveals fill the view


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
        scans: how many were counted.
        checked: (wall, station in meters) of unseen stretches that were looked at from the front, in vain.
    """

    def __init__(self, polygon: Array) -> None:
        self.polygon = polygon
        self.walls = Walls.of_polygon(polygon)
        self._evidence = [WallEvidence(float(length)) for length in self.walls.length_m]
        self._latest: list[WallRays] | None = None
        self._kept: Pose2 | None = None
        self.scans = 0
        self.checked: list[tuple[int, float]] = []

    def add(self, scan: LidarScan, T_room_base: Pose2) -> None:
        """Count a scan's rays; keep them one by one when the robot has moved since the last kept ones."""
        moved = self._kept is None or (
            self._kept.distance_m(T_room_base) > _STEP_M
            or abs(wrap(self._kept.yaw_rad - T_room_base.yaw_rad)) > _STEP_RAD
        )
        keep = moved or self.scans < _FIRST_SCANS
        if keep:
            self._kept = T_room_base
        self.scans += 1
        self._latest = rays_by_wall(scan, T_room_base, self.walls)
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
        return measure_gap(self._evidence[wall], gap)

    def looks_open(self, wall: int, span: Span) -> bool | None:
        """Whether the newest scan sees through a known door; ``None`` when it does not see enough of it."""
        if self._latest is None:
            return None
        rays = self._latest[wall]
        margin_m = min(0.12, 0.2 * span.width_m)
        inner = span.width_m / 2.0 - margin_m
        near = (np.abs(rays.station_m - span.center_m) < inner) & (np.abs(rays.slope) < _STEEP)
        if near.sum() < 8 or np.ptp(rays.station_m[near]) < 1.2 * inner or rays.distance_m[near].min() < 0.3:
            return None
        passed = float(rays.passed[near].mean())
        if passed > 0.4:
            return True
        return False if passed < 0.1 else None
