"""Pages of tasks, newest first, with an address of the next page that stays right while tasks are added."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from urllib.parse import urlencode

from planner.tasks.tasks import Task, TaskStatus


@dataclass(frozen=True, kw_only=True)
class Page:
    """``total``: tasks that pass the filter, on all pages. ``next``: where the next page is, ``None`` on the last."""

    tasks: Sequence[Task]
    total: int
    next: str | None


def page(
    newest: Sequence[Task], *, limit: int, offset: int, before: str | None, statuses: Sequence[TaskStatus]
) -> Page:
    """The page of ``limit`` tasks after ``offset`` of those older than ``before`` and in one of ``statuses``."""
    fitting = [task for task in newest if not statuses or task.status in statuses]
    older = fitting if before is None else [task for task in fitting if _number(task.id) < _number(before)]
    shown = older[offset : offset + limit]
    more = bool(shown) and offset + limit < len(older)
    query = [("limit", str(limit)), *(("status", status.value) for status in statuses)]
    following = f"/v1/tasks?{urlencode([*query, ('before', shown[-1].id)])}" if more else None
    return Page(tasks=shown, total=len(fitting), next=following)


def _number(task_id: str) -> int:
    return int(task_id.rpartition("_")[2])
