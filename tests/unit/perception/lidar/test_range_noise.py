"""How noisy ranges are, and ranges made less noisy for driving."""

from __future__ import annotations

import numpy as np
import pytest

from perception.geometry.planar import Pose2
from perception.lidar.range_noise import CalmingSettings, calmed, range_noise_m
from unit.perception.lidar_house import Box, House, cast, rectangle

USUAL = CalmingSettings(usual_m=0.02)
ROOM = House(rooms={"a": rectangle(5.0, 4.0)})
MIDDLE = Pose2(2.2, 1.8, 0.3)


@pytest.mark.parametrize("sigma_m", [0.01, 0.02, 0.05, 0.1])
def test_noise_is_told_from_one_scan(sigma_m: float) -> None:
    scan = cast(ROOM, MIDDLE, np.random.default_rng(0), sigma_m=sigma_m)
    assert range_noise_m(scan.ranges_m) == pytest.approx(sigma_m, rel=0.1)


@pytest.mark.parametrize("sigma_m", [0.035, 0.05, 0.075])
def test_noisy_ranges_come_nearer_to_the_truth_and_stay_unbiased(sigma_m: float) -> None:
    truth = cast(ROOM, MIDDLE, np.random.default_rng(0), sigma_m=0.0).ranges_m
    noisy = cast(ROOM, MIDDLE, np.random.default_rng(0), sigma_m=sigma_m).ranges_m
    returned = np.isfinite(truth)
    error = calmed(noisy, USUAL)[returned] - truth[returned]
    assert np.median(np.abs(error)) < 0.5 * sigma_m
    assert abs(float(np.mean(error))) < 0.005


def test_usual_ranges_stay_as_they_are_and_nothing_returns_where_nothing_did() -> None:
    scan = cast(ROOM, MIDDLE, np.random.default_rng(0), sigma_m=0.015)
    assert calmed(scan.ranges_m, USUAL) is scan.ranges_m
    gaps = np.full((2, 90), np.inf)
    gaps[:, ::3] = 2.0 + 0.1 * np.random.default_rng(0).standard_normal((2, 30))
    assert (np.isfinite(calmed(gaps, USUAL)) == np.isfinite(gaps)).all()


def test_a_thin_leg_before_a_wall_does_not_fade() -> None:
    leg = House(rooms=ROOM.rooms, boxes=[Box(center=(3.6, 1.9), size=(0.05, 0.05, 2.2))])
    truth = cast(leg, MIDDLE, np.random.default_rng(0), sigma_m=0.0).ranges_m
    on_leg = truth < cast(ROOM, MIDDLE, np.random.default_rng(0), sigma_m=0.0).ranges_m - 0.4
    assert on_leg.sum() > 10
    seen = calmed(cast(leg, MIDDLE, np.random.default_rng(1), sigma_m=0.05).ranges_m, USUAL)
    assert np.abs(seen[on_leg] - truth[on_leg]).max() < 0.2
