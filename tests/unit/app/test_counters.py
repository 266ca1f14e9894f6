"""What is counted of tasks as they change, and of a model's answers."""

from __future__ import annotations

from dataclasses import replace

import pytest
from prometheus_client.parser import text_string_to_metric_families

from app.counters import CountedModel, Counters
from planner.goals import goal
from planner.models.protocol import FailureKind, ModelFailure, ModelReply, ModelRequest
from planner.tasks.tasks import FailureReport, PlanReport, StepReport, StepStatus, Task, TaskStatus, TaskTimes

pytestmark = pytest.mark.anyio
GOALS = (goal("on", "cup_1", "table_1"),)


@pytest.fixture
def anyio_backend():
    return "asyncio"


def counted(counters):
    """Value by name and labels' values."""
    families = text_string_to_metric_families(counters.text().decode())
    return {
        (sample.name, *sample.labels.values()): sample.value
        for family in families
        for sample in family.samples
        if sample.name.startswith("majordomo_") and not sample.name.endswith(("_created", "_bucket"))
    }


def plan(*statuses, revision=1):
    steps = tuple(
        StepReport(skill=skill, args=("cup_1",), status=status, seconds=4.0)
        for skill, status in zip(("GOTO", "PICK"), statuses, strict=True)
    )
    return PlanReport(source="grammar", revision=revision, goals=GOALS, steps=steps)


async def test_a_task_that_replans_is_counted_step_by_step_and_each_thing_once():
    counters = Counters()
    pending, running, done, failed = (StepStatus(s) for s in ("pending", "running", "succeeded", "failed"))
    task = Task(id="task_1", request="x", times=TaskTimes(received_s=1.0))
    counters.task(task)
    task = replace(task, status=TaskStatus.PLANNING, plan=plan(pending, pending))
    counters.task(task)
    task = task.to(TaskStatus.RUNNING, stamp_s=2.0)
    for steps in ((running, pending), (done, pending), (done, running), (done, failed)):
        task = replace(task, plan=plan(*steps))
        counters.task(task)
    task = replace(task, failures=(FailureReport(step="PICK(cup_1)", code="slipped", message="It slipped."),))
    counters.task(task)
    task = replace(task, replans=1, plan=plan(pending, pending, revision=9))
    for steps in ((pending, pending), (done, pending), (done, done)):
        task = replace(task, plan=plan(*steps, revision=9))
        counters.task(task)
    counters.task(task.to(TaskStatus.SUCCEEDED, stamp_s=32.0))
    found = counted(counters)
    assert found["majordomo_plans_total", "grammar"] == 2
    assert found["majordomo_replans_total",] == 1
    assert found["majordomo_failures_total", "slipped"] == 1
    assert found["majordomo_steps_total", "GOTO", "succeeded"] == 2
    assert found["majordomo_steps_total", "PICK", "failed"] == 1
    assert found["majordomo_steps_total", "PICK", "succeeded"] == 1
    assert found["majordomo_step_seconds_sum", "GOTO"] == 8.0
    assert found["majordomo_tasks_ended_total", "succeeded"] == 1
    assert found["majordomo_task_seconds_sum", "succeeded"] == 30.0


async def test_a_models_answers_are_counted_by_outcome_with_their_tokens_and_handed_on():
    outcomes = [
        ModelReply(data={}, text="{}", prompt_tokens=100, completion_tokens=7),
        ModelFailure(kind=FailureKind.TIMEOUT, message="late"),
    ]

    class Model:
        name = "scripted"

        async def complete(self, request, deadline_s):
            return outcomes[deadline_s]

    counters = Counters()
    model = CountedModel(Model(), counters)
    request = ModelRequest(messages=(), schema={})
    assert [await model.complete(request, number) for number in (0, 1)] == outcomes
    assert model.name == "scripted"
    found = counted(counters)
    assert (found["majordomo_model_answers_total", "reply"], found["majordomo_model_answers_total", "timeout"]) == (
        1,
        1,
    )
    assert (found["majordomo_model_tokens_total", "prompt"], found["majordomo_model_tokens_total", "completion"]) == (
        100,
        7,
    )
    assert found["majordomo_model_seconds_count",] == 2


async def test_methods_that_nobody_knows_are_counted_as_one():
    counters = Counters()
    for method in ("GET", "BREW", "WHEN"):
        counters.call(method, "none", 405, 0.001)
    found = counted(counters)
    assert (
        found["majordomo_http_requests_total", "other", "none", "405"],
        found["majordomo_http_seconds_count", "none"],
    ) == (2, 3)
