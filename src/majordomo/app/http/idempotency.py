"""``Idempotency-Key``: the same key twice makes one task."""

from __future__ import annotations

from collections import OrderedDict

from majordomo.app.http.documents import TaskRequest
from majordomo.app.http.problems import Problem


class IdempotencyKeys:
    """Which key made which task; the oldest keys are forgotten beyond ``keep``."""

    def __init__(self, *, keep: int = 1000) -> None:
        self._tasks: OrderedDict[str, tuple[str, str]] = OrderedDict()
        self._keep = keep

    def task_for(self, key: str | None, body: TaskRequest) -> str | None:
        """The task made earlier with this key; a different body under the same key is refused."""
        if key is None or key not in self._tasks:
            return None
        task_id, earlier = self._tasks[key]
        if earlier != body.model_dump_json():
            raise Problem(422, "idempotency_key_reused", "this Idempotency-Key came with another request before")
        return task_id

    def remember(self, key: str | None, body: TaskRequest, task_id: str) -> None:
        """Bind ``key`` to the task it made."""
        if key is None:
            return
        self._tasks[key] = (task_id, body.model_dump_json())
        while len(self._tasks) > self._keep:
            self._tasks.popitem(last=False)
