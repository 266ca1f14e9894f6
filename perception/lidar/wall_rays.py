"""What a scan says about each wall of a room: where rays end on its face, and where they pass through its plane.

This is lines 1 to 4 of the paper's algorithm 2 with the wall's plane in place of the range profile: a ray that goes on
for half a meter beyond the plane has found a gap; one that ends before the plane says nothing, so furniture in front of
a wall is no door.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.walls import Walls
from perception.ports import LidarScan

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class RaySettings:
    """Which rays tell what about a wall; heights are above the floor."""

    low_m: float = 0.25
    """Bottom of what must be open in a door: above thresholds and shoes. Chosen."""
    split_m: float = 0.9
    """Below, what is seen on the face closes it for the robot's base: a window's sill is at this height."""
    high_m: float = 1.8
    """Top of it: below the lintel of a door of 2 m."""
    floor_m: float = 0.1
    """A ray that would meet the floor, to so much, before it has passed tells nothing."""
    lintel_m: float = 1.95
    """Nor does one that would meet the lintel of a door of 2 m."""
    face_m: float = 0.09
    """Returns this near to the plane are on the wall: range noise, and errors of the wall and the pose."""
    through_m: float = 0.5
    """A ray this far beyond the plane has passed it (``lambda`` of algorithm 2): more than most walls are thick."""
    grazing: float = 0.25
    """Least cosine of incidence: fourteen degrees. Chosen."""
    reach_m: float = 9.0
    """Rays meeting a wall farther away are too far apart to tell."""
    passage_m: float = 0.6
    """What stands nearer to a wall leaves no way to a door in it: the robot is 0.56 m wide."""
    lintel_bottom_m: float = 2.05
    """Where wall goes on above a door."""
    lintel_top_m: float = 2.45
    """Up to the ceiling of a room of usual height."""
    floor_range_m: float = 20.0
    """A ray that meets the floor nearer than this always returns. Chosen."""


@dataclass(frozen=True, kw_only=True, eq=False)
class WallRays:
    """Rays of one scan that reached the plane of one wall, one entry per direction, (N,) each.

    ``station_m``: where along the wall, from its start. ``depth_m``: how far behind the face the ray ended, at most
    ``through_m``. ``slope``: way along the wall per way into it. ``distance_m``: from the sensor.
    ``passed``: whether most rays of the direction passed; ``on_face``: whether they ended on the face, not behind it on
    a reveal or a recessed panel; ``low_hit``: whether most in the low band ended on the face.
    ``lintel_m``: how far behind the face the nearest return above doors is, ``inf`` where there is none.
    ``blocked_m``: (M,) stations in whose direction something stands so close before the wall that nobody could pass.
    """

    station_m: Array
    depth_m: Array
    slope: Array
    distance_m: Array
    passed: NDArray[np.bool_]
    on_face: NDArray[np.bool_]
    low_hit: NDArray[np.bool_]
    lintel_m: Array
    blocked_m: Array


def rays_by_wall(
    scan: LidarScan, T_room_base: Pose2, walls: Walls, settings: RaySettings = RaySettings()
) -> list[WallRays]:
    """The rays of ``scan``, taken at ``T_room_base``, that tell about each of ``walls``."""
    T_room_lidar = T_room_base @ Pose2.from_se3(scan.T_base_lidar)
    height_m = scan.T_base_lidar.z_m
    azimuth = scan.azimuths_rad + T_room_lidar.yaw_rad
    direction = np.stack([np.cos(azimuth), np.sin(azimuth)], axis=1)
    tangent = np.tan(scan.elevations_rad)
    horizontal = scan.ranges_m.astype(np.float64) * np.cos(scan.elevations_rad)[:, None]
    origin = T_room_lidar.position_m
    result: list[WallRays] = []
    for k in range(len(walls.offset_m)):
        incidence = -(direction @ walls.normal[k])
        clearance = float(walls.normal[k] @ origin - walls.offset_m[k])
        with np.errstate(divide="ignore", invalid="ignore"):
            reach = np.where(incidence > settings.grazing, clearance / incidence, np.inf)
        station = (origin - walls.start[k]) @ walls.along[k] + np.where(np.isfinite(reach), reach, 0.0) * (
            direction @ walls.along[k]
        )
        useful = (reach < settings.reach_m) & (station > 0.0) & (station < walls.length_m[k]) & (clearance > 0.05)
        result.append(
            _classify(
                horizontal[:, useful],
                reach[useful],
                incidence[useful],
                station[useful],
                (direction @ walls.along[k])[useful],
                height_m,
                tangent,
                settings,
            )
        )
    return result


def _classify(
    horizontal: Array,
    reach: Array,
    incidence: Array,
    station: Array,
    sideways: Array,
    height_m: float,
    tangent: Array,
    settings: RaySettings,
) -> WallRays:
    """Per direction: the typical depth over the rings whose rays reach the plane at the height of a door."""
    height = height_m + reach[None, :] * tangent[:, None]
    with np.errstate(invalid="ignore"):
        depth = np.minimum((horizontal - reach) * incidence, settings.through_m)
    behind = height + tangent[:, None] * settings.through_m / incidence
    in_band = (height > settings.low_m) & (height < settings.high_m)
    clear = (behind > settings.floor_m) & (behind < settings.lintel_m)
    told = in_band & clear & (depth > -settings.face_m) & ~_hidden(horizontal, height_m, tangent, settings)
    low = told & (height < settings.split_m)
    count = told.sum(axis=0)
    passing = (told & (depth >= settings.through_m)).sum(axis=0)
    low_hits = (low & (depth < settings.face_m)).sum(axis=0)
    kept = count > 0
    above = (height > settings.lintel_bottom_m) & (height < settings.lintel_top_m) & (depth > -settings.face_m)
    before = (in_band & (depth > -settings.passage_m) & (depth <= -settings.face_m)).any(axis=0)
    typical = _median_where(depth, told)
    return WallRays(
        station_m=station[kept],
        depth_m=typical[kept],
        slope=(sideways / incidence)[kept],
        distance_m=reach[kept],
        passed=(2 * passing > count)[kept],
        on_face=(typical < settings.face_m)[kept],
        low_hit=(2 * low_hits > low.sum(axis=0))[kept],
        lintel_m=np.where(above, depth, np.inf).min(axis=0)[kept],
        blocked_m=station[before & ~kept],
    )


def _hidden(horizontal: Array, height_m: float, tangent: Array, settings: RaySettings) -> NDArray[np.bool_]:
    """Rays that did not return though they would have met the floor: the robot's own body is in their way."""
    meets_floor = tangent * settings.floor_range_m < -height_m
    return np.asarray(~np.isfinite(horizontal) & meets_floor[:, None])


def _median_where(values: Array, mask: NDArray[np.bool_]) -> Array:
    """(columns,) median of the masked values of each column, 0 where there are none."""
    filled = np.sort(np.where(mask, values, np.inf), axis=0)
    count = mask.sum(axis=0)
    columns = np.arange(values.shape[1])
    middle = (
        filled[np.maximum(count - 1, 0) // 2, columns] + filled[np.minimum(count // 2, len(filled) - 1), columns]
    ) / 2.0
    return np.where(count > 0, middle, 0.0)
