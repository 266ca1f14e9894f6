"""A service over a stored graph: in process for plain calls, on a real socket for streams and the page."""

from __future__ import annotations

import contextlib
import json
from dataclasses import dataclass

import httpx
import pytest

from app.http.guards.security import Token
from app.http.service import make_service
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.settings import Settings
from paths import DATA

GRAPH = DATA / "flat_graph.json"
TOKEN, VIEWER = Token("a-token-only-for-tests"), Token("a-viewers-token-for-tests")
AUTHORIZED = {"Authorization": f"Bearer {TOKEN.value}"}
SETTLED = {"succeeded", "failed", "cancelled", "refused", "awaiting_answer", "awaiting_approval"}


@pytest.fixture
def anyio_backend():
    return "asyncio"


@dataclass(frozen=True, kw_only=True)
class Service:
    """A running service, a client that may call it, and what is behind it."""

    client: httpx.AsyncClient
    runtime: Runtime
    address: str = ""

    async def settled(self, task_id: str) -> dict:
        """The task once it has ended or waits for a person."""
        while (document := (await self.client.get(f"/v1/tasks/{task_id}")).json())["status"] not in SETTLED:
            await self.runtime.wait_for_change()
        return document

    async def ask(self, request: str, **options) -> dict:
        response = await self.client.post("/v1/tasks", json={"request": request, **options})
        assert response.status_code == 202, response.text
        return await self.settled(response.json()["id"])


@pytest.fixture
def settings(tmp_path):
    return Settings(graph=GRAPH, data=tmp_path, port=0)


@pytest.fixture
def in_process():
    """Runs a service in process: ``async with in_process(settings) as service``."""

    @contextlib.asynccontextmanager
    async def run(settings: Settings):
        runtime = Runtime(settings)
        app = make_service(runtime, TOKEN, VIEWER)
        transport = httpx.ASGITransport(app=app, raise_app_exceptions=False)
        async with (
            app.router.lifespan_context(app),
            httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1:8642", headers=AUTHORIZED) as client,
        ):
            yield Service(client=client, runtime=runtime)

    return run


@pytest.fixture
async def service(in_process, settings):
    async with in_process(settings) as service:
        yield service


@pytest.fixture
async def served(settings):
    """The same on a real socket, as people run it."""
    runtime = Runtime(settings)
    with bind(settings) as listener:
        address = page_address(listener, TOKEN).partition("/?")[0]
        async with (
            serving(runtime, listener, TOKEN, viewer=VIEWER),
            httpx.AsyncClient(base_url=address, headers=AUTHORIZED) as client,
        ):
            yield Service(client=client, runtime=runtime, address=address)


@pytest.fixture
def scene():
    """Nodes of the stored graph by identifier."""
    return {node["id"]: node for node in json.loads(GRAPH.read_text(encoding="utf-8"))["nodes"]}


@pytest.fixture
def token():
    return TOKEN.value


@pytest.fixture
def viewer_token():
    return VIEWER.value
