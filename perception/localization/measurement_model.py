"""What a scan should show from a pose in a known room, and how well a scan agrees with it, both ways.

Of each ray above furniture and doors the outline says where it ends. A return there is explained. One beyond has passed
through a wall, which cannot be, unless the wall is so near that the ray passed under a door's lintel, or a door is
there that may have none; one before it may be tall furniture.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d, minimum_filter1d

from perception.geometry.planar import Pose2
from perception.geometry.runs import runs
from perception.geometry.walls import Walls
from perception.lidar.slice import OutlineScan
from perception.localization.doorways import DoorSizes

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class ScanFit:
    """Agreement of a scan with a room at a pose; shares of the returns that tell.

    ``explained``: on the wall that the ray should meet. ``passed``: behind it. ``cost``: mean squared distance from it
    in standard deviations, halved and cut off, what passed counting twice.
    """

    explained: float
    passed: float
    cost: float


@dataclass(frozen=True, kw_only=True)
class MeasurementModelSettings:
    """When a return is explained by a room, and when it contradicts it."""

    slack_m: float = 0.03
    """Errors that the measured outline and the pose may have. Chosen: about their largest."""
    through_m: float = 0.3
    """What is so far behind a wall has passed it. Chosen: more than a pose that is good enough can be off."""
    least_std_m: float = 0.02
    """Of a return: range noise of the robot's own LiDAR (design, section 5)."""
    gate: float = 3.0
    """Standard deviations beyond which a return is not explained."""
    window_rad: float = 0.012
    """Half of the window about each azimuth: error of the heading."""
    blind_margin_m: float = 0.15
    """Added to the distance below which rays pass under a lintel: errors of pose and outline."""
    post_m: float = 0.1
    """So near beside a door a ray may pass by it: errors of the door's place."""
    fewest_returns: int = 60
    """With fewer that tell, nothing is explained. Chosen: a fifteenth of a revolution."""
    widest_door_m: float = DoorSizes.widest_m
    """Of a door that nobody has noticed yet."""
    new_doors: int = 2
    """Most of these in one scan. Chosen: few of them can be new at once."""
    beside: int = 4
    """Rays on either side of such a door of which one must be explained. Chosen: those next to it may meet the post."""


def fit_of(
    scan: OutlineScan,
    walls: Walls,
    openings: Array,
    T_room_base: Pose2,
    settings: MeasurementModelSettings = MeasurementModelSettings(),
) -> ScanFit:
    """How well ``scan``, taken at ``T_room_base``, agrees with a room; nothing explained when too little returned.

    ``openings``: (D, 2, 2) ends of the gaps in its ``walls``.
    """
    origin = T_room_base.apply(scan.origin_base)
    azimuths_rad = scan.azimuths_rad + T_room_base.yaw_rad
    nearest, farthest, incidence = expected_ranges(walls, origin, azimuths_rad, settings.window_rad)
    measured = scan.ranges_m
    may_pass = (nearest <= scan.blind_m + settings.blind_margin_m) | _at_openings(
        openings, origin, azimuths_rad, nearest, settings.post_m
    )
    below_lintel = may_pass & (measured > farthest + settings.through_m)
    tells = np.isfinite(measured) & np.isfinite(farthest) & ~below_lintel
    if tells.sum() < settings.fewest_returns:
        return ScanFit(explained=0.0, passed=0.0, cost=settings.gate**2)
    measured, nearest, farthest = measured[tells], nearest[tells], farthest[tells]
    off = (measured - np.clip(measured, nearest, farthest)) * incidence[tells]
    deviation = np.maximum(np.abs(off) - settings.slack_m, 0.0) / max(settings.least_std_m, scan.noise_m)
    passed = off > settings.through_m
    explained = deviation <= settings.gate
    directions = np.stack([np.cos(azimuths_rad[tells]), np.sin(azimuths_rad[tells])], axis=1)
    unknown = _unknown_doorways(passed, explained, origin + directions * nearest[:, None], settings)
    passed, explained, deviation = passed[~unknown], explained[~unknown], deviation[~unknown]
    cost = np.minimum(deviation**2, settings.gate**2) / 2.0 * np.where(passed, 2.0, 1.0)
    return ScanFit(
        explained=float(explained.mean()),
        passed=float(passed.mean()),
        cost=float(cost.mean()),
    )


def _unknown_doorways(passed: Mask, explained: Mask, hits: Array, settings: MeasurementModelSettings) -> Mask:
    """(N,) rays that pass a wall together where a door may be that nobody has noticed yet.

    It is no wider than a door, and rays end as expected on both sides of it; few of them can be new at once.
    """
    doubtful = np.zeros(len(passed), dtype=bool)
    found = 0
    for first, last in runs(passed):
        width_m = float(np.linalg.norm(hits[last - 1] - hits[first]))
        near = settings.beside
        beside = explained[max(0, first - near) : first].any() and explained[last : last + near].any()
        if width_m < settings.widest_door_m and beside and found < settings.new_doors:
            doubtful[first:last] = True
            found += 1
    return doubtful


def _at_openings(openings: Array, origin: Array, azimuths_rad: Array, ranges_m: Array, post_m: float) -> Mask:
    """(N,) rays that meet the outline where a door is."""
    met = np.isfinite(ranges_m)
    directions = np.stack([np.cos(azimuths_rad), np.sin(azimuths_rad)], axis=1)
    hits = origin + directions * np.where(met, ranges_m, 0.0)[:, None]
    there = np.zeros(len(hits), dtype=bool)
    for start, end in openings:
        width_m = float(np.linalg.norm(end - start))
        along = (end - start) / width_m
        offset = hits - start
        station, away = offset @ along, offset @ np.array([-along[1], along[0]])
        there |= (station > -post_m) & (station < width_m + post_m) & (np.abs(away) < post_m)
    return there & met


def expected_ranges(
    walls: Walls, origin: Array, azimuths_rad: Array, window_rad: float = MeasurementModelSettings.window_rad
) -> tuple[Array, Array, Array]:
    """Nearest and farthest wall (N,) within ``window_rad`` of each azimuth, and the cosine of incidence there.

    The window takes up what an error of the heading does at grazing angles and at the edge of a corner. Infinite where
    no wall is met; azimuths are evenly spaced, all around.
    """
    ranges, incidence = wall_ranges(walls, origin, azimuths_rad)
    window = 2 * int(np.ceil(window_rad * len(azimuths_rad) / (2.0 * np.pi))) + 1
    nearest, farthest = minimum_filter1d(ranges, window, mode="wrap"), maximum_filter1d(ranges, window, mode="wrap")
    return nearest, farthest, incidence


def wall_ranges(walls: Walls, origin: Array, azimuths_rad: Array) -> tuple[Array, Array]:
    """Distance (N,) of the first wall face from ``origin`` in each direction, and the cosine of incidence on it."""
    direction = np.stack([np.cos(azimuths_rad), np.sin(azimuths_rad)], axis=1)
    towards = -(direction @ walls.normal.T)
    clearance = walls.normal @ origin - walls.offset_m
    with np.errstate(divide="ignore", invalid="ignore"):
        reach = np.where((towards > 1e-6) & (clearance > 0.0), clearance / towards, np.inf)
    finite = np.where(np.isfinite(reach), reach, 0.0)
    station = ((origin - walls.start) * walls.along).sum(axis=1) + finite * (direction @ walls.along.T)
    reach = np.where((station > -1e-3) & (station < walls.length_m + 1e-3), reach, np.inf)
    met = np.argmin(reach, axis=1)[:, None]
    return np.take_along_axis(reach, met, axis=1)[:, 0], np.take_along_axis(towards, met, axis=1)[:, 0]
