"""Scouting: what was never seen is looked for before a request for it is turned down."""

from __future__ import annotations

from dataclasses import replace

import pytest

from planner.doubles.rehearsal import rehearsal_graph
from planner.goals import goal
from planner.grounding.unlabeled import likely_label
from planner.language.grammar.parser import CommandGrammar
from planner.mission.mission import Mission
from planner.plan import Dialogue, Interpretation, Kind
from planner.skill_planner.scouting import Scout, kinds_called
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from planner.tasks.approval import Approval
from planner.tasks.tasks import TaskStatus
from rehearsed_mission import BRING, ON_DESK, Show
from scene_graph.edges import InEdge, RtEdge
from scene_graph.edits import PutEdge, PutNode, RemoveNode
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import UNKNOWN_LABEL, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.registry import load_registry

REFUSAL, MISTAKEN = "I know of no bottle.", "vase"


class Nearsighted:
    """Knows of no bottle until it is seen for one."""

    async def interpret(self, text, snapshot, dialogue):
        del text, dialogue
        if snapshot.object("bottle_1").label == MISTAKEN:
            return Interpretation(kind=Kind.REFUSE, reply=REFUSAL, sought="bottle")
        return Interpretation(kind=Kind.PLAN, goals=(ON_DESK,))


def show_of(place="table_1", recognizable=("bottle",)):
    """A rehearsal in which the bottle is taken for something else."""
    show = Show()
    show.resources = replace(show.resources, recognizable=frozenset(recognizable))
    show.mission = Mission(show.resources, Nearsighted())
    call(show, MISTAKEN)
    show.stage.places["bottle_1"] = place
    return show


def call(show, label):
    distribution = ((label, 0.95),)
    node = replace(show.memory.snapshot().object("bottle_1"), label=label, label_distribution=distribution)
    show.memory.commit([PutNode(node)], agent="objects", stamp_s=show.stamp_s)


@pytest.mark.parametrize("seen_from", ["room_1", "table_1", "desk_1"])
def test_what_was_never_seen_is_looked_for_and_brought(seen_from):
    show = show_of()
    show.ask()
    show.run_until(lambda: show.task.plan is not None and show.task.plan.source == "search")
    assert "I have not seen “bottle” yet" in show.task.explanation
    show.run_until(lambda: show.stage.robot_at == seen_from)
    call(show, "bottle")
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.SUCCEEDED
    assert show.stage.places["bottle_1"] == "desk_1"
    assert show.task.plan.source == "grammar"
    assert show.task.failures == ()


def test_what_is_nowhere_is_refused_with_where_it_was_looked_for():
    show = show_of()
    task = show.finish()
    assert task.status is TaskStatus.REFUSED
    assert task.explanation.startswith(REFUSAL)
    for place in ("the shelf in the kitchen", "the desk in the office", "the table in the kitchen", "the kitchen"):
        assert place in task.explanation
    assert show.stage.places["bottle_1"] == "table_1"
    assert not any(edge.agent.startswith("task") for edge in show.memory.snapshot().intentions())


@pytest.mark.parametrize("options", [{"dry_run": True}, {"approval": Approval.ASK}])
def test_nothing_moves_unasked(options):
    show = show_of()
    task = show.finish(**options)
    assert (task.status, task.explanation) == (TaskStatus.REFUSED, REFUSAL)
    assert show.body.drives == []


def test_what_the_robot_would_not_recognize_is_refused_at_once():
    show = show_of(recognizable=("cup",))
    task = show.finish()
    assert (task.status, task.explanation) == (TaskStatus.REFUSED, REFUSAL)
    assert show.body.drives == []


def test_while_another_task_has_the_robot_the_search_waits_its_turn():
    show = show_of()
    show.ask()
    show.run_until(lambda: show.task.plan is not None)
    show.ask()
    show.run(10)
    assert show.queue.task("task_2").status is TaskStatus.QUEUED
    show.run_until(lambda: show.stage.robot_at == "table_1")
    call(show, "bottle")
    show.run_until(lambda: show.queue.task("task_2").status.ended)
    assert [task.status for task in show.queue.tasks] == [TaskStatus.SUCCEEDED] * 2


@pytest.mark.parametrize("ticks", range(4, 120, 23))
def test_cancelled_at_any_time_the_search_ends_and_the_next_task_runs(ticks):
    show = show_of()
    show.ask()
    show.run(ticks)
    show.queue.cancel("task_1", stamp_s=show.stamp_s)
    show.run(4)
    assert not show.body.moving
    show.stage.stand_at("desk_1", show.stamp_s)
    call(show, "bottle")
    show.ask(BRING)
    show.run_until(lambda: show.queue.task("task_2").status.ended)
    assert show.queue.task("task_2").status is TaskStatus.SUCCEEDED


@pytest.mark.parametrize(
    ("request_", "sought"),
    [
        ("bring the remote to the desk", "remote"),
        ("bring the red bottle to the desk", "bottle"),
        ("take the cups to the office", "cup"),
        ("find the keys", "key"),
        ("go to the office and then take the remote to the kitchen", "remote"),
        ("where is the remote?", ""),
        ("put the bottle on the sofa", ""),
        ("go to the garage", ""),
        ("bring the bottle to the desk", ""),
        ("give the bottle to Anna", ""),
    ],
)
def test_a_thing_to_be_moved_or_found_that_nobody_has_seen_is_sought_and_nothing_else(request_, sought):
    planner = TaskPlanner(CommandGrammar(), Verifier(load_registry(more=())))
    meaning = planner.read(request_, rehearsal_graph(), Dialogue()).interpretation
    assert meaning.sought == sought
    assert not sought or meaning.kind is Kind.REFUSE


@pytest.mark.parametrize("request_", ["bring me the bottle", "give me the bottle", "come to me", "come here"])
def test_who_asks_for_something_and_is_not_seen_is_sought(request_):
    graph = rehearsal_graph()
    people = [person.id for person in graph.of_type(PersonNode)]
    memory = WorkingMemory(graph)
    memory.commit([RemoveNode(person) for person in people], agent="objects", stamp_s=1.0)
    planner = TaskPlanner(CommandGrammar(), Verifier(load_registry(more=())))
    meaning = planner.read(request_, memory.snapshot(), Dialogue()).interpretation
    assert (meaning.kind, meaning.sought) == (Kind.REFUSE, "person")


class Lonely:
    """Gives the bottle to whoever is there."""

    async def interpret(self, text, snapshot, dialogue):
        del text, dialogue
        people = snapshot.of_type(PersonNode)
        if not people:
            return Interpretation(kind=Kind.REFUSE, reply="I see nobody.", sought="person")
        return Interpretation(kind=Kind.PLAN, goals=(goal("given", "bottle_1", people[0].id),))


@pytest.mark.parametrize("comes", [True, False])
def test_who_is_seen_on_the_way_is_given_what_they_asked_for_and_rooms_are_looked_through_once(comes):
    show = Show()
    show.resources = replace(show.resources, recognizable=frozenset({"person"}))
    show.mission = Mission(show.resources, Lonely())
    people = [person.id for person in show.memory.snapshot().of_type(PersonNode)]
    show.memory.commit([RemoveNode(person) for person in people], agent="objects", stamp_s=0.0)
    show.ask()
    show.run_until(lambda: show.task.plan is not None and show.task.plan.source == "search")
    assert show.task.explanation.startswith("I do not know where you are; I will look for you in ")
    places = [step.args[0] for step in show.task.plan.steps]
    assert sorted(places) == [room.id for room in show.memory.snapshot().of_type(RoomNode)]
    if comes:
        show.run_until(lambda: show.stage.robot_at == places[0])
        edges = [RtEdge(source=places[0], target="person_1", T_source_target=SE3.from_xyz_yaw(0.5, 0.5, 0.0, 0.0))]
        edits = [PutNode(PersonNode(id="person_1")), *(PutEdge(edge) for edge in edges)]
        edits.append(PutEdge(InEdge(source="person_1", target=places[0])))
        show.memory.commit(edits, agent="objects", stamp_s=show.stamp_s)
        show.run_until(lambda: show.task.plan.source == "grammar")
        assert [str(each) for each in show.task.plan.goals] == ["given(bottle_1, person_1)"]
    else:
        show.run_until(lambda: show.task.status.ended)
        assert show.task.status is TaskStatus.REFUSED
        assert show.task.explanation.endswith("and did not find anybody.")


def test_a_tour_looks_from_near_at_what_has_no_name_and_never_twice_at_a_place():
    verifier = Verifier(load_registry(more=()))
    graph = rehearsal_graph()
    nameless = replace(graph.object("bottle_1"), label=UNKNOWN_LABEL)
    snapshot = Snapshot.of([nameless, *(n for i, n in graph.nodes.items() if i != "bottle_1")], graph.edges.values())
    scout = Scout("cup", verifier, stamp_s=0.0)
    places = [step.args[0] for step in scout.tour(snapshot).steps]
    assert len(places) == len(set(places))
    assert set(places) == {"bottle_1", "table_1", "shelf_1", "desk_1", "room_1", "room_2"}
    scout.search_for("cup").looked.extend(places)
    assert scout.tour(snapshot) is None
    assert "6 places in the kitchen and the office" in scout.told(snapshot)


class Guessing:
    """Takes what has no name for the bottle while that is likely, and says so when it is not."""

    async def interpret(self, text, snapshot, dialogue):
        del text, dialogue
        if likely_label(snapshot.object("bottle_1")) == "bottle":
            return Interpretation(kind=Kind.PLAN, goals=(ON_DESK,))
        return Interpretation(kind=Kind.REFUSE, reply=REFUSAL)


class Leaving:
    """Wants the bottle where it is anyway, as long as anything is called so."""

    async def interpret(self, text, snapshot, dialogue):
        del text, dialogue
        if snapshot.object("bottle_1").label == "bottle":
            return Interpretation(kind=Kind.PLAN, goals=(goal("on", "bottle_1", "table_1"),))
        return Interpretation(kind=Kind.REFUSE, reply=REFUSAL)


def guess(show, chance):
    bottle = show.memory.snapshot().object("bottle_1")
    unsure = (("bottle", chance), (UNKNOWN_LABEL, 1.0 - chance))
    node = replace(bottle, label=UNKNOWN_LABEL, label_distribution=unsure)
    show.memory.commit([PutNode(node)], agent="objects", stamp_s=show.stamp_s)


@pytest.mark.parametrize(
    ("step", "chance", "status"),
    [
        ("GOTO", 0.4, TaskStatus.SUCCEEDED),
        ("GOTO", 0.2, TaskStatus.FAILED),
        ("GOTO", 0.02, TaskStatus.REFUSED),
        ("PLACE", 0.02, TaskStatus.FAILED),
    ],
)
def test_what_was_guessed_to_be_the_thing_and_is_not_is_never_said_to_be_it(step, chance, status):
    show = Show()
    show.mission = Mission(show.resources, Guessing())
    guess(show, 0.4)
    show.ask()
    show.until_step(step)
    guess(show, chance)
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is status
    if status is not TaskStatus.SUCCEEDED:
        assert show.codes == ["object_gone"]
        assert "what might have been a bottle" in show.task.failures[0].message


def test_when_what_was_found_turns_out_to_be_something_else_the_search_goes_on():
    show = show_of()
    show.ask()
    show.run_until(lambda: show.task.plan is not None and show.task.plan.source == "search")
    show.run_until(lambda: show.stage.robot_at == "table_1")
    call(show, "bottle")
    show.run_until(lambda: show.task.plan.source != "search")
    call(show, MISTAKEN)
    show.run_until(lambda: show.task.plan.source == "search" or show.task.status.ended)
    assert show.codes == ["object_gone"]
    assert "what I took for a bottle is a vase" in show.task.failures[0].message
    show.run_until(lambda: show.task.status.ended, limit=20_000)
    assert show.task.status is TaskStatus.REFUSED
    assert "I looked at" in show.task.explanation


def test_what_loses_its_name_when_it_is_seen_from_near_is_not_said_to_be_it():
    show = Show()
    show.mission = Mission(show.resources, Leaving())
    show.ask("leave the bottle on the table")
    show.run_until(lambda: show.task.status is TaskStatus.RUNNING)
    guess(show, 0.02)
    show.run_until(lambda: show.task.status.ended)
    assert show.task.status is TaskStatus.REFUSED
    assert show.codes == ["object_gone"]


def test_a_word_is_any_label_that_it_may_mean():
    assert {"cup", "mug"} <= kinds_called("mug")
