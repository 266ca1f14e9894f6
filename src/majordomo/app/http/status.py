"""Routes for people and programs that watch the service: status, health, metrics."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Response

from majordomo.app.http.problems import Problem
from majordomo.app.runtime import Runtime


def status_routes(runtime: Runtime) -> APIRouter:
    """Routes behind the token."""
    router = APIRouter(tags=["status"])

    @router.get("/v1/status", summary="What the robot is doing")
    async def status() -> dict[str, Any]:
        return runtime.status_document()

    @router.get("/metrics", summary="Prometheus metrics", response_class=Response)
    async def metrics() -> Response:
        return Response(runtime.metrics_text(), media_type="text/plain; version=0.0.4")

    @router.post("/v1/simulation/restart", summary="Bring a dead simulator back")
    async def restart() -> dict[str, Any]:
        if not await runtime.restart_robot():
            raise Problem(409, "not_allowed_now", "the simulator is alive; nothing to restart")
        return {"restarted": True}

    return router


def health_routes(runtime: Runtime) -> APIRouter:
    """Routes that need no token and tell nothing but yes or no."""
    router = APIRouter(tags=["health"])

    @router.get("/healthz", summary="Alive")
    async def healthz() -> dict[str, str]:
        return {"status": "alive"}

    @router.get("/readyz", summary="Ready to take a request")
    async def readyz() -> dict[str, str]:
        if not runtime.ready:
            raise Problem(503, "not_ready", runtime.not_ready_reason)
        return {"status": "ready"}

    return router
