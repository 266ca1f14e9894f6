"""How long the API takes to answer, asked from a process of its own while the service is at work."""

from __future__ import annotations

import asyncio
import contextlib
import http.client
import itertools
import multiprocessing
import time
from collections.abc import AsyncIterator
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass

PATHS = ("/v1/status", "/v1/scene?frame=map", "/v1/tasks", "/healthz")
"""What is asked for, in turn."""


@dataclass(frozen=True, kw_only=True)
class Answers:
    """``latencies_ms``: from sending a request to having read the whole answer. ``failures``: what went wrong."""

    latencies_ms: tuple[float, ...]
    failures: tuple[str, ...] = ()


class ApiProbe:
    """Asks a service on this machine; make one with ``api_probe``, before the time that matters."""

    def __init__(self, pool: ProcessPoolExecutor) -> None:
        self._pool = pool

    async def ask(self, port: int, token: str, seconds: float) -> Answers:
        """Ask over one connection for so many wall seconds."""
        return await asyncio.get_running_loop().run_in_executor(self._pool, ask, port, token, seconds)


@contextlib.asynccontextmanager
async def api_probe() -> AsyncIterator[ApiProbe]:
    """A probe whose process has started."""
    with ProcessPoolExecutor(max_workers=1, mp_context=multiprocessing.get_context("spawn")) as pool:
        await asyncio.get_running_loop().run_in_executor(pool, time.monotonic)
        yield ApiProbe(pool)


def ask(port: int, token: str, seconds: float, *, rate_hz: float = 10.0, timeout_s: float = 10.0) -> Answers:
    """As ``ApiProbe.ask``, in this process, ``rate_hz`` times a second; as often as a page asks.

    A request that is due while another is under way is sent after it.
    """
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=timeout_s)
    latencies_ms: list[float] = []
    failures: list[str] = []
    started = time.perf_counter()
    with contextlib.closing(connection):
        for path, number in zip(itertools.cycle(PATHS), range(round(seconds * rate_hz)), strict=False):
            time.sleep(max(0.0, started + number / rate_hz - time.perf_counter()))
            sent = time.perf_counter()
            problem = _problem(connection, path, token)
            latencies_ms.append(1000.0 * (time.perf_counter() - sent))
            if problem:
                failures.append(f"{path}: {problem}")
    return Answers(latencies_ms=tuple(latencies_ms), failures=tuple(failures))


def _problem(connection: http.client.HTTPConnection, path: str, token: str) -> str:
    """What was wrong with the answer, empty when nothing was."""
    try:
        connection.request("GET", path, headers={"Authorization": f"Bearer {token}"})
        answer = connection.getresponse()
        answer.read()
    except (OSError, http.client.HTTPException) as error:
        connection.close()
        return f"{type(error).__name__}: {error}"
    return "" if answer.status == http.client.OK else f"{answer.status} {answer.reason}"
