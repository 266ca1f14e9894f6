"""``majordomo ask`` against a running service."""

from __future__ import annotations

import io
import json

import pytest
from rich.console import Console

from majordomo.app.asking import NoService, Service, ask_service, find_service

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


async def test_an_answer_is_printed_and_counts_as_success(target):
    terminal = Terminal()
    assert await ask_service(target, "where is the red apple?", terminal)
    assert "bowl" in terminal.text


async def test_a_refusal_is_printed_and_does_not(target):
    terminal = Terminal()
    assert not await ask_service(target, "fold the laundry", terminal)
    assert "cannot fold" in terminal.text


async def test_a_question_is_put_to_the_keyboard_until_there_is_an_answer(target):
    terminal = Terminal("", "  ", "the white one")
    assert await ask_service(target, "bring the cup to the bench", terminal)
    assert len(terminal.prompts) == 3
    assert "the red cup on the gray counter" in terminal.prompts[0]
    assert "white cup" in terminal.text


async def test_without_a_keyboard_the_question_is_left_to_others(target, served):
    with pytest.raises(NoService, match="the task waits"):
        await ask_service(target, "bring the cup to the bench", Terminal())
    [task] = (await served.client.get("/v1/tasks")).json()["tasks"]
    assert task["status"] == "awaiting_answer"


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
    with pytest.raises(NoService, match=said):
        await ask_service(target, request_text, Terminal())
    assert (await served.client.get("/v1/tasks")).json()["total"] == 0


async def test_an_answer_that_cannot_be_taken_is_asked_for_again_and_why(target):
    terminal = Terminal("", "x" * 10_001, "\udcff", "the white one")
    assert await ask_service(target, "bring the cup to the bench", terminal)
    assert len(terminal.prompts) == 4
    for said in ("The answer is empty.", "The answer has 10001 characters", "cannot read this as text", "white cup"):
        assert said in terminal.text


@pytest.mark.parametrize(
    ("change", "said"), [({"token": "not-the-one-you-want"}, "token"), ({"address": "http://127.0.0.1:9"}, "answer")]
)
async def test_what_goes_wrong_is_one_sentence(target, change, said):
    broken = Service(**{"address": target.address, "token": target.token} | change)
    with pytest.raises(NoService, match=said):
        await ask_service(broken, "where is the red apple?", Terminal())


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
