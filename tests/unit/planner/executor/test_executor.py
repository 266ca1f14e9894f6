"""The executor: one job at a time, cut off safely at any tick, never a crash when the body is silent."""

from __future__ import annotations

import asyncio

import pytest
from hypothesis import given
from hypothesis import strategies as st

from planner.doubles.rehearsal import Stage, StillBody, rehearsal_graph
from planner.doubles.scripted import Script, ScriptedAction
from planner.executor.arbiter import Arbiter
from planner.executor.executor import Executor
from planner.executor.exploration import explore, look_at
from planner.executor.job import Job, JobState
from planner.tasks.tasks import StepStatus
from scene_graph.edges import HasEdge, HasIntentionEdge, IntentionAction, IntentionStatus, Priority
from scene_graph.edits import PutEdge, PutNode, RemoveEdge
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import AffordanceKind, AffordanceNode
from skills.failures import Failure, FailureCode

TASK = "task:task_1"


def intention(action=IntentionAction.LOOK, target="table_1", agent="objects", status=IntentionStatus.GRANTED, **fields):
    priority = fields.pop("priority", Priority.LOOK_AROUND)
    fields |= {"source": "robot", "target": target, "agent": agent, "action": action}
    return HasIntentionEdge(status=status, priority=priority, **fields)


def task_intention(status=IntentionStatus.GRANTED):
    return intention(IntentionAction.TASK, "robot", TASK, status, priority=Priority.REQUEST)


class Rig:
    """An executor on a still body; every exploration intention is two scripted actions."""

    def __init__(self, script: Script | None = None) -> None:
        self.memory = WorkingMemory(rehearsal_graph())
        self.stage = Stage(memory=self.memory)
        self.body, self.events, self.made = StillBody(), [], []
        self.script = script or Script()
        self.executor = Executor(self.memory, self.body, self.body, explore=self.actions, on_event=self.events.append)
        self.arbiter = Arbiter(self.memory, stopped=lambda: self.body.stopped)
        self.stamp_s = 0.0

    def actions(self, edge, context):
        outcomes = [self.script.next("first"), self.script.next("second")]
        made = [
            ScriptedAction(name, context, ticks=self.script.ticks, outcome=outcome, drives=True)
            for name, outcome in zip(("first", "second"), outcomes, strict=True)
        ]
        self.made.append(made)
        return made

    def job(self, **options):
        return Job("job", self.actions(None, self.executor.context), **options)

    def put(self, *edges):
        self.memory.commit([PutEdge(edge) for edge in edges], agent="test", stamp_s=self.stamp_s)

    def drop(self, edge):
        self.memory.commit([RemoveEdge(edge.key)], agent="test", stamp_s=self.stamp_s)

    def status(self, edge):
        return self.memory.snapshot().edge(edge.key).status

    def run(self, ticks=1):
        for _ in range(ticks):
            self.stamp_s = round(self.stamp_s + 0.05, 3)
            asyncio.run(self.executor.step(self.stamp_s))

    @property
    def names(self):
        return [event["event"] for event in self.events]


def test_a_granted_intention_is_carried_out_and_marked_done():
    rig, edge = Rig(), intention()
    rig.put(edge)
    rig.run(20)
    assert rig.status(edge) is IntentionStatus.DONE
    assert rig.names == ["started", "action", "action", "succeeded"]
    assert rig.body.drives[-1] == (0.0, 0.0)


def test_a_failed_action_marks_the_intention_failed_with_code_and_reason():
    rig, edge = Rig(Script(outcomes={"second": [FailureCode.WAY_BLOCKED]})), intention()
    rig.put(edge)
    rig.run(20)
    failed = rig.memory.snapshot().edge(edge.key)
    assert failed.status is IntentionStatus.FAILED
    assert failed.reason.startswith("way_blocked: ")
    assert not rig.body.moving


@given(st.integers(0, 14), st.sampled_from(["revoked", "removed", "stopped"]))
def test_at_whatever_tick_it_is_cut_off_the_base_stands_still_from_the_next_tick_on(tick, how):
    rig, edge = Rig(), intention()
    rig.put(edge)
    rig.run(tick)
    if how == "stopped":
        rig.body.stop()
    elif how == "removed":
        rig.drop(edge)
    elif rig.status(edge) is IntentionStatus.GRANTED:
        rig.put(intention(status=IntentionStatus.REVOKED))
    rig.run(1)
    assert not rig.body.moving
    sent = len(rig.body.drives)
    rig.run(10)
    assert all(drive == (0.0, 0.0) for drive in rig.body.drives[sent:])


@given(st.lists(st.integers(1, 9), min_size=1, max_size=4))
def test_however_often_it_is_stopped_the_interrupted_action_starts_again_and_finished_ones_do_not(pauses):
    rig, edge = Rig(), intention()
    rig.put(edge)
    for ticks in pauses:
        rig.run(ticks)
        rig.body.stop()
        rig.run(2)
        assert rig.executor.stopped
        rig.body.release_stop()
    rig.run(20)
    assert rig.status(edge) is IntentionStatus.DONE
    first, second = rig.made[0]
    assert 2 <= first.begun + second.begun <= 2 + len(pauses)
    assert len(rig.made) == 1


def test_while_stopped_nothing_is_ticked_and_nothing_is_sent():
    rig = Rig()
    rig.put(intention())
    rig.run(3)
    rig.body.stop()
    rig.run(1)
    sent = len(rig.body.drives)
    rig.run(10)
    assert len(rig.body.drives) == sent
    assert rig.names[-2:] == ["stopped", "interrupted"]


def test_interrupted_exploration_is_planned_anew_from_where_the_robot_is_then():
    rig, edge = Rig(), intention()
    rig.put(edge)
    rig.run(3)
    rig.put(intention(status=IntentionStatus.REVOKED))
    rig.run(2)
    rig.put(edge)
    rig.run(20)
    assert len(rig.made) == 2
    assert rig.status(edge) is IntentionStatus.DONE


def test_a_tasks_job_waits_for_its_grant_and_is_taken_up_again_after_a_revocation():
    rig = Rig()
    rig.run()
    job = rig.job()
    rig.executor.assign(TASK, job)
    rig.run(5)
    assert job.state is JobState.WAITING
    rig.put(task_intention())
    rig.run(8)
    rig.put(task_intention(IntentionStatus.REVOKED))
    rig.run(2)
    assert job.state is JobState.WAITING
    assert [report.status for report in job.reports()] == [StepStatus.SUCCEEDED, StepStatus.PENDING]
    rig.put(task_intention())
    rig.run(10)
    assert job.state is JobState.SUCCEEDED
    assert [action.begun for action in rig.made[0]] == [1, 2]
    assert rig.status(task_intention()) is IntentionStatus.GRANTED


def test_a_job_of_another_task_is_not_ticked():
    rig = Rig()
    rig.put(task_intention())
    rig.run()
    job = rig.job()
    rig.executor.assign("task:task_2", job)
    rig.run(5)
    assert job.state is JobState.WAITING


def test_an_unwanted_job_pauses_and_goes_on_when_it_is_wanted_again():
    rig, wanted = Rig(), True
    rig.put(task_intention())
    rig.run()
    job = rig.job(wanted=lambda: wanted)
    rig.executor.assign(TASK, job)
    rig.run(3)
    wanted = False
    rig.run(5)
    assert not rig.body.moving
    active_s = job.active_s
    rig.run(5)
    assert job.active_s == active_s
    wanted = True
    rig.run(15)
    assert job.state is JobState.SUCCEEDED


def test_a_watch_ends_the_job_before_the_tick():
    rig = Rig()
    rig.put(task_intention())
    rig.run()
    lost = Failure(code=FailureCode.OBJECT_GONE, message="gone")
    job = rig.job(watch=lambda job: lost if job.active_s > 0.2 else None)
    rig.executor.assign(TASK, job)
    rig.run(8)
    assert (job.state, job.failure) == (JobState.FAILED, lost)
    assert not rig.body.moving


def test_a_job_times_out_by_the_time_it_was_ticked():
    rig = Rig(Script(ticks=1000))
    rig.put(task_intention())
    rig.run()
    job = rig.job(timeout_s=1.0)
    rig.executor.assign(TASK, job)
    rig.run(10)
    rig.body.stop()
    rig.run(100)
    rig.body.release_stop()
    rig.run(5)
    assert not job.ended
    rig.run(10)
    assert job.failure.code is FailureCode.TIMEOUT


@pytest.mark.parametrize("ticks", [0, 1, 5])
def test_a_silent_body_fails_the_job_and_the_executor_goes_on(ticks):
    rig, edge = Rig(), intention()
    rig.put(edge)
    rig.run(1 + ticks)
    rig.body.silent = True
    rig.run(5)
    assert rig.executor.body_silent
    assert rig.names.count("body_silent") == 1
    failed = rig.memory.snapshot().edge(edge.key)
    assert failed.reason.startswith("body_silent: ")
    rig.body.silent = False
    rig.put(edge)
    rig.run(20)
    assert rig.status(edge) is IntentionStatus.DONE


def test_an_abandoned_job_leaves_no_drive_command():
    rig = Rig()
    rig.put(task_intention())
    rig.run()
    job = rig.job()
    rig.executor.assign(TASK, job)
    rig.run(3)
    job.abandon()
    rig.run(1)
    assert not rig.body.moving
    assert rig.executor.job is None


def test_an_action_that_meets_a_vanished_node_fails_with_the_evidence():
    rig = Rig()
    rig.put(task_intention())
    rig.run()
    job = Job("job", [Vanishing("look", rig.executor.context, ticks=2)])
    rig.executor.assign(TASK, job)
    rig.run(3)
    assert job.failure.code is FailureCode.OBJECT_GONE
    assert "cup_9" in job.failure.evidence.observation


def test_an_intention_whose_actions_cannot_be_made_fails_with_the_evidence():
    rig, edge = Rig(), intention()
    rig.executor = Executor(
        rig.memory, rig.body, rig.body, explore=lambda edge, context: [context.snapshot.node("cup_9")]
    )
    rig.put(edge)
    rig.run(2)
    assert rig.memory.snapshot().edge(edge.key).reason.startswith("object_gone: ")


class Vanishing(ScriptedAction):
    """Looks for a node that is not there."""

    def step(self):
        self.context.snapshot.node("cup_9")
        return super().step()


def test_the_events_of_two_runs_are_the_same():
    logs = []
    for _ in range(2):
        rig = Rig()
        rig.put(intention())
        rig.run(4)
        rig.body.stop()
        rig.run(2)
        rig.body.release_stop()
        rig.run(20)
        logs.append(rig.events)
    assert logs[0] == logs[1]
    assert all(set(event) >= {"stamp_s", "by", "event"} for event in logs[0])


def names_of(actions):
    return [action.name for action in actions]


def test_exploration_goes_through_doors_crosses_and_looks():
    rig = Rig()
    rig.run()
    context = rig.executor.context
    visit = names_of(explore(intention(IntentionAction.VISIT, "desk_1", standoff_m=0.8), context))
    assert "cross door_1_0_0" in visit
    assert visit[-1] == "drive to desk_1"
    look = names_of(explore(intention(IntentionAction.LOOK, "table_1"), context))
    accounting = "account for what is at table_1"
    assert look[-4:] == ["look at table_1", accounting, "see table_1 from elsewhere", accounting]
    assert names_of(explore(intention(IntentionAction.LOOK, "room_1"), context))[-1] == "look around"
    affordance = AffordanceNode(id="aff_cross_1_0_0", kind=AffordanceKind.CROSS, target="door_1_0_0")
    has = HasEdge(source="door_1_0_0", target=affordance.id)
    rig.memory.commit([PutNode(affordance), PutEdge(has)], agent="test", stamp_s=0.0)
    assert names_of(explore(intention(IntentionAction.CROSS, affordance.id), context))[-1] == "cross door_1_0_0"


@pytest.mark.parametrize(
    ("action", "target"),
    [(IntentionAction.VISIT, "cup_9"), (IntentionAction.CROSS, "table_1"), (IntentionAction.TASK, "robot")],
)
def test_an_intention_that_makes_no_sense_is_refused_with_a_reason(action, target):
    rig = Rig()
    rig.run()
    job = Job("job", explore(intention(action, target), rig.executor.context))
    job.advance(0.05)
    assert job.failure.code is FailureCode.UNREACHABLE
    assert target in job.failure.message or action is IntentionAction.TASK


def test_looking_at_something_that_is_gone_is_refused():
    rig = Rig()
    rig.run()
    job = Job("job", look_at("cup_9", rig.executor.context))
    job.advance(0.05)
    assert job.failure.evidence.nodes == ("cup_9",)
