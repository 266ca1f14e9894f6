"""Routes for requests: ``/v1/tasks`` and what a person may do to a task, and the stop that overrides them all."""

from __future__ import annotations

from typing import Annotated, Any

from fastapi import APIRouter, Header, Query, Response

from majordomo.app.http.documents import Answer, TaskRequest
from majordomo.app.http.idempotency import IdempotencyKeys
from majordomo.app.http.problems import Problem
from majordomo.app.runtime import Runtime
from majordomo.planner.errors import IllegalTransition, OperationNotAllowed, TaskNotFound
from majordomo.planner.tasks import Task


def task_routes(runtime: Runtime) -> APIRouter:
    """Routes over the runtime's task queue."""
    router = APIRouter(tags=["tasks"])
    keys = IdempotencyKeys()
    queue = runtime.queue

    def find(task_id: str) -> Task:
        try:
            return queue.task(task_id)
        except TaskNotFound as error:
            raise Problem(404, "task_not_found", str(error)) from None

    def operate(task_id: str, operation: str, *args: str) -> dict[str, Any]:
        find(task_id)
        try:
            task: Task = getattr(queue, operation)(task_id, *args, stamp_s=runtime.now_s)
        except (OperationNotAllowed, IllegalTransition) as error:
            raise Problem(409, "not_allowed_now", str(error)) from None
        return task.document()

    @router.post("/v1/tasks", status_code=202, summary="Ask for something")
    async def submit(
        body: TaskRequest,
        response: Response,
        idempotency_key: Annotated[str | None, Header(max_length=200)] = None,
    ) -> dict[str, Any]:
        known = keys.task_for(idempotency_key, body)
        if known is None:
            task = runtime.submit(body.request, approval=body.approval, dry_run=body.dry_run)
            keys.remember(idempotency_key, body, task.id)
        else:
            task = find(known)
        response.headers["Location"] = f"/v1/tasks/{task.id}"
        return task.document()

    @router.get("/v1/tasks", summary="All tasks, newest first")
    async def list_tasks(
        limit: Annotated[int, Query(ge=1, le=200)] = 50, offset: Annotated[int, Query(ge=0)] = 0
    ) -> dict[str, Any]:
        newest = queue.tasks[::-1]
        return {"tasks": [task.document() for task in newest[offset : offset + limit]], "total": len(newest)}

    @router.get("/v1/tasks/{task_id}", summary="One task")
    async def show(task_id: str) -> dict[str, Any]:
        return find(task_id).document()

    @router.post("/v1/tasks/{task_id}/approve", summary="Let a planned task run")
    async def approve(task_id: str) -> dict[str, Any]:
        return operate(task_id, "approve")

    @router.post("/v1/tasks/{task_id}/reject", summary="Turn a plan down")
    async def reject(task_id: str) -> dict[str, Any]:
        return operate(task_id, "reject")

    @router.post("/v1/tasks/{task_id}/pause", summary="Hold a running task")
    async def pause(task_id: str) -> dict[str, Any]:
        return operate(task_id, "pause")

    @router.post("/v1/tasks/{task_id}/resume", summary="Go on with a paused task")
    async def resume(task_id: str) -> dict[str, Any]:
        return operate(task_id, "resume")

    @router.post("/v1/tasks/{task_id}/cancel", summary="End a task")
    async def cancel(task_id: str) -> dict[str, Any]:
        return operate(task_id, "cancel")

    @router.post("/v1/tasks/{task_id}/answer", summary="Answer the robot's question")
    async def answer(task_id: str, body: Answer) -> dict[str, Any]:
        return operate(task_id, "answer", body.answer)

    @router.post("/v1/stop", summary="Stop the robot now, and keep it stopped")
    async def stop() -> dict[str, Any]:
        runtime.stop_robot()
        return {"stopped": True}

    @router.post("/v1/resume", summary="Release the stop")
    async def resume_robot() -> dict[str, Any]:
        runtime.release_stop()
        return {"stopped": False}

    return router
