"""A robot with perception, skills and planner around it.

Agents are listed in the order in which they take their turns in lockstep: sense, localize, map, see, decide, act.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Sequence

import numpy as np

from majordomo.app.event_log import EventLog
from majordomo.app.mapping_agents import mapping_agents
from majordomo.app.ranges import ScanRanges
from majordomo.app.remembering import Remembering, building_folder
from majordomo.app.robot_port import Robot
from majordomo.app.scheduler import Agent
from majordomo.app.settings import ClockMode, Settings
from majordomo.perception.labels import RoomLabels
from majordomo.perception.network.model import OnnxPanopticModel
from majordomo.perception.objects.agent import ObjectMemory, ObjectMemorySettings
from majordomo.perception.panoptic import PanopticModel
from majordomo.perception.preview import WatchedModel, preview_jpeg
from majordomo.perception.sensing import Filming, Sensing, SensorBuffer
from majordomo.planner.arbiter import Arbiter
from majordomo.planner.crew import Crew
from majordomo.planner.executor import Executor
from majordomo.planner.exploration import explore, look_at
from majordomo.planner.grammar.parser import CommandGrammar
from majordomo.planner.mission import Mission
from majordomo.planner.models.protocol import LanguageModel
from majordomo.planner.queue import TaskQueue
from majordomo.planner.skill_planner import SkillPlanner
from majordomo.planner.task_planner import TaskPlanner
from majordomo.planner.verifier import Verifier
from majordomo.scene_graph.long_term.long_term_store import LongTermStore
from majordomo.scene_graph.memory import WorkingMemory
from majordomo.simulation.client import SimulatedRobot
from majordomo.simulation.errors import SimulatorDied
from majordomo.skills.registry import load_registry


class RobotStack:
    """A robot and all agents around it. Make one around a simulated robot with ``build``."""

    def __init__(
        self,
        robot: Robot,
        settings: Settings,
        queue: TaskQueue,
        model: LanguageModel | None,
        log: EventLog,
        *,
        network: PanopticModel | None,
        remembering: Remembering | None = None,
        memory: WorkingMemory | None = None,
    ) -> None:
        """Give all agents their places.

        ``network``: what understands the camera's frames; there is no camera without. ``memory``: the graph to begin
        with where nobody remembers one, empty when left out.
        """
        self.robot = robot
        empty_or_given = memory or WorkingMemory(long_term=LongTermStore())
        self.memory = remembering.memory if remembering is not None else empty_or_given
        self._remembering = remembering
        self._settings = settings
        buffer = SensorBuffer(robot)
        self._executor = Executor(
            self.memory,
            robot,
            ScanRanges(buffer),
            explore=explore,
            on_event=lambda event: log.write(event["stamp_s"], "executor", event),
            silent=(SimulatorDied,),
        )
        self._eyes = WatchedModel(network) if network is not None else None
        self._objects = self._object_memory(buffer, self._eyes) if self._eyes is not None else None
        self._buffer = buffer
        skills = load_registry()
        verifier = Verifier(skills)
        crew = Crew(
            memory=self.memory,
            queue=queue,
            verifier=verifier,
            skills=SkillPlanner(skills),
            executor=self._executor,
            look_at=look_at,
            sensor_ages=self._sensor_ages,
            on_event=lambda event: log.write(event["stamp_s"], "mission", event),
        )
        planner = TaskPlanner(
            CommandGrammar(), verifier, model, journal=lambda entry: log.write(self.now(), "model", entry)
        )
        filming = [Filming(buffer, period_s=1.0 / settings.camera_hz)] if self._eyes is not None else []
        seeing: list[Agent] = [self._objects, RoomLabels(self.memory)] if self._objects is not None else []
        self.agents: Sequence[Agent] = [
            Sensing(buffer),
            *filming,
            *mapping_agents(self.memory, buffer),
            *seeing,
            Arbiter(self.memory, stopped=lambda: self.stopped, exploration_enabled=settings.explore),
            Mission(crew, planner),
            self._executor,
            *([remembering] if remembering is not None else []),
        ]

    @classmethod
    async def build(
        cls, settings: Settings, queue: TaskQueue, model: LanguageModel | None, log: EventLog, *, anew: bool = False
    ) -> RobotStack:
        """Start the simulator and build everything around it.

        ``anew``: begin with an empty graph, whatever is remembered.

        Raises:
            HouseError: the house cannot be built.
            NetworkRefused: the network's file does not keep its contract.
        """
        network = await _network(settings)
        remembering = _remembering(settings, anew=anew)
        mode = "lockstep" if settings.clock is ClockMode.LOCKSTEP else "real"
        robot = await SimulatedRobot.start(settings.house, seed=settings.seed, mode=mode, speed=settings.speed or 1.0)
        return cls(robot, settings, queue, model, log, network=network, remembering=remembering)

    @property
    def path_room(self) -> tuple[tuple[float, float], ...]:
        """The path being followed, in the frame of the robot's parent."""
        return self._executor.context.path_room if self._executor.context is not None else ()

    @property
    def stopped(self) -> bool:
        """Whether the software stop is latched."""
        return self.robot.stopped

    @property
    def exploring(self) -> bool:
        """Whether exploration is switched on."""
        return self._settings.explore

    @property
    def degraded(self) -> str | None:
        """What is wrong with perception, if anything."""
        if self._buffer.silent:
            return f"silent: {', '.join(sorted(self._buffer.silent))}"
        return self._objects.degraded if self._objects is not None else None

    @property
    def scans(self) -> int:
        """LiDAR revolutions taken in so far."""
        return self._buffer.scans

    @property
    def frames(self) -> int:
        """Camera frames taken in so far."""
        return self._buffer.frames

    @property
    def frames_understood(self) -> int:
        """Camera frames that the network has made something of so far."""
        return self._eyes.understood if self._eyes is not None else 0

    @property
    def network(self) -> str | None:
        """Name of the file of the network in use."""
        return self._settings.model.name if self._settings.camera else None

    def now(self) -> float:
        """Robot time in seconds."""
        return self.robot.now_s

    async def advance(self, duration_s: float) -> float:
        """Advance simulated time (lockstep); the new time."""
        return await self.robot.advance(duration_s)

    def stop(self) -> None:
        """Latch the robot's own stop."""
        self.robot.stop()

    def release_stop(self) -> None:
        """Lift the latched stop."""
        self.robot.release_stop()

    @property
    def camera_on(self) -> bool:
        """Whether there is a frame to show."""
        return self._eyes is not None and self._eyes.newest is not None

    async def camera_jpeg(self) -> bytes | None:
        """The newest frame with outlined objects."""
        newest = self._eyes.newest if self._eyes is not None else None
        return await asyncio.to_thread(preview_jpeg, *newest) if newest is not None else None

    async def close(self) -> None:
        """Write the building down, and end the simulator."""
        if self._remembering is not None:
            await asyncio.to_thread(self._remembering.write, self.now())
        await self.robot.close()

    def _object_memory(self, buffer: SensorBuffer, eyes: PanopticModel) -> ObjectMemory:
        random = np.random.default_rng(self._settings.seed)
        settings = ObjectMemorySettings(period_s=1.0 / self._settings.camera_hz)
        return ObjectMemory(self.memory, buffer, eyes, random=random, settings=settings)

    def _sensor_ages(self) -> dict[str, float]:
        """Seconds since the newest data of each sensor."""
        newest = {"lidar": self._buffer.scan, "camera": self._buffer.frame, "joints": self._buffer.joints}
        now_s = self.now()
        return {name: now_s - data.stamp_s for name, data in newest.items() if data is not None}


async def _network(settings: Settings) -> PanopticModel | None:
    """The network of the configured file, unless nothing would look through it."""
    if not settings.camera:
        return None
    return await asyncio.to_thread(OnnxPanopticModel.load, settings.model.expanduser())


def _remembering(settings: Settings, *, anew: bool) -> Remembering | None:
    """Who keeps the building on disk, if that is wanted. In lockstep no wall time passes between two starts."""
    if not settings.remember:
        return None
    lockstep = settings.clock is ClockMode.LOCKSTEP
    folder = building_folder(settings.data_folder, settings.house)
    return Remembering(folder, wall_time=(lambda: 0.0) if lockstep else time.time, anew=anew)
