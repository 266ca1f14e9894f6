"""What *stop*, *wait*, *go on* and *cancel*, typed as a request, do to the other tasks."""

from __future__ import annotations

from planner.language.sentences.control import Control
from planner.plan import Kind
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import Task, TaskStatus

_OPEN = frozenset({TaskStatus.AWAITING_ANSWER, TaskStatus.AWAITING_APPROVAL, TaskStatus.QUEUED, TaskStatus.PLANNING})


def apply_control(control: Control, task: Task, queue: TaskQueue, stamp_s: float) -> Task:
    """Act on the other tasks at once; ``task``, whose words these were, ends with what was done.

    *Stop* is the robot's own: who calls this latches the stop, and releases it for *go on*.
    """
    others = [other for other in queue.tasks if other.id != task.id and not other.status.ended]
    match control:
        case Control.STOP:
            said = "I have stopped. Say “go on” when I may move again."
        case Control.PAUSE:
            said = (
                _operated("pause", (TaskStatus.RUNNING,), others, queue, stamp_s) or "I am doing nothing that can wait."
            )
        case Control.RESUME:
            said = _operated("resume", (TaskStatus.PAUSED,), others, queue, stamp_s) or "I go on."
        case Control.CANCEL:
            active = [other for other in others if other.status in (TaskStatus.RUNNING, TaskStatus.PAUSED)]
            last = active or [other for other in others if other.status in _OPEN][-1:]
            said = _operated("cancel", tuple(TaskStatus), last, queue, stamp_s) or "There is nothing to cancel."
    queue.move(task.id, TaskStatus.PLANNING, stamp_s=stamp_s)
    done = {"kind": Kind.ANSWER.value, "reply": said, "explanation": said}
    return queue.move(task.id, TaskStatus.SUCCEEDED, stamp_s=stamp_s, **done)


def _operated(
    operation: str, statuses: tuple[TaskStatus, ...], tasks: list[Task], queue: TaskQueue, stamp_s: float
) -> str:
    fitting = [task for task in tasks if task.status in statuses]
    for task in fitting:
        getattr(queue, operation)(task.id, stamp_s=stamp_s)
    verb = {"pause": "I wait with", "resume": "I go on with", "cancel": "I have cancelled"}[operation]
    return " ".join(f"{verb} “{task.request}”." for task in fitting)
