"""Counters and durations since the service began: what becomes of tasks, plans and steps, and what a model answers."""

from __future__ import annotations

import time

from prometheus_client import CollectorRegistry, Counter, Histogram, ProcessCollector, generate_latest

from planner.models.protocol import LanguageModel, ModelFailure, ModelReply, ModelRequest
from planner.tasks.tasks import StepReport, StepStatus, Task

TASK_BUCKETS_S = (5, 15, 30, 60, 120, 300, 600, 1800)
STEP_BUCKETS_S = (1, 2, 5, 10, 20, 40, 80, 160)
MODEL_BUCKETS_S = (0.25, 0.5, 1, 2, 4, 8, 16, 32, 64)
CALL_BUCKETS_S = (0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1, 5)
METHODS = frozenset({"GET", "POST", "PATCH", "HEAD", "OPTIONS"})
_STEP_ENDED = frozenset({StepStatus.SUCCEEDED, StepStatus.FAILED, StepStatus.SKIPPED})


class Counters:
    """What is counted while the service runs. Names are stable; every name begins with ``majordomo_``."""

    def __init__(self) -> None:
        self._registry = registry = CollectorRegistry()
        ProcessCollector(registry=registry)
        self._open: dict[str, Task] = {}
        self._ended = Counter("majordomo_tasks_ended", "Tasks that ended", ["status"], registry=registry)
        self._task_s = Histogram(
            "majordomo_task_seconds",
            "Robot time from a task's first action to its end",
            ["status"],
            buckets=TASK_BUCKETS_S,
            registry=registry,
        )
        self._plans = Counter("majordomo_plans", "Plans made, by who named the goals", ["source"], registry=registry)
        self._replans = Counter("majordomo_replans", "Plans made because another failed", registry=registry)
        self._failures = Counter("majordomo_failures", "Failures on the way", ["code"], registry=registry)
        self._steps = Counter("majordomo_steps", "Steps that ended", ["skill", "status"], registry=registry)
        self._step_s = Histogram(
            "majordomo_step_seconds",
            "Robot time spent on a step",
            ["skill"],
            buckets=STEP_BUCKETS_S,
            registry=registry,
        )
        self._stops = Counter("majordomo_stops", "Times that a person stopped the robot", registry=registry)
        self._answers = Counter("majordomo_model_answers", "Answers of the model", ["outcome"], registry=registry)
        self._model_s = Histogram(
            "majordomo_model_seconds", "Wall time of an answer", buckets=MODEL_BUCKETS_S, registry=registry
        )
        self._tokens = Counter("majordomo_model_tokens", "Tokens read and written", ["direction"], registry=registry)
        self._calls = Counter("majordomo_http_requests", "Calls", ["method", "route", "status"], registry=registry)
        self._call_s = Histogram(
            "majordomo_http_seconds", "Wall time of a call", ["route"], buckets=CALL_BUCKETS_S, registry=registry
        )

    def text(self) -> bytes:
        """Prometheus text of all that was counted, and of the process."""
        return generate_latest(self._registry)

    def stopped(self) -> None:
        """A person stopped the robot."""
        self._stops.inc()

    def call(self, method: str, route: str, status: int, seconds: float) -> None:
        """A call of the HTTP interface was answered."""
        self._calls.labels(method if method in METHODS else "other", route, str(status)).inc()
        self._call_s.labels(route).observe(seconds)

    def answer(self, outcome: ModelReply | ModelFailure, seconds: float) -> None:
        """The language model has answered, or failed to."""
        self._model_s.observe(seconds)
        if isinstance(outcome, ModelFailure):
            self._answers.labels(outcome.kind.value).inc()
            return
        self._answers.labels("reply").inc()
        self._tokens.labels("prompt").inc(outcome.prompt_tokens)
        self._tokens.labels("completion").inc(outcome.completion_tokens)

    def task(self, task: Task) -> None:
        """A task is new or has changed."""
        before = self._open.pop(task.id, None)
        self._count_plans(task, before)
        for failure in task.failures[len(before.failures) if before is not None else 0 :]:
            self._failures.labels(failure.code).inc()
        for step in _ended_steps(task, before):
            self._steps.labels(step.skill, step.status.value).inc()
            self._step_s.labels(step.skill).observe(step.seconds)
        if not task.status.ended:
            self._open[task.id] = task
            return
        self._ended.labels(task.status.value).inc()
        if task.times.started_s is not None and task.times.ended_s is not None:
            self._task_s.labels(task.status.value).observe(task.times.ended_s - task.times.started_s)

    def _count_plans(self, task: Task, before: Task | None) -> None:
        replans = task.replans - (before.replans if before is not None else 0)
        anew = task.plan is not None and (before is None or before.plan is None)
        if task.plan is not None and (anew or replans > 0):
            self._plans.labels(task.plan.source).inc()
        if replans > 0:
            self._replans.inc(replans)


class CountedModel:
    """A language model whose answers are counted."""

    def __init__(self, model: LanguageModel, counters: Counters) -> None:
        self._model, self._counters = model, counters

    @property
    def name(self) -> str:
        """As the model's own."""
        return self._model.name

    async def complete(self, request: ModelRequest, deadline_s: float) -> ModelReply | ModelFailure:
        """The model's answer."""
        began = time.perf_counter()
        outcome = await self._model.complete(request, deadline_s)
        self._counters.answer(outcome, time.perf_counter() - began)
        return outcome


def _ended_steps(task: Task, before: Task | None) -> list[StepReport]:
    """The steps of the plan in force that have ended since ``before``."""
    steps = task.plan.steps if task.plan is not None else ()
    same_plan = before is not None and before.plan is not None and before.replans == task.replans
    earlier = before.plan.steps if same_plan and before is not None and before.plan is not None else ()
    known = [step.status in _STEP_ENDED for step in earlier] + [False] * len(steps)
    return [step for step, ended in zip(steps, known, strict=False) if step.status in _STEP_ENDED and not ended]
