"""What every task under way works with."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from planner.controller.controller import Controller
from planner.executor.executor import Executor, OnEvent, ignore_event
from planner.mission.settings import MissionSettings
from planner.skill_planner.replanner import Verifier
from planner.skill_planner.skill_planner import SkillPlanner
from planner.tasks.queue import TaskQueue
from scene_graph.memory import WorkingMemory
from skills.action import Action, RobotContext

LookAt = Callable[[str, RobotContext], list[Action]]


def no_ages() -> Mapping[str, float]:
    """Sensor ages of a robot that reports none."""
    return {}


@dataclass(frozen=True, kw_only=True)
class Resources:
    """The parts that carry out a task together.

    ``look_at`` makes actions that approach a node and look at it. ``sensor_ages`` gives the seconds since each sensor's
    newest data. ``recognizable``: labels of people, and of what can be carried, for which perception
    has a name.
    """

    memory: WorkingMemory
    queue: TaskQueue
    verifier: Verifier
    skills: SkillPlanner
    executor: Executor
    look_at: LookAt
    controller: Controller = field(default_factory=Controller)
    sensor_ages: Callable[[], Mapping[str, float]] = no_ages
    on_event: OnEvent = ignore_event
    settings: MissionSettings = field(default_factory=MissionSettings)
    recognizable: frozenset[str] = frozenset()

    def emit(self, stamp_s: float, event: str, **fields: Any) -> None:
        """Tell the event log."""
        self.on_event({"stamp_s": round(stamp_s, 3), "by": "mission", "event": event, **fields})
