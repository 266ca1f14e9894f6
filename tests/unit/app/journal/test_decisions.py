"""What a trace tells: every decision about a task once, with its reason, and no secret."""

from __future__ import annotations

import json
import sqlite3
from dataclasses import replace

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.journal import file as journal_file
from app.journal.audit import Audit, NotKept
from app.journal.decisions import Decision, DecisionKind, decisions_between, outline
from app.journal.file import JournalFile, JournalSettings
from app.journal.redaction import LONGEST, Redactor
from app.journal.tasks import TaskJournal
from app.journal.trace import stored_traces
from planner.goals import Goal, Predicate
from planner.tasks.approval import Approval
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import FailureReport, PlanReport, StepReport, StepStatus, TaskStatus, VerifiedGoal
from skills.failures import Evidence

GOAL = Goal(predicate=Predicate.ON, args=("cup_1", "desk_1"))
STEPS = (StepReport(skill="PICK", args=("cup_1",)), StepReport(skill="PLACE", args=("cup_1", "desk_1")))
PLAN = PlanReport(source="grammar", revision=7, goals=(GOAL,), steps=STEPS)
FAILURE = FailureReport(
    step="PICK(cup_1)",
    code="object_gone",
    message="The cup is gone.",
    suggestion="I look for it.",
    evidence=Evidence(nodes=("cup_1",), revision=9, observation="its place is in view and empty"),
)
KEY = "key-0123456789"


@pytest.fixture
def file(tmp_path):
    folder = tmp_path / "buildings" / "flat-1"
    folder.mkdir(parents=True)
    return folder / "tasks.sqlite3"


@pytest.fixture
def journal(file):
    journal = TaskJournal.open(file)
    yield journal
    journal.close()


@pytest.fixture
def audit(journal):
    return Audit(journal, redactor=Redactor((KEY,)))


@pytest.fixture
def queue(audit):
    queue = TaskQueue()
    queue.listen(lambda task: audit.hear_task(task, 1.5))
    return queue


def with_step(plan, index, status):
    steps = tuple(replace(step, status=status) if i == index else step for i, step in enumerate(plan.steps))
    return replace(plan, steps=steps)


def carry_out(queue, audit, request="bring the cup"):
    """A task that is asked about, approved, fails once, is planned anew, and succeeds."""
    task_id = queue.submit(request, stamp_s=0.0, approval=Approval.ASK).id
    queue.move(task_id, TaskStatus.PLANNING, stamp_s=0.1)
    understood = {"event": "understood", "task": task_id, "kind": "plan", "source": "grammar", "goals": [str(GOAL)]}
    audit.hear_event(0.1, "mission", {**understood, "reply": "I will."})
    queue.amend(task_id, plan=PLAN, kind="plan", reply="I will.")
    queue.move(task_id, TaskStatus.AWAITING_APPROVAL, stamp_s=0.2, explanation="I bring the cup. Shall I?")
    queue.approve(task_id, stamp_s=0.3)
    queue.move(task_id, TaskStatus.PLANNING, stamp_s=0.4)
    queue.move(task_id, TaskStatus.RUNNING, stamp_s=0.4, explanation="I bring the cup.")
    queue.amend(task_id, plan=with_step(PLAN, 0, StepStatus.RUNNING))
    queue.pause(task_id, stamp_s=0.5)
    audit.hear_event(0.5, "stop", {})
    audit.hear_event(0.5, "resume", {})
    queue.resume(task_id, stamp_s=0.6)
    queue.amend(task_id, plan=with_step(PLAN, 0, StepStatus.FAILED), failures=(FAILURE,))
    audit.hear_event(0.7, "mission", {"event": "replan", "task": task_id, "why": "recovery", "plan": "…"})
    other = replace(PLAN, revision=12, steps=(StepReport(skill="GOTO", args=("desk_1",)), *STEPS))
    queue.amend(task_id, plan=other, replans=1)
    seen = {"step": "GOTO(desk_1)", "seen": "the robot is at the desk", "nodes": ["desk_1"], "revision": 13}
    audit.hear_event(0.8, "mission", {"event": "observed", "task": task_id, **seen})
    queue.amend(task_id, plan=with_step(other, 0, StepStatus.SUCCEEDED))
    queue.amend(task_id, verified=(VerifiedGoal(goal=GOAL, confirmed=True),))
    queue.move(task_id, TaskStatus.SUCCEEDED, stamp_s=0.9, explanation="The cup is on the desk.")
    return task_id


def test_a_trace_tells_every_decision_in_order_with_its_reason(queue, audit, journal):
    task_id = carry_out(queue, audit)
    entries = journal.trace(task_id).entries
    assert [entry.kind for entry in entries] == [
        "received", "understood", "planned", "shown", "approved", "started", "step", "paused", "stopped", "released",
        "resumed", "step", "failure", "replanned", "planned", "observed", "step", "verified", "ended",
    ]  # fmt: skip
    by_kind = {entry.kind: entry for entry in entries}
    assert by_kind["received"].what == "bring the cup"
    assert "read by grammar; proven on revision 12" in by_kind["planned"].why
    assert by_kind["failure"].why == "its place is in view and empty (revision 9)"
    assert by_kind["failure"].data["code"] == "object_gone"
    assert by_kind["replanned"].why == "Because of: recovery."
    assert by_kind["observed"].why == "the robot is at the desk (revision 13)"
    assert by_kind["verified"].what == f"{GOAL} confirmed"
    assert by_kind["ended"].what == "succeeded: The cup is on the desk."
    assert all(entry.at_s > 1e9 for entry in entries)


class Disk:
    """A disk that is full from time to time, as SQLite meets it."""

    def __init__(self, journal):
        self.journal, self.full = journal, False

    def __getattr__(self, name):
        if self.full and name in ("write", "note"):
            raise sqlite3.OperationalError("database or disk is full")
        return getattr(self.journal, name)


def test_what_cannot_be_written_is_not_taken_and_what_is_under_way_goes_on_and_is_told_later(journal, caplog):
    disk = Disk(journal)
    audit, queue = Audit(disk, redactor=Redactor(())), TaskQueue()
    queue.listen(lambda task: audit.hear_task(task, 0.0))
    task_id = queue.submit("bring the cup", stamp_s=0.0).id
    queue.move(task_id, TaskStatus.PLANNING, stamp_s=0.0)
    disk.full = True
    with pytest.raises(NotKept, match="disk is full"):
        queue.submit("bring the other one", stamp_s=0.0)
    assert [task.id for task in queue.tasks] == [task_id]
    queue.amend(task_id, plan=PLAN)
    queue.move(task_id, TaskStatus.RUNNING, stamp_s=0.0, explanation="I bring the cup.")
    audit.hear_event(0.0, "stop", {})
    assert "disk is full" in caplog.text
    disk.full = False
    queue.cancel(task_id, stamp_s=0.0)
    assert [entry.kind for entry in journal.trace(task_id).entries] == ["received", "planned", "ended"]


def test_a_plan_turned_down_is_told_from_a_task_cancelled(queue, journal):
    def shown():
        task_id = queue.submit("bring the cup", stamp_s=0.0, approval=Approval.ASK).id
        queue.move(task_id, TaskStatus.PLANNING, stamp_s=0.0)
        queue.move(task_id, TaskStatus.AWAITING_APPROVAL, stamp_s=0.0, explanation="Shall I?")
        return task_id

    rejected, cancelled = shown(), shown()
    queue.reject(rejected, stamp_s=1.0)
    queue.cancel(cancelled, stamp_s=1.0)
    assert [entry.kind for entry in journal.trace(rejected).entries][-2:] == ["rejected", "ended"]
    assert [entry.kind for entry in journal.trace(cancelled).entries][-2:] == ["shown", "ended"]


def test_questions_and_answers_are_told_once(queue, journal):
    task_id = queue.submit("bring the cup", stamp_s=0.0).id
    queue.move(task_id, TaskStatus.PLANNING, stamp_s=0.0)
    asked = {"candidates": ("cup_1", "cup_2"), "dialogue": (("Which one?", ""),)}
    queue.move(task_id, TaskStatus.AWAITING_ANSWER, stamp_s=0.1, **asked)
    queue.answer(task_id, "the red one", stamp_s=0.2)
    _, question, answer = journal.trace(task_id).entries
    assert (question.what, question.data["candidates"]) == ("Which one?", ["cup_1", "cup_2"])
    assert (answer.what, answer.why) == ("the red one", "to the question: Which one?")


def test_what_a_model_was_asked_and_said_is_kept_without_secrets(queue, audit, journal, file):
    task_id = queue.submit(f"my password is {KEY}, bring the cup", stamp_s=0.0).id
    about = {"task": task_id, "model": "openai:x", "round": 1}
    messages = [{"role": "user", "text": f"Authorization: Bearer abcdefghijkl and {KEY} and sk-{'a' * 20}"}]
    audit.hear_event(0.0, "model", {"event": "model_prompt", **about, "messages": messages})
    audit.hear_event(0.1, "model", {"event": "model_answer", **about, "attempts": 1, "text": "{" * (LONGEST + 50)})
    audit.hear_event(0.2, "model", {"event": "model_answer", **about, "attempts": 2, "text": "", "failure": "timeout",
                                    "message": "no answer within 3 s"})  # fmt: skip
    _, asked, said, silent = journal.trace(task_id).entries
    assert asked.data["messages"] == [
        {"role": "user", "text": "Authorization: Bearer [secret] and [secret] and [secret]"}
    ]
    assert "(50 characters left out)" in said.what
    assert silent.what == "timeout: no answer within 3 s"
    connection = sqlite3.connect(file)
    told = json.dumps(connection.execute("SELECT what, why, data FROM decisions").fetchall())
    connection.close()
    assert KEY not in told
    assert "abcdefghijkl" not in told


@given(st.text(max_size=200), st.text(alphabet="abcXYZ0189-_", min_size=6, max_size=40), st.text(max_size=200))
def test_no_known_secret_is_left_wherever_it_stands(before, secret, after):
    data = {f"{before}{secret}": [f"{before}{secret}{after}", {"deep": (secret,)}]}
    assert secret not in json.dumps(Redactor((secret,)).data(data), ensure_ascii=False)


def test_ordinary_words_stay_as_they_are():
    text = "bring the token ring to the bearer of good news, e.g. at 10:30, user@example.org; skate-board"
    assert Redactor(()).text(text) == text


def test_a_full_journal_drops_the_oldest_entries_and_says_so(file):
    journal = TaskJournal.open(file, max_bytes=100_000)
    queue = TaskQueue()
    audit = Audit(journal, redactor=Redactor(()))
    queue.listen(lambda task: audit.hear_task(task, 0.0))
    for _ in range(60):
        carry_out(queue, audit, request="bring the cup " * 20)
    first, last = journal.trace("task_1"), journal.trace("task_60")
    assert (first.entries, first.dropped) == ([], 19)
    assert (last.entries[0].kind, last.entries[-1].kind, last.dropped) == ("received", "ended", 0)
    kept = sum(len(journal.trace(f"task_{n}").entries) for n in range(1, 61))
    dropped = sum(journal.trace(f"task_{n}").dropped for n in range(1, 61))
    assert kept + dropped == 60 * 19
    journal.close()
    again = TaskJournal.open(file, max_bytes=100_000)
    assert again.trace("task_1").dropped == 19
    assert len(again.take_up()) == 60
    again.close()


def test_the_log_beside_the_journal_stays_short_also_when_writing_never_pauses(file, monkeypatch):
    monkeypatch.setattr(journal_file, "_checkpoint", lambda _: None)  # as if it never caught up
    journal = TaskJournal(JournalFile.open(file, JournalSettings(longest_log_bytes=1_000_000)))
    audit, queue = Audit(journal, redactor=Redactor(())), TaskQueue()
    queue.listen(lambda task: audit.hear_task(task, 1.5))
    task_id, said = queue.submit("bring the cup", stamp_s=0.0).id, "word " * 4000
    longest = 0
    for _ in range(350):
        journal.note(task_id, [Decision(kind=DecisionKind.MODEL_ANSWERED, what=said)], stamp_s=0.0)
        longest = max(longest, file.with_name(f"{file.name}-wal").stat().st_size)
    assert 1_000_000 < longest < 6_000_000
    assert len(journal.trace(task_id).entries) == 351
    journal.close()


def test_pages_of_a_trace_make_the_whole(queue, audit, journal):
    carry_out(queue, audit)
    task_id = carry_out(queue, audit)
    pages, after = [], 0
    while after is not None:
        page = journal.trace(task_id, after=after, limit=4)
        pages.append(page.entries)
        after = page.next
    assert [len(page) for page in pages] == [4, 4, 4, 4, 3]
    assert [entry for page in pages for entry in page] == journal.trace(task_id).entries
    assert journal.trace("task_77") is None


def test_a_trace_is_read_from_the_files_of_a_service_that_is_gone(queue, audit, journal, file, tmp_path):
    task_id = carry_out(queue, audit)
    [(found, trace)] = stored_traces(tmp_path, task_id)  # also beside one that runs
    assert (found, trace.entries) == (file, journal.trace(task_id).entries)
    journal.close()
    [(_, trace)] = stored_traces(tmp_path, task_id)
    assert trace.entries[-1].kind == "ended"
    assert list(stored_traces(tmp_path, "task_9")) == []


def test_a_journal_of_the_version_before_is_taken_up_and_gets_traces(file):
    task_table = "CREATE TABLE tasks (number INTEGER PRIMARY KEY, id TEXT NOT NULL UNIQUE, ended INTEGER NOT NULL, document BLOB NOT NULL)"  # noqa: E501
    document = json.dumps({"id": "task_3", "request": "go", "times": {"received_s": 1.0}, "status": "running"})
    with sqlite3.connect(file) as connection:
        connection.execute(task_table)
        connection.execute("INSERT INTO tasks VALUES (3, 'task_3', 0, ?)", (document,))
        connection.execute("PRAGMA user_version = 1")
    connection.close()
    journal = TaskJournal.open(file)
    [task] = journal.take_up()
    assert task.status is TaskStatus.FAILED
    assert [entry.kind for entry in journal.trace("task_3").entries] == ["restarted", "failure", "ended"]
    journal.close()
    again = TaskJournal.open(file)
    assert [entry.kind for entry in again.trace("task_3").entries] == ["restarted", "failure", "ended"]
    assert again.take_up() == [task]
    again.close()


STATUSES = st.sampled_from(list(StepStatus))


@settings(max_examples=60)
@given(st.lists(st.tuples(STATUSES, STATUSES), min_size=1, max_size=8))
def test_the_steps_in_a_trace_end_as_those_of_the_plan(course):
    queue, told = TaskQueue(), []
    known = {}

    def hear(task):
        told.extend(decisions_between(known.get(task.id), task))
        known[task.id] = task

    queue.listen(hear)
    task_id = queue.submit("go", stamp_s=0.0).id
    for statuses in course:
        steps = tuple(replace(step, status=status) for step, status in zip(STEPS, statuses, strict=True))
        queue.amend(task_id, plan=replace(PLAN, steps=steps))
    states = dict.fromkeys(range(len(STEPS)), StepStatus.PENDING.value)
    for decision in told:
        if decision.kind is DecisionKind.STEP:
            assert states[decision.data["index"]] != decision.data["status"]
            states[decision.data["index"]] = decision.data["status"]
    assert tuple(states.values()) == tuple(status.value for status in course[-1])
    planned = [decision for decision in told if decision.kind is DecisionKind.PLANNED]
    assert planned[-1].data["steps"] == list(outline(queue.task(task_id).plan))
