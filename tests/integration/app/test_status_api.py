"""Status, health, metrics and the simulation routes of a service without a robot."""

from __future__ import annotations

import pytest
from prometheus_client.parser import text_string_to_metric_families

pytestmark = pytest.mark.anyio


async def test_the_status_tells_what_the_robot_is_doing(service):
    status = (await service.client.get("/v1/status")).json()
    assert status.keys() >= {"stamp_s", "clock", "exploring", "explored", "task", "stopped", "robot", "agents"}
    assert (status["clock"], status["explored"], status["exploring"]) == ("real", True, False)
    assert (status["task"], status["stopped"], status["language_model"]) == (None, False, None)
    assert status["network"] is None, "a stored graph is not looked at"
    assert (status["robot"]["room"], status["robot"]["holding"]) == ("room_1", None)
    assert status["robot"]["pose_map"] == pytest.approx({"x": 0.0, "y": 0.2, "yaw_rad": 0.6}, abs=1e-3)
    for figures in status["agents"].values():
        assert figures.keys() == {"rate_hz", "busy_ms_p50", "busy_ms_p99", "restarts"}


async def test_the_clock_of_a_stored_graph_goes_on_from_its_stamp(service):
    stamp_s = service.runtime.memory.snapshot().stamp_s
    status = (await service.client.get("/v1/status")).json()
    assert stamp_s < status["stamp_s"] < stamp_s + 60


async def test_health_needs_no_token(service):
    for path, word in {"/healthz": "alive", "/readyz": "ready"}.items():
        response = await service.client.get(path, headers={"Authorization": ""})
        assert (response.status_code, response.json()) == (200, {"status": word})


async def test_metrics_are_prometheus_text(service):
    await service.ask("where is the red apple?")
    response = await service.client.get("/metrics")
    assert response.headers["content-type"].startswith("text/plain")
    families = {family.name: family for family in text_string_to_metric_families(response.text)}
    nodes = {sample.labels["type"]: sample.value for sample in families["majordomo_graph_nodes"].samples}
    assert (nodes["room"], nodes["door"], nodes["person"]) == (3, 3, 1)
    tasks = {sample.labels["status"]: sample.value for sample in families["majordomo_tasks"].samples}
    assert tasks == {"succeeded": 1}
    assert "majordomo_agent_restarts" in families


async def test_the_simulators_truth_is_not_offered_unless_asked_for(service):
    assert (await service.client.get("/v1/simulation/truth")).status_code == 404
    assert (await service.client.post("/v1/simulation/disturb", json={"do": "remove", "id": "x"})).status_code == 404


async def test_without_a_robot_the_simulation_routes_say_so(in_process, settings):
    async with in_process(settings.model_copy(update={"simulation_api": True})) as service:
        answers = [
            await service.client.get("/v1/simulation/truth"),
            await service.client.post("/v1/simulation/disturb", json={"do": "remove", "id": "bottle_1"}),
        ]
        assert [(answer.status_code, answer.json()["code"]) for answer in answers] == [
            (503, "simulator_unavailable")
        ] * 2
        wrong = await service.client.post("/v1/simulation/disturb", json={"do": "explode"})
        assert (wrong.status_code, wrong.json()["code"]) == (422, "invalid_request")


async def test_there_is_no_simulator_to_restart(service):
    response = await service.client.post("/v1/simulation/restart")
    assert (response.status_code, response.json()["code"]) == (409, "not_allowed_now")
