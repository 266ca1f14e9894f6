"""The request box: history by arrow keys, names completed from the graph, and what shall become of the plan."""

from __future__ import annotations

from dataclasses import replace

import pytest

from app.http.guards.security import Token
from app.server import bind, page_address, serving
from scene_graph.edits import PutNode
from scene_graph.nodes import ObjectNode

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
TOKEN = Token("a-token-only-for-tests")
SHOWN = "document.querySelectorAll('.room').length === 3"
BOX = "document.querySelector('#request').value"
OFFERS = "[...document.querySelectorAll('#suggestions button')].map((e) => e.textContent)"


@pytest.fixture
async def box(page, address):
    """The page with the cursor in the request box."""
    await page.open(address)
    await page.until(SHOWN)
    await page.js("document.querySelector('#request').focus()")
    return page


async def asked(page, *requests):
    for request in requests:
        await page.type(request)
        await page.press("Enter")
        await page.until(f"{BOX} === ''")


async def test_arrow_keys_bring_back_what_was_asked_and_then_the_words_begun(box):
    await asked(box, "where is the red apple?", "what is on the bench?")
    await box.type("bring")
    await box.press("ArrowUp")
    await box.press("ArrowUp")
    assert await box.js(BOX) == "what is on the bench?"
    await box.press("ArrowUp")
    await box.press("ArrowUp")
    assert await box.js(BOX) == "where is the red apple?", "the oldest, however often"
    await box.press("ArrowDown")
    await box.press("ArrowDown")
    assert await box.js(BOX) == "bring"


async def test_what_was_asked_is_remembered_over_a_reload_but_not_what_was_only_typed(box):
    await asked(box, "where is the red apple?")
    await box.type("never asked")
    await box.call("Page.reload")
    await box.until(SHOWN)
    await box.js("document.querySelector('#request').focus()")
    await box.press("ArrowUp")
    assert await box.js(BOX) == "where is the red apple?"


async def test_a_request_that_was_not_taken_stays_in_the_box_with_the_reason(page, runtime):
    viewer = Token("a-viewers-token-for-tests")
    with bind(runtime.settings) as listener:
        async with serving(runtime, listener, TOKEN, viewer=viewer):
            await page.open(page_address(listener, viewer))
            await page.until(SHOWN)
            await page.js("document.querySelector('#request').focus()")
            await page.type("where is the red apple?")
            await page.press("Enter")
            await page.until("document.querySelector('#problem').innerText.includes('only reads')")
            assert await page.js(BOX) == "where is the red apple?"


async def test_names_in_the_graph_complete_the_words(box):
    await box.type("bring the blue b")
    await box.until(f"{OFFERS}.join() === 'bring the blue bottle'")
    await box.click("document.querySelector('#suggestions button')")
    assert await box.js(BOX) == "bring the blue bottle"
    assert await box.js("document.activeElement.id") == "request"
    await box.type(" to the off")
    await box.until(f"{OFFERS}.join() === 'bring the blue bottle to the office'")


async def test_what_is_only_to_be_planned_is_handed_in_so_and_tells_what_it_would_take(box, runtime):
    await box.js("document.querySelector('#mode').value = 'dry'")
    await asked(box, "bring the blue bottle to the desk")
    await box.until("document.querySelector('.forecast')?.innerText.includes('the blue bottle is on the white desk')")
    [task] = runtime.queue.tasks
    assert task.dry_run
    told = await box.js("document.querySelector('.forecast').innerText")
    assert f"{task.plan.expected_m:.1f} m to drive" in told


async def test_what_a_request_is_about_shows_itself(box):
    await asked(box, "bring the blue bottle to the desk")
    await box.click("document.querySelector('.links [data-node=bottle_1]')")
    await box.until("document.querySelector('#details').innerText.includes('bottle_1')")


async def test_an_impatient_second_enter_does_not_ask_twice(box, runtime):
    await box.type("where is the red apple?")
    await box.press("Enter")
    await box.press("Enter")
    await box.until(f"{BOX} === '' && document.querySelector('.task.succeeded')")
    await asked(box, "what is on the bench?")
    await box.until("document.querySelectorAll('.task.succeeded').length === 2")
    assert [task.request for task in runtime.queue.tasks] == ["where is the red apple?", "what is on the bench?"]


async def test_a_late_answer_to_an_impatient_second_enter_leaves_what_is_being_typed(box):
    await box.js(
        """(() => {
            const real = window.fetch, pause = (ms) => new Promise((done) => setTimeout(done, ms));
            let posts = 0;
            window.fetch = async (url, options) => {
                const number = options?.method === "POST" ? ++posts : 0;
                const answer = await real(url, options);
                while (number === 1 && posts < 2) await pause(10);
                if (number === 2) { await pause(1000); window.late = true; }
                return answer;
            };
        })()"""
    )
    await box.type("where is the red apple?")
    await box.press("Enter")
    await box.press("Enter")
    await box.until(f"{BOX} === ''")
    await box.type("what is on the bench?")
    await box.until("window.late")
    assert await box.js(f"new Promise((done) => setTimeout(() => done({BOX}), 300))") == "what is on the bench?"
    await box.press("Enter")
    await box.until(f"{BOX} === ''")
    await box.press("ArrowUp")
    assert await box.js(BOX) == "what is on the bench?"


async def test_a_suggestion_goes_when_it_would_no_longer_be_clear_what_it_means(box, runtime):
    before = await box.until(f"{OFFERS}.length >= 3 && {OFFERS}")
    assert "where is the purple book?" in before
    snapshot = runtime.memory.snapshot()
    green = next(node for node in snapshot.of_type(ObjectNode) if node.label == "bottle" and node.color == "green")
    [book] = [node for node in snapshot.of_type(ObjectNode) if (node.label, node.color) == ("book", "purple")]
    alike = replace(green, label=book.label, label_distribution=book.label_distribution, color=book.color)
    runtime.memory.commit([PutNode(alike)], agent="test", stamp_s=runtime.now_s)
    await box.until(f"{OFFERS}.length >= 3 && !{OFFERS}.includes('where is the purple book?')")
