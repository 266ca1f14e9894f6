"""The life of a task: legal moves only, immutable records, one at a time."""

from __future__ import annotations

import json
from dataclasses import FrozenInstanceError, replace
from itertools import pairwise

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.errors import IllegalTransition, OperationNotAllowed, PlanChanged, QueueFull, TaskNotFound
from planner.goals import goal
from planner.tasks.approval import Approval
from planner.tasks.queue import MOST_OPEN, OPERATIONS, TaskQueue
from planner.tasks.tasks import (
    TRANSITIONS,
    ActionReport,
    FailureReport,
    PlanReport,
    StepReport,
    StepStatus,
    Task,
    TaskStatus,
    TaskTimes,
)

statuses = st.sampled_from(TaskStatus)


def a_task(status: TaskStatus = TaskStatus.QUEUED) -> Task:
    return Task(id="task_1", request="bring the bottle", times=TaskTimes(received_s=1.0), status=status)


def queue_with(status: TaskStatus) -> TaskQueue:
    return TaskQueue([a_task(status)])


@given(statuses, statuses)
def test_a_task_makes_every_legal_move_and_no_other(source, target):
    task = a_task(source)
    if target in TRANSITIONS[source]:
        assert task.to(target, stamp_s=2.0).status is target
        return
    with pytest.raises(IllegalTransition) as error:
        task.to(target, stamp_s=2.0)
    assert set(error.value.allowed) == TRANSITIONS[source]
    assert all(allowed in str(error.value) for allowed in TRANSITIONS[source])


def test_ended_is_ended_and_everything_else_can_be_cancelled():
    ended = {TaskStatus.SUCCEEDED, TaskStatus.FAILED, TaskStatus.CANCELLED, TaskStatus.REFUSED}
    assert {status for status in TaskStatus if status.ended} == ended
    assert all(TaskStatus.CANCELLED in TRANSITIONS[status] for status in set(TaskStatus) - ended)


def test_every_status_is_reached_from_queued():
    reached, todo = set(), {TaskStatus.QUEUED}
    while todo:
        status = todo.pop()
        reached.add(status)
        todo |= TRANSITIONS[status] - reached
    assert reached == set(TaskStatus)


@given(statuses, st.sampled_from(sorted(OPERATIONS)))
def test_operations_fit_their_statuses_and_errors_list_those_that_do(status, operation):
    queue = queue_with(status)
    extra = ("blue",) if operation == "answer" else ()
    fits, target = OPERATIONS[operation]
    if status in fits:
        assert getattr(queue, operation)("task_1", *extra, stamp_s=2.0).status is target
        return
    with pytest.raises(OperationNotAllowed) as error:
        getattr(queue, operation)("task_1", *extra, stamp_s=2.0)
    assert set(error.value.allowed) == {name for name, (fitting, _) in OPERATIONS.items() if status in fitting}
    assert queue.task("task_1").status is status


@given(
    st.lists(
        st.tuples(st.sampled_from([*sorted(OPERATIONS), "submit", "move"]), st.integers(1, 4), statuses), max_size=40
    )
)
def test_no_sequence_of_operations_makes_two_tasks_run_through_the_queue_or_changes_an_ended_one(moves):
    queue, history = TaskQueue(), {}
    queue.listen(lambda task: history.setdefault(task.id, []).append(task.status))
    for operation, number, status in moves:
        task_id = f"task_{number}"
        try:
            if operation == "submit":
                queue.submit("go", stamp_s=0.0)
            elif operation == "move":
                current = queue.current
                if current is not None:
                    queue.move(current.id, status, stamp_s=0.0)
            elif operation == "answer":
                queue.answer(task_id, "yes", stamp_s=0.0)
            else:
                getattr(queue, operation)(task_id, stamp_s=0.0)
        except (TaskNotFound, OperationNotAllowed, IllegalTransition):
            pass
        held = [task for task in queue.tasks if task.status in (TaskStatus.RUNNING, TaskStatus.PAUSED)]
        assert len(held) <= 1
        assert not held or queue.current is held[0]
    for seen in history.values():
        assert all(after in TRANSITIONS[before] for before, after in pairwise(seen))


def test_tasks_run_in_order_of_arrival_and_those_that_wait_for_a_person_step_aside():
    queue = TaskQueue()
    first, second = queue.submit("first", stamp_s=0.0), queue.submit("second", stamp_s=0.0)
    assert queue.current == first
    queue.move(first.id, TaskStatus.PLANNING, stamp_s=0.0)
    queue.move(first.id, TaskStatus.AWAITING_ANSWER, stamp_s=0.0, dialogue=(("which?", ""),))
    assert queue.current == second
    answered = queue.answer(first.id, "the blue one", stamp_s=1.0)
    assert answered.dialogue == (("which?", "the blue one"),)
    assert queue.current == answered


def test_an_approval_is_of_the_plan_that_was_looked_at_or_of_none():
    plan = PlanReport(source="grammar", revision=7, goals=(goal("robot_at", "room_1"),), steps=())
    waiting = replace(a_task(TaskStatus.AWAITING_APPROVAL), plan=plan)
    for stale in (6, 8, 0, -1):
        queue = TaskQueue([waiting])
        with pytest.raises(PlanChanged) as error:
            queue.approve("task_1", stamp_s=2.0, revision=stale)
        assert (error.value.revision, queue.task("task_1")) == (7, waiting)
    for seen in (7, None):
        approved = TaskQueue([waiting]).approve("task_1", stamp_s=2.0, revision=seen)
        assert (approved.status, approved.approved) == (TaskStatus.QUEUED, True)
    with pytest.raises(OperationNotAllowed):
        queue_with(TaskStatus.RUNNING).approve("task_1", stamp_s=2.0, revision=7)


def test_the_queue_is_told_in_the_order_in_which_tasks_get_the_robot():
    queue = TaskQueue()
    for _ in range(5):
        queue.submit("go", stamp_s=1.0)
    queue.cancel("task_2", stamp_s=1.0)
    for status in (TaskStatus.PLANNING, TaskStatus.RUNNING):
        queue.move("task_3", status, stamp_s=2.0)
    assert [task.id for task in queue.waiting] == ["task_3", "task_1", "task_4", "task_5"]
    queue.cancel("task_3", stamp_s=3.0)
    order = []
    while (current := queue.current) is not None:
        assert queue.waiting[0] is current
        order.append(current.id)
        queue.cancel(current.id, stamp_s=4.0)
    assert order == ["task_1", "task_4", "task_5"]
    assert queue.waiting == ()


def test_only_so_many_tasks_wait_at_a_time_but_what_is_urgent_is_taken():
    queue = TaskQueue()
    for _ in range(MOST_OPEN):
        queue.submit("go", stamp_s=1.0)
    with pytest.raises(QueueFull):
        queue.submit("go", stamp_s=1.0)
    assert queue.submit("stop", stamp_s=1.0, urgent=True).id == f"task_{MOST_OPEN + 1}"
    for task_id in ("task_1", f"task_{MOST_OPEN + 1}"):
        queue.cancel(task_id, stamp_s=2.0)
    assert queue.submit("go", stamp_s=3.0).status is TaskStatus.QUEUED


def test_listeners_get_every_record_and_records_do_not_change():
    queue, seen = TaskQueue(), []
    queue.listen(seen.append)
    task = queue.submit("go", stamp_s=3.0)
    queue.cancel(task.id, stamp_s=4.0)
    assert [record.status for record in seen] == [TaskStatus.QUEUED, TaskStatus.CANCELLED]
    assert seen[0].times.ended_s is None
    assert seen[1].times.ended_s == 4.0
    with pytest.raises(FrozenInstanceError):
        seen[0].status = TaskStatus.RUNNING


def test_an_unknown_task_is_named_and_the_known_ones_listed():
    queue = TaskQueue()
    queue.submit("go", stamp_s=0.0)
    with pytest.raises(TaskNotFound, match="task_1"):
        queue.task("task_9")


def test_identifiers_go_on_counting_and_ended_tasks_are_forgotten_oldest_first():
    queue = TaskQueue([a_task(TaskStatus.FAILED)], keep=2)
    for _ in range(4):
        queue.cancel(queue.submit("go", stamp_s=0.0).id, stamp_s=0.0)
    assert [task.id for task in queue.tasks] == ["task_3", "task_4", "task_5"]


def test_the_document_has_the_fields_of_the_api_and_is_json():
    step = StepReport(skill="PICK", args=("cup_1",), actions=(ActionReport(name="reach", status=StepStatus.RUNNING),))
    plan = PlanReport(source="grammar", revision=7, goals=(goal("on", "cup_1", "desk_1"),), steps=(step,))
    failure = FailureReport(step="PICK(cup_1)", code="grasp_empty", message="Nothing there.")
    task = Task(
        id="task_1",
        request="x",
        times=TaskTimes(received_s=0.0),
        plan=plan,
        failures=(failure,),
        approval=Approval.ASK,
    )
    document = json.loads(json.dumps(task.document()))
    assert {"id", "request", "status", "kind", "reply", "plan", "replans", "failures", "explanation", "times"} <= set(
        document
    )
    assert document["status"] == "queued"
    assert document["plan"]["goals"] == [{"predicate": "on", "args": ["cup_1", "desk_1"]}]
    assert set(document["plan"]["steps"][0]) == {"skill", "args", "status", "actions", "seconds"}
    assert set(document["failures"][0]) == {"step", "code", "message", "evidence", "suggestion"}
