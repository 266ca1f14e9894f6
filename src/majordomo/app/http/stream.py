"""``WS /v1/stream``: numbered events out, requests and stops in."""

from __future__ import annotations

import asyncio
import json
import logging
from typing import Any

from fastapi import APIRouter, WebSocket, WebSocketDisconnect
from pydantic import ValidationError

from majordomo.app.events import Listener
from majordomo.app.http.documents import TaskRequest
from majordomo.app.http.security import Token, offered_token
from majordomo.app.runtime import Runtime

logger = logging.getLogger(__name__)

UNAUTHORIZED = 4401
MAX_MESSAGE_CHARACTERS = 65_536
AUTHENTICATION_TIMEOUT_S = 5.0
SEND_TIMEOUT_S = 20.0

_CLIENT_IS_GONE = (WebSocketDisconnect, TimeoutError, RuntimeError)
"""Ends of a conversation that need no word in the log; ``RuntimeError`` is Starlette's for sending after the end."""


def stream_routes(runtime: Runtime, token: Token) -> APIRouter:
    """The event stream. The token comes as header, as query, or in the first message (``{"token": …}``)."""
    router = APIRouter()

    @router.websocket("/v1/stream")
    async def stream(socket: WebSocket, since: int | None = None) -> None:
        offered = offered_token(socket)
        await socket.accept()
        if offered is None:
            offered = await _token_of_first_message(socket)
        if not token.admits(offered):
            await socket.close(UNAUTHORIZED, "a valid token is needed")
            return
        with runtime.stream.listen(since) as listener:
            await _converse(socket, listener, runtime)

    return router


async def _converse(socket: WebSocket, listener: Listener, runtime: Runtime) -> None:
    """Send and receive until either ends: the client left, or does not read any more."""
    sending = asyncio.create_task(_send(socket, listener), name="stream send")
    receiving = asyncio.create_task(_receive(socket, runtime), name="stream receive")
    try:
        await asyncio.wait({sending, receiving}, return_when=asyncio.FIRST_COMPLETED)
    finally:
        sending.cancel()
        receiving.cancel()
    for outcome in await asyncio.gather(sending, receiving, return_exceptions=True):
        if isinstance(outcome, Exception) and not isinstance(outcome, _CLIENT_IS_GONE):
            logger.warning("stream ended: %s", outcome)


async def _send(socket: WebSocket, listener: Listener) -> None:
    async for event in listener.events():
        async with asyncio.timeout(SEND_TIMEOUT_S):
            await socket.send_text(json.dumps(event.document(), separators=(",", ":")))


async def _receive(socket: WebSocket, runtime: Runtime) -> None:
    while True:
        text = await _receive_text(socket)
        reply = _refusal("not_text", "send JSON as text") if text is None else _obey(text, runtime)
        if reply is not None:
            await socket.send_text(json.dumps(reply))


async def _receive_text(socket: WebSocket) -> str | None:
    """The next message, ``None`` if it is not text.

    Raises:
        WebSocketDisconnect: the client left.
    """
    message = await socket.receive()
    if message["type"] == "websocket.disconnect":
        raise WebSocketDisconnect(message.get("code", 1006), message.get("reason"))
    text: str | None = message.get("text")
    return text


def _obey(text: str, runtime: Runtime) -> dict[str, Any] | None:
    """Carry out one message; the answer, if one is due."""
    if len(text) > MAX_MESSAGE_CHARACTERS:
        return _refusal("message_too_large", f"a message may have at most {MAX_MESSAGE_CHARACTERS} characters")
    try:
        message = json.loads(text)
    except (json.JSONDecodeError, RecursionError) as error:
        return _refusal("invalid_json", str(error))
    match message:
        case {"type": "stop"}:
            runtime.stop_robot()
            return None
        case {"type": "request", "text": str(words)}:
            try:
                request = TaskRequest(request=words)
            except ValidationError as error:
                return _refusal("invalid_request", error.errors()[0]["msg"])
            return {"type": "accepted", "task": runtime.submit(request.request).id}
        case _:
            return _refusal("unknown_message", 'send {"type": "request", "text": "…"} or {"type": "stop"}')


async def _token_of_first_message(socket: WebSocket) -> str | None:
    try:
        async with asyncio.timeout(AUTHENTICATION_TIMEOUT_S):
            message = json.loads(await _receive_text(socket) or "null")
    except (TimeoutError, WebSocketDisconnect, json.JSONDecodeError, RecursionError):
        return None
    offered = message.get("token") if isinstance(message, dict) else None
    return offered if isinstance(offered, str) else None


def _refusal(code: str, detail: str) -> dict[str, str]:
    return {"type": "problem", "code": code, "detail": detail}
