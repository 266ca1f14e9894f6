"""The record of one request, from its words to its outcome (design, sections 8 and 9), and its status' legal moves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass, replace
from enum import StrEnum
from types import MappingProxyType
from typing import Any

from planner.errors import IllegalTransition
from planner.forecast import NO_CHANGES, Forecast
from planner.goals import Goal
from planner.plan import Offer, Plan
from planner.tasks.approval import Approval
from skills.failures import Evidence

NO_EVIDENCE = Evidence()


class TaskStatus(StrEnum):
    """Closed set of a task's states; the value is what the API shows."""

    QUEUED = "queued"
    PLANNING = "planning"
    AWAITING_ANSWER = "awaiting_answer"
    AWAITING_APPROVAL = "awaiting_approval"
    RUNNING = "running"
    PAUSED = "paused"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    CANCELLED = "cancelled"
    REFUSED = "refused"

    @property
    def ended(self) -> bool:
        """Whether nothing can happen to the task any more."""
        return not TRANSITIONS[self]


TRANSITIONS: Mapping[TaskStatus, frozenset[TaskStatus]] = MappingProxyType(
    {
        TaskStatus.QUEUED: frozenset({TaskStatus.PLANNING, TaskStatus.CANCELLED}),
        TaskStatus.PLANNING: frozenset(
            {
                TaskStatus.QUEUED,
                TaskStatus.AWAITING_ANSWER,
                TaskStatus.AWAITING_APPROVAL,
                TaskStatus.RUNNING,
                TaskStatus.SUCCEEDED,
                TaskStatus.FAILED,
                TaskStatus.CANCELLED,
                TaskStatus.REFUSED,
            }
        ),
        TaskStatus.AWAITING_ANSWER: frozenset({TaskStatus.QUEUED, TaskStatus.CANCELLED}),
        TaskStatus.AWAITING_APPROVAL: frozenset({TaskStatus.QUEUED, TaskStatus.CANCELLED}),
        TaskStatus.RUNNING: frozenset(
            {TaskStatus.PLANNING, TaskStatus.PAUSED, TaskStatus.SUCCEEDED, TaskStatus.FAILED, TaskStatus.CANCELLED}
        ),
        TaskStatus.PAUSED: frozenset({TaskStatus.RUNNING, TaskStatus.CANCELLED}),
        TaskStatus.SUCCEEDED: frozenset(),
        TaskStatus.FAILED: frozenset(),
        TaskStatus.CANCELLED: frozenset(),
        TaskStatus.REFUSED: frozenset(),
    }
)


class StepStatus(StrEnum):
    """Where a step or an action of it stands."""

    PENDING = "pending"
    RUNNING = "running"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    SKIPPED = "skipped"


@dataclass(frozen=True, kw_only=True)
class ActionReport:
    """One action of a step, as far as it came."""

    name: str
    status: StepStatus = StepStatus.PENDING


@dataclass(frozen=True, kw_only=True)
class StepReport:
    """One step of the plan in force. ``seconds``: time spent acting and confirming; pauses and stops do not count."""

    skill: str
    args: tuple[str, ...]
    status: StepStatus = StepStatus.PENDING
    actions: tuple[ActionReport, ...] = ()
    seconds: float = 0.0

    @property
    def text(self) -> str:
        """The step as people write it: ``PICK(bottle_1)``."""
        return f"{self.skill}({', '.join(self.args)})"


@dataclass(frozen=True, kw_only=True)
class PlanReport:
    """The plan in force: where it came from, the graph revision it was made on, its goals and steps.

    ``expected_s``, ``expected_m``: estimated time, and way. ``changes``: to the graph, at its end.
    """

    source: str
    revision: int
    goals: tuple[Goal, ...]
    steps: tuple[StepReport, ...]
    expected_s: float = 0.0
    expected_m: float = 0.0
    changes: Forecast = NO_CHANGES

    @classmethod
    def of(cls, plan: Plan, goals: tuple[Goal, ...], steps: tuple[StepReport, ...] | None = None) -> PlanReport:
        """The record of ``plan``, made for ``goals``; none of its steps has begun unless ``steps`` say otherwise."""
        if steps is None:
            steps = tuple(StepReport(skill=step.skill, args=step.args) for step in plan.steps)
        return cls(
            source=plan.source.value,
            revision=plan.revision,
            goals=goals,
            steps=steps,
            expected_s=plan.expected_s,
            expected_m=plan.expected_m,
            changes=plan.changes,
        )


@dataclass(frozen=True, kw_only=True)
class FailureReport:
    """One failure on the way: the step, what happened, on what evidence, and what the robot tries next."""

    step: str
    code: str
    message: str
    evidence: Evidence = NO_EVIDENCE
    suggestion: str = ""

    @property
    def sentence(self) -> str:
        """What happened and what comes next, to be said aloud."""
        return f"{self.message} {self.suggestion}".strip()


@dataclass(frozen=True, kw_only=True)
class VerifiedGoal:
    """A goal and whether the graph confirms it, by an observation newer than the last action that touched it."""

    goal: Goal
    confirmed: bool


@dataclass(frozen=True, kw_only=True)
class TaskTimes:
    """Robot times in seconds: request received, plan made, first action, end; ``None`` until it happens."""

    received_s: float
    planned_s: float | None = None
    started_s: float | None = None
    ended_s: float | None = None


@dataclass(frozen=True, kw_only=True)
class Task:
    """One request and everything that became of it.

    ``dialogue``: what the robot asked and what was answered, as (question, answer) pairs, the last answer ``""`` while
    open; ``offers``: what each question gave to choose from. ``candidates``: those while an answer is awaited.
    ``key``: what the client called the request, so that it can send it again without asking for it twice.
    """

    id: str
    request: str
    times: TaskTimes
    status: TaskStatus = TaskStatus.QUEUED
    approval: Approval = Approval.AUTO
    dry_run: bool = False
    approved: bool = False
    kind: str | None = None
    reply: str = ""
    candidates: tuple[str, ...] = ()
    dialogue: tuple[tuple[str, str], ...] = ()
    offers: tuple[Offer, ...] = ()
    plan: PlanReport | None = None
    replans: int = 0
    failures: tuple[FailureReport, ...] = ()
    verified: tuple[VerifiedGoal, ...] = ()
    explanation: str = ""
    key: str | None = None

    def to(self, status: TaskStatus, *, stamp_s: float, **changes: Any) -> Task:
        """This task in another status, with its times kept.

        Raises:
            IllegalTransition: listing what is allowed from here.
        """
        allowed = TRANSITIONS[self.status]
        if status not in allowed:
            raise IllegalTransition(self.id, self.status.value, status.value, tuple(sorted(allowed)))
        times = self.times
        if status is TaskStatus.RUNNING and times.started_s is None:
            times = replace(times, started_s=stamp_s)
        if status.ended:
            times = replace(times, ended_s=stamp_s)
        return replace(self, **{"status": status, "times": times, **changes})

    def document(self) -> dict[str, Any]:
        """The task as the API shows it (design, section 9)."""
        fields = asdict(self)
        del fields["key"], fields["offers"]
        fields["plan"] = _plan_document(self.plan) if self.plan is not None else None
        fields["verified"] = [{**_goal_document(v.goal), "confirmed": v.confirmed} for v in self.verified]
        fields["dialogue"] = [{"question": question, "answer": answer} for question, answer in self.dialogue]
        return fields


def _plan_document(plan: PlanReport) -> dict[str, Any]:
    steps = [asdict(step) | {"seconds": round(step.seconds, 3)} for step in plan.steps]
    goals = [_goal_document(goal) for goal in plan.goals]
    return {
        "source": plan.source,
        "revision": plan.revision,
        "goals": goals,
        "steps": steps,
        "expected_s": round(plan.expected_s, 1),
        "expected_m": round(plan.expected_m, 2),
        "changes": {
            "added": [_goal_document(fact) for fact in plan.changes.added],
            "removed": [_goal_document(fact) for fact in plan.changes.removed],
        },
    }


def _goal_document(goal: Goal) -> dict[str, Any]:
    return {"predicate": str(goal.predicate), "args": list(goal.args)}
