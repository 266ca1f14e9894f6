"""Route for the trace of a task: what was decided, when, and why."""

from __future__ import annotations

from typing import Annotated

from fastapi import APIRouter, Query

from app.http.description import shows
from app.http.documents import examples
from app.http.documents.codes import told
from app.http.documents.problems import Problem
from app.runtime import Runtime
from client.documents import Trace

MAX_ENTRIES = 1000


def trace_routes(runtime: Runtime) -> APIRouter:
    """The trace of every task that the journal knows, also of those that the queue has forgotten."""
    router = APIRouter(tags=["tasks"])

    @router.get(
        "/v1/tasks/{task_id}/trace",
        summary="What was decided about a task, when, and why",
        responses=shows(Trace, examples.TRACE) | told("task_not_found", "invalid_request"),
    )
    async def trace(
        task_id: str,
        after: Annotated[int, Query(ge=0, le=2**62, description="Only entries with a higher number.")] = 0,
        limit: Annotated[int, Query(ge=1, le=MAX_ENTRIES)] = 200,
    ) -> Trace:
        """Entries are in the order in which they were written; page with `after` = the `next` of the answer before."""
        found = runtime.journal.trace(task_id, after=after, limit=limit)
        if found is None:
            raise Problem(404, "task_not_found", f"there is no trace of {task_id!r}")
        return found

    return router
