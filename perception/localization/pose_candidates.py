"""All ways to lay the straight walls that a scan shows on the walls of a known room."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, wrap
from perception.geometry.walls import Walls
from perception.lidar.corners import WallLine
from perception.lidar.slice import OutlineScan
from perception.localization.measurement_model import wall_ranges
from perception.localization.room_model import RoomModel

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PoseCandidateSettings:
    """What fits well enough to be tried. The alignment that follows forgives all of it."""

    lines: int = 8
    """Longest ones that are laid on walls. Chosen: for speed."""
    parallel_rad: float = float(np.deg2rad(5.0))
    """Between a line and its wall, and between headings that are one. Chosen: several times a line's error."""
    crossing: float = 0.5
    """Sine of the angle between two lines that fix a position. Chosen: thirty degrees."""
    overhang_m: float = 0.5
    """By which a line may be longer than its wall: it may go on as a piece of furniture."""
    cell_m: float = 0.15
    """Positions this near are one; the alignment reaches farther."""
    rays: int = 90
    """Asked per pose, one every four degrees. Chosen: enough to rank poses."""
    near_m: float = 0.25
    """From where a ray should end: errors of the position above."""
    worth_trying: float = 0.5
    """Share of the rays that must end near where they should. Chosen: furniture as high as the slice hides less."""


def pose_candidates(
    scan: OutlineScan,
    lines: Sequence[WallLine],
    room: RoomModel,
    settings: PoseCandidateSettings = PoseCandidateSettings(),
) -> list[Pose2]:
    """Poses of the base in ``room`` at which two ``lines`` of the scan lie on walls that are long enough, best first.

    Ranked by the share of rays that end near where they should; those with less than half are left out.
    """
    longest = sorted(lines, key=lambda line: -line.length_m)[: settings.lines]
    facing = [_facing(line) for line in longest]
    places: dict[tuple[int, int, int], Pose2] = {}
    for yaw_rad in _turns(facing, longest, room.walls, settings):
        for point in _shifts(facing, longest, room.walls, yaw_rad, settings):
            if room.contains(point):
                pose = Pose2(float(point[0]), float(point[1]), yaw_rad)
                cell = (*np.rint(point / settings.cell_m).astype(int).tolist(), round(yaw_rad / settings.parallel_rad))
                places.setdefault((cell[0], cell[1], cell[2]), pose)
    ranked = [(_agreement(scan, room.walls, pose, settings), pose) for pose in places.values()]
    ranked.sort(key=lambda item: -item[0])
    return [pose for share, pose in ranked if share > settings.worth_trying]


def _facing(line: WallLine) -> tuple[Array, float]:
    """Normal and offset of a line, turned to the robot in the origin."""
    return (line.normal, line.offset_m) if line.offset_m < 0.0 else (-line.normal, -line.offset_m)


def _turns(
    facing: Sequence[tuple[Array, float]], lines: Sequence[WallLine], walls: Walls, settings: PoseCandidateSettings
) -> list[float]:
    """Headings that make a line parallel to a wall and turn it to the same side; like ones count once."""
    found: list[float] = []
    for (normal, _), line in zip(facing, lines, strict=True):
        for wall in range(len(walls.offset_m)):
            yaw_rad = wrap(float(np.arctan2(*walls.normal[wall][::-1]) - np.arctan2(*normal[::-1])))
            fits = line.length_m < walls.length_m[wall] + settings.overhang_m
            if fits and not any(abs(wrap(yaw_rad - other)) < settings.parallel_rad for other in found):
                found.append(yaw_rad)
    return found


def _shifts(
    facing: Sequence[tuple[Array, float]],
    lines: Sequence[WallLine],
    walls: Walls,
    yaw_rad: float,
    settings: PoseCandidateSettings,
) -> list[Array]:
    """Positions (2,) that put two crossing lines onto walls, given the heading."""
    rotation = Pose2(0.0, 0.0, yaw_rad).rotation()
    ties: list[tuple[int, Array, float]] = []
    for index, ((normal, offset_m), line) in enumerate(zip(facing, lines, strict=True)):
        alike = walls.normal @ (rotation @ normal) > np.cos(settings.parallel_rad)
        fitting = np.flatnonzero(alike & (line.length_m < walls.length_m + settings.overhang_m)).tolist()
        ties += [(index, walls.normal[wall], float(walls.offset_m[wall]) - offset_m) for wall in fitting]
    found: list[Array] = []
    for (first, normal, shift_m), (second, other_normal, other_shift_m) in combinations(ties, 2):
        matrix = np.stack([normal, other_normal])
        if first != second and abs(np.linalg.det(matrix)) > settings.crossing:
            found.append(np.linalg.solve(matrix, np.array([shift_m, other_shift_m])))
    return found


def _agreement(scan: OutlineScan, walls: Walls, T_room_base: Pose2, settings: PoseCandidateSettings) -> float:
    """Share of a few rays that end near the wall they should meet."""
    step = max(1, len(scan.azimuths_rad) // settings.rays)
    measured = scan.ranges_m[::step]
    origin = T_room_base.apply(scan.origin_base)
    expected, incidence = wall_ranges(walls, origin, scan.azimuths_rad[::step] + T_room_base.yaw_rad)
    tells = np.isfinite(measured) & np.isfinite(expected)
    if not tells.any():
        return 0.0
    return float((np.abs(measured - expected)[tells] * incidence[tells] < settings.near_m).mean())
