"""Laser scans and point clouds of ROS become revolutions: compared with the rays that they were made of."""

from __future__ import annotations

import base64
import math

import numpy as np
import pytest

from drivers.rosbridge.errors import BadMessage
from drivers.rosbridge.messages import LaserScanMessage, PointCloudMessage
from drivers.rosbridge.ranges import scan_of_cloud, scan_of_laser
from scene_graph.geometry.se3 import SE3

MOUNT = SE3.from_xyz_yaw(0.0, 0.0, 1.6, 0.0)
HEADER = {"stamp": {"sec": 1, "nanosec": 5}, "frame_id": "laser"}
ELEVATIONS = np.radians([-30.0, 2.0, 15.0])
AZIMUTHS = np.arange(360) * math.tau / 360 - math.pi + 0.003


def rays():
    """Ranges (3, 360) that differ everywhere, some without return, and the points that they lead to."""
    ranges_m = 1.0 + np.random.default_rng(0).random((3, 360)) * 5.0
    ranges_m[1, 40:60] = np.nan
    elevation, azimuth = ELEVATIONS[:, None], AZIMUTHS[None, :]
    directions = np.stack(
        np.broadcast_arrays(
            np.cos(elevation) * np.cos(azimuth), np.cos(elevation) * np.sin(azimuth), np.sin(elevation)
        ),
        axis=-1,
    )
    return ranges_m, directions * ranges_m[..., None]


def cloud(points, *, ring=None, order="<", pad=0, **changes):
    """A message of (rows, columns, 3) points; ``pad``: bytes between two rows."""
    kinds = [("x", "f4", 7), ("y", "f4", 7), ("z", "f4", 7), ("ring", "u2", 4)]
    packed = np.zeros(points.shape[:2], dtype=[(name, order + kind) for name, kind, _ in kinds])
    for index, name in enumerate("xyz"):
        packed[name] = points[..., index]
    if ring is not None:
        packed["ring"] = ring
    rows, columns = packed.shape
    data = b"".join(row.tobytes() + bytes(pad) for row in packed)
    offsets = [packed.dtype.fields[name][1] for name, _, _ in kinds]
    fields = [
        {"name": name, "offset": at, "datatype": number, "count": 1}
        for (name, _, number), at in zip(kinds, offsets, strict=True)
        if name != "ring" or ring is not None
    ]
    told = {
        "header": HEADER,
        "height": rows,
        "width": columns,
        "fields": fields,
        "is_bigendian": order == ">",
        "point_step": packed.itemsize,
        "row_step": packed.itemsize * columns + pad,
        "data": base64.b64encode(data).decode(),
    }
    return PointCloudMessage.read("/points", told | changes)


def assert_same(scan, ranges_m):
    np.testing.assert_allclose(scan.elevations_rad, ELEVATIONS, atol=1e-5)
    np.testing.assert_allclose(scan.azimuths_rad, AZIMUTHS, atol=1e-5)
    np.testing.assert_allclose(scan.ranges_m, np.where(np.isnan(ranges_m), np.inf, ranges_m), rtol=1e-5)
    assert scan.ranges_m.dtype == np.float32


@pytest.mark.parametrize(("order", "pad"), [("<", 0), (">", 0), ("<", 16)])
def test_an_organized_cloud_gives_back_every_ray(order, pad):
    ranges_m, points = rays()
    assert_same(scan_of_cloud(cloud(points, order=order, pad=pad), 3.0, MOUNT, azimuths=9), ranges_m)


def test_a_cloud_in_no_order_gives_back_every_ray_by_its_ring():
    ranges_m, points = rays()
    ring = np.repeat([[0], [1], [2]], 360, axis=1)
    order = np.random.default_rng(1).permutation(points[..., 0].size)
    shuffled = points.reshape(-1, 3)[order][None]
    message = cloud(shuffled, ring=ring.reshape(-1)[order][None])
    assert_same(scan_of_cloud(message, 3.0, MOUNT, azimuths=360), ranges_m)


def test_of_several_rays_in_one_direction_the_nearest_counts_and_the_origin_is_no_return():
    points = np.array([[[2.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0], [0.0, 3.0, 0.0]]])
    scan = scan_of_cloud(cloud(points, ring=np.zeros((1, 4))), 0.0, MOUNT, azimuths=4)
    assert sorted(scan.ranges_m[0]) == [1.0, 3.0, np.inf, np.inf]


def test_of_a_lidar_without_any_return_nothing_is_concluded():
    with pytest.raises(BadMessage, match="covered"):
        scan_of_cloud(cloud(np.full((2, 8, 3), np.nan)), 0.0, MOUNT, azimuths=8)
    told = {"header": HEADER, "angle_min": -1.5, "angle_increment": 0.5, "range_min": 0.1, "range_max": 8.0}
    with pytest.raises(BadMessage, match="covered"):
        scan_of_laser(LaserScanMessage.read("/scan", told | {"ranges": [None, 9.0, 0.05]}), 0.0, MOUNT)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"height": 1, "width": 1080, "row_step": 0}, "no field 'ring'"),
        ({"width": 400}, "too few"),
        ({"row_step": 8}, "too few"),
        ({"fields": [{"name": "x", "offset": 0, "datatype": 7}]}, "no field y, z"),
        ({"point_step": 4}, "point cloud"),
    ],
)
def test_a_cloud_that_is_not_what_it_says_is_refused(changes, said):
    _, points = rays()
    with pytest.raises(BadMessage, match=said):
        scan_of_cloud(cloud(points, **changes), 0.0, MOUNT, azimuths=360)


@pytest.mark.parametrize("turn", [1, -1])
def test_a_laser_scan_is_one_ring_counter_clockwise(turn):
    told = {"header": HEADER, "angle_min": -1.5 * turn, "angle_increment": 0.5 * turn, "range_min": 0.1}
    message = LaserScanMessage.read("/scan", told | {"range_max": 8.0, "ranges": [1.0, None, 9.0, 0.05]})
    scan = scan_of_laser(message, 0.0, MOUNT)
    expected = {-1.5 * turn: 1.0, -1.0 * turn: np.inf, -0.5 * turn: np.inf, 0.0: np.inf}
    assert dict(zip(scan.azimuths_rad.tolist(), scan.ranges_m[0].tolist(), strict=True)) == expected
    assert list(scan.azimuths_rad) == sorted(scan.azimuths_rad)
