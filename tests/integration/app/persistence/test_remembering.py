"""The building survives a restart: it is known at once, and the robot finds out where in it it stands."""

import os
import signal

import anyio
import pytest

from app.persistence.building import building_folder
from app.runtime import Runtime
from app.settings import ClockMode, Settings
from app.views.scene_documents import document_nodes
from planner.mission.teaching import teach
from scene_graph.nodes import RoomNode

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
LIMIT_S = 300.0


@pytest.fixture
def anyio_backend():
    return "asyncio"


def settings(folder, **more):
    return Settings(
        house="flat", clock=ClockMode.LOCKSTEP, speed=None, data=folder, camera=False, remember=True, **more
    )


async def until(runtime, condition):
    while not condition() and runtime.now_s < LIMIT_S:
        await runtime.wait_for_change()
    assert condition()


def rooms(runtime):
    return [room.id for room in runtime.memory.building().of_type(RoomNode)]


def explored(runtime):
    return runtime.memory.snapshot().root.explored


def localized(runtime):
    robot = runtime.memory.snapshot().robot
    return robot is not None and robot.localized


def places(runtime):
    nodes = document_nodes(runtime.memory.building())
    return {node["id"]: node["position_m"] for node in nodes if node["type"] == "room"}


@pytest.mark.long
async def test_a_known_building_is_known_at_once_and_the_robot_finds_its_place(tmp_path):
    async with Runtime(settings(tmp_path)).running() as runtime:
        await until(runtime, lambda: explored(runtime))
        teach(runtime.memory, "room_2", label="library", name=None, stamp_s=runtime.now_s)
        known, before = rooms(runtime), places(runtime)
        assert len(known) == 3
        found = runtime.views.scene.history("room_2")["entries"][0]
        assert (found["kind"], found["stamp_s"] > 0.0) == ("found", True)
    async with Runtime(settings(tmp_path)).running() as runtime:
        assert rooms(runtime) == known
        assert places(runtime) == before
        assert runtime.memory.building().room("room_2").label == "library"
        assert not localized(runtime)
        await until(runtime, lambda: localized(runtime))
        await until(runtime, lambda: explored(runtime))
        history = runtime.views.scene.history("room_2")
        assert history["entries"][0] == {**found, "stamp_s": history["entries"][0]["stamp_s"]}
        assert history["since_s"] < history["entries"][0]["stamp_s"] < 0.0
        assert "library" in [entry["after"] for entry in history["entries"] if entry["kind"] == "label"]
        assert rooms(runtime) == known
        assert places(runtime) == {room: pytest.approx(place, abs=0.01) for room, place in before.items()}


@pytest.mark.long
async def test_what_was_explored_so_far_is_not_explored_again(tmp_path):
    async with Runtime(settings(tmp_path)).running() as runtime:
        await until(runtime, lambda: len(rooms(runtime)) >= 2 and runtime.now_s > 30.0)
        known = rooms(runtime)
    async with Runtime(settings(tmp_path)).running() as runtime:
        assert set(rooms(runtime)) <= set(known)
        await until(runtime, lambda: explored(runtime))
        total = len(rooms(runtime))
    async with Runtime(settings(tmp_path / "fresh")).running() as runtime:
        await until(runtime, lambda: explored(runtime))
        assert len(rooms(runtime)) == total


@pytest.mark.long
async def test_the_same_memory_and_the_same_seed_give_the_same_run(tmp_path):
    async with Runtime(settings(tmp_path / "a")).running() as runtime:
        await until(runtime, lambda: runtime.now_s > 25.0)
    source = building_folder(tmp_path / "a", "flat")
    logs = []
    for name in ("b", "c"):
        target = building_folder(tmp_path / name, "flat")
        (target / "rooms").mkdir(parents=True)
        for path in source.rglob("*.json"):
            (target / path.relative_to(source)).write_bytes(path.read_bytes())
        log = tmp_path / f"{name}.jsonl"
        async with Runtime(settings(tmp_path / name), event_log=log).running() as runtime:
            await until(runtime, lambda: runtime.now_s > 12.0)
        logs.append(log.read_text().splitlines()[:200])
    assert logs[0] == logs[1]
    assert len(logs[0]) > 5


async def test_a_restarted_simulator_begins_with_an_empty_graph(tmp_path):
    async with Runtime(settings(tmp_path)).running() as runtime:
        await until(runtime, lambda: runtime.memory.snapshot().current_room is not None)
    async with Runtime(settings(tmp_path)).running() as runtime:
        assert rooms(runtime)
        os.kill(runtime.require_robot().pid, signal.SIGKILL)
        with anyio.fail_after(30):
            while runtime.robot.alive:  # noqa: ASYNC110 - the process dies outside any event loop
                await anyio.sleep(0.05)
        assert await runtime.restart_robot()
        assert rooms(runtime) == []
