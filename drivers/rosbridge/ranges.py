"""Laser scans and point clouds of ROS as revolutions of a multi-ring LiDAR."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from drivers.rosbridge.errors import BadMessage
from drivers.rosbridge.messages import LaserScanMessage, PointCloudMessage
from perception.ports import LidarScan
from scene_graph.geometry.se3 import SE3

_TYPES = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 8: "f8"}
"""Types of a point's values by their number in ``sensor_msgs/PointField``."""
_DIGITS = 5
"""Of angles in radians: the same direction in two scans is the same number."""
"""Angles are rounded to 10 µrad, so that those of successive scans are the same and what is computed of them lasts."""


def scan_of_laser(message: LaserScanMessage, stamp_s: float, T_base_lidar: SE3) -> LidarScan:
    """A revolution of one ring.

    Raises:
        BadMessage: no ray returned.
    """
    ranges_m = np.array([math.inf if value is None else value for value in message.ranges], dtype=np.float32)
    ranges_m[~((ranges_m >= message.range_min) & (ranges_m <= message.range_max))] = np.inf
    _check_returns(np.isfinite(ranges_m))
    steps = np.arange(len(ranges_m), dtype=np.float64)
    azimuths_rad = message.angle_min + message.angle_increment * steps
    if message.angle_increment < 0:
        ranges_m, azimuths_rad = ranges_m[::-1], azimuths_rad[::-1]
    return LidarScan(
        stamp_s=stamp_s,
        ranges_m=np.ascontiguousarray(ranges_m[None, :]),
        elevations_rad=np.zeros(1),
        azimuths_rad=np.asarray(np.round(azimuths_rad, _DIGITS), dtype=np.float64),
        T_base_lidar=T_base_lidar,
    )


def scan_of_cloud(message: PointCloudMessage, stamp_s: float, T_base_lidar: SE3, *, azimuths: int) -> LidarScan:
    """A revolution of as many rings as returned anything.

    The rings are the rows of an organized cloud, otherwise the values of its field ``ring``. Rays of a ring are laid
    on a grid of directions, the nearest of several in one direction counts; the grid is turned so that it fits best.
    ``azimuths``: how many directions, where the cloud is not organized.

    Raises:
        BadMessage: the cloud has no rings, no point, or is not what it says.
    """
    points, rings = _points_and_rings(message)
    count = message.width if message.height > 1 else azimuths
    seen = np.isfinite(points).all(axis=1) & np.any(points != 0.0, axis=1)
    _check_returns(seen)
    points, rings = points[seen], rings[seen]
    names, row = np.unique(rings, return_inverse=True)
    flat_m = np.hypot(points[:, 0], points[:, 1])
    azimuth_rad, elevation_rad = np.arctan2(points[:, 1], points[:, 0]), np.arctan2(points[:, 2], flat_m)
    grid_rad, column = _grid(azimuth_rad, count)
    ranges_m = np.full((len(names), count), np.inf, dtype=np.float32)
    np.minimum.at(ranges_m, (row, column), np.linalg.norm(points, axis=1).astype(np.float32))
    elevations_rad = np.array([np.median(elevation_rad[row == index]) for index in range(len(names))])
    upwards = np.argsort(elevations_rad)
    return LidarScan(
        stamp_s=stamp_s,
        ranges_m=ranges_m[upwards],
        elevations_rad=np.round(elevations_rad[upwards], _DIGITS),
        azimuths_rad=np.round(grid_rad, _DIGITS),
        T_base_lidar=T_base_lidar,
    )


def _check_returns(returned: NDArray[np.bool_]) -> None:
    """Indoors something is in every direction: of a LiDAR that sees nothing at all, nothing may be concluded."""
    if not returned.any():
        raise BadMessage("no ray of the LiDAR returns: is it covered?")


def _grid(azimuth_rad: NDArray[np.float64], count: int) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
    """``count`` directions all around, turned to where the rays are, and the one that each ray is nearest to."""
    step_rad = math.tau / count
    turn = np.exp(1j * azimuth_rad * count).sum()
    phase_rad = float(np.angle(turn)) / count if abs(turn) > 0 else 0.0
    column = np.round((azimuth_rad - phase_rad + math.pi) / step_rad).astype(np.intp) % count
    return phase_rad - math.pi + step_rad * np.arange(count, dtype=np.float64), column


def _points_and_rings(message: PointCloudMessage) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """(N, 3) points in the sensor's frame, and the ring of each."""
    packed = _unpacked(message)
    names = packed.dtype.names or ()
    if absent := [name for name in ("x", "y", "z") if name not in names]:
        raise BadMessage(f"point cloud: it has no field {', '.join(absent)}; there are {', '.join(names)}")
    points = np.stack([packed[name].astype(np.float64) for name in ("x", "y", "z")], axis=-1)
    if message.height > 1:
        rings = np.repeat(np.arange(message.height), message.width)
    elif "ring" in names:
        rings = packed["ring"].astype(np.int64)
    else:
        raise BadMessage("point cloud: it is not organized in rows, and has no field 'ring'")
    return points, rings


def _unpacked(message: PointCloudMessage) -> NDArray[np.void]:
    """(N,) points with their fields by name."""
    order = ">" if message.is_bigendian else "<"
    fields = [field for field in message.fields if field.datatype in _TYPES]
    layout = {
        "names": [field.name for field in fields],
        "formats": [order + _TYPES[field.datatype] for field in fields],
        "offsets": [field.offset for field in fields],
        "itemsize": message.point_step,
    }
    row_bytes, rows = message.width * message.point_step, message.height
    if len(message.data) < (rows - 1) * message.row_step + row_bytes or (rows > 1 and message.row_step < row_bytes):
        raise BadMessage(f"point cloud: {len(message.data)} bytes are too few for {rows} × {message.width} points")
    try:
        dtype = np.dtype(layout)  # type: ignore[call-overload]
    except ValueError as error:
        raise BadMessage(f"point cloud: {error}") from error
    step = message.row_step or row_bytes
    parts = [np.frombuffer(message.data, dtype, message.width, row * step) for row in range(rows)]
    return np.concatenate(parts)
