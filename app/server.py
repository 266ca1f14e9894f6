"""Runs the HTTP application on a bound socket, and tells the address before anything else is printed."""

from __future__ import annotations

import contextlib
import json
import os
import socket
from collections.abc import AsyncIterator, Callable, Iterator

import uvicorn

from app.errors import RefusedToBind
from app.garbage_collection import exempt_what_is_loaded
from app.http.guards.security import Token, is_loopback
from app.http.service import make_service
from app.runtime import Runtime
from app.settings import Settings

SHUTDOWN_TIMEOUT_S = 5
"""So long connections may take to end; chosen."""
SWITCH_INTERVAL_S = 0.001
"""How long perception's threads may hold the interpreter while a request waits."""


def bind(settings: Settings) -> socket.socket:
    """A listening socket; port 0 picks a free one.

    Raises:
        RefusedToBind: the port is taken, or the host is not this machine's.
    """
    if not settings.host.strip():
        raise RefusedToBind("there is no address to listen on: name one with --host, or leave the option away")
    family = socket.AF_INET6 if ":" in settings.host else socket.AF_INET
    listener = socket.socket(family, socket.SOCK_STREAM, socket.IPPROTO_TCP)
    listener.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
    listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)  # connections inherit it: no 40 ms for a late ACK
    try:
        listener.bind((settings.host, settings.port))
    except (OSError, TypeError) as error:  # what cannot be encoded as a host's name is a TypeError
        listener.close()
        reason = getattr(error, "strerror", None) or error
        raise RefusedToBind(f"cannot listen on {settings.host}:{settings.port}: {reason}") from error
    listener.listen(128)
    return listener


def page_address(listener: socket.socket, token: Token) -> str:
    """The page's address with its token."""
    host, port = listener.getsockname()[:2]
    shown = f"[{host}]" if ":" in host else host
    return f"http://{shown}:{port}/?token={token.value}"


class _Server(uvicorn.Server):
    """A uvicorn server around a running runtime.

    ``life`` holds what starts before the first connection and ends after the last, whatever signal ends the process.
    What keeps the runtime from starting is raised by ``serve``.
    """

    def __init__(self, config: uvicorn.Config, runtime: Runtime, on_ready: Callable[[], None]) -> None:
        super().__init__(config)
        self.life = contextlib.AsyncExitStack()
        self._runtime = runtime
        self._on_ready = on_ready

    async def startup(self, sockets: list[socket.socket] | None = None) -> None:
        await self.life.enter_async_context(self._runtime.running())
        await super().startup(sockets)
        exempt_what_is_loaded()
        if self.started and not self.should_exit:
            self._on_ready()

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        await super().shutdown(sockets)
        await self.life.aclose()


async def serve(
    runtime: Runtime,
    listener: socket.socket,
    token: Token,
    on_ready: Callable[[], None],
    *,
    viewer: Token | None = None,
) -> bool:
    """Serve until interrupted; whether start-up succeeded."""

    def ready() -> None:
        server.life.enter_context(_announced(runtime.settings, listener, token))
        on_ready()

    server = _make_server(runtime, token, ready, viewer)
    await server.serve(sockets=[listener])
    return server.started


@contextlib.asynccontextmanager
async def serving(
    runtime: Runtime, listener: socket.socket, token: Token, *, viewer: Token | None = None
) -> AsyncIterator[None]:
    """Serve in the background of a program that works with the runtime itself (the demo)."""
    import asyncio

    ready = asyncio.Event()
    server = _make_server(runtime, token, ready.set, viewer)
    task = asyncio.create_task(server.serve(sockets=[listener]))
    waiting = asyncio.create_task(ready.wait())
    await asyncio.wait({task, waiting}, return_when=asyncio.FIRST_COMPLETED)
    waiting.cancel()
    if task.done():
        task.result()
        raise RefusedToBind("the service did not start; its log says why")
    try:
        yield
    finally:
        server.should_exit = True
        await task


def _make_server(runtime: Runtime, token: Token, on_ready: Callable[[], None], viewer: Token | None) -> _Server:
    config = uvicorn.Config(
        make_service(runtime, token, viewer),
        lifespan="off",
        log_level="warning",
        access_log=False,
        ws_max_size=65_536,
        ws_per_message_deflate=False,  # two hundred clients would be two hundred compressions of every event
        timeout_graceful_shutdown=SHUTDOWN_TIMEOUT_S,
        server_header=False,
    )
    return _Server(config, runtime, on_ready)


@contextlib.contextmanager
def _announced(settings: Settings, listener: socket.socket, token: Token) -> Iterator[None]:
    """Leave address and token in the data folder for ``majordomo ask``, for as long as the service runs."""
    path = settings.data_folder / "service.json"
    address = page_address(listener, token).partition("/?")[0]
    descriptor = os.open(path, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
    with os.fdopen(descriptor, "w", encoding="ascii") as file:
        json.dump({"address": address, "token": token.value, "pid": os.getpid()}, file)
    try:
        yield
    finally:
        path.unlink(missing_ok=True)


def check_exposure(settings: Settings, *, has_token: bool) -> None:
    """Refuse to listen beyond this machine without a token.

    Raises:
        RefusedToBind: naming the host.
    """
    if not is_loopback(settings.host) and not has_token:
        raise RefusedToBind(f"refusing to listen on {settings.host} without a token")
