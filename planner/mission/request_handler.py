"""A request becomes a verified plan that may run, or an answer, a question, a refusal."""

from __future__ import annotations

import asyncio
import logging
from dataclasses import dataclass, replace
from typing import Any, Protocol

from planner.executor.executor import OnEvent, ignore_event
from planner.explainer.explainer import plan_sentence
from planner.goals import Goal
from planner.grounding.openness import suppose_not_known
from planner.mission.settings import MissionSettings
from planner.mission.teaching import teach
from planner.plan import Dialogue, Exchange, Impossible, Interpretation, Kind, Offer, Plan, Source
from planner.skill_planner.replanner import PlanMaker, Replanner, Verifier
from planner.skill_planner.scouting import Scout, kinds_called
from planner.skill_planner.second_look import SecondLook, perhaps_cleared
from planner.tasks.approval import Approval
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import PlanReport, Task, TaskStatus
from scene_graph.memory import WorkingMemory
from scene_graph.snapshot import Snapshot

logger = logging.getLogger(__name__)


class Interpreter(Protocol):
    """What the Task Planner offers: words in, goals or a reply out."""

    async def interpret(self, text: str, snapshot: Snapshot, dialogue: Dialogue) -> Interpretation:
        """What a request means on this revision of the graph."""
        ...


@dataclass(frozen=True, kw_only=True)
class Ready:
    """A task that may run now: its goals, the first plan, and what makes the next ones. ``intent`` says it aloud.
    ``sought``: what it is about was not known at first, and has been looked for.
    """

    task: Task
    goals: tuple[Goal, ...]
    plan: Plan
    replanner: PlanMaker
    intent: str
    sought: bool = False


class RequestHandler:
    """Understands requests and plans for them; moves tasks from ``planning`` on, except to ``running``.

    Args:
        memory: the graph.
        queue: the tasks' records.
        interpreter: the Task Planner.
        verifier: makes and checks plans.
        on_event: told what was understood, planned, and how tasks end here.
        settings: among them the deadline for understanding a request.
        offline: there is no robot, and every plan is only shown.
        recognizable: labels of what is looked for when it was never seen; of anything else the request is turned down.
    """

    def __init__(
        self,
        memory: WorkingMemory,
        queue: TaskQueue,
        interpreter: Interpreter,
        verifier: Verifier,
        *,
        on_event: OnEvent = ignore_event,
        settings: MissionSettings = MissionSettings(),
        offline: bool = False,
        recognizable: frozenset[str] = frozenset(),
    ) -> None:
        self._memory, self._queue = memory, queue
        self._interpreter, self._verifier = interpreter, verifier
        self._on_event, self._settings, self._offline = on_event, settings, offline
        self._recognizable = recognizable
        self._scouts: dict[str, Scout] = {}
        self._looking: str | None = None
        self._looked_again: frozenset[tuple[str, str]] = frozenset()
        self._displaced: dict[str, frozenset[str]] = {}
        self._mentioned: tuple[str, ...] = ()
        self._last: tuple[str, ...] = ()
        self._origins: dict[str, str] = {}

    async def take(self, task: Task, stamp_s: float, *, busy: bool = False) -> Ready | None:
        """Plan for a task in status ``planning``; ``None`` when it is not to run now.

        ``busy``: another task has the robot, or it cannot go yet. Then what words can settle is settled, and a plan
        goes back to the queue. Where only closed doors speak against a request, the robot goes and looks at them once:
        somebody may have opened them since it saw them.
        """
        if task.approved and task.plan is not None and not busy:
            return self._plan(task, task.plan.goals, Source(task.plan.source), stamp_s)
        meaning = await self._understood(task, stamp_s)
        if meaning is None:
            return None
        task = self._queue.task(task.id)
        scouting = meaning.kind is Kind.REFUSE and self._scout(task, meaning.sought, stamp_s) is not None
        looking = bool(meaning.closed) and task.id != self._looking and self._moves_unasked(task)
        if busy and (meaning.kind is Kind.PLAN or scouting or looking) and not task.dry_run:
            self._queue.move(task.id, TaskStatus.QUEUED, stamp_s=stamp_s, kind=Kind.PLAN.value)
            return None
        if looking:
            self._looking = task.id
            suppose_not_known(meaning.closed, self._memory, stamp_s)
            return await self.take(task, stamp_s)
        return self._follow(task, meaning, stamp_s)

    async def _understood(self, task: Task, stamp_s: float) -> Interpretation | None:
        """What a request means now; None where that took too long, or the task was ended meanwhile."""
        snapshot = self._memory.building()
        dialogue = Dialogue(
            answers=task.dialogue,
            offers=task.offers,
            mentioned=self._mentioned,
            earlier=self._earlier(task),
            origins=self._origins,
            last=self._last,
            displaced=self._displaced.get(task.id, frozenset()),
            task=task.id,
        )
        try:
            async with asyncio.timeout(self._settings.interpret_s):
                meaning = await self._interpreter.interpret(task.request, snapshot, dialogue)
        except TimeoutError:
            self.end(task, TaskStatus.FAILED, "I could not understand the request in time.", stamp_s)
            return None
        return meaning if self._queue.task(task.id).status is TaskStatus.PLANNING else None

    def displace(self, task_id: str, things: frozenset[str]) -> None:
        """Take note that things have moved since a request was made: what it says of their place is over."""
        if things:
            self._displaced = {task_id: self._displaced.get(task_id, frozenset()) | things}

    def end(self, task: Task, status: TaskStatus, explanation: str, stamp_s: float, **changes: Any) -> Task:
        """End a task with a sentence, and tell."""
        logger.info("%s %s: %s", task.id, status, explanation)
        task = self._queue.move(task.id, status, stamp_s=stamp_s, explanation=explanation, **changes)
        self._emit(stamp_s, "ended", task=task.id, status=status.value, why=explanation)
        return task

    def _follow(self, task: Task, meaning: Interpretation, stamp_s: float) -> Ready | None:
        untaught = bool(meaning.lessons) and task.dry_run
        reply = f"Tried only, nothing was learned. {meaning.reply}" if untaught else meaning.reply
        said = {"kind": meaning.kind.value, "reply": reply}
        goals = [str(goal) for goal in meaning.goals]
        self._remember(meaning)
        for lesson in () if untaught else meaning.lessons:
            teach(self._memory, lesson.node, label=lesson.label, name=lesson.name, stamp_s=stamp_s)
        self._emit(stamp_s, "understood", task=task.id, source=meaning.source.value, **said, goals=goals)
        match meaning.kind:
            case Kind.ANSWER:
                self.end(task, TaskStatus.SUCCEEDED, reply, stamp_s, **said)
            case Kind.REFUSE:
                return self._scouted(task, meaning, stamp_s)
            case Kind.CLARIFY:
                offer = Offer(asked=meaning.asked, candidates=meaning.candidates)
                self._queue.move(
                    task.id,
                    TaskStatus.AWAITING_ANSWER,
                    stamp_s=stamp_s,
                    candidates=meaning.candidates,
                    dialogue=(*task.dialogue, (meaning.reply, "")),
                    offers=(*task.offers, offer),
                    **said,
                )
            case Kind.PLAN:
                return self._plan(self._queue.amend(task.id, **said), meaning.goals, meaning.source, stamp_s)
        return None

    def _scouted(self, task: Task, meaning: Interpretation, stamp_s: float) -> Ready | None:
        """Look for what was never seen, if the robot would know it when it saw it; else, or in vain, turn it down."""
        scout = self._scout(task, meaning.sought, stamp_s)
        snapshot = self._memory.building()
        plan = scout.tour(snapshot) if scout is not None else None
        if scout is None or plan is None:
            reply = f"{meaning.reply} {scout.told(snapshot)}".strip() if scout is not None else meaning.reply
            self._scouts.pop(task.id, None)
            self.end(task, TaskStatus.REFUSED, reply, stamp_s, kind=meaning.kind.value, reply=reply)
            return None
        return self._looks_first(task, plan, scout, plan_sentence(plan, snapshot), stamp_s)

    def _looks_first(self, task: Task, plan: Plan, planner: PlanMaker, intent: str, stamp_s: float) -> Ready:
        """A tour, after which the request is understood anew."""
        times = replace(task.times, planned_s=stamp_s)
        task = self._queue.amend(task.id, kind=Kind.PLAN.value, reply=intent, plan=PlanReport.of(plan, ()), times=times)
        self._emit(stamp_s, "planned", task=task.id, plan=str(plan), revision=plan.revision)
        return Ready(task=task, goals=(), plan=plan, replanner=planner, intent=intent)

    def _scout(self, task: Task, kind: str, stamp_s: float) -> Scout | None:
        """Who looks for a kind of thing for a task. Nobody does where a person is to see every plan before."""
        if task.id in self._scouts:
            return self._scouts[task.id]
        if not self._moves_unasked(task) or not kind or not kinds_called(kind) & self._recognizable:
            return None
        self._scouts = {task.id: Scout(kind, self._verifier, stamp_s)}
        return self._scouts[task.id]

    def _moves_unasked(self, task: Task) -> bool:
        """Whether the robot may go and look for a task before there is a plan that a person could see."""
        return not (self._offline or task.dry_run or task.approval is Approval.ASK)

    def _plan(self, task: Task, goals: tuple[Goal, ...], source: Source, stamp_s: float) -> Ready | None:
        """Plan for the goals; then refuse, show the plan, ask for approval, or let the task run."""
        snapshot = self._memory.building()
        replanner = Replanner(self._verifier, source)
        plan = replanner.first_plan(goals, snapshot, stamp_s)
        if isinstance(plan, Impossible):
            if (ready := self._looked_over(task, plan, goals, stamp_s)) is not None:
                return ready
            self.end(task, TaskStatus.REFUSED, plan.reason, stamp_s, reply=plan.reason)
            return None
        report = PlanReport.of(plan, goals)
        self._origins |= _origins(plan, snapshot)
        same = task.plan is not None and _outline(task.plan) == _outline(report)
        task = self._queue.amend(task.id, plan=report, times=replace(task.times, planned_s=stamp_s))
        self._emit(stamp_s, "planned", task=task.id, plan=str(plan), revision=plan.revision)
        intent = plan_sentence(plan, snapshot)
        if task.dry_run or self._offline:
            self.end(task, TaskStatus.SUCCEEDED, f"Planned only, nothing was moved. {intent}", stamp_s)
        elif task.approval is Approval.ASK and not (task.approved and same):
            asked = {"approved": False, "explanation": f"{intent} Shall I?"}
            self._queue.move(task.id, TaskStatus.AWAITING_APPROVAL, stamp_s=stamp_s, **asked)
        else:
            sought = task.id in self._scouts
            return Ready(task=task, goals=goals, plan=plan, replanner=replanner, intent=intent, sought=sought)
        return None

    def _looked_over(self, task: Task, why: Impossible, goals: tuple[Goal, ...], stamp_s: float) -> Ready | None:
        """Look once more, once a task, at what was full a while ago, where only that speaks against a request."""
        if not self._moves_unasked(task):
            return None
        snapshot = self._memory.building()
        support = perhaps_cleared(why, goals, self._verifier, snapshot, stamp_s, fresh_s=self._settings.fresh_s)
        if support is None or (task.id, support) in self._looked_again:
            return None
        self._looked_again = frozenset(
            {(task.id, support)} | {each for each in self._looked_again if each[0] == task.id}
        )
        second = SecondLook(support, self._verifier, stamp_s)
        plan = second.look(snapshot)
        return self._looks_first(task, plan, second, second.told(snapshot), stamp_s) if plan is not None else None

    def _earlier(self, task: Task) -> tuple[Exchange, ...]:
        """What was asked before ``task``, the newest first."""
        tasks = [other for other in self._queue.tasks if other.id != task.id]
        return tuple(
            Exchange(
                request=other.request,
                goals=other.plan.goals if other.plan is not None else (),
                status=other.status.value,
                explanation=other.explanation or other.reply,
            )
            for other in reversed(tasks[-self._settings.earlier :])
        )

    def _remember(self, meaning: Interpretation) -> None:
        spoken = (*meaning.mentioned, *(arg for goal in meaning.goals for arg in goal.args))
        self._last = tuple(dict.fromkeys(spoken)) or self._last
        self._mentioned = tuple(dict.fromkeys((*spoken, *self._mentioned)))[: self._settings.mentions]

    def _emit(self, stamp_s: float, event: str, **fields: Any) -> None:
        self._on_event({"stamp_s": round(stamp_s, 3), "by": "mission", "event": event, **fields})


def _origins(plan: Plan, snapshot: Snapshot) -> dict[str, str]:
    """Where everything that the plan picks up is now: what it stands on, else its room."""
    picked = [step.args[0] for step in plan.steps if step.skill == "PICK"]
    places = {i: snapshot.support_of(i) or snapshot.room_of(i) for i in picked if i in snapshot}
    return {i: place for i, place in places.items() if place is not None}


def _outline(plan: PlanReport) -> tuple[str, ...]:
    return tuple(step.text for step in plan.steps)
