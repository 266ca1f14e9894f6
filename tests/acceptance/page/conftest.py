"""A headless browser, driven over the DevTools protocol, in front of a service over a stored graph."""

from __future__ import annotations

import asyncio
import base64
import contextlib
import itertools
import json
import shutil
from pathlib import Path

import pytest
import websockets

from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, page_address, serving
from app.settings import Settings
from paths import DATA

GRAPH = DATA / "flat_graph.json"
TOKEN = Token("a-token-only-for-tests")
LIMIT_S = 20.0
KEYS = {"Enter": 13, "Escape": 27, "Tab": 9, "ArrowUp": 38, "ArrowDown": 40}


def pytest_addoption(parser):
    parser.addoption("--pictures", type=Path, help="Folder of the documentation, to renew its pictures of the page.")
    parser.addoption("--explored", type=Path, help="Data folder of a service that has explored the flat.")


@pytest.fixture
def anyio_backend():
    return "asyncio"


class Page:
    """One page of the browser."""

    def __init__(self, socket, session: str) -> None:
        self._socket, self._session = socket, session
        self._numbers = itertools.count(1000)
        self._answers: dict[int, asyncio.Future] = {}
        self.complaints: list[str] = []
        self.trace: list[dict] = []
        self.traced = asyncio.Event()
        self._reading = asyncio.create_task(self._read())

    async def close(self) -> None:
        self._reading.cancel()
        with contextlib.suppress(asyncio.CancelledError):
            await self._reading

    async def call(self, method: str, *, limit_s: float = LIMIT_S, **parameters):
        number = next(self._numbers)
        self._answers[number] = asyncio.get_running_loop().create_future()
        message = {"id": number, "sessionId": self._session, "method": method, "params": parameters}
        await self._socket.send(json.dumps(message))
        async with asyncio.timeout(limit_s):
            return await self._answers[number]

    async def js(self, expression: str, limit_s: float = LIMIT_S):
        """The value of a JavaScript expression."""
        options = {"returnByValue": True, "awaitPromise": True}
        result = await self.call("Runtime.evaluate", limit_s=limit_s, expression=expression, **options)
        assert "exceptionDetails" not in result, result["exceptionDetails"]
        return result["result"].get("value")

    async def until(self, condition: str, limit_s: float = LIMIT_S):
        """Wait until a JavaScript condition holds; its value."""
        watched = f"""new Promise((resolve) => {{
            const value = () => {{ try {{ return {condition}; }} catch (error) {{ return null; }} }};
            const look = () => {{
                const found = value();
                found ? resolve(found instanceof Node || found) : setTimeout(look, 30);
            }};
            setTimeout(() => resolve(null), {1000 * limit_s - 1000});
            look();
        }})"""
        value = await self.js(watched, limit_s)
        assert value, f"it did not happen: {condition}\n{await self.js('document.body.innerText')}"
        return value

    async def resize(self, width: int, height: int, *, dark: bool = False) -> None:
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": width < 600}
        await self.call("Emulation.setDeviceMetricsOverride", **metrics)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        await self.call("Emulation.setEmulatedMedia", features=[scheme])

    async def picture(self) -> bytes:
        """What is in view, as PNG."""
        shot = await self.call("Page.captureScreenshot", format="png")
        return base64.b64decode(shot["data"])

    async def open(self, address: str) -> None:
        await self.call("Page.navigate", url=address)

    async def press(self, key: str) -> None:
        text = {"Enter": "\r", "Tab": ""}.get(key, key if len(key) == 1 else "")
        code = KEYS.get(key, ord(key[0].upper()))
        for kind in ("keyDown" if text else "rawKeyDown", "keyUp"):
            typed = {"text": text} if kind == "keyDown" else {}
            await self.call("Input.dispatchKeyEvent", type=kind, key=key, windowsVirtualKeyCode=code, **typed)

    async def type(self, text: str) -> None:
        await self.call("Input.insertText", text=text)

    async def click(self, finder: str) -> None:
        """Click in the middle of the element that a JavaScript expression finds."""
        await self.until(f"Boolean({finder})")
        await self.js(f"({finder}).scrollIntoView({{ block: 'center' }})")
        x, y = await self.js(
            f"(({{ x, y, width, height }}) => [x + width / 2, y + height / 2])(({finder}).getBoundingClientRect())"
        )
        for kind in ("mousePressed", "mouseReleased"):
            await self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button="left", clickCount=1)

    async def _read(self) -> None:
        async for text in self._socket:
            message = json.loads(text)
            answer = self._answers.pop(message.get("id"), None)
            if answer is not None and not answer.done():
                answer.set_result(message.get("result", message))
            self._listen(message.get("method"), message.get("params", {}))

    def _listen(self, method: str | None, parameters) -> None:
        """Keep what the page complains about."""
        match method:
            case "Tracing.dataCollected":
                self.trace += parameters["value"]
            case "Tracing.tracingComplete":
                self.traced.set()
            case "Runtime.exceptionThrown":
                self.complaints.append(parameters["exceptionDetails"].get("exception", {}).get("description", "?"))
            case "Runtime.consoleAPICalled" if parameters["type"] in {"error", "warning", "assert"}:
                self.complaints.append(str(parameters["args"]))
            case "Log.entryAdded" if parameters["entry"]["level"] in {"error", "warning"}:
                self.complaints.append(parameters["entry"]["text"])


@contextlib.asynccontextmanager
async def browser(binary: str, profile: Path):
    """The address at which a headless browser listens."""
    flags = ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-background-networking", "--no-first-run"]
    process = await asyncio.create_subprocess_exec(
        binary,
        *flags,
        f"--user-data-dir={profile}",
        "--remote-debugging-port=0",
        "about:blank",
        stderr=asyncio.subprocess.PIPE,
        stdout=asyncio.subprocess.DEVNULL,
    )
    try:
        async with asyncio.timeout(LIMIT_S):
            while "DevTools listening on " not in (line := (await process.stderr.readline()).decode()):
                assert line, "the browser did not start"
        yield line.split("DevTools listening on ")[1].strip()
    finally:
        process.kill()
        await process.communicate()


@pytest.fixture
async def page(tmp_path):
    """An empty page, 1440 × 900 and light; at the end it must not have complained."""
    binary = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if binary is None:
        pytest.skip("no browser is here; to install: chromium (apt-get install chromium), for the tests of the page")
    async with browser(binary, tmp_path / "profile") as address, websockets.connect(address, max_size=None) as socket:
        target = await _command(socket, 1, "Target.createTarget", url="about:blank")
        attached = await _command(socket, 2, "Target.attachToTarget", targetId=target["targetId"], flatten=True)
        page = Page(socket, attached["sessionId"])
        for domain in ("Page", "Runtime", "Log"):
            await page.call(f"{domain}.enable")
        await page.resize(1440, 900)
        yield page
        await page.close()


async def _command(socket, number: int, method: str, **parameters):
    await socket.send(json.dumps({"id": number, "method": method, "params": parameters}))
    while (message := json.loads(await socket.recv())).get("id") != number:
        pass
    return message["result"]


@pytest.fixture
async def runtime(tmp_path):
    return Runtime(Settings(graph=GRAPH, data=tmp_path, port=0))


@pytest.fixture
async def address(runtime):
    """The page's address, with its token, while it is served."""
    with bind(runtime.settings) as listener:
        async with serving(runtime, listener, TOKEN):
            yield page_address(listener, TOKEN)
