"""The trace of a task: over the interface, with a language model, and from what a service left."""

from __future__ import annotations

import asyncio
import io
import json

import pytest
from rich.console import Console

from app.commands.trace import NoTrace, find_trace, show_trace
from app.journal.tasks import TaskJournal
from app.settings import Settings
from client import NoService
from model_server import Line, ModelServer, OpenAI
from planner.tasks.queue import TaskQueue

pytestmark = pytest.mark.anyio

KEY = "key-0123456789abcdef"
VAGUE = "my desk looks so empty without that red thing one drinks tea from"
GOALS = [{"predicate": "on", "args": ["cup_1", "desk_1"]}]
PROPOSAL = json.dumps({"kind": "plan", "goals": GOALS, "question": "", "reply": "the key is " + KEY})


async def test_what_a_model_was_asked_and_said_is_told_and_no_key(in_process, settings):
    async with ModelServer(Line(body=OpenAI.text("prose")), Line(body=OpenAI.text(PROPOSAL))).running() as server:
        model = {"llm": "openai:qwen", "llm_url": f"{server.url}/v1", "llm_key": KEY}
        async with in_process(settings.model_copy(update=model)) as service:
            task = await service.ask(VAGUE)
            answer = await service.client.get(f"/v1/tasks/{task['id']}/trace")
    assert KEY in server.headers[0]["authorization"]
    entries = answer.json()["entries"]
    assert [entry["kind"] for entry in entries] == [
        "received", "model_asked", "model_answered", "model_asked", "model_answered", "understood", "planned", "ended",
    ]  # fmt: skip
    assert VAGUE in entries[1]["data"]["messages"][-1]["text"]
    assert entries[2]["data"]["text"] == "prose"
    assert entries[4]["what"] == PROPOSAL.replace(KEY, "[secret]")
    assert entries[5]["why"] == "Read by model."
    assert KEY not in answer.text


async def test_a_trace_is_paged_and_what_is_unknown_is_a_problem(service):
    task = await service.ask("where is the red apple?")
    path = f"/v1/tasks/{task['id']}/trace"
    whole = (await service.client.get(path)).json()
    first = (await service.client.get(path, params={"limit": 1})).json()
    rest = (await service.client.get(path, params={"after": first["next"]})).json()
    assert first["entries"] + rest["entries"] == whole["entries"]
    assert (whole["next"], rest["next"], whole["dropped"]) == (None, None, 0)
    unknown = await service.client.get("/v1/tasks/task_77/trace")
    assert (unknown.status_code, unknown.json()["code"]) == (404, "task_not_found")
    assert (await service.client.get(path, params={"limit": 0})).status_code == 422
    assert (await service.client.get(path, headers={"Authorization": ""})).status_code == 401


def left_by_a_service(data):
    folder = data / "buildings" / "flat-1"
    folder.mkdir(parents=True)
    journal = TaskJournal.open(folder / "tasks.sqlite3")
    queue = TaskQueue()
    queue.listen(journal.write)
    queue.submit("bring the cup", stamp_s=0.0)
    journal.close()
    return folder / "tasks.sqlite3"


async def test_a_trace_is_told_from_the_service_or_from_what_it_left(served, token, tmp_path):
    task = await served.ask("where is the red apple?")
    found = await asyncio.to_thread(find_trace, "1", url=served.address, token=token, data=tmp_path)
    assert served.address in found.source
    console = Console(file=io.StringIO(), width=140)
    show_trace(found, console)
    assert "where is the red apple?" in console.file.getvalue()
    assert task["reply"].split(".")[0][:30] in console.file.getvalue()
    with pytest.raises(NoTrace, match="task_9"):
        await asyncio.to_thread(find_trace, "task_9", url=served.address, token=token, data=tmp_path)


def test_without_a_service_the_files_are_read_and_damage_is_said(tmp_path):
    with pytest.raises(NoTrace, match="nothing is known of task_1"):
        find_trace("task_1", url=None, token=None, data=tmp_path)
    file = left_by_a_service(tmp_path)
    assert find_trace("task_1", url=None, token=None, data=tmp_path).source == "flat-1, where no service runs now"
    gone = {"address": "http://127.0.0.1:9", "token": "a-token-of-old", "pid": 1}
    (tmp_path / "service.json").write_text(json.dumps(gone))
    assert find_trace("task_1", url=None, token=None, data=tmp_path).trace.task == "task_1"
    with pytest.raises(NoService):
        find_trace("task_1", url="http://127.0.0.1:9", token=None, data=tmp_path)
    file.write_bytes(b"no database" * 999)
    with pytest.raises(NoTrace, match="doctor --data"):
        find_trace("task_1", url=None, token=None, data=tmp_path)


def test_a_service_that_remembers_nothing_keeps_traces_as_long_as_it_runs(tmp_path):
    journal = TaskJournal.of(Settings(data=tmp_path, remember=False))
    queue = TaskQueue(journal.take_up())
    queue.listen(journal.write)
    task = queue.submit("bring the cup", stamp_s=0.0)
    assert journal.trace(task.id) is not None
    journal.close()
    assert list(tmp_path.iterdir()) == []
