"""What the camera shows to the arm: points in the base frame."""

from types import SimpleNamespace

import numpy as np
import pytest

from app.stacks.ranges import ScanRanges
from perception.ports import Intrinsics, RgbdFrame
from scene_graph.geometry.se3 import SE3

INTRINSICS = Intrinsics(width=64, height=48, fx=60.0, fy=60.0, cx=31.5, cy=23.5)
LEVEL = SE3((0.5, -0.5, 0.5, -0.5), (0.1, 0.0, 1.2))
"""Looks along the base's x, optical frame: its z is x, its x is -y, its y is -z."""


def seen(depth_m):
    shape = (INTRINSICS.height, INTRINSICS.width)
    frame = RgbdFrame(
        stamp_s=1.0,
        rgb=np.zeros((*shape, 3), np.uint8),
        depth_m=np.full(shape, depth_m, np.float32),
        intrinsics=INTRINSICS,
        T_base_camera=LEVEL,
    )
    return ScanRanges(SimpleNamespace(frame=frame, scan=None)).seen_base()


def test_a_wall_before_the_camera_is_seen_where_it_is():
    points = seen(0.9)
    assert points[:, 0] == pytest.approx(1.0)
    assert np.ptp(points[:, 1]) == pytest.approx(0.9 * 63 / 60, abs=1e-6)
    assert points[:, 2].min() < 1.2 < points[:, 2].max()


@pytest.mark.parametrize("depth_m", [0.0, 2.5, np.nan])
def test_what_is_out_of_reach_or_not_known_is_left_out(depth_m):
    assert seen(depth_m).shape == (0, 3)


def test_without_a_picture_nothing_is_seen():
    assert ScanRanges(SimpleNamespace(frame=None, scan=None)).seen_base().shape == (0, 3)
