"""Token, host and body limits, in front of any application."""

from __future__ import annotations

import stat

import httpx
import pytest
from fastapi import FastAPI

from app.http.documents.problems import Problem, install_problem_handlers
from app.http.guards.gate import Gate
from app.http.guards.limits import BodyLimit, HostGuard
from app.http.guards.rates import Budget, Budgets
from app.http.guards.security import Access, Role, Token, is_loopback

pytestmark = pytest.mark.anyio

TOKEN, VIEWER = Token("0123456789abcdef"), Token("a-viewers-own-token")
ACCESS = Access(operator=TOKEN, viewer=VIEWER)
OTHER_PAGE = "https://house.example"


@pytest.fixture
def anyio_backend():
    return "asyncio"


@pytest.fixture
async def client():
    app = FastAPI()
    install_problem_handlers(app)

    @app.post("/echo")
    async def echo(body: dict[str, str]) -> dict[str, str]:
        return body

    @app.get("/broken")
    async def broken() -> None:
        raise Problem(409, "not_now", "because")

    @app.post("/v1/stop")
    async def stop() -> None: ...

    app.add_middleware(BodyLimit, max_bytes=1000)
    app.add_middleware(Gate, access=ACCESS, budgets=Budgets(rate_hz=1.0, burst=30, clock=lambda: 0.0))
    app.add_middleware(HostGuard, hosts=frozenset({"robot.lan"}), origins=frozenset({OTHER_PAGE}))
    transport = httpx.ASGITransport(app=app, raise_app_exceptions=False)
    async with httpx.AsyncClient(transport=transport, base_url="http://127.0.0.1:1") as client:
        yield client


AUTHORIZED = {"Authorization": f"Bearer {TOKEN.value}"}
AS_VIEWER = {"Authorization": f"Bearer {VIEWER.value}"}


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
        ({"Host": "ROBOT.lan", "Origin": "http://robot.lan"}, True),
        ({"Host": "robot.lan:8642", "Origin": "http://robot.lan:8642"}, True),
        ({"Host": "evil.example"}, False),
        ({"Host": ""}, False),
        ({"Host": "robot.lan.evil.example"}, False),
        ({"Host": "robot.lan", "Origin": "http://robot.lan:3000"}, False),
        ({"Origin": "http://127.0.0.1:1"}, True),
        ({"Origin": "http://localhost:1"}, True),
        ({"Origin": "http://127.0.0.1:3000"}, False),
        ({"Origin": "http://127.0.0.1:1@evil.example"}, False),
        ({"Origin": "http://127.0.0.1:1.evil.example"}, False),
        ({"Origin": OTHER_PAGE}, True),
        ({"Origin": OTHER_PAGE + ":8443"}, False),
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
        response = await client.get(path, headers=AUTHORIZED)
        assert (response.status_code, response.json()["code"]) == (status, code)
    response = await client.post("/echo", content=b"{", headers=AUTHORIZED)
    assert (response.status_code, response.json()["code"]) == (422, "invalid_request")


async def test_a_viewers_token_reads_and_does_not_act(client):
    assert (await client.get("/nowhere", headers=AS_VIEWER)).status_code == 404
    for path in ("/echo", "/v1/stop", "/nowhere"):
        response = await client.post(path, json={}, headers=AS_VIEWER)
        assert (response.status_code, response.json()["code"]) == (403, "forbidden")


async def test_a_path_that_leads_nowhere_asks_for_the_token_too(client):
    assert (await client.get("/nowhere")).status_code == 401


async def test_who_comes_too_often_is_told_when_to_come_back_and_can_still_stop(client):
    for _ in range(30):
        assert (await client.post("/echo", json={}, headers=AUTHORIZED)).status_code == 200
    response = await client.post("/echo", json={}, headers=AUTHORIZED)
    assert (response.status_code, response.json()["code"]) == (429, "rate_limited")
    assert response.headers["retry-after"] == "1"
    assert (await client.post("/v1/stop", headers=AUTHORIZED)).status_code == 200
    assert (await client.get("/nowhere", headers=AS_VIEWER)).status_code == 404, "others have budgets of their own"
    assert (await client.get("/nowhere")).status_code == 401


async def test_guessing_tokens_is_limited_too(client):
    guesses = [await client.get("/nowhere", headers={"Authorization": f"Bearer guess-{n}"}) for n in range(31)]
    assert [guess.status_code for guess in guesses] == [401] * 30 + [429]
    assert (await client.post("/echo", json={}, headers=AUTHORIZED)).status_code == 200


def test_a_budget_fills_up_again_with_time_and_never_above_its_size():
    now_s = 0.0
    budget = Budget(rate_hz=2.0, burst=3.0, clock=lambda: now_s)
    assert [budget.take() for _ in range(4)] == [0.0, 0.0, 0.0, 0.5]
    now_s = 0.5
    assert [budget.take() for _ in range(2)] == [0.0, 0.5]
    now_s = 1000.0
    assert [budget.take() for _ in range(4)] == [0.0, 0.0, 0.0, 0.5]


def test_callers_beyond_those_that_are_remembered_begin_with_a_full_budget():
    budgets = Budgets(rate_hz=1.0, burst=1.0, clock=lambda: 0.0)
    assert (budgets.take("first"), budgets.take("first")) == (0.0, 1.0)
    assert all(budgets.take(number) == 0.0 for number in range(2000))
    assert budgets.take("first") == 0.0


def test_a_token_opens_what_its_role_may():
    assert ACCESS.role_of(TOKEN.value) is Role.OPERATOR
    assert ACCESS.role_of(VIEWER.value) is Role.VIEWER
    assert ACCESS.role_of("neither of the two") is ACCESS.role_of(None) is None
    assert Access(operator=TOKEN).role_of(VIEWER.value) is None


def test_a_token_is_made_once_and_only_its_owner_can_read_it(tmp_path):
    first, second = Token.stored_in(tmp_path), Token.stored_in(tmp_path)
    assert first.value == second.value
    assert stat.S_IMODE((tmp_path / "token").stat().st_mode) == 0o600
    assert first.admits(second.value)
    assert not first.admits(None)


def test_loopback_is_told_from_other_addresses():
    assert all(is_loopback(host) for host in ("localhost", "127.0.0.1", "127.8.8.8", "::1", "[::1]"))
    assert not any(is_loopback(host) for host in ("0.0.0.0", "10.0.0.1", "example.org", ""))


@pytest.mark.parametrize("damage", [b"short", b"\xff\xfe not a token at all", "ein schönes Token".encode()])
def test_a_token_file_that_holds_none_is_told_with_what_to_do_and_left_alone(tmp_path, damage):
    (tmp_path / "token").write_bytes(damage)
    with pytest.raises(OSError, match="delete it, and a new one is made"):
        Token.stored_in(tmp_path)
    assert (tmp_path / "token").read_bytes() == damage


def test_a_token_file_that_a_crash_left_empty_gets_a_token(tmp_path):
    (tmp_path / "token").write_bytes(b"")
    made = Token.stored_in(tmp_path)
    assert Token.stored_in(tmp_path).value == made.value
