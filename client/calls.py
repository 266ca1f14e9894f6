"""The calls of the interface as data: both clients send the same."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Generic, Literal, TypeVar
from urllib.parse import quote

import httpx
from pydantic import BaseModel

from client.documents import History, Node, Path, Scene, Selection, Status, Task, TaskPage, Trace, View
from client.errors import NoService, refusal

T = TypeVar("T")
M = TypeVar("M", bound=BaseModel)
Approval = Literal["auto", "ask"]
Operation = Literal["approve", "reject", "pause", "resume", "cancel", "answer"]


@dataclass(frozen=True, kw_only=True)
class Call(Generic[T]):
    """One call: how it is sent, and how its answer is read."""

    method: str
    path: str
    read: Callable[[httpx.Response], T]
    params: Mapping[str, Any] = field(default_factory=dict)
    json: Mapping[str, Any] | None = None
    headers: Mapping[str, str] = field(default_factory=dict)

    def answer(self, response: httpx.Response) -> T:
        """What the answer says.

        Raises:
            Refused: the service refused.
            NoService: what answers is no service of this kind.
        """
        if response.is_error:
            raise refusal(response)
        try:
            return self.read(response)
        except ValueError as error:
            raise NoService(f"what answers at {response.url.host} does not speak as a service does: {error}") from error


def a_document(kind: type[M]) -> Callable[[httpx.Response], M]:
    """Reads a document of this kind."""
    return lambda response: kind.model_validate_json(response.content)


def submit(request: str, approval: Approval, *, dry_run: bool, key: str | None) -> Call[Task]:
    """Ask for something."""
    body = {"request": request, "approval": approval, "dry_run": dry_run}
    headers = {"Idempotency-Key": key} if key is not None else {}
    return Call(method="POST", path="/v1/tasks", json=body, headers=headers, read=a_document(Task))


def task(task_id: str) -> Call[Task]:
    """One task."""
    return Call(method="GET", path=_task_path(task_id), read=a_document(Task))


def tasks(limit: int, offset: int) -> Call[TaskPage]:
    """Tasks, newest first."""
    page = {"limit": limit, "offset": offset}
    return Call(method="GET", path="/v1/tasks", params=page, read=a_document(TaskPage))


def operate(task_id: str, operation: Operation, body: Mapping[str, Any] | None = None) -> Call[Task]:
    """What a person does to a task."""
    return Call(method="POST", path=f"{_task_path(task_id)}/{operation}", json=body, read=a_document(Task))


def trace(task_id: str, after: int, limit: int) -> Call[Trace]:
    """What was decided about a task."""
    page = {"after": after, "limit": limit}
    return Call(method="GET", path=f"{_task_path(task_id)}/trace", params=page, read=a_document(Trace))


def stop() -> Call[None]:
    """Stop the robot."""
    return Call(method="POST", path="/v1/stop", read=_nothing)


def release_stop() -> Call[None]:
    """Let it move again."""
    return Call(method="POST", path="/v1/resume", read=_nothing)


def scene(frame: Literal["map", "room"], layers: Sequence[str]) -> Call[Scene]:
    """The scene graph."""
    asked = {"frame": frame, "layer": list(layers)}
    return Call(method="GET", path="/v1/scene", params=asked, read=a_document(Scene))


def query(conditions: Mapping[str, Any]) -> Call[Selection]:
    """Nodes that meet conditions."""
    return Call(method="POST", path="/v1/scene/query", json=conditions, read=a_document(Selection))


def path(target: str, origin: str) -> Call[Path]:
    """Rooms and doors between two nodes."""
    return Call(method="GET", path="/v1/scene/path", params={"from": origin, "to": target}, read=a_document(Path))


def teach(node_id: str, taught: Mapping[str, str | None]) -> Call[Node]:
    """What a person teaches about a node."""
    body = {name: word for name, word in taught.items() if word is not None}
    return Call(method="PATCH", path=f"/v1/scene/nodes/{quote(node_id, safe='')}", json=body, read=a_document(Node))


def history(node_id: str) -> Call[History]:
    """What became of a node."""
    return Call(method="GET", path=f"/v1/scene/nodes/{quote(node_id, safe='')}/history", read=a_document(History))


def camera() -> Call[View]:
    """What was recognized in the newest frame."""
    return Call(method="GET", path="/v1/camera", read=a_document(View))


def status() -> Call[Status]:
    """What the service is doing."""
    return Call(method="GET", path="/v1/status", read=a_document(Status))


def picture(path: str, options: Mapping[str, Any] | None = None) -> Call[bytes]:
    """A picture, as it comes."""
    return Call(method="GET", path=path, params=options or {}, read=lambda response: response.content)


def _task_path(task_id: str) -> str:
    return f"/v1/tasks/{quote(task_id, safe='')}"


def _nothing(response: httpx.Response) -> None:
    del response
