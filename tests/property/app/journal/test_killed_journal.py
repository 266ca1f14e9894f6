"""A process that is killed at any instant leaves tasks and traces that agree, and loses nothing it acknowledged."""

from __future__ import annotations

import json
import os
import random
import signal
import sqlite3
import time
from dataclasses import replace

import pytest

from app.journal.audit import Audit
from app.journal.decisions import outline
from app.journal.redaction import Redactor
from app.journal.tasks import INTERRUPTED, TaskJournal
from planner.goals import Goal, Predicate
from planner.tasks.approval import Approval
from planner.tasks.queue import KEEP, TaskQueue
from planner.tasks.tasks import FailureReport, PlanReport, StepReport, StepStatus, TaskStatus, VerifiedGoal
from skills.failures import Evidence

GOAL = Goal(predicate=Predicate.ON, args=("cup_1", "desk_1"))


class Life:
    """One life of a service: takes up the journal, and lets random things happen to random tasks."""

    def __init__(self, file, seed):
        self.random = random.Random(seed)
        self.journal = TaskJournal.open(file)
        tasks = self.journal.take_up()
        self.audit = Audit(self.journal, tasks, redactor=Redactor(()))
        self.queue = TaskQueue(tasks)
        self.queue.listen(lambda task: self.audit.hear_task(task, 1.0))

    def happen(self):
        """One change of one task; the task as it is then."""
        waiting = [task for task in self.queue.tasks if not task.status.ended]
        if not waiting or self.random.random() < 0.2:
            asked = self.random.choice(list(Approval))
            return self.queue.submit(f"bring the cup {self.random.random()}", stamp_s=1.0, approval=asked)
        task = self.random.choice(waiting)
        return getattr(self, f"_{task.status.value}")(task)

    def _queued(self, task):
        return self.queue.move(task.id, TaskStatus.PLANNING, stamp_s=1.0)

    def _planning(self, task):
        move = self.random.choice([self._asked, self._shown, self._started, self._ended])
        self.audit.hear_event(1.0, "model", {"event": "model_prompt", "task": task.id, "model": "m", "round": 1,
                                             "messages": [{"role": "user", "text": "x" * 3000}]})  # fmt: skip
        return move(task)

    def _asked(self, task):
        told = {"candidates": ("cup_1", "cup_2"), "dialogue": (*task.dialogue, ("Which one?", ""))}
        return self.queue.move(task.id, TaskStatus.AWAITING_ANSWER, stamp_s=1.0, **told)

    def _shown(self, task):
        self.queue.amend(task.id, plan=self._plan(), approved=False)
        return self.queue.move(task.id, TaskStatus.AWAITING_APPROVAL, stamp_s=1.0, explanation="Shall I?")

    def _started(self, task):
        self.queue.amend(task.id, plan=self._plan())
        return self.queue.move(task.id, TaskStatus.RUNNING, stamp_s=1.0, explanation="I go.")

    def _ended(self, task):
        ending = self.random.choice([TaskStatus.SUCCEEDED, TaskStatus.FAILED])
        verified = (VerifiedGoal(goal=GOAL, confirmed=ending is TaskStatus.SUCCEEDED),)
        self.queue.amend(task.id, verified=verified)
        return self.queue.move(task.id, ending, stamp_s=1.0, explanation="That was it.")

    def _awaiting_answer(self, task):
        return self.queue.answer(task.id, "the red one", stamp_s=1.0)

    def _awaiting_approval(self, task):
        return self.random.choice([self.queue.approve, self.queue.reject])(task.id, stamp_s=1.0)

    def _paused(self, task):
        return self.random.choice([self.queue.resume, self.queue.cancel])(task.id, stamp_s=1.0)

    def _running(self, task):
        return self.random.choice([self._stepped, self._stepped, self._failed, self._held, self._ended])(task)

    def _held(self, task):
        return self.queue.pause(task.id, stamp_s=1.0)

    def _stepped(self, task):
        steps = list(task.plan.steps)
        index = self.random.randrange(len(steps))
        steps[index] = replace(steps[index], status=self.random.choice(list(StepStatus)))
        return self.queue.amend(task.id, plan=replace(task.plan, steps=tuple(steps)))

    def _failed(self, task):
        evidence = Evidence(nodes=("cup_1",), revision=3, observation="not there")
        failure = FailureReport(step="PICK(cup_1)", code="object_gone", message="Gone.", evidence=evidence)
        self.queue.amend(task.id, failures=(*task.failures, failure))
        self.audit.hear_event(1.0, "mission", {"event": "replan", "task": task.id, "why": "recovery"})
        return self.queue.amend(task.id, plan=self._plan(), replans=task.replans + 1)

    def _plan(self):
        skills = self.random.sample(["GOTO", "PICK", "PLACE", "OPEN"], self.random.randint(1, 4))
        steps = tuple(StepReport(skill=skill, args=("cup_1",)) for skill in skills)
        return PlanReport(source="grammar", revision=self.random.randint(1, 9), goals=(GOAL,), steps=steps)


def live_until_killed(file, seed, after_s):
    """What a process that works on the journal acknowledged before it was killed."""
    reading, writing = os.pipe()
    child = os.fork()
    if child == 0:
        try:
            life = Life(file, seed)
            while True:
                task = life.happen()
                told = {"id": task.id, "request": task.request, "entries": len(life.journal.trace(task.id).entries)}
                os.write(writing, json.dumps(told).encode() + b"\n")
        finally:
            os._exit(1)
    os.close(writing)
    with os.fdopen(reading, "rb") as acknowledged:
        first = acknowledged.readline()
        time.sleep(after_s)  # the instant of the kill is the point
        os.kill(child, signal.SIGKILL)
        lines = [first, *acknowledged.readlines()]
    _, status = os.waitpid(child, 0)
    assert os.WIFSIGNALED(status), "the process ended by itself"
    return [json.loads(line) for line in lines if line.endswith(b"\n")]


def assert_agree(task, trace):
    """A task's record and its trace tell the same story."""
    entries = trace.entries
    assert (entries[0].kind, entries[0].what) == ("received", task.request)
    of_kind = {kind: [entry for entry in entries if entry.kind == kind] for kind in {entry.kind for entry in entries}}
    ended = [entry.data["status"] for entry in of_kind.get("ended", [])]
    assert ended == ([task.status.value] if task.status.ended else [])
    assert [entry.data["code"] for entry in of_kind.get("failure", [])] == [f.code for f in task.failures]
    assert len(of_kind.get("asked", [])) == len(task.dialogue)
    assert [entry.what for entry in of_kind.get("answered", [])] == [answer for _, answer in task.dialogue if answer]
    if task.plan is not None:
        planned = of_kind["planned"][-1]
        assert planned.data["steps"] == list(outline(task.plan))
        statuses = ["pending"] * len(task.plan.steps)
        for entry in of_kind.get("step", []):
            if entry.seq > planned.seq:
                statuses[entry.data["index"]] = entry.data["status"]
        assert statuses == [step.status.value for step in task.plan.steps]


def assert_killed_in_vain(file, kills, seed):
    """Kill ``kills`` lives of one journal, and look after each."""
    chance, requests = random.Random(seed), {}
    for life in range(kills):
        told = live_until_killed(file, seed * 1000 + life, chance.random() * 0.03)
        before_restart = stored_traces(file)
        for line in told:
            requests[line["id"]] = line["request"]
            assert before_restart.get(line["id"], 0) >= line["entries"], "an acknowledged change is not in the trace"
        journal = TaskJournal.open(file)
        tasks = {task.id: task for task in journal.take_up()}
        newest = max(number(task_id) for task_id in requests)
        due = {task_id: words for task_id, words in requests.items() if number(task_id) > newest - KEEP}
        assert due.items() <= {task.id: task.request for task in tasks.values()}.items()
        assert not [task for task in tasks.values() if task.status in (TaskStatus.RUNNING, TaskStatus.PAUSED)]
        for task in tasks.values():
            assert_agree(task, journal.trace(task.id))
        journal.close()
    assert [path.name for path in file.parent.iterdir() if "damaged" in path.name] == []
    interrupted = [task for task in tasks.values() if any(f.code == INTERRUPTED for f in task.failures)]
    assert interrupted, "nothing was under way at any kill"


def number(task_id):
    return int(task_id.removeprefix("task_"))


def stored_traces(file):
    """How many entries of each task are in the file that the killed process left."""
    connection = sqlite3.connect(f"{file.as_uri()}?mode=ro", uri=True)
    counts = dict(connection.execute("SELECT task, count(*) FROM decisions GROUP BY task").fetchall())
    connection.close()
    return counts


def test_a_killed_process_leaves_tasks_and_traces_that_agree(tmp_path):
    assert_killed_in_vain(tmp_path / "tasks.sqlite3", kills=12, seed=1)


@pytest.mark.long
@pytest.mark.parametrize("seed", range(2, 6))
def test_so_do_a_hundred(tmp_path, seed):
    assert_killed_in_vain(tmp_path / "tasks.sqlite3", kills=25, seed=seed)
