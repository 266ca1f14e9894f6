"""What is secret stays so: tokens and keys are neither in the log nor in any answer."""

from __future__ import annotations

import pytest
from websockets.sync.client import connect

from paths import DATA
from service_process import serving, wait_until

GRAPH = DATA / "flat_graph.json"
KEY = "sk-a-key/that+nobody/may-see"
SETTLED = {"succeeded", "failed", "refused", "awaiting_answer"}


@pytest.mark.slow
def test_neither_the_log_nor_any_answer_holds_a_token_or_the_models_key(tmp_path, monkeypatch):
    monkeypatch.setenv("MAJORDOMO_LLM_KEY", KEY)
    monkeypatch.setenv("MAJORDOMO_LLM_URL", "http://127.0.0.1:9/v1")
    with serving(tmp_path, "--graph", str(GRAPH), "--llm", "openai:nobody", "--verbose") as service:
        address, _, token = service.page.partition("/?token=")
        viewer = (tmp_path / "viewer-token").read_text(encoding="ascii").strip()
        task = service.client.post("/v1/tasks", json={"request": "kindly vacuum whatever seems dusty"}).json()
        told = []
        wait_until(lambda: service.client.get(f"/v1/tasks/{task['id']}").json()["status"] in SETTLED, 60.0)
        for path in ("/v1/tasks", "/v1/status", "/metrics", "/v1/scene", "/openapi.json", "/"):
            told.append(service.client.get(path, params={"token": token}).text)
            told.append(service.client.get(path, params={"token": f"{viewer}x"}, headers={"Authorization": ""}).text)
        with connect(f"{address.replace('http', 'ws', 1)}/v1/stream?token={token}") as socket:
            told.append(socket.recv(10.0))
        with connect(f"{address.replace('http', 'ws', 1)}/v1/stream?token={viewer}") as socket:
            told.append(socket.recv(10.0))
    log = (tmp_path / "stderr.log").read_text(encoding="utf-8")
    assert log, "a log that is empty proves nothing"
    for secret in (token, viewer, KEY):
        assert secret not in log
        assert not any(secret in text for text in told)
