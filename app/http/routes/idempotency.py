"""``Idempotency-Key``: the same key twice makes one task, also when the service was restarted in between."""

from __future__ import annotations

from app.http.documents.problems import Problem
from app.http.documents.requests import TaskRequest
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import Task


def earlier_task(queue: TaskQueue, key: str | None, body: TaskRequest) -> Task | None:
    """The task made with this key before, for as long as it is remembered.

    Raises:
        Problem: the key came with another request.
    """
    task = next((task for task in queue.tasks if key is not None and task.key == key), None)
    if task is not None and (task.request, task.approval, task.dry_run) != (body.request, body.approval, body.dry_run):
        raise Problem(409, "idempotency_key_reused", "this Idempotency-Key came with another request before")
    return task
