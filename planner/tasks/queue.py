"""The queue of tasks: in order of arrival, one at a time, and what a person may do to them (design, section 9)."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from types import MappingProxyType
from typing import Any

from planner.errors import OperationNotAllowed, PlanChanged, QueueFull, TaskNotFound
from planner.plan import Kind
from planner.tasks.approval import Approval
from planner.tasks.tasks import Task, TaskStatus, TaskTimes

TaskListener = Callable[[Task], None]
KEEP = 500
"""Of ended tasks, the newest that are remembered."""
MOST_OPEN = 500
"""Tasks that may wait at a time."""
TURNED_DOWN = "You turned the plan down; nothing was done."

OPERATIONS: Mapping[str, tuple[frozenset[TaskStatus], TaskStatus]] = MappingProxyType(
    {
        "approve": (frozenset({TaskStatus.AWAITING_APPROVAL}), TaskStatus.QUEUED),
        "reject": (frozenset({TaskStatus.AWAITING_APPROVAL}), TaskStatus.CANCELLED),
        "answer": (frozenset({TaskStatus.AWAITING_ANSWER}), TaskStatus.QUEUED),
        "pause": (frozenset({TaskStatus.RUNNING}), TaskStatus.PAUSED),
        "resume": (frozenset({TaskStatus.PAUSED}), TaskStatus.RUNNING),
        "cancel": (frozenset(status for status in TaskStatus if not status.ended), TaskStatus.CANCELLED),
    }
)
"""What a person may do: the statuses it fits, and the status it leads to."""


class TaskQueue:
    """All tasks of a service. Every change makes a new immutable ``Task`` and tells the listeners, in order.

    A task that waits for an answer or an approval steps aside, so that others can run; it takes its place again, by
    order of arrival, when the person has spoken. Ended tasks beyond ``keep`` are forgotten, oldest first.
    """

    def __init__(self, tasks: Iterable[Task] = (), *, keep: int = KEEP) -> None:
        self._tasks = {task.id: task for task in tasks}
        self._keep = keep
        self._count = max((int(task_id.rpartition("_")[2]) for task_id in self._tasks), default=0)
        self._listeners: list[TaskListener] = []

    @property
    def tasks(self) -> tuple[Task, ...]:
        """All remembered tasks, oldest first."""
        return tuple(self._tasks.values())

    @property
    def current(self) -> Task | None:
        """The task that has the robot: a running or paused one, else the first that can be planned."""
        for statuses in ((TaskStatus.RUNNING, TaskStatus.PAUSED), (TaskStatus.PLANNING, TaskStatus.QUEUED)):
            for task in self._tasks.values():
                if task.status in statuses:
                    return task
        return None

    @property
    def waiting(self) -> tuple[Task, ...]:
        """The task that has the robot, and those that wait for it, in the order in which they will have it."""
        current = self.current
        others = (t for t in self._tasks.values() if t.status in (TaskStatus.PLANNING, TaskStatus.QUEUED))
        return () if current is None else (current, *(task for task in others if task.id != current.id))

    @property
    def unread(self) -> Task | None:
        """The first task in the queue that nobody has tried to understand yet, or whose question was answered."""
        queued = (task for task in self._tasks.values() if task.status is TaskStatus.QUEUED)
        return next((task for task in queued if task.kind in (None, Kind.CLARIFY.value)), None)

    def listen(self, listener: TaskListener) -> None:
        """Call ``listener`` with every task that is new or changed."""
        self._listeners.append(listener)

    def task(self, task_id: str) -> Task:
        """The task as it is now.

        Raises:
            TaskNotFound: listing the newest identifiers.
        """
        try:
            return self._tasks[task_id]
        except KeyError:
            raise TaskNotFound(task_id, tuple(self._tasks)[-10:]) from None

    def submit(
        self,
        request: str,
        *,
        stamp_s: float,
        approval: Approval = Approval.AUTO,
        dry_run: bool = False,
        key: str | None = None,
        urgent: bool = False,
    ) -> Task:
        """Append a request; identifiers count up from ``task_1``. ``urgent``: take it however many are open.

        Raises:
            QueueFull: too many tasks are open.
        """
        if not urgent and sum(not task.status.ended for task in self._tasks.values()) >= MOST_OPEN:
            raise QueueFull(MOST_OPEN)
        self._count += 1
        task = Task(
            id=f"task_{self._count}",
            request=request,
            times=TaskTimes(received_s=stamp_s),
            approval=approval,
            dry_run=dry_run,
            key=key,
        )
        self._forget_oldest()
        try:
            return self._publish(task)
        except BaseException:
            self._tasks.pop(task.id, None)  # who asked is told that it was not taken, so nobody may carry it out
            raise

    def move(self, task_id: str, status: TaskStatus, *, stamp_s: float, **changes: Any) -> Task:
        """Put a task into another status, if that is legal."""
        return self._publish(self.task(task_id).to(status, stamp_s=stamp_s, **changes))

    def amend(self, task_id: str, **changes: Any) -> Task:
        """Change a task's record, not its status."""
        return self._publish(replace(self.task(task_id), **changes))

    def approve(self, task_id: str, *, stamp_s: float, revision: int | None = None) -> Task:
        """Let a planned task run; its plan is checked again when its turn comes.

        ``revision``: that of the plan which the person has seen.

        Raises:
            PlanChanged: the task's plan is another by now.
        """
        task = self.task(task_id)
        waits = task.status is TaskStatus.AWAITING_APPROVAL and task.plan is not None
        if waits and task.plan is not None and revision not in (None, task.plan.revision):
            raise PlanChanged(task_id, revision or 0, task.plan.revision)
        return self._operate("approve", task_id, stamp_s, approved=True)

    def reject(self, task_id: str, *, stamp_s: float) -> Task:
        """Turn a plan down; the task ends."""
        return self._operate("reject", task_id, stamp_s, explanation=TURNED_DOWN)

    def answer(self, task_id: str, text: str, *, stamp_s: float) -> Task:
        """Answer the robot's question; the task is planned again with the answer."""
        dialogue = self.task(task_id).dialogue
        told = (*dialogue[:-1], (dialogue[-1][0], text)) if dialogue else ()
        return self._operate("answer", task_id, stamp_s, dialogue=told, candidates=())

    def pause(self, task_id: str, *, stamp_s: float) -> Task:
        """Hold a running task; the robot stands still and keeps what it holds."""
        return self._operate("pause", task_id, stamp_s)

    def resume(self, task_id: str, *, stamp_s: float) -> Task:
        """Go on with a paused task, with the action that was interrupted."""
        return self._operate("resume", task_id, stamp_s)

    def cancel(self, task_id: str, *, stamp_s: float) -> Task:
        """End a task for good; whatever moves is stopped and the arm made safe."""
        return self._operate("cancel", task_id, stamp_s, explanation="Cancelled on request.")

    def _operate(self, operation: str, task_id: str, stamp_s: float, **changes: Any) -> Task:
        task = self.task(task_id)
        statuses, status = OPERATIONS[operation]
        if task.status not in statuses:
            fitting = tuple(name for name, (fits, _) in OPERATIONS.items() if task.status in fits)
            raise OperationNotAllowed(task_id, task.status.value, operation, fitting)
        return self.move(task_id, status, stamp_s=stamp_s, **changes)

    def _publish(self, task: Task) -> Task:
        self._tasks[task.id] = task
        for listener in self._listeners:
            listener(task)
        return task

    def _forget_oldest(self) -> None:
        ended = [task.id for task in self._tasks.values() if task.status.ended]
        for task_id in ended[: max(0, len(ended) - self._keep)]:
            del self._tasks[task_id]
