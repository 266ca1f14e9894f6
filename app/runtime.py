"""One running Majordomo: graph, tasks, agents, robot and clock, started and stopped together.

The HTTP routes, the demonstration and the evaluations find here what they need: ``orders`` to tell the robot what to
do, ``views`` to see what it knows, and the scene graph itself.
"""

from __future__ import annotations

import asyncio
import contextlib
import logging
import time
from collections.abc import AsyncIterator, Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import httpx

from app.counters import CountedModel, Counters
from app.errors import RobotUnavailable
from app.events.event_log import EventLog
from app.events.publisher import Publisher
from app.events.stream import EventStream
from app.journal.audit import Audit, NotKept
from app.journal.redaction import Redactor
from app.journal.tasks import TaskJournal
from app.orders import Orders
from app.scheduler import TICK_S, Agent, LockstepScheduler, RealTimeScheduler, Scheduler, Turns
from app.settings import ClockMode, Settings
from app.stacks.graph import GraphStack
from app.stacks.language_model import make_language_model
from app.stacks.robot import RobotStack
from app.stacks.stack import BuildStack, Stack
from app.views.views import Views
from planner.models.protocol import LanguageModel
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import Task
from scene_graph.memory import WorkingMemory
from simulation.errors import SimulatorDied
from simulation.process.client import SimulatedRobot

logger = logging.getLogger(__name__)

Part = TypeVar("Part")

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
        self.journal = TaskJournal.of(settings)
        tasks = self.journal.take_up()
        self._audit = Audit(self.journal, tasks, redactor=Redactor((settings.llm_key,)))
        self.queue = TaskQueue(tasks)
        snapshot: Callable[[], Mapping[str, Any]] = lambda: self.views.snapshot()  # noqa: E731, PLW0108 - not made yet
        self.stream = EventStream(snapshot, first_seq=time.time_ns() // 1_000_000)
        self.log = EventLog(event_log, hear=self._audit.hear_event)
        self._http = httpx.AsyncClient()
        self.counters = Counters()
        model = make_language_model(settings, self._http)
        self.model: LanguageModel | None = CountedModel(model, self.counters) if model is not None else None
        self._stack: Stack | None = None
        self._views: Views | None = None
        self._orders: Orders | None = None
        self._scheduler: Scheduler | None = None
        self._loop_task: asyncio.Task[None] | None = None
        self._lost = ""
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
            self.journal.close()

    @property
    def memory(self) -> WorkingMemory:
        """The scene graph."""
        return self.stack.memory

    @property
    def stack(self) -> Stack:
        """What runs behind the interface: a robot, or a stored graph."""
        return _started(self._stack)

    @property
    def views(self) -> Views:
        """What is shown of it."""
        return _started(self._views)

    @property
    def orders(self) -> Orders:
        """Where people tell it what to do."""
        return _started(self._orders)

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
    def ready(self) -> bool:
        """Whether a request can be taken."""
        return self.not_ready_reason == ""

    @property
    def not_ready_reason(self) -> str:
        """Why no request can be taken, empty when one can."""
        if self._lost:
            return self._lost
        return "" if self._scheduler is not None and self.now_s > 0.0 else "starting"

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

    def turns(self) -> Sequence[Turns]:
        """Account of every agent's turns."""
        return self._scheduler.turns if self._scheduler is not None else ()

    def _agents(self) -> dict[str, Any]:
        return {turn.agent.name: turn.summary() for turn in self.turns()}

    async def _start(self, *, anew: bool = False) -> None:
        settings = self.settings
        self._stack = stack = await self._build(settings, self.queue, self.model, self.log, anew=anew)
        now: Callable[[], float] = lambda: self.now_s  # noqa: E731
        self._views = views = Views(
            stack,
            settings,
            self.queue,
            self.stream,
            self.counters,
            now=now,
            agents=self._agents,
            lost=lambda: self._lost,
        )
        self._orders = Orders(stack, self.queue, self.stream, self.log, self.counters, now=now)
        publisher = Publisher(
            stack.memory,
            self.stream,
            self.log,
            scene=views.scene.document,
            robot=views.scene.robot,
            status=views.status.document,
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
        if task.status.ended and self._orders is not None:
            try:
                self._orders.keep_taught()
            except NotKept as problem:
                logger.critical("%s: %s", task.id, problem)
        self._audit.hear_task(task, self.now_s)
        self.counters.task(task)
        document = task.document()
        self.stream.publish("task", document, self.now_s)
        self.log.write(self.now_s, "task", {"task": document})

    def _say(self, message: str) -> None:
        self.stream.publish("log", {"message": message}, self.now_s)


def _started(part: Part | None) -> Part:
    """A part that is made at the start.

    Raises:
        RobotUnavailable: nothing has started yet.
    """
    if part is None:
        raise RobotUnavailable("not started")
    return part


class _Herald:
    """Wakes whoever waits for agents to have had a turn."""

    name = "herald"
    period_s = 0.25

    def __init__(self, changed: asyncio.Condition) -> None:
        self._changed = changed

    async def step(self, stamp_s: float) -> None:  # noqa: ARG002 - every agent takes the time
        async with self._changed:
            self._changed.notify_all()
