"""The demonstration: explore, take one request, let a person interfere, and compare the outcome with the truth."""

from __future__ import annotations

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Protocol

from app.runtime import Runtime
from planner.tasks.tasks import StepStatus, Task, TaskStatus
from scene_graph.nodes import DoorNode, ObjectNode, RoomNode
from simulation.process.client import SimulatedRobot

REQUEST = "bring the blue bottle from the kitchen to the desk in the office"
EXPLORATION_LIMIT_S, TASK_LIMIT_S = 1500.0, 1200.0
"""Robot time after which the demonstration gives up: several times as long as it takes."""


class DemoImpossible(RuntimeError):
    """The house lacks what the demonstration needs."""


@dataclass(frozen=True, kw_only=True)
class Scenario:
    """What the person does: ``thing`` goes from where it stands to ``new_place``; it is asked for on ``goal_place``."""

    thing: str
    old_place: str
    new_place: str
    goal_place: str


@dataclass(frozen=True, kw_only=True)
class DemoOutcome:
    """What was reported and what is true. ``reported`` and ``true``: success by the robot's word and by the truth."""

    seed: int
    reported: bool
    true: bool
    replans: int
    sim_seconds: float
    wall_seconds: float
    explored: bool
    disturbed: bool
    task: Task | None
    truth_place: str | None


class Progress(Protocol):
    """Who shows a person how far things are."""

    def exploring(self, rooms: int, doors_done: int, doors: int, objects: int, stamp_s: float) -> None: ...

    def explored(self, stamp_s: float, *, complete: bool) -> None: ...

    def disturbed(self, scenario: Scenario, stamp_s: float) -> None: ...

    def working(self, task: Task) -> None: ...


def scenario_of(truth: Mapping[str, Any], furniture: Mapping[str, tuple[str, str]]) -> Scenario:
    """Choose the thing and the places from the house itself.

    Args:
        truth: the simulator's truth.
        furniture: furniture id -> (category, room label).
    """
    bottles = [
        item
        for item in truth["objects"]
        if item["category"] == "bottle"
        and item["color"] == "blue"
        and furniture.get(item["on"], ("", ""))[1] == "kitchen"
    ]
    desks = [name for name, (category, room) in furniture.items() if category == "desk" and room == "office"]
    tables = [name for name, (category, _) in furniture.items() if category == "table"]
    others = [name for name in tables if bottles and name != bottles[0]["on"]]
    if not bottles or not desks or not others:
        raise DemoImpossible("the house needs a blue bottle in the kitchen, another table, and a desk in the office")
    return Scenario(thing=bottles[0]["id"], old_place=bottles[0]["on"], new_place=others[0], goal_place=desks[0])


async def play(
    runtime: Runtime, robot: SimulatedRobot, furniture: Mapping[str, tuple[str, str]], progress: Progress
) -> DemoOutcome:
    """Play the demonstration on a running runtime."""
    started = time.monotonic()
    complete = await _explore(runtime, progress)
    progress.explored(runtime.now_s, complete=complete)
    scenario = scenario_of(await robot.truth(), furniture)
    task = runtime.orders.submit(REQUEST)
    disturbed = await _work(runtime, robot, task.id, scenario, progress)
    task = runtime.queue.task(task.id)
    place = _place_of(await robot.truth(), scenario.thing)
    return DemoOutcome(
        seed=runtime.settings.seed,
        reported=task.status is TaskStatus.SUCCEEDED,
        true=place == scenario.goal_place,
        replans=task.replans,
        sim_seconds=round(runtime.now_s, 3),
        wall_seconds=round(time.monotonic() - started, 3),
        explored=complete,
        disturbed=disturbed,
        task=task,
        truth_place=place,
    )


async def _explore(runtime: Runtime, progress: Progress) -> bool:
    while runtime.now_s < EXPLORATION_LIMIT_S:
        await runtime.wait_for_change()
        snapshot = runtime.memory.building()
        doors = snapshot.of_type(DoorNode)
        done = sum(door.crossing != "uncrossed" for door in doors)
        things = len(snapshot.of_type(ObjectNode))
        progress.exploring(len(snapshot.of_type(RoomNode)), done, len(doors), things, runtime.now_s)
        if snapshot.root.explored:
            return True
    return False


async def _work(runtime: Runtime, robot: SimulatedRobot, task_id: str, scenario: Scenario, progress: Progress) -> bool:
    """Follow the task to its end; the person interferes once the robot is under way. Whether that happened."""
    disturbed = False
    limit_s = runtime.now_s + TASK_LIMIT_S
    while not (task := runtime.queue.task(task_id)).status.ended:
        progress.working(task)
        if not disturbed and _under_way(task, runtime.now_s):
            await robot.disturb({"do": "move", "id": scenario.thing, "to": {"on": scenario.new_place}})
            disturbed = True
            progress.disturbed(scenario, runtime.now_s)
        if task.status is TaskStatus.AWAITING_ANSWER or runtime.now_s > limit_s:
            runtime.queue.cancel(task_id, stamp_s=runtime.now_s)
        await runtime.wait_for_change()
    progress.working(task)
    return disturbed


def _under_way(task: Task, now_s: float) -> bool:
    """Whether the robot has been driving to the thing for a moment."""
    if task.status is not TaskStatus.RUNNING or task.plan is None or task.times.started_s is None:
        return False
    first = task.plan.steps[0]
    return first.status is StepStatus.RUNNING and now_s - task.times.started_s > 1.0


def _place_of(truth: Mapping[str, Any], thing: str) -> str | None:
    for item in truth["objects"]:
        if item["id"] == thing:
            place: str | None = item["on"] or item["in"]
            return place
    return None
