"""The page when the service goes away and comes back."""

from __future__ import annotations

import pytest

from majordomo.app.http.security import Token
from majordomo.app.runtime import Runtime
from majordomo.app.server import bind, page_address, serving

pytestmark = [pytest.mark.anyio, pytest.mark.slow]
TOKEN = Token("a-token-only-for-tests")


async def test_a_lost_service_is_seen_and_a_new_one_is_found_with_its_own_state(page, runtime):
    with bind(runtime.settings) as listener:
        port = listener.getsockname()[1]
        async with serving(runtime, listener, TOKEN):
            await page.open(page_address(listener, TOKEN))
            await page.until("document.querySelectorAll('.room').length === 3")
            runtime.submit("where is the red apple?")
            await page.until("document.querySelectorAll('.task').length === 1")
    await page.until("document.querySelector('#status').innerText.includes('no connection')")
    assert await page.js("document.querySelector('#map-panel').classList.contains('stale')")
    again = Runtime(runtime.settings.model_copy(update={"port": port}))
    with bind(again.settings) as listener:
        async with serving(again, listener, TOKEN):
            await page.until("!document.querySelector('#map-panel').classList.contains('stale')")
            assert await page.js("document.querySelectorAll('.task').length") == 0, "nothing of the old life is left"
            assert await page.js("document.querySelector('#problem').hidden")
