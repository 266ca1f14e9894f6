"""What looks like a lost thing and turned up later, and what words about its place mean then."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.doubles.rehearsal import GRIPPER
from planner.goals import goal
from planner.language.grammar.parser import CommandGrammar
from planner.mission.mission import Mission
from planner.plan import Interpretation, Kind
from planner.task_planner.task_planner import TaskPlanner
from planner.tasks.tasks import TaskStatus
from rehearsed_mission import Show, turn_up
from scene_graph.edits import PutNode
from scene_graph.nodes import ObjectNode, ObjectState


class ByName:
    """Means the bottle that is there rather than one that is missing."""

    async def interpret(self, text, snapshot, dialogue):
        del text, dialogue
        bottles = [node for node in snapshot.of_type(ObjectNode) if node.label == "bottle"]
        there = [node.id for node in bottles if node.state is ObjectState.PRESENT] or [node.id for node in bottles]
        return Interpretation(kind=Kind.PLAN, goals=(goal("on", there[-1], "desk_1"),))


def talked_to():
    """A show whose robot reads what is asked."""
    show = Show()
    show.mission = Mission(show.resources, TaskPlanner(CommandGrammar(), show.resources.verifier, None))
    return show


@pytest.mark.parametrize(("color", "status"), [("blue", TaskStatus.SUCCEEDED), ("red", TaskStatus.FAILED)])
def test_what_looks_like_a_lost_thing_and_turned_up_later_is_taken_for_it(color, status):
    show = Show()
    show.mission = Mission(show.resources, ByName())
    show.ask()
    show.until_step("GOTO")
    show.stage.places["bottle_1"] = None
    show.run_until(lambda: show.task.plan.source == "search" and show.stage.robot_at == "desk_1")
    turn_up(show, color=color)
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.task.status is status
    assert (show.stage.places["bottle_2"] == "desk_1") is (status is TaskStatus.SUCCEEDED)


@pytest.mark.parametrize("shelf_is_new", [True, False])
def test_what_stands_on_furniture_that_was_not_known_when_the_lost_was_last_seen_may_always_have_stood_there(
    shelf_is_new,
):
    show = Show()
    show.mission = Mission(show.resources, ByName())
    show.ask()
    show.until_step("GOTO")
    show.stage.places["bottle_1"] = None
    show.run_until(lambda: show.task.plan.source == "search" and show.stage.robot_at == "desk_1")
    shelf = show.memory.snapshot().object("shelf_1")
    first_seen_s = show.stamp_s if shelf_is_new else shelf.first_seen_s
    show.memory.commit([PutNode(replace(shelf, first_seen_s=first_seen_s))], agent="objects", stamp_s=show.stamp_s)
    turn_up(show)
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.task.status is (TaskStatus.FAILED if shelf_is_new else TaskStatus.SUCCEEDED)


def test_what_looks_like_a_lost_thing_and_was_known_before_anybody_asked_is_not_taken_for_it():
    show = Show()
    show.mission = Mission(show.resources, ByName())
    show.run_until(lambda: show.stamp_s > 3.0)
    show.ask()
    show.until_step("GOTO")
    show.stage.places["bottle_1"] = None
    show.run_until(lambda: show.task.plan.source == "search" and show.stage.robot_at == "desk_1")
    lost = replace(show.memory.snapshot().object("bottle_1"), last_seen_s=1.0)
    show.memory.commit([PutNode(lost)], agent="objects", stamp_s=show.stamp_s)
    turn_up(show, first_seen_s=2.0)
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.task.status is TaskStatus.FAILED
    assert show.stage.places["bottle_2"] == "shelf_1"


@pytest.mark.parametrize("where", ["from the table", "on the table"])
def test_a_request_that_says_where_a_thing_was_means_it_where_it_has_been_put_since(where):
    show = talked_to()
    show.ask(f"bring the bottle {where} to the desk")
    show.until_step("GOTO")
    show.stage.places["bottle_1"] = None
    show.run_until(lambda: show.task.plan.source == "search" and show.stage.robot_at == "desk_1")
    turn_up(show)
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.task.status is TaskStatus.SUCCEEDED, show.task.explanation
    assert show.stage.places["bottle_2"] == "desk_1"


def test_what_was_not_lost_is_held_to_the_words_about_its_place():
    show = talked_to()
    turn_up(show, color="red", first_seen_s=-5.0)
    show.ask("bring the bottle from the table to the desk")
    show.until_step("GOTO")
    show.stage.places["bottle_1"] = None
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.task.status is TaskStatus.FAILED
    assert show.stage.places["bottle_2"] == "shelf_1"


def test_who_means_the_very_thing_that_is_lost_has_it_looked_for_whatever_looks_like_it():
    show = Show()
    show.stage.places["bottle_1"] = "desk_1"
    lost = replace(show.memory.snapshot().object("bottle_1"), state=ObjectState.MISSING)
    show.memory.commit([PutNode(lost)], agent="objects", stamp_s=0.0)
    turn_up(show, first_seen_s=1.0)
    show.ask("take it")
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.task.status is TaskStatus.SUCCEEDED
    assert show.stage.places["bottle_1"] == GRIPPER
