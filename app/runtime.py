"""One running Majordomo: graph, tasks, agents, robot and clock, started and stopped together.

The HTTP routes, the demonstration and the evaluations talk to this object and to nothing behind it.
"""

from __future__ import annotations

import asyncio
import contextlib
import json
import logging
import time
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import httpx

from app.errors import RobotUnavailable
from app.events.event_log import EventLog
from app.events.publisher import Publisher
from app.events.stream import EventStream
from app.journal.audit import Audit, NotKept
from app.journal.scrubbing import Scrubber
from app.journal.tasks import TaskJournal
from app.scheduler import TICK_S, Agent, LockstepScheduler, RealTimeScheduler, Scheduler, Turns
from app.settings import ClockMode, Settings
from app.stacks.graph import GraphStack
from app.stacks.model_choice import make_language_model
from app.stacks.robot import RobotStack
from app.stacks.stack import BuildStack, Stack
from app.tallies import CountedModel, Tallies
from app.views.metrics import Standing, metrics_text
from app.views.scene_documents import robot_document, scene_document
from client.documents import Trace
from planner.language.sentences.control import Control, control_word
from planner.mission.control_words import apply_control
from planner.models.protocol import LanguageModel
from planner.tasks.approval import Approval
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import Task
from scene_graph.memory import WorkingMemory
from simulation.errors import SimulatorDied
from simulation.process.client import SimulatedRobot

logger = logging.getLogger(__name__)

FATAL = (SimulatorDied,)
"""What no agent can survive: without a body nothing goes on until it is brought back."""


async def build_stack(
    settings: Settings, queue: TaskQueue, model: LanguageModel | None, log: EventLog, *, anew: bool = False
) -> Stack:
    """The stored graph that is configured, otherwise a robot."""
    if settings.graph is not None:
        return GraphStack.load(settings.graph, queue, model, log)
    return await RobotStack.build(settings, queue, model, log, anew=anew)


class Runtime:
    """Everything that runs behind the interface. Use ``async with runtime.running()``."""

    def __init__(
        self,
        settings: Settings,
        *,
        event_log: Path | None = None,
        witnesses: Callable[[Runtime], Sequence[Agent]] | None = None,
        build: BuildStack = build_stack,
        tick_s: float = TICK_S,
    ) -> None:
        """Connect everything; nothing starts yet.

        ``witnesses``: makes agents that take the last turns and look on, as evaluations do. ``build``: makes what runs
        behind the interface. ``tick_s``: how finely simulated time is cut in lockstep.
        """
        self.settings = settings
        self._build, self._tick_s = build, tick_s
        self._witnesses = witnesses
        self._journal = TaskJournal.of(settings)
        tasks = self._journal.take_up()
        self._audit = Audit(self._journal, tasks, scrubber=Scrubber((settings.llm_key,)))
        self.queue = TaskQueue(tasks)
        self.stream = EventStream(self._snapshot_document, first_seq=time.time_ns() // 1_000_000)
        self.log = EventLog(event_log, hear=self._audit.hear_event)
        self._http = httpx.AsyncClient()
        self.tallies = Tallies()
        model = make_language_model(settings, self._http)
        self.model: LanguageModel | None = CountedModel(model, self.tallies) if model is not None else None
        self._stack: Stack | None = None
        self._scheduler: Scheduler | None = None
        self._loop_task: asyncio.Task[None] | None = None
        self._lost = ""
        self._scene_cache: dict[tuple[str, tuple[str, ...]], tuple[int, bytes]] = {}
        self._changed = asyncio.Condition()
        self._restarting = asyncio.Lock()
        self.queue.listen(self._on_task)

    @contextlib.asynccontextmanager
    async def running(self) -> AsyncIterator[Runtime]:
        """Start robot and agents, and stop them at the end whatever happens."""
        await self._start()
        try:
            yield self
        finally:
            await self._halt()
            await self._http.aclose()
            self.log.close()
            self._journal.close()

    @property
    def memory(self) -> WorkingMemory:
        """The scene graph."""
        return self._require_stack().memory

    @property
    def robot(self) -> SimulatedRobot | None:
        """The simulated robot's driver, if there is one."""
        robot = self._stack.robot if isinstance(self._stack, RobotStack) else None
        return robot if isinstance(robot, SimulatedRobot) else None

    def require_robot(self) -> SimulatedRobot:
        """The robot's driver.

        Raises:
            RobotUnavailable: there is none.
        """
        if self.robot is None or not self.robot.alive:
            raise RobotUnavailable("no robot is running")
        return self.robot

    @property
    def now_s(self) -> float:
        """Robot time in seconds."""
        return self._scheduler.now_s if self._scheduler is not None else 0.0

    @property
    def scans(self) -> int:
        """LiDAR revolutions taken in so far."""
        return self._stack.scans if isinstance(self._stack, RobotStack) else 0

    @property
    def frames(self) -> int:
        """Camera frames taken in so far."""
        return self._stack.frames if isinstance(self._stack, RobotStack) else 0

    @property
    def frames_understood(self) -> int:
        """Camera frames that the network has made something of so far."""
        return self._stack.frames_understood if isinstance(self._stack, RobotStack) else 0

    @property
    def ready(self) -> bool:
        """Whether a request can be taken."""
        return self.not_ready_reason == ""

    @property
    def not_ready_reason(self) -> str:
        """Why no request can be taken, empty when one can."""
        if self._lost:
            return self._lost
        return "" if self._scheduler is not None and self.now_s > 0.0 else "starting"

    def submit(
        self, request: str, *, approval: Approval = Approval.AUTO, dry_run: bool = False, key: str | None = None
    ) -> Task:
        """Queue a request; *stop*, *wait*, *go on* and *cancel* act at once instead. ``key``: the client's name for it.

        Raises:
            QueueFull: too many tasks are open.
        """
        control = None if dry_run else control_word(request)
        task = self.queue.submit(
            request, stamp_s=self.now_s, approval=approval, dry_run=dry_run, key=key, urgent=control is not None
        )
        if control is None:
            return task
        if control is Control.STOP:
            self.stop_robot()
        elif control is Control.RESUME and self._stack is not None and self._stack.stopped:
            self.release_stop()
        return apply_control(control, task, self.queue, self.now_s)

    def stop_robot(self) -> None:
        """Latch the stop; never waits for anything."""
        if self._stack is not None:
            self._stack.stop()
        self.tallies.stopped()
        self.log.write(self.now_s, "stop", {})
        self._say("stopped by a person")

    def release_stop(self) -> None:
        """Lift the latched stop."""
        if self._stack is not None:
            self._stack.release_stop()
        self.log.write(self.now_s, "resume", {})
        self._say("stop released")

    def trace(self, task_id: str, *, after: int = 0, limit: int | None = None) -> Trace | None:
        """What was decided about a task, oldest first; ``None`` if nothing is known of it."""
        return self._journal.trace(task_id, after=after, limit=limit)

    def keep_taught(self) -> None:
        """Write down what a person has just taught, so that it survives the end of the process at any instant.

        Raises:
            NotKept: it cannot be written.
        """
        if isinstance(self._stack, RobotStack):
            try:
                self._stack.keep_taught()
            except OSError as problem:
                raise NotKept(f"I know it now, but cannot write it down: {problem}") from problem

    async def restart_robot(self) -> bool:
        """Bring a dead simulator back with an empty graph, since its house begins anew; false while it is alive."""
        async with self._restarting:
            if self.robot is None or self.robot.alive:
                return False
            for task in self.queue.tasks:
                if not task.status.ended:
                    self.queue.cancel(task.id, stamp_s=self.now_s)
            await self._halt()
            self._lost = ""
            await self._start(anew=True)
        self.stream.begin_anew()
        self._say("the simulator was restarted; the building is explored again")
        return True

    async def wait_for_change(self, timeout_s: float = 5.0) -> None:
        """Wait until agents have had a turn (or ``timeout_s`` wall seconds have passed).

        Raises:
            RobotUnavailable: the robot was lost.
        """
        if self._lost:
            raise RobotUnavailable(self._lost)
        async with self._changed:
            with contextlib.suppress(TimeoutError):
                await asyncio.wait_for(self._changed.wait(), timeout_s)

    async def camera_jpeg(self, *, stamp_s: float | None = None, outlines: bool = True) -> bytes | None:
        """What the robot sees as JPEG, ``None`` without a camera; see ``CameraWindow.jpeg``.

        Raises:
            FrameGone: the look at ``stamp_s`` is no longer kept.
        """
        camera = self._stack.camera if self._stack is not None else None
        return await camera.jpeg(stamp_s=stamp_s, outlines=outlines) if camera is not None else None

    async def camera_document(self) -> dict[str, Any] | None:
        """What was recognized in the newest frame, ``None`` without a camera."""
        camera = self._stack.camera if self._stack is not None else None
        return await camera.document(self.now_s) if camera is not None else None

    def scene_document(self, frame: str, layers: tuple[str, ...] = ()) -> dict[str, Any]:
        """The scene as a document."""
        return scene_document(self.memory.building(), frame, layers)

    def scene_json(self, frame: str, layers: tuple[str, ...] = ()) -> bytes:
        """The scene as JSON, made once per revision."""
        revision = self.memory.snapshot().revision
        cached = self._scene_cache.get((frame, layers))
        if cached is None or cached[0] != revision:
            body = json.dumps(self.scene_document(frame, layers), separators=(",", ":")).encode()
            cached = self._scene_cache[frame, layers] = (revision, body)
            while len(self._scene_cache) > 16:
                self._scene_cache.pop(next(iter(self._scene_cache)))
        return cached[1]

    def history_document(self, node_id: str) -> dict[str, Any] | None:
        """What became of a node, ``None`` if it is unknown."""
        return self._require_stack().history.document(node_id, exists=node_id in self.memory.building())

    def robot_document(self) -> dict[str, Any]:
        """Pose, room, load and path of the robot, in the map frame."""
        stack = self._require_stack()
        return robot_document(
            self.memory.snapshot(),
            path_room=stack.path_room,
            gaze=stack.gaze,
            stopped=stack.stopped,
            stamp_s=self.now_s,
        )

    def status_document(self) -> dict[str, Any]:
        """The body of ``GET /v1/status``."""
        snapshot = self.memory.snapshot()
        robot = self.robot_document()
        current = self.queue.current
        return {
            "stamp_s": round(self.now_s, 3),
            "clock": str(self.settings.clock),
            "house": self.settings.robot or self.settings.house,
            "exploring": self._require_stack().exploring and not snapshot.root.explored,
            "explored": snapshot.root.explored,
            "task": current.id if current else None,
            "stopped": robot["stopped"],
            "robot": {key: robot[key] for key in ("room", "localized", "pose_map", "holding")},
            "language_model": self.settings.llm,
            "network": self._require_stack().network,
            "agents": self._agents(),
            "simulator": self._lost or ("running" if isinstance(self._stack, RobotStack) else "none"),
            "perception": self._require_stack().degraded,
            "camera": self._require_stack().camera_on,
            "revision": snapshot.revision,
        }

    def turns(self) -> Sequence[Turns]:
        """Account of every agent's turns."""
        return self._scheduler.turns if self._scheduler is not None else ()

    def metrics_text(self) -> bytes:
        """Prometheus text."""
        stack = self._require_stack()
        standing = Standing(
            building=stack.memory.building(),
            loaded=stack.memory.snapshot(),
            agents=self._agents(),
            queue=self.queue,
            stamp_s=self.now_s,
            listeners=self.stream.listeners,
            stopped=stack.stopped,
            ready=self.ready,
        )
        return metrics_text(standing) + self.tallies.text()

    def _agents(self) -> dict[str, Any]:
        turns = self._scheduler.turns if self._scheduler is not None else ()
        return {turn.agent.name: turn.summary() for turn in turns}

    def _require_stack(self) -> Stack:
        if self._stack is None:
            raise RobotUnavailable("not started")
        return self._stack

    async def _start(self, *, anew: bool = False) -> None:
        settings = self.settings
        self._stack = stack = await self._build(settings, self.queue, self.model, self.log, anew=anew)
        self._scene_cache.clear()
        publisher = Publisher(
            stack.memory,
            self.stream,
            self.log,
            scene=lambda: self.scene_document("map"),
            robot=self.robot_document,
            status=self.status_document,
            history=stack.history,
        )
        agents = [*stack.agents, publisher, *(self._witnesses(self) if self._witnesses else ()), _Herald(self._changed)]
        if isinstance(stack, RobotStack) and settings.clock is ClockMode.LOCKSTEP:
            scheduler: Scheduler = LockstepScheduler(
                agents, stack.advance, tick_s=self._tick_s, speed=settings.speed, fatal=FATAL
            )
        else:
            scheduler = RealTimeScheduler(agents, stack.now, speed=settings.speed or 1.0, fatal=FATAL)
        self._scheduler = scheduler
        self._loop_task = asyncio.create_task(self._run(scheduler), name="scheduler")

    async def _run(self, scheduler: Scheduler) -> None:
        try:
            await scheduler.run()
        except SimulatorDied as error:
            self._lost = f"the simulator died: {error}; POST /v1/simulation/restart brings it back"
            logger.critical("%s", self._lost)
            self._say(self._lost)
            async with self._changed:
                self._changed.notify_all()

    async def _halt(self) -> None:
        if self._loop_task is not None:
            self._loop_task.cancel()
            with contextlib.suppress(asyncio.CancelledError):
                await self._loop_task
        if self._stack is not None:
            await self._stack.close()

    def _on_task(self, task: Task) -> None:
        if task.status.ended:
            try:
                self.keep_taught()
            except NotKept as problem:
                logger.critical("%s: %s", task.id, problem)
        self._audit.hear_task(task, self.now_s)
        self.tallies.task(task)
        document = task.document()
        self.stream.publish("task", document, self.now_s)
        self.log.write(self.now_s, "task", {"task": document})

    def _say(self, message: str) -> None:
        self.stream.publish("log", {"message": message}, self.now_s)

    def _snapshot_document(self) -> Mapping[str, Any]:
        return {
            "scene": self.scene_document("map"),
            "tasks": [task.document() for task in self.queue.tasks[-50:]],
            "robot": self.robot_document(),
            "status": self.status_document(),
        }


class _Herald:
    """Wakes whoever waits for agents to have had a turn."""

    name = "herald"
    period_s = 0.25

    def __init__(self, changed: asyncio.Condition) -> None:
        self._changed = changed

    async def step(self, stamp_s: float) -> None:  # noqa: ARG002 - every agent takes the time
        async with self._changed:
            self._changed.notify_all()
