"""``WS /v1/stream``: numbered events out, requests and stops in."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
from collections.abc import Iterator

from fastapi import APIRouter, WebSocket, WebSocketDisconnect

from app.events.stream import Listener
from app.http.guards.security import Access, offered_token
from app.http.routes.conversation import Conversation, TooManyMessages
from app.runtime import Runtime

logger = logging.getLogger(__name__)

UNAUTHORIZED, TRY_LATER, FLOODED = 4401, 1013, 1008
AUTHENTICATION_TIMEOUT_S = 5.0
SEND_TIMEOUT_S = 20.0

_CLIENT_IS_GONE = (WebSocketDisconnect, TimeoutError, RuntimeError)
"""Ends of a conversation that need no word in the log; ``RuntimeError`` is Starlette's for sending after the end."""


def stream_routes(runtime: Runtime, access: Access) -> APIRouter:
    """The event stream. The token comes as header, as query, or in the first message (``{"token": …}``)."""
    router = APIRouter()
    unknown, clients = Seats(runtime.settings.streams), Seats(runtime.settings.streams)

    @router.websocket("/v1/stream")
    async def stream(socket: WebSocket, since: int | None = None) -> None:
        offered = offered_token(socket)
        await socket.accept()
        if offered is None:
            with unknown.taken() as seated:
                offered = await _token_of_first_message(socket) if seated else None
        role = access.role_of(offered)
        if role is None:
            await socket.close(UNAUTHORIZED, "a valid token is needed")
            return
        with clients.taken() as seated:
            if not seated:
                await socket.close(TRY_LATER, "as many clients as I can serve are listening already")
                return
            with runtime.stream.listen(since) as listener:
                await _converse(socket, listener, Conversation(runtime, role))

    return router


class Seats:
    """Room for so many at a time."""

    def __init__(self, room: int) -> None:
        self._left = room

    @contextlib.contextmanager
    def taken(self) -> Iterator[bool]:
        """Take a seat as long as the context lasts; false if all are taken."""
        seated = self._left > 0
        self._left -= seated
        try:
            yield seated
        finally:
            self._left += seated


async def _converse(socket: WebSocket, listener: Listener, conversation: Conversation) -> None:
    """Send and receive until either ends: the client left, or does not read any more."""
    sending = asyncio.create_task(_send(socket, listener), name="stream send")
    receiving = asyncio.create_task(_receive(socket, conversation), name="stream receive")
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
            await socket.send_text(event.text)


async def _receive(socket: WebSocket, conversation: Conversation) -> None:
    while True:
        text = await _receive_text(socket)
        try:
            reply = conversation.take(text)
        except TooManyMessages as flood:
            await socket.close(FLOODED, str(flood))
            return
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


async def _token_of_first_message(socket: WebSocket) -> str | None:
    try:
        async with asyncio.timeout(AUTHENTICATION_TIMEOUT_S):
            message = json.loads(await _receive_text(socket) or "null")
    except (TimeoutError, WebSocketDisconnect, ValueError, RecursionError):
        return None
    offered = message.get("token") if isinstance(message, dict) else None
    return offered if isinstance(offered, str) else None
