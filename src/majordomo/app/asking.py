"""``majordomo ask``: a client of the running service that follows one request to its end."""

from __future__ import annotations

import contextlib
import json
from collections.abc import AsyncGenerator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import websockets
from rich.console import Console
from rich.text import Text

ENDED = frozenset({"succeeded", "failed", "cancelled", "refused"})
UNDECIDED = frozenset({"awaiting_answer", "awaiting_approval"})
MAX_PORT = 65535
NO_TEXT = "I cannot read this as text (UTF-8). Please type it again."


class NoService(RuntimeError):
    """No service was found, or it does not answer."""


@dataclass(frozen=True, kw_only=True)
class Service:
    """Where the service is and the token that opens it."""

    address: str
    token: str


def find_service(url: str | None, token: str | None, data: Path) -> Service:
    """The service at ``url``, else the one that left its address in the data folder.

    Raises:
        NoService: saying how to start one.
    """
    if url is not None:
        return _service_at(url, token)
    try:
        known = json.loads((data / "service.json").read_text(encoding="ascii"))
        return Service(address=known["address"], token=known["token"])
    except (OSError, ValueError, LookupError, TypeError):
        raise NoService(
            f"no service has left its address in {data}: start one with 'majordomo serve', or, if one runs with "
            "another data folder, name that folder with --data"
        ) from None


def _service_at(url: str, token: str | None) -> Service:
    try:
        parsed = httpx.URL(url)
    except httpx.InvalidURL as error:
        raise NoService(f"the address {url!r} cannot be used: {error}") from None
    if parsed.port is not None and parsed.port > MAX_PORT:
        raise NoService(f"the address {url!r} cannot be used: ports end at {MAX_PORT}")
    offered = token or parsed.params.get("token")
    if not offered:
        raise NoService("the address holds no token: pass it with --token")
    if not offered.isascii():
        raise NoService("the token holds characters that no token has: copy it from the printed address")
    return Service(address=str(parsed.copy_with(query=None, path="/")).rstrip("/"), token=offered)


async def ask_service(service: Service, request: str, console: Console) -> bool:
    """Submit ``request``, print progress, and answer the robot's questions from the keyboard; whether it succeeded.

    Raises:
        NoService: the service cannot be reached, or refuses.
    """
    if not _is_text(request):
        raise NoService(NO_TEXT)
    headers = {"Authorization": f"Bearer {service.token}"}
    try:
        async with httpx.AsyncClient(base_url=service.address, headers=headers, timeout=10.0) as client:
            task = _checked(await client.post("/v1/tasks", json={"request": request}))
            return await _follow(service, client, task["id"], console)
    except (httpx.TransportError, OSError, websockets.WebSocketException) as error:
        raise NoService(f"the service at {service.address} does not answer: {error}") from error


async def _follow(service: Service, client: httpx.AsyncClient, task_id: str, console: Console) -> bool:
    """Print what becomes of the task; the stream is closed while a person thinks and opened anew afterwards."""
    told: list[str] = []
    while True:
        async with contextlib.aclosing(_states(service, task_id)) as states:
            async for task in states:
                _tell(task, told, console)
                if task["status"] in ENDED:
                    return bool(task["status"] == "succeeded")
                if task["status"] in UNDECIDED:
                    break
            else:
                raise NoService("the service ended the stream")
        await _decide(task, client, console)


async def _states(service: Service, task_id: str) -> AsyncGenerator[dict[str, Any]]:
    """The task as it is, and then each time it changes, until the service ends the stream."""
    address = f"{service.address.replace('http', 'ws', 1)}/v1/stream"
    headers = {"Authorization": f"Bearer {service.token}"}
    async with websockets.connect(address, additional_headers=headers, max_size=None) as socket:
        async for message in socket:
            event = json.loads(message)
            data = event["data"]
            for task in {"task": [data], "snapshot": data.get("tasks", ())}.get(event["type"], ()):
                if task["id"] == task_id:
                    yield task


async def _decide(task: dict[str, Any], client: httpx.AsyncClient, console: Console) -> None:
    """Let the person at the keyboard answer or approve, if the task waits for that.

    Raises:
        NoService: nobody is at the keyboard; the task goes on waiting.
    """
    path = f"/v1/tasks/{task['id']}"
    if task["status"] == "awaiting_answer":
        while refusal := await _refusal(_typed(console, f"{task['reply']} > "), path, client):
            console.print(refusal, markup=False, highlight=False)
    elif task["status"] == "awaiting_approval":
        agreed = _typed(console, f"{task['explanation']} [y/N] ").strip().lower() in {"y", "yes"}
        _checked(await client.post(f"{path}/{'approve' if agreed else 'reject'}"))


async def _refusal(answer: str, path: str, client: httpx.AsyncClient) -> str | None:
    """Give an answer; why it cannot be taken, if it cannot."""
    if not _is_text(answer):
        return NO_TEXT
    response = await client.post(f"{path}/answer", json={"answer": answer})
    if response.status_code == httpx.codes.UNPROCESSABLE_ENTITY:
        return str(response.json()["detail"])
    _checked(response)
    return None


def _is_text(typed: str) -> bool:
    """Whether what was typed is Unicode text; Python smuggles other bytes in as lone surrogates."""
    try:
        typed.encode()
    except UnicodeEncodeError:
        return False
    return True


def _typed(console: Console, prompt: str) -> str:
    try:
        return console.input(Text(prompt))
    except UnicodeDecodeError as error:
        return error.object.decode(errors="surrogateescape")
    except EOFError:
        raise NoService("nobody is there to answer; the task waits, and the page shows its question") from None


def _tell(task: dict[str, Any], told: list[str], console: Console) -> None:
    """Print what has not been printed yet."""
    lines = [
        f"{step['status']:>10}  {step['skill']}({', '.join(step['args'])})"
        for step in (task["plan"] or {}).get("steps", ())
        if step["status"] != "pending"
    ]
    lines += [f"    failed  {failure['message']} {failure['suggestion']}" for failure in task["failures"]]
    if task["status"] in ENDED:
        lines.append(f"{task['status']:>10}  {task['explanation'] or task['reply']}")
    for line in lines:
        if line not in told:
            told.append(line)
            console.print(line, markup=False, highlight=False)


def _checked(response: httpx.Response) -> dict[str, Any]:
    if response.is_error:
        is_problem = "json" in response.headers.get("content-type", "")
        raise NoService(response.json()["detail"] if is_problem else f"the service answered {response.status_code}")
    return dict(response.json())
