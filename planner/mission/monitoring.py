"""Keeps the Controller supplied: the situation of a step at each tick, and whether the rest of the plan still fits."""

from __future__ import annotations

from planner.controller.situation import Situation
from planner.executor.job import Job, Watch
from planner.mission.plan_progress import PlanProgress
from planner.mission.resources import Resources
from planner.plan import Step
from planner.skill_planner.replanner import PlanMaker
from scene_graph.snapshot import Snapshot
from skills.action import RobotContext
from skills.failures import Evidence, Failure, FailureCode


class Monitoring:
    """Asks the Controller before a step begins and at every tick of its job."""

    def __init__(self, resources: Resources, progress: PlanProgress, replanner: PlanMaker) -> None:
        self._resources, self._progress, self._replanner = resources, progress, replanner
        self._before: Snapshot | None = None

    def before(self, step: Step, context: RobotContext) -> Failure | None:
        """What speaks against beginning a step: something unexpected, or a rest of the plan that no longer fits."""
        snapshot = context.building
        self._before = None
        self._progress.expect(snapshot)
        return self._resources.controller.check(self._situation(step, context)) or self._flaw(snapshot)

    def now(self, step: Step, context: RobotContext) -> Failure | None:
        """What is amiss while perception is asked to confirm a step; it says more than that it does not."""
        self._before = None
        return self._resources.controller.check(self._situation(step, context))

    def during(self, step: Step, context: RobotContext) -> Watch:
        """The watch for the job of a step."""
        return lambda job: self._resources.controller.check(self._situation(step, context, job))

    def _situation(self, step: Step, context: RobotContext, job: Job | None = None) -> Situation:
        snapshot, before = context.building, self._before
        self._before = snapshot
        times = {} if job is None else {"active_s": job.active_s, "timeout_s": job.timeout_s}
        return Situation(
            snapshot=snapshot,
            previous=before,
            stamp_s=context.stamp_s,
            step=step,
            expected=self._progress.expected,
            gripping=context.grip.object_id if context.grip is not None else None,
            sensor_ages_s=self._resources.sensor_ages(),
            **times,
        )

    def _flaw(self, snapshot: Snapshot) -> Failure | None:
        flaws = self._replanner.flaws(self._progress.checked, snapshot)
        if not flaws:
            return None
        message = f"My plan no longer fits what I see: {flaws[0].message}"
        evidence = Evidence(nodes=flaws[0].nodes, revision=snapshot.revision, observation=flaws[0].message)
        return Failure(code=flaws[0].code or FailureCode.NOT_CONFIRMED, message=message, evidence=evidence)
