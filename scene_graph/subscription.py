"""A bounded queue of deltas between the working memory and one reader."""

from __future__ import annotations

import asyncio
import threading
from collections import deque
from collections.abc import Callable
from types import TracebackType
from typing import Self

from scene_graph.diff import Delta
from scene_graph.errors import SubscriptionClosed


class Subscription:
    """Every commit since it was opened, in order, for one reader who may poll or wait.

    When the queue is full, all of it is dropped except the newest delta, which wakes a waiting reader, and ``lagged``
    turns true: take a fresh snapshot and skip deltas up to its revision. A slow reader is told, never left stale.
    """

    def __init__(self, capacity: int, on_close: Callable[[Subscription], None]) -> None:
        if capacity < 1:
            raise ValueError(f"capacity must be at least 1, not {capacity}")
        self._capacity = capacity
        self._on_close = on_close
        self._lock = threading.Lock()
        self._queue: deque[Delta] = deque()
        self._lagged = False
        self._closed = False
        self._waiters: list[tuple[asyncio.AbstractEventLoop, asyncio.Event]] = []

    @property
    def lagged(self) -> bool:
        """Whether deltas were dropped since this was last asked; asking resets it."""
        with self._lock:
            lagged, self._lagged = self._lagged, False
            return lagged

    @property
    def closed(self) -> bool:
        """Whether ``close`` was called."""
        return self._closed

    def poll(self) -> list[Delta]:
        """All queued deltas, oldest first; never waits."""
        with self._lock:
            deltas = list(self._queue)
            self._queue.clear()
            return deltas

    async def next(self) -> Delta:
        """The oldest queued delta; waits for one when there is none.

        Raises:
            SubscriptionClosed: the subscription is closed and its queue is empty.
        """
        while True:
            with self._lock:
                if self._queue:
                    return self._queue.popleft()
                if self._closed:
                    raise SubscriptionClosed("the subscription is closed")
                waiter = (asyncio.get_running_loop(), asyncio.Event())
                self._waiters.append(waiter)
            try:
                await waiter[1].wait()
            finally:
                with self._lock:
                    if waiter in self._waiters:
                        self._waiters.remove(waiter)

    def publish(self, delta: Delta) -> None:
        """Called by the working memory, in any thread, once per commit."""
        with self._lock:
            if self._closed:
                return
            if len(self._queue) >= self._capacity:
                self._queue.clear()
                self._lagged = True
            self._queue.append(delta)
            self._wake()

    def close(self) -> None:
        """Ends the subscription; what is queued can still be read."""
        with self._lock:
            self._closed = True
            self._wake()
        self._on_close(self)

    def _wake(self) -> None:
        waiters, self._waiters = self._waiters, []
        for loop, event in waiters:
            if not loop.is_closed():
                loop.call_soon_threadsafe(event.set)

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()
