"""The HTTP application: routes, guards and the page, put together around one runtime."""

from __future__ import annotations

from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

from fastapi import Depends, FastAPI
from fastapi.responses import FileResponse
from fastapi.staticfiles import StaticFiles

from majordomo import __version__
from majordomo.app.http.limits import BodyLimit, HostGuard
from majordomo.app.http.problems import install_problem_handlers
from majordomo.app.http.scene import scene_routes
from majordomo.app.http.security import Token, TokenGuard
from majordomo.app.http.simulation import simulation_routes
from majordomo.app.http.status import health_routes, status_routes
from majordomo.app.http.stream import stream_routes
from majordomo.app.http.tasks import task_routes
from majordomo.app.runtime import Runtime

PAGE_FOLDER = Path(__file__).parent.parent / "page"


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
    guarded = [Depends(TokenGuard(token))]
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


def _serve_page(app: FastAPI) -> None:
    """The page's own files hold nothing secret; all they show comes through the token."""
    app.mount("/page", StaticFiles(directory=PAGE_FOLDER), name="page")

    @app.get("/", include_in_schema=False)
    async def page() -> FileResponse:
        return FileResponse(PAGE_FOLDER / "index.html", headers={"Cache-Control": "no-cache"})
