"""Requests put to the planner of ``serve --graph``, one after the other, and what came of each."""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import dataclass

from app.stacks.graph import GraphStack
from evaluations.planning.symbolic_execution import perform, write
from planner.language.grammar.parser import CommandGrammar
from planner.language.sentences.control import control_word
from planner.models.protocol import LanguageModel
from planner.tasks.queue import TaskQueue
from planner.tasks.tasks import PlanReport, StepReport, Task, TaskStatus
from scene_graph.memory import WorkingMemory
from scene_graph.snapshot import Snapshot
from skills.facts import read_state
from skills.registry import load_registry
from skills.state.state import PlanState

PLAN, ANSWER, CLARIFY, REFUSE, CONTROL, FAILED = "plan", "answer", "clarify", "refuse", "control", "failed"
_KINDS = {TaskStatus.AWAITING_ANSWER: CLARIFY, TaskStatus.REFUSED: REFUSE, TaskStatus.FAILED: FAILED}


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """What came of one turn.

    ``trail``: the states from before the plan to after it, one for each step; empty of a question or a refusal.
    ``obstacle``: why a step could not be carried out. ``after``: the graph when all was done. ``ms``: processor time
    from words to a verified plan or a reply, so that other programs do not count; ``wall_ms``: waiting included.
    """

    kind: str
    said: str
    candidates: frozenset[str]
    steps: tuple[StepReport, ...]
    source: str
    sought: tuple[str, ...]
    trail: tuple[PlanState, ...]
    obstacle: str
    after: Snapshot
    ms: float
    wall_ms: float = 0.0

    @property
    def acts(self) -> bool:
        """Whether the robot does something."""
        return bool(self.steps)


class Conversation:
    """One person and one robot in a building that nothing else changes. Every turn finds the graph newly read.

    Args:
        model: takes what the grammar cannot parse; ``None`` for the grammar alone.
        grammar: shared by conversations, since it takes long to make.
        turn_s: robot time between two turns.
    """

    def __init__(
        self, snapshot: Snapshot, grammar: CommandGrammar, model: LanguageModel | None = None, *, turn_s: float = 60.0
    ) -> None:
        self._turn_s = turn_s
        self._memory = WorkingMemory(snapshot)
        self._queue = TaskQueue()
        self._stack = GraphStack(self._memory, self._queue, model, grammar=grammar)
        self._skills = load_registry()
        self._stamp_s = snapshot.stamp_s
        self._open: str | None = None

    @property
    def snapshot(self) -> Snapshot:
        """The building as it is now."""
        return self._memory.building()

    async def say(self, text: str) -> Outcome:
        """One turn: a control word, the answer to an open question, or a new request."""
        self._stamp_s += self._turn_s
        watch = _Watch()
        control = control_word(text)
        if control is not None:
            return self._outcome(CONTROL, control.value, watch.read())
        if self._open is not None:
            task = self._queue.answer(self._open, text, stamp_s=self._stamp_s)
        else:
            task = self._queue.submit(text, stamp_s=self._stamp_s)
        watch = _Watch()
        for agent in self._stack.agents:
            await agent.step(self._stamp_s)
        return self._follow(self._queue.task(task.id), watch.read())

    def _follow(self, task: Task, ms: tuple[float, float]) -> Outcome:
        """Carry out what was planned, and remember whether a question is open."""
        self._open = task.id if task.status is TaskStatus.AWAITING_ANSWER else None
        kind = _KINDS.get(task.status) or (PLAN if task.plan is not None else ANSWER)
        said = " ".join(dict.fromkeys(part for part in (task.reply, task.explanation) if part))
        plan = task.plan if kind == PLAN else None
        return self._outcome(kind, said, ms, plan=plan, candidates=task.candidates)

    def _outcome(
        self,
        kind: str,
        said: str,
        ms: tuple[float, float],
        *,
        plan: PlanReport | None = None,
        candidates: Sequence[str] = (),
    ) -> Outcome:
        steps = plan.steps if plan is not None else ()
        trail: tuple[PlanState, ...] = ()
        obstacle = ""
        if kind in (PLAN, ANSWER):
            trail, obstacle = perform(steps, read_state(self.snapshot), self._skills)
        if steps:
            write(trail[0], trail[-1], self._memory, self._stamp_s)
        return Outcome(
            kind=kind,
            said=said,
            candidates=frozenset(candidates),
            steps=steps,
            source=plan.source if plan is not None else "",
            sought=tuple(arg for goal in plan.goals for arg in goal.args) if plan is not None else (),
            trail=trail,
            obstacle=obstacle,
            after=self.snapshot,
            ms=ms[0],
            wall_ms=ms[1],
        )


class _Watch:
    """Milliseconds since it was made."""

    def __init__(self) -> None:
        self._processor_s, self._wall_s = time.process_time(), time.perf_counter()

    def read(self) -> tuple[float, float]:
        """Processor time, wall time."""
        return 1000.0 * (time.process_time() - self._processor_s), 1000.0 * (time.perf_counter() - self._wall_s)
