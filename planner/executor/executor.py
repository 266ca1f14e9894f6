"""The Executor: the ``robot_body`` agent that carries out the granted intention, action by action (design, section 8).

Twenty times a second it refreshes what actions share, ticks the job of the granted intention, and sends the commands.
Exploration's jobs it makes itself when they are granted; the job of a task is handed over by the mission.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import replace
from typing import Any

from planner.executor.job import Job, JobState, actions_or_refusal
from planner.executor.settings import ExecutorSettings
from scene_graph.edges import HasIntentionEdge, IntentionAction, IntentionStatus
from scene_graph.edits import PutEdge
from scene_graph.memory import WorkingMemory
from scene_graph.snapshot import Snapshot
from skills.action import Action, Commands, RobotContext
from skills.failures import Evidence, Failure, FailureCode
from skills.ports import BodyPort, RangeSource

logger = logging.getLogger(__name__)

OnEvent = Callable[[dict[str, Any]], None]
ActionsFor = Callable[[HasIntentionEdge, RobotContext], list[Action]]
STILL = (0.0, 0.0)


def ignore_event(event: dict[str, Any]) -> None:
    """Listener for those who need none."""
    del event


class Executor:
    """Carries out at most one job at a time and leaves the body still whenever none is ticked.

    Args:
        memory: the graph.
        body: the robot's body port.
        ranges: proximity points for obstacle avoidance.
        explore: makes the actions of an exploration intention.
        on_event: told what starts, ends and is interrupted, as plain data with robot time.
        silent: what the body port raises when the body does not answer.
        settings: among them how long exploration may act.
    """

    name = "robot_body"

    def __init__(
        self,
        memory: WorkingMemory,
        body: BodyPort,
        ranges: RangeSource,
        *,
        explore: ActionsFor,
        on_event: OnEvent = ignore_event,
        silent: tuple[type[Exception], ...] = (OSError, EOFError),
        period_s: float = 0.05,
        settings: ExecutorSettings = ExecutorSettings(),
    ) -> None:
        self._settings = settings
        self.period_s = period_s
        self.context: RobotContext | None = None
        self.body_silent = False
        self._memory, self._body, self._ranges = memory, body, ranges
        self._explore, self._on_event, self._silent = explore, on_event, silent
        self._granted: HasIntentionEdge | None = None
        self._job: Job | None = None
        self._offered: tuple[str, Job] | None = None
        self._stopped = False
        self._driving = False
        self._stamp_s: float | None = None

    @property
    def stopped(self) -> bool:
        """Whether the software stop is latched, as the body last said."""
        return self._stopped

    @property
    def job(self) -> Job | None:
        """The job under way, if any."""
        return self._job

    def assign(self, agent: str, job: Job) -> None:
        """Hand over a task's job; it is ticked while the task intention of ``agent`` is granted."""
        self._offered = (agent, job)

    async def step(self, stamp_s: float) -> None:
        """One control tick."""
        dt_s = self.period_s if self._stamp_s is None else stamp_s - self._stamp_s
        self._stamp_s = stamp_s
        try:
            context = await self._refresh(stamp_s)
            self._work(context, dt_s)
            await self._send(context)
        except self._silent as error:
            self._lose_body(error)
        else:
            self.body_silent = False

    async def _refresh(self, stamp_s: float) -> RobotContext:
        state = await self._body.state()
        if self.context is None:
            self.context = RobotContext(
                memory=self._memory, limits=self._body.limits, geometry=self._body.geometry, body=state
            )
        context = self.context
        context.body, context.stamp_s = state, stamp_s
        context.obstacles_base, context.floor_base = self._ranges.points_base(), self._ranges.floor_base()
        context.seen_base = self._ranges.seen_base
        return context

    def _work(self, context: RobotContext, dt_s: float) -> None:
        granted = granted_intention(context.snapshot)
        self._follow_stop(context.body.stopped)
        if self._granted is not None and (granted is None or granted.key != self._granted.key):
            self._let_go()
        if self._stopped:
            self._interrupt("stopped")
            return
        if granted is None:
            return
        if self._granted is None:
            self._take(granted, context)
        self._take_over_offer(granted)
        if self._job is not None:
            self._advance(self._job, dt_s)

    def _follow_stop(self, stopped: bool) -> None:
        if stopped != self._stopped:
            self._stopped = stopped
            self._emit("stopped" if stopped else "released")

    def _take(self, granted: HasIntentionEdge, context: RobotContext) -> None:
        self._granted = granted
        self._emit("started")
        if granted.action is not IntentionAction.TASK:
            name = f"{granted.action} {granted.target}"
            actions = actions_or_refusal(lambda: self._explore(granted, context), context)
            self._job = Job(name, actions, timeout_s=self._settings.exploration_timeout_s)

    def _take_over_offer(self, granted: HasIntentionEdge) -> None:
        if granted.action is not IntentionAction.TASK or self._offered is None:
            return
        agent, job = self._offered
        if agent == granted.agent and job is not self._job:
            self._interrupt("replaced")
            self._job = job

    def _advance(self, job: Job, dt_s: float) -> None:
        if job.ended or not job.wanted():
            self._interrupt("paused")
            self._finish_if_ended(job)
        else:
            before = job.action
            job.advance(dt_s)
            if job.action and (job.action != before or job.active_s <= dt_s):
                self._emit("action", name=job.action)
            self._finish_if_ended(job)

    def _finish_if_ended(self, job: Job) -> None:
        if job.ended:
            self._finish(job)

    def _finish(self, job: Job) -> None:
        failure = job.failure
        self._emit(str(job.state), **({} if failure is None else {"code": str(failure.code), "why": failure.message}))
        granted, self._job, self._offered = self._granted, None, None
        if granted is not None and granted.action is not IntentionAction.TASK:
            self._granted = None
            self._close(granted, failure)
        self._idle()

    def _close(self, granted: HasIntentionEdge, failure: Failure | None) -> None:
        """Write the outcome of an exploration intention, unless its owner has removed it meanwhile."""
        edge = granted_intention(self._memory.snapshot())
        if edge is None or edge.key != granted.key:
            return
        status = IntentionStatus.DONE if failure is None else IntentionStatus.FAILED
        reason = "" if failure is None else f"{failure.code}: {failure.message}"
        edge = replace(edge, status=status, reason=reason)
        self._memory.commit([PutEdge(edge)], agent=self.name, stamp_s=self._stamp_s or 0.0)

    def _let_go(self) -> None:
        """The grant is over: interrupt, and forget an exploration job; a task keeps its job and takes it up again."""
        self._interrupt("revoked")
        exploring = self._granted is not None and self._granted.action is not IntentionAction.TASK
        self._granted = self._job = None
        if exploring:
            self._idle()

    def _interrupt(self, why: str) -> None:
        if self._job is not None and self._job.state is JobState.RUNNING:
            self._job.interrupt()
            self._emit("interrupted", why=why)

    def _idle(self) -> None:
        if self.context is not None:
            self.context.path_room = ()
            self.context.announce("idle")

    async def _send(self, context: RobotContext) -> None:
        """Send the commands of this tick; nothing while stopped, and no motion of the base while no job runs."""
        if self._stopped:
            context.commands = Commands()
            self._driving = False
            return
        running = self._job is not None and self._job.state is JobState.RUNNING
        if not running and (self._driving or context.commands.drive is not None):
            context.commands.drive = STILL
        drive = context.commands.drive
        self._driving = self._driving if drive is None else drive != STILL
        await context.commands.flush(self._body)

    def _lose_body(self, error: Exception) -> None:
        """The body does not answer: the job under way fails, and nothing is sent until the body answers again."""
        if not self.body_silent:
            logger.warning("the body does not answer: %s", error)
            self._emit("body_silent")
        self.body_silent = True
        if self._job is not None and not self._job.ended:
            evidence = Evidence(observation=f"{type(error).__name__}: {error}")
            message = "The robot's body does not answer."
            self._job.fail(Failure(code=FailureCode.BODY_SILENT, message=message, evidence=evidence))
            self._finish(self._job)
        if self.context is not None:
            self.context.commands = Commands()

    def _emit(self, event: str, **fields: Any) -> None:
        about = {}
        if self._granted is not None:
            about = {"agent": self._granted.agent, "action": str(self._granted.action), "target": self._granted.target}
        self._on_event({"stamp_s": round(self._stamp_s or 0.0, 3), "by": self.name, "event": event, **about, **fields})


def granted_intention(snapshot: Snapshot) -> HasIntentionEdge | None:
    """The one intention that has the robot, if any."""
    return next(iter(snapshot.intentions(IntentionStatus.GRANTED)), None)
