"""The Python client against a real service on a real socket."""

from __future__ import annotations

import asyncio
import contextlib
import inspect
import itertools

import pytest

from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from client import (
    AsyncClient,
    Client,
    Invalid,
    NoService,
    NotAllowedNow,
    NotFound,
    Service,
    StillWaiting,
    Unauthorized,
    find_service,
)
from planner.tasks.tasks import TaskStatus

pytestmark = pytest.mark.anyio


@pytest.fixture
def there(served, token):
    return Service(address=served.address, token=token)


@pytest.fixture
async def robot(there):
    async with AsyncClient(there) as robot:
        yield robot


def test_both_clients_offer_the_same_calls():
    def offered(client):
        public = {name: value for name, value in vars(client).items() if not name.startswith("_")}
        public.pop("close", None), public.pop("aclose", None)
        return {
            name: [p.name for p in inspect.signature(value).parameters.values()]
            for name, value in public.items()
            if inspect.isfunction(value)
        }

    assert offered(Client) == offered(AsyncClient)
    assert {"submit", "wait", "events", "trace", "stop"} <= offered(Client).keys()


async def test_a_task_is_followed_from_its_words_to_its_outcome(robot, served):
    task = await robot.submit("bring the blue bottle to the desk")
    seen = [state async for state in robot.follow(task.id)]
    assert seen[-1].ended
    assert seen[-1].succeeded
    assert [str(step) for step in seen[-1].plan.steps]
    assert seen[-1] == await robot.task(task.id)
    assert seen[-1].model_dump(by_alias=True) == (await served.client.get(f"/v1/tasks/{task.id}")).json()
    assert all(one != other for one, other in itertools.pairwise(seen))


async def test_a_question_is_answered_and_a_plan_approved(robot):
    task = await robot.wait((await robot.submit("bring the cup to the bench", approval="ask")).id)
    assert task.undecided
    assert task.status == "awaiting_answer"
    await robot.answer(task.id, task.candidates[0])
    done = await robot.wait(task.id)
    assert done.dialogue[0].answer == task.candidates[0]
    trace = await robot.trace(task.id)
    kinds = [entry.kind for entry in trace.entries]
    assert kinds[0] == "received"
    assert kinds[-1] == "ended"
    assert kinds.index("asked") < kinds.index("answered") < kinds.index("planned")


async def test_what_is_refused_is_an_exception_with_the_code_of_the_problem(robot, there):
    with pytest.raises(NotFound) as missing:
        await robot.task("task_99")
    assert (missing.value.status, missing.value.code) == (404, "task_not_found")
    with pytest.raises(NotFound, match="no trace"):
        await robot.trace("task_99")
    with pytest.raises(Invalid) as empty:
        await robot.submit("  ")
    assert empty.value.code == "invalid_request"
    assert empty.value.document["fields"]
    task = await robot.wait((await robot.submit("where is the red apple?")).id)
    with pytest.raises(NotAllowedNow) as late:
        await robot.cancel(task.id)
    assert late.value.code == "not_allowed_now"
    async with AsyncClient(Service(address=there.address, token="not-the-one-you-want")) as stranger:
        with pytest.raises(Unauthorized):
            await stranger.status()
        with pytest.raises(Unauthorized):
            await anext(stranger.events())


async def test_the_graph_is_read_asked_and_taught(robot, scene):
    assert {node.id for node in (await robot.scene()).nodes} == scene.keys()
    assert {node.type for node in (await robot.scene(layers=["room"])).nodes} == {"room"}
    found = await robot.query(type="object", label="cup")
    assert found.total == len(found.nodes)
    assert {node.label for node in found.nodes} == {"cup"}
    way = await robot.path("room_3", origin="room_2")
    assert (way.origin, way.rooms[0], way.rooms[-1]) == ("room_2", "room_2", "room_3")
    assert (await robot.teach("room_3", label="study")).label == "study"
    assert b"<svg" in await robot.map_svg()
    await robot.teach("cup_1", name="my mug")
    past: list[str | list[float] | None] = []
    while "my mug" not in past:
        past = [entry.after for entry in (await robot.history("cup_1")).entries]
    for looking in (robot.camera(), robot.camera_jpeg(), robot.history("attic")):
        with pytest.raises(NotFound):
            await looking


async def test_the_stop_is_latched_until_it_is_released(robot):
    await robot.stop()
    assert (await robot.status()).stopped
    await robot.release_stop()
    assert not (await robot.status()).stopped


async def test_waiting_ends_when_the_time_is_over_and_the_task_goes_on(robot, served):
    task = await robot.wait((await robot.submit("bring the cup to the bench")).id)
    async with asyncio.timeout(10):
        assert [state.status async for state in robot.follow(task.id, for_s=0.2)] == ["awaiting_answer"]
    queue = served.runtime.queue
    going = queue.submit("go to the kitchen", stamp_s=0.0)
    for status in (TaskStatus.PLANNING, TaskStatus.RUNNING, TaskStatus.PAUSED):
        queue.move(going.id, status, stamp_s=0.0)
    with pytest.raises(StillWaiting, match="it goes on") as waiting:
        await robot.wait(going.id, timeout_s=0.2)
    assert (waiting.value.task_id, waiting.value.status) == (going.id, "paused")


async def test_events_are_numbered_without_a_gap_and_a_snapshot_comes_first(robot):
    async with contextlib.aclosing(robot.events()) as events:
        first = await anext(events)
        await robot.submit("where is the red apple?")
        rest = [await anext(events) for _ in range(8)]
    assert (first.type, first.gap) == ("snapshot", False)
    assert [event.seq for event in rest] == list(range(first.seq + 1, first.seq + 9))
    assert not any(event.gap for event in rest)
    async with contextlib.aclosing(robot.events(since=first.seq)) as again:
        assert [(await anext(again)).seq for _ in range(8)] == [event.seq for event in rest]


@contextlib.asynccontextmanager
async def life(settings, token, port=0):
    """One life of a service; its address."""
    settings = settings.model_copy(update={"port": port})
    with bind(settings) as listener:
        async with serving(Runtime(settings), listener, Token(token)):
            yield page_address(listener, Token(token)).partition("/?")[0]


async def until(condition):
    while not condition():  # noqa: ASYNC110 - events come from another task
        await asyncio.sleep(0.01)


async def test_a_restart_of_the_service_is_told_and_the_stream_goes_on_with_a_snapshot(settings, token):
    seen = []

    async def read(address):
        async with AsyncClient(Service(address=address, token=token)) as robot:
            async for event in robot.events():
                seen.append(event)  # noqa: PERF401 - looked at meanwhile

    async with life(settings, token) as address:
        reading = asyncio.create_task(read(address))
        await until(lambda: seen)
    port = int(address.rpartition(":")[2])
    async with life(settings, token, port), asyncio.timeout(20):
        await until(lambda: [event.type for event in seen].count("snapshot") > 1 and seen[-1].type != "snapshot")
        reading.cancel()
    lost = next(index for index, event in enumerate(seen) if event.type == "disconnected")
    back = next(event for event in seen[lost:] if event.type != "disconnected")
    assert (back.type, back.gap) == ("snapshot", True)
    assert seen[lost].data["reason"]
    assert not seen[-1].gap


async def test_a_service_that_stays_away_is_given_up(settings, token):
    async with life(settings, token) as address:
        pass
    async with AsyncClient(Service(address=address, token=token)) as robot:
        with pytest.raises(NoService, match="does not answer"):
            await robot.status()
        seen = robot.events(patience_s=0.3)
        assert (await anext(seen)).type == "disconnected"
        with pytest.raises(NoService, match="does not answer"):
            [event async for event in seen]


async def test_the_synchronous_client_does_the_same(there):
    def use():
        with Client(there) as robot:
            task = robot.wait(robot.submit("where is the red apple?").id, timeout_s=30)
            with contextlib.closing(robot.events(for_s=5)) as events:
                first = next(events)
            with pytest.raises(NotFound):
                robot.task("task_99")
            states = list(robot.follow(task.id))
            return task, first, states, robot.status(), list(robot.events(for_s=0.1))

    task, first, states, status, events = await asyncio.to_thread(use)
    assert task.succeeded
    assert states == [task]
    assert first.type == events[0].type == "snapshot"
    assert not status.stopped


def test_a_service_is_found_with_the_token_of_the_data_folder(tmp_path):
    (tmp_path / "token").write_text("the-token-of-the-folder\n")
    assert find_service("http://127.0.0.1:1", None, tmp_path).token == "the-token-of-the-folder"
    assert find_service("http://127.0.0.1:1", "mine", tmp_path).token == "mine"
    with pytest.raises(NoService, match="no token"):
        find_service("http://example.org:1", None, tmp_path)
    assert "the-token" not in repr(find_service("http://127.0.0.1:1", None, tmp_path))
