"""One request from the page to a robot that drives in a simulated house, and the stop while it drives."""

from __future__ import annotations

import json
import math
from importlib.resources import files

import pytest

from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.settings import ClockMode, Settings

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
TOKEN = Token("a-token-only-for-tests")
LIMIT_S = 120.0
FLAT = json.loads((files("simulation") / "houses" / "flat.json").read_text(encoding="utf-8"))
[WARDROBE_M] = [piece["pose"][:2] for piece in FLAT["furniture"] if piece["category"] == "wardrobe"]
NEAR_M = 1.5
BADGE = "document.querySelector('.task .badge')?.textContent"
KNOWN = "document.querySelector('#map [data-id^=wardrobe]')"
STOPPED = "!document.querySelector('#stopped').hidden"


async def test_the_robot_drives_where_it_is_asked_to_and_stands_while_it_is_stopped(page, tmp_path):
    settings = Settings(house="flat", clock=ClockMode.LOCKSTEP, speed=None, data=tmp_path, port=0, simulation_api=True)
    runtime = Runtime(settings)
    with bind(settings) as listener:
        async with serving(runtime, listener, TOKEN):
            await page.open(page_address(listener, TOKEN))
            await page.until(f"document.querySelector('#map .room') && {KNOWN}", LIMIT_S)
            await page.js("document.querySelector('#request').focus()")
            await page.type("go to the wardrobe")
            await page.press("Enter")
            await page.until("document.querySelector('.steps .running')", LIMIT_S)
            await page.press("Escape")
            await page.until(STOPPED)
            before = await standing(runtime)
            assert await standing(runtime) == pytest.approx(before, abs=2e-3), "it is stopped, and stands"
            assert await page.js(BADGE) == "running", "and has not forgotten what it was about"
            await page.click("document.querySelector('#release')")
            await page.until(f"['succeeded', 'failed'].includes({BADGE})", LIMIT_S)
            assert await page.js(BADGE) == "succeeded"
            truth = await runtime.require_robot().truth()
            assert math.dist(truth["robot"]["pose"][:2], WARDROBE_M) < NEAR_M
            assert truth["collisions"] == 0
            assert page.complaints == [], "while it was served: it rightly complains once the service is gone"


async def standing(runtime):
    """Where the robot truly is, a second after it had time to come to rest."""
    at_s = runtime.now_s
    while runtime.now_s < at_s + 1.0:
        await runtime.wait_for_change()
    return (await runtime.require_robot().truth())["robot"]["pose"]
