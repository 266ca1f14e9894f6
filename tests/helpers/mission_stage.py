"""A stage for whole missions: planner, controller and skills on the simulated robot, in a world that people change.

Perception is played: what is in plain view of the camera is told as it is, what is not seen where it should be is
missing, and everything else stays as it was last seen.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from math import atan2, cos, dist, sin
from typing import Any

import numpy as np

from app.stacks.ranges import ScanRanges
from perception.ports import LidarScan
from physics_stage import SKILLS, Stage
from planner.doubles.scripted import ScriptedInterpreter
from planner.executor.arbiter import Arbiter
from planner.executor.executor import Executor
from planner.executor.exploration import explore, look_at
from planner.goals import Goal
from planner.mission.mission import Mission
from planner.mission.resources import Resources
from planner.plan import Interpretation, Kind
from planner.skill_planner.skill_planner import SkillPlanner
from planner.skill_planner.verifier import Verifier
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import Task
from scene_graph.nodes import ObjectNode, ObjectState

SIGHT_M = 3.0
FIELD_RAD = 0.5
"""Half the camera's field of view."""
LOOKS = 3
"""In so many looks a thing is not seen where it should be before it is missing."""
MOVED_M = 0.2


class MissionStage(Stage):
    """Takes requests; ``goals`` are what they mean. ``silent``: sensors whose data have stopped, and since when.
    ``sigma_m``: how badly the robot knows where it is.
    """

    def __init__(self, *args: Any, **options: Any) -> None:
        super().__init__(*args, **options)
        self.taken_away: set[str] = set()
        self.silent: dict[str, float] = {}
        self.queue, self.events = TaskQueue(), []
        self.sigma_m = 0.0
        self._unseen: Counter[str] = Counter()
        self._heard: LidarScan | None = None

    @property
    def scan(self) -> LidarScan | None:
        """The newest scan that the LiDAR has sent."""
        if "lidar" not in self.silent:
            self._heard = self.newest
        return self._heard

    @property
    def frame(self) -> None:
        """What is seen here is played: there are no pictures."""
        return

    async def ask(self, *goals: Goal, body: Any = None, silent: tuple[type[Exception], ...] = (OSError,)) -> None:
        """Set to work on a request that means these goals. ``body``: stands between skills and the robot."""
        self.resources = Resources(
            memory=self.memory,
            queue=self.queue,
            verifier=Verifier(SKILLS),
            skills=SkillPlanner(SKILLS),
            executor=Executor(
                self.memory,
                body or self.robot,
                ScanRanges(self),
                explore=explore,
                on_event=self.events.append,
                silent=silent,
            ),
            look_at=look_at,
            sensor_ages=self._ages,
            on_event=self.events.append,
        )
        meaning = Interpretation(kind=Kind.PLAN, goals=goals)
        self.mission = Mission(self.resources, ScriptedInterpreter({"do it": meaning}))
        self.arbiter = Arbiter(self.memory, stopped=lambda: self.robot.stopped, exploration_enabled=False)
        self.queue.submit("do it", stamp_s=self.now_s)
        self._due_s = 0.0

    @property
    def task(self) -> Task:
        """The request under way."""
        return self.queue.tasks[-1]

    @property
    def codes(self) -> list[str]:
        """What went wrong on the way, in order."""
        return [failure.code for failure in self.task.failures]

    @property
    def robot_xy(self) -> tuple[float, float]:
        """Where the robot truly is, in the house."""
        return tuple(self.truth["robot"]["pose"][:2])

    @property
    def carrying(self) -> bool:
        """Whether the robot is under way with something in its hand."""
        return self.truth["robot"]["holding"] is not None and self.doing("GOTO")

    def ahead(self, away_m: float) -> tuple[float, float]:
        """A spot in front of the robot, in the house."""
        x, y, yaw = self.truth["robot"]["pose"]
        return x + away_m * cos(yaw), y + away_m * sin(yaw)

    def doing(self, skill: str) -> bool:
        """Whether a step with this skill is under way."""
        steps = self.task.plan.steps if self.task.plan is not None else ()
        return any(step.skill == skill and step.status == "running" for step in steps)

    async def until(self, condition: Callable[[], bool], limit_s: float = 240.0) -> None:
        """Let time pass until the condition holds; the robot's task must not end before."""
        began_s = self.now_s
        while not condition():
            assert not self.task.status.ended, f"ended early: {self.task.explanation} {self.codes}"
            assert self.now_s - began_s < limit_s, f"still {self.task.status} at {self.now_s:.0f} s: {self.codes}"
            await self.tick()

    async def rest(self, duration_s: float) -> None:
        """Let some time pass."""
        began_s = self.now_s
        while self.now_s < began_s + duration_s:
            await self.tick()

    async def end(self, limit_s: float = 400.0) -> Task:
        """Let time pass until the task is over; nothing may have been touched."""
        began_s = self.now_s
        while not self.task.status.ended:
            assert self.now_s - began_s < limit_s, f"goes on and on: {self.task.explanation} {self.codes}"
            await self.tick()
        self.truth = await self.robot.truth()
        return self.task

    async def disturb(self, do: str, thing: str, **event: Any) -> None:
        """Meddle with the world."""
        if do == "remove":
            self.taken_away.add(thing)
        await self.robot.disturb({"do": do, "id": thing, **event})

    async def add(self, thing: str, category: str, pose: list[float], size: tuple[float, float, float]) -> None:
        """Bring something in."""
        self._sizes[thing] = size
        entry = {"id": thing, "category": category, "size": list(size), "pose": pose}
        await self.robot.disturb({"do": "add", "object": entry})

    async def tick(self) -> None:
        """One control tick of robot, planner and perception."""
        await self._refresh()
        if self.now_s >= self._due_s:
            self._due_s = self.now_s + 0.099
            await self.arbiter.step(self.now_s)
            await self.mission.step(self.now_s)
        await self.resources.executor.step(self.now_s)
        self.now_s = await self.robot.advance(0.05)

    def _localize(self) -> None:
        super()._localize()
        if self.sigma_m > 0.0:
            edge = self.memory.snapshot().parent("robot")
            with self.memory.edit("stage", self.now_s) as tx:
                tx.put(replace(edge, covariance=np.eye(6) * self.sigma_m**2))

    def _see_people(self) -> None:
        snapshot = self.memory.snapshot()
        for record in self.truth["people"]:
            if record["id"] in snapshot and self._in_view(record["position_m"]):
                x, y = record["position_m"][:2]
                with self.memory.edit("stage", self.now_s) as tx:
                    node = snapshot.person(record["id"])
                    self._unhang(tx, snapshot, node.id)
                    self._put(tx, node, x, y, 0.0, 0.0)

    def _ages(self) -> dict[str, float]:
        return {name: self.now_s - self.silent.get(name, self.now_s) for name in ("lidar", "camera")}

    def _see(self) -> None:
        """Feel the grip; tell what is in view, and what is not where it should be."""
        if "camera" in self.silent:
            return
        self._feel()
        self._see_people()
        records = {record["id"]: record for record in self.truth["objects"]}
        for name, record in records.items():
            if self._in_view(record["position_m"]) and not self._handled(name):
                self._tell(name, record)
        for node in self.memory.snapshot().of_type(ObjectNode):
            if node.state is ObjectState.PRESENT and not self._handled(node.id):
                self._miss(node, records.get(node.id))

    def _feel(self) -> None:
        snapshot, body = self.memory.snapshot(), self.context.body
        verb, _, about = snapshot.robot.status.partition(" ")
        if snapshot.robot.holding is None:
            node = snapshot.get(about) if verb == "grasping" else None
            if isinstance(node, ObjectNode) and all(body.finger_contacts) and body.gripper_opening_m > 0.003:
                self._take(node)
        elif not any(body.finger_contacts):
            self._lose(snapshot.object(snapshot.robot.holding))

    def _lose(self, node: ObjectNode) -> None:
        """What is no longer felt is somewhere; where, the camera may tell."""
        snapshot = self.memory.snapshot()
        with self.memory.edit("stage", self.now_s) as tx:
            x, y = self.robot_xy
            self._unhang(tx, snapshot, node.id)
            self._put(tx, replace(node, state=ObjectState.MISSING), x, y, node.size_m[2] / 2, 0.0)
            tx.put(replace(snapshot.robot, holding=None))

    def _handled(self, name: str) -> bool:
        robot = self.memory.snapshot().robot
        return robot.holding == name or (
            robot.status.startswith("grasping") and self.context.body.arm.extension_m > 0.1
        )

    def _tell(self, name: str, record: dict[str, Any]) -> None:
        self._unseen[name] = 0
        node = self.memory.snapshot().get(name)
        if node is None:
            node = ObjectNode(id=name, label=record["category"], size_m=self._sizes[name])
            with self.memory.edit("stage", self.now_s) as tx:
                self._put(tx, node, *record["position_m"], 0.0)
        self._sight(node, record, let_go=False)

    def _miss(self, node: ObjectNode, record: dict[str, Any] | None) -> None:
        """Count the looks at a place where a thing should be and is not."""
        believed = self.memory.snapshot().position(node.id, "room_1")
        gone = node.id in self.taken_away or (record is not None and dist(believed, record["position_m"]) > MOVED_M)
        if not gone or not self._in_view(believed):
            return
        self._unseen[node.id] += 1
        if self._unseen[node.id] >= LOOKS:
            with self.memory.edit("stage", self.now_s) as tx:
                tx.put(replace(node, state=ObjectState.MISSING))

    def _in_view(self, position: Any) -> bool:
        x, y, yaw = self.truth["robot"]["pose"]
        away_m = dist((x, y), position[:2])
        off = atan2(position[1] - y, position[0] - x) - yaw - self.context.body.pan_rad
        same_room = (x > 3.1) == (position[0] > 3.1)
        return same_room and away_m < SIGHT_M and abs(atan2(sin(off), cos(off))) < FIELD_RAD


class Body:
    """Stands between the skills and the robot's body; passes everything on."""

    def __init__(self, robot: Any) -> None:
        self._robot = robot

    def __getattr__(self, name: str) -> Any:
        return getattr(self._robot, name)


class Jammed(Body):
    """Its arm does not move."""

    async def move_arm(self, target: Any) -> None:
        """Do nothing."""


class Mute(Body):
    """While ``mute``, it does not answer."""

    mute = False

    async def state(self) -> Any:
        """The state of the robot's body."""
        if self.mute:
            raise OSError("no answer")
        return await self._robot.state()
