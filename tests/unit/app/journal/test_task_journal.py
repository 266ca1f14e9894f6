"""What of the tasks outlives a process."""

from __future__ import annotations

import signal
import sqlite3
import subprocess
import sys
from contextlib import closing
from dataclasses import replace

import pytest

from app.journal.file import MIGRATIONS, SCHEMA
from app.journal.tasks import INTERRUPTED, TaskJournal, taken_up
from planner.forecast import Forecast
from planner.goals import Goal, Predicate
from planner.tasks.queue import KEEP, TaskQueue
from planner.tasks.tasks import (
    ActionReport,
    FailureReport,
    PlanReport,
    StepReport,
    StepStatus,
    Task,
    TaskStatus,
    TaskTimes,
    VerifiedGoal,
)
from skills.failures import Evidence

GOAL = Goal(predicate=Predicate.ON, args=("bottle_1", "desk_1"))
STEPS = (
    StepReport(skill="GOTO", args=("table_1",), status=StepStatus.SUCCEEDED, seconds=3.5),
    StepReport(
        skill="PICK",
        args=("bottle_1",),
        status=StepStatus.RUNNING,
        actions=(
            ActionReport(name="reach", status=StepStatus.SUCCEEDED),
            ActionReport(name="close", status=StepStatus.RUNNING),
        ),
    ),
    StepReport(skill="GOTO", args=("desk_1",)),
)


def task_in(status, number=1):
    return Task(
        id=f"task_{number}",
        request="bring the bottle\nto the «desk» ✓",
        times=TaskTimes(received_s=41.0, planned_s=42.5),
        status=status,
        kind="plan",
        reply="I will.",
        candidates=("bottle_1", "bottle_2"),
        dialogue=(("Which one?", "the blue one"),),
        plan=PlanReport(
            source="grammar",
            revision=7,
            goals=(GOAL,),
            steps=STEPS,
            expected_s=64.5,
            expected_m=11.2,
            changes=Forecast(added=(GOAL,)),
        ),
        key="sent by a client",
        failures=(FailureReport(step="GOTO(x)", code="timeout", message="late", evidence=Evidence(nodes=("x",))),),
        verified=(VerifiedGoal(goal=GOAL, confirmed=True),),
    )


@pytest.mark.parametrize("status", [status for status in TaskStatus if status.ended])
def test_an_ended_task_comes_back_as_it_was(tmp_path, status):
    journal = TaskJournal.open(tmp_path / "tasks.sqlite3")
    journal.write(task_in(TaskStatus.QUEUED))
    journal.write(task_in(status))
    journal.close()
    assert TaskJournal.open(tmp_path / "tasks.sqlite3").take_up() == [task_in(status)]


@pytest.mark.parametrize(
    ("before", "after"),
    [
        (TaskStatus.QUEUED, TaskStatus.QUEUED),
        (TaskStatus.PLANNING, TaskStatus.QUEUED),
        (TaskStatus.AWAITING_ANSWER, TaskStatus.AWAITING_ANSWER),
        (TaskStatus.AWAITING_APPROVAL, TaskStatus.AWAITING_APPROVAL),
    ],
)
def test_who_waits_goes_on_waiting(before, after):
    task = taken_up(task_in(before))
    assert (task.status, task.dialogue, task.times) == (after, task_in(before).dialogue, TaskTimes(received_s=0.0))


@pytest.mark.parametrize("status", [TaskStatus.RUNNING, TaskStatus.PAUSED])
def test_what_was_under_way_has_failed_and_says_after_which_step(status):
    task = taken_up(task_in(status))
    assert task.status is TaskStatus.FAILED
    assert (task.failures[-1].code, task.failures[-1].step) == (INTERRUPTED, "PICK(bottle_1)")
    assert task.explanation.startswith("I was switched off after 1 of 3 steps. Ask for it again")
    assert [step.status for step in task.plan.steps] == [StepStatus.SUCCEEDED, StepStatus.FAILED, StepStatus.SKIPPED]
    assert [action.status for action in task.plan.steps[1].actions] == [StepStatus.SUCCEEDED, StepStatus.FAILED]


def test_before_any_step_was_done_it_says_so():
    plan = PlanReport(source="grammar", revision=7, goals=(GOAL,), steps=(replace(STEPS[1]),))
    assert "before any step was done" in taken_up(replace(task_in(TaskStatus.RUNNING), plan=plan)).explanation
    assert "before any step was done" in taken_up(replace(task_in(TaskStatus.RUNNING), plan=None)).explanation


def test_numbers_go_on_where_they_were(tmp_path):
    journal = TaskJournal.open(tmp_path / "tasks.sqlite3")
    for number in (1, 2, 9):
        journal.write(task_in(TaskStatus.SUCCEEDED, number))
    assert TaskQueue(journal.take_up()).submit("go on", stamp_s=0.0).id == "task_10"


def test_of_ended_tasks_the_newest_stay_and_of_open_ones_all(tmp_path):
    journal = TaskJournal.open(tmp_path / "tasks.sqlite3")
    journal.write(task_in(TaskStatus.AWAITING_ANSWER, 1))
    for number in range(2, KEEP + 5):
        journal.write(task_in(TaskStatus.SUCCEEDED, number))
    kept = [task.id for task in journal.take_up()]
    assert (kept[0], kept[1], len(kept)) == ("task_1", "task_5", KEEP + 1)


@pytest.mark.parametrize("damage", [b"this is no database at all" * 99, b""])
def test_a_damaged_file_is_set_aside_and_reported(tmp_path, caplog, damage):
    file = tmp_path / "tasks.sqlite3"
    journal = TaskJournal.open(file)
    journal.write(task_in(TaskStatus.SUCCEEDED))
    journal.close()
    file.write_bytes(damage)
    journal = TaskJournal.open(file)
    assert journal.take_up() == []
    journal.write(task_in(TaskStatus.SUCCEEDED, 2))
    assert [task.id for task in journal.take_up()] == ["task_2"]
    aside = tmp_path / "tasks.sqlite3.damaged-1"
    assert aside.exists() == bool(damage)
    assert ("set aside" in caplog.text) == bool(damage)
    assert not damage or aside.read_bytes() == damage


def test_a_file_of_a_later_version_is_not_touched(tmp_path, caplog):
    file = tmp_path / "tasks.sqlite3"
    TaskJournal.open(file).close()
    with sqlite3.connect(file) as connection:
        connection.execute("PRAGMA user_version = 99")
    connection.close()
    assert TaskJournal.open(file).take_up() == []
    assert "version 99" in caplog.text


def test_a_file_of_every_earlier_version_is_brought_to_this_one_with_all_its_tasks(tmp_path):
    current = tmp_path / "current.sqlite3"
    with closing(TaskJournal.open(current)) as journal:
        journal.write(task_in(TaskStatus.SUCCEEDED))
    document = column(current, "SELECT document FROM tasks")
    assert list(MIGRATIONS) == list(range(1, SCHEMA + 1))
    for version in range(1, SCHEMA):
        file = tmp_path / f"of_{version}.sqlite3"
        with closing(sqlite3.connect(file)) as older, older:
            for step in range(1, version + 1):
                for statement in MIGRATIONS[step]:
                    older.execute(statement)
            older.execute("INSERT INTO tasks VALUES (7, 'task_7', 1, ?)", (document.replace(b"task_1", b"task_7"),))
            older.execute(f"PRAGMA user_version = {version}")
        with closing(TaskJournal.open(file)) as journal:
            assert journal.take_up() == [replace(task_in(TaskStatus.SUCCEEDED), id="task_7")]
            journal.write(task_in(TaskStatus.SUCCEEDED, 8))
            assert journal.trace("task_7") is not None
        assert column(file, "PRAGMA user_version") == SCHEMA
        assert schema(file) == schema(current)
    assert not list(tmp_path.glob("*.damaged-*"))


def column(file, query):
    with closing(sqlite3.connect(file)) as connection:
        return connection.execute(query).fetchone()[0]


def schema(file):
    with closing(sqlite3.connect(file)) as connection:
        return sorted(connection.execute("SELECT name, sql FROM sqlite_master WHERE sql IS NOT NULL"))


def test_a_task_that_cannot_be_read_takes_no_other_with_it(tmp_path, caplog):
    file = tmp_path / "tasks.sqlite3"
    journal = TaskJournal.open(file)
    for number in (1, 2):
        journal.write(task_in(TaskStatus.SUCCEEDED, number))
    journal.close()
    with sqlite3.connect(file) as connection:
        connection.execute("UPDATE tasks SET document = ? WHERE id = 'task_1'", (b'{"status": "lost"}',))
    connection.close()
    assert [task.id for task in TaskJournal.open(file).take_up()] == ["task_2"]
    assert "task_1 cannot be read" in caplog.text


def test_two_services_do_not_write_into_one_journal(tmp_path):
    file = tmp_path / "tasks.sqlite3"
    journal = TaskJournal.open(file)
    journal.write(task_in(TaskStatus.SUCCEEDED))
    with pytest.raises(OSError, match="another --data"):
        TaskJournal.open(file)
    journal.close()
    assert [task.id for task in TaskJournal.open(file).take_up()] == ["task_1"]
    assert [path.name for path in tmp_path.iterdir() if "damaged" in path.name] == []


WRITER = """
import sys
from pathlib import Path
from app.journal.tasks import TaskJournal
from planner.tasks.queue import KEEP, TaskQueue
journal = TaskJournal.open(Path(sys.argv[1]))
queue = TaskQueue(journal.take_up())
queue.listen(journal.write)
while True:
    print(queue.submit("go to the kitchen", stamp_s=0.0).id, flush=True)
"""


def test_a_killed_process_loses_no_task_that_it_acknowledged(tmp_path):
    file, acknowledged = tmp_path / "tasks.sqlite3", []
    for _ in range(5):
        process = subprocess.Popen([sys.executable, "-c", WRITER, str(file)], stdout=subprocess.PIPE, text=True)
        acknowledged += [process.stdout.readline().strip() for _ in range(7)]
        process.send_signal(signal.SIGKILL)
        rest, _ = process.communicate()
        acknowledged += [line for line in rest.splitlines(keepends=True) if line.endswith("\n")]
    kept = [task.id for task in TaskJournal.open(file).take_up()]
    assert {line.strip() for line in acknowledged} <= set(kept)
    assert len(kept) == len(set(kept))
