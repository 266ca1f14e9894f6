"""What is told about a task under way: its failures, its confirmed goals, and how it ended."""

from __future__ import annotations

from dataclasses import dataclass

from planner.explainer.explainer import explain, failure_sentence, success_sentence
from planner.mission.goal_tracker import GoalTracker
from planner.mission.resources import Resources
from planner.naming import capital, humanize, name_of, whereabouts
from planner.plan import Impossible, Step
from planner.skill_planner.replanner import ObjectSearch
from planner.tasks.tasks import TaskStatus
from scene_graph.nodes import ROBOT_ID, ObjectNode
from scene_graph.snapshot import Snapshot
from skills.failures import Evidence, Failure, FailureCode


@dataclass(frozen=True, kw_only=True)
class Ending:
    """How a task ended, and the sentence that says so; or that it is to be planned anew, in silence, while things that
    are ``displaced`` no longer are where the request may say.
    """

    status: TaskStatus
    explanation: str
    displaced: frozenset[str] = frozenset()


class TaskLog:
    """Writes what happens into the task's record and the event log."""

    def __init__(self, task_id: str, tracker: GoalTracker, resources: Resources) -> None:
        self._task_id, self._tracker, self._resources = task_id, tracker, resources

    def step(self, step: Step, stamp_s: float) -> None:
        """A step begins."""
        self._resources.emit(stamp_s, "step", task=self._task_id, step=str(step))

    def observed(self, step: Step, snapshot: Snapshot, stamp_s: float, *, search: ObjectSearch | None) -> None:
        """What was seen says that a step is done; with a ``search``: that a place was looked at in vain."""
        seen = search.seen_there if search is not None else observation(step, snapshot, stamp_s)
        fields = {"step": str(step), "seen": seen, "nodes": list(step.args), "revision": snapshot.revision}
        self._resources.emit(stamp_s, "observed", task=self._task_id, **fields)

    def step_done(self, step: Step, snapshot: Snapshot, stamp_s: float) -> None:
        """A step is confirmed, and with it perhaps a goal."""
        self._resources.queue.amend(self._task_id, verified=self._tracker.report(snapshot))
        self._resources.emit(stamp_s, "step_done", task=self._task_id, step=str(step))

    def failure(self, failure: Failure, step: Step, snapshot: Snapshot, stamp_s: float, *, hopeless: bool) -> None:
        """Something went wrong; ``hopeless``: nothing more will be tried."""
        report = explain(failure, step, snapshot, hopeless=hopeless)
        failures = self._resources.queue.task(self._task_id).failures
        self._resources.queue.amend(self._task_id, failures=(*failures, report), explanation=report.sentence)
        fields = {"step": report.step, "code": report.code, "why": report.message, "next": report.suggestion}
        self._resources.emit(stamp_s, "failure", task=self._task_id, **fields)

    def replan(self, plan: str, why: str, stamp_s: float) -> None:
        """A new plan comes into force."""
        self._resources.emit(stamp_s, "replan", task=self._task_id, why=why, plan=plan)

    def success(self, snapshot: Snapshot, stamp_s: float) -> Ending:
        """Every goal is confirmed."""
        task = self._resources.queue.amend(self._task_id, verified=self._tracker.report(snapshot))
        goals = [verified.goal for verified in task.verified]
        return Ending(status=TaskStatus.SUCCEEDED, explanation=success_sentence(task, goals, snapshot, stamp_s))

    def surrender(self, reason: str, snapshot: Snapshot) -> Ending:
        """Nothing is left to try."""
        self._resources.queue.amend(self._task_id, verified=self._tracker.report(snapshot))
        explanation = failure_sentence(self._tracker.remaining(), reason, snapshot)
        return Ending(status=TaskStatus.FAILED, explanation=explanation)

    def despair(self, why: Impossible, step: Step, snapshot: Snapshot, stamp_s: float) -> Ending:
        """There is no plan any more. What was looked for in vain, or has happened, is the last failure, not what went
        wrong before that became known.
        """
        if why.lost is not None:
            carried = any(goal.object_id == why.lost for goal in self._tracker.goals)
            code = FailureCode.OBJECT_GONE if carried else FailureCode.SUPPORT_GONE
            self._conclude(code, why, "not found anywhere", Step(skill="SEARCH", args=(why.lost,)), snapshot, stamp_s)
        elif why.code is not None and why.code != self._last_code():
            self._conclude(why.code, why, "no plan is left", step, snapshot, stamp_s)
        return self.surrender(why.reason, snapshot)

    def _last_code(self) -> str | None:
        failures = self._resources.queue.task(self._task_id).failures
        return failures[-1].code if failures else None

    def _conclude(
        self, code: FailureCode, why: Impossible, observation: str, step: Step, snapshot: Snapshot, stamp_s: float
    ) -> None:
        evidence = Evidence(nodes=why.nodes, revision=snapshot.revision, observation=observation)
        failure = Failure(code=code, message=f"{capital(humanize(why.reason, snapshot))}.", evidence=evidence)
        self.failure(failure, step, snapshot, stamp_s, hopeless=True)


def observation(step: Step, snapshot: Snapshot, stamp_s: float) -> str:
    """What the graph says after a step about what that step was to change, and how old it is."""
    thing = step.args[0] if step.args else ROBOT_ID
    node = snapshot.get(thing)
    if step.skill == "GOTO" and node is not None:
        return f"the robot is at {name_of(thing, snapshot)}"
    if isinstance(node, ObjectNode):
        age_s = max(0.0, stamp_s - node.last_seen_s)
        return f"{name_of(thing, snapshot)} is {whereabouts(thing, snapshot)}, seen {age_s:.1f} s ago"
    room = snapshot.room_of(ROBOT_ID)
    return f"the robot is in {name_of(room, snapshot) if room is not None else 'a place that it does not know'}"
