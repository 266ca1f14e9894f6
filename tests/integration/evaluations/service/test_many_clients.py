"""Many clients of one service that explores: who reads misses nothing, and who does not costs nobody anything."""

from __future__ import annotations

import multiprocessing
from concurrent.futures import ProcessPoolExecutor

import pytest

from evaluations.service.clients import ClientAims, compared, run_once

AIMS = ClientAims()


def in_a_process_of_its_own(*arguments):
    with ProcessPoolExecutor(max_workers=1, mp_context=multiprocessing.get_context("spawn")) as pool:
        return pool.submit(run_once, *arguments).result(300.0)


@pytest.mark.slow
def test_eighteen_clients_that_read_miss_nothing_beside_two_that_never_do():
    measured = in_a_process_of_its_own("flat", 6.0, 18, 2)
    heard = measured["heard"]
    assert heard["clients"] == 18
    assert (heard["gaps"], heard["snapshots"], heard["closed"]) == (0, 0, 0)
    assert heard["fewest"] > 20
    assert measured["api_failures"] == []
    assert measured["rgbd_hz"] > 0.0
    assert measured["grown_mb"] < AIMS.most_mb


@pytest.mark.long
def test_two_hundred_clients_are_not_noticed():
    """On a machine that does nothing else meanwhile; the first seconds of a listener's life count as well."""
    without, beside = (in_a_process_of_its_own("flat", 60.0, *audience) for audience in ((0, 0), (180, 20)))
    print({name: (without[name], beside[name]) for name in ("lidar_hz", "rgbd_hz", "api_p99_ms", "resident_mb")})
    figures = compared(without, beside)
    assert figures["held"], (figures, beside["heard"], beside["api_p99_ms"], beside["grown_mb"])
    assert min(figures["kept"].values()) >= AIMS.kept
    assert beside["api_p99_ms"] < AIMS.api_p99_ms
