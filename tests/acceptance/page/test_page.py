"""The page as a person meets it: what can be seen at two sizes and in two lights, and what keys and clicks do."""

from __future__ import annotations

import itertools
import json
import math

import pytest

from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.settings import Settings
from paths import DATA

pytestmark = [pytest.mark.anyio, pytest.mark.slow]

GRAPH = DATA / "flat_graph.json"
TOKEN = Token("a-token-only-for-tests")
SIZES = [(1440, 900), (390, 844)]
BOX = "(({ left, top, right, bottom }) => [left, top, right, bottom])"
SHOWN = "document.querySelectorAll('.room').length === 3"


async def boxes(page, selector):
    """Left, top, right and bottom of every visible element that the selector finds."""
    listed = f"[...document.querySelectorAll({selector!r})].map((e) => e.getBoundingClientRect())"
    return [box for box in await page.js(f"{listed}.map{BOX}") if box[2] > box[0]]


def overlap(a, b):
    width, height = min(a[2], b[2]) - max(a[0], b[0]), min(a[3], b[3]) - max(a[1], b[1])
    return max(0.0, width) * max(0.0, height)


def within(box, outer):
    return box[0] >= outer[0] - 1 and box[1] >= outer[1] - 1 and box[2] <= outer[2] + 1 and box[3] <= outer[3] + 1


async def ask(page, words):
    await page.js("document.querySelector('#request').focus()")
    await page.type(words)
    await page.press("Enter")


async def test_the_token_leaves_the_address_and_a_reload_still_gets_in(page, address):
    await page.open(address)
    await page.until(SHOWN)
    assert await page.js("location.href") == address.partition("?")[0]
    await page.call("Page.reload")
    await page.until(SHOWN)
    assert page.complaints == []


async def test_a_wrong_token_is_told_in_words(page, address):
    await page.open(address[:-1])
    await page.until("document.querySelector('#connection').innerText.includes('token is not valid')")
    assert await page.js("document.querySelector('#status').innerText") == "no access"


@pytest.mark.parametrize("dark", [False, True])
@pytest.mark.parametrize("size", SIZES)
async def test_everything_has_its_place_and_nothing_overlaps(page, address, size, dark):
    width, height = size
    await page.resize(width, height, dark=dark)
    await page.open(address)
    await page.until(SHOWN)
    assert await page.js("document.documentElement.scrollWidth") <= width
    sections = await boxes(page, "header, section")
    assert len(sections) == 5
    assert all(overlap(a, b) == 0 for a, b in itertools.combinations(sections, 2))
    screen = (0, 0, width, height)
    for control in ("#stop", "#request", "#ask button[type=submit]", "#map"):
        [box] = await boxes(page, control)
        assert within(box, screen), control
    [stop] = await boxes(page, "#stop")
    assert stop[2] - stop[0] >= 90
    assert stop[3] - stop[1] >= 40
    assert page.complaints == []


@pytest.mark.parametrize("size", SIZES)
async def test_the_stop_stays_in_view_however_far_one_scrolls(page, address, size):
    await page.resize(*size)
    await page.open(address)
    await page.until(SHOWN)
    for words in ("bring the blue bottle to the desk", "bring the red apple to the bench", "where is the red apple?"):
        await ask(page, words)
        await page.until("document.querySelector('#request').value === ''")
    await page.js("scrollTo(0, document.documentElement.scrollHeight)")
    [stop] = await boxes(page, "#stop")
    assert within(stop, (0, 0, *size))


@pytest.mark.parametrize("size", SIZES)
async def test_the_map_names_each_room_inside_it_and_beside_its_furniture(page, address, size):
    await page.resize(*size)
    await page.open(address)
    await page.until(SHOWN)
    assert await page.js("[...document.querySelectorAll('.room-name')].map((e) => e.textContent)") == [
        "hall",
        "kitchen",
        "office",
    ]
    names, rooms = await boxes(page, ".room-name"), await boxes(page, ".room")
    assert all(within(name, room) for name, room in zip(names, rooms, strict=True))
    assert all(name[3] - name[1] >= 11 for name in names)
    furniture = await boxes(page, ".furniture")
    assert len(furniture) == 8
    assert all(overlap(name, piece) == 0 for name in names for piece in furniture)


async def test_the_map_shows_doors_as_gaps_things_in_their_colors_and_the_robot(page, address):
    await page.open(address)
    await page.until(SHOWN)
    middles = await page.js(
        "[...document.querySelectorAll('.door .gap')].map((e) => e.getBoundingClientRect())"
        ".map(({ x, y, width, height }) => document.elementFromPoint(x + width / 2, y + height / 4).className.baseVal)"
    )
    assert middles == ["gap", "gap", "gap"], "nothing of a wall lies over them"
    rooms, doors = await boxes(page, ".room"), await boxes(page, ".door .gap")
    for door, (one, other) in zip(doors, ((0, 1), (0, 2), (1, 2)), strict=True):
        assert overlap(door, rooms[one]) > 0
        assert overlap(door, rooms[other]) > 0, "it goes right through the wall"
    assert await page.js("document.querySelectorAll('.door.closed').length") == 1
    assert await page.js("document.querySelector('[data-id=bottle_1]').getAttribute('fill')") == "blue"
    [robot] = await boxes(page, ".robot")
    assert within(robot, rooms[0])


async def test_a_request_is_made_with_the_keyboard_alone_and_its_plan_appears(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await page.press("Tab")
    assert await page.js("document.activeElement.id") == "stop"
    await page.press("Tab")
    await page.press("Tab")
    assert await page.js("document.activeElement.id") == "request"
    await page.type("bring the blue bottle to the desk")
    await page.press("Enter")
    await page.until("document.querySelectorAll('.steps li').length === 4")
    steps = await page.js("[...document.querySelectorAll('.steps .what')].map((e) => e.textContent)")
    assert steps == [
        "Go to the blue bottle",
        "Pick up the blue bottle",
        "Go to the white desk",
        "Put the blue bottle on the white desk",
    ]
    assert await page.js("document.querySelector('.badge').textContent") == "planned only"
    assert await page.js("document.querySelector('#request').value") == ""
    assert page.complaints == []


async def test_candidates_are_buttons_and_one_click_answers(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await ask(page, "bring the cup to the bench")
    await page.until("document.querySelectorAll('.candidates button').length === 2")
    await page.click(
        "[...document.querySelectorAll('.candidates button')].find((e) => e.textContent.includes('white'))"
    )
    await page.until("document.querySelector('.steps')?.innerText.includes('Put the white cup on the brown bench')")
    assert await page.js("document.querySelector('.candidates')") is None


async def test_an_answer_can_also_be_typed(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await ask(page, "bring the cup to the bench")
    await page.until("Boolean(document.querySelector('.question input'))")
    await page.js("document.querySelector('.question input').focus()")
    await page.type("the red one")
    await page.press("Enter")
    await page.until("document.querySelector('.steps')?.innerText.includes('Put the red cup')")


async def test_stop_is_latched_by_click_or_escape_and_released_by_its_own_button(page, address, runtime):
    await page.open(address)
    await page.until(SHOWN)
    for stop in (lambda: page.click("document.querySelector('#stop')"), lambda: page.press("Escape")):
        await stop()
        await page.until("!document.querySelector('#stopped').hidden")
        assert runtime.views.status.document()["stopped"]
        assert await page.js("document.querySelector('#stop').textContent") == "STOP"
        await page.click("document.querySelector('#stop')")
        assert runtime.views.status.document()["stopped"], "a second push, in panic, must not release it"
        await page.click("document.querySelector('#release')")
        await page.until("document.querySelector('#stopped').hidden")
        assert not runtime.views.status.document()["stopped"]


async def test_a_suggestion_fills_in_the_request_and_works(page, address):
    await page.open(address)
    await page.until("document.querySelectorAll('#suggestions button').length >= 3")
    count = await page.js("document.querySelectorAll('#suggestions button').length")
    for number in range(count):
        await page.click(f"document.querySelectorAll('#suggestions button')[{number}]")
        await page.press("Enter")
        await page.until(f"document.querySelectorAll('.task.succeeded').length === {number + 1}")


async def test_a_click_on_a_thing_tells_of_it_and_takes_a_name(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await page.click("document.querySelector('[data-id=bottle_1]')")
    told = await page.until("document.querySelector('#details').innerText")
    assert "blue bottle" in told
    assert "on the brown table in the kitchen" in told
    await page.js("document.querySelector('#details input').focus()")
    await page.type("Ada's <b>bottle</b>")
    await page.press("Enter")
    await page.until(
        "document.querySelector('[data-id=bottle_1] title').textContent.startsWith(\"Ada's <b>bottle</b>\")"
    )
    assert await page.js("document.querySelector('#details b')") is None
    await page.click("document.querySelector('#details .close')")
    await page.until("document.querySelector('#details').hidden")


async def test_the_map_is_moved_and_searched_with_keys(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await page.js("document.querySelector('#map').focus()")
    await page.press("n")
    await page.until("document.querySelector('#details').innerText.includes('hall')")
    scale = "Number(document.querySelector('#map .world').getAttribute('transform').match(/[0-9.]+/)[0])"
    whole = await page.js(scale)
    await page.press("+")
    nearer = await page.js(scale)
    assert nearer > whole
    await page.press("0")
    assert await page.js(scale) < nearer  # not just as before: the building may have grown meanwhile


async def test_words_of_others_are_shown_as_words(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await ask(page, "<img src=x onerror=alert(1)>")
    await page.until("Boolean(document.querySelector('.task .words'))")
    assert await page.js("document.querySelector('.task .words').textContent") == "<img src=x onerror=alert(1)>"
    assert await page.js("document.querySelector('.task img')") is None


async def test_a_building_that_the_robot_entered_askew_stands_upright_on_the_screen(page, tmp_path):
    angle = 0.43
    document = json.loads(GRAPH.read_text(encoding="utf-8"))
    for node in document["nodes"]:
        x, y, z = node["position_m"]
        node["position_m"] = [*turned((x, y), angle), z]
        node["yaw_rad"] += angle
        if "polygon_m" in node:
            node["polygon_m"] = [turned(corner, angle) for corner in node["polygon_m"]]
    (tmp_path / "askew.json").write_text(json.dumps(document), encoding="utf-8")
    runtime = Runtime(Settings(graph=tmp_path / "askew.json", data=tmp_path, port=0))
    with bind(runtime.settings) as listener:
        async with serving(runtime, listener, TOKEN):
            await page.open(page_address(listener, TOKEN))
            await page.until(SHOWN)
            rooms = await boxes(page, ".room")
            shapes = [(right - left) / (bottom - top) for left, top, right, bottom in rooms]
            assert shapes == pytest.approx([2.4 / 6.6, 4.0 / 3.2, 4.0 / 3.2], rel=0.01)
            names, furniture = await boxes(page, ".room-name"), await boxes(page, ".furniture")
            assert len(names) == 3
            assert all(overlap(name, piece) == 0 for name in names for piece in furniture)
            assert within((await boxes(page, ".robot"))[0], rooms[0])


def turned(point, angle):
    """A point of the plane, turned about the origin."""
    (x, y), c, s = point, math.cos(angle), math.sin(angle)
    return [c * x - s * y, s * x + c * y]
