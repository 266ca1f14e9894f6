"""The page when the service goes away, hangs, and comes back: nothing old is ever shown as if it were now."""

from __future__ import annotations

import contextlib
import os
import signal
import socket

import anyio.to_thread
import pytest

from paths import DATA
from service_process import serving

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
GRAPH = DATA / "flat_graph.json"
SHOWN = "document.querySelectorAll('.room').length === 3"
BANNER = "document.querySelector('#connection')"
IS_STALE = "document.body.classList.contains('stale')"
ENDED = "document.querySelector('.task:is(.succeeded, .refused)')"
AGE_S = f"parseInt({BANNER}.querySelector('.age').innerText.match(/\\d+/)?.[0])"


@pytest.fixture
def port():
    """A port that is free."""
    with socket.create_server(("127.0.0.1", 0)) as listener:
        return listener.getsockname()[1]


@contextlib.asynccontextmanager
async def service(data, port, *options):
    """``majordomo serve`` as a process of its own, on the port that it had before."""
    life = serving(data, "--port", str(port), *(options or ("--graph", str(GRAPH))))
    started = await anyio.to_thread.run_sync(life.__enter__)
    try:
        yield started
    finally:
        with contextlib.suppress(ProcessLookupError):
            os.kill(started.process.pid, signal.SIGCONT)
        await anyio.to_thread.run_sync(life.__exit__, None, None, None)


async def ask(page, request):
    await page.js("document.querySelector('#request').focus()")
    await page.type(request)
    await page.press("Enter")


async def test_a_killed_service_is_seen_at_once_its_age_is_told_and_it_comes_back_with_its_requests(
    page, tmp_path, port
):
    house = ("--house", "flat", "--no-explore", "--no-camera")
    async with service(tmp_path, port, *house) as first:
        await page.open(first.page)
        await page.until("document.querySelector('.robot[visibility=visible]')")
        await ask(page, "can you dance?")
        await page.until(ENDED)
        assert await page.js(f"!{IS_STALE} && {BANNER}.hidden")
        first.process.kill()
        await page.until(f"{IS_STALE} && !{BANNER}.hidden && {BANNER}.innerText.includes('No connection')")
        await page.until(f"{AGE_S} >= 2")
        assert await page.js("Number(getComputedStyle(document.querySelector('.view')).opacity)") < 0.6
        assert "no connection" in await page.js("document.querySelector('#status').innerText")
        await ask(page, "what can you do?")
        await page.until("document.querySelector('#problem').innerText.includes('does not answer')")
        assert await page.js("document.querySelector('#request').value") == "what can you do?", "nothing is lost"
    async with service(tmp_path, port, *house):
        await page.until(f"!{IS_STALE} && {BANNER}.hidden && document.querySelector('#problem').hidden")
        words = "document.querySelector('.task .words').textContent"
        assert await page.js(words) == "can you dance?", "it knows what it was asked"
        await page.press("Enter")
        await page.until("document.querySelectorAll('.task').length === 2")


async def test_a_service_that_hangs_is_not_taken_for_live_and_is_stopped_as_soon_as_it_answers(page, tmp_path, port):
    async with service(tmp_path, port) as hung:
        await page.open(hung.page)
        await page.until(SHOWN)
        os.kill(hung.process.pid, signal.SIGSTOP)
        await page.until(f"{IS_STALE} && {BANNER}.innerText.includes('No news')")
        first_s = await page.js(AGE_S)
        assert first_s >= 3
        await page.until(f"{AGE_S} > {first_s}")
        await page.press("Escape")
        os.kill(hung.process.pid, signal.SIGCONT)
        await page.until(f"!{IS_STALE} && !document.querySelector('#stopped').hidden")
        status = await anyio.to_thread.run_sync(lambda: hung.client.get("/v1/status").json())
        assert status["stopped"]


async def test_another_building_after_a_restart_leaves_nothing_of_the_old_one(page, tmp_path, port):
    empty = tmp_path / "empty"
    empty.mkdir()
    async with service(tmp_path, port) as first:
        await page.open(first.page)
        await page.until(SHOWN)
        await ask(page, "where is the red apple?")
        await page.until("document.querySelector('.task.succeeded')")
    (empty / "token").write_text((tmp_path / "token").read_text(encoding="ascii"), encoding="ascii")
    async with service(empty, port):
        await page.until(f"!{IS_STALE}")
        await page.until("document.querySelectorAll('.task').length === 0")
        assert not await page.js("document.querySelector('#no-tasks').hidden")
