"""Control words, typed as requests, act on the tasks at once."""

from __future__ import annotations

import pytest

from planner.language.sentences.control import Control, control_word
from planner.mission.control_words import apply_control
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import TaskStatus


def running():
    queue = TaskQueue()
    task = queue.submit("bring me the cup", stamp_s=1.0)
    queue.move(task.id, TaskStatus.PLANNING, stamp_s=1.0)
    return queue, queue.move(task.id, TaskStatus.RUNNING, stamp_s=1.0)


@pytest.mark.parametrize(
    ("text", "status"),
    [
        ("wait a second", TaskStatus.PAUSED),
        ("never mind", TaskStatus.CANCELLED),
        ("stop right now!!", TaskStatus.RUNNING),
        ("ok carry on", TaskStatus.RUNNING),
    ],
)
def test_a_control_word_acts_on_the_running_task_and_ends_at_once(text, status):
    queue, task = running()
    said = apply_control(control_word(text), queue.submit(text, stamp_s=2.0), queue, 2.0)
    assert (queue.task(task.id).status, said.status) == (status, TaskStatus.SUCCEEDED)


def test_going_on_resumes_what_was_paused():
    queue, task = running()
    queue.pause(task.id, stamp_s=2.0)
    apply_control(Control.RESUME, queue.submit("go on", stamp_s=3.0), queue, 3.0)
    assert queue.task(task.id).status is TaskStatus.RUNNING


def test_with_nothing_to_do_a_control_word_says_so():
    queue = TaskQueue()
    assert (
        "nothing to cancel"
        in apply_control(Control.CANCEL, queue.submit("cancel", stamp_s=1.0), queue, 1.0).explanation
    )
