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

from majordomo import __version__
from majordomo.app.http.limits import BodyLimit, HostGuard
from majordomo.app.http.problems import Problem, install_problem_handlers, problem_response
from majordomo.app.http.scene import scene_routes
from majordomo.app.http.security import Token, TokenGuard
from majordomo.app.http.simulation import simulation_routes
from majordomo.app.http.status import health_routes, status_routes
from majordomo.app.http.stream import stream_routes
from majordomo.app.http.tasks import task_routes
from majordomo.app.runtime import RobotUnavailable, Runtime

PAGE_FOLDER = Path(__file__).parent.parent / "page"
PAGE_HEADERS = {
    "Cache-Control": "no-cache",
    "Content-Security-Policy": "default-src 'self'; img-src 'self' blob:; base-uri 'none'; frame-ancestors 'none'",
    "Referrer-Policy": "no-referrer",
    "X-Content-Type-Options": "nosniff",
}


def make_service(runtime: Runtime, token: Token) -> FastAPI:
    """The application of one runtime; its lifespan starts and stops the runtime."""

    @asynccontextmanager
    async def lifespan(_: FastAPI) -> AsyncIterator[None]:
        async with runtime.running():
            yield

    app = FastAPI(
        title="Majordomo",
        version=__version__,
        description="Ask a robot for something; it plans, acts, checks, explains.",
        lifespan=lifespan,
    )
    install_problem_handlers(app)

    @app.exception_handler(RobotUnavailable)
    async def _no_robot(_: Request, error: RobotUnavailable) -> JSONResponse:
        return problem_response(Problem(503, "robot_unavailable", str(error)))

    bearer = HTTPBearer(auto_error=False, description="The token in the address printed at start.")
    guarded = [Depends(bearer), Depends(TokenGuard(token))]
    for router in (task_routes(runtime), scene_routes(runtime), status_routes(runtime)):
        app.include_router(router, dependencies=guarded)
    if runtime.settings.simulation_api:
        app.include_router(simulation_routes(runtime), dependencies=guarded)
    app.include_router(health_routes(runtime))
    app.include_router(stream_routes(runtime, token))
    _serve_page(app)
    app.add_middleware(BodyLimit, max_bytes=runtime.settings.max_body_bytes)
    app.add_middleware(HostGuard, hosts=frozenset({runtime.settings.host}))
    return app


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
