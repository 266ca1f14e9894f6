"""Requests on the page, from the words to the outcome: approval, pause, failure, another plan, stop, cancel."""

from __future__ import annotations

import json

import pytest

from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.settings import Settings
from planner.doubles.scripted import Script
from planner.tasks.tasks import TaskStatus
from rehearsal_service import rehearsed
from skills.failures import FailureCode

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
TOKEN = Token("a-token-only-for-tests")
BRING = "bring the blue bottle to the desk"
BADGE = "document.querySelector('.task .badge')?.textContent"


@pytest.fixture
def script():
    """Each action takes a third of a second."""
    return Script(ticks=7)


@pytest.fixture
async def runtime(tmp_path, script):
    return Runtime(Settings(data=tmp_path, port=0), build=rehearsed(script))


@pytest.fixture
async def open_page(page, runtime):
    with bind(runtime.settings) as listener:
        async with serving(runtime, listener, TOKEN):
            await page.open(page_address(listener, TOKEN))
            await page.until("document.querySelectorAll('.room').length === 2")
            yield page
            assert page.complaints == []


async def ask(page, request, mode="auto"):
    await page.js(f"document.querySelector('#mode').value = '{mode}'; document.querySelector('#request').focus()")
    await page.type(request)
    await page.press("Enter")


def act(name):
    return f"document.querySelector('.controls .{name}')"


async def test_a_request_goes_from_words_over_steps_to_an_outcome_that_was_seen(open_page, runtime):
    await ask(open_page, BRING)
    await open_page.until("document.querySelector('.steps .running[aria-current=step]')")
    await open_page.until("document.querySelectorAll('.steps .succeeded').length === 4")
    await open_page.until(f"{BADGE} === 'succeeded'")
    verified = await open_page.until("document.querySelector('.verified .confirmed')?.textContent")
    assert verified == "seen: the blue bottle is on the desk"
    assert "4 of 4 steps done" in await open_page.js("document.querySelector('.plan summary').textContent")
    assert runtime.queue.tasks[-1].status is TaskStatus.SUCCEEDED
    said = runtime.queue.tasks[-1].explanation
    await open_page.until(f"document.querySelector('#announcement').textContent.includes({json.dumps(said)})")


async def test_nothing_moves_before_the_plan_that_is_shown_is_approved(open_page, runtime):
    await ask(open_page, BRING, "ask")
    await open_page.until(f"{BADGE} === 'may I?'")
    forecast = await open_page.js("document.querySelector('.forecast').innerText")
    assert "the blue bottle is on the desk" in forecast
    assert await open_page.js("document.querySelectorAll('.steps li[class=pending]').length") == 4
    shown = int(await open_page.js("document.querySelector('.task').dataset.revision"))
    assert shown == runtime.queue.tasks[-1].plan.revision
    await open_page.js("window.sent = []; fetch = ((f) => (...a) => { sent.push(a[1].body); return f(...a); })(fetch)")
    await open_page.click(act("approve"))
    await open_page.until(f"{BADGE} === 'succeeded'")
    assert await open_page.js("sent[0]") == f'{{"revision":{shown}}}'


async def test_a_plan_that_is_rejected_is_not_carried_out(open_page, runtime):
    await ask(open_page, BRING, "ask")
    await open_page.click(act("reject"))
    await open_page.until(f"{BADGE} === 'cancelled'")
    assert runtime.queue.tasks[-1].times.started_s is None
    assert await open_page.js("document.querySelector('.controls')") is None


async def test_a_task_is_paused_goes_on_and_is_cancelled(open_page, runtime, script):
    script.ticks = 40
    await ask(open_page, BRING)
    await open_page.click(act("pause"))
    await open_page.until(f"{BADGE} === 'paused'")
    await open_page.click(act("resume"))
    await open_page.until(f"{BADGE} === 'running'")
    await open_page.click(act("cancel"))
    await open_page.until(f"{BADGE} === 'cancelled'")
    assert runtime.queue.tasks[-1].status is TaskStatus.CANCELLED


async def test_focus_and_what_is_folded_stay_while_the_steps_go_on(open_page):
    await ask(open_page, BRING)
    await open_page.until(act("pause"))
    await open_page.js(f"{act('cancel')}.focus(); document.querySelector('.plan').open = false")
    await open_page.until("document.querySelectorAll('.steps .succeeded').length >= 2")
    assert await open_page.js("document.activeElement.className") == "cancel"
    assert not await open_page.js("document.querySelector('.plan').open")


async def test_what_failed_is_told_and_the_plans_that_were_given_up_can_be_unfolded(open_page, runtime, script):
    script.outcomes["PICK"] = [FailureCode.GRASP_EMPTY, FailureCode.GRASP_EMPTY]
    await ask(open_page, BRING)
    await open_page.until("document.querySelectorAll('.failures li').length > 0")
    await open_page.until(f"{BADGE} === 'succeeded'")
    task = runtime.queue.tasks[-1]
    told = await open_page.js("[...document.querySelectorAll('.failures li')].map((e) => e.textContent)")
    assert len(told) == len(task.failures)
    assert all(failure.message in line for failure, line in zip(task.failures, told, strict=True))
    assert task.replans > 0
    assert await open_page.js("document.querySelector('.earlier .steps')") is None, "folded, and not yet asked for"
    await open_page.click("document.querySelector('.earlier summary')")
    await open_page.until(f"document.querySelectorAll('.earlier .given-up').length === {task.replans}")
    assert "✕" in await open_page.js("document.querySelector('.earlier .given-up').innerText")


async def test_escape_stops_also_while_one_types_and_what_was_typed_stays(open_page, runtime):
    await ask(open_page, BRING)
    await open_page.until(act("pause"))
    await open_page.type("where is")
    await open_page.press("Escape")
    await open_page.until("!document.querySelector('#stopped').hidden")
    assert runtime.views.status.document()["stopped"]
    assert await open_page.js("document.querySelector('#request').value") == "where is"
    await open_page.click("document.querySelector('#release')")
    await open_page.until(f"{BADGE} === 'succeeded'")
