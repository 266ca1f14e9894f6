"""What was decided about a task, when and why: told from one state of its record to the next."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field
from enum import StrEnum
from typing import Any

from planner.tasks.queue import TURNED_DOWN
from planner.tasks.tasks import FailureReport, PlanReport, StepReport, StepStatus, Task, TaskStatus


class DecisionKind(StrEnum):
    """Closed set of what a trace tells."""

    RECEIVED = "received"
    RESTARTED = "restarted"
    MODEL_ASKED = "model_asked"
    MODEL_ANSWERED = "model_answered"
    UNDERSTOOD = "understood"
    ASKED = "asked"
    ANSWERED = "answered"
    REPLANNED = "replanned"
    PLANNED = "planned"
    SHOWN = "shown"
    APPROVED = "approved"
    REJECTED = "rejected"
    STARTED = "started"
    STEP = "step"
    OBSERVED = "observed"
    FAILURE = "failure"
    VERIFIED = "verified"
    PAUSED = "paused"
    RESUMED = "resumed"
    STOPPED = "stopped"
    RELEASED = "released"
    ENDED = "ended"


@dataclass(frozen=True, kw_only=True)
class Decision:
    """One entry of a trace: what was decided or seen, why, and the data behind it (plain JSON)."""

    kind: DecisionKind
    what: str
    why: str = ""
    data: Mapping[str, Any] = field(default_factory=dict)


def decisions_between(before: Task | None, after: Task) -> tuple[Decision, ...]:
    """What was decided from one state of a task to the next; ``before`` is ``None`` for a task that is new."""
    if before is None:
        options = {"approval": after.approval.value, "dry_run": after.dry_run}
        return (Decision(kind=DecisionKind.RECEIVED, what=after.request, data=options),)
    return (
        *_spoken(before, after),
        *_planned(before, after),
        *_failed(before, after),
        *_moved(before, after),
    )


def _spoken(before: Task, after: Task) -> Iterator[Decision]:
    """Questions of the robot and answers of people."""
    for index, (question, answer) in enumerate(after.dialogue):
        known = before.dialogue[index] if index < len(before.dialogue) else None
        if known is None:
            yield Decision(kind=DecisionKind.ASKED, what=question, data={"candidates": list(after.candidates)})
        if answer and (known is None or known[1] != answer):
            yield Decision(kind=DecisionKind.ANSWERED, what=answer, why=f"to the question: {question}")
    if after.approved and not before.approved:
        yield Decision(kind=DecisionKind.APPROVED, what="The plan may run.", why="A person approved it.")


def _planned(before: Task, after: Task) -> Iterator[Decision]:
    """A plan that came into force, and how far its steps came."""
    if after.plan is None:
        return
    if before.plan is None or outline(before.plan) != outline(after.plan) or after.replans > before.replans:
        yield _plan(after.plan, after.replans)
        known: tuple[StepReport, ...] = ()
    else:
        known = before.plan.steps
    for index, step in enumerate(after.plan.steps):
        status = known[index].status if index < len(known) else StepStatus.PENDING
        if step.status is not status:
            yield _step(index, step)


def _plan(plan: PlanReport, replans: int) -> Decision:
    goals = ", ".join(str(goal) for goal in plan.goals)
    why = f"To reach {goals}, read by {plan.source}; proven on revision {plan.revision} of the graph."
    data = {"revision": plan.revision, "source": plan.source, "replans": replans, "steps": list(outline(plan))}
    goals_data = [{"predicate": str(goal.predicate), "args": list(goal.args)} for goal in plan.goals]
    return Decision(
        kind=DecisionKind.PLANNED,
        what=", ".join(outline(plan)) or "nothing has to be done",
        why=why,
        data={**data, "goals": goals_data},
    )


def _step(index: int, step: StepReport) -> Decision:
    data = {"index": index, "step": step.text, "status": step.status.value, "seconds": round(step.seconds, 3)}
    actions = [asdict(action) for action in step.actions]
    told = "begun" if step.status is StepStatus.RUNNING else step.status.value
    return Decision(kind=DecisionKind.STEP, what=f"{step.text} {told}", data={**data, "actions": actions})


def _failed(before: Task, after: Task) -> Iterator[Decision]:
    """Failures with the observations behind them, and what the graph confirms of the goals."""
    for failure in after.failures[len(before.failures) :]:
        yield _failure(failure)
    if after.verified != before.verified:
        told = [f"{verified.goal} {'confirmed' if verified.confirmed else 'open'}" for verified in after.verified]
        data = {"goals": [{"goal": str(v.goal), "confirmed": v.confirmed} for v in after.verified]}
        yield Decision(kind=DecisionKind.VERIFIED, what=", ".join(told), why="By what was seen since.", data=data)


def _failure(failure: FailureReport) -> Decision:
    evidence = failure.evidence
    seen = evidence.observation and f"{evidence.observation} (revision {evidence.revision})"
    where = f"{failure.step}: " if failure.step else ""
    return Decision(
        kind=DecisionKind.FAILURE,
        what=f"{where}{failure.sentence}",
        why=seen,
        data={
            "step": failure.step,
            "code": failure.code,
            "nodes": list(evidence.nodes),
            "revision": evidence.revision,
            "observation": evidence.observation,
            "suggestion": failure.suggestion,
        },
    )


def _moved(before: Task, after: Task) -> Iterator[Decision]:
    """Another status, where it is a decision."""
    if after.status is before.status:
        if after.status.ended and after.explanation != before.explanation:
            yield Decision(kind=DecisionKind.OBSERVED, what=after.explanation)
        return
    was_shown = before.status is TaskStatus.AWAITING_APPROVAL
    revision = {"revision": after.plan.revision} if after.plan is not None else {}
    match after.status:
        case TaskStatus.AWAITING_APPROVAL:
            why = "Nothing moves before a person has approved it."
            yield Decision(kind=DecisionKind.SHOWN, what=after.explanation, why=why, data=revision)
        case TaskStatus.RUNNING if before.status is TaskStatus.PAUSED:
            yield Decision(kind=DecisionKind.RESUMED, what="It goes on.", why="A person said so.")
        case TaskStatus.RUNNING:
            yield Decision(kind=DecisionKind.STARTED, what=after.explanation, data=revision)
        case TaskStatus.PAUSED:
            yield Decision(kind=DecisionKind.PAUSED, what="It waits.", why="A person said so.")
        case TaskStatus.CANCELLED if was_shown and after.explanation == TURNED_DOWN:
            yield Decision(kind=DecisionKind.REJECTED, what="The plan was turned down.", why="A person said so.")
    if after.status.ended:
        yield _ending(after)


def _ending(task: Task) -> Decision:
    data = {"status": task.status.value, "replans": task.replans, "failures": len(task.failures), "kind": task.kind}
    return Decision(
        kind=DecisionKind.ENDED, what=f"{task.status.value}: {task.explanation or task.reply}".rstrip(": "), data=data
    )


def outline(plan: PlanReport) -> tuple[str, ...]:
    """The steps of a plan as people write them."""
    return tuple(step.text for step in plan.steps)
