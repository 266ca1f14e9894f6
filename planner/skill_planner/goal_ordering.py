"""The order of goals whose order was left open: the one in which the robot has the least to drive.

*Put the cups on the table* leaves it open, *first the cup, then the plate* does not. With one gripper things are
carried one by one, so this is a shortest path through all of them: exact for a few (Held and Karp, 1962),
else improved from the cheapest insertion until no exchange helps or a number of tries are spent.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from itertools import chain, pairwise, permutations, product
from math import factorial, prod

from planner.goals import PLACING, Goal, holds
from planner.skill_planner.settings import OrderSettings, SkillPlanningSettings
from skills.state.state import PlanState

Leg = Callable[[str, str], float]
"""Cost of going from one node to another."""
_Paths = dict[frozenset[int], dict[int, tuple[float, tuple[int, ...]]]]
"""For each set of goals that are done, and the last of them: cost, order."""


def orders(
    goals: Sequence[Goal], state: PlanState, leg: Leg, settings: SkillPlanningSettings = SkillPlanningSettings()
) -> Iterator[tuple[Goal, ...]]:
    """The orders worth trying, each once: the cheapest by its legs, the one that was told, and all others of few.

    Of orders that differ only in which of several things alike comes first, such as glasses of a size from one table,
    the first.
    """
    runs = _runs(goals)
    few: Iterator[tuple[Goal, ...]] = iter(())
    if prod(factorial(len(run)) for run in runs) <= settings.order.few:
        few = (tuple(chain(*order)) for order in product(*(permutations(run) for run in runs)))
    spoken = Counter(arg for goal in goals for arg in goal.args)
    kinds = {goal: _kind(goal, spoken, state) for goal in goals}
    tried: set[tuple[Hashable, ...]] = set()
    for order in chain((cheapest_order(goals, state, leg, settings), tuple(goals)), few):
        kind = tuple(kinds[goal] for goal in order)
        if kind not in tried:
            tried.add(kind)
            yield order


def _kind(goal: Goal, spoken: Mapping[str, int], state: PlanState) -> Hashable:
    """The same for two goals that take things alike from one place to another; else the goal itself."""
    thing_id, place = goal.args[0], state.places.get(goal.args[0])
    free = not state.on_top_of(thing_id) and not state.in_the_way_of(thing_id)
    alone = spoken[thing_id] == 1 and free and thing_id not in state.missing
    thing = state.world.things.get(thing_id)
    if goal.predicate not in PLACING or place is None or thing is None or not alone or thing_id in state.near:
        return goal
    return (
        goal.predicate,
        goal.args[1],
        place,
        thing.size_m,
        thing.graspable,
        thing.position_m if place[1] == thing.room else None,
    )


def cheapest_order(
    goals: Sequence[Goal], state: PlanState, leg: Leg, settings: SkillPlanningSettings = SkillPlanningSettings()
) -> tuple[Goal, ...]:
    """``goals`` with every run of them that may come in any order in its cheapest one."""
    found: list[Goal] = []
    here = state.robot_at
    for run in _runs(goals):
        found += (goal for goal in run if holds(goal, state, settings.goals))
        open_goals = [goal for goal in run if not holds(goal, state, settings.goals)]
        best = _Tour(open_goals, state, leg, here, settings.order).best() if len(open_goals) > 1 else tuple(open_goals)
        found += best
        here = best[-1].args[-1] if best else here
    return tuple(found)


def _runs(goals: Sequence[Goal]) -> list[list[Goal]]:
    """The goals in order, those together whose order is open: things to be put somewhere, each once."""
    runs: list[list[Goal]] = []
    for goal in goals:
        last = runs[-1] if runs else []
        free = goal.any_order and all(other.predicate in PLACING for other in (*last, goal))
        if last and free and goal.args[0] not in {other.args[0] for other in last}:
            last.append(goal)
        else:
            runs.append([goal])
    return runs


class _Tour:
    """The orders of one run. What is held goes first, what stands on something else that moves, or in the way of the
    hand to it, before that.
    """

    def __init__(self, goals: Sequence[Goal], state: PlanState, leg: Leg, start: str, settings: OrderSettings) -> None:
        self._goals, self._state, self._settings = tuple(goals), state, settings
        count = range(len(goals))
        self._first = [self._to(start, goal, leg) + self._carry(start, goal, leg) for goal in goals]
        self._next = [
            [self._to(one.args[1], goal, leg) + self._carry(start, goal, leg) for goal in goals] for one in goals
        ]
        self._before = [frozenset(i for i in count if i != j and self._precedes(goals[i], goals[j])) for j in count]

    def best(self) -> tuple[Goal, ...]:
        """The goals in the cheapest order found; as they are, when the rules forbid every order."""
        order = self._exact() if len(self._goals) <= self._settings.exact else self._improved(self._inserted())
        return tuple(self._goals[i] for i in order) if order is not None else self._goals

    def _to(self, here: str, goal: Goal, leg: Leg) -> float:
        held = goal.args[0] == self._state.holding
        return 0.0 if held else leg(here, goal.args[0])

    def _carry(self, start: str, goal: Goal, leg: Leg) -> float:
        held = goal.args[0] == self._state.holding
        return leg(start if held else goal.args[0], goal.args[1])

    def _precedes(self, one: Goal, other: Goal) -> bool:
        held = self._state.holding == one.args[0]
        above = other.args[0] in list(self._state.chain(one.args[0]))[1:]
        before = one.args[0] in self._state.in_the_way_of(other.args[0])
        return held or above or before or one.args[0] == other.args[1]

    def _cost(self, order: Sequence[int]) -> float:
        placed: set[int] = set()
        for i in order:
            if not self._before[i] <= placed:
                return float("inf")
            placed.add(i)
        return self._first[order[0]] + sum(self._next[i][j] for i, j in pairwise(order))

    def _exact(self) -> Sequence[int] | None:
        """Over sets of goals that are done, and the last of them."""
        count = len(self._goals)
        paths: _Paths = {frozenset({i}): {i: (self._first[i], (i,))} for i in range(count) if not self._before[i]}
        for _ in range(count - 1):
            longer: _Paths = {}
            for done, ends in paths.items():
                for j in range(count):
                    if j in done or not self._before[j] <= done:
                        continue
                    cost, path = min((cost + self._next[i][j], path) for i, (cost, path) in ends.items())
                    longer.setdefault(done | {j}, {})[j] = (cost, (*path, j))
            paths = longer
        return min((end for ends in paths.values() for end in ends.values()), default=(0.0, None))[1]

    def _inserted(self) -> list[int]:
        order: list[int] = []
        for i in sorted(range(len(self._goals)), key=lambda i: (len(self._before[i]), self._first[i], i)):
            ways = [[*order[:k], i, *order[k:]] for k in range(len(order) + 1)]
            order = min(ways, key=self._cost_so_far)
        return order

    def _cost_so_far(self, order: Sequence[int]) -> float:
        """As ``_cost``, where only the rules among those that are in the order count."""
        broken = any(j in self._before[i] for k, i in enumerate(order) for j in order[k + 1 :])
        length = self._first[order[0]] + sum(self._next[i][j] for i, j in pairwise(order))
        return float("inf") if broken else length

    def _improved(self, order: list[int]) -> list[int] | None:
        best, tries, better = self._cost(order), 0, True
        while better and tries < self._settings.tries:
            better = False
            for changed in _exchanges(order):
                tries += 1
                if (cost := self._cost(changed)) < best - 1e-9:
                    order, best, better = changed, cost, True
                    break
        return order if best < float("inf") else None


def _exchanges(order: list[int]) -> list[list[int]]:
    """Every order in which one goal comes elsewhere, or two have changed places."""
    places = range(len(order))
    moved = [[*rest[:k], order[i], *rest[k:]] for i in places for rest in [order[:i] + order[i + 1 :]] for k in places]
    swapped = []
    for i in places:
        for j in range(i + 1, len(order)):
            other = list(order)
            other[i], other[j] = other[j], other[i]
            swapped.append(other)
    return moved + swapped
