"""The HTTP application: routes, guards and the page, put together around one runtime."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path
from typing import Any

from fastapi import Depends, FastAPI, Request, Response
from fastapi.responses import FileResponse, JSONResponse
from fastapi.security import HTTPBearer
from fastapi.staticfiles import StaticFiles
from starlette.middleware.cors import CORSMiddleware

from app.errors import RobotUnavailable
from app.http.description import ABOUT, TAGS, describe
from app.http.documents.codes import GUARDED, OPEN_TO_ALL, told
from app.http.documents.problems import Problem, install_problem_handlers, problem_response
from app.http.guards.counting import CallCounter
from app.http.guards.gate import Gate
from app.http.guards.limits import BodyLimit, HostGuard
from app.http.guards.rates import Budgets
from app.http.guards.security import Access, Token
from app.http.routes.camera import camera_routes
from app.http.routes.scene import scene_routes
from app.http.routes.simulation import simulation_routes
from app.http.routes.status import health_routes, status_routes
from app.http.routes.stream import stream_routes
from app.http.routes.tasks import task_routes
from app.http.routes.trace import trace_routes
from app.journal.audit import NotKept
from app.runtime import Runtime
from app.settings import Settings
from app.version import __version__

PAGE_FOLDER = Path(__file__).parent.parent / "page"
BURST_S = 5.0
"""How long a caller who was silent may come as often as twice the rate allows."""
PAGE_HEADERS = {
    "Cache-Control": "no-cache",
    "Content-Security-Policy": "default-src 'self'; img-src 'self' blob:; base-uri 'none'; frame-ancestors 'none'",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


def make_service(runtime: Runtime, token: Token, viewer: Token | None = None) -> FastAPI:
    """The application of one runtime; its lifespan starts and stops the runtime.

    ``token`` opens everything, ``viewer`` all that only reads.
    """

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        async with runtime.running():
            yield

    app = FastAPI(
        title="Majordomo",
        version=__version__,
        description=ABOUT,
        openapi_tags=TAGS,
        docs_url=None,
        redoc_url=None,
        generate_unique_id_function=lambda route: route.name,
        lifespan=lifespan,
    )
    describe(app)
    install_problem_handlers(app)

    @app.exception_handler(RobotUnavailable)
    async def _no_robot(_: Request, error: RobotUnavailable) -> JSONResponse:
        return problem_response(Problem(503, "robot_unavailable", str(error)))

    @app.exception_handler(NotKept)
    async def _not_kept(_: Request, error: NotKept) -> JSONResponse:
        return problem_response(Problem(503, "journal_unavailable", str(error)))

    bearer = HTTPBearer(auto_error=False, description="The token in the address printed at start.")
    guarded: dict[str, Any] = {"dependencies": [Depends(bearer)], "responses": told(*GUARDED)}
    for routes in (task_routes, trace_routes, scene_routes, camera_routes, status_routes):
        app.include_router(routes(runtime), **guarded)
    if runtime.settings.simulation_api:
        app.include_router(simulation_routes(runtime), **guarded)
    access = Access(operator=token, viewer=viewer)
    app.include_router(health_routes(runtime), responses=told(*OPEN_TO_ALL))
    app.include_router(stream_routes(runtime, access))
    _serve_page(app)
    _guard(app, runtime.settings, access)
    app.add_middleware(CallCounter, counters=runtime.counters)
    return app


def _guard(app: FastAPI, settings: Settings, access: Access) -> None:
    """Everything passes, from the last to the first: host and origin, foreign pages' questions, token, size."""
    origins = frozenset(settings.allow_origins)
    app.add_middleware(BodyLimit, max_bytes=settings.max_body_bytes)
    budgets = Budgets(rate_hz=settings.requests_per_s, burst=BURST_S * settings.requests_per_s)
    app.add_middleware(Gate, access=access, budgets=budgets)
    if origins:
        app.add_middleware(
            CORSMiddleware,
            allow_origins=sorted(origins),
            allow_methods=["GET", "POST", "PATCH"],
            allow_headers=["Authorization", "Content-Type", "Idempotency-Key"],
            expose_headers=["Location", "Link", "Retry-After"],
        )
    app.add_middleware(HostGuard, hosts=frozenset({settings.host}), origins=origins)


class _PageFiles(StaticFiles):
    """The page's modules, asked for anew at every load, so that no page is made of two versions."""

    def file_response(self, *args: Any, **kwargs: Any) -> Response:
        response = super().file_response(*args, **kwargs)
        response.headers.update(PAGE_HEADERS)
        return response


def _serve_page(app: FastAPI) -> None:
    """The page's own files hold nothing secret; all they show comes through the token."""
    app.mount("/page", _PageFiles(directory=PAGE_FOLDER), name="page")

    @app.get("/", include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(PAGE_FOLDER / "index.html", headers=PAGE_HEADERS)

    @app.get("/docs", include_in_schema=False)
    async def docs() -> FileResponse:
        return FileResponse(PAGE_FOLDER / "docs.html", headers=PAGE_HEADERS)
