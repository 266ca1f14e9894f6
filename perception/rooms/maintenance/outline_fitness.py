"""How well a room that stands agrees with what is seen of its walls, recently and in the long run, place by place.

Rays that keep passing a stretch of wall where no door is known contradict the outline: an L-shaped room was taken for a
rectangle, or a wall was put where there is none. One such scan is nothing, many from different places are evidence.
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.runs import runs
from perception.lidar.slice import OutlineScan
from perception.rooms.views.view import View, ViewSettings

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class OutlineFitnessSettings:
    """What is evidence for and against an outline, and how much of it is enough."""

    recent_views: float = 20.0
    """Memory of the recent evidence. Chosen: a meter of driving."""
    usual_views: float = 200.0
    """Memory of the long-term evidence. Chosen: ten times as long, some crossings of the room."""
    moved_m: float = 0.05
    """Way between views that count. Chosen: from nearer ones errors are the same."""
    turned_rad: float = 0.1
    """Or turn between them."""
    views: float = 6.0
    """Least number at a place. Chosen."""
    passed: float = 0.8
    """Share of rays passing that contradicts. Chosen: some end on what hangs before the wall."""
    stretch_m: float = 0.5
    """Least length of contradicted wall: a door's width."""
    places: int = 3
    """From which it must have been seen. Chosen."""
    apart_m: float = 0.4
    """Between these."""
    step_m: float = 0.1
    """Between places on the outline that rays are asked about. Chosen: a fifth of the least length."""
    gate_m: float = 0.08
    """How near to the wall a ray that meets it ends: four standard deviations of the usual range noise."""
    least_matched: float = 0.5
    """Share of the rays at a place that makes it agree. Chosen: most of them."""
    view: ViewSettings = field(default_factory=ViewSettings)


@dataclass(frozen=True, kw_only=True)
class Stretch:
    """Part of ``wall``, in meters from its start."""

    wall: int
    start_m: float
    end_m: float


class OutlineFitness:
    """Evidence about one outline."""

    def __init__(self, polygon: Array, settings: OutlineFitnessSettings = OutlineFitnessSettings()) -> None:
        self.polygon = polygon
        self._settings = settings
        self._wall, self._station, self._points, self._outward = _places(polygon, settings.step_m)
        self._ended = np.zeros((2, len(self._points)))
        self._passed = np.zeros((2, len(self._points)))
        self._from: list[Array] = []
        self._last: Pose2 | None = None

    @property
    def recent(self) -> float:
        """Share of the places on the outline at which rays lately ended as they should, of those that tell."""
        told = self._ended[0] + self._passed[0]
        asked = told >= 1.0
        if not asked.any():
            return 1.0
        return float((self._ended[0][asked] >= self._settings.least_matched * told[asked]).mean())

    def add(self, scan: OutlineScan, T_room_base: Pose2) -> bool:
        """Take in a scan, unless the robot has not moved since the last; whether it was taken in."""
        settings = self._settings
        if self._last is not None:
            moved = self._last.inverse() @ T_room_base
            if np.hypot(moved.x_m, moved.y_m) < settings.moved_m and abs(moved.yaw_rad) < settings.turned_rad:
                return False
        self._last = T_room_base
        position = T_room_base.position_m
        if all(float(np.linalg.norm(position - other)) > settings.apart_m for other in self._from):
            self._from.append(position)
        ended, passed = self._judge(scan, T_room_base)
        for row, memory in enumerate((settings.recent_views, settings.usual_views)):
            told = ended | passed
            keep = np.where(told, 1.0 - 1.0 / memory, 1.0)
            self._ended[row] = self._ended[row] * keep + ended
            self._passed[row] = self._passed[row] * keep + passed
        return True

    def _judge(self, scan: OutlineScan, T_room_base: Pose2) -> tuple[Mask, Mask]:
        """(P,) places where a ray ended as it should, and where one passed."""
        view = View(
            T_frame_base=T_room_base,
            T_odom_base=T_room_base,
            scan=scan,
            lines=(),
            corners=(),
            settings=self._settings.view,
        )
        gate_m = max(self._settings.gate_m, 3.0 * scan.noise_m)
        clearance, incidence = view.clearance(self._points, self._outward, gate_m)
        clearance[incidence < 0.0] = np.nan
        with np.errstate(invalid="ignore"):
            return np.abs(clearance) <= gate_m, clearance > 2.0 * gate_m

    def contradicted(self) -> list[Stretch]:
        """Stretches of wall that most rays pass, seen from enough places to be sure."""
        settings = self._settings
        if len(self._from) < settings.places:
            return []
        told = self._ended[1] + self._passed[1]
        against = (told >= settings.views) & (self._passed[1] > settings.passed * told)
        found: list[Stretch] = []
        for wall in range(len(self.polygon)):
            here = np.flatnonzero(self._wall == wall)
            for first, last in runs(against[here]):
                start_m, end_m = self._station[here[[first, last - 1]]] + np.array([-0.5, 0.5]) * settings.step_m
                if end_m - start_m >= settings.stretch_m:
                    found.append(Stretch(wall=wall, start_m=float(start_m), end_m=float(end_m)))
        return found


def _places(polygon: Array, step_m: float) -> tuple[NDArray[np.int64], Array, Array, Array]:
    """Wall (P,), station along it (P,), position (P, 2) and outward normal (P, 2) of places on the outline."""
    walls, stations, points, normals = [], [], [], []
    for k, (start, end) in enumerate(zip(polygon, np.roll(polygon, -1, axis=0), strict=True)):
        length_m = float(np.linalg.norm(end - start))
        along = (end - start) / length_m
        station = np.arange(step_m / 2.0, length_m, step_m)
        walls.append(np.full(len(station), k))
        stations.append(station)
        points.append(start + station[:, None] * along)
        normals.append(np.tile(np.array([along[1], -along[0]]), (len(station), 1)))
    return np.concatenate(walls), np.concatenate(stations), np.concatenate(points), np.concatenate(normals)
