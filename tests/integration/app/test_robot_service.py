"""The service with a simulated robot: stop, loss of the simulator, and that the robot explores by itself."""

from __future__ import annotations

import os
import signal
import time
from pathlib import Path

import anyio
import httpx
import pytest

from app.http.guards.security import Token
from app.http.service import make_service
from app.runtime import Runtime
from app.settings import ClockMode, Settings

pytestmark = pytest.mark.anyio
TOKEN = Token("0123456789abcdef")


@pytest.fixture
def anyio_backend():
    return "asyncio"


@pytest.fixture
async def service(tmp_path: Path):
    runtime = Runtime(Settings(house="flat", clock=ClockMode.LOCKSTEP, speed=None, data=tmp_path, simulation_api=True))
    app = make_service(runtime, TOKEN)
    headers = {"Authorization": f"Bearer {TOKEN.value}"}
    transport = httpx.ASGITransport(app=app)
    async with (
        app.router.lifespan_context(app),
        httpx.AsyncClient(transport=transport, base_url="http://localhost", headers=headers) as client,
    ):
        yield runtime, client


async def until(runtime, condition, limit_s):
    """Let simulated time pass until ``condition`` holds."""
    start_s = runtime.now_s
    while not condition():
        assert runtime.now_s - start_s < limit_s, "simulated time ran out"
        await runtime.wait_for_change()


async def test_the_robot_finds_its_first_room_by_itself_and_says_that_it_explores(service):
    runtime, client = service
    await until(runtime, lambda: runtime.memory.snapshot().current_room is not None, 60.0)
    scene = (await client.get("/v1/scene")).json()
    [room] = [node for node in scene["nodes"] if node["type"] == "room"]
    xs, ys = zip(*room["polygon_m"], strict=True)
    perimeter_m = sum(((xs[i] - xs[i - 1]) ** 2 + (ys[i] - ys[i - 1]) ** 2) ** 0.5 for i in range(4))
    assert perimeter_m == pytest.approx(2 * (2.2 + 7.2), abs=0.1), "the hall, whatever way the map is turned"
    assert (await client.get("/v1/simulation/truth")).json()["house"] == "flat"
    status = (await client.get("/v1/status")).json()
    assert status["robot"]["room"] == room["id"]
    assert status["exploring"]
    assert all(agent["restarts"] == 0 for agent in status["agents"].values())


async def test_the_stop_holds_the_robot_until_it_is_released(service):
    runtime, client = service
    await until(runtime, lambda: runtime.now_s > 3.0, 10.0)
    assert (await client.post("/v1/stop")).json() == {"stopped": True}
    await until(runtime, lambda at=runtime.now_s: runtime.now_s > at + 0.2, 5.0)
    before = (await client.get("/v1/simulation/truth")).json()["robot"]["pose"]
    await until(runtime, lambda at=runtime.now_s: runtime.now_s > at + 2.0, 5.0)
    after = (await client.get("/v1/simulation/truth")).json()["robot"]["pose"]
    assert after == pytest.approx(before, abs=2e-3)
    assert (await client.get("/v1/status")).json()["stopped"]
    await client.post("/v1/resume")
    await until(runtime, lambda at=runtime.now_s: runtime.now_s > at + 4.0, 10.0)
    assert (await client.get("/v1/simulation/truth")).json()["robot"]["pose"] != pytest.approx(before, abs=2e-2)


async def test_a_dead_simulator_is_reported_and_comes_back_on_request(service):
    runtime, client = service
    await until(runtime, lambda: runtime.now_s > 1.0, 5.0)
    os.kill(runtime.require_robot().pid, signal.SIGKILL)
    with anyio.fail_after(30):
        while runtime.ready:  # noqa: ASYNC110 - the process dies outside any event loop
            await anyio.sleep(0.05)
    ready = await client.get("/readyz")
    assert (ready.status_code, ready.json()["code"]) == (503, "not_ready")
    assert "simulator died" in ready.json()["detail"]
    assert (await client.get("/healthz")).status_code == 200
    assert (await client.get("/v1/scene")).status_code == 200
    assert (await client.get("/v1/simulation/truth")).status_code == 503
    assert (await client.post("/v1/stop")).status_code == 200
    assert (await client.post("/v1/resume")).status_code == 200
    assert (await client.post("/v1/simulation/restart")).status_code == 200
    await until(runtime, lambda: runtime.now_s > 1.0, 10.0)
    assert (await client.get("/readyz")).status_code == 200
    assert (await client.post("/v1/simulation/restart")).status_code == 409


async def test_the_api_answers_while_simulated_time_runs_as_fast_as_it_can(service):
    runtime, client = service
    await until(runtime, lambda: runtime.now_s > 1.0, 5.0)
    slowest_s = 0.0
    for _ in range(50):
        started = time.perf_counter()
        assert (await client.get("/v1/status")).status_code == 200
        slowest_s = max(slowest_s, time.perf_counter() - started)
        await anyio.sleep(0.02)
    assert slowest_s < 1.0


async def test_what_is_recognized_in_a_frame_is_told_and_its_own_picture_can_be_fetched(service):
    runtime, client = service
    missing = await client.get("/v1/camera")
    assert (missing.status_code, missing.json()["code"]) == (404, "no_camera")
    await until(runtime, lambda: runtime.stack.frames_understood > 1, 20.0)
    seen = (await client.get("/v1/camera")).json()
    assert 0.0 <= seen["age_s"] < 2.0
    options = {"stamp_s": seen["stamp_s"], "outlines": False}
    picture = await client.get("/v1/camera.jpg", params=options)
    assert (picture.status_code, picture.headers["content-type"]) == (200, "image/jpeg")
    gone = await client.get("/v1/camera.jpg", params={"stamp_s": 0.001})
    assert (gone.status_code, gone.json()["code"]) == (404, "frame_gone")
    assert (await client.get("/v1/camera.jpg", params={"stamp_s": "nan"})).status_code == 422
    assert runtime.views.scene.robot()["camera"]["width_rad"] > 0.5
