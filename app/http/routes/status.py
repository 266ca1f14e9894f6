"""Routes for people and programs that watch the service: status, health, metrics."""

from __future__ import annotations

from typing import Any

from fastapi import APIRouter, Response

from app.http.description import shows, shows_media
from app.http.documents import examples
from app.http.documents.answers import HealthDocument, RestartDocument, StatusDocument
from app.http.documents.codes import told
from app.http.documents.problems import Problem
from app.runtime import Runtime


def status_routes(runtime: Runtime) -> APIRouter:
    """Routes behind the token."""
    router = APIRouter(tags=["status"])

    @router.get("/v1/status", summary="What the robot is doing", responses=shows(StatusDocument, examples.STATUS))
    async def status() -> Any:
        """Where the robot is, what it holds, which task it has, and how each agent keeps its rate."""
        return runtime.views.status.document()

    @router.get(
        "/metrics",
        summary="Prometheus metrics",
        response_class=Response,
        responses=shows_media("text/plain", "Prometheus' text format."),
    )
    async def metrics() -> Response:
        """Agents, queue, plans, model, skills, graph and process, for a scrape with a viewer's token."""
        return Response(runtime.views.metrics.text(), media_type="text/plain; version=0.0.4")

    @router.post(
        "/v1/simulation/restart",
        summary="Bring a dead simulator back",
        responses=shows(RestartDocument, {"restarted": True}) | told("not_allowed_now"),
    )
    async def restart() -> Any:
        """Open tasks are cancelled, and the building is explored anew."""
        if not await runtime.restart_robot():
            raise Problem(409, "not_allowed_now", "the simulator is alive; nothing to restart")
        return {"restarted": True}

    return router


def health_routes(runtime: Runtime) -> APIRouter:
    """Routes that need no token and tell nothing but yes or no."""
    router = APIRouter(tags=["health"])

    @router.get("/healthz", summary="Alive", responses=shows(HealthDocument, {"status": "alive"}))
    async def healthz() -> Any:
        """The service answers."""
        return {"status": "alive"}

    @router.get(
        "/readyz",
        summary="Ready to take a request",
        responses=shows(HealthDocument, {"status": "ready"}) | told("not_ready"),
    )
    async def readyz() -> Any:
        """The service has a robot, or a stored graph, and takes requests."""
        if not runtime.ready:
            raise Problem(503, "not_ready", runtime.not_ready_reason)
        return {"status": "ready"}

    return router
