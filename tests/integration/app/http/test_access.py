"""Who gets in: every route asks for the token, foreign hosts and pages are turned away, the page itself is open."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
import websockets
from fastapi.routing import APIRoute, APIWebSocketRoute
from starlette.routing import Mount, Route

from app.http import service as service_module
from app.http.documents.codes import CODES
from app.http.guards.security import Token
from app.http.service import PAGE_FOLDER, make_service
from app.runtime import Runtime
from app.settings import Settings

pytestmark = pytest.mark.anyio

OPEN = {"/", "/docs", "/healthz", "/readyz", "/openapi.json"}
"""Yes or no, and text that is the same in every installation."""
FOREIGN = (
    {"Host": "evil.example"},
    {"Host": "10.1.2.3"},
    {"Origin": "https://evil.example"},
    {"Origin": "http://127.0.0.1:3000"},
    {"Origin": "null"},
)


def all_routes(settings):
    """Method and path of every route of the application, whatever it is mounted from, but for streams."""
    app = make_service(Runtime(settings.model_copy(update={"simulation_api": True})), Token("0" * 16))
    for route in flat(app.routes):
        if isinstance(route, Mount):
            yield "GET", f"{route.path}/index.html"
        elif isinstance(route, Route | APIRoute):
            yield from ((method, re.sub(r"{\w+}", "x", route.path)) for method in sorted(route.methods))
        else:
            assert isinstance(route, APIWebSocketRoute), route


def all_streams(settings):
    app = make_service(Runtime(settings), Token("0" * 16))
    return [route.path for route in flat(app.routes) if isinstance(route, APIWebSocketRoute)]


def flat(routes):
    for route in routes:
        inner = getattr(route, "original_router", None) or getattr(route, "router", None)
        if inner is not None and not isinstance(route, Mount):
            yield from flat(inner.routes)
        else:
            yield route


def is_open(path):
    return path in OPEN or path.startswith("/page/")


async def test_every_route_refuses_who_has_no_token_or_a_wrong_one_and_every_foreign_host_and_page(
    in_process, settings, token
):
    settings = settings.model_copy(update={"simulation_api": True})
    calls = list(all_routes(settings))
    assert len([path for _, path in calls if not is_open(path)]) >= 22
    async with in_process(settings) as service:
        before = service.runtime.memory.snapshot().revision
        for method, path in calls:
            for foreign in FOREIGN:
                response = await service.client.request(method, path, headers=foreign, json={})
                assert (response.status_code, path) == (403, path)
                assert response.headers["content-type"] == "application/problem+json"
            for header in ("", "Bearer ", "Bearer wrong-token-entirely", f"Basic {token}", f"Bearer {token[:-1]}"):
                for body in (b"{}", b"{"):
                    headers = {"Authorization": header, "Content-Type": "application/json"}
                    response = await service.client.request(method, path, headers=headers, content=body)
                    if not is_open(path):
                        assert (response.status_code, path) == (401, path)
                        assert response.json()["code"] == "unauthorized"
                        assert response.headers["www-authenticate"] == "Bearer"
        assert service.runtime.queue.tasks == ()
        assert not service.runtime.views.status.document()["stopped"]
        assert service.runtime.memory.snapshot().revision == before


async def test_every_stream_refuses_who_has_no_token_or_a_wrong_one_and_every_foreign_host_and_page(
    served, settings, token
):
    streams = all_streams(settings)
    assert streams == ["/v1/stream"]
    for path in streams:
        address = served.address.replace("http", "ws", 1) + path
        for query in ("?token=", "?token=wrong-token-entirely", f"?token={token[:-1]}"):
            async with websockets.connect(address + query) as socket:
                with pytest.raises(websockets.ConnectionClosed):
                    await socket.recv()
                assert socket.close_code == 4401
        for foreign in FOREIGN:
            headers = {"Authorization": f"Bearer {token}"} | foreign
            with pytest.raises(websockets.InvalidStatus) as refusal:
                async with websockets.connect(address, additional_headers=headers):
                    pass
            assert refusal.value.response.status_code in {400, 403}, foreign
    with pytest.raises(websockets.InvalidStatus):
        async with websockets.connect(served.address.replace("http", "ws", 1) + "/v1/status"):
            pass


async def test_a_viewer_reads_everything_and_changes_nothing(in_process, settings, viewer_token):
    as_viewer = {"Authorization": f"Bearer {viewer_token}"}
    async with in_process(settings.model_copy(update={"simulation_api": True})) as service:
        for method, path in all_routes(settings):
            response = await service.client.request(method, path, headers=as_viewer, json={})
            reads = method in {"GET", "HEAD"} or path == "/v1/scene/query"
            assert (response.status_code == 403) is not reads, (method, path)
            if not reads:
                assert response.json()["code"] == "forbidden"
        found = await service.client.post("/v1/scene/query", json={"type": "room"}, headers=as_viewer)
        assert found.json()["total"] == 3
        assert service.runtime.queue.tasks == ()
        assert not service.runtime.views.status.document()["stopped"]


async def test_a_page_that_is_allowed_may_call_and_another_may_not(in_process, settings):
    page = "https://house.example:8443"
    async with in_process(settings.model_copy(update={"allow_origins": (page,)})) as service:
        asked = {"Access-Control-Request-Method": "POST", "Access-Control-Request-Headers": "authorization"}
        bare = {"Authorization": "", "Origin": page} | asked
        preflight = await service.client.options("/v1/tasks", headers=bare)
        assert (preflight.status_code, preflight.headers["access-control-allow-origin"]) == (200, page)
        response = await service.client.get("/v1/status", headers={"Origin": page})
        assert (response.status_code, response.headers["access-control-allow-origin"]) == (200, page)
        foreign = await service.client.options("/v1/tasks", headers=bare | {"Origin": "https://house.example"})
        assert foreign.status_code == 403
        assert "access-control-allow-origin" not in foreign.headers
    async with in_process(settings) as service:
        response = await service.client.get("/v1/status", headers={"Origin": "http://127.0.0.1:8642"})
        assert "access-control-allow-origin" not in response.headers


@pytest.mark.parametrize("name", ["*", "house.example", "https://house.example/", "null", "https://*.example", ""])
def test_what_is_no_origin_cannot_be_allowed(name):
    with pytest.raises(ValueError, match="no origin"):
        Settings(allow_origins=(name,))


async def test_who_calls_too_often_waits_and_can_still_stop_the_robot(in_process, settings, viewer_token):
    async with in_process(settings.model_copy(update={"requests_per_s": 2.0})) as service:
        answers = [await service.client.get("/v1/status") for _ in range(30)]
        refused = [answer for answer in answers if answer.status_code == 429]
        assert refused
        assert {answer.status_code for answer in answers} == {200, 429}
        assert refused[0].json()["code"] == "rate_limited"
        assert int(refused[0].headers["retry-after"]) >= 1
        assert (await service.client.post("/v1/stop")).json() == {"stopped": True}
        viewer = await service.client.get("/v1/status", headers={"Authorization": f"Bearer {viewer_token}"})
        assert viewer.json()["stopped"]
        assert (await service.client.get("/healthz")).status_code == 200


async def test_the_token_is_also_taken_from_the_query_and_a_wrong_one_is_not(service, token):
    bare = {"Authorization": ""}
    assert (await service.client.get("/v1/status", params={"token": token}, headers=bare)).status_code == 200
    assert (await service.client.get("/v1/status", params={"token": token[:-1]}, headers=bare)).status_code == 401
    assert (await service.client.get("/v1/status?token=%ff%ed%a0%80", headers=bare)).status_code == 401


@pytest.mark.parametrize(
    "headers", [{"Host": "evil.example"}, {"Origin": "https://evil.example"}, {"Origin": "null"}, {"Host": "10.1.2.3"}]
)
async def test_a_foreign_host_or_page_is_turned_away_even_with_the_token(service, headers):
    response = await service.client.get("/v1/status", headers=headers)
    assert (response.status_code, response.json()["code"]) == (403, "foreign_origin")


async def test_a_service_on_all_addresses_answers_under_each_but_not_under_names(in_process, settings):
    async with in_process(settings.model_copy(update={"host": "0.0.0.0"})) as service:
        own = {"Host": "192.168.1.7:8642"}
        assert (await service.client.get("/v1/status", headers=own)).status_code == 200
        page = own | {"Origin": "http://192.168.1.7:8642"}
        assert (await service.client.get("/v1/status", headers=page)).status_code == 200
        for foreign in ({"Host": "rebound.example"}, own | {"Origin": "http://6.6.6.6"}):
            assert (await service.client.get("/v1/status", headers=foreign)).status_code == 403


async def test_unknown_paths_and_methods_are_problems(service):
    for method, path, status, code in [
        ("GET", "/v2/tasks", 404, "not_found"),
        ("DELETE", "/v1/tasks", 405, "method_not_allowed"),
        ("GET", "/page/none.js", 404, "not_found"),
        ("GET", "/page/..%2fsettings.py", 404, "not_found"),
    ]:
        response = await service.client.request(method, path)
        assert (response.status_code, response.json()["code"]) == (status, code)


async def test_a_method_that_a_path_does_not_take_is_answered_with_all_that_it_takes(in_process, settings):
    async with in_process(settings.model_copy(update={"simulation_api": True})) as service:
        paths = (await service.client.get("/openapi.json")).json()["paths"]
        allowed = {path: {method.upper() for method in operations} for path, operations in paths.items()}
        for path, methods in (allowed | {"/": {"GET"}, "/openapi.json": {"GET", "HEAD"}}).items():
            for method in {"GET", "HEAD", "POST", "PUT", "PATCH", "DELETE", "OPTIONS", "TRACE"} - methods:
                response = await service.client.request(method, path.replace("{", "").replace("}", ""))
                assert (response.status_code, method, path) == (405, method, path)
                assert set(response.headers["allow"].split(", ")) == methods, path
        page = await service.client.post("/page/main.js")
        assert (page.status_code, page.headers["allow"]) == (405, "GET, HEAD")


async def test_the_page_is_served_without_a_token_and_holds_none(service, token):
    files = sorted(path.name for path in PAGE_FOLDER.iterdir())
    assert {"index.html", "main.js", "style.css"} <= set(files)
    for path in ["/", *(f"/page/{name}" for name in files)]:
        response = await service.client.get(path, headers={"Authorization": ""})
        assert response.status_code == 200
        assert response.headers["cache-control"] == "no-cache"
        assert "default-src 'self'" in response.headers["content-security-policy"]
        assert response.headers["referrer-policy"] == "no-referrer"
        assert token not in response.text


async def test_the_page_asks_for_nothing_from_elsewhere(service):
    for path in PAGE_FOLDER.iterdir():
        text = path.read_text(encoding="utf-8").replace("http://www.w3.org/2000/svg", "")
        assert not re.search(r"(https?:)?//[a-z0-9.-]+\.[a-z]{2,}/", text), path.name
        for module in re.findall(r'from "(.+?)"', text):
            assert (PAGE_FOLDER / module).is_file()


async def test_the_documentation_knows_every_call_and_its_token(service):
    document = (await service.client.get("/openapi.json", headers={"Authorization": ""})).json()
    assert {"/v1/tasks", "/v1/scene", "/v1/status", "/v1/stop", "/v1/map.svg"} <= document["paths"].keys()
    assert document["paths"]["/v1/status"]["get"]["security"] == [{"HTTPBearer": []}]
    assert document["paths"]["/v1/status"]["get"]["x-role"] == "viewer"
    assert document["paths"]["/v1/stop"]["post"]["x-role"] == "operator"


async def test_every_call_is_described_with_its_answers_and_problems(in_process, settings):
    async with in_process(settings.model_copy(update={"simulation_api": True})) as service:
        document = (await service.client.get("/openapi.json")).json()
    for path, operations in document["paths"].items():
        for method, operation in operations.items():
            responses = operation["responses"]
            assert operation["summary"], path
            assert operation["description"], path
            assert ("x-role" in operation) is (path not in {"/healthz", "/readyz"}), path
            if "x-role" in operation:
                assert {"401", "403", "413", "429"} <= responses.keys(), path
            if "requestBody" in operation:
                assert "422" in responses, path
            for status, response in responses.items():
                assert response["description"], (path, status)
                [media] = response["content"]
                assert (media == "application/problem+json") is (status >= "400"), (path, status)
            if method == "get" and "application/json" in responses["200"]["content"] and "simulation" not in path:
                assert responses["200"]["content"]["application/json"]["example"], path


async def test_every_code_that_is_raised_is_documented():
    source = Path(service_module.__file__).parent
    raised = {
        code
        for file in source.rglob("*.py")
        for code in re.findall(r'Problem\(\s*\d+,\s*"(\w+)"', file.read_text("utf-8"))
    }
    assert len(raised) > 10
    assert raised <= CODES.keys()


async def test_the_interactive_documentation_comes_from_here_alone(service):
    page = await service.client.get("/docs", headers={"Authorization": ""})
    assert page.status_code == 200
    assert "default-src 'self'" in page.headers["content-security-policy"]
    for address in re.findall(r'(?:src|href)="([^"]+)"', page.text):
        assert not address.startswith(("http", "//"))
        assert (await service.client.get(f"/{address.lstrip('/')}")).status_code == 200
    for elsewhere in ("/redoc", "/docs/oauth2-redirect"):
        assert (await service.client.get(elsewhere)).status_code == 404
