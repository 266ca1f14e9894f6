"""Classical search: which skills, in which order, achieve ordered goals at the least expected time.

A* over pairs of a symbolic state and the number of goals achieved so far (Hart, Nilsson and Raphael, 1968). A goal is
ticked off when it holds and all before it are ticked off; at the end all ``lasting`` goals hold together. Operators
serve the goal whose turn it is, so that *first ... then ...* means what it says.
"""

from __future__ import annotations

import heapq
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import count
from math import inf

from planner.goals import Goal, holds, lasting
from planner.plan import Step
from planner.skill_planner.operators import Operators
from planner.skill_planner.settings import SkillPlanningSettings
from skills.skill import Skill, Unmet
from skills.state.state import PlanState


@dataclass(frozen=True, kw_only=True)
class Found:
    """The cheapest way: steps, their expected seconds, and how many states were expanded."""

    steps: tuple[Step, ...]
    cost_s: float
    expanded: int


@dataclass(frozen=True, kw_only=True)
class Exhausted:
    """No way: every state was tried, or the ``budget`` was. ``unmet`` are conditions that stood in the way."""

    expanded: int
    out_of_budget: bool
    unmet: tuple[Unmet, ...]


@dataclass(frozen=True)
class _Node:
    """A state reached, the goals ticked off, and how."""

    state: PlanState
    ticked: int
    cost_s: float
    step: Step | None
    before: _Node | None

    def steps(self) -> tuple[Step, ...]:
        taken: list[Step] = []
        node: _Node | None = self
        while node is not None and node.step is not None:
            taken.append(node.step)
            node = node.before
        return tuple(reversed(taken))


class Search:
    """One planning problem: ordered goals from one state with the registered skills.

    Args:
        goals: in the order in which they shall be achieved.
        skills: by name; at least GOTO, PICK and PLACE.
        start: the state that the plan starts from.
        budget: states that may be expanded.
        settings: what goals mean, and how much is tried.
    """

    def __init__(
        self,
        goals: Sequence[Goal],
        skills: Mapping[str, Skill],
        start: PlanState,
        *,
        budget: int = 20_000,
        settings: SkillPlanningSettings = SkillPlanningSettings(),
    ) -> None:
        self._goals = tuple(goals)
        self._lasting = lasting(goals)
        self._start, self._meaning = start, settings.goals
        self._operators = Operators(skills, goals, start, settings=settings)
        self._budget = budget

    def run(self, *, below_s: float = inf) -> Found | Exhausted:
        """The cheapest steps, if they take less than ``below_s``; deterministic."""
        start = self._start
        first = _Node(start, self.tick(start, 0), 0.0, None, None)
        order = count()
        queue = [(self.at_least_s(start, first.ticked), next(order), first)]
        best = {(start, first.ticked): 0.0}
        expanded = 0
        unmet: dict[Unmet, None] = {}
        while queue and expanded < self._budget:
            _, _, node = heapq.heappop(queue)
            if node.cost_s > best[(node.state, node.ticked)]:
                continue
            if self.done(node.state, node.ticked):
                return Found(steps=node.steps(), cost_s=node.cost_s, expanded=expanded)
            expanded += 1
            for after in self._successors(node, unmet):
                key = (after.state, after.ticked)
                if after.cost_s < best.get(key, inf):
                    best[key] = after.cost_s
                    least_s = after.cost_s + self.at_least_s(after.state, after.ticked)
                    if least_s < below_s:
                        heapq.heappush(queue, (least_s, next(order), after))
        return Exhausted(expanded=expanded, out_of_budget=bool(queue), unmet=tuple(unmet))

    def tick(self, state: PlanState, ticked: int) -> int:
        """How many goals are ticked off in ``state`` when ``ticked`` were before."""
        while ticked < len(self._goals) and holds(self._goals[ticked], state, self._meaning):
            ticked += 1
        return ticked

    def done(self, state: PlanState, ticked: int) -> bool:
        """Whether nothing is left to do."""
        return ticked == len(self._goals) and all(holds(goal, state, self._meaning) for goal in self._lasting)

    def pending(self, state: PlanState, ticked: int) -> tuple[Goal, ...]:
        """The goals to work on: the next in order; when all had their turn, every lasting one that was undone."""
        if ticked < len(self._goals):
            return (self._goals[ticked],)
        return tuple(goal for goal in self._lasting if not holds(goal, state, self._meaning))

    def at_least_s(self, state: PlanState, ticked: int) -> float:
        """Seconds that the remaining goals take at least: admissible, zero at the end.

        A goal that holds before its turn may cost nothing.
        """
        left = self._goals[ticked:] or self._lasting
        return self._operators.at_least_s([goal for goal in left if not holds(goal, state, self._meaning)], state)

    def _successors(self, node: _Node, unmet: dict[Unmet, None]) -> Iterator[_Node]:
        later = self._goals[node.ticked + 1 :]
        for goal in self.pending(node.state, node.ticked):
            for step, cost_s, state in self._operators.applicable(goal, node.state, unmet, later):
                yield _Node(state, self.tick(state, node.ticked), node.cost_s + cost_s, step, node)


def one_by_one(
    goals: Sequence[Goal],
    skills: Mapping[str, Skill],
    start: PlanState,
    *,
    budget: int,
    settings: SkillPlanningSettings,
) -> Found | Exhausted:
    """Steps that achieve one goal after the other, each as cheaply as it can be from where the last one leaves off.

    Not the cheapest together, but found for any number of goals, and each may take the whole ``budget``.
    """
    steps: list[Step] = []
    state, cost_s, expanded = start, 0.0, 0
    for goal in goals:
        found = Search([goal], skills, state, budget=budget, settings=settings).run()
        expanded += found.expanded
        if isinstance(found, Exhausted):
            return replace(found, expanded=expanded)
        steps += found.steps
        cost_s += found.cost_s
        for step in found.steps:
            state = skills[step.skill].effects(state, step.args)
    return Found(steps=tuple(steps), cost_s=cost_s, expanded=expanded)
