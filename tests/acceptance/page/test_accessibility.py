"""No violation of WCAG 2.1 A and AA that axe-core can find, in both sizes, in both lights, with everything unfolded."""

from __future__ import annotations

import importlib.util
from pathlib import Path

import pytest

from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.settings import Settings
from planner.doubles.scripted import Script
from rehearsal_service import rehearsed
from skills.failures import FailureCode

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
TOKEN = Token("a-token-only-for-tests")
SIZES = [(1440, 900), (390, 844)]
VIEWS = ("graph", "agents", "camera", "map")
SHOWN = "document.querySelectorAll('.room').length === 3"
LEVELS = ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa"]
FOUND = "v.nodes.map((n) => `${v.id}: ${n.target} ${n.failureSummary}`)"
TAPPED = "button, select, input:not([type=checkbox]), .switch, textarea, summary, a"


@pytest.fixture(scope="module")
def axe():
    """The script of axe-core, as its Python package brings it."""
    package = Path(importlib.util.find_spec("axe_core_python").origin).parent
    return (package / "axe.min.js").read_text(encoding="utf-8")


async def violations(page, axe):
    """What axe-core finds wrong with the page as it is now."""
    await page.js(axe + "; true")
    options = f"{{ runOnly: {LEVELS} }}"
    return await page.js(f"axe.run(document, {options}).then((r) => r.violations.flatMap((v) => {FOUND}))")


async def asked(page, words, mode="auto"):
    await page.js(f"document.querySelector('#mode').value = '{mode}'; document.querySelector('#request').focus()")
    await page.type(words)
    await page.press("Enter")
    await page.until("document.querySelector('#request').value === ''")


async def small_targets(page):
    """Everything that one taps and that is less than 44 px wide or high."""
    shown = f"[...document.querySelectorAll('{TAPPED}')].filter((e) => e.checkVisibility())"
    small = "(({ width, height }) => width < 44 || height < 44)(e.getBoundingClientRect())"
    return await page.js(f"{shown}.filter((e) => {small}).map((e) => e.outerHTML.slice(0, 120))")


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("size", SIZES, ids=["desktop", "phone"])
async def test_axe_finds_nothing_while_requests_are_answered_planned_and_asked_about(page, address, axe, size, dark):
    await page.resize(*size, dark=dark)
    await page.open(address)
    await page.until(SHOWN)
    assert await violations(page, axe) == [], "as it opens"
    await asked(page, "where is the red apple?")
    await asked(page, "bring the blue bottle to the desk", "dry")
    await asked(page, "dance with me")
    await asked(page, "bring the cup to the bench")
    await page.until("document.querySelectorAll('.candidates button').length === 2")
    await page.click("document.querySelector('.links [data-node]')")
    await page.until("!document.querySelector('#details').hidden")
    await page.js("document.querySelectorAll('details').forEach((e) => { e.open = true; })")
    await page.click("document.querySelector('#stop')")
    await page.until("!document.querySelector('#stopped').hidden")
    assert await violations(page, axe) == [], "with everything unfolded"
    for view in VIEWS:
        await page.click(f"document.querySelector('#tab-{view}')")
        await page.until(f"document.querySelector('#view-{view}').checkVisibility()")
        assert await violations(page, axe) == [], view
        assert size[0] > 600 or await small_targets(page) == [], view
    await page.click("document.querySelector('.links .why')")
    await page.until("document.querySelector('#view-trace .entry')")
    await page.js("document.querySelectorAll('#view-trace details').forEach((e) => { e.open = true; })")
    assert await violations(page, axe) == [], "decisions"
    if size[0] < 600:
        assert await small_targets(page) == []
        assert await page.js("document.documentElement.scrollWidth") <= size[0]


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("size", SIZES, ids=["desktop", "phone"])
async def test_axe_finds_nothing_in_a_plan_to_approve_and_in_one_that_failed(page, tmp_path, axe, size, dark):
    script = Script(ticks=2, outcomes={"PICK": [FailureCode.GRASP_EMPTY] * 2})
    runtime = Runtime(Settings(data=tmp_path, port=0), build=rehearsed(script))
    await page.resize(*size, dark=dark)
    with bind(runtime.settings) as listener:
        async with serving(runtime, listener, TOKEN):
            await page.open(page_address(listener, TOKEN))
            await page.until("document.querySelectorAll('.room').length === 2")
            await asked(page, "bring the blue bottle to the desk")
            await page.until("document.querySelector('.task.succeeded .earlier')")
            await page.click("document.querySelector('.earlier summary')")
            await page.until("document.querySelector('.earlier .given-up')")
            await asked(page, "bring the blue bottle to the shelf", "ask")
            await page.until("document.querySelector('.controls .approve')")
            assert await violations(page, axe) == []


@pytest.mark.parametrize("size", SIZES, ids=["desktop", "phone"])
async def test_every_control_can_be_reached_with_tab_in_the_order_in_which_it_stands_and_is_seen(page, address, size):
    await page.resize(*size)
    await page.open(address)
    await page.until(SHOWN)
    await asked(page, "bring the cup to the bench")
    await page.until("document.querySelectorAll('.candidates button').length === 2")
    focusable = 'button, select, input, textarea, summary, [tabindex]:not([tabindex="-1"])'
    shown = f"[...document.querySelectorAll('{focusable}')].filter((e) => e.checkVisibility() && e.tabIndex >= 0)"
    expected = await page.js(f"{shown}.map((e) => e.id || e.textContent)")
    await page.js("document.activeElement.blur(); getSelection().removeAllRanges(); scrollTo(0, 0)")
    await page.js("document.body.tabIndex = -1; document.body.focus(); document.body.removeAttribute('tabindex')")
    reached = []
    for _ in expected:
        await page.press("Tab")
        reached.append(await page.js("document.activeElement.id || document.activeElement.textContent"))
        outline = await page.js("getComputedStyle(document.activeElement).outlineStyle")
        assert outline == "solid", f"no visible focus on {reached[-1]}"
    assert reached == expected


async def test_who_wants_less_motion_gets_none(page, address):
    await page.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
    await page.open(address)
    await page.until(SHOWN)
    moving = "(s) => parseFloat(s.transitionDuration) > 0 || parseFloat(s.animationDuration) > 0"
    assert (
        await page.js(f"[...document.querySelectorAll('*')].map((e) => getComputedStyle(e)).filter({moving}).length")
        == 0
    )


async def test_headings_and_landmarks_tell_the_parts_of_the_page(page, address):
    await page.open(address)
    await page.until(SHOWN)
    assert await page.js("document.querySelectorAll('header, main').length") == 2
    headings = await page.js("[...document.querySelectorAll('h1, h2')].map((e) => e.textContent.trim())")
    assert headings[0] == "Majordomo"
    assert {"What shall I do?", "Requests", "Log"} <= set(headings)
    unnamed = "(e) => !e.ariaLabel && !document.getElementById(e.getAttribute('aria-labelledby'))?.textContent"
    assert await page.js(f"[...document.querySelectorAll('section')].filter({unnamed}).length") == 0
    live = await page.js("[...document.querySelectorAll('[role=status], [role=alert], [aria-live]')].map((e) => e.id)")
    assert "status" not in live, "what changes every second is not read out"


@pytest.mark.parametrize("dark", [False, True], ids=["light", "dark"])
@pytest.mark.parametrize("size", SIZES, ids=["desktop", "phone"])
async def test_axe_finds_nothing_in_the_documentation_of_the_interface(page, address, axe, size, dark):
    await page.resize(*size, dark=dark)
    await page.open(address.partition("?")[0] + "docs")
    await page.until("document.querySelectorAll('details').length > 20")
    await page.js("[...document.querySelectorAll('details')].slice(0, 6).forEach((e) => { e.open = true; })")
    assert await violations(page, axe) == []
    assert await page.js("document.documentElement.scrollWidth") <= size[0]
