"""A door that was closed is looked at once more before a request is turned down because of it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from grammar_home import home
from planner.doubles.scripted import Script
from planner.grounding.openness import suppose_not_known
from planner.language.grammar.parser import CommandGrammar
from planner.mission.mission import Mission
from planner.plan import Dialogue, Kind
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from planner.tasks.approval import Approval
from planner.tasks.tasks import TaskStatus
from rehearsed_mission import Show
from scene_graph.edits import PutNode
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import DoorNode, DoorState
from skills.registry import load_registry

TO_THE_OFFICE = "go to the office"
DOORS = ("door_1_0_0", "door_2_0_0")


@pytest.fixture
def show():
    """The robot is in the kitchen and knows the only door to the office as closed."""
    show = Show(Script(ticks=40))
    show.mission = Mission(show.resources, TaskPlanner(CommandGrammar(), show.resources.verifier))
    see(show, DoorState.CLOSED)
    return show


def see(show, state):
    snapshot = show.memory.snapshot()
    edits = [PutNode(replace(snapshot.door(door), state=state)) for door in DOORS]
    show.memory.commit(edits, agent="doors", stamp_s=show.stamp_s)


def states(show):
    return [show.memory.snapshot().door(door).state for door in DOORS]


def test_who_opened_the_door_unseen_and_asks_again_is_obeyed(show):
    task = show.finish(TO_THE_OFFICE)
    assert (task.status, task.failures) == (TaskStatus.SUCCEEDED, ())


def test_a_door_that_is_still_closed_is_reported_after_it_has_been_looked_at_once(show):
    show.ask(TO_THE_OFFICE)
    show.run_until(lambda: show.task.status is TaskStatus.RUNNING)
    show.run(10)
    see(show, DoorState.CLOSED)
    show.run_until(lambda: show.task.status.ended)
    assert (show.task.status, show.codes) == (TaskStatus.FAILED, ["door_closed"])
    assert "is closed, and I cannot open doors" in show.task.explanation
    assert states(show) == [DoorState.CLOSED] * 2


@pytest.mark.parametrize("options", [{"dry_run": True}, {"approval": Approval.ASK}])
def test_nobody_goes_to_look_unasked(show, options):
    task = show.finish(TO_THE_OFFICE, **options)
    assert task.status is TaskStatus.REFUSED
    assert "is closed" in task.explanation
    assert states(show) == [DoorState.CLOSED] * 2


def test_while_another_task_has_the_robot_the_look_waits_its_turn(show):
    show.ask("go to the shelf")
    show.run_until(lambda: show.task.status is TaskStatus.RUNNING)
    second = show.ask(TO_THE_OFFICE)
    show.run(4)
    assert show.queue.task(second.id).status is TaskStatus.QUEUED
    assert states(show) == [DoorState.CLOSED] * 2
    show.run_until(lambda: show.queue.task(second.id).status.ended)
    assert [task.status for task in show.queue.tasks] == [TaskStatus.SUCCEEDED] * 2


@pytest.mark.parametrize(
    ("request_", "doors"),
    [("go to the pantry", 1), ("go to the pantry and bring me the table", 0), ("go to the kitchen", 0)],
)
def test_only_doors_that_alone_are_in_the_way_are_worth_a_look(request_, doors):
    sketch = home().room("room_7", "pantry", at=(-6.0, 0.0))
    snapshot = sketch.door("room_1", "room_7", at=(-3.0, 0.0), state=DoorState.CLOSED).snapshot(
        robot_in="room_2", at=(4.2, 0.0)
    )
    planner = TaskPlanner(CommandGrammar(), Verifier(load_registry([])))
    meaning = planner.read(request_, snapshot, Dialogue()).interpretation
    assert (meaning.kind is Kind.REFUSE) is (request_ != "go to the kitchen")
    assert len(meaning.closed) == doors


def test_both_sides_of_a_door_are_not_known_any_more_and_open_ones_stay_as_they_are():
    snapshot = home().snapshot(robot_in="room_2", at=(4.2, 0.0))
    opened = {door.id for door in snapshot.of_type(DoorNode) if door.state is DoorState.OPEN}
    memory = WorkingMemory(snapshot)
    suppose_not_known([door.id for door in snapshot.of_type(DoorNode)], memory, 1.0)
    after = {door.id: door.state for door in memory.snapshot().of_type(DoorNode)}
    assert {door for door, state in after.items() if state is DoorState.OPEN} == opened
    assert set(after.values()) == {DoorState.OPEN, DoorState.UNKNOWN}
