"""Routes for requests: ``/v1/tasks`` and what a person may do to a task, and the stop that overrides them all."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Header, Path, Query, Response

from app.http.description import shows
from app.http.documents import examples
from app.http.documents.answers import StopDocument, TaskDocument, TasksDocument
from app.http.documents.codes import told
from app.http.documents.problems import Problem
from app.http.documents.requests import Answer, SeenPlan, TaskRequest
from app.http.routes.idempotency import earlier_task
from app.http.routes.paging import page
from app.runtime import Runtime
from planner.errors import IllegalTransition, OperationNotAllowed, PlanChanged, QueueFull, TaskNotFound
from planner.tasks.tasks import Task, TaskStatus

TaskId = Annotated[str, Path(description="Such as `task_1`.")]
Key = Annotated[
    str | None,
    Header(
        min_length=1,
        max_length=200,
        pattern=r"^[!-~]([ -~]*[!-~])?$",
        description="A name of your own for the request: sent again under it, it is not done twice, also after a "
        "restart of the service.",
    ),
]
Before = Annotated[str | None, Query(pattern=r"^task_[0-9]{1,18}$", description="Only tasks older than this one.")]
LOCATION = {"headers": {"Location": {"description": "Where the task is.", "schema": {"type": "string"}}}}
LINKS = {
    "links": {
        operation: {"operationId": operation, "parameters": {"task_id": "$response.body#/id"}}
        for operation in ("show_task", "approve", "reject", "pause", "resume", "cancel", "answer")
    }
}
TASK = shows(TaskDocument, examples.TASK) | told("task_not_found", "not_allowed_now", "journal_unavailable")
STOP_TEXT = "The software stop, latched: in force at once, whatever else goes on, and never limited in rate."


def task_routes(runtime: Runtime) -> APIRouter:
    """Routes over the runtime's task queue."""
    router = APIRouter()
    router.include_router(_asking(runtime))
    router.include_router(_deciding(runtime))
    router.include_router(_stopping(runtime))
    return router


def _asking(runtime: Runtime) -> APIRouter:
    router = APIRouter(tags=["tasks"])
    queue = runtime.queue
    submitted = shows(TaskDocument, examples.SUBMITTED, status=202, **LOCATION, **LINKS)

    @router.post(
        "/v1/tasks",
        status_code=202,
        summary="Ask for something",
        responses=submitted
        | told("idempotency_key_reused", "invalid_request", "rate_limited", "queue_full", "journal_unavailable"),
    )
    async def submit(body: TaskRequest, response: Response, idempotency_key: Key = None) -> Any:
        """Queue a request. Tasks are done one at a time, in order of arrival; follow one at its `Location` or on the
        stream. *Stop*, *wait*, *go on* and *cancel* act at once.
        """
        task = earlier_task(queue, idempotency_key, body)
        if task is None:
            try:
                task = runtime.orders.submit(
                    body.request, approval=body.approval, dry_run=body.dry_run, key=idempotency_key
                )
            except QueueFull as full:
                raise Problem(429, "queue_full", str(full), headers={"Retry-After": "10"}) from None
        response.headers["Location"] = f"/v1/tasks/{task.id}"
        return task.document()

    @router.get(
        "/v1/tasks",
        summary="All tasks, newest first",
        responses=shows(TasksDocument, examples.TASKS) | told("invalid_request"),
    )
    async def list_tasks(
        response: Response,
        limit: Annotated[int, Query(ge=1, le=200)] = 50,
        offset: Annotated[int, Query(ge=0)] = 0,
        before: Before = None,
        status: Annotated[list[TaskStatus] | None, Query(description="Only tasks in one of these.")] = None,
    ) -> Any:
        """A page of tasks, the identifiers of those that wait for the robot in order, and where the next page is. The
        address of the next page stays right when tasks are added meanwhile; an `offset` does not.
        """
        found = page(queue.tasks[::-1], limit=limit, offset=offset, before=before, statuses=tuple(status or ()))
        if found.next is not None:
            response.headers["Link"] = f'<{found.next}>; rel="next"'
        return {
            "tasks": [task.document() for task in found.tasks],
            "total": found.total,
            "queue": [task.id for task in queue.waiting],
            "next": found.next,
        }

    @router.get(
        "/v1/tasks/{task_id}",
        summary="One task",
        responses=shows(TaskDocument, examples.TASK) | told("task_not_found"),
    )
    async def show_task(task_id: TaskId) -> Any:
        """The task as it is now: its plan with each step's state, its failures and their evidence, its outcome."""
        return _find(runtime, task_id).document()

    return router


def _deciding(runtime: Runtime) -> APIRouter:
    router = APIRouter(tags=["tasks"])

    @router.post(
        "/v1/tasks/{task_id}/approve",
        summary="Let a planned task run",
        responses=TASK | told("not_allowed_now", "plan_changed", "invalid_request"),
    )
    async def approve(task_id: TaskId, body: SeenPlan | None = None) -> Any:
        """Name the `revision` of the plan that was looked at: should the task have another plan by now, nothing is
        approved. When its turn comes the plan is made again; one with other steps is asked about anew.
        """
        return _operate(runtime, task_id, "approve", revision=body.revision if body else None)

    @router.post("/v1/tasks/{task_id}/reject", summary="Turn a plan down", responses=TASK)
    async def reject(task_id: TaskId) -> Any:
        """The task ends, and nothing has moved."""
        return _operate(runtime, task_id, "reject")

    @router.post("/v1/tasks/{task_id}/pause", summary="Hold a running task", responses=TASK)
    async def pause(task_id: TaskId) -> Any:
        """The robot stands still and keeps what it holds."""
        return _operate(runtime, task_id, "pause")

    @router.post("/v1/tasks/{task_id}/resume", summary="Go on with a paused task", responses=TASK)
    async def resume(task_id: TaskId) -> Any:
        """It goes on with the action that was interrupted."""
        return _operate(runtime, task_id, "resume")

    @router.post("/v1/tasks/{task_id}/cancel", summary="End a task", responses=TASK)
    async def cancel(task_id: TaskId) -> Any:
        """Whatever moves is stopped and the arm made safe."""
        return _operate(runtime, task_id, "cancel")

    @router.post(
        "/v1/tasks/{task_id}/answer",
        summary="Answer the robot's question",
        responses=TASK | told("invalid_request"),
    )
    async def answer(task_id: TaskId, body: Answer) -> Any:
        """The task is understood again, with the answer; another question may follow."""
        return _operate(runtime, task_id, "answer", text=body.answer)

    return router


def _stopping(runtime: Runtime) -> APIRouter:
    router = APIRouter(tags=["tasks"], responses=told("rate_limited"))

    @router.post(
        "/v1/stop",
        summary="Stop the robot now, and keep it stopped",
        description=STOP_TEXT,
        responses=shows(StopDocument, {"stopped": True}),
    )
    async def stop() -> Any:
        runtime.orders.stop()
        return {"stopped": True}

    @router.post("/v1/resume", summary="Release the stop", responses=shows(StopDocument, {"stopped": False}))
    async def resume_robot() -> Any:
        """What was interrupted goes on."""
        runtime.orders.release_stop()
        return {"stopped": False}

    return router


def _find(runtime: Runtime, task_id: str) -> Task:
    try:
        return runtime.queue.task(task_id)
    except TaskNotFound as error:
        raise Problem(404, "task_not_found", str(error)) from None


def _operate(runtime: Runtime, task_id: str, operation: str, **how: Any) -> dict[str, Any]:
    """Carry out what a person wants of a task; its document afterwards."""
    _find(runtime, task_id)
    try:
        task: Task = getattr(runtime.queue, operation)(task_id, stamp_s=runtime.now_s, **how)
    except PlanChanged as error:
        raise Problem(409, "plan_changed", str(error), revision=error.revision) from None
    except (OperationNotAllowed, IllegalTransition) as error:
        raise Problem(409, "not_allowed_now", str(error)) from None
    return task.document()
