"""What both clients do with the event stream: where they are in it, when they come back, and what was missed."""

from __future__ import annotations

import json
import ssl
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from typing import Any

from websockets.exceptions import ConnectionClosed, InvalidStatus, WebSocketException

from client.documents import Event
from client.errors import Forbidden, Refused, Unauthorized, closing, silent

LOST = (OSError, EOFError, TimeoutError, WebSocketException)
"""What the loss of a connection, or its failing to open, is raised as."""


@dataclass(kw_only=True)
class Cursor:
    """A reader's place in the stream.

    ``since``: number of the last event that was read, ``None`` before the first. ``patience_s``: how long a service
    may be away before the reader gives up, ``None`` for ever. ``waits_s``: the first and the longest wait before trying
    again; each is twice the one before.
    """

    since: int | None = None
    patience_s: float | None = 60.0
    clock: Callable[[], float] = time.monotonic
    waits_s: tuple[float, float] = (0.2, 5.0)
    _lost_at_s: float | None = field(default=None, repr=False)
    _wait_s: float = field(init=False, repr=False)

    def __post_init__(self) -> None:
        self._wait_s = self.waits_s[0]

    @property
    def query(self) -> str:
        """What to add to the stream's address."""
        return "" if self.since is None else f"?since={self.since}"

    def read(self, message: str | bytes) -> Event | None:
        """The event in a message; ``None`` for what is no event, or was read before."""
        document = json.loads(message)
        if not isinstance(document, dict) or "seq" not in document:
            return None
        self._lost_at_s, self._wait_s = None, self.waits_s[0]
        event = Event.model_validate(document)
        if event.type == "snapshot":
            gap = self.since is not None and event.seq != self.since
        elif self.since is not None and event.seq <= self.since:
            return None
        else:
            gap = self.since is not None and event.seq != self.since + 1
        self.since = event.seq
        return event.model_copy(update={"gap": gap})

    def lost(self, error: BaseException, address: str) -> tuple[Event, float]:
        """The event that says that the connection was lost, and how long to wait before trying again, seconds.

        Raises:
            Refused: the service does not want this client.
            NoService: it has been away for longer than ``patience_s``.
        """
        refused = _refused(error)
        if refused is not None:
            raise refused from error
        now_s = self.clock()
        self._lost_at_s = now_s if self._lost_at_s is None else self._lost_at_s
        if self.patience_s is not None and now_s - self._lost_at_s >= self.patience_s:
            raise silent(address, error) from error
        wait_s, self._wait_s = self._wait_s, min(2 * self._wait_s, self.waits_s[1])
        return Event(seq=self.since or 0, type="disconnected", data={"reason": str(error)}), wait_s


def states_in(event: Event, task_id: str) -> Iterator[dict[str, Any]]:
    """What an event says of a task."""
    told = {"task": [event.data], "snapshot": (event.data or {}).get("tasks", ())}.get(event.type, ())
    return (state for state in told if state["id"] == task_id)


def _refused(error: BaseException) -> Refused | None:
    if isinstance(error, InvalidStatus):
        status = error.response.status_code
        if status in (401, 403):
            kind = Unauthorized if status == 401 else Forbidden
            return kind(status, "stream_refused", "the service does not open its stream to this token or address")
    if isinstance(error, ConnectionClosed) and error.rcvd is not None:
        return closing(error.rcvd.code, error.rcvd.reason)
    if isinstance(error, ssl.SSLCertVerificationError):
        return Forbidden(0, "certificate", f"its certificate cannot be trusted: {error}")
    return None
