"""Many clients of the event stream, in a process of their own: most read all they get, some never read."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import re
import secrets
import socket
import time
from dataclasses import dataclass, field

from websockets.asyncio.client import ClientConnection, connect
from websockets.exceptions import ConnectionClosed

_HEAD = re.compile(r'\{"seq":(\d+),"type":"(\w+)"')


@dataclass(frozen=True, kw_only=True)
class Heard:
    """What the clients that read have got.

    Attributes:
        events: of all of them together. ``fewest``: of the one that got fewest.
        gaps: numbers that were skipped. ``snapshots``: taken after the first, because a client had fallen behind.
        closed: clients whose connection ended before its time.
    """

    clients: int = 0
    events: int = 0
    fewest: int = 0
    gaps: int = 0
    snapshots: int = 0
    closed: int = 0


@dataclass(kw_only=True)
class Reader:
    """One client's account of what it has got."""

    events: int = 0
    gaps: int = 0
    snapshots: int = 0
    closed: bool = False
    last_seq: int | None = field(default=None, repr=False)

    def hear(self, text: str) -> None:
        """Take in a message; what is no event has no number."""
        head = _HEAD.match(text)
        if head is None:
            return
        seq = int(head[1])
        if head[2] == "snapshot":
            self.snapshots += self.last_seq is not None
        elif self.last_seq is not None and seq != self.last_seq + 1:
            self.gaps += abs(seq - self.last_seq - 1)
        self.last_seq = seq
        self.events += 1


def listen(port: int, token: str, readers: int, mute: int, seconds: float) -> Heard:
    """Connect, and listen for so many wall seconds from then on.

    Raises:
        OSError: the service does not let in as many.
    """
    return asyncio.run(_listen(port, token, readers, mute, seconds))


async def _listen(port: int, token: str, readers: int, mute: int, seconds: float) -> Heard:
    with contextlib.ExitStack() as silent:
        for _ in range(mute):
            silent.enter_context(contextlib.closing(knock(port, token)))
        async with contextlib.AsyncExitStack() as reading:
            sockets = await _connected(port, token, readers, reading)
            until_s = time.monotonic() + seconds
            accounts = await asyncio.gather(*(_read(one, until_s) for one in sockets))
    return Heard(
        clients=len(accounts),
        events=sum(one.events for one in accounts),
        fewest=min((one.events for one in accounts), default=0),
        gaps=sum(one.gaps for one in accounts),
        snapshots=sum(one.snapshots for one in accounts),
        closed=sum(one.closed for one in accounts),
    )


async def _connected(
    port: int, token: str, count: int, stack: contextlib.AsyncExitStack, *, at_once: int = 20, timeout_s: float = 30.0
) -> list[tuple[ClientConnection, Reader]]:
    """Clients that read from the moment at which they are let in; ``at_once`` of them knock at the same time."""
    found: list[tuple[ClientConnection, Reader]] = []
    address, headers = f"ws://127.0.0.1:{port}/v1/stream", {"Authorization": f"Bearer {token}"}
    while len(found) < count:
        batch = [
            connect(address, additional_headers=headers, max_size=None, open_timeout=timeout_s, proxy=None)
            for _ in range(min(at_once, count - len(found)))
        ]
        sockets = await asyncio.gather(*batch)
        for one in sockets:
            stack.push_async_callback(one.close)
            found.append((one, Reader()))
    return found


async def _read(client: tuple[ClientConnection, Reader], until_s: float) -> Reader:
    socket_, account = client
    with contextlib.suppress(TimeoutError):
        async with asyncio.timeout(until_s - time.monotonic()):
            try:
                async for message in socket_:
                    account.hear(str(message))
                account.closed = True
            except ConnectionClosed:
                account.closed = True
    return account


def knock(port: int, token: str, *, buffer_bytes: int = 4096) -> socket.socket:
    """A client that is let in and does not read: neither an event nor even the answer to its knocking.

    ``buffer_bytes``: little, so that what is sent to it soon stays with the sender.
    """
    client = socket.socket()
    client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, buffer_bytes)
    client.connect(("127.0.0.1", port))
    key = base64.b64encode(secrets.token_bytes(16)).decode()
    lines = (
        "GET /v1/stream HTTP/1.1",
        f"Host: 127.0.0.1:{port}",
        "Upgrade: websocket",
        "Connection: Upgrade",
        f"Sec-WebSocket-Key: {key}",
        "Sec-WebSocket-Version: 13",
        f"Authorization: Bearer {token}",
        "\r\n",
    )
    client.sendall("\r\n".join(lines).encode())
    return client
