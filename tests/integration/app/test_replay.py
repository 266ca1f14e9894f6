"""A drive in the simulated flat is recorded; perception over the recording comes to the same graph."""

from __future__ import annotations

import asyncio
import json
import subprocess
import sys

import pytest

pytest.importorskip("mcap")

from app.replay import replay, told
from app.runtime import Runtime
from app.settings import ClockMode, Settings

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
DRIVE_S = 12.0


class Last:
    """Takes the last turn of all, keeps the graph at the end of the drive, and lets no time pass after it."""

    name, period_s = "last", 0.05

    def __init__(self, runtime):
        self.runtime, self.reached = runtime, asyncio.Event()
        self.scene, self.seconds = {}, 0.0

    async def step(self, stamp_s):
        if stamp_s > DRIVE_S:
            self.scene, self.seconds = self.runtime.views.scene.document(), stamp_s
            self.reached.set()
            await asyncio.Event().wait()


async def drive(folder, **changes):
    """A drive in lockstep that is recorded to ``drive.mcap``, and how it ended."""
    settings = Settings(
        house="flat",
        seed=1,
        clock=ClockMode.LOCKSTEP,
        speed=None,
        data=folder,
        record=folder / "drive.mcap",
        **changes,
    )
    made = []

    def witnesses(runtime):
        made.append(Last(runtime))
        return made

    async with Runtime(settings, witnesses=witnesses).running():
        await made[0].reached.wait()
    return made[0]


@pytest.mark.parametrize("camera", [pytest.param(False, marks=pytest.mark.long), True])
async def test_perception_over_a_recording_comes_to_the_same_graph(tmp_path, camera):
    drive_end = await drive(tmp_path, camera=camera)
    scene = drive_end.scene
    again = await replay(tmp_path / "drive.mcap")
    assert again.seconds == drive_end.seconds
    assert not again.truncated
    assert {node["type"] for node in scene["nodes"]} >= ({"room", "object"} if camera else {"room"})
    assert again.scene["nodes"] == scene["nodes"]
    assert again.scene["edges"] == scene["edges"]
    assert told(again).startswith("replayed 12.")


@pytest.mark.long
async def test_the_command_writes_the_graph_and_refuses_what_is_damaged(tmp_path):
    await drive(tmp_path, camera=False)
    recording, graph = tmp_path / "drive.mcap", tmp_path / "again.json"
    command = [sys.executable, "-m", "app", "replay", str(recording), "--graph", str(graph)]
    outcome = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)  # noqa: ASYNC221
    assert outcome.returncode == 0, outcome.stderr
    assert "replayed " in outcome.stderr
    assert any(node["type"] == "room" for node in json.loads(graph.read_text())["nodes"])
    data = bytearray(recording.read_bytes())
    data[len(data) // 2 : len(data) // 2 + 64] = bytes(64)
    recording.write_bytes(data)
    outcome = subprocess.run(command, capture_output=True, text=True, timeout=300, check=False)  # noqa: ASYNC221
    assert outcome.returncode == 2
    assert "is damaged after" in outcome.stderr
    assert "Traceback" not in outcome.stderr
