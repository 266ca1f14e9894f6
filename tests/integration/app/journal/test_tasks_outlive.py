"""Tasks survive a restart: who waits goes on waiting, and what was under way is said to be cut off."""

import pytest

from app.journal.tasks import INTERRUPTED
from app.runtime import Runtime
from app.settings import ClockMode, Settings
from planner.tasks.approval import Approval
from planner.tasks.tasks import TaskStatus
from scene_graph.nodes import RoomNode, RoomStatus

pytestmark = pytest.mark.anyio
LIMIT_S = 120.0
KEPT = RoomStatus.PERMANENT


@pytest.fixture
def anyio_backend():
    return "asyncio"


def settings(folder):
    return Settings(house="flat", clock=ClockMode.LOCKSTEP, speed=None, data=folder, camera=False, remember=True)


async def until(runtime, condition):
    while not condition() and runtime.now_s < LIMIT_S:
        await runtime.wait_for_change()
    assert condition()


def status_of(runtime, task):
    return runtime.queue.task(task.id).status


async def test_a_restart_keeps_the_tasks_and_says_which_was_cut_off(tmp_path):
    async with Runtime(settings(tmp_path)).running() as runtime:
        await until(runtime, lambda: len(runtime.memory.building().of_type(RoomNode)) >= 2)
        done = runtime.orders.submit("where are you?")
        asked = runtime.orders.submit("go to room_1", approval=Approval.ASK)
        await until(runtime, lambda: status_of(runtime, asked) is TaskStatus.AWAITING_APPROVAL)
        going = runtime.orders.submit("go to room_1")
        await until(runtime, lambda: status_of(runtime, going) is TaskStatus.RUNNING)
        reply = runtime.queue.task(done.id).reply
    async with Runtime(settings(tmp_path)).running() as runtime:
        assert (status_of(runtime, done), runtime.queue.task(done.id).reply) == (TaskStatus.SUCCEEDED, reply)
        assert status_of(runtime, asked) is TaskStatus.AWAITING_APPROVAL
        cut_off = runtime.queue.task(going.id)
        assert (cut_off.status, cut_off.failures[-1].code) == (TaskStatus.FAILED, INTERRUPTED)
        assert "I was switched off" in cut_off.explanation
        again = runtime.orders.submit("why did you fail?")
        assert again.id == "task_4"
        await until(runtime, lambda: status_of(runtime, again).ended)
        assert "switched off" in runtime.queue.task(again.id).reply


async def test_what_a_person_says_is_on_disk_before_the_task_is_said_to_have_succeeded(tmp_path):
    def look(task):
        if task.status.ended:
            told[task.id] = any("library" in file.read_text() for file in tmp_path.rglob("room_*.json"))

    told = {}
    async with Runtime(settings(tmp_path)).running() as runtime:
        await until(
            runtime, lambda: [room.status for room in runtime.memory.building().of_type(RoomNode)][:1] == [KEPT]
        )
        runtime.queue.listen(look)
        asked = runtime.orders.submit("where are you?")
        await until(runtime, lambda: status_of(runtime, asked).ended)
        taught = runtime.orders.submit("this is the library")
        await until(runtime, lambda: status_of(runtime, taught).ended)
        assert status_of(runtime, taught) is TaskStatus.SUCCEEDED
    assert told == {asked.id: False, taught.id: True}
