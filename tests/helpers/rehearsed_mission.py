"""A rehearsal with the whole planner on it, for tests of missions."""

from __future__ import annotations

import asyncio
from dataclasses import replace

from planner.doubles.rehearsal import Stage, StillBody, rehearsal_graph
from planner.doubles.scripted import Script, ScriptedInterpreter, scripted_look, scripted_skills
from planner.executor.arbiter import Arbiter
from planner.executor.executor import Executor
from planner.goals import goal
from planner.mission.mission import Mission
from planner.mission.resources import Resources
from planner.mission.settings import MissionSettings
from planner.plan import Interpretation, Kind
from planner.skill_planner.skill_planner import SkillPlanner
from planner.skill_planner.verifier import Verifier
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import StepStatus
from scene_graph.edges import InEdge, IntentionStatus, RelationEdge
from scene_graph.edits import PutEdge, PutNode
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ObjectState

BRING = "bring the blue bottle to the desk"
ON_DESK = goal("on", "bottle_1", "desk_1")
MEANINGS = {
    BRING: Interpretation(kind=Kind.PLAN, goals=(ON_DESK,)),
    "bring both": Interpretation(kind=Kind.PLAN, goals=(ON_DESK, goal("on", "bottle_2", "desk_1"))),
    "tidy up": Interpretation(kind=Kind.PLAN, goals=(goal("on", "bottle_1", "shelf_1"), goal("robot_at", "room_2"))),
    "go round": Interpretation(
        kind=Kind.PLAN, goals=(goal("robot_at", "room_2"), goal("robot_at", "table_1"), goal("robot_at", "room_2"))
    ),
    "leave it": Interpretation(kind=Kind.PLAN, goals=(goal("on", "bottle_1", "table_1"),)),
    "take it": Interpretation(kind=Kind.PLAN, goals=(goal("holding", "bottle_1"),)),
    "where is it?": Interpretation(kind=Kind.ANSWER, reply="On the table in the kitchen."),
    "open the window": Interpretation(kind=Kind.REFUSE, reply="I cannot open windows."),
    "bring the bottle": Interpretation(kind=Kind.CLARIFY, reply="Which one?", candidates=("bottle_1", "bottle_2")),
    "the blue one": Interpretation(kind=Kind.PLAN, goals=(ON_DESK,)),
    "bring the table": Interpretation(kind=Kind.PLAN, goals=(goal("on", "table_1", "desk_1"),)),
}


class Show:
    """A rehearsal with the whole planner on it, in lockstep at 20 Hz; perception at 5 Hz."""

    def __init__(self, script: Script | None = None, **options) -> None:
        self.memory = WorkingMemory(rehearsal_graph())
        self.stage, self.script = Stage(memory=self.memory), script or Script()
        self.body, self.events, self.queue = StillBody(), [], TaskQueue()
        self.ages = {"lidar": 0.0, "camera": 0.0}
        self.skills = scripted_skills(self.stage, self.script)
        look = scripted_look(self.stage, self.script)
        self.executor = Executor(
            self.memory,
            self.body,
            self.body,
            explore=lambda edge, context: look(edge.target, context),
            on_event=self.events.append,
        )
        self.resources = Resources(
            memory=self.memory,
            queue=self.queue,
            verifier=Verifier(self.skills),
            skills=SkillPlanner(self.skills),
            executor=self.executor,
            look_at=look,
            sensor_ages=lambda: self.ages,
            on_event=self.events.append,
            settings=MissionSettings(**options),
        )
        self.mission = Mission(self.resources, ScriptedInterpreter(MEANINGS))
        self.arbiter = Arbiter(self.memory, stopped=lambda: self.body.stopped)
        self.tick, self.granted_twice = 0, False

    @property
    def stamp_s(self):
        return round(self.tick * 0.05, 3)

    async def _tick(self):
        self.tick += 1
        if self.tick % 4 == 0:
            self.stage.look(self.stamp_s)
        if self.tick % 2 == 0:
            await self.arbiter.step(self.stamp_s)
            await self.mission.step(self.stamp_s)
        await self.executor.step(self.stamp_s)
        self.granted_twice |= len(self.memory.snapshot().intentions(IntentionStatus.GRANTED)) > 1

    def run(self, ticks=1):
        async def ticking():
            for _ in range(ticks):
                await self._tick()

        asyncio.run(ticking())

    def run_until(self, condition, limit=6000):
        async def ticking():
            for _ in range(limit):
                if condition():
                    return
                await self._tick()

        asyncio.run(ticking())
        assert condition(), f"not within {limit} ticks: {self.task}"

    def ask(self, request=BRING, **options):
        return self.queue.submit(request, stamp_s=self.stamp_s, **options)

    def finish(self, request=BRING, **options):
        self.ask(request, **options)
        self.run_until(lambda: self.task.status.ended)
        return self.task

    @property
    def task(self):
        return self.queue.tasks[0]

    def until_step(self, skill, status=StepStatus.RUNNING):
        def there():
            steps = self.task.plan.steps if self.task.plan is not None else ()
            return any(step.skill == skill and step.status is status for step in steps)

        self.run_until(there)

    @property
    def codes(self):
        return [failure.code for failure in self.task.failures]


def turn_up(show, *, color="blue", first_seen_s=None):
    """Another bottle is seen on the shelf."""
    snapshot = show.memory.snapshot()
    seen_s = show.stamp_s if first_seen_s is None else first_seen_s
    other = replace(snapshot.object("bottle_1"), id="bottle_2", color=color, first_seen_s=seen_s, last_seen_s=seen_s)
    other = replace(other, state=ObjectState.PRESENT)
    shelf = replace(snapshot.parent("shelf_1"), target="bottle_2")
    on_it = RelationEdge(source="bottle_2", target="shelf_1", predicate="on", probability=0.95)
    edits = [PutNode(other), PutEdge(shelf), PutEdge(InEdge(source="bottle_2", target="room_1")), PutEdge(on_it)]
    show.stage.places["bottle_2"] = "shelf_1"
    show.memory.commit(edits, agent="objects", stamp_s=show.stamp_s)
