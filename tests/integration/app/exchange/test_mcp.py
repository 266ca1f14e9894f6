"""The tools for language models, called by the library's own client against the real service."""

from __future__ import annotations

import os
import sys
from types import SimpleNamespace

import httpx
import pytest

pytest.importorskip("mcp")
from mcp import Client, StdioServerParameters

from app.exchange.mcp_server import ServiceTools, make_mcp_server
from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.stacks.graph import GraphStack
from client import Service
from planner.language.grammar.parser import CommandGrammar
from planner.mission.request_handler import RequestHandler
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from planner.tasks.approval import Approval
from planner.tasks.tasks import TaskStatus
from skills.registry import load_registry

pytestmark = pytest.mark.anyio
TOKEN, VIEWER = Token("a-token-only-for-tests"), Token("a-viewers-token-for-tests")
MOVING = "bring the red apple to the desk"


def tools_of(served, token, **options):
    return make_mcp_server(ServiceTools(Service(address=served.address, token=token), **options))


class Ordered:
    """Understands and plans requests as a robot's service does, and calls running what may run; nothing moves."""

    name, period_s = "mission", 0.1

    def __init__(self, memory, queue):
        verifier = Verifier(load_registry())
        self.queue = queue
        self.intake = RequestHandler(memory, queue, TaskPlanner(CommandGrammar(), verifier, None), verifier)

    async def step(self, stamp_s):
        task = self.queue.current
        if task is not None and task.status is TaskStatus.QUEUED:
            task = self.queue.move(task.id, TaskStatus.PLANNING, stamp_s=stamp_s)
        if task is not None and task.status is TaskStatus.PLANNING:
            ready = await self.intake.take(task, stamp_s)
            if ready is not None:
                self.queue.move(task.id, TaskStatus.RUNNING, stamp_s=stamp_s)


async def build(settings, queue, model, log, *, anew=False):
    stack = GraphStack.load(settings.graph, queue, model)
    stack.agents = [Ordered(stack.memory, queue)]
    return stack


@pytest.fixture
async def served(settings):
    """A service that asks for approval; over a stored graph as it is there is nothing to approve."""
    runtime = Runtime(settings, build=build)
    with bind(settings) as listener:
        address = page_address(listener, TOKEN).partition("/?")[0]
        async with (
            serving(runtime, listener, TOKEN, viewer=VIEWER),
            httpx.AsyncClient(base_url=address, headers={"Authorization": f"Bearer {TOKEN.value}"}) as client,
        ):
            yield SimpleNamespace(runtime=runtime, address=address, client=client)


@pytest.fixture
async def model(served, token):
    async with Client(tools_of(served, token)) as client:
        yield client


async def called(client, tool, **arguments):
    result = await client.call_tool(tool, arguments)
    assert not result.is_error, result.content
    return result.structured_content


async def refused(client, tool, **arguments):
    result = await client.call_tool(tool, arguments)
    assert result.is_error
    return " ".join(block.text for block in result.content)


async def test_there_are_five_tools_and_none_approves_or_resumes(model):
    tools = {tool.name: tool for tool in (await model.list_tools()).tools}
    assert tools.keys() == {"plan", "execute", "status", "stop", "scene"}
    readers = {name for name, tool in tools.items() if tool.annotations.read_only_hint}
    assert readers == {"plan", "status", "scene"}
    assert all(tool.description for tool in tools.values())


async def test_the_scene_is_what_the_interface_says(model, scene):
    told = await called(model, "scene", kind="room")
    assert {node["id"]: node["label"] for node in told["nodes"]} == {
        name: node["label"] for name, node in scene.items() if node["type"] == "room"
    }
    apples = await called(model, "scene", label="apple")
    assert apples["total"] == sum(node["label"] == "apple" for node in scene.values())
    assert "valid" in await refused(model, "scene", kind="dragon")


async def test_planning_answers_and_moves_nothing(model, served):
    before = served.runtime.memory.snapshot()
    told = await called(model, "plan", request=MOVING)
    assert told["status"] == "succeeded"
    assert [step["skill"] for step in told["steps"]][-1] == "PLACE"
    assert served.runtime.queue.task(told["task"]).dry_run
    assert served.runtime.memory.snapshot() is before
    assert "bowl" in (await called(model, "plan", request="where is the red apple?"))["reply"]
    taught = await called(model, "plan", request="this is the office")
    assert "nothing was learned" in taught["reply"]
    assert served.runtime.memory.snapshot() is before


async def test_what_moves_waits_for_a_person(model, served):
    told = await called(model, "execute", request=MOVING)
    assert told["status"] == "awaiting_approval"
    assert "person must approve" in told["next"]
    assert served.runtime.queue.task(told["task"]).approved is False
    assert (await called(model, "status", task=told["task"]))["status"] == "awaiting_approval"
    await served.client.post(f"/v1/tasks/{told['task']}/approve")
    while (after := await called(model, "status", task=told["task"]))["status"] not in {"running", "failed"}:
        await served.runtime.wait_for_change()
    assert after["status"] == "running"


async def test_only_the_operator_who_starts_it_lets_requests_run_at_once(served, token):
    async with Client(tools_of(served, token, approval=Approval.AUTO)) as client:
        told = await called(client, "execute", request=MOVING, wait_s=0.0)
        while told["status"] in {"queued", "planning"}:
            await served.runtime.wait_for_change()
            told = await called(client, "status", task=told["task"])
    assert told["status"] == "running"
    assert served.runtime.queue.task(told["task"]).approval is Approval.AUTO


async def test_a_model_can_stop_the_robot_and_not_release_it(model):
    assert await called(model, "stop") == {"stopped": True}
    for words in ("go on", "resume please", "you can continue"):
        assert "only a person" in await refused(model, "execute", request=words)
    assert (await called(model, "status"))["stopped"] is True


async def test_what_the_service_refuses_is_said_in_its_words(model):
    assert "task_99" in await refused(model, "status", task="task_99")
    assert "not found" in (await refused(model, "status", task="../stop?x=")).lower()
    assert "empty" in await refused(model, "execute", request="  ")


async def test_every_tool_refuses_who_has_no_token_or_a_wrong_one_and_a_viewer_moves_nothing(served, token):
    before = served.runtime.memory.snapshot()
    for wrong in ("", "another-token-for-tests", token[:-1]):
        async with Client(tools_of(served, wrong)) as client:
            for tool, arguments in minimal_calls(await client.list_tools()):
                assert "valid bearer token" in await refused(client, tool, **arguments), tool
    async with Client(tools_of(served, VIEWER.value)) as viewer:
        for tool, arguments in minimal_calls(await viewer.list_tools()):
            if tool in {"status", "scene"}:
                await called(viewer, tool, **arguments)
            else:
                assert "only reads" in await refused(viewer, tool, **arguments), tool
    assert served.runtime.queue.tasks == ()
    assert not served.runtime.views.status.document()["stopped"]
    assert served.runtime.memory.snapshot() is before


def minimal_calls(listed):
    """Every tool there is, with as little as it asks for."""
    assert len(listed.tools) >= 5
    for tool in listed.tools:
        yield tool.name, dict.fromkeys(tool.input_schema.get("required", ()), MOVING)


async def test_a_service_that_is_gone_is_said_to_be(token):
    async with Client(make_mcp_server(ServiceTools(Service(address="http://127.0.0.1:9", token=token)))) as client:
        assert "does not answer" in await refused(client, "status")


@pytest.mark.slow
async def test_a_host_starts_it_as_a_command(served, token):
    command = ["-m", "app", "mcp", "--url", served.address]
    known = {**os.environ, "MAJORDOMO_TOKEN": token}
    async with Client(StdioServerParameters(command=sys.executable, args=command, env=known)) as client:
        assert (await called(client, "status"))["house"]
