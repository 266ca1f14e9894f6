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


async def scraped(service):
    """Samples by name: labels, as sorted pairs, to value."""
    response = await service.client.get("/metrics")
    assert response.headers["content-type"].startswith("text/plain")
    samples: dict[str, dict] = {}
    for family in text_string_to_metric_families(response.text):
        assert family.documentation or family.name.startswith("process_")
        for sample in family.samples:
            samples.setdefault(sample.name, {})[tuple(sorted(sample.labels.items()))] = sample.value
    return samples


async def test_metrics_tell_how_graph_agents_and_queue_stand(service):
    await service.ask("where is the red apple?")
    await service.ask("bring the cup to the bench")
    samples = await scraped(service)
    nodes = samples["majordomo_graph_nodes"]
    assert (nodes[("type", "room"),], nodes[("type", "door"),], nodes[("type", "person"),]) == (3, 3, 1)
    snapshot = service.runtime.memory.snapshot()
    assert sum(samples["majordomo_graph_edges"].values()) == len(snapshot.edges)
    assert samples["majordomo_graph_loaded"][("what", "nodes"),] == len(snapshot.nodes)
    assert samples["majordomo_graph_revision"][()] == snapshot.revision
    assert samples["majordomo_tasks"] == {(("status", "succeeded"),): 1, (("status", "awaiting_answer"),): 1}
    assert samples["majordomo_queue_waiting"][()] == 0
    assert samples["majordomo_agent_restarts"][("agent", "mission"),] == 0
    assert (samples["majordomo_ready"][()], samples["majordomo_stopped"][()]) == (1, 0)
    assert samples["process_resident_memory_bytes"][()] > 1e6


async def test_metrics_count_what_became_of_tasks_plans_calls_and_stops(service):
    await service.ask("where is the red apple?")
    await service.ask("bring the blue bottle to the desk")
    await service.ask("fold the laundry")
    await service.client.get("/v1/tasks/task_99")
    await service.client.get("/v1/status", headers={"Authorization": ""})
    await service.client.post("/v1/stop")
    samples = await scraped(service)
    assert samples["majordomo_tasks_ended_total"] == {(("status", "succeeded"),): 2, (("status", "refused"),): 1}
    assert samples["majordomo_plans_total"] == {(("source", "grammar"),): 1}
    assert samples["majordomo_stops_total"][()] == 1
    calls = samples["majordomo_http_requests_total"]
    assert calls[("method", "POST"), ("route", "/v1/tasks"), ("status", "202")] == 3
    assert calls[("method", "GET"), ("route", "/v1/tasks/{task_id}"), ("status", "404")] == 1
    assert calls[("method", "GET"), ("route", "none"), ("status", "401")] == 1
    assert samples["majordomo_http_seconds_count"][("route", "/v1/tasks"),] == 3


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
