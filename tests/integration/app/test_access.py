"""Who gets in: every route asks for the token, foreign hosts and pages are turned away, the page itself is open."""

from __future__ import annotations

import re

import pytest
from fastapi.routing import APIRoute, APIWebSocketRoute
from starlette.routing import Mount, Route

from majordomo.app.http.security import Token
from majordomo.app.http.service import PAGE_FOLDER, make_service
from majordomo.app.runtime import Runtime

pytestmark = pytest.mark.anyio

OPEN = {"/", "/healthz", "/readyz", "/docs", "/docs/oauth2-redirect", "/redoc", "/openapi.json"}
"""Yes or no, and text that is the same in every installation."""


def all_routes(settings):
    app = make_service(Runtime(settings.model_copy(update={"simulation_api": True})), Token("0" * 16))
    return flat(app.routes)


def flat(routes):
    for route in routes:
        inner = getattr(route, "original_router", None) or getattr(route, "router", None)
        if inner is not None and not isinstance(route, Mount):
            yield from flat(inner.routes)
        else:
            yield route


async def test_every_route_refuses_without_the_token_except_health_and_the_page(in_process, settings):
    calls = []
    for route in all_routes(settings):
        if isinstance(route, APIWebSocketRoute):
            assert route.path == "/v1/stream"
        elif isinstance(route, Mount):
            assert route.path == "/page"
        elif isinstance(route, Route | APIRoute) and route.path not in OPEN:
            calls += [(method, re.sub(r"{\w+}", "x", route.path)) for method in route.methods]
    assert len(calls) >= 20
    async with in_process(settings.model_copy(update={"simulation_api": True})) as service:
        for method, path in calls:
            for header in ("", "Bearer ", "Bearer wrong-token-entirely", "Basic eDp5"):
                response = await service.client.request(method, path, headers={"Authorization": header}, json={})
                assert (response.status_code, path) == (401, path)
            assert response.headers["www-authenticate"] == "Bearer"
            assert response.json()["code"] == "unauthorized"


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
