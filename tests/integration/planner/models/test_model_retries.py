"""What every adapter of a language model tries again, how long it waits, and when it gives up."""

from __future__ import annotations

import socket
import time

import pytest

from asked_model import GOOD, Time, ask, assert_failed
from model_server import Line
from planner.models.exchange import ExchangeSettings
from planner.models.protocol import FailureKind, ModelReply

pytestmark = pytest.mark.anyio


@pytest.mark.parametrize("status", [408, 429, 500, 502, 503, 529])
async def test_a_failure_that_may_pass_is_tried_again(dialect, status):
    clock = Time()
    outcome, server = await ask(dialect, Line(body="busy", status=status), Line(body=dialect.text(GOOD)), clock=clock)
    assert isinstance(outcome, ModelReply)
    assert (outcome.attempts, len(server.requests), clock.naps) == (2, 2, [0.5])


@pytest.mark.parametrize(
    "error", [{"code": 429, "message": "busy"}, {"message": "busy"}, "busy", {"code": "overloaded"}]
)
async def test_an_error_under_the_status_of_a_success_is_one(dialect, error):
    outcome, server = await ask(dialect, Line(body={"error": error}), Line(body=dialect.text(GOOD)))
    assert isinstance(outcome, ModelReply)
    assert len(server.requests) == 2
    outcome, server = await ask(dialect, Line(body={"error": {"code": 401, "message": "who are you?"}}))
    assert_failed(outcome, FailureKind.HTTP_ERROR)
    assert "key" in outcome.message


async def test_an_answer_that_speaks_of_an_error_or_has_none_is_an_answer(dialect):
    outcome, _ = await ask(dialect, Line(body=dialect.text('{"a": 1, "error": "none"}') | {"error": None}))
    assert isinstance(outcome, ModelReply)


async def test_a_server_that_stays_out_of_order_is_given_up_after_three_attempts(dialect):
    clock = Time()
    outcome, server = await ask(dialect, Line(body="Traceback: secret", status=500), clock=clock)
    assert_failed(outcome, FailureKind.SERVER_ERROR, attempts=3)
    assert "status 500" in outcome.message
    assert "secret" not in outcome.message
    assert (len(server.requests), clock.naps) == (3, [0.5, 1.0])


@pytest.mark.parametrize(
    "headers",
    [
        {"Retry-After": "7"},
        {"Retry-After": "Sun, 06 Nov 1994 08:49:44 GMT", "Date": "Sun, 06 Nov 1994 08:49:37 GMT"},
    ],
    ids=["seconds", "date"],
)
async def test_a_wait_that_fits_into_the_deadline_is_kept(dialect, headers):
    clock, limit = Time(), Line(status=429, headers=headers)
    outcome, _ = await ask(dialect, limit, Line(body=dialect.text(GOOD)), clock=clock)
    assert isinstance(outcome, ModelReply)
    assert clock.naps == [7.0]


@pytest.mark.parametrize(
    ("deadline_s", "wait"), [(15.0, "16"), (3600.0, "1800")], ids=["past the deadline", "too long to hold a queue"]
)
async def test_a_wait_that_does_not_fit_ends_it_at_once(dialect, deadline_s, wait):
    clock, limit = Time(), Line(status=429, headers={"Retry-After": wait})
    outcome, server = await ask(dialect, limit, deadline_s=deadline_s, clock=clock)
    assert_failed(outcome, FailureKind.RATE_LIMITED)
    assert outcome.wait_s == float(wait)
    assert f"{wait} s" in outcome.message
    assert (len(server.requests), clock.naps) == (1, [])


@pytest.mark.parametrize("wait", ["soon", "-3", "nan", "", "Sun, 06 Nov 1994 08:49:44 GMT"])
async def test_a_wait_that_cannot_be_read_is_none(dialect, wait):
    clock, limit = Time(), Line(status=429, headers={"Retry-After": wait})
    outcome, _ = await ask(dialect, limit, Line(body=dialect.text(GOOD)), clock=clock)
    assert isinstance(outcome, ModelReply)
    assert clock.naps == [0.5]


async def test_one_deadline_ends_slow_bytes(dialect):
    started_s = time.perf_counter()
    outcome, _ = await ask(dialect, Line(body=dialect.text(GOOD), pause_s=0.05), deadline_s=0.2)
    assert_failed(outcome, FailureKind.TIMEOUT)
    assert time.perf_counter() - started_s < 3


async def test_no_attempt_begins_after_the_deadline(dialect):
    clock, patient = Time(), ExchangeSettings(wait_s=12.0, longest_wait_s=60.0)
    outcome, server = await ask(dialect, Line(status=500), deadline_s=30.0, clock=clock, exchange=patient)
    assert_failed(outcome, FailureKind.SERVER_ERROR, attempts=2)
    assert (len(server.requests), clock.naps) == (2, [12.0])


async def test_a_cut_connection_is_tried_again(dialect):
    whole = Line(body=dialect.text(GOOD))
    outcome, _ = await ask(dialect, Line(body=dialect.text(GOOD), cut=True), whole)
    assert isinstance(outcome, ModelReply)
    outcome, server = await ask(dialect, Line(body=dialect.text(GOOD), cut=True))
    assert_failed(outcome, FailureKind.ENDPOINT_DOWN, attempts=3)
    assert server.url.removeprefix("http://") in outcome.message


async def test_a_dead_endpoint_is_named_without_its_password(dialect):
    with socket.create_server(("127.0.0.1", 0)) as taken:
        port = taken.getsockname()[1]
    outcome, _ = await ask(dialect, Line(), url=f"http://user:passw0rd@127.0.0.1:{port}/v1")
    assert_failed(outcome, FailureKind.ENDPOINT_DOWN, attempts=3)
    assert f"127.0.0.1:{port}" in outcome.message
    assert "passw0rd" not in outcome.message


@pytest.mark.parametrize("url", ["http://", "http://[", "http://h:port", "http://no such host/"])
async def test_an_address_that_is_none_is_a_dead_endpoint(dialect, url):
    outcome, _ = await ask(dialect, Line(), url=url)
    assert_failed(outcome, FailureKind.ENDPOINT_DOWN, attempts=3)
