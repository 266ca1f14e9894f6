"""Outline scans and the corner detector (Concepts, algorithm 1)."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from perception.geometry.planar import Pose2
from perception.lidar.corners import corners_of, detect_lines
from perception.lidar.slice import OutlineSlicer
from perception.ports import LidarScan
from unit.perception.lidar_house import Array, Box, Door, House, cast, l_shape, rectangle


def corners_at(house: House, pose: Pose2, seed: int = 0) -> Array:
    outline = OutlineSlicer().cut(cast(house, pose, np.random.default_rng(seed)))
    sightings = corners_of(detect_lines(outline.points_base))
    return pose.apply(np.array([sighting.point for sighting in sightings]))


def farthest_from(truth: Array, points: Array) -> float:
    return float(np.linalg.norm(truth[:, None] - points[None], axis=2).min(axis=1).max())


@pytest.mark.parametrize("yaw_rad", np.linspace(-3.0, 3.0, 7))
def test_all_four_corners_of_a_room_are_found_however_the_robot_stands(yaw_rad: float) -> None:
    room = rectangle(5.0, 3.5)
    corners = corners_at(House(rooms={"a": room}), Pose2(1.7, 1.2, float(yaw_rad)))
    assert len(corners) == 4
    assert farthest_from(room, corners) < 0.015


def test_the_six_corners_of_an_l_are_found_from_its_bend() -> None:
    corners = corners_at(House(rooms={"a": l_shape()}), Pose2(1.5, 1.2, 1.0))
    assert farthest_from(l_shape(), corners) < 0.015


def test_the_far_ends_of_a_narrow_corridor_give_corners_too() -> None:
    room = rectangle(14.0, 1.2)
    assert farthest_from(room, corners_at(House(rooms={"a": room}), Pose2(7.0, 0.6, 0.1))) < 0.05


def test_furniture_below_two_meters_may_hide_a_wall_but_is_never_taken_for_one() -> None:
    boxes = [Box(center=(2.5, 1.7), size=(1.0, 0.6, 1.95))]
    empty, full = House(rooms={"a": rectangle(5.0, 3.0)}), House(rooms={"a": rectangle(5.0, 3.0)}, boxes=boxes)
    pose, rng = Pose2(1.0, 1.0, 0.0), np.random.default_rng(0)
    bare = OutlineSlicer().cut(cast(empty, pose, rng, sigma_m=0.0)).ranges_m
    furnished = OutlineSlicer().cut(cast(full, pose, rng, sigma_m=0.0)).ranges_m
    seen = np.isfinite(furnished)
    assert seen.mean() > 0.85
    assert np.allclose(furnished[seen], bare[seen], atol=1e-4)


def test_the_lintel_hides_the_next_room() -> None:
    house = House(
        rooms={"a": rectangle(4.0, 3.0), "b": rectangle(5.0, 3.0, x=4.2)},
        doors=[Door(rooms=("a", "b"), center=(4.1, 1.5))],
    )
    pose = Pose2(2.5, 1.5, 0.3)
    scan = OutlineSlicer().cut(cast(house, pose, np.random.default_rng(0)))
    assert scan.coverage == 1.0
    assert pose.apply(scan.points_base)[:, 0].max() < 4.0 + 0.1


def test_outline_ranges_are_unbiased_where_two_rings_hit_the_same_wall() -> None:
    house, pose = House(rooms={"a": rectangle(6.0, 6.0)}), Pose2(3.0, 3.0, 0.0)
    slicer, rng = OutlineSlicer(), np.random.default_rng(0)
    exact = slicer.cut(cast(house, pose, rng, sigma_m=0.0)).ranges_m
    noisy = np.mean([slicer.cut(cast(house, pose, rng)).ranges_m for _ in range(20)], axis=0)
    assert abs(float((noisy - exact).mean())) < 0.001


def test_the_slicer_learns_how_high_the_walls_are() -> None:
    slicer = OutlineSlicer()
    for x_m in (1.0, 1.5, 2.0):
        slicer.cut(
            cast(House(rooms={"a": rectangle(4.0, 3.0)}, height=2.8), Pose2(x_m, 1.0, 0.0), np.random.default_rng(0))
        )
    assert slicer.wall_top_m == pytest.approx(2.8, abs=0.05)
    assert slicer.ceiling_m is None


def test_a_ceiling_is_told_from_walls() -> None:
    scan = cast(House(rooms={"a": rectangle(8.0, 7.0)}, height=2.6), Pose2(4.0, 3.5, 0.0), np.random.default_rng(0))
    to_ceiling = np.where(scan.elevations_rad > 0, 1.0 / np.maximum(np.sin(scan.elevations_rad), 1e-9), np.inf)[:, None]
    closed = LidarScan(
        stamp_s=0.0,
        ranges_m=np.minimum(scan.ranges_m, to_ceiling).astype(np.float32),
        elevations_rad=scan.elevations_rad,
        azimuths_rad=scan.azimuths_rad,
        T_base_lidar=scan.T_base_lidar,
    )
    slicer = OutlineSlicer()
    outline = slicer.cut(closed)
    assert slicer.ceiling_m == pytest.approx(2.6, abs=0.02)
    assert np.linalg.norm(outline.points_base, axis=1).min() > 3.3


def test_the_slice_of_a_lidar_of_one_flat_ring_is_at_its_height():
    scan = cast(House(rooms={"a": rectangle(4.0, 3.0)}), Pose2(1.0, 1.0, 0.0), np.random.default_rng(0))
    flat = replace(scan, ranges_m=scan.ranges_m[:1], elevations_rad=np.zeros(1))
    outline = OutlineSlicer().cut(flat)
    assert outline.blind_m == 0.0
    np.testing.assert_allclose(outline.ranges_m, flat.ranges_m[0])
