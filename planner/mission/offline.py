"""Planning without a robot: requests are understood, planned and verified on a stored graph, and nothing moves."""

from __future__ import annotations

from planner.executor.executor import OnEvent, ignore_event
from planner.mission.request_handler import Interpreter, RequestHandler
from planner.skill_planner.replanner import Verifier
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import TaskStatus
from scene_graph.memory import WorkingMemory


class OfflineMission:
    """Takes the place of ``Mission`` where there is no body: every task ends with its plan."""

    name = "mission"

    def __init__(
        self,
        memory: WorkingMemory,
        queue: TaskQueue,
        interpreter: Interpreter,
        verifier: Verifier,
        *,
        on_event: OnEvent = ignore_event,
        period_s: float = 0.1,
    ) -> None:
        self.period_s = period_s
        self._queue = queue
        self._requests = RequestHandler(memory, queue, interpreter, verifier, on_event=on_event, offline=True)

    async def step(self, stamp_s: float) -> None:
        """Plan for the next task, if there is one."""
        task = self._queue.current
        if task is None:
            return
        if task.status is TaskStatus.QUEUED:
            task = self._queue.move(task.id, TaskStatus.PLANNING, stamp_s=stamp_s)
        await self._requests.take(task, stamp_s)
