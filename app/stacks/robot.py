"""A robot with perception, skills and planner around it.

Agents are listed in the order in which they take their turns in lockstep: sense, localize, map, see, decide, act.
"""

from __future__ import annotations

import asyncio
import time
from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING

import numpy as np

from app.events.event_log import EventLog
from app.persistence.building import Remembering, building_folder
from app.persistence.node_history import NodeHistory
from app.recording.errors import RecordingError
from app.recording.profile import profile_of
from app.robot_port import Robot
from app.scheduler import TICK_S, Agent
from app.settings import ClockMode, Settings
from app.stacks.mapping_agents import mapping_agents
from app.stacks.ranges import ScanRanges
from app.stacks.robot_registry import start_robot
from perception.labels import RoomLabels
from perception.network.model import OnnxPanopticModel
from perception.objects.agent import ObjectMemory, ObjectMemorySettings
from perception.objects.seeing.look import Look
from perception.panoptic import PanopticModel
from perception.ports import RgbdFrame, RobotShape
from perception.preview import WatchedModel
from perception.sensing import Filming, Sensing, SensingSettings, SensorBuffer
from perception.vocabulary import category_of, is_person, plain_label
from planner.executor.arbiter import Arbiter
from planner.executor.executor import Executor
from planner.executor.exploration import explore, look_at
from planner.language.grammar.parser import CommandGrammar
from planner.mission.mission import Mission
from planner.mission.resources import Resources
from planner.models.protocol import LanguageModel
from planner.skill_planner.skill_planner import SkillPlanner
from planner.skill_planner.verifier import Verifier
from planner.task_planner.task_planner import TaskPlanner
from planner.tasks.queue import TaskQueue
from scene_graph.long_term.long_term_store import LongTermStore
from scene_graph.memory import WorkingMemory
from simulation.errors import SimulatorDied
from skills.errors import BodySilent
from skills.registry import load_registry

if TYPE_CHECKING:
    from app.recording.mcap_writer import McapWriter
    from app.recording.recorder import Recorder


class RobotStack:
    """A robot and all agents around it. ``build`` makes one around the robot that is configured."""

    def __init__(
        self,
        robot: Robot,
        settings: Settings,
        queue: TaskQueue,
        model: LanguageModel | None,
        log: EventLog,
        *,
        network: PanopticModel | None,
        recognizable: Collection[str] = (),
        remembering: Remembering | None = None,
        memory: WorkingMemory | None = None,
        writer: McapWriter | None = None,
    ) -> None:
        """Give all agents their places.

        ``network``: what understands the camera's frames; there is no camera without. ``recognizable``: the names that
        it may give. ``memory``: the graph to begin with where nobody remembers one, empty when left out. ``writer``:
        of the recording, if there is to be one.
        """
        self.robot = robot
        empty_or_given = memory or WorkingMemory(long_term=LongTermStore())
        self.memory = remembering.memory if remembering is not None else empty_or_given
        self.history = remembering.history if remembering is not None else NodeHistory()
        self._remembering = remembering
        self._settings = settings
        buffer = SensorBuffer(robot)
        self._executor = Executor(
            self.memory,
            robot,
            ScanRanges(buffer),
            explore=explore,
            on_event=lambda event: log.write(event["stamp_s"], "executor", event),
            silent=(SimulatorDied, BodySilent),
        )
        self._eyes = WatchedModel(network) if network is not None else None
        self._objects = self._object_memory(buffer, self._eyes) if self._eyes is not None else None
        self._buffer = buffer
        skills = load_registry()
        verifier = Verifier(skills)
        resources = Resources(
            memory=self.memory,
            queue=queue,
            verifier=verifier,
            skills=SkillPlanner(skills),
            executor=self._executor,
            look_at=look_at,
            sensor_ages=self._sensor_ages,
            on_event=lambda event: log.write(event["stamp_s"], "mission", event),
            recognizable=frozenset(plain_label(name) for name in recognizable if _is_sought(name)),
        )
        planner = TaskPlanner(
            CommandGrammar(), verifier, model, journal=lambda entry: log.write(self.now(), "model", entry)
        )
        filming = [Filming(buffer, period_s=1.0 / settings.camera_hz)] if self._eyes is not None else []
        seeing: list[Agent] = [self._objects, RoomLabels(self.memory)] if self._objects is not None else []
        self.agents: Sequence[Agent] = [
            Sensing(buffer),
            *filming,
            *mapping_agents(self.memory, buffer, RobotShape(footprint_radius_m=robot.limits.footprint_radius_m)),
            *seeing,
            Arbiter(self.memory, stopped=lambda: self.stopped, exploration_enabled=settings.explore),
            Mission(resources, planner),
            self._executor,
            *([remembering] if remembering is not None else []),
        ]
        self._recorder = self._recording(writer) if writer is not None else None
        if self._recorder is not None:
            self.agents = [*self.agents, self._recorder]

    @classmethod
    async def build(
        cls, settings: Settings, queue: TaskQueue, model: LanguageModel | None, log: EventLog, *, anew: bool = False
    ) -> RobotStack:
        """Start the simulator, or connect to the robot, and build everything around it.

        ``anew``: begin with an empty graph, whatever is remembered.

        Raises:
            HouseError: the house cannot be built.
            NoSuchRobot, RobotMisfit, RosbridgeError: the robot cannot be had.
            NetworkRefused: the network's file does not keep its contract.
            RecordingExists: there is a file of the name of the recording.
        """
        network = await load_network(settings)
        remembering = _remembering(settings, anew=anew)
        robot = await start_robot(settings)
        try:
            writer = _writer(settings, anew=anew)
        except (RecordingError, OSError):
            await robot.close()
            raise
        names = network.description.classes if network is not None else ()
        return cls(
            robot,
            settings,
            queue,
            model,
            log,
            network=network,
            recognizable=names,
            remembering=remembering,
            writer=writer,
        )

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

    def keep_taught(self) -> None:
        """Write down what a person has just taught.

        Raises:
            OSError: it cannot be written.
        """
        if self._remembering is not None:
            self._remembering.keep_taught(self.now())

    @property
    def look(self) -> Look | None:
        """What the camera has shown last, and what was made of it."""
        return self._objects.look if self._objects is not None else None

    @property
    def frame(self) -> RgbdFrame | None:
        """The newest frame of the camera."""
        return self._buffer.frame if self._eyes is not None else None

    async def close(self) -> None:
        """Write the building down, end the recording, and end the simulator."""
        if self._remembering is not None:
            await asyncio.to_thread(self._remembering.write, self.now())
        if self._recorder is not None:
            await asyncio.to_thread(self._recorder.close)
        await self.robot.close()

    def _object_memory(self, buffer: SensorBuffer, eyes: PanopticModel) -> ObjectMemory:
        random = np.random.default_rng(self._settings.seed)
        settings = ObjectMemorySettings(period_s=1.0 / self._settings.camera_hz)
        held = self._remembering.held if self._remembering is not None else None
        return ObjectMemory(self.memory, buffer, eyes, random=random, settings=settings, held_before=held)

    def _recording(self, writer: McapWriter) -> Recorder:
        """Who records: in lockstep every tick, and nothing is left out; else as often as LiDAR and body are asked."""
        from app.recording.recorder import Recorder

        lockstep = self._settings.clock is ClockMode.LOCKSTEP
        period_s = TICK_S if lockstep else SensingSettings.period_s
        return Recorder(writer, self.memory, self._buffer, self.robot, patient=lockstep, period_s=period_s)

    def _sensor_ages(self) -> dict[str, float]:
        """Seconds since the newest data of each sensor."""
        newest = {"lidar": self._buffer.scan, "camera": self._buffer.frame, "joints": self._buffer.joints}
        now_s = self.now()
        return {name: now_s - data.stamp_s for name, data in newest.items() if data is not None}


def _is_sought(label: str) -> bool:
    """Whether the robot goes and looks for what has that name, when a request needs one and none is known."""
    return category_of(label).graspable or is_person(label)


async def load_network(settings: Settings) -> OnnxPanopticModel | None:
    """The network of the configured file, unless nothing would look through it."""
    if not settings.camera:
        return None
    return await asyncio.to_thread(OnnxPanopticModel.load, settings.model.expanduser())


def _remembering(settings: Settings, *, anew: bool) -> Remembering | None:
    """Who keeps the building on disk, if that is wanted. In lockstep no wall time passes between two starts."""
    if not settings.remember:
        return None
    lockstep = settings.clock is ClockMode.LOCKSTEP
    folder = building_folder(settings.data_folder, settings.house, settings.robot)
    return Remembering(folder, wall_time=(lambda: 0.0) if lockstep else time.time, anew=anew)


def _writer(settings: Settings, *, anew: bool) -> McapWriter | None:
    """What is recorded to, if anything; after a restart of the robot a file beside the one before.

    Raises:
        RecordingExists: there is such a file.
        OSError: it cannot be made.
    """
    if settings.record is None:
        return None
    from app.recording.mcap_writer import McapWriter, free_path

    path = settings.record.expanduser()
    return McapWriter(free_path(path) if anew else path, profile_of(settings), limit_bytes=settings.record_limit_bytes)
