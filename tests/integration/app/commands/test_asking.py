"""``majordomo ask`` against a running service."""

from __future__ import annotations

import asyncio
import io
import json

import pytest
from rich.console import Console

from app.commands.ask import Asking, Ending, Manners
from client import Client, NoService, Refused, Service, find_service
from planner.tasks.tasks import TaskStatus

pytestmark = pytest.mark.anyio


class Terminal(Console):
    """A console that keeps what is printed and types prepared answers; without any, its keyboard is unplugged."""

    def __init__(self, *answers: str) -> None:
        super().__init__(file=io.StringIO(), width=200)
        self.answers, self.prompts = list(answers), []

    def input(self, prompt="", **options):
        self.prompts.append(str(prompt))
        if not self.answers:
            raise EOFError
        return self.answers.pop(0)

    @property
    def text(self):
        return self.file.getvalue()


@pytest.fixture
def target(served, token):
    return Service(address=served.address, token=token)


async def ask(target, request, terminal, **manners):
    """Ask from another thread, as another process would."""

    def run():
        with Client(target) as robot:
            return Asking(robot=robot, console=terminal, manners=Manners(**manners)).run(request)

    return await asyncio.to_thread(run)


async def newest(served):
    [task] = (await served.client.get("/v1/tasks", params={"limit": 1})).json()["tasks"]
    return task


async def test_an_answer_is_printed_and_counts_as_success(target):
    terminal = Terminal()
    assert await ask(target, "where is the red apple?", terminal) is Ending.SUCCEEDED
    assert "bowl" in terminal.text


async def test_a_refusal_is_printed_and_does_not(target):
    terminal = Terminal()
    assert await ask(target, "fold the laundry", terminal) is Ending.NOT_SUCCEEDED
    assert "cannot fold" in terminal.text


async def test_the_plan_is_told_once_and_then_how_it_ended(target):
    terminal = Terminal()
    assert await ask(target, "bring the blue bottle to the desk", terminal, dry_run=True) is Ending.SUCCEEDED
    plan, end = terminal.text.splitlines()
    assert plan.split()[0] == "plan"
    assert "PICK(" in plan
    assert end.strip().startswith("succeeded  Planned only")


async def test_a_question_is_put_to_the_keyboard_until_there_is_an_answer(target):
    terminal = Terminal("", "  ", "the white one")
    assert await ask(target, "bring the cup to the bench", terminal) is Ending.SUCCEEDED
    assert len(terminal.prompts) == 3
    assert "the red cup on the gray counter" in terminal.prompts[0]
    assert "white cup" in terminal.text


async def test_a_question_is_answered_by_what_was_given_beforehand(target):
    terminal = Terminal()
    ending = await ask(target, "bring the cup to the bench", terminal, answers=("the white one",), keyboard=False)
    assert ending is Ending.SUCCEEDED
    assert terminal.prompts == []
    assert "> the white one" in terminal.text


@pytest.mark.parametrize("keyboard", [True, False])
async def test_without_a_keyboard_the_question_is_left_to_others(target, served, keyboard):
    terminal = Terminal()
    assert await ask(target, "bring the cup to the bench", terminal, keyboard=keyboard) is Ending.WAITS
    assert "the task waits" in terminal.text
    assert (await newest(served))["status"] == "awaiting_answer"


async def test_who_does_not_stay_gets_the_identifier(target, served):
    terminal = Terminal()
    assert await ask(target, "where is the red apple?", terminal, follow=False) is Ending.SUCCEEDED
    assert terminal.text.strip() == (await newest(served))["id"]


def show_a_plan(served, revision=412):
    """A task whose plan waits for approval, as it is with a robot."""
    queue = served.runtime.queue
    task = queue.submit("bring the cup", stamp_s=0.0)
    queue.move(task.id, TaskStatus.PLANNING, stamp_s=0.0)
    queue.move(task.id, TaskStatus.AWAITING_APPROVAL, stamp_s=0.0, explanation="I bring the cup. Shall I?")
    return task.id


@pytest.mark.parametrize(
    ("manners", "typed", "ending"),
    [
        ({}, ["y"], "succeeded"),
        ({}, ["no"], "cancelled"),
        ({"agree": True}, [], "succeeded"),
        ({"agree": False}, [], "cancelled"),
    ],
)
async def test_a_plan_is_approved_or_turned_down(target, served, manners, typed, ending):
    terminal = Terminal(*typed)
    task_id = show_a_plan(served)

    def decide():
        with Client(target) as robot:
            asking = Asking(robot=robot, console=terminal, manners=Manners(**manners))
            decided = asking._decide(robot.task(task_id))
            return decided, robot.task(task_id)

    decided, task = await asyncio.to_thread(decide)
    assert decided
    assert (task.status == "cancelled") == (ending == "cancelled")
    assert bool(terminal.prompts) == bool(typed)
    assert "Shall I?" in (terminal.prompts[0] if typed else terminal.text)


async def test_somebody_else_may_decide_first(target, served):
    terminal = Terminal("y")
    task_id = show_a_plan(served)

    def decide():
        with Client(target) as robot:
            before = robot.task(task_id)
            robot.reject(task_id)
            return Asking(robot=robot, console=terminal)._decide(before)

    assert await asyncio.to_thread(decide)
    assert "cannot approve" in terminal.text


@pytest.mark.parametrize(
    ("typed", "status"), [(["y"], "cancelled"), (["n"], "awaiting_answer"), ([], "awaiting_answer")]
)
async def test_ctrl_c_ends_the_watching_and_the_task_only_on_demand(target, served, typed, status):
    class Impatient(Terminal):
        def input(self, prompt="", **options):
            if not self.prompts:
                self.prompts.append(str(prompt))
                raise KeyboardInterrupt
            return super().input(prompt, **options)

    terminal = Impatient(*typed)
    assert await ask(target, "bring the cup to the bench", terminal) is Ending.INTERRUPTED
    assert "task_1 goes on without you; it is awaiting answer." in terminal.text
    assert terminal.prompts[1] == "Cancel it? [y/N] "
    assert (await newest(served))["status"] == status


async def test_after_the_time_that_was_given_it_goes_on_alone(target, served):
    queue = served.runtime.queue
    busy = queue.submit("go to the kitchen", stamp_s=0.0)
    for status in (TaskStatus.PLANNING, TaskStatus.RUNNING, TaskStatus.PAUSED):
        queue.move(busy.id, status, stamp_s=0.0)
    terminal = Terminal()
    assert await ask(target, "bring the cup to the bench", terminal, timeout_s=0.3) is Ending.GOES_ON
    assert "task_2 is queued after 0.3 s; it goes on" in terminal.text


@pytest.mark.parametrize(
    ("request_text", "said"),
    [
        ("", "The request is empty. Please"),
        (" \t\n", "The request is empty. Please"),
        ("go " * 4000, "at most 10000"),
        ("go " * 30_000, "at most 65536 bytes"),
        ("bring \udcff\udcfe cup", "cannot read this as text"),
    ],
    ids=["empty", "blank", "long", "huge", "bytes"],
)
async def test_a_request_that_is_none_is_refused_in_a_sentence(target, served, request_text, said):
    with pytest.raises((NoService, Refused), match=said):
        await ask(target, request_text, Terminal())
    assert (await served.client.get("/v1/tasks")).json()["total"] == 0


async def test_an_answer_that_cannot_be_taken_is_asked_for_again_and_why(target):
    terminal = Terminal("", "x" * 10_001, "\udcff", "the white one")
    assert await ask(target, "bring the cup to the bench", terminal) is Ending.SUCCEEDED
    assert len(terminal.prompts) == 4
    for said in ("The answer is empty.", "The answer has 10001 characters", "cannot read this as text", "white cup"):
        assert said in terminal.text


@pytest.mark.parametrize(
    ("change", "said"), [({"token": "not-the-one-you-want"}, "token"), ({"address": "http://127.0.0.1:9"}, "answer")]
)
async def test_what_goes_wrong_is_one_sentence(target, change, said):
    broken = Service(**{"address": target.address, "token": target.token} | change)
    with pytest.raises((NoService, Refused), match=said):
        await ask(broken, "where is the red apple?", Terminal())


def test_the_service_is_found_by_its_address_or_where_it_left_it(tmp_path):
    found = find_service("http://127.0.0.1:8642/?token=abc", None, tmp_path)
    assert found == Service(address="http://127.0.0.1:8642", token="abc")
    with pytest.raises(NoService, match="no token"):
        find_service("http://127.0.0.1:8642/", None, tmp_path)
    with pytest.raises(NoService, match="majordomo serve") as refusal:
        find_service(None, None, tmp_path)
    assert f"in {tmp_path}:" in str(refusal.value)
    assert "with --data" in str(refusal.value)
    (tmp_path / "service.json").write_text(json.dumps({"address": "http://127.0.0.1:1", "token": "t", "pid": 1}))
    assert find_service(None, None, tmp_path).address == "http://127.0.0.1:1"


@pytest.mark.parametrize("left", [b"", b"{}", b"[1]", b"\xff\xfe", b"null"])
def test_what_is_no_address_of_a_service_counts_as_none(tmp_path, left):
    (tmp_path / "service.json").write_bytes(left)
    with pytest.raises(NoService, match="majordomo serve"):
        find_service(None, None, tmp_path)


@pytest.mark.parametrize(
    ("url", "said"),
    [
        ("http://[::1", "cannot be used"),
        ("http://\udcff/?token=a", "cannot be used"),
        ("http://127.0.0.1:99999/?token=a", "ports end at 65535"),
        ("http://127.0.0.1:8642/?token=\u00e4", "copy it"),
        ("", "no token"),
    ],
)
def test_an_address_that_cannot_be_one_is_refused_in_a_sentence(tmp_path, url, said):
    with pytest.raises(NoService, match=said):
        find_service(url, None, tmp_path)
