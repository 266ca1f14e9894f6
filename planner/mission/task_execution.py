"""One task under way: step by step, each confirmed by perception; failures lead to new plans (design, section 8)."""

from __future__ import annotations

from collections.abc import Callable
from enum import StrEnum
from functools import partial

from planner.controller.identity_check import IdentityCheck
from planner.executor.job import Job, Watch, actions_or_refusal
from planner.explainer.explainer import give_up_reason, unseen_sentence
from planner.explainer.recovery import RecoveryPolicy
from planner.mission.goal_tracker import GoalTracker
from planner.mission.monitoring import Monitoring
from planner.mission.plan_progress import PlanProgress
from planner.mission.request_handler import Ready
from planner.mission.resources import Resources
from planner.mission.task_log import Ending, TaskLog
from planner.plan import Impossible, Reinterpret, Step
from planner.skill_planner.replanner import ObjectSearch
from planner.tasks.tasks import TaskStatus
from scene_graph.edges import TASK_AGENT
from scene_graph.snapshot import Snapshot
from skills.action import Action, RobotContext
from skills.failures import Evidence, Failure, FailureCode

VERIFY = Step(skill="VERIFY", args=())
"""What reports call the last look at the goals."""
CONFIRMED_BY_BODY = frozenset({"GOTO", "PICK"})
"""Skills whose effect the robot's pose and grip confirm; there is nothing to look at again."""
PLACE_CODES = frozenset(
    {FailureCode.WAY_BLOCKED, FailureCode.DOOR_CLOSED, FailureCode.UNREACHABLE, FailureCode.TIMEOUT}
    | {FailureCode.NOT_CONFIRMED, FailureCode.PERSON_IN_WAY}
)
"""While searching, these concern one place among several: it is skipped, and the search goes on."""
LOST_GRIP = frozenset({FailureCode.GRASP_EMPTY, FailureCode.SLIPPED, FailureCode.DROPPED})
"""What was in the hand, or nearly, lies somewhere now."""


class Phase(StrEnum):
    """What a task under way is about right now."""

    READY = "ready"
    ACTING = "acting"
    CONFIRMING = "confirming"
    VERIFYING = "verifying"
    LOOKING = "looking"
    WAITING = "waiting"


class TaskExecution:
    """Carries out one task's plan and its successors until every goal is confirmed, or nothing is left to try.

    ``advance`` is called while the task runs and has the robot; time in between does not count.
    """

    def __init__(self, ready: Ready, resources: Resources, stamp_s: float) -> None:
        task_id, goals, building = ready.task.id, ready.goals, resources.memory.building()
        self._task_id, self._resources, self._replanner, self._sought = (
            task_id,
            resources,
            ready.replanner,
            ready.sought,
        )
        self._tracker = GoalTracker(goals, stamp_s, resources.settings.goals)
        self._recovery_policy = RecoveryPolicy(max_failures=resources.settings.max_failures)
        self._progress = PlanProgress(task_id, goals, ready.plan, resources.queue, building)
        self._monitoring = Monitoring(resources, self._progress, ready.replanner)
        self._log = TaskLog(task_id, self._tracker, resources)
        self._identity = IdentityCheck(
            resources.queue.task(task_id).request,
            goals,
            building,
            settings=resources.settings.identity,
            grounding=resources.settings.grounding,
        )
        self._job: Job | None = None
        self._phase, self._phase_s, self._wait_s = Phase.READY, 0.0, 0.0
        self._looked, self._after_look = False, Phase.READY
        self._looked_at: set[str] = set()
        self._worked_at: str | None = None
        self._hindrance: Failure | None = None
        self._acted_s = self._stamp_s = stamp_s
        self._replans = 0

    def advance(self, stamp_s: float, dt_s: float) -> Ending | None:
        """Go on from the graph as it is now; an ``Ending`` when the task is over."""
        context = self._resources.executor.context
        if context is None:
            return None
        self._stamp_s = stamp_s
        self._phase_s += dt_s
        self._progress.spend(dt_s)
        snapshot = context.building
        if self._search is not None and self._search.found(snapshot) and self._phase is not Phase.WAITING:
            return self._replan(snapshot, "found")
        mistake = self._identity.mistake(snapshot)
        if mistake is not None and not self._sought:
            return self._admit(mistake, snapshot)
        refuted = mistake or self._identity.refuted(snapshot)
        if refuted is not None:
            return self._think_again(refuted, snapshot)
        ending = self._handlers[self._phase](context, snapshot)
        self._progress.follow(self._job)
        return ending

    @property
    def needs(self) -> tuple[str, ...]:
        """What the plan in force and the goals name."""
        named = [*(step.args for step in self._progress.plan.steps), *(goal.args for goal in self._tracker.goals)]
        return tuple(dict.fromkeys(arg for args in named for arg in args))

    def close(self) -> None:
        """End whatever is under way."""
        if self._job is not None:
            self._job.abandon()
            self._job = None

    @property
    def _handlers(self) -> dict[Phase, Callable[[RobotContext, Snapshot], Ending | None]]:
        return {
            Phase.READY: self._begin,
            Phase.ACTING: self._act,
            Phase.CONFIRMING: self._confirm,
            Phase.VERIFYING: self._verify,
            Phase.LOOKING: self._look,
            Phase.WAITING: self._wait,
        }

    @property
    def _search(self) -> ObjectSearch | None:
        seeking = self._progress.plan.seeking
        return self._replanner.search_for(seeking) if seeking is not None else None

    def _enter(self, phase: Phase) -> None:
        self._phase, self._phase_s = phase, 0.0

    def _begin(self, context: RobotContext, snapshot: Snapshot) -> Ending | None:
        """Start the next step, if the graph still allows it; after the last one, look at the goals."""
        step, self._looked, self._hindrance = self._progress.step, False, None
        if step is None:
            if self._search is not None:
                return self._replan(snapshot, "not found there")
            self._looked_at.clear()
            self._enter(Phase.VERIFYING)
            return None
        failure = self._monitoring.before(step, context)
        if failure is not None:
            return self._fail(failure, step, snapshot)
        self._worked_at = next((each for each in map(snapshot.support_of, step.args) if each is not None), None)
        self._tracker.handled(step, self._stamp_s, at=self._worked_at)
        seeking, resources = self._search is not None, self._resources
        make = partial(resources.look_at, step.args[0]) if seeking else partial(resources.skills.actions, step)
        actions = actions_or_refusal(lambda: make(context), context)
        self._progress.start()
        self._log.step(step, self._stamp_s)
        timeout_s = self._resources.skills.timeout_s(step, snapshot)
        self._start(str(step), actions, timeout_s, watch=self._monitoring.during(step, context))
        self._enter(Phase.ACTING)
        return None

    def _act(self, context: RobotContext, snapshot: Snapshot) -> Ending | None:
        del context
        job, step = self._job, self._progress.step
        if job is None or step is None or not job.ended:
            return None
        self._tracker.handled(step, self._stamp_s, at=self._worked_at)
        self._acted_s = self._stamp_s
        if job.failure is not None:
            return self._fail(job.failure, step, snapshot)
        self._enter(Phase.CONFIRMING)
        return None

    def _confirm(self, context: RobotContext, snapshot: Snapshot) -> Ending | None:
        """Wait for perception to confirm the step, looking again once."""
        step, patience_s = self._progress.step, self._resources.settings.confirm_s
        if step is None:
            return None
        if self._search is not None:
            self._settle(step, self._search, snapshot)
            return None
        failure = self._resources.skills.confirmed(step, snapshot, self._acted_s)
        if failure is None:
            self._step_done(step, snapshot)
            return None
        impatient = self._phase_s >= patience_s
        surprise = self._monitoring.now(step, context) if impatient or step.skill == "GOTO" else None
        if surprise is not None or (impatient and (self._looked or step.skill in CONFIRMED_BY_BODY)):
            return self._fail(surprise or failure, step, snapshot)
        if impatient:
            self._look_again(step.args[-1], context)
        return None

    def _settle(self, step: Step, search: ObjectSearch, snapshot: Snapshot) -> None:
        """Give perception a moment to notice the object at a place; then the place has been searched."""
        if self._phase_s >= self._resources.settings.settle_s:
            search.looked.append(step.args[0])
            self._step_done(step, snapshot)

    def _step_done(self, step: Step, snapshot: Snapshot) -> None:
        self._tracker.note(snapshot)
        self._progress.follow(self._job)
        self._log.observed(step, snapshot, self._stamp_s, search=self._search)
        self._progress.succeed(snapshot)
        self._log.step_done(step, snapshot, self._stamp_s)
        self._enter(Phase.READY)

    def _verify(self, context: RobotContext, snapshot: Snapshot) -> Ending | None:
        """After the last step every goal must be confirmed; else look once; else make a new plan."""
        self._tracker.note(snapshot)
        open_goals = self._tracker.open(snapshot)
        if not open_goals:
            if self._looks_at_shaken(context, snapshot):
                return None
            mistake = self._identity.mistake(snapshot, at_last=True)
            if mistake is not None:
                return self._admit(mistake, snapshot)
            refuted = self._identity.refuted(snapshot, at_last=True)
            if refuted is not None:
                return self._think_again(refuted, snapshot)
            return self._log.success(snapshot, self._stamp_s)
        if self._phase_s < self._resources.settings.confirm_s:
            return None
        goal = open_goals[0]
        if not self._looked and goal.object_id is not None and goal.object_id in snapshot:
            self._look_again(goal.object_id, context)
            return None
        evidence = Evidence(nodes=goal.args, revision=snapshot.revision, observation="no fresh observation confirms it")
        failure = Failure(code=FailureCode.NOT_CONFIRMED, message=unseen_sentence(goal, snapshot), evidence=evidence)
        return self._fail(self._hindrance or failure, VERIFY, snapshot)

    def _looks_at_shaken(self, context: RobotContext, snapshot: Snapshot) -> bool:
        """Look once at what was put down where the hand was again since, unless it is seen anyway: it may have been
        pushed. Whether that still takes time.
        """
        shaken = self._tracker.shaken(snapshot)
        if not shaken:
            return False
        if self._phase_s < self._resources.settings.confirm_s:
            return True
        unlooked = [node_id for node_id in shaken if node_id not in self._looked_at]
        if not unlooked:
            return False
        self._looked_at.add(unlooked[0])
        self._look_again(unlooked[0], context)
        return True

    def _look_again(self, node_id: str, context: RobotContext) -> None:
        self._looked, self._after_look, self._hindrance = True, self._phase, None
        actions = actions_or_refusal(lambda: self._resources.look_at(node_id, context), context)
        self._start(f"look at {node_id}", actions, self._resources.settings.look_timeout_s)
        self._enter(Phase.LOOKING)

    def _look(self, context: RobotContext, snapshot: Snapshot) -> None:
        del context, snapshot
        if self._job is None or self._job.ended:
            self._hindrance = self._job.failure if self._job is not None else None
            self._enter(self._after_look)

    def _wait(self, context: RobotContext, snapshot: Snapshot) -> Ending | None:
        del context
        return self._replan(snapshot, "recovery") if self._phase_s >= self._wait_s else None

    def _fail(self, failure: Failure, step: Step, snapshot: Snapshot) -> Ending | None:
        """Explain and record a failure; then skip the place, wait for a new plan, or give up."""
        self.close()
        self._progress.fail()
        if failure.code in LOST_GRIP:
            for node_id in failure.evidence.nodes:
                self._identity.fell(node_id)
        skipping = self._search is not None and failure.code in PLACE_CODES
        recovery = self._recovery_policy.after(failure.code, str(step)) if not skipping else None
        hopeless = recovery is None and not skipping
        self._log.failure(failure, step, snapshot, self._stamp_s, hopeless=hopeless)
        if self._search is not None and skipping:
            self._search.skipped.append(step.args[0])
            self._progress.skip()
            self._enter(Phase.READY)
        elif recovery is None:
            times = self._recovery_policy.times(failure.code, str(step))
            return self._log.surrender(give_up_reason(failure, times), snapshot)
        else:
            self._wait_s = recovery.wait_s
            self._enter(Phase.WAITING)
            context = self._resources.executor.context
            if recovery.looks and context is not None and step.args and step.args[-1] in snapshot:
                self._look_again(step.args[-1], context)
        return None

    def _replan(self, snapshot: Snapshot, why: str) -> Ending | None:
        """Put a new plan in force, made from the graph as it is now; end when there is none."""
        self.close()
        plan = self._replanner.plan(self._tracker.remaining(), snapshot, self._stamp_s)
        if isinstance(plan, Impossible):
            return self._log.despair(plan, self._progress.step or VERIFY, snapshot, self._stamp_s)
        if isinstance(plan, Reinterpret):
            return Ending(status=TaskStatus.PLANNING, explanation="", displaced=plan.displaced)
        self._replans += 1
        self._log.replan(str(plan), why, self._stamp_s)
        self._progress.adopt(plan, snapshot, replans=self._replans)
        self._enter(Phase.READY)
        return None

    def _admit(self, mistake: Failure, snapshot: Snapshot) -> Ending:
        """A thing is not what the request was about: nothing that could be done with it would be what was asked."""
        self.close()
        self._progress.fail()
        self._log.failure(mistake, self._progress.step or VERIFY, snapshot, self._stamp_s, hopeless=True)
        return self._log.surrender(mistake.message, snapshot)

    def _think_again(self, refuted: Failure, snapshot: Snapshot) -> Ending:
        """A guess was wrong: the request is understood anew, unless the wrong thing was touched already."""
        if self._tracker.touched:
            return self._admit(refuted, snapshot)
        self.close()
        self._progress.fail()
        self._log.failure(refuted, self._progress.step or VERIFY, snapshot, self._stamp_s, hopeless=False)
        return Ending(status=TaskStatus.PLANNING, explanation="")

    def _start(self, name: str, actions: list[Action], timeout_s: float, watch: Watch | None = None) -> None:
        self._job = Job(name, actions, timeout_s=timeout_s, watch=watch, wanted=self._wanted)
        self._resources.executor.assign(agent_of(self._task_id), self._job)

    def _wanted(self) -> bool:
        return self._resources.queue.task(self._task_id).status is TaskStatus.RUNNING


def agent_of(task_id: str) -> str:
    """Name of the intention under which a task has the robot."""
    return f"{TASK_AGENT}{task_id}"
