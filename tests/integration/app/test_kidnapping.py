"""The simulated robot is picked up by a disturbance and set down elsewhere, while it explores the flat."""

from __future__ import annotations

from pathlib import Path

import pytest

from app.runtime import Runtime
from app.settings import ClockMode, Settings
from planner.tasks.tasks import TaskStatus
from scene_graph.nodes import CrossingStatus, DoorNode, RoomNode

pytestmark = pytest.mark.anyio


@pytest.fixture
def anyio_backend():
    return "asyncio"


async def until(runtime, condition, limit_s):
    """Let simulated time pass until ``condition`` holds."""
    start_s = runtime.now_s
    while not condition():
        assert runtime.now_s - start_s < limit_s, "simulated time ran out"
        await runtime.wait_for_change()


@pytest.mark.long
async def test_carried_into_another_room_the_robot_says_so_finds_itself_and_explores_to_the_end(tmp_path: Path):
    runtime = Runtime(Settings(house="flat", clock=ClockMode.LOCKSTEP, speed=None, data=tmp_path, camera=False))
    async with runtime.running():
        await until(runtime, lambda: len(runtime.memory.snapshot().of_type(RoomNode)) == 2, 90.0)
        await until(runtime, lambda at=runtime.now_s: runtime.now_s > at + 3.0, 10.0)
        known = runtime.memory.snapshot()
        assert known.current_room is not None
        away = next(room.id for room in known.of_type(RoomNode) if room.id != known.current_room)
        before = (await runtime.require_robot().truth())["robot"]["pose"]
        inside = [2.2, 2.1, 0.7] if before[0] > 4.3 else [5.3, 4.6, 0.7]
        await runtime.require_robot().disturb({"do": "move", "id": "robot", "to": {"pose": inside}})
        await until(runtime, lambda: not runtime.views.status.document()["robot"]["localized"], 3.0)
        assert runtime.views.status.document()["robot"]["room"] is None
        await until(runtime, lambda: runtime.views.status.document()["robot"]["localized"], 10.0)
        assert runtime.memory.snapshot().current_room == away
        await until(runtime, lambda: runtime.memory.snapshot().root.explored, 200.0)
        graph = runtime.memory.building()
        assert len(graph.of_type(RoomNode)) == 3
        assert {door.crossing for door in graph.of_type(DoorNode)} == {CrossingStatus.CROSSED}
        said = [event.data["message"] for event in runtime.stream._history if event.type == "log"]
        assert [message.split(";")[0].split(":")[0] for message in said] == [
            "I do not know where I am",
            "I know again where I am",
        ]
        await carry_during_a_task(runtime)


async def carry_during_a_task(runtime: Runtime) -> None:
    """A request goes on where the robot was set down, and succeeds."""
    here = runtime.memory.snapshot().current_room
    task = runtime.orders.submit(f"go to {next(r for r in ('room_1', 'room_2', 'room_3') if r != here)}")
    await until(runtime, lambda: runtime.memory.snapshot().robot.status.startswith(("driving", "crossing")), 20.0)
    robot = runtime.require_robot()
    x_m, y_m, _ = (await robot.truth())["robot"]["pose"]
    elsewhere = [5.5, 2.0, 1.0] if x_m < 4.3 and y_m > 3.5 else [2.2, 5.6, 0.5]
    await robot.disturb({"do": "move", "id": "robot", "to": {"pose": elsewhere}})
    await until(runtime, lambda: not runtime.views.status.document()["robot"]["localized"], 3.0)
    await until(runtime, lambda: runtime.queue.task(task.id).status.ended, 120.0)
    assert runtime.queue.task(task.id).status is TaskStatus.SUCCEEDED
    assert (await robot.truth())["collisions"] == 0
