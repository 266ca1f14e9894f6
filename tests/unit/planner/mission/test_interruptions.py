"""Cancelled, paused, stopped and meddled with at any moment, a task ends honestly."""

from __future__ import annotations

from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from planner.doubles.rehearsal import GRIPPER
from planner.doubles.scripted import PHANTOM, Script
from planner.tasks.tasks import TaskStatus
from rehearsed_mission import BRING, Show
from scene_graph.nodes import ObjectState
from skills.failures import FailureCode


@settings(max_examples=25, suppress_health_check=[HealthCheck.too_slow])
@given(st.integers(4, 110))
def test_cancelled_at_any_tick_the_robot_stands_still_and_the_next_task_runs(tick):
    show = Show()
    show.ask()
    show.ask("take it")
    show.run(tick)
    if show.task.status.ended:
        return
    show.queue.cancel("task_1", stamp_s=show.stamp_s)
    show.run(1)
    assert not show.body.moving
    show.run_until(lambda: show.queue.task("task_2").status.ended)
    assert show.queue.task("task_2").status is TaskStatus.SUCCEEDED
    assert show.memory.snapshot().robot.holding == "bottle_1"
    assert show.task.status is TaskStatus.CANCELLED


@settings(max_examples=25, suppress_health_check=[HealthCheck.too_slow])
@given(st.lists(st.tuples(st.integers(2, 60), st.sampled_from(["pause", "stop"])), min_size=1, max_size=3))
def test_paused_or_stopped_at_any_ticks_nothing_moves_and_afterwards_the_task_still_succeeds(cuts):
    show = Show()
    show.ask()
    for ticks, how in cuts:
        show.run(ticks)
        if show.task.status is not TaskStatus.RUNNING:
            continue
        if how == "pause":
            show.queue.pause("task_1", stamp_s=show.stamp_s)
        else:
            show.body.stop()
        show.run(1)
        assert not show.body.moving
        sent = len(show.body.drives)
        show.run(150)
        assert all(drive == (0.0, 0.0) for drive in show.body.drives[sent:])
        if how == "pause":
            show.queue.resume("task_1", stamp_s=show.stamp_s)
        else:
            show.body.release_stop()
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.SUCCEEDED
    assert show.task.failures == ()
    assert show.stage.places["bottle_1"] == "desk_1"


TRUTH = {BRING: "desk_1", "tidy up": "shelf_1", "take it": GRIPPER, "leave it": "table_1"}
outcomes = st.lists(st.sampled_from([None, None, PHANTOM, *FailureCode]), max_size=5)
meddling = st.lists(
    st.tuples(st.integers(1, 80), st.sampled_from(["table_1", "shelf_1", "desk_1", None, "blind", "seeing"])),
    max_size=4,
)


@settings(max_examples=60, suppress_health_check=[HealthCheck.too_slow])
@given(outcomes, outcomes, outcomes, outcomes, meddling, st.sampled_from(sorted(TRUTH)))
def test_whatever_happens_a_task_ends_and_never_succeeds_unless_its_goals_hold_in_truth(
    goto, pick, place, look, meddles, request_
):
    show, meddled_s = Show(Script(outcomes={"GOTO": goto, "PICK": pick, "PLACE": place, "LOOK": look})), 0.0
    show.ask(request_)
    for ticks, deed in meddles:
        show.run(ticks)
        if show.task.status.ended:
            break
        meddled_s = show.stamp_s
        if deed in ("blind", "seeing"):
            show.stage.blind = deed == "blind"
        else:
            show.stage.places["bottle_1"] = deed
    show.run_until(lambda: show.task.status.ended, limit=40_000)
    task, node = show.task, show.memory.snapshot().object("bottle_1")
    assert not show.body.moving
    assert not show.granted_twice
    assert task.explanation
    assert task.status in (TaskStatus.SUCCEEDED, TaskStatus.FAILED)
    if task.status is TaskStatus.FAILED:
        assert task.failures or "not" in task.explanation
        return
    assert all(verified.confirmed for verified in task.verified)
    assert node.state is ObjectState.HELD or node.last_seen_s > task.times.planned_s
    felt_since = node.state is ObjectState.HELD and not show.stage.blind and task.times.ended_s > meddled_s + 0.3
    if felt_since or node.last_seen_s > meddled_s:
        assert show.stage.places["bottle_1"] == TRUTH[request_]
