"""Which of a task's goals perception has confirmed, by observations newer than the last touch."""

from __future__ import annotations

from collections.abc import Sequence

from planner.goals import Goal, GoalSettings, Predicate, holds_in, superseded
from planner.plan import Step
from planner.tasks.tasks import VerifiedGoal
from scene_graph.nodes import ObjectNode
from scene_graph.snapshot import Snapshot

IMMEDIATE = frozenset({Predicate.ROBOT_AT, Predicate.HOLDING, Predicate.OPEN})
"""Goals about the robot's own body, which its pose and its grip confirm at every moment, and about doors, whose state
the graph holds without the time of the last look.
"""


class GoalTracker:
    """Goals in their order, and when the robot last touched the object of each.

    A goal is *confirmed* when the graph believes it and its object was seen after the robot last handled it (after
    ``since_s`` if never). Goals that a later one supersedes need to have been confirmed once, in their turn; the others
    must be confirmed at the end.
    """

    def __init__(self, goals: Sequence[Goal], since_s: float, settings: GoalSettings = GoalSettings()) -> None:
        self.goals = tuple(goals)
        self._since_s, self._settings = since_s, settings
        self._handled_s: dict[str, float] = {}
        self._reached = 0

    def handled(self, step: Step, stamp_s: float, *, at: str | None = None) -> None:
        """Note that a step may have changed where its arguments are, and what else is ``at`` the place where the hand
        was; older observations of them count no more.
        """
        if step.skill != "GOTO":
            for name in (*step.args, *((at,) if at is not None else ())):
                self._handled_s[name] = stamp_s

    @property
    def touched(self) -> bool:
        """Whether anything was handled yet."""
        return bool(self._handled_s)

    def note(self, snapshot: Snapshot) -> None:
        """Pass over the goals that are confirmed now, in order, up to the first that is not."""
        while self._reached < len(self.goals) and self.confirms(self.goals[self._reached], snapshot):
            self._reached += 1

    def confirms(self, goal: Goal, snapshot: Snapshot) -> bool:
        """Whether the graph believes a goal on fresh evidence."""
        if not holds_in(goal, snapshot, since_s=self._since_s, settings=self._settings):
            return False
        return goal.predicate in IMMEDIATE or self._fresh(goal, snapshot)

    def shaken(self, snapshot: Snapshot) -> tuple[str, ...]:
        """Things of goals that must last which were not seen since the hand was at what they are on or in."""
        goals = [goal for index, goal in enumerate(self.goals) if index < self._reached and not self._passed(index)]
        things = [node for goal in goals if isinstance(node := snapshot.get(goal.args[0]), ObjectNode)]
        worked_s = [self._handled_s.get(snapshot.support_of(node.id) or "", self._since_s) for node in things]
        return tuple(node.id for node, at_s in zip(things, worked_s, strict=True) if node.last_seen_s <= at_s)

    def open(self, snapshot: Snapshot) -> tuple[Goal, ...]:
        """Goals that are still to be confirmed: those not reached, and reached ones that must last and do not."""
        return tuple(
            goal
            for index, goal in enumerate(self.goals)
            if not (self._passed(index) or (index < self._reached and self.confirms(goal, snapshot)))
        )

    def remaining(self) -> tuple[Goal, ...]:
        """Goals for a new plan: all but those that are over and done with."""
        return tuple(goal for index, goal in enumerate(self.goals) if not self._passed(index))

    def report(self, snapshot: Snapshot) -> tuple[VerifiedGoal, ...]:
        """Every goal and whether it is confirmed, or was in its turn."""
        still_open = self.open(snapshot)
        return tuple(VerifiedGoal(goal=goal, confirmed=goal not in still_open) for goal in self.goals)

    def _passed(self, index: int) -> bool:
        """Whether a goal was confirmed in its turn and need not last."""
        return index < self._reached and superseded(self.goals, index)

    def _fresh(self, goal: Goal, snapshot: Snapshot) -> bool:
        node = snapshot.get(goal.args[0])
        return isinstance(node, ObjectNode) and node.last_seen_s > self._handled_s.get(node.id, self._since_s)
