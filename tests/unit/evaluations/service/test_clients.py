"""What counts as missing something, and as noticing that others listen."""

from __future__ import annotations

import pytest

from evaluations.service.clients import compared
from evaluations.service.stream_load import Reader

ALONE = {"lidar_hz": 10.0, "rgbd_hz": 5.0}
HEARD = {"fewest": 100, "gaps": 0, "snapshots": 0, "closed": 0}
BESIDE = {**ALONE, "api_p99_ms": 40.0, "api_failures": [], "grown_mb": 20.0, "heard": HEARD}


def heard(*messages):
    reader = Reader()
    for seq, kind in messages:
        reader.hear(f'{{"seq":{seq},"type":"{kind}","stamp_s":1.0,"data":{{}}}}')
    return reader.events, reader.gaps, reader.snapshots


def test_a_client_that_gets_every_number_after_its_first_snapshot_misses_nothing():
    assert heard((7, "snapshot"), (8, "scene"), (9, "robot")) == (3, 0, 0)


def test_numbers_that_are_skipped_or_come_twice_are_counted():
    assert heard((7, "snapshot"), (8, "scene"), (11, "robot"), (11, "robot")) == (4, 3, 0)


def test_a_later_snapshot_tells_that_the_client_fell_behind():
    assert heard((7, "snapshot"), (8, "scene"), (900, "snapshot"), (901, "robot")) == (4, 0, 1)


def test_what_is_no_event_is_left_out():
    reader = Reader()
    reader.hear('{"type":"accepted","task":"task_1"}')
    assert (reader.events, reader.last_seq) == (0, None)


@pytest.mark.parametrize(
    ("change", "held"),
    [
        ({}, True),
        ({"lidar_hz": 9.4}, False),
        ({"rgbd_hz": 4.0}, False),
        ({"api_p99_ms": 101.0}, False),
        ({"api_failures": ["/v1/status: 500"]}, False),
        ({"grown_mb": 150.0}, False),
        *(({"heard": HEARD | {flaw: 1}}, False) for flaw in ("gaps", "snapshots", "closed")),
        ({"heard": HEARD | {"fewest": 0}}, False),
    ],
)
def test_nobody_may_notice_that_others_listen(change, held):
    figures = compared(ALONE, BESIDE | change)
    assert figures["held"] is held
    assert figures["kept"]["lidar_hz"] == pytest.approx(change.get("lidar_hz", 10.0) / 10.0)
