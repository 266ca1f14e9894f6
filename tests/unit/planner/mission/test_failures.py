"""Whatever goes wrong on the way is named, and tried again as often as makes sense."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.doubles.rehearsal import GRIPPER
from planner.doubles.scripted import PHANTOM, Script, ScriptedInterpreter
from planner.mission.mission import Mission
from planner.tasks.tasks import StepStatus, TaskStatus
from rehearsed_mission import MEANINGS, Show, turn_up
from scene_graph.edges import InEdge, RelationEdge
from scene_graph.edits import PutEdge, PutNode
from scene_graph.nodes import DoorState, ObjectNode
from skills.failures import FailureCode


def test_an_empty_grasp_is_tried_again_and_three_are_too_many():
    show = Show(Script(outcomes={"PICK": [FailureCode.GRASP_EMPTY]}))
    assert show.finish().status is TaskStatus.SUCCEEDED
    assert show.codes == ["grasp_empty"]
    show = Show(Script(outcomes={"PICK": [FailureCode.GRASP_EMPTY] * 9}))
    task = show.finish()
    assert task.status is TaskStatus.FAILED
    assert show.codes == ["grasp_empty"] * 3
    assert "I tried 3 times" in task.explanation


def test_motors_that_report_a_place_which_perception_does_not_see_never_succeed():
    show = Show(Script(outcomes={"PLACE": [PHANTOM] * 20}))
    task = show.finish()
    assert task.status is TaskStatus.FAILED
    assert show.stage.places["bottle_1"] == GRIPPER
    assert "I am still holding the blue bottle" in task.explanation


def test_a_robot_that_sees_nothing_never_succeeds():
    show = Show()
    show.ask()
    show.until_step("PLACE")
    show.stage.blind = True
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.stage.places["bottle_1"] == "desk_1"
    assert show.task.status is TaskStatus.FAILED


def test_a_goal_that_seems_to_hold_already_is_looked_at_before_it_counts():
    show = Show()
    show.ask("leave it")
    show.run(6)
    assert show.task.status is TaskStatus.RUNNING
    assert show.task.plan.steps == ()
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.SUCCEEDED
    assert show.stage.robot_at == "table_1"
    show = Show()
    show.stage.places["bottle_1"] = "desk_1"
    show.ask("leave it")
    show.run_until(lambda: show.task.status.ended)
    assert show.stage.places["bottle_1"] == "table_1"
    assert show.task.failures != ()


def test_a_dropped_object_is_picked_up_again():
    show = Show()
    show.ask()
    show.until_step("PICK", StepStatus.SUCCEEDED)
    show.stage.places["bottle_1"] = show.stage.robot_at
    show.run_until(lambda: show.task.status.ended)
    assert show.codes == ["dropped"]
    assert show.task.status is TaskStatus.SUCCEEDED


def test_what_keeps_the_robot_from_looking_is_the_reason_and_not_that_it_saw_nothing():
    show = Show(Script(outcomes={"LOOK": [FailureCode.WAY_BLOCKED] * 9}))
    show.stage.robot_at = "desk_1"
    show.ask("leave it")
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.task.status is TaskStatus.FAILED
    assert set(show.codes) == {"way_blocked"}


def test_an_object_that_slipped_away_unseen_is_searched():
    show = Show(Script(ticks=20))
    show.ask()
    show.until_step("PICK", StepStatus.SUCCEEDED)
    show.stage.places["bottle_1"] = "shelf_1"
    show.run_until(lambda: show.task.status.ended)
    assert show.codes[0] == "slipped"
    assert show.task.status is TaskStatus.SUCCEEDED


def test_a_door_closed_on_the_way_is_reported_and_no_other_way_ends_the_task():
    show = Show(Script(ticks=40))
    show.ask()
    show.until_step("PICK", StepStatus.SUCCEEDED)
    show.run(10)
    door = show.memory.snapshot().door("door_1_0_0")
    show.memory.commit([PutNode(replace(door, state=DoorState.CLOSED))], agent="doors", stamp_s=show.stamp_s)
    show.run_until(lambda: show.task.status.ended)
    assert show.codes == ["door_closed"]
    assert show.task.status is TaskStatus.FAILED
    assert "the door between the kitchen and the office" in show.task.explanation
    assert "still holding" in show.task.explanation


@pytest.mark.parametrize("sensor", ["lidar", "camera"])
def test_a_silent_sensor_is_waited_for_and_named(sensor):
    show = Show()
    show.ask()
    show.until_step("GOTO")
    show.ages[sensor] = 9.0
    show.run(4)
    assert show.codes == ["sensor_silent"]
    assert sensor in show.task.failures[0].message
    show.ages[sensor] = 0.0
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.SUCCEEDED


def test_a_silent_body_is_waited_for():
    show = Show()
    show.ask()
    show.until_step("GOTO")
    show.body.silent = True
    show.run(10)
    show.body.silent = False
    show.run_until(lambda: show.task.status.ended)
    assert show.codes == ["body_silent"]
    assert show.task.status is TaskStatus.SUCCEEDED


def test_at_most_the_allowed_number_of_failures_is_met():
    codes = [FailureCode.WAY_BLOCKED, FailureCode.TIMEOUT, FailureCode.UNREACHABLE, FailureCode.ROBOT_MOVED] * 3
    show = Show(Script(outcomes={"GOTO": codes}), max_failures=3)
    assert show.finish().status is TaskStatus.FAILED
    assert len(show.codes) <= 4


@pytest.mark.parametrize(
    ("skill", "code", "looked_at"),
    [
        ("PLACE", FailureCode.SUPPORT_FULL, ["desk_1"]),
        ("PICK", FailureCode.UNREACHABLE, ["bottle_1"]),
        ("PICK", FailureCode.GRASP_EMPTY, []),
    ],
)
def test_what_was_in_the_way_is_looked_at_once_more_before_the_next_go(skill, code, looked_at):
    show = Show(Script(outcomes={skill: [code]}))
    look_at, looks = show.resources.look_at, []

    def look(node_id, context):
        looks.append(node_id)
        return look_at(node_id, context)

    show.mission = Mission(replace(show.resources, look_at=look), ScriptedInterpreter(MEANINGS))
    assert show.finish().status is TaskStatus.SUCCEEDED
    assert show.codes == [code]
    assert looks == looked_at


def test_a_support_that_is_seen_to_be_full_after_a_failed_go_is_the_reason_that_is_given():
    show = Show(Script(outcomes={"PLACE": [FailureCode.UNREACHABLE]}))
    look_at = show.resources.look_at

    def look(node_id, context):
        desk = show.memory.snapshot().object("desk_1")
        crate = ObjectNode(id="crate_1", label="crate", size_m=(*desk.size_m[:2], 0.3), last_seen_s=show.stamp_s)
        there = replace(show.memory.snapshot().parent("desk_1"), target="crate_1")
        on_it = RelationEdge(source="crate_1", target="desk_1", predicate="on", probability=0.95)
        edits = [PutNode(crate), PutEdge(there), PutEdge(InEdge(source="crate_1", target="room_2")), PutEdge(on_it)]
        show.memory.commit(edits, agent="objects", stamp_s=show.stamp_s)
        return look_at(node_id, context)

    show.mission = Mission(replace(show.resources, look_at=look), ScriptedInterpreter(MEANINGS))
    assert show.finish().status is TaskStatus.FAILED
    assert show.codes == [FailureCode.UNREACHABLE, FailureCode.SUPPORT_FULL]
    assert "full" in show.task.explanation


@pytest.mark.parametrize("knocked_off", [True, False])
def test_what_was_put_down_first_is_looked_at_again_when_the_hand_was_there_again(knocked_off):
    show = Show()
    turn_up(show)
    look_at, see, hidden, looks = show.resources.look_at, show.stage._see, set(), []

    def look(node_id, context):
        looks.append(node_id)
        hidden.discard(node_id)
        return look_at(node_id, context)

    show.mission = Mission(replace(show.resources, look_at=look), ScriptedInterpreter(MEANINGS))
    show.stage._see = lambda name, snapshot, stamp_s: [] if name in hidden else see(name, snapshot, stamp_s)
    show.ask("bring both")
    show.run_until(lambda: show.stage.places["bottle_2"] == GRIPPER)
    assert show.stage.places["bottle_1"] == "desk_1"
    hidden.add("bottle_1")
    if knocked_off:
        show.stage.places["bottle_1"] = None
    show.run_until(lambda: show.task.status.ended)
    assert looks[0] == "bottle_1"
    assert (looks == ["bottle_1"]) is not knocked_off
    assert show.task.status is (TaskStatus.FAILED if knocked_off else TaskStatus.SUCCEEDED)
