"""The page's views: map, graph, camera, agents and decisions, and that all of them show the same selected node."""

from __future__ import annotations

import numpy as np
import pytest

from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.settings import Settings
from app.stacks.graph import GraphStack
from paths import DATA
from perception.objects.seeing.look import Look
from perception.panoptic import Instance, PanopticScene
from perception.ports import Intrinsics, RgbdFrame
from planner.mission.teaching import teach
from scene_graph.geometry.se3 import SE3

pytestmark = [pytest.mark.anyio, pytest.mark.slow]

GRAPH = DATA / "flat_graph.json"
TOKEN = Token("a-token-only-for-tests")
SHOWN = "document.querySelectorAll('#map .room').length === 3"
HEIGHT, WIDTH = 240, 320


def find(selector):
    return f"document.querySelector({selector!r})"


def mask(rows, columns):
    shown = np.zeros((HEIGHT, WIDTH), dtype=bool)
    shown[rows, columns] = True
    return shown


class Filmed(GraphStack):
    """A stored graph with a camera that goes on showing a bottle on a table before a wall, as long as ``rolling``."""

    rolling = True
    _shown: Look | None = None

    @property
    def frame(self):
        return self.look.frame

    @property
    def look(self):
        if self.rolling or self._shown is None:
            self._shown = self._new_look()
        return self._shown

    def _new_look(self):
        frame = RgbdFrame(
            stamp_s=self.now(),
            rgb=np.full((HEIGHT, WIDTH, 3), 120, dtype=np.uint8),
            depth_m=np.ones((HEIGHT, WIDTH), dtype=np.float32),
            intrinsics=Intrinsics(fx=300.0, fy=300.0, cx=160.0, cy=120.0, width=WIDTH, height=HEIGHT),
            T_base_camera=SE3.identity(),
        )
        seen = {
            "bottle": mask(slice(60, 120), slice(140, 165)),
            "table": mask(slice(120, 200), slice(60, 260)),
            "wall": mask(slice(0, 60), slice(0, WIDTH)),
        }
        instances = tuple(
            Instance(label=label, score=0.9, mask=shown, label_distribution=()) for label, shown in seen.items()
        )
        scene = PanopticScene(stamp_s=frame.stamp_s, instances=instances, relations=())
        return Look(frame=frame, scene=scene, nodes={0: "bottle_1", 1: "table_1"})


@pytest.fixture
async def filmed(tmp_path):
    """The stack and the page's address, while it is served."""
    stacks = []

    async def build(settings, queue, model, log, *, anew=False):
        stacks.append(Filmed.load(settings.graph, queue, model, log))
        return stacks[-1]

    runtime = Runtime(Settings(graph=GRAPH, data=tmp_path, port=0), build=build)
    with bind(runtime.settings) as listener:
        async with serving(runtime, listener, TOKEN):
            yield stacks[0], page_address(listener, TOKEN)


async def show(page, view):
    await page.js(f"{find(f'#tab-{view}')}.click()")


async def select(page, node):
    await page.js(f"document.dispatchEvent(new CustomEvent('select-node', {{ detail: {node!r} }}))")


async def test_views_are_chosen_with_arrow_keys_and_only_one_is_shown(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await page.js(f"{find('#tab-map')}.focus()")
    shown = "[...document.querySelectorAll('.view')].filter((e) => e.checkVisibility()).map((e) => e.id).join()"
    assert await page.js(shown) == "view-map"
    for expected in ("view-graph", "view-camera", "view-agents", "view-map"):
        await page.call("Input.dispatchKeyEvent", type="rawKeyDown", key="ArrowRight", windowsVirtualKeyCode=39)
        assert await page.js(shown) == expected
        assert await page.js("document.activeElement.getAttribute('aria-controls')") == expected
    assert page.complaints == []


@pytest.mark.parametrize("view", ["map", "graph", "camera", "agents", "trace"])
async def test_no_view_is_wider_than_a_phone(page, filmed, view):
    _, address = filmed
    await page.resize(390, 844)
    await page.open(address)
    await page.until(SHOWN)
    await select(page, "bottle_1")
    await show(page, view)
    await page.until(f"{find(f'#view-{view}')}.checkVisibility()")
    assert await page.js("document.documentElement.scrollWidth") <= 390


async def test_what_is_selected_in_the_graph_is_selected_on_the_map_and_told_with_edges_and_past(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await show(page, "graph")
    await page.click(find(".cards [data-id=bottle_1]"))
    assert await page.js(f"{find('.cards [data-id=bottle_1]')}.ariaPressed") == "true"
    assert await page.js(f"{find('.cards [data-id=table_1]')}.classList.contains('near')"), "they share an edge"
    await page.until(f"{find('#map [data-id=bottle_1]')}.classList.contains('selected')")
    await page.until(f"{find('#details')}.innerText.includes('known when this record began')")
    await page.js(f"{find('#details input')}.focus()")
    await page.type("Ada's bottle")
    await page.press("Enter")
    await page.until(f'{find("#details")}.innerText.includes("called Ada\'s bottle")')
    edges = "[...document.querySelectorAll('#details .edges button')]"
    await page.click(f"{edges}.find((e) => e.innerText.includes('table'))")
    assert await page.js(f"{find('#details small')}.textContent") == "table_1"
    await page.until(f"{find('#map [data-id=table_1]')}.classList.contains('selected')")
    assert not await page.js(f"{find('#map [data-id=bottle_1]')}.classList.contains('selected')")
    assert page.complaints == []


async def test_the_graph_nests_things_in_what_carries_them_and_leaves_out_layers_that_are_switched_off(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await show(page, "graph")
    await page.until("document.querySelectorAll('.card[data-room^=room]').length === 3")
    kitchen = ".card[data-room=room_2]"
    table = f"{find(f'{kitchen} [data-id=table_1]')}.closest('li')"
    assert await page.js(f"Boolean({table}.querySelector('ul [data-id=bottle_1]'))")
    doors = "[...document.querySelectorAll('.cards [data-id=door_1_1_0]')].map((e) => e.closest('.card').dataset.room)"
    assert sorted(await page.js(doors)) == ["room_1", "room_2"]
    assert await page.js("document.querySelectorAll('.curve.connects').length") == 3
    await page.click(find(".switch.furniture input"))
    await page.until(f"!{find('.cards [data-id=table_1]')}")
    assert await page.js(f"Boolean({find('.cards [data-id=bottle_1]')})"), "what it carries moves up"
    await page.click(find(".switch.door input"))
    await page.until("!document.querySelector('.curve')")


async def test_what_did_not_change_is_not_drawn_anew(page, address, runtime):
    await page.open(address)
    await page.until(SHOWN)
    pixels = f"{find('#map [data-id=bottle_1]')}.r.baseVal.value * {find('.world')}.getCTM().a"
    await page.until(f"Math.abs({pixels} - 5) < 0.05")  # the scale has settled, and dots have their size on the screen
    others = "[...document.querySelectorAll('#map [data-id]')].filter((e) => e.dataset.id !== 'cup_1')"
    await page.js(f"(window.kept = {others}).length")
    await page.js(f"(window.cup = {find('#map [data-id=cup_1]')}).tagName")
    teach(runtime.memory, "cup_1", label=None, name="my mug", stamp_s=runtime.now_s)
    await page.until(f"{find('#map [data-id=cup_1] title')}.textContent.startsWith('my mug')")
    assert not await page.js("window.cup.isConnected")
    assert await page.js("window.kept.every((element) => element.isConnected)")


async def test_an_ellipse_shows_how_uncertain_the_place_of_what_is_selected_is(page, address, runtime):
    await page.open(address)
    await page.until(SHOWN)
    std_m = next(n for n in runtime.views.scene.document()["nodes"] if n["id"] == "book_2")["position_std_m"]
    await select(page, "book_2")
    await page.until(f"{find('#map [data-id=book_2]')}.classList.contains('selected')")
    axes = "[...document.querySelectorAll('#map .spread')].map((e) => [e.rx, e.ry].map((r) => r.baseVal.value))"
    drawn = await page.js(axes)
    assert any(ellipse == pytest.approx(std_m[:2]) for ellipse in drawn)


async def test_the_camera_covers_what_lies_before_walls_and_behind_open_doors_only(page, filmed):
    _, address = filmed
    await page.open(address)
    await page.until("document.querySelectorAll('#map polygon.gaze').length === 1")
    script = """import('/page/sight.js').then(({ covered }) => {
        const square = (x) => ({ polygon_m: [[x, -2], [x + 4, -2], [x + 4, 2], [x, 2]] });
        const door = (state) => ({ position_m: [2, 0], yaw_rad: Math.PI / 2, width_m: 1, state });
        const camera = { x: 0, y: 0, yaw_rad: 0, width_rad: 1.2, range_m: 5 }, pose = { x: 0, y: 0, yaw_rad: 0 };
        return ['open', 'closed'].map((state) => covered(pose, camera, [square(-2), square(2.2)], [door(state)]));
    })"""
    through, shut = await page.js(script)
    assert max(x for x, _ in shut) == pytest.approx(2.0)
    assert max(x for x, _ in through) == pytest.approx(5.0, abs=1e-3)
    beyond = [abs(y / x) for x, y in through if x > 2.1]
    assert 0.15 < max(beyond) <= 0.25, "no wider than the door lets through"


async def test_a_click_into_the_picture_selects_and_what_cannot_be_clicked_is_listed(page, filmed):
    _, address = filmed
    await page.open(address)
    await page.until(SHOWN)
    await show(page, "camera")
    await page.until("document.querySelectorAll('#camera-view .seen').length === 2")
    await page.until(f"{find('#camera-view figcaption')}.innerText.startsWith('live')")
    labels = await page.js("[...document.querySelectorAll('#camera-view .seen-label')].map((e) => e.textContent)")
    assert sorted(labels) == ["blue bottle", "brown table"], "the wall has none"
    await page.click(find("#camera-view path[data-id=bottle_1]"))
    await page.until(f"{find('#details small')}?.textContent === 'bottle_1'")
    assert await page.js(f"{find('#camera-view path[data-id=bottle_1]')}.classList.contains('selected')")
    listed = await page.js("[...document.querySelectorAll('#camera-seen button')].map((e) => e.innerText)")
    assert sorted(listed) == sorted(labels)
    await page.click("[...document.querySelectorAll('#camera-seen button')].find((e) => e.innerText === 'brown table')")
    await page.until(f"{find('#details small')}.textContent === 'table_1'")
    assert page.complaints == []


async def test_a_picture_that_is_no_longer_new_says_so(page, filmed):
    stack, address = filmed
    await page.open(address)
    await page.until(SHOWN)
    await show(page, "camera")
    await page.until(f"{find('#camera-view figcaption')}.innerText.startsWith('live')")
    stack.rolling = False
    await page.until(f"{find('#camera-view')}.classList.contains('old')")
    assert await page.js(f"{find('#camera-view figcaption')}.innerText.startsWith('not live')")
    stack.rolling = True
    await page.until(f"!{find('#camera-view')}.classList.contains('old')")


async def test_no_picture_is_fetched_while_none_can_be_seen(page, filmed):
    _, address = filmed
    await page.open(address)
    await page.until(SHOWN)
    count = "performance.getEntriesByType('resource').filter(({ name }) => name.includes('/v1/camera')).length"
    await page.until(f"{count} > 1")
    await page.js(f"{find('#side')}.style.display = 'none'")
    rest = "new Promise((done) => setTimeout(done, 1600))"
    await page.js(rest)
    before = await page.js(count)
    await page.js(rest)
    assert await page.js(count) == before
    await show(page, "camera")
    await page.until(f"{count} > {before}")


async def test_agents_and_the_language_model_are_told_of(page, address):
    await page.open(address)
    await page.until(SHOWN)
    await show(page, "agents")
    await page.until(f"{find('#view-agents')}.innerText.includes('none attached')")
    rows = await page.js("[...document.querySelectorAll('#view-agents tbody th')].map((e) => e.textContent)")
    assert "publisher" in rows


async def test_a_request_leads_to_its_nodes_and_to_the_decisions_about_it(page, address, runtime):
    await page.open(address)
    await page.until(SHOWN)
    runtime.orders.submit("bring the blue bottle to the desk")
    await page.click("[...document.querySelectorAll('.task .links button')].find((e) => e.innerText === 'blue bottle')")
    await page.until(f"{find('#details small')}?.textContent === 'bottle_1'")
    await page.click(find(".task .links .why"))
    await page.until(f"{find('#view-trace')}.innerText.includes('GOTO(bottle_1)')")
    kinds = await page.js("[...document.querySelectorAll('.entry b')].map((e) => e.textContent)")
    assert kinds[0] == "received"
    assert "planned" in kinds
    assert await page.js(f"{find('#tab-trace')}.ariaSelected") == "true"
    await page.click("[...document.querySelectorAll('.entry button')].find((e) => e.innerText === 'desk_1')")
    await page.until(f"{find('#details small')}.textContent === 'desk_1'")
    assert page.complaints == []


async def test_labels_have_the_same_size_however_large_the_picture_is(page, filmed):
    stack, address = filmed
    await page.open(address)
    await page.until(SHOWN)
    await page.until("document.querySelectorAll('#camera-view .seen').length === 2")  # still hidden
    stack.rolling = False
    await show(page, "camera")
    await page.until(
        f"Math.abs({find('#camera-view .seen-label text')}?.getAttribute('font-size') "
        f"* {find('#camera-view svg')}.getScreenCTM().a - 12) < 0.5"
    )
