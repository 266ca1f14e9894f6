"""Token, host and body limits, in front of any application."""

from __future__ import annotations

import stat

import httpx
import pytest
from fastapi import Depends, FastAPI

from majordomo.app.http.limits import BodyLimit, HostGuard
from majordomo.app.http.problems import Problem, install_problem_handlers
from majordomo.app.http.security import Token, TokenGuard, is_loopback

pytestmark = pytest.mark.anyio

TOKEN = Token("0123456789abcdef")


@pytest.fixture
def anyio_backend():
    return "asyncio"


@pytest.fixture
async def client():
    app = FastAPI()
    install_problem_handlers(app)

    @app.post("/echo", dependencies=[Depends(TokenGuard(TOKEN))])
    async def echo(body: dict[str, str]) -> dict[str, str]:
        return body

    @app.get("/broken")
    async def broken() -> None:
        raise Problem(409, "not_now", "because")

    app.add_middleware(BodyLimit, max_bytes=1000)
    app.add_middleware(HostGuard, hosts=frozenset({"robot.lan"}))
    transport = httpx.ASGITransport(app=app, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1:1") as client:
        yield client


AUTHORIZED = {"Authorization": f"Bearer {TOKEN.value}"}


async def test_the_token_opens_as_header_and_as_query(client):
    assert (await client.post("/echo", json={}, headers=AUTHORIZED)).status_code == 200
    assert (await client.post(f"/echo?token={TOKEN.value}", json={})).status_code == 200


@pytest.mark.parametrize("headers", [{}, {"Authorization": "Bearer wrong"}, {"Authorization": f"Basic {TOKEN.value}"}])
async def test_without_the_token_a_problem_document_says_where_it_is(client, headers):
    response = await client.post("/echo", json={}, headers=headers)
    assert response.status_code == 401
    assert response.headers["content-type"] == "application/problem+json"
    assert response.json()["code"] == "unauthorized"


@pytest.mark.parametrize("stream", [False, True])
async def test_a_body_over_the_limit_is_refused_announced_or_not(client, stream):
    async def pieces():
        for _ in range(20):
            yield b"x" * 100

    content = pieces() if stream else b"x" * 2000
    response = await client.post("/echo", content=content, headers=AUTHORIZED)
    assert (response.status_code, response.json()["code"]) == (413, "request_too_large")


@pytest.mark.parametrize(
    ("headers", "admitted"),
    [
        ({"Host": "localhost:8642"}, True),
        ({"Host": "[::1]:8642"}, True),
        ({"Host": "robot.lan"}, True),
        ({"Host": "evil.example"}, False),
        ({"Origin": "http://127.0.0.1:8642"}, True),
        ({"Origin": "https://evil.example"}, False),
        ({"Origin": "null"}, False),
    ],
)
async def test_only_own_hosts_and_own_pages_are_answered(client, headers, admitted):
    response = await client.post("/echo", json={}, headers=AUTHORIZED | headers)
    assert (response.status_code == 200) is admitted


async def test_every_error_is_a_problem_document_with_a_stable_code(client):
    expected = {"/broken": (409, "not_now"), "/nowhere": (404, "not_found"), "/echo": (405, "method_not_allowed")}
    for path, (status, code) in expected.items():
        response = await client.get(path)
        assert (response.status_code, response.json()["code"]) == (status, code)
    response = await client.post("/echo", content=b"{", headers=AUTHORIZED)
    assert (response.status_code, response.json()["code"]) == (422, "invalid_request")


def test_a_token_is_made_once_and_only_its_owner_can_read_it(tmp_path):
    first, second = Token.stored_in(tmp_path), Token.stored_in(tmp_path)
    assert first.value == second.value
    assert stat.S_IMODE((tmp_path / "token").stat().st_mode) == 0o600
    assert first.admits(second.value)
    assert not first.admits(None)


def test_loopback_is_told_from_other_addresses():
    assert all(is_loopback(host) for host in ("localhost", "127.0.0.1", "127.8.8.8", "::1", "[::1]"))
    assert not any(is_loopback(host) for host in ("0.0.0.0", "10.0.0.1", "example.org", ""))
