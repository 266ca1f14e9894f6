"""The service around a recorded robot."""

from __future__ import annotations

import pytest

from app.runtime import Runtime
from app.settings import ClockMode, Settings
from evaluations.service.rates import FROM_MEMORY, SPEED, Player, measured
from evaluations.service.replay import CAMERA_HZ
from paths import DATA
from recorded_drive import recording

pytestmark = pytest.mark.anyio
NETWORK = DATA / "network" / "instances.onnx"


@pytest.mark.slow
async def test_the_whole_service_runs_on_a_recording_and_is_measured(tmp_path):
    settings = Settings(
        data=tmp_path, port=0, clock=ClockMode.REAL, speed=SPEED, camera_hz=CAMERA_HZ, explore=False, model=NETWORK
    )
    runtime = Runtime(settings, build=Player(recording(16.0)))
    run = await measured(FROM_MEMORY, runtime, 1.0)
    assert (run["source"], run["network"]) == ("from memory", "instances.onnx")
    assert run["rgbd_hz"] > 0.0
    assert run["lidar_hz"] > 0.0
    assert (run["api_requests"], run["api_failures"]) == (10, [])
    assert {"sensing", "filming", "objects", "energy_optimizer", "mission"} <= run["agents"].keys()
