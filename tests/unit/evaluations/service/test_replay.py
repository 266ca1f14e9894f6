"""A drive played back: who asks when gets what."""

from __future__ import annotations

import asyncio

import numpy as np
import pytest

from evaluations.service.replay import CompactFrame, RecordedRobot
from perception.errors import SensorSilent
from recorded_drive import BEGIN_S, frame, recording

SLOWLY, IN_NO_TIME = 1e-6, 1e3


def test_a_compact_frame_is_the_frame_to_half_a_millimeter():
    taken = frame(3.0)
    kept = CompactFrame.of(taken).frame()
    assert (kept.depth_m.dtype, kept.depth_m.shape) == (np.float32, (240, 320))
    assert np.abs(kept.depth_m - taken.depth_m).max() <= 0.0005 + 1e-6
    assert (kept.depth_m[taken.depth_m == 0.0] == 0.0).all()
    assert (kept.rgb == taken.rgb).all()
    assert (kept.stamp_s, kept.intrinsics, kept.T_base_camera) == (3.0, taken.intrinsics, taken.T_base_camera)


def test_a_recording_begins_to_play_when_its_time_is_asked_for():
    robot = RecordedRobot(recording(1.0), speed=SLOWLY)
    assert robot.now_s == pytest.approx(BEGIN_S)
    assert asyncio.run(robot.scan()).stamp_s == BEGIN_S
    assert asyncio.run(robot.state()).stamp_s == BEGIN_S


def test_every_frame_is_given_once_and_none_before_its_time():
    async def filmed():
        robot = RecordedRobot(recording(1.0), speed=20.0)
        given = []
        while True:
            try:
                given.append((await robot.frame()).stamp_s)
            except SensorSilent:
                return given
            assert robot.now_s >= given[-1] - 1e-6

    stamps_s = asyncio.run(filmed())
    assert stamps_s[0] == BEGIN_S
    assert (np.diff(stamps_s) > 0.0).all()


def test_after_its_end_the_camera_is_silent_and_the_last_scan_stays():
    robot = RecordedRobot(recording(1.0), speed=IN_NO_TIME)

    async def at_the_end():
        await robot.advance(5.0)
        last = await robot.frame()
        with pytest.raises(SensorSilent):
            await robot.frame()
        return last, await robot.scan(), await robot.odometry(), await robot.joints()

    for measured in asyncio.run(at_the_end()):
        assert BEGIN_S + 0.9 <= measured.stamp_s < BEGIN_S + 1.0
