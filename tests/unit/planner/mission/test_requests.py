"""Answers, questions, plans that are only shown, and requests while another one is under way."""

from __future__ import annotations

import asyncio

import pytest

from planner.doubles.rehearsal import rehearsal_graph
from planner.doubles.scripted import ScriptedInterpreter
from planner.mission.mission import Mission
from planner.mission.offline import OfflineMission
from planner.skill_planner.verifier import Verifier
from planner.tasks.approval import Approval
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import StepStatus, TaskStatus
from rehearsed_mission import BRING, MEANINGS, Show
from scene_graph.memory import WorkingMemory
from skills.registry import load_registry


@pytest.mark.parametrize(
    ("request_", "status", "kind"),
    [
        ("where is it?", TaskStatus.SUCCEEDED, "answer"),
        ("open the window", TaskStatus.REFUSED, "refuse"),
        ("bring the table", TaskStatus.REFUSED, "plan"),
    ],
)
def test_answers_and_refusals_move_nothing(request_, status, kind):
    show = Show()
    task = show.finish(request_)
    assert (task.status, task.kind) == (status, kind)
    assert task.explanation
    assert show.body.drives == []


def test_a_question_is_asked_with_candidates_and_its_answer_planned():
    show = Show()
    show.ask("bring the bottle")
    show.run(6)
    assert show.task.status is TaskStatus.AWAITING_ANSWER
    assert show.task.candidates == ("bottle_1", "bottle_2")
    assert [offer.candidates for offer in show.task.offers] == [show.task.candidates]
    assert show.task.reply == "Which one?"
    show.queue.answer("task_1", "the blue one", stamp_s=show.stamp_s)
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.SUCCEEDED
    assert show.task.dialogue == (("Which one?", "the blue one"),)


@pytest.mark.parametrize("paused", [False, True])
def test_questions_are_answered_while_another_task_has_the_robot_and_requests_wait_their_turn(paused):
    show = Show()
    show.ask()
    show.until_step("GOTO")
    if paused:
        show.queue.pause("task_1", stamp_s=show.stamp_s)
    for request in ("where is it?", "take it", "bring the bottle"):
        show.ask(request)
    show.run(10)
    _, answered, waiting, asked = show.queue.tasks
    assert answered.status is TaskStatus.SUCCEEDED
    assert (waiting.status, waiting.kind) == (TaskStatus.QUEUED, "plan")
    assert asked.status is TaskStatus.AWAITING_ANSWER
    assert not show.task.status.ended
    if paused:
        show.queue.resume("task_1", stamp_s=show.stamp_s)
    show.run_until(lambda: show.queue.task("task_3").status.ended)
    assert [task.status for task in show.queue.tasks[:3]] == [TaskStatus.SUCCEEDED] * 3
    assert show.task.times.ended_s <= show.queue.task("task_3").times.started_s


def test_a_plan_is_shown_before_anything_moves_when_approval_is_asked():
    show = Show()
    show.ask(approval=Approval.ASK)
    show.run(40)
    assert show.task.status is TaskStatus.AWAITING_APPROVAL
    assert len(show.task.plan.steps) == 4
    assert show.body.drives == []
    show.queue.approve("task_1", stamp_s=show.stamp_s)
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.SUCCEEDED


def test_a_plan_that_has_changed_since_its_approval_is_shown_again():
    show = Show()
    show.ask(approval=Approval.ASK)
    show.run(10)
    show.stage.stand_at("table_1", show.stamp_s)
    show.queue.approve("task_1", stamp_s=show.stamp_s)
    show.run(10)
    assert show.task.status is TaskStatus.AWAITING_APPROVAL
    assert [step.skill for step in show.task.plan.steps] == ["PICK", "GOTO", "PLACE"]
    show.queue.reject("task_1", stamp_s=show.stamp_s)
    show.run(20)
    assert show.task.status is TaskStatus.CANCELLED
    assert show.body.drives == []


def test_a_dry_run_plans_and_moves_nothing():
    show = Show()
    task = show.finish(dry_run=True)
    assert task.status is TaskStatus.SUCCEEDED
    assert [step.status for step in task.plan.steps] == [StepStatus.PENDING] * 4
    assert "nothing was moved" in task.explanation
    assert task.verified == ()
    assert show.body.drives == []


def test_without_a_robot_requests_are_planned_on_paper():
    memory, queue = WorkingMemory(rehearsal_graph()), TaskQueue()
    skills = load_registry(more=())
    mission = OfflineMission(memory, queue, ScriptedInterpreter(MEANINGS), Verifier(skills))
    for request in (BRING, "open the window", "bring the bottle", "where is it?", "bring the table"):
        queue.submit(request, stamp_s=0.0)
    before = memory.snapshot()
    for _ in range(6):
        asyncio.run(mission.step(0.0))
    planned, refused, asked, answered, impossible = queue.tasks
    assert [step.skill for step in planned.plan.steps] == ["GOTO", "PICK", "GOTO", "PLACE"]
    assert planned.status is answered.status is TaskStatus.SUCCEEDED
    assert refused.status is impossible.status is TaskStatus.REFUSED
    assert asked.status is TaskStatus.AWAITING_ANSWER
    assert memory.snapshot() is before


def test_a_request_that_is_not_understood_in_time_fails():
    show = Show(interpret_s=0.01)

    class Slow:
        async def interpret(self, text, snapshot, dialogue):
            await asyncio.Event().wait()

    show.mission = Mission(show.resources, Slow())
    assert "in time" in show.finish().explanation


def test_a_task_cancelled_while_it_is_being_understood_stays_cancelled():
    show = Show()

    class Cancelling:
        async def interpret(self, text, snapshot, dialogue):
            show.queue.cancel("task_1", stamp_s=show.stamp_s)
            return MEANINGS[text]

    show.mission = Mission(show.resources, Cancelling())
    show.ask()
    show.run(10)
    assert show.task.status is TaskStatus.CANCELLED
    assert show.task.plan is None


def test_pronouns_reach_the_interpreter_in_the_next_request():
    show = Show()
    interpreter = ScriptedInterpreter(MEANINGS)
    show.mission = Mission(show.resources, interpreter)
    show.finish(dry_run=True)
    show.ask("where is it?")
    show.run(6)
    assert interpreter.asked[-1][1].mentioned[0] == "bottle_1"
