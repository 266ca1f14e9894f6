"""The mission: from a request to an outcome that perception has confirmed."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.doubles.scripted import Script, ScriptedInterpreter
from planner.mission.mission import Mission
from planner.tasks.tasks import StepStatus, TaskStatus
from rehearsed_mission import MEANINGS, ON_DESK, Show
from scene_graph.edges import HasIntentionEdge, InEdge, IntentionAction, IntentionStatus, Priority, RelationEdge
from scene_graph.edits import PutEdge, PutNode, RemoveEdge
from scene_graph.nodes import ObjectNode
from skills.errors import SkillNotFound
from skills.failures import FailureCode


def test_a_request_is_planned_carried_out_and_confirmed():
    show = Show()
    task = show.finish()
    assert task.status is TaskStatus.SUCCEEDED
    assert show.stage.places["bottle_1"] == "desk_1"
    assert [step.skill for step in task.plan.steps] == ["GOTO", "PICK", "GOTO", "PLACE"]
    assert all(step.status is StepStatus.SUCCEEDED and step.seconds > 0 for step in task.plan.steps)
    assert all(action.status is StepStatus.SUCCEEDED for step in task.plan.steps for action in step.actions)
    assert [(verified.goal, verified.confirmed) for verified in task.verified] == [(ON_DESK, True)]
    assert task.replans == 0
    assert task.failures == ()
    assert "the blue bottle is on the desk in the office" in task.explanation
    assert task.times.received_s <= task.times.planned_s <= task.times.started_s < task.times.ended_s


def test_what_confirms_each_step_is_told_before_the_step_counts_as_done():
    show = Show()
    show.finish()
    told = [event for event in show.events if event["event"] in ("observed", "step_done")]
    assert [event["event"] for event in told] == ["observed", "step_done"] * 4
    assert [event["step"] for event in told[::2]] == [event["step"] for event in told[1::2]]
    seen = [event["seen"] for event in told[::2]]
    assert seen[0].startswith("the robot is at ")
    assert seen[1].startswith("the blue bottle is in my gripper, seen ")
    assert seen[3].startswith("the blue bottle is on the desk in the office, seen ")
    assert all(event["revision"] > 0 for event in told[::2])


def test_after_the_task_its_intention_is_withdrawn_and_exploration_goes_on():
    show = Show(Script(ticks=30))
    look = HasIntentionEdge(
        source="robot", target="shelf_1", agent="objects", action=IntentionAction.LOOK, priority=Priority.LOOK_AROUND
    )
    show.memory.commit([PutEdge(look)], agent="objects", stamp_s=0.0)
    show.run(4)
    show.ask()
    show.until_step("PICK")
    assert show.memory.snapshot().edge(look.key).status is IntentionStatus.REVOKED
    show.run_until(lambda: show.task.status.ended)
    show.run(60)
    assert show.memory.snapshot().edge(look.key).status is IntentionStatus.DONE
    assert [edge.agent for edge in show.memory.snapshot().intentions()] == ["objects"]
    assert not show.granted_twice


def test_a_plan_that_no_longer_fits_the_graph_is_replaced_before_the_next_step():
    show = Show()
    show.ask()
    show.until_step("GOTO", StepStatus.RUNNING)
    cup = ObjectNode(id="cup_1", label="cup", color="red", size_m=(0.06, 0.06, 0.1), graspable=True)
    on_top = RelationEdge(source="cup_1", target="bottle_1", predicate="on", probability=0.9)
    hung = replace(show.memory.snapshot().parent("bottle_1"), target="cup_1")
    edits = [PutNode(cup), PutEdge(hung), PutEdge(InEdge(source="cup_1", target="room_1")), PutEdge(on_top)]
    show.memory.commit(edits, agent="objects", stamp_s=show.stamp_s)
    show.run_until(lambda: show.codes != [] or show.task.status.ended)
    assert show.codes == ["not_confirmed"]
    assert "the red cup stands on the blue bottle" in show.task.failures[0].message
    show.memory.commit([RemoveEdge(on_top.key)], agent="objects", stamp_s=show.stamp_s)
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.SUCCEEDED


def test_a_running_task_whose_execution_is_lost_fails_honestly():
    show = Show()
    show.ask()
    show.until_step("GOTO")
    show.mission = Mission(show.resources, ScriptedInterpreter(MEANINGS))
    show.run(4)
    assert show.task.status is TaskStatus.FAILED
    assert "restarted" in show.task.explanation


def test_skills_are_described_and_unknown_ones_refused():
    planner = Show().resources.skills
    assert [skill["name"] for skill in planner.describe()] == ["GOTO", "PICK", "PLACE"]
    assert all(skill["schema"]["properties"] for skill in planner.describe())
    with pytest.raises(SkillNotFound, match="GOTO"):
        planner.skill("FLY")


def test_ordered_goals_are_each_confirmed_in_their_turn():
    show = Show()
    task = show.finish("go round")
    assert task.status is TaskStatus.SUCCEEDED
    assert [step.args for step in task.plan.steps] == [("room_2",), ("table_1",), ("room_2",)]
    assert all(verified.confirmed for verified in task.verified)


def test_after_a_failure_goals_that_are_over_and_done_with_are_not_done_again():
    show = Show(Script(outcomes={"GOTO": [None, FailureCode.WAY_BLOCKED]}))
    task = show.finish("go round")
    assert task.status is TaskStatus.SUCCEEDED
    assert [step.args for step in task.plan.steps] == [("table_1",), ("room_2",)]


def test_two_runs_of_the_same_mission_log_the_same_events():
    logs = []
    for _ in range(2):
        show = Show(Script(outcomes={"PICK": [FailureCode.GRASP_EMPTY]}))
        show.ask()
        show.until_step("GOTO")
        show.stage.places["bottle_1"] = "shelf_1"
        show.run_until(lambda show=show: show.task.status.ended)
        logs.append(show.events)
    assert logs[0] == logs[1]
    assert {"understood", "planned", "step", "failure", "replan", "ended"} <= {event["event"] for event in logs[0]}
