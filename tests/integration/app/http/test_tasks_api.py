"""Requests over HTTP: submitting, following, deciding, and every way to do it wrong."""

from __future__ import annotations

import pytest

pytestmark = pytest.mark.anyio

FIELDS = {"id", "request", "status", "kind", "reply", "plan", "replans", "failures", "explanation", "times"}


async def refused(response, status, code):
    assert response.status_code == status, response.text
    assert response.headers["content-type"] == "application/problem+json"
    problem = response.json()
    assert (problem["status"], problem["code"]) == (status, code)
    assert problem["detail"]
    assert "Traceback" not in response.text
    return problem


async def test_a_submitted_request_is_accepted_with_its_location_and_document(service):
    response = await service.client.post("/v1/tasks", json={"request": " bring the blue bottle to the desk "})
    assert response.status_code == 202
    task = response.json()
    assert task.keys() >= FIELDS
    assert task["request"] == "bring the blue bottle to the desk"
    assert task["status"] == "queued"
    shown = await service.client.get(response.headers["location"])
    assert shown.json()["id"] == task["id"]


async def test_a_request_on_a_stored_graph_ends_with_its_plan(service):
    task = await service.ask("bring the blue bottle to the desk")
    assert (task["status"], task["kind"]) == ("succeeded", "plan")
    assert task["plan"]["goals"] == [{"predicate": "on", "args": ["bottle_1", "desk_1"]}]
    steps = [(step["skill"], step["args"]) for step in task["plan"]["steps"]]
    assert steps == [
        ("GOTO", ["bottle_1"]),
        ("PICK", ["bottle_1"]),
        ("GOTO", ["desk_1"]),
        ("PLACE", ["bottle_1", "desk_1"]),
    ]
    assert {"status", "actions", "seconds"} <= task["plan"]["steps"][0].keys()
    assert task["plan"]["revision"] == service.runtime.memory.snapshot().revision


async def test_a_question_is_answered_and_what_cannot_be_done_is_refused(service):
    answered, declined = await service.ask("where is the red apple?"), await service.ask("fold the laundry")
    assert (answered["status"], answered["kind"]) == ("succeeded", "answer")
    assert "bowl" in answered["reply"]
    assert (declined["status"], declined["kind"]) == ("refused", "refuse")


async def test_two_candidates_are_offered_and_the_answer_chooses_one(service):
    task = await service.ask("bring the cup to the bench")
    assert task["status"] == "awaiting_answer"
    assert sorted(task["candidates"]) == ["cup_1", "cup_2"]
    response = await service.client.post(f"/v1/tasks/{task['id']}/answer", json={"answer": "cup_2"})
    assert response.status_code == 200
    task = await service.settled(task["id"])
    assert task["status"] == "succeeded"
    assert task["plan"]["goals"] == [{"predicate": "on", "args": ["cup_2", "bench_1"]}]


async def test_the_same_idempotency_key_makes_one_task_and_another_body_under_it_is_refused(service):
    headers, body = {"Idempotency-Key": "one"}, {"request": "what do you see?"}
    first = await service.client.post("/v1/tasks", json=body, headers=headers)
    again = await service.client.post("/v1/tasks", json=body, headers=headers)
    assert (again.status_code, again.json()["id"]) == (202, first.json()["id"])
    assert again.headers["location"] == first.headers["location"]
    other = await service.client.post("/v1/tasks", json={"request": "go to the kitchen"}, headers=headers)
    await refused(other, 409, "idempotency_key_reused")
    assert (await service.client.get("/v1/tasks")).json()["total"] == 1


async def test_tasks_are_listed_newest_first_in_pages(service):
    for number in range(5):
        await service.client.post("/v1/tasks", json={"request": f"where is bottle {number}?"})
    page = (await service.client.get("/v1/tasks", params={"limit": 2, "offset": 1})).json()
    assert ([task["id"] for task in page["tasks"]], page["total"]) == (["task_4", "task_3"], 5)
    assert (await service.client.get("/v1/tasks", params={"offset": 9})).json()["tasks"] == []
    for wrong in ({"limit": 0}, {"limit": 201}, {"offset": -1}, {"limit": "many"}):
        await refused(await service.client.get("/v1/tasks", params=wrong), 422, "invalid_request")


async def test_what_does_not_fit_a_tasks_status_is_a_conflict_that_says_what_does(service):
    ended = await service.ask("where is the red apple?")
    for operation in ("approve", "reject", "pause", "resume", "cancel"):
        await refused(await service.client.post(f"/v1/tasks/{ended['id']}/{operation}"), 409, "not_allowed_now")
    await refused(
        await service.client.post(f"/v1/tasks/{ended['id']}/answer", json={"answer": "yes"}), 409, "not_allowed_now"
    )
    waiting = await service.ask("bring the cup to the bench")
    problem = await refused(await service.client.post(f"/v1/tasks/{waiting['id']}/pause"), 409, "not_allowed_now")
    assert "answer" in problem["detail"]
    assert "cancel" in problem["detail"]


async def test_a_waiting_task_can_be_cancelled_and_does_not_hold_up_others(service):
    waiting = await service.ask("bring the cup to the bench")
    assert (await service.ask("where is the red apple?"))["status"] == "succeeded"
    cancelled = (await service.client.post(f"/v1/tasks/{waiting['id']}/cancel")).json()
    assert cancelled["status"] == "cancelled"
    assert cancelled["times"]["ended_s"] >= cancelled["times"]["received_s"]


async def test_an_unknown_task_is_not_found_whatever_is_wanted_of_it(service):
    await refused(await service.client.get("/v1/tasks/task_99"), 404, "task_not_found")
    for operation in ("approve", "reject", "pause", "resume", "cancel"):
        await refused(await service.client.post(f"/v1/tasks/task_99/{operation}"), 404, "task_not_found")
    await refused(await service.client.post("/v1/tasks/task_99/answer", json={"answer": "x"}), 404, "task_not_found")
    await refused(await service.client.post("/v1/tasks/task_99/explode"), 404, "not_found")


@pytest.mark.parametrize(
    "body",
    [
        {},
        {"request": ""},
        {"request": " \n\t "},
        {"request": None},
        {"request": 7},
        {"request": ["go"]},
        {"request": "x" * 10_001},
        {"request": "go to the kitchen", "approval": "maybe"},
        {"request": "go to the kitchen", "dry_run": "perhaps"},
        {"request": "go to the kitchen", "urgent": True},
        [],
        "go to the kitchen",
        None,
    ],
)
async def test_a_malformed_request_is_refused_and_names_its_field(service, body):
    problem = await refused(await service.client.post("/v1/tasks", json=body), 422, "invalid_request")
    assert problem["fields"][0]["field"]
    assert (await service.client.get("/v1/tasks")).json()["total"] == 0


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (" \n ", "The request is empty. Please say in plain words what you want."),
        (
            "x" * 10_001,
            "The request has 10001 characters, and I read at most 10000. Please say it in fewer words.",
        ),
    ],
)
async def test_words_that_cannot_be_taken_are_refused_in_a_sentence(service, words, said):
    problem = await refused(await service.client.post("/v1/tasks", json={"request": words}), 422, "invalid_request")
    assert problem["detail"] == said
    assert problem["fields"] == [{"field": "request", "message": said}]


async def test_the_documentation_tells_how_long_a_request_may_be(service):
    documents = (await service.client.get("/openapi.json")).json()["components"]["schemas"]
    for text in (documents["TaskRequest"]["properties"]["request"], documents["Answer"]["properties"]["answer"]):
        assert (text["type"], text["minLength"], text["maxLength"]) == ("string", 1, 10_000)


@pytest.mark.parametrize(
    "content", [b"", b"{", b'{"request": "go"', b"\xff\xfe", b'{"request": "\\ud800"}', b"[" * 30_000, b"\x00"]
)
async def test_bytes_that_are_not_json_text_are_refused(service, content):
    headers = {"Content-Type": "application/json"}
    response = await service.client.post("/v1/tasks", content=content, headers=headers)
    assert response.status_code in {400, 422}
    await refused(response, response.status_code, "invalid_request")


async def test_broken_json_is_told_where_it_breaks(service):
    headers = {"Content-Type": "application/json"}
    response = await service.client.post("/v1/tasks", content=b'{"request": }', headers=headers)
    assert "character 12" in (await refused(response, 422, "invalid_request"))["detail"]


async def test_the_longest_request_is_taken_and_a_megabyte_is_not(service):
    longest = await service.ask("go " * 3000 + "x" * 1000)
    assert longest["status"] in {"refused", "awaiting_answer"}
    too_large = await service.client.post("/v1/tasks", json={"request": "x" * 1_000_000})
    await refused(too_large, 413, "request_too_large")
    assert (await service.ask("where is the red apple?"))["status"] == "succeeded"


@pytest.mark.parametrize(
    "words",
    [
        "😀😀😀",
        "привет, робот",
        "' OR 1=1; --",
        "<script>alert(1)</script>",
        "bring \u202ethe bottle",
        "a\x00b",
        "{{scene}} %s {0}",
        "\ufeffgo to the kitchen",
    ],
)
async def test_strange_words_end_in_a_reply_and_leave_the_service_well(service, words):
    task = await service.ask(words)
    assert task["status"] in {"succeeded", "refused", "awaiting_answer"}
    assert task["reply"] or task["explanation"]
    status = (await service.client.get("/v1/status")).json()
    assert status["agents"]["mission"]["restarts"] == 0


async def test_an_empty_or_overlong_answer_is_refused_and_the_question_stays_open(service):
    task = await service.ask("bring the cup to the bench")
    for answer in ({}, {"answer": ""}, {"answer": "x" * 10_001}, {"answer": "cup_1", "sure": True}):
        response = await service.client.post(f"/v1/tasks/{task['id']}/answer", json=answer)
        await refused(response, 422, "invalid_request")
    assert (await service.client.get(f"/v1/tasks/{task['id']}")).json()["status"] == "awaiting_answer"


async def test_stop_is_latched_until_it_is_released(service):
    assert (await service.client.post("/v1/stop")).json() == {"stopped": True}
    assert (await service.client.post("/v1/stop")).json() == {"stopped": True}
    assert (await service.client.get("/v1/status")).json()["stopped"] is True
    assert (await service.client.post("/v1/resume")).json() == {"stopped": False}
    assert (await service.client.get("/v1/status")).json()["stopped"] is False


async def test_a_dry_run_tells_what_it_would_take_and_change_and_changes_nothing(service):
    revision = service.runtime.memory.snapshot().revision
    task = await service.ask("bring the blue bottle to the desk", dry_run=True)
    assert (task["status"], task["dry_run"]) == ("succeeded", True)
    plan = task["plan"]
    way = (await service.client.get("/v1/scene/path", params={"from": "bottle_1", "to": "desk_1"})).json()
    assert plan["expected_m"] >= way["length_m"]
    assert plan["expected_s"] > plan["expected_m"]
    assert plan["changes"] == {
        "added": [{"predicate": "on", "args": ["bottle_1", "desk_1"]}, {"predicate": "robot_at", "args": ["room_3"]}],
        "removed": [
            {"predicate": "on", "args": ["bottle_1", "table_1"]},
            {"predicate": "robot_at", "args": ["room_1"]},
        ],
    }
    assert service.runtime.memory.snapshot().revision == revision


async def test_the_next_page_is_right_although_tasks_were_added_meanwhile(service):
    for number in range(5):
        await service.client.post("/v1/tasks", json={"request": f"where is bottle {number}?"})
    seen, following = [], "/v1/tasks?limit=2"
    while following is not None:
        response = await service.client.get(following)
        seen += [task["id"] for task in response.json()["tasks"]]
        following = response.json()["next"]
        assert (f'<{following}>; rel="next"' == response.headers.get("link")) is (following is not None)
        await service.client.post("/v1/tasks", json={"request": "where is the cup?"})
    assert seen == ["task_5", "task_4", "task_3", "task_2", "task_1"]


async def test_tasks_are_listed_by_status(service):
    await service.ask("where is the red apple?")
    waiting = await service.ask("bring the cup to the bench")
    listed = (await service.client.get("/v1/tasks", params={"status": "awaiting_answer"})).json()
    assert ([task["id"] for task in listed["tasks"]], listed["total"]) == ([waiting["id"]], 1)
    both = (
        await service.client.get("/v1/tasks", params={"status": ["awaiting_answer", "succeeded"], "limit": 1})
    ).json()
    assert (both["total"], len(both["tasks"])) == (2, 1)
    assert "status=awaiting_answer&status=succeeded" in both["next"]
    await refused(await service.client.get("/v1/tasks", params={"status": "lost"}), 422, "invalid_request")


async def test_a_request_that_is_sent_again_after_it_ended_is_still_the_same(service):
    headers, body = {"Idempotency-Key": "a b"}, {"request": "where is the red apple?"}
    first = (await service.client.post("/v1/tasks", json=body, headers=headers)).json()
    await service.settled(first["id"])
    again = (await service.client.post("/v1/tasks", json=body, headers=headers)).json()
    assert (again["id"], again["status"]) == (first["id"], "succeeded")
    assert "key" not in again
    for wrong in ("", " ", "x" * 201):
        response = await service.client.post("/v1/tasks", json=body, headers={"Idempotency-Key": wrong})
        await refused(response, 422, "invalid_request")


async def test_a_queue_that_is_full_takes_no_more_but_stops(service, monkeypatch):
    monkeypatch.setattr("planner.tasks.queue.MOST_OPEN", 2)
    for _ in range(2):
        await service.ask("bring the cup to the bench")
    response = await service.client.post("/v1/tasks", json={"request": "go to the kitchen"})
    await refused(response, 429, "queue_full")
    assert int(response.headers["retry-after"]) > 0
    assert (await service.ask("stop"))["status"] == "succeeded"
    assert (await service.client.get("/v1/status")).json()["stopped"]
