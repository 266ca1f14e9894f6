"""A row of actions under way: a py_trees sequence that can be cut off at any tick and taken up again."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from enum import StrEnum

import py_trees
from py_trees.common import Status

from planner.tasks.tasks import ActionReport, StepStatus
from scene_graph.errors import SceneGraphError
from scene_graph.geometry.errors import InvalidTransform
from skills.action import Action, Refusal, RobotContext
from skills.failures import Evidence, Failure, FailureCode

Watch = Callable[["Job"], Failure | None]
UNFIT_GRAPH = (SceneGraphError, InvalidTransform)
"""What an action raises when the graph lacks what it needs, or holds numbers that are no pose."""


class JobState(StrEnum):
    """Where a job stands; ``waiting`` before its first tick and while it is interrupted."""

    WAITING = "waiting"
    RUNNING = "running"
    SUCCEEDED = "succeeded"
    FAILED = "failed"
    ABANDONED = "abandoned"


def actions_or_refusal(make: Callable[[], list[Action]], context: RobotContext) -> list[Action]:
    """What ``make`` makes, or one action that fails with the reason when the graph lacks what it needs."""
    try:
        return make()
    except UNFIT_GRAPH as error:
        return [Refusal(context, vanished("It", error))]


def vanished(who: str, error: SceneGraphError | InvalidTransform) -> Failure:
    """The failure of something that needed what the graph does not have (any more)."""
    message = f"{who} cannot be done: something that it needs is no longer on my map."
    return Failure(code=FailureCode.OBJECT_GONE, message=message, evidence=Evidence(observation=str(error)))


class Job:
    """Actions carried out one after the other, ticked by the executor.

    When interrupted, the action under way is terminated, which leaves the body safe; the next tick starts that same
    action again with its ``initialise``, and those that had succeeded are not repeated.

    Args:
        name: for people and logs.
        actions: carried out in this order.
        timeout_s: how long the job may be ticked; time spent interrupted does not count.
        watch: asked before every tick; a failure that it returns ends the job.
        wanted: asked before every tick; while false the job is interrupted.
    """

    def __init__(
        self,
        name: str,
        actions: Sequence[Action],
        *,
        timeout_s: float = 120.0,
        watch: Watch | None = None,
        wanted: Callable[[], bool] = lambda: True,
    ) -> None:
        self.name = name
        self.state = JobState.WAITING
        self.failure: Failure | None = None
        self.active_s = 0.0
        self.timeout_s = timeout_s
        self.wanted = wanted
        self._actions = tuple(actions)
        self._done = 0
        self._watch = watch
        self._tree: py_trees.composites.Sequence | None = None

    @property
    def ended(self) -> bool:
        """Whether the job will never be ticked again."""
        return self.state not in (JobState.WAITING, JobState.RUNNING)

    @property
    def action(self) -> str:
        """Name of the action that is under way or next, ``""`` when all have succeeded."""
        return self._actions[self._done].name if self._done < len(self._actions) else ""

    def advance(self, dt_s: float) -> None:
        """Tick once, ``dt_s`` after the last tick. Call only while the job has not ended."""
        self.active_s += dt_s
        failure = self._watch(self) if self._watch is not None else None
        if failure is None and self.active_s > self.timeout_s:
            failure = self._timed_out()
        if failure is not None:
            self.fail(failure)
            return
        self._tick()

    def interrupt(self) -> None:
        """Terminate the action under way; the next tick starts it again."""
        if self._tree is None:
            return
        tree, self._tree = self._tree, None
        tree.remove_all_children()
        if self.state is JobState.RUNNING:
            self.state = JobState.WAITING

    def abandon(self) -> None:
        """Interrupt for good, without a failure."""
        self._end(JobState.ABANDONED)

    def fail(self, failure: Failure) -> None:
        """Interrupt for good, with the reason."""
        self.failure = failure
        self._end(JobState.FAILED)

    def reports(self) -> tuple[ActionReport, ...]:
        """The actions and how far each came."""
        return tuple(ActionReport(name=action.name, status=self._status(i)) for i, action in enumerate(self._actions))

    def _tick(self) -> None:
        tree = self._tree = self._tree or self._grow()
        self.state = JobState.RUNNING
        try:
            tree.tick_once()
        except UNFIT_GRAPH as error:
            self.fail(vanished(self.action, error))
            return
        open_ends = (i for i, action in enumerate(self._actions) if action.status is not Status.SUCCESS)
        self._done = next(open_ends, len(self._actions))
        if tree.status is Status.SUCCESS:
            self._end(JobState.SUCCEEDED)
        elif tree.status is Status.FAILURE:
            self.fail(self._reason())

    def _grow(self) -> py_trees.composites.Sequence:
        return py_trees.composites.Sequence(self.name, memory=True, children=self._actions[self._done :])

    def _reason(self) -> Failure:
        failed = self._actions[self._done]
        if failed.failure is not None:
            return failed.failure
        return Failure(code=FailureCode.UNREACHABLE, message=f"{failed.name} failed and could not say why.")

    def _timed_out(self) -> Failure:
        message = f"{self.action or self.name} took longer than {self.timeout_s:.0f} s."
        return Failure(
            code=FailureCode.TIMEOUT, message=message, evidence=Evidence(observation=f"{self.active_s:.1f} s")
        )

    def _end(self, state: JobState) -> None:
        if not self.ended:
            self.interrupt()
            self.state = state

    def _status(self, index: int) -> StepStatus:
        if index < self._done:
            return StepStatus.SUCCEEDED
        if index > self._done or self.state is JobState.WAITING:
            return StepStatus.PENDING
        return StepStatus.FAILED if self.state is JobState.FAILED else StepStatus.RUNNING
