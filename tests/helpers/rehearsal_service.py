"""A service whose robot is rehearsed: real requests, plans and approvals, in a made-up flat without physics."""

from __future__ import annotations

import time
from collections.abc import Sequence

from app.persistence.node_history import NodeHistory
from app.scheduler import Agent
from planner.doubles.rehearsal import Stage, StillBody, rehearsal_graph
from planner.doubles.scripted import Script, scripted_look, scripted_skills
from planner.executor.arbiter import Arbiter
from planner.executor.executor import Executor
from planner.language.grammar.parser import CommandGrammar
from planner.mission.mission import Mission
from planner.mission.resources import Resources
from planner.skill_planner.skill_planner import SkillPlanner
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from scene_graph.memory import WorkingMemory


class Perception:
    """What the rehearsal's stage shows, five times a second."""

    name, period_s = "objects", 0.2

    def __init__(self, stage: Stage) -> None:
        self._stage = stage

    async def step(self, stamp_s: float) -> None:
        """One look."""
        self._stage.look(stamp_s)


class RehearsalStack:
    """Takes the place of a robot behind the interface; ``script`` says what fails and how long things take."""

    path_room: tuple[tuple[float, float], ...] = ()
    exploring, look, frame, network, degraded = False, None, None, None, None

    def __init__(self, queue, log, script: Script) -> None:
        self.memory = WorkingMemory(rehearsal_graph())
        self.history = NodeHistory()
        self.stage, self.body = Stage(memory=self.memory), StillBody()
        self._started = time.monotonic()
        skills, look = scripted_skills(self.stage, script), scripted_look(self.stage, script)
        executor = Executor(self.memory, self.body, self.body, explore=lambda edge, context: look(edge.target, context))
        resources = Resources(
            memory=self.memory,
            queue=queue,
            verifier=Verifier(skills),
            skills=SkillPlanner(skills),
            executor=executor,
            look_at=look,
            sensor_ages=lambda: {"lidar": 0.0, "camera": 0.0},
            on_event=lambda event: log.write(event["stamp_s"], "mission", event),
        )
        mission = Mission(resources, TaskPlanner(CommandGrammar(), resources.verifier, None))
        arbiter = Arbiter(self.memory, stopped=lambda: self.body.stopped, exploration_enabled=False)
        self.agents: Sequence[Agent] = [Perception(self.stage), arbiter, mission, executor]

    @property
    def stopped(self) -> bool:
        """Whether the software stop is latched."""
        return self.body.stopped

    def now(self) -> float:
        """Robot time in seconds."""
        return time.monotonic() - self._started

    def stop(self) -> None:
        """Latch the stop."""
        self.body.stop()

    def release_stop(self) -> None:
        """Lift it."""
        self.body.release_stop()

    async def close(self) -> None:
        """Nothing to release."""


def rehearsed(script: Script):
    """Builds the stack for ``Runtime(settings, build=rehearsed(script))``."""

    async def build(settings, queue, model, log, *, anew=False):
        return RehearsalStack(queue, log, script)

    return build
