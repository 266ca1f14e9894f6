"""Numbered events for clients of the stream: a bounded history, bounded queues, and a snapshot for who fell behind."""

from __future__ import annotations

import asyncio
import json
from collections import deque
from collections.abc import AsyncIterator, Callable
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from typing import Any


@dataclass(frozen=True, kw_only=True)
class StreamSettings:
    """What is kept for clients."""

    history: int = 2048
    """Events for who comes back: some minutes."""
    queue: int = 512
    """Events that wait for one client; who is so far behind gets a snapshot instead."""


@dataclass(frozen=True, kw_only=True)
class Event:
    """One event: ``type`` is one of snapshot, scene, task, robot, perception, log."""

    seq: int
    type: str
    stamp_s: float
    data: Any

    def document(self) -> dict[str, Any]:
        """As sent to clients."""
        return {"seq": self.seq, "type": self.type, "stamp_s": self.stamp_s, "data": self.data}

    @cached_property
    def text(self) -> str:
        """The document as JSON, made once for all clients."""
        return json.dumps(self.document(), separators=(",", ":"))


class Listener:
    """One client's bounded queue. When it overflows it is emptied and the client gets a new snapshot instead."""

    def __init__(self, make_snapshot: Callable[[], Event], most: int) -> None:
        """``most``: events that may wait."""
        self._make_snapshot, self._most = make_snapshot, most
        self._queue: deque[Event] = deque()
        self._ready = asyncio.Event()
        self._behind = False

    def offer(self, event: Event) -> None:
        """Queue an event; drops everything and marks the client as behind when full."""
        if self._behind:
            return
        if len(self._queue) >= self._most:
            self._queue.clear()
            self._behind = True
        else:
            self._queue.append(event)
        self._ready.set()

    def require_snapshot(self) -> None:
        """Make the next event a snapshot."""
        self._queue.clear()
        self._behind = True
        self._ready.set()

    async def events(self) -> AsyncIterator[Event]:
        """Events in order of their numbers, for ever."""
        while True:
            await self._ready.wait()
            self._ready.clear()
            if self._behind:
                self._behind = False
                yield self._make_snapshot()
            while self._queue and not self._behind:
                yield self._queue.popleft()


class EventStream:
    """Publishes numbered events to listeners on one event loop.

    Args:
        snapshot: makes the data of a snapshot.
        first_seq: the first event has the next number. Higher than any of an earlier life of the service, it lets a
            client that comes back with a number of that life be told from one that missed a few events of this one.
    """

    def __init__(
        self, snapshot: Callable[[], Any], *, first_seq: int = 0, settings: StreamSettings = StreamSettings()
    ) -> None:
        self._snapshot, self._settings = snapshot, settings
        self._history: deque[Event] = deque(maxlen=settings.history)
        self._listeners: list[Listener] = []
        self._seq = first_seq
        self._stamp_s = 0.0
        self._newest_snapshot: Event | None = None

    @property
    def seq(self) -> int:
        """Number of the newest event."""
        return self._seq

    @property
    def listeners(self) -> int:
        """How many clients listen."""
        return len(self._listeners)

    def publish(self, event_type: str, data: Any, stamp_s: float) -> None:
        """Number an event and offer it to every listener."""
        self._seq += 1
        self._stamp_s = stamp_s
        event = Event(seq=self._seq, type=event_type, stamp_s=stamp_s, data=data)
        self._history.append(event)
        for listener in self._listeners:
            listener.offer(event)

    def begin_anew(self) -> None:
        """What is shown has changed altogether: everyone gets a snapshot, also who comes back with an older number."""
        self._seq += 1
        self._history.clear()
        for listener in self._listeners:
            listener.require_snapshot()

    @contextmanager
    def listen(self, since: int | None = None) -> Any:
        """A listener that starts after event ``since`` if history reaches back so far, else with a snapshot."""
        listener = Listener(self._snapshot_event, self._settings.queue)
        first = self._history[0].seq if self._history else self._seq + 1
        if since is None or since > self._seq or since < first - 1:
            listener.require_snapshot()
        else:
            for event in self._history:
                if event.seq > since:
                    listener.offer(event)
        self._listeners.append(listener)
        try:
            yield listener
        finally:
            self._listeners.remove(listener)

    def _snapshot_event(self) -> Event:
        """The same for all who come between two events, such as everybody after a restart."""
        newest = self._newest_snapshot
        if newest is None or newest.seq != self._seq:
            newest = Event(seq=self._seq, type="snapshot", stamp_s=self._stamp_s, data=self._snapshot())
            self._newest_snapshot = newest
        return newest
