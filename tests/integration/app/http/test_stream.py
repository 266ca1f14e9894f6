"""The event stream on a real socket: who may listen, what comes first, numbers without gap, and words sent into it."""

from __future__ import annotations

import asyncio
import contextlib
import json
from dataclasses import dataclass

import pytest
import websockets

from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving

pytestmark = pytest.mark.anyio

KINDS = {"snapshot", "scene", "task", "robot", "perception", "log"}


@contextlib.asynccontextmanager
async def stream(served, bearer, **query):
    address = served.address.replace("http", "ws", 1) + "/v1/stream"
    parameters = "&".join(f"{key}={value}" for key, value in query.items())
    headers = {"Authorization": f"Bearer {bearer}"} if bearer else {}
    async with websockets.connect(f"{address}?{parameters}", additional_headers=headers, max_size=None) as socket:
        yield socket


async def receive(socket, wanted=lambda message: True):
    """The next message that is wanted."""
    async with asyncio.timeout(10.0):
        while not wanted(message := json.loads(await socket.recv())):
            pass
    return message


async def closed(socket):
    async with asyncio.timeout(10.0):
        await socket.wait_closed()
    return socket.close_code


async def test_a_snapshot_comes_first_and_then_numbers_without_gap(served, token):
    async with stream(served, token) as socket:
        first = await receive(socket)
        assert first["type"] == "snapshot"
        assert first["data"].keys() >= {"scene", "tasks", "robot", "status"}
        assert first["data"]["scene"] == (await served.client.get("/v1/scene")).json()
        events = [await receive(socket) for _ in range(10)]
    assert [event["seq"] for event in events] == list(range(first["seq"] + 1, first["seq"] + 11))
    assert {event["type"] for event in events} <= KINDS
    assert all(event.keys() == {"seq", "type", "stamp_s", "data"} for event in events)


async def test_who_returns_with_a_number_gets_what_was_missed_and_nothing_twice(served, token):
    async with stream(served, token) as socket:
        seen = [(await receive(socket))["seq"]]
    await served.ask("where is the red apple?")
    async with stream(served, token, since=seen[0]) as socket:
        missed = []
        while not missed or missed[-1]["type"] != "task" or missed[-1]["data"]["status"] != "succeeded":
            missed.append(await receive(socket))
    assert [event["seq"] for event in missed] == list(range(seen[0] + 1, seen[0] + 1 + len(missed)))
    statuses = [event["data"]["status"] for event in missed if event["type"] == "task"]
    assert statuses == ["queued", "planning", "succeeded"]


@pytest.mark.parametrize("since", [-5, 0, 3, 10**15])
async def test_a_number_of_another_life_gets_a_snapshot(served, token, since):
    async with stream(served, token, since=since) as socket:
        assert (await receive(socket))["type"] == "snapshot"


async def test_a_number_that_is_none_is_turned_away(served, token):
    with pytest.raises(websockets.InvalidStatus):
        async with stream(served, token, since="yesterday"):
            pass


async def test_the_token_comes_as_header_as_query_or_in_the_first_message(served, token):
    async with stream(served, token) as socket:
        assert (await receive(socket))["type"] == "snapshot"
    async with stream(served, None, token=token) as socket:
        assert (await receive(socket))["type"] == "snapshot"
    async with stream(served, None) as socket:
        await socket.send(json.dumps({"type": "auth", "token": token}))
        assert (await receive(socket))["type"] == "snapshot"


@pytest.mark.parametrize(
    "message",
    ['{"token": "not-the-one-you-want"}', '{"token": 7}', "[]", "nonsense", '{"token": "\\ud800"}', b"\x00\x01", "["],
)
async def test_a_wrong_first_message_closes_with_4401(served, message):
    async with stream(served, None) as socket:
        await socket.send(message)
        assert await closed(socket) == 4401


@pytest.mark.parametrize("query", [{"token": "not-the-one-you-want"}, {"token": ""}])
async def test_a_wrong_token_closes_with_4401_before_anything_is_told(served, query):
    async with stream(served, None, **query) as socket:
        with pytest.raises(websockets.ConnectionClosed):
            await receive(socket)
        assert socket.close_code == 4401


async def test_a_foreign_page_gets_no_stream(served, token):
    address = served.address.replace("http", "ws", 1) + f"/v1/stream?token={token}"
    with pytest.raises(websockets.InvalidStatus) as refusal:
        async with websockets.connect(address, origin="https://evil.example"):
            pass
    assert refusal.value.response.status_code == 403


async def test_a_request_can_be_made_through_the_stream(served, token):
    async with stream(served, token) as socket:
        await socket.send(json.dumps({"type": "request", "text": "bring the blue bottle to the desk"}))
        accepted = await receive(socket, lambda message: message["type"] == "accepted")
        done = await receive(socket, lambda m: m["type"] == "task" and m["data"]["status"] == "succeeded")
    assert done["data"]["id"] == accepted["task"]
    assert done["data"]["plan"]["steps"]


async def test_stop_works_through_the_stream(served, token):
    async with stream(served, token) as socket:
        await socket.send('{"type": "stop"}')
        await receive(socket, lambda message: message["type"] == "robot" and message["data"]["stopped"])
        assert (await served.client.get("/v1/status")).json()["stopped"]
        await served.client.post("/v1/resume")
        await receive(socket, lambda message: message["type"] == "robot" and not message["data"]["stopped"])


async def test_what_is_no_message_is_answered_and_the_stream_goes_on(served, token):
    wrong = {
        "hello": "invalid_json",
        "[" * 20_000: "invalid_json",
        "{}": "unknown_message",
        "null": "unknown_message",
        '{"type": "dance"}': "unknown_message",
        '{"type": "request"}': "unknown_message",
        '{"type": "request", "text": 5}': "unknown_message",
        '{"type": "request", "text": " "}': "invalid_request",
        json.dumps({"type": "request", "text": "x" * 10_001}): "invalid_request",
        b"\x00\xff": "not_text",
    }
    async with stream(served, token) as socket:
        for message, code in wrong.items():
            await socket.send(message)
            problem = await receive(socket, lambda received: received["type"] == "problem")
            assert (problem["code"], bool(problem["detail"])) == (code, True)
            assert code != "invalid_request" or problem["detail"].startswith("The request ")
        await receive(socket, lambda message: message["type"] == "robot")
    assert (await served.client.get("/v1/tasks")).json()["total"] == 0


async def test_teaching_is_seen_by_everyone_who_listens(served, token):
    async with stream(served, token) as one, stream(served, token) as other:
        await served.client.patch("/v1/scene/nodes/room_3", json={"label": "study"})
        for socket in (one, other):
            told = await receive(
                socket,
                lambda message: (
                    message["type"] == "scene"
                    and any(
                        node["id"] == "room_3" and node["label"] == "study" for node in message["data"]["put_nodes"]
                    )
                ),
            )
            assert told["data"]["revision"] == served.runtime.memory.snapshot().revision


async def test_a_client_that_left_is_forgotten(served, token):
    async with stream(served, token) as socket:
        await receive(socket)
        assert len(served.runtime.stream._listeners) == 1
    while served.runtime.stream._listeners:
        await served.runtime.wait_for_change()


async def test_a_megabyte_is_refused_on_a_real_socket_and_the_connection_serves_on(served):
    refused = await served.client.post("/v1/tasks", content=b"x" * 1_000_000)
    assert (refused.status_code, refused.json()["code"]) == (413, "request_too_large")

    async def pieces():
        for _ in range(100):
            yield b"x" * 10_000

    unannounced = await served.client.post("/v1/tasks", content=pieces())
    assert (unannounced.status_code, unannounced.json()["code"]) == (413, "request_too_large")
    assert (await served.client.get("/healthz")).status_code == 200


async def test_a_client_that_hangs_up_in_the_middle_of_a_request_starts_nothing(served, token):
    host, port = served.address.removeprefix("http://").split(":")
    reader, writer = await asyncio.open_connection(host, int(port))
    head = f"POST /v1/tasks HTTP/1.1\r\nHost: {host}\r\nAuthorization: Bearer {token}\r\nContent-Length: 500\r\n"
    writer.write(head.encode() + b'Content-Type: application/json\r\n\r\n{"request": "go to the kitchen"}')
    await writer.drain()
    writer.close()
    await writer.wait_closed()
    assert await reader.read() == b""
    await served.ask("where is the red apple?")
    assert (await served.client.get("/v1/tasks")).json()["total"] == 1


async def test_a_viewer_sees_the_stream_and_cannot_act_through_it(served, viewer_token):
    async with stream(served, viewer_token) as socket:
        assert (await receive(socket))["type"] == "snapshot"
        for message in ({"type": "stop"}, {"type": "request", "text": "go to the kitchen"}):
            await socket.send(json.dumps(message))
            problem = await receive(socket, lambda received: received["type"] == "problem")
            assert problem["code"] == "forbidden"
    assert not (await served.client.get("/v1/status")).json()["stopped"]
    assert (await served.client.get("/v1/tasks")).json()["total"] == 0


async def test_who_floods_the_stream_is_told_to_wait_can_still_stop_and_is_closed_at_last(served, token):
    async with stream(served, token) as socket:
        for _ in range(120):
            await socket.send("{}")
        await receive(socket, lambda message: message.get("code") == "rate_limited")
        await socket.send('{"type": "stop"}')
        await receive(socket, lambda message: message["type"] == "robot" and message["data"]["stopped"])
        with contextlib.suppress(websockets.ConnectionClosed):
            for _ in range(2000):
                await socket.send("{}")
        while socket.close_code is None:
            with contextlib.suppress(websockets.ConnectionClosed):
                await receive(socket)
        assert socket.close_code == 1008


async def test_a_message_that_is_too_long_closes_the_stream(served, token):
    async with stream(served, token) as socket:
        await socket.send("x" * 70_000)
        while socket.close_code is None:
            with contextlib.suppress(websockets.ConnectionClosed):
                await receive(socket)
        assert socket.close_code == 1009


async def test_a_number_too_long_to_read_is_refused_and_the_stream_goes_on(served, token):
    async with stream(served, token) as socket:
        await socket.send('{"type": ' + "1" * 10_000 + "}")
        assert (await receive(socket, lambda message: message["type"] == "problem"))["code"] == "invalid_json"


@pytest.fixture
async def small(settings, token):
    """A service with room for two clients."""
    runtime = Runtime(settings.model_copy(update={"streams": 2}))
    with bind(settings) as listener:
        address = page_address(listener, Token(token)).partition("/?")[0]
        async with serving(runtime, listener, Token(token)):
            yield Small(address=address, runtime=runtime)


async def test_more_clients_than_there_is_room_for_are_turned_away_until_one_leaves(small, token):
    async with stream(small, token) as one, stream(small, token) as other:
        assert [(await receive(socket))["type"] for socket in (one, other)] == ["snapshot"] * 2
        async with stream(small, token) as third:
            assert await closed(third) == 1013
    while small.runtime.stream.listeners:
        await small.runtime.wait_for_change()
    async with stream(small, token) as again:
        assert (await receive(again))["type"] == "snapshot"


async def test_who_does_not_say_who_he_is_is_not_waited_for_when_many_do_not(small, token):
    async with stream(small, None), stream(small, None):
        async with stream(small, None) as one_more:
            assert await closed(one_more) == 4401
        async with stream(small, token) as known:
            assert (await receive(known))["type"] == "snapshot"


@dataclass(frozen=True, kw_only=True)
class Small:
    """A service with little room."""

    address: str
    runtime: Runtime
