"""Keeps the trace of every task: hears of tasks and of what the planner decides, and writes it into the journal."""

from __future__ import annotations

import logging
import sqlite3
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any

from app.journal.decisions import Decision, DecisionKind, decisions_between
from app.journal.redaction import Redactor
from app.journal.tasks import TaskJournal
from planner.tasks.queue import KEEP
from planner.tasks.tasks import Task, TaskStatus

logger = logging.getLogger(__name__)

UNDER_WAY = (TaskStatus.RUNNING, TaskStatus.PAUSED)


class NotKept(RuntimeError):
    """A new task cannot be written to the journal, and so is not taken."""


class Audit:
    """Hears what happens, and keeps what was decided.

    Args:
        journal: where it is kept.
        tasks: those that the journal has already.
        redactor: takes secrets out of what is kept.
    """

    def __init__(self, journal: TaskJournal, tasks: Sequence[Task] = (), *, redactor: Redactor) -> None:
        self._journal, self._redactor = journal, redactor
        self._known = {task.id: task for task in tasks if not task.status.ended}

    def hear_task(self, task: Task, stamp_s: float) -> None:
        """Keep a task that is new or changed, together with what led there.

        When a change cannot be written, the next one is told from what was written last, so that nothing is missing
        once the disk takes it again.

        Raises:
            NotKept: a new task cannot be written, and so must not be acknowledged.
        """
        before = self._known.get(task.id)
        decisions = [self._redacted(decision) for decision in decisions_between(before, task)]
        try:
            self._journal.write(task, decisions, stamp_s=stamp_s)
        except sqlite3.Error as problem:
            logger.critical("%s could not be written to the journal: %s", task.id, problem)
            if before is None:
                raise NotKept(f"I cannot write down what you ask for, so I do not take it on: {problem}") from problem
            return
        self._known[task.id] = task
        self._forget_ended()

    def hear_event(self, stamp_s: float, kind: str, data: Mapping[str, Any]) -> None:
        """Keep what an event of the planner says about a task; other events pass."""
        if kind in ("stop", "resume"):
            for task in self._known.values():
                if task.status in UNDER_WAY:
                    self._note(task.id, (_STOPPED if kind == "stop" else _RELEASED,), stamp_s)
        elif kind in ("mission", "model") and (task_id := data.get("task")):
            decision = decision_of(data)
            if decision is not None:
                self._note(task_id, (decision,), stamp_s)

    def _forget_ended(self) -> None:
        """Of ended tasks nothing is awaited but a last word; the oldest go."""
        if len(self._known) > 2 * KEEP:
            ended = [task_id for task_id, task in self._known.items() if task.status.ended]
            for task_id in ended[:-KEEP]:
                del self._known[task_id]

    def _note(self, task_id: str, decisions: Sequence[Decision], stamp_s: float) -> None:
        redacted = [self._redacted(decision) for decision in decisions]
        try:
            self._journal.note(task_id, redacted, stamp_s=stamp_s)
        except sqlite3.Error as problem:
            logger.critical("the trace of %s lacks what could not be written: %s", task_id, problem)

    def _redacted(self, decision: Decision) -> Decision:
        clean = self._redactor
        return replace(
            decision, what=clean.text(decision.what), why=clean.text(decision.why), data=clean.data(decision.data)
        )


_STOPPED = Decision(kind=DecisionKind.STOPPED, what="The robot stopped.", why="A person stopped it.")
_RELEASED = Decision(kind=DecisionKind.RELEASED, what="The robot may move again.", why="A person released the stop.")


def decision_of(event: Mapping[str, Any]) -> Decision | None:
    """What an event of the planner or of a language model decides; ``None`` for what a task's record tells as well."""
    match event.get("event"):
        case "understood":
            goals = ", ".join(event["goals"])
            what = f"{event['kind']}: {goals or event['reply']}"
            why = f"Read by {event['source']}."
            data = {key: event[key] for key in ("kind", "source", "goals", "reply")}
            return Decision(kind=DecisionKind.UNDERSTOOD, what=what, why=why, data=data)
        case "observed":
            data = {key: event[key] for key in ("step", "revision", "nodes")}
            why = f"{event['seen']} (revision {event['revision']})"
            return Decision(kind=DecisionKind.OBSERVED, what=f"{event['step']} is confirmed", why=why, data=data)
        case "replan":
            return Decision(
                kind=DecisionKind.REPLANNED, what="A new plan is needed.", why=f"Because of: {event['why']}."
            )
        case "model_prompt":
            what = f"{event['model']}, round {event['round']}"
            return Decision(
                kind=DecisionKind.MODEL_ASKED,
                what=what,
                why="The grammar could not read the whole request.",
                data={"model": event["model"], "round": event["round"], "messages": event["messages"]},
            )
        case "model_answer":
            failure = f"{event['failure']}: {event['message']}" if "failure" in event else ""
            data = {key: value for key, value in event.items() if key not in ("event", "task")}
            return Decision(kind=DecisionKind.MODEL_ANSWERED, what=event["text"] or failure, why=failure, data=data)
        case _:
            return None
