"""One websocket to rosbridge: hands messages on, sends the newest of each kind, and comes back by itself."""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import InvalidHandshake, WebSocketException

from drivers.rosbridge.errors import RobotNotReached

logger = logging.getLogger(__name__)

Hear = Callable[[str, Mapping[str, Any]], None]


@dataclass(frozen=True, kw_only=True)
class ConnectionSettings:
    """How a connection is watched, and taken up again; chosen, so that a robot is missed within seconds."""

    ping_s: float = 2.0
    """Between two signs of life that are asked for."""
    pong_limit_s: float = 5.0
    """So long each may take."""
    open_limit_s: float = 5.0
    close_limit_s: float = 1.0
    pauses_s: tuple[float, ...] = (0.2, 0.5, 1.0, 2.0)
    """Waits between attempts to come back; the last one goes on for ever."""
    message_limit_bytes: int = 32_000_000
    """Room for an uncompressed picture of several megapixels in base 64."""


class Connection:
    """A connection that is kept up as long as ``run`` runs.

    Of what is to be sent only the newest of each topic and action waits, so that nothing old is done after a stall;
    when the connection is lost it is forgotten.

    Attributes:
        up: whether messages can go both ways now.
        problem: why not, in words.
    """

    def __init__(
        self,
        url: str,
        *,
        subscriptions: Mapping[str, str],
        advertised: Mapping[str, str],
        hear: Hear,
        on_change: Callable[[bool], None],
        settings: ConnectionSettings = ConnectionSettings(),
    ) -> None:
        """``subscriptions``, ``advertised``: topic -> type. ``hear``: gets topic and message. ``on_change``: told
        whether the connection is up.
        """
        self.up, self.problem, self._settings = False, "not connected yet", settings
        self._url, self._subscriptions, self._advertised = url, subscriptions, advertised
        self._hear, self._on_change = hear, on_change
        self._outbox: dict[str, dict[str, Any]] = {}
        self._filled = asyncio.Event()
        self._goals = 0

    def publish(self, topic: str, message: Mapping[str, Any]) -> None:
        """Send a message soon, unless a newer one of this topic comes before."""
        self._send(topic, {"op": "publish", "topic": topic, "msg": message})

    def send_goal(self, action: str, kind: str, goal: Mapping[str, Any]) -> None:
        """Give an action a goal, which replaces the one before."""
        self._goals += 1
        number = f"majordomo-goal-{self._goals}"
        request = {"op": "send_action_goal", "id": number, "action": action, "action_type": kind, "args": goal}
        self._send(action, request | {"feedback": False})

    async def sent(self, limit_s: float) -> None:
        """Wait until nothing waits to be sent, or ``limit_s`` have passed."""
        with contextlib.suppress(TimeoutError):
            async with asyncio.timeout(limit_s):
                while self._outbox and self.up:  # noqa: ASYNC110 - the end of a robot's life, once
                    await asyncio.sleep(0.01)

    async def run(self) -> None:
        """Connect, and connect again, until cancelled."""
        attempts, settings = 0, self._settings
        while True:
            try:
                async with connect(
                    self._url,
                    ping_interval=settings.ping_s,
                    ping_timeout=settings.pong_limit_s,
                    open_timeout=settings.open_limit_s,
                    close_timeout=settings.close_limit_s,
                    max_size=settings.message_limit_bytes,
                    compression=None,
                    proxy=None,
                ) as socket:
                    attempts = 0
                    await self._talk(socket)
            except (OSError, InvalidHandshake, WebSocketException, TimeoutError) as error:
                self.problem = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
            except asyncio.CancelledError:
                self.up = False
                raise
            finally:
                self._go_down()
            await asyncio.sleep(settings.pauses_s[min(attempts, len(settings.pauses_s) - 1)])
            attempts += 1

    async def _talk(self, socket: ClientConnection) -> None:
        for topic, kind in self._advertised.items():
            await socket.send(json.dumps({"op": "advertise", "topic": topic, "type": kind}))
        for topic, kind in self._subscriptions.items():
            newest_only = {"queue_length": 1, "throttle_rate": 0}
            await socket.send(json.dumps({"op": "subscribe", "topic": topic, "type": kind} | newest_only))
        self.up, self.problem = True, ""
        logger.info("connected to %s", self._url)
        self._on_change(True)
        sending = asyncio.create_task(self._send_all(socket), name="rosbridge sending")
        try:
            async for text in socket:
                self._take(text)
            self.problem = "rosbridge closed the connection"
        finally:
            sending.cancel()
            with contextlib.suppress(asyncio.CancelledError, WebSocketException, OSError):
                await sending

    async def _send_all(self, socket: ClientConnection) -> None:
        while True:
            await self._filled.wait()
            self._filled.clear()
            while self._outbox:
                await socket.send(json.dumps(self._outbox.pop(next(iter(self._outbox)))))

    def _take(self, text: str | bytes) -> None:
        try:
            document = json.loads(text)
            operation = document.get("op")
        except (ValueError, AttributeError):
            logger.warning("rosbridge sent what is no message, %d bytes", len(text))
            return
        if operation == "publish" and isinstance(document.get("msg"), dict):
            self._hear(str(document.get("topic")), document["msg"])
        elif operation == "status" and document.get("level") in {"error", "warning"}:
            logger.warning("rosbridge says: %s", document.get("msg"))
        elif operation == "action_result" and document.get("result") is False:
            logger.warning("action %s: %s", document.get("action"), document.get("values"))

    def _send(self, key: str, request: dict[str, Any]) -> None:
        if self.up:
            self._outbox.pop(key, None)
            self._outbox[key] = request
            self._filled.set()

    def _go_down(self) -> None:
        self._outbox.clear()
        if self.up:
            self.up = False
            logger.warning("the connection to %s is lost: %s", self._url, self.problem)
            self._on_change(False)


def not_reached(connection: Connection, url: str, missing: list[str]) -> RobotNotReached:
    """Why there is no robot at an address, in words."""
    if not connection.up:
        return RobotNotReached(url, f"no rosbridge answers there: {connection.problem}")
    return RobotNotReached(url, f"rosbridge answers, but nothing came on {', '.join(missing)}")
