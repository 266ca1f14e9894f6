"""The tasks on disk: what was acknowledged is there after a crash, and what was under way is said to be cut off.

Beside every task stands what was decided about it, when and why: its trace.
"""

from __future__ import annotations

import json
import logging
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Self

from pydantic import TypeAdapter, ValidationError

from app.journal.decisions import Decision, DecisionKind, decisions_between
from app.journal.file import JournalFile
from app.journal.trace import read_trace
from app.persistence.building import building_folder
from app.settings import JOURNAL_BYTES, Settings
from client.documents import Trace
from planner.tasks.queue import KEEP
from planner.tasks.tasks import FailureReport, PlanReport, StepStatus, Task, TaskStatus, TaskTimes

logger = logging.getLogger(__name__)

INTERRUPTED = "interrupted"
"""Code of the failure of what was under way; no skill fails so."""
JOURNAL_FILE = "tasks.sqlite3"
_DROPPED_AT_ONCE = 100
"""So many entries go together, so that not every new one has to look for an old one."""
_ROW_BYTES = 100
"""What an entry takes beside its texts, about."""
_TASK = TypeAdapter(Task)
_ENDED_AS = {StepStatus.RUNNING: StepStatus.FAILED, StepStatus.PENDING: StepStatus.SKIPPED}


class TaskJournal:
    """Every task in its newest state and every decision about it, written before anybody is told.

    A process that is killed loses nothing that was written: a task and the decisions that led to its state are
    kept together or not at all. Of ended tasks the newest ``KEEP`` stay; traces stay up to ``max_bytes`` in all:
    beyond, the oldest entries go, and the trace says how many.
    """

    def __init__(
        self, file: JournalFile, *, max_bytes: int = JOURNAL_BYTES, wall_time: Callable[[], float] = time.time
    ) -> None:
        """``wall_time``: seconds since 1970."""
        self._file, self._max_bytes, self._wall_time = file, max_bytes, wall_time
        self._bytes = int(file.connection.execute("SELECT coalesce(sum(bytes), 0) FROM decisions").fetchone()[0])

    @classmethod
    def of(cls, settings: Settings) -> Self:
        """The journal of a service with its building; of one that remembers nothing, it ends with the process.

        Raises:
            HouseError: there is no such house.
            OSError: another service uses it, or it cannot be written.
        """
        if not settings.remember or settings.graph is not None:
            return cls(JournalFile.in_memory(), max_bytes=min(settings.journal_bytes, JOURNAL_BYTES // 4))
        folder = building_folder(settings.data_folder, settings.house, settings.robot)
        return cls.open(folder / JOURNAL_FILE, max_bytes=settings.journal_bytes)

    @classmethod
    def open(cls, file: Path, *, max_bytes: int = JOURNAL_BYTES) -> Self:
        """Open or begin a journal; no other process can use it until it is closed.

        Raises:
            OSError: another service uses it, or it cannot be written.
        """
        return cls(JournalFile.open(file), max_bytes=max_bytes)

    def take_up(self) -> list[Task]:
        """All tasks, oldest first, as they are now that a new process goes on with them; that is written down too.

        Unreadable ones are left out.
        """
        found: list[Task] = []
        for task_id, document in self._file.connection.execute("SELECT id, document FROM tasks ORDER BY number"):
            try:
                found.append(_TASK.validate_json(document))
            except (ValidationError, ValueError) as problem:
                logger.warning("%s cannot be read and is left out: %s", task_id, str(problem).splitlines()[0])
        return [self._taken_up(task) for task in found]

    def write(self, task: Task, decisions: Sequence[Decision] = (), *, stamp_s: float = 0.0) -> None:
        """Keep a task as it is now, what led there, and of the ended tasks the newest."""
        number = int(task.id.rpartition("_")[2])
        with self._file.transaction() as connection:
            connection.execute(
                "INSERT INTO tasks (number, id, ended, document) VALUES (?, ?, ?, ?) "
                "ON CONFLICT (number) DO UPDATE SET ended = excluded.ended, document = excluded.document",
                (number, task.id, task.status.ended, _TASK.dump_json(task)),
            )
            connection.execute("DELETE FROM tasks WHERE ended AND number <= ?", (number - KEEP,))
            self._note(task.id, decisions, stamp_s)

    def note(self, task_id: str, decisions: Iterable[Decision], *, stamp_s: float) -> None:
        """Keep decisions about a task whose record did not change."""
        with self._file.transaction():
            self._note(task_id, decisions, stamp_s)

    def trace(self, task_id: str, *, after: int = 0, limit: int | None = None) -> Trace | None:
        """What was decided about a task since entry ``after``, oldest first; ``None`` if nothing is known of it."""
        return read_trace(self._file.connection, task_id, after=after, limit=limit)

    def close(self) -> None:
        """Let go of the file."""
        self._file.close()

    def _taken_up(self, before: Task) -> Task:
        """The task as a new process goes on with it, with what that changed in its trace."""
        task = taken_up(before)
        if task != before:
            begun_anew = Decision(
                kind=DecisionKind.RESTARTED,
                what="The service began anew.",
                why=f"An earlier process ended while this was {before.status.value.replace('_', ' ')}.",
            )
            self.write(task, (begun_anew, *decisions_between(before, task)))
        return task

    def _note(self, task_id: str, decisions: Iterable[Decision], stamp_s: float) -> None:
        at_s = self._wall_time()
        for decision in decisions:
            data = json.dumps(decision.data, ensure_ascii=False, separators=(",", ":"), default=str)
            size = len(decision.what) + len(decision.why) + len(data) + _ROW_BYTES
            row = (task_id, stamp_s, at_s, decision.kind.value, decision.what, decision.why, data, size)
            self._file.connection.execute(
                "INSERT INTO decisions (task, stamp_s, at_s, kind, what, why, data, bytes) "
                "VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
                row,
            )
            self._bytes += size
        while self._bytes > self._max_bytes and self._drop_oldest():
            pass

    def _drop_oldest(self) -> bool:
        """Forget the oldest entries, and remember how many of which task; whether there were any."""
        connection = self._file.connection
        oldest = connection.execute(
            "SELECT seq, task, bytes FROM decisions ORDER BY seq LIMIT ?", (_DROPPED_AT_ONCE,)
        ).fetchall()
        for _, task_id, size in oldest:
            self._bytes -= size
            connection.execute(
                "INSERT INTO dropped (task, decisions) VALUES (?, 1) "
                "ON CONFLICT (task) DO UPDATE SET decisions = decisions + 1",
                (task_id,),
            )
        if oldest:
            connection.execute("DELETE FROM decisions WHERE seq <= ?", (oldest[-1][0],))
            logger.info("the journal is full; the oldest %d entries were dropped", len(oldest))
        return bool(oldest)


def taken_up(task: Task) -> Task:
    """A task of an earlier process, as a new one goes on with it.

    Who waits in the queue or for a person goes on waiting, from the beginning of the new robot clock; what was being
    carried out has failed, and says after which step. What the world is like by now has to be looked at, so it is
    not simply gone on with.
    """
    if task.status.ended:
        return task
    waiting = replace(task, times=TaskTimes(received_s=0.0))
    if task.status is TaskStatus.PLANNING:
        return replace(waiting, status=TaskStatus.QUEUED)
    if task.status not in (TaskStatus.RUNNING, TaskStatus.PAUSED):
        return waiting
    failure = FailureReport(step=_step_under_way(task), code=INTERRUPTED, message="I was switched off.")
    again = "Ask for it again if it is still wanted: I have to look first how things are now."
    return replace(
        task,
        status=TaskStatus.FAILED,
        failures=(*task.failures, failure),
        explanation=f"I was switched off {_how_far(task)}. {again}",
        plan=_cut_off(task),
    )


def _cut_off(task: Task) -> PlanReport | None:
    """The plan with what was under way failed, and what had not begun left out."""
    if task.plan is None:
        return None
    steps = tuple(
        replace(
            step,
            status=_ENDED_AS.get(step.status, step.status),
            actions=tuple(
                replace(action, status=_ENDED_AS.get(action.status, action.status)) for action in step.actions
            ),
        )
        for step in task.plan.steps
    )
    return replace(task.plan, steps=steps)


def _step_under_way(task: Task) -> str:
    steps = task.plan.steps if task.plan is not None else ()
    return next((step.text for step in steps if step.status is StepStatus.RUNNING), "")


def _how_far(task: Task) -> str:
    steps = task.plan.steps if task.plan is not None else ()
    done = sum(step.status is StepStatus.SUCCEEDED for step in steps)
    return f"after {done} of {len(steps)} steps" if done else "before any step was done"
