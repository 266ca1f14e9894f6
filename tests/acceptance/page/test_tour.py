"""A tour of the page in pictures, of a real run: the robot explores a simulated house, is asked for a bottle, a person
moves the bottle meanwhile, and in the end the service is killed.

``make pictures`` renews those of the documentation; otherwise they go to a temporary folder. With
``ARGS=--explored=FOLDER``, the data folder of a service that has explored the flat, it begins with what is known there.
"""

from __future__ import annotations

import io
import shutil
from functools import partial

import anyio.to_thread
import pytest
from PIL import Image

from service_process import serving

pytestmark = [pytest.mark.anyio, pytest.mark.long]

DESKTOP, PHONE = (1440, 900), (390, 844)
HOUSE = ("--house", "flat", "--seed", "1", "--clock", "lockstep", "--speed", "max", "--simulation-api")
SETTLE_MS = 1500
"""Time for pictures of the camera, and for the map, to come."""
MOST_BYTES = 200_000
BADGE = "document.querySelector('.task .badge')?.textContent"
STATUS = "document.querySelector('#status').innerText"
CARRIED = f"{STATUS}.includes('holding') && document.querySelector('polyline.path')"
ENDED = f"['succeeded', 'failed', 'cancelled', 'refused'].includes({BADGE})"


class Tour:
    """A visitor with a camera."""

    def __init__(self, page, service, folder) -> None:
        self._page, self._service, self._folder = page, service, folder
        (folder / "tour").mkdir(parents=True, exist_ok=True)

    async def take(self, name: str, size=DESKTOP, *, dark: bool = False, top: str = "body") -> None:
        """Take a picture of the page from the element ``top`` on, at a size and in a light."""
        await self._page.resize(*size, dark=dark)
        await self._page.js(f"document.querySelector('{top}').scrollIntoView(); document.activeElement.blur()")
        await self._page.js("document.querySelectorAll('#tasks-panel, #log-panel').forEach((e) => e.scrollTo(0, 0))")
        await self._page.js(f"new Promise((done) => setTimeout(done, {SETTLE_MS}))")
        assert await self._page.js("document.documentElement.scrollWidth") <= size[0]
        assert await self._page.js("document.querySelector('#stop').getBoundingClientRect().top") >= 0
        image = Image.open(io.BytesIO(await self._page.picture())).convert("RGB")
        await self._page.resize(*DESKTOP)
        file = self._folder / f"{name}.png"
        await anyio.to_thread.run_sync(partial(image.quantize(160).save, file, optimize=True))
        assert file.stat().st_size < MOST_BYTES, f"{file.name} is too large for the documentation"

    async def until(self, condition: str, limit_s: float = 60.0) -> None:
        """Wait until a condition holds, however long that takes in the house."""
        await self._page.until(condition, limit_s)

    async def ask(self, words: str, mode: str = "auto") -> None:
        """Type a request."""
        await self._page.js(
            f"document.querySelector('#mode').value = '{mode}'; document.querySelector('#request').focus()"
        )
        await self._page.type(words)
        await self._page.press("Enter")
        await self.until("document.querySelector('#request').value === ''")

    async def click(self, selector: str) -> None:
        """Click an element."""
        await self._page.click(f"document.querySelector('{selector}')")

    async def disturb(self, **event) -> None:
        """Meddle with the house."""
        post = partial(self._service.client.post, "/v1/simulation/disturb", json=event)
        (await anyio.to_thread.run_sync(post)).raise_for_status()


@pytest.fixture
def known(request, tmp_path):
    """The folder of an explored building, if one is given."""
    given = request.config.getoption("--explored", None)
    if given is not None:
        shutil.copytree(given, tmp_path / "data")
    return given


@pytest.fixture
async def service(tmp_path, known):
    data = tmp_path / "data"
    data.mkdir(exist_ok=True)
    life = serving(data, *HOUSE)
    started = await anyio.to_thread.run_sync(life.__enter__)
    yield started
    await anyio.to_thread.run_sync(life.__exit__, None, None, None)


@pytest.fixture
def folder(request, tmp_path):
    return request.config.getoption("--pictures", None) or tmp_path


async def test_a_tour_of_the_page(page, service, folder, known):
    tour = Tour(page, service, folder)
    await page.open(service.page)
    if known is None:
        await explored(tour)
    await tour.until(f"/^(ready|idle) · in/.test({STATUS})", 120.0)
    await asked_back(tour)
    await carried_out_while_a_person_interferes(tour)
    await looked_around(tour)
    assert page.complaints == []
    await stopped_and_lost(tour, service)


async def explored(tour):
    await tour.until("document.querySelectorAll('.room').length >= 2", 600.0)
    await tour.take("tour/exploring")
    await tour.until(f"{STATUS}.includes('ready')", 900.0)


async def asked_back(tour):
    await tour.ask("bring the bottle to the table in the hall")
    await tour.until("document.querySelectorAll('.candidates button').length >= 2")
    await tour.take("tour/question-phone", PHONE)
    await tour.click(".controls .cancel")
    await tour.until(ENDED)


async def carried_out_while_a_person_interferes(tour):
    await tour.ask("bring the blue bottle from the kitchen to the desk in the office", "ask")
    await tour.until(f"{BADGE} === 'may I?'")
    await tour.take("tour/approval")
    await tour.take("tour/approval-phone-dark", PHONE, dark=True, top="#tasks-panel")
    await tour.click(".controls .approve")
    await tour.until("document.querySelector('.steps .running')")
    await tour.disturb(do="move", id="bottle_1", to={"on": "table_2"})
    await tour.until(f"document.querySelectorAll('.failures li').length > 0 || {ENDED}", 200.0)
    await tour.until(f"({CARRIED}) || {ENDED}", 300.0)
    await tour.take("page")
    await tour.until(ENDED, 300.0)
    await tour.click(".earlier summary")
    await tour.until("document.querySelector('.given-up')")
    await tour.take("tour/outcome-dark", dark=True)
    await tour.take("tour/outcome-phone", PHONE, top="#tasks-panel")


async def looked_around(tour):
    await tour.click(".links [data-node]")
    await tour.take("tour/selected")
    await tour.take("tour/map-phone-dark", PHONE, dark=True, top="#map-panel")
    for view in ("graph", "camera", "agents"):
        await tour.click(f"#tab-{view}")
        await tour.take(f"tour/{view}", dark=view == "graph")
    await tour.click(".links .why")
    await tour.until("document.querySelectorAll('#view-trace .entry').length > 0")
    await tour.take("tour/decisions")
    await tour.click("#tab-map")


async def stopped_and_lost(tour, service):
    await tour.click("#stop")
    await tour.until("!document.querySelector('#stopped').hidden")
    await tour.take("tour/stopped-phone", PHONE)
    await tour.click("#release")
    await tour.until("document.querySelector('#stopped').hidden")
    service.process.kill()
    await tour.until("/ [3-9] s old/.test(document.querySelector('#connection').innerText)")
    await tour.take("tour/lost")
