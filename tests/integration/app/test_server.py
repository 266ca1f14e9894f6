"""Starting and ending the service: addresses, refusals to start, and what is left behind."""

from __future__ import annotations

import json
import os
import signal
import stat
import subprocess
import sys

import httpx
import pytest

from app.errors import RefusedToBind
from app.http.guards.security import Token
from app.runtime import Runtime
from app.server import bind, check_exposure, page_address, serving
from app.settings import Settings
from scene_graph.errors import SceneFormatError

pytestmark = pytest.mark.anyio


def test_a_taken_port_is_refused_with_its_address(settings):
    with bind(settings) as listener:
        port = listener.getsockname()[1]
        with pytest.raises(RefusedToBind, match=rf"127\.0\.0\.1:{port}"):
            bind(settings.model_copy(update={"port": port}))


def test_the_address_of_the_page_can_be_opened_also_over_ipv6():
    token = Token("0123456789abcdef")
    with bind(Settings(host="::1", port=0)) as listener:
        port = listener.getsockname()[1]
        assert page_address(listener, token) == f"http://[::1]:{port}/?token=0123456789abcdef"


def test_other_addresses_need_a_token():
    check_exposure(Settings(host="0.0.0.0"), has_token=True)
    with pytest.raises(RefusedToBind):
        check_exposure(Settings(host="0.0.0.0"), has_token=False)


@pytest.mark.parametrize(
    ("text", "error"), [("{", SceneFormatError), ('{"nodes": [{"type": "room"}]}', SceneFormatError), (None, OSError)]
)
async def test_a_graph_that_cannot_be_read_ends_the_start_with_its_own_error(settings, token, text, error):
    graph = settings.data / "graph.json"
    if text is not None:
        graph.write_text(text)
    runtime = Runtime(settings.model_copy(update={"graph": graph}))
    with bind(settings) as listener, pytest.raises(error):
        async with serving(runtime, listener, Token(token)):
            pass


@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM])
def test_a_served_graph_announces_itself_answers_and_leaves_nothing_behind(settings, ending):
    arguments = ["serve", "--graph", str(settings.graph), "--port", "0", "--data", str(settings.data)]
    command = [sys.executable, "-c", "from app.commands.main import main; main()", *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        address = process.stdout.readline().strip()
        announced = settings.data / "service.json"
        assert stat.S_IMODE(announced.stat().st_mode) == 0o600
        assert json.loads(announced.read_text())["pid"] == process.pid
        with httpx.Client(base_url=address.partition("/?")[0]) as client:
            assert client.get("/readyz").status_code == 200
            assert client.get("/v1/status", params={"token": address.partition("token=")[2]}).status_code == 200
        os.kill(process.pid, ending)
        process.wait(20)
        assert "Traceback" not in process.stderr.read()
    assert not announced.exists()
