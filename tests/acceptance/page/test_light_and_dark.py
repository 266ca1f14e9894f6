"""Light or dark: as the system says, until a person chooses, and from then on as chosen."""

from __future__ import annotations

import pytest

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
SHOWN = "document.querySelectorAll('.room').length === 3"
BRIGHTNESS = (
    "Number(getComputedStyle(document.body).backgroundColor.match(/\\d+/g).reduce((a, b) => Number(a) + Number(b)))"
)
PRESSED = "document.querySelector('#theme').ariaPressed"


async def is_dark(page):
    dark = await page.js(BRIGHTNESS) < 300
    assert await page.js(PRESSED) == str(dark).lower(), "the button says what is so"
    return dark


async def reload(page):
    await page.call("Page.reload")
    await page.until(SHOWN)


async def test_the_page_follows_the_system_also_while_it_is_open(page, address):
    await page.open(address)
    await page.until(SHOWN)
    assert not await is_dark(page)
    await page.resize(1440, 900, dark=True)
    await page.until(f"{PRESSED} === 'true'")  # the system's wish reaches styles and scripts at different moments
    assert await is_dark(page)
    await page.resize(1440, 900, dark=False)
    await page.until(f"{PRESSED} === 'false'")
    assert not await is_dark(page)


async def test_a_choice_is_remembered_whatever_the_system_says_and_can_be_taken_back(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await page.click("document.querySelector('#theme')")
    assert await is_dark(page)
    await reload(page)
    assert await is_dark(page)
    await page.click("document.querySelector('#theme')")
    assert not await is_dark(page)
    await reload(page)
    await page.resize(1440, 900, dark=True)
    await page.until(f"{PRESSED} === 'true'")
    assert await is_dark(page), "chosen as the system is, it follows the system again"
    assert page.complaints == []
