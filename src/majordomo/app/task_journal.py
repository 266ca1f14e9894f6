"""The tasks on disk: what was acknowledged is there after a crash, and what was under way is said to be cut off."""

from __future__ import annotations

import logging
import sqlite3
from dataclasses import replace
from pathlib import Path
from typing import Self

from pydantic import TypeAdapter, ValidationError

from majordomo.app.remembering import building_folder
from majordomo.app.settings import Settings
from majordomo.planner.queue import KEEP
from majordomo.planner.tasks import FailureReport, PlanReport, StepStatus, Task, TaskStatus, TaskTimes

logger = logging.getLogger(__name__)

SCHEMA = 1
"""Of the file; another is set aside, since nobody knows yet what it would hold."""
INTERRUPTED = "interrupted"
"""Code of the failure of what was under way; no skill fails so."""
_TASK = TypeAdapter(Task)
_ENDED_AS = {StepStatus.RUNNING: StepStatus.FAILED, StepStatus.PENDING: StepStatus.SKIPPED}


class TaskJournal:
    """Every task in its newest state, in a SQLite file (write-ahead log), written before anybody is told.

    A process that is killed loses nothing that was written. A file that is damaged, or of another version, is set aside
    under a name of its own and reported. Of ended tasks the newest ``KEEP`` stay.
    """

    def __init__(self, connection: sqlite3.Connection) -> None:
        self._connection = connection

    @classmethod
    def of(cls, settings: Settings) -> Self | None:
        """The journal of a service with its building, ``None`` for one that remembers nothing.

        Raises:
            HouseError: there is no such house.
            OSError: another service uses it, or it cannot be written.
        """
        if not settings.remember or settings.graph is not None:
            return None
        return cls.open(building_folder(settings.data_folder, settings.house) / "tasks.sqlite3")

    @classmethod
    def open(cls, file: Path) -> Self:
        """Open or begin a journal; no other process can use it until it is closed.

        Raises:
            OSError: another service uses it, or it cannot be written.
        """
        file.parent.mkdir(parents=True, exist_ok=True)
        try:
            return cls(_connected(file))
        except sqlite3.OperationalError as problem:
            advice = "stop the other service, or give this one another --data" if "locked" in str(problem) else ""
            raise OSError(f"the journal of tasks {file} cannot be used: {problem}; {advice}".rstrip("; ")) from problem
        except sqlite3.DatabaseError as problem:
            aside = _set_aside(file)
            logger.warning("the journal of tasks is damaged (%s); it was set aside as %s", problem, aside.name)
            return cls(_connected(file))

    def tasks(self) -> list[Task]:
        """All tasks, oldest first, as they are now that a new process takes them up; unreadable ones are left out."""
        found: list[Task] = []
        for task_id, document in self._connection.execute("SELECT id, document FROM tasks ORDER BY number"):
            try:
                found.append(taken_up(_TASK.validate_json(document)))
            except (ValidationError, ValueError) as problem:
                logger.warning("%s cannot be read and is left out: %s", task_id, str(problem).splitlines()[0])
        return found

    def write(self, task: Task) -> None:
        """Keep a task as it is now, and of the ended ones the newest."""
        number = int(task.id.rpartition("_")[2])
        with self._connection:
            self._connection.execute(
                "INSERT INTO tasks (number, id, ended, document) VALUES (?, ?, ?, ?) "
                "ON CONFLICT (number) DO UPDATE SET ended = excluded.ended, document = excluded.document",
                (number, task.id, task.status.ended, _TASK.dump_json(task)),
            )
            self._connection.execute("DELETE FROM tasks WHERE ended AND number <= ?", (number - KEEP,))

    def close(self) -> None:
        """Let go of the file."""
        self._connection.close()


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


def _connected(file: Path) -> sqlite3.Connection:
    connection = sqlite3.connect(file, timeout=1.0, check_same_thread=False)
    try:
        _prepare(connection)
    except sqlite3.DatabaseError:
        connection.close()
        raise
    return connection


def _prepare(connection: sqlite3.Connection) -> None:
    """Check the file, and make its table if it is new.

    Raises:
        sqlite3.DatabaseError: it is damaged, no database, or of another version.
    """
    connection.execute("PRAGMA locking_mode = EXCLUSIVE")
    (verdict,) = connection.execute("PRAGMA quick_check(1)").fetchone()
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    if verdict != "ok":
        raise sqlite3.DatabaseError(str(verdict))
    if version not in (0, SCHEMA):
        raise sqlite3.DatabaseError(f"it is of version {version}, and this program writes version {SCHEMA}")
    connection.execute("PRAGMA journal_mode = WAL")
    connection.execute("PRAGMA synchronous = NORMAL")
    with connection:
        connection.execute(
            "CREATE TABLE IF NOT EXISTS tasks ("
            "number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, ended INTEGER NOT NULL, document BLOB NOT NULL)"
        )
        connection.execute(f"PRAGMA user_version = {SCHEMA}")


def _set_aside(file: Path) -> Path:
    """Rename a file and what belongs to it, under the first free number."""
    number = next(n for n in range(1, 1_000_000) if not file.with_name(f"{file.name}.damaged-{n}").exists())
    aside = file.with_name(f"{file.name}.damaged-{number}")
    for suffix in ("", "-wal", "-shm"):
        part = file.with_name(file.name + suffix)
        if part.exists():
            part.rename(aside.with_name(aside.name + suffix))
    return aside
