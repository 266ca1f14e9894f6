"""A robot that does not know where it is, as after every start in a known building: it finds out first, then goes."""

from __future__ import annotations

from dataclasses import replace

from planner.mission.mission import LOST
from planner.mission.settings import MissionSettings
from planner.tasks.approval import Approval
from planner.tasks.tasks import TaskStatus
from rehearsed_mission import BRING, Show


def lost():
    """A show whose robot does not know where it is."""
    show = Show()
    place(show, known=False)
    return show


def place(show, *, known):
    snapshot = show.memory.snapshot()
    room = next(edge for edge in snapshot.edges_from("robot") if edge.key.type == "in") if not known else show.room
    with show.memory.edit("test", show.stamp_s) as tx:
        tx.put(replace(snapshot.robot, localized=known))
        if known:
            tx.put(room)
        else:
            tx.remove(room.key)
    show.room = room


def test_what_is_to_be_done_waits_until_the_robot_knows_where_it_is():
    show = lost()
    task = show.ask()
    show.run(100)
    waiting = show.queue.task(task.id)
    assert (waiting.status, waiting.explanation) == (TaskStatus.QUEUED, LOST)
    place(show, known=True)
    show.run_until(lambda: show.queue.task(task.id).status.ended)
    assert show.queue.task(task.id).status is TaskStatus.SUCCEEDED


def test_while_it_waits_it_is_planned_for_once_and_not_told_again_and_again():
    show, told = lost(), []
    show.ask()
    show.queue.listen(told.append)
    show.run(200)
    assert len(told) < 6


def test_questions_are_answered_meanwhile_and_what_cannot_be_done_is_turned_down():
    show = lost()
    show.ask()
    asked, refused = show.ask("where is it?"), show.ask("open the window")
    show.run(20)
    assert show.queue.task(asked.id).status is TaskStatus.SUCCEEDED
    assert show.queue.task(refused.id).status is TaskStatus.REFUSED


def test_what_was_asked_meanwhile_is_done_in_its_order():
    show = lost()
    first, second = show.ask(), show.ask("leave it")
    show.run(20)
    assert [task.id for task in show.queue.waiting] == [first.id, second.id]
    place(show, known=True)
    show.run_until(lambda: show.queue.task(second.id).status.ended)
    assert {show.queue.task(task.id).status for task in (first, second)} == {TaskStatus.SUCCEEDED}


def test_a_person_can_cancel_what_waits_and_is_asked_for_an_approval_afterwards():
    show = lost()
    first, second = show.ask(), show.ask(BRING, approval=Approval.ASK)
    show.run(20)
    show.queue.cancel(first.id, stamp_s=show.stamp_s)
    place(show, known=True)
    show.run(10)
    assert show.queue.task(first.id).status is TaskStatus.CANCELLED
    assert show.queue.task(second.id).status is TaskStatus.AWAITING_APPROVAL


def test_a_robot_that_does_not_find_its_place_is_not_waited_for_for_ever():
    show = lost()
    task = show.ask()
    show.run(round(MissionSettings.lost_patience_s / 0.05) - 40)
    assert show.queue.task(task.id).status is TaskStatus.QUEUED
    show.run(80)
    assert show.queue.task(task.id).status is not TaskStatus.QUEUED
