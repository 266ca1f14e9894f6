"""How far the plan in force has come, what it still counts on, and its record in the task."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from planner.controller.situation import Expectation, expect, expected_object
from planner.executor.job import Job
from planner.goals import Goal
from planner.plan import Plan, Step
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import PlanReport, StepReport, StepStatus
from scene_graph.snapshot import Snapshot


class PlanProgress:
    """The plan in force, its current step, and the report that the API shows.

    What the plan counts on about objects is taken from the graph when the plan is adopted, and again for those that a
    step of ours has touched; what it counts on about doors and the gripper, when each step begins.
    """

    def __init__(self, task_id: str, goals: Sequence[Goal], plan: Plan, queue: TaskQueue, snapshot: Snapshot) -> None:
        self._task_id, self._goals, self._queue = task_id, tuple(goals), queue
        self.adopt(plan, snapshot, replans=0)

    def adopt(self, plan: Plan, snapshot: Snapshot, *, replans: int) -> None:
        """Put a plan in force."""
        self.plan = plan
        self.expected = expect(plan.steps, snapshot)
        self._objects = {thing.id: thing for thing in self.expected.objects}
        self._index = 0
        self._reports = [StepReport(skill=step.skill, args=step.args) for step in plan.steps]
        self._queue.amend(self._task_id, plan=self.report(), replans=replans)

    @property
    def step(self) -> Step | None:
        """The step under way or next, ``None`` after the last."""
        return self.plan.steps[self._index] if self._index < len(self.plan.steps) else None

    @property
    def rest(self) -> Plan:
        """The plan without the steps that are done."""
        return replace(self.plan, steps=self.plan.steps[self._index :])

    @property
    def checked(self) -> Plan:
        """What symbolic execution has to prove: the rest of the plan, from where the last step has brought the robot;
        of a search its next place alone, since none depends on another.

        The graph tells where the robot is only roughly; that it stands *at* something is what a confirmed GOTO says.
        """
        if self.plan.seeking is not None:
            return replace(self.plan, steps=self.rest.steps[:1])
        came = [step for step in self.plan.steps[max(0, self._index - 1) : self._index] if step.skill == "GOTO"]
        return replace(self.plan, steps=(*came, *self.rest.steps))

    def expect(self, snapshot: Snapshot) -> Expectation:
        """What the rest of the plan counts on, now that a step begins."""
        fresh = expect(self.rest.steps, snapshot)
        objects = tuple(self._objects.get(thing.id, thing) for thing in fresh.objects)
        self.expected = replace(fresh, objects=objects)
        return self.expected

    def spend(self, dt_s: float) -> None:
        """Count time for the step under way."""
        if self._index < len(self._reports) and self._reports[self._index].status is StepStatus.RUNNING:
            report = self._reports[self._index]
            self._reports[self._index] = replace(report, seconds=report.seconds + dt_s)

    def start(self) -> None:
        """The step has begun."""
        self._mark(StepStatus.RUNNING)

    def succeed(self, snapshot: Snapshot) -> None:
        """The step is done; what it touched is now expected where the graph has it."""
        for arg in self.plan.steps[self._index].args:
            if arg in self._objects and arg in snapshot:
                self._objects[arg] = expected_object(arg, snapshot)
        self._mark(StepStatus.SUCCEEDED)
        self._index += 1

    def skip(self) -> None:
        """The step could not be done, and the plan goes on without it."""
        self._mark(StepStatus.SKIPPED)
        self._index += 1

    def fail(self) -> None:
        """The step has failed."""
        if self._index < len(self._reports):
            self._mark(StepStatus.FAILED)

    def follow(self, job: Job | None) -> None:
        """Record how far the job under way has come."""
        if job is None or self._index >= len(self._reports):
            return
        report = self._reports[self._index]
        if report.status is StepStatus.RUNNING and report.actions != job.reports():
            self._reports[self._index] = replace(report, actions=job.reports())
            self._publish()

    def report(self) -> PlanReport:
        """The plan as the API shows it."""
        return PlanReport.of(self.plan, self._goals, tuple(self._reports))

    def _mark(self, status: StepStatus) -> None:
        self._reports[self._index] = replace(self._reports[self._index], status=status)
        self._publish()

    def _publish(self) -> None:
        self._queue.amend(self._task_id, plan=self.report())
