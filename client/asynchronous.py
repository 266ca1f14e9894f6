"""The asynchronous client, for asyncio: the same calls as the synchronous one."""

from __future__ import annotations

import asyncio
import contextlib
import time
from collections.abc import AsyncGenerator, Mapping, Sequence
from pathlib import Path as FilePath
from typing import Any, Literal, Self, TypeVar

import httpx
from websockets.asyncio.client import ClientConnection, connect

from client import calls
from client.calls import Approval, Call
from client.documents import Event, History, Node, Path, Scene, Selection, Status, Task, TaskPage, Trace, View
from client.errors import StillWaiting, silent
from client.service import DEFAULT_DATA, Service, find_service
from client.streaming import LOST, Cursor, states_in

T = TypeVar("T")


class AsyncClient:
    """A running service. Use it as an asynchronous context manager, on one event loop.

    Every call raises ``NoService`` when nobody answers and ``Refused``, or the class of it that fits, when the service
    refuses; its ``code`` is stable.

    Args:
        service: where it is, and its token.
        timeout_s: for the answer to one call.
    """

    def __init__(self, service: Service, *, timeout_s: float = 10.0) -> None:
        self.service = service
        self._http = httpx.AsyncClient(
            base_url=service.address,
            headers=service.headers,
            timeout=timeout_s,
            trust_env=not service.on_this_machine,
        )

    @classmethod
    def local(cls, data: FilePath = DEFAULT_DATA) -> Self:
        """The service that runs on this machine with this data folder.

        Raises:
            NoService: none does.
        """
        return cls(find_service(data=data))

    @classmethod
    def at(cls, url: str, token: str | None = None, data: FilePath = DEFAULT_DATA) -> Self:
        """The service at an address, such as the one that ``majordomo serve`` prints.

        Raises:
            NoService: the address cannot be used, or no token for it is known.
        """
        return cls(find_service(url, token, data))

    async def __aenter__(self) -> Self:
        return self

    async def __aexit__(self, *_: object) -> None:
        await self.aclose()

    async def aclose(self) -> None:
        """Let go of the connections."""
        await self._http.aclose()

    async def submit(
        self, request: str, *, approval: Approval = "auto", dry_run: bool = False, key: str | None = None
    ) -> Task:
        """Ask for something, in plain words.

        Args:
            request: what is wanted.
            approval: ``ask`` shows the plan and waits for ``approve`` before anything moves.
            dry_run: plan only.
            key: a name of your own for this request: sent twice under it, it is done once.
        """
        return await self._send(calls.submit(request, approval, dry_run=dry_run, key=key))

    async def task(self, task_id: str) -> Task:
        """The task as it is now."""
        return await self._send(calls.task(task_id))

    async def tasks(self, *, limit: int = 50, offset: int = 0) -> TaskPage:
        """Tasks, newest first."""
        return await self._send(calls.tasks(limit, offset))

    async def approve(self, task_id: str, *, revision: int | None = None) -> Task:
        """Let a planned task run; ``revision``: only if its plan is still the one made on that of the graph."""
        seen = None if revision is None else {"revision": revision}
        return await self._send(calls.operate(task_id, "approve", seen))

    async def reject(self, task_id: str) -> Task:
        """Turn a plan down; the task ends."""
        return await self._send(calls.operate(task_id, "reject"))

    async def answer(self, task_id: str, answer: str) -> Task:
        """Answer the robot's question, in plain words or with one of the task's candidates."""
        return await self._send(calls.operate(task_id, "answer", {"answer": answer}))

    async def pause(self, task_id: str) -> Task:
        """Hold a running task; the robot stands still and keeps what it holds."""
        return await self._send(calls.operate(task_id, "pause"))

    async def resume(self, task_id: str) -> Task:
        """Go on with a paused task."""
        return await self._send(calls.operate(task_id, "resume"))

    async def cancel(self, task_id: str) -> Task:
        """End a task for good; whatever moves is stopped and the arm made safe."""
        return await self._send(calls.operate(task_id, "cancel"))

    async def trace(self, task_id: str, *, after: int = 0, limit: int = 200) -> Trace:
        """What was decided about a task, when and why; page with ``after`` = the trace's ``next``."""
        return await self._send(calls.trace(task_id, after, limit))

    async def stop(self) -> None:
        """Stop the robot now, and keep it stopped."""
        await self._send(calls.stop())

    async def release_stop(self) -> None:
        """Let a stopped robot move again."""
        await self._send(calls.release_stop())

    async def status(self) -> Status:
        """What the service is doing."""
        return await self._send(calls.status())

    async def scene(self, *, frame: Literal["map", "room"] = "map", layers: Sequence[str] = ()) -> Scene:
        """The scene graph; ``layers``: only nodes of these types. ``frame``: of the positions."""
        return await self._send(calls.scene(frame, layers))

    async def query(self, conditions: Mapping[str, Any] | None = None, **more: Any) -> Selection:
        """Nodes that meet conditions, such as ``query(type="object", label="cup", room="kitchen")``.

        The conditions are those of ``POST /v1/scene/query``.
        """
        return await self._send(calls.query({**(conditions or {}), **more}))

    async def path(self, target: str, *, origin: str = "robot") -> Path:
        """Rooms and doors from one node to another."""
        return await self._send(calls.path(target, origin))

    async def teach(
        self, node_id: str, *, label: str | None = None, name: str | None = None, region: str | None = None
    ) -> Node:
        """Tell the robot what a node is, what it is called, or which region a room belongs to."""
        return await self._send(calls.teach(node_id, {"label": label, "name": name, "region": region}))

    async def history(self, node_id: str) -> History:
        """What became of a node; what was before the last start is of negative times."""
        return await self._send(calls.history(node_id))

    async def camera(self) -> View:
        """What was recognized in the newest frame, with outlines and nodes."""
        return await self._send(calls.camera())

    async def camera_jpeg(self, *, stamp_s: float | None = None, outlines: bool = True) -> bytes:
        """What the robot sees, with outlined objects unless told otherwise; ``stamp_s``: the frame of a ``View``."""
        options = {"outlines": outlines} if stamp_s is None else {"stamp_s": stamp_s, "outlines": outlines}
        return await self._send(calls.picture("/v1/camera.jpg", options))

    async def map_svg(self) -> bytes:
        """The known building as a picture."""
        return await self._send(calls.picture("/v1/map.svg"))

    async def events(
        self, *, since: int | None = None, patience_s: float | None = 60.0, for_s: float | None = None
    ) -> AsyncGenerator[Event]:
        """Events of the service, in order, across losses of the connection; a snapshot of everything comes first.

        Args:
            since: number of the last event that was read earlier; goes on after it where the service still can.
            patience_s: how long the service may be away before ``NoService`` is raised, ``None`` for ever.
            for_s: ends after so many seconds.

        Close it when you leave it early: ``async with contextlib.aclosing(robot.events()) as events``.
        """
        cursor, end_s = Cursor(since=since, patience_s=patience_s), _end(for_s)
        while _left(end_s) != 0.0:
            try:
                async with connect(f"{self.service.stream}{cursor.query}", **self._options) as socket:
                    while True:
                        message = await _next(socket, _left(end_s))
                        if message is None:
                            return
                        event = cursor.read(message)
                        if event is not None:
                            yield event
            except LOST as error:
                disconnected, wait_s = cursor.lost(error, self.service.address)
            yield disconnected
            await asyncio.sleep(min(wait_s, _left(end_s) or wait_s))

    async def follow(
        self, task_id: str, *, patience_s: float | None = 60.0, for_s: float | None = None
    ) -> AsyncGenerator[Task]:
        """The task as it is, and then each time it changes, until it has ended; arguments as for ``events``."""
        last: Task | None = None
        async with contextlib.aclosing(self.events(patience_s=patience_s, for_s=for_s)) as events:
            async for event in events:
                states = [Task.model_validate(state) for state in states_in(event, task_id)]
                if event.type == "snapshot" and not states:
                    states = [await self.task(task_id)]
                for task in states:
                    if task != last:
                        last = task
                        yield task
                    if task.ended:
                        return

    async def wait(self, task_id: str, *, timeout_s: float | None = None, patience_s: float | None = 60.0) -> Task:
        """The task once it has ended, or waits for a person: then ``undecided`` is true.

        Raises:
            StillWaiting: neither within ``timeout_s`` seconds.
        """
        async with contextlib.aclosing(self.follow(task_id, patience_s=patience_s, for_s=timeout_s)) as states:
            async for task in states:
                if task.ended or task.undecided:
                    return task
        raise StillWaiting(task_id, (await self.task(task_id)).status, timeout_s or 0.0)

    @property
    def _options(self) -> dict[str, Any]:
        """How the stream is opened."""
        proxy = {"proxy": None} if self.service.on_this_machine else {}
        return {"additional_headers": self.service.headers, "max_size": None, "close_timeout": 1.0, **proxy}

    async def _send(self, call: Call[T]) -> T:
        try:
            response = await self._http.request(
                call.method, call.path, params=call.params or None, json=call.json, headers=call.headers
            )
        except httpx.TransportError as error:
            raise silent(self.service.address, error) from error
        return call.answer(response)


def _end(for_s: float | None) -> float | None:
    return None if for_s is None else time.monotonic() + for_s


def _left(end_s: float | None) -> float | None:
    """Seconds until the end, ``None`` if there is none."""
    return None if end_s is None else max(0.0, end_s - time.monotonic())


async def _next(socket: ClientConnection, timeout_s: float | None) -> str | bytes | None:
    """The next message, ``None`` when the time is over."""
    try:
        async with asyncio.timeout(timeout_s):
            return await socket.recv()
    except TimeoutError:
        return None
