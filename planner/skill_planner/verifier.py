"""The verifier: no plan leaves it that symbolic execution has not proven (design, section 8).

Goals are type-checked, search fills in every GOTO, PICK and PLACE, and the steps are then carried out on a copy of the
facts: each condition must hold in turn, and the goals at the end.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from math import inf

from planner.forecast import forecast
from planner.goals import Goal, holds, lasting
from planner.naming import goal_phrase, humanize
from planner.plan import Flaw, Impossible, Plan, Source, Step
from planner.skill_planner.flaws import goal_flaws
from planner.skill_planner.goal_ordering import Leg, orders
from planner.skill_planner.object_search import lost_object_plan, scouting_plan
from planner.skill_planner.operators import GOTO
from planner.skill_planner.search import Exhausted, Found, Search, one_by_one
from planner.skill_planner.settings import SkillPlanningSettings
from scene_graph.snapshot import Snapshot
from skills.facts import read_state
from skills.skill import Skill
from skills.state.state import PlanState


class Verifier:
    """Makes and checks plans with the registered skills.

    Args:
        skills: by name; at least GOTO, PICK and PLACE.
        budget: states that one search may expand.
        settings: by what numbers plans are made.
    """

    def __init__(
        self,
        skills: Mapping[str, Skill],
        *,
        budget: int = 20_000,
        settings: SkillPlanningSettings = SkillPlanningSettings(),
    ) -> None:
        self._skills, self._settings = skills, settings
        self._budget = budget
        others = (skill for name, skill in skills.items() if name != GOTO)
        self._opens_doors = any("door" in parameter.kinds for skill in others for parameter in skill.parameters)
        self._read: tuple[Snapshot, PlanState] | None = None

    @property
    def skills(self) -> Mapping[str, Skill]:
        """The registered skills by name."""
        return self._skills

    def verify_goals(self, goals: Sequence[Goal], snapshot: Snapshot) -> list[Flaw]:
        """What is wrong with ``goals`` on this graph; empty when they make sense. Missing objects are no flaw."""
        return goal_flaws(
            goals,
            snapshot,
            self.state(snapshot),
            opens_doors=self._opens_doors,
            near_m=self._settings.goals.near_m,
        )

    def plan_for(
        self, goals: Sequence[Goal], snapshot: Snapshot, *, source: Source = Source.GRAMMAR
    ) -> Plan | Impossible:
        """The cheapest proven plan for ``goals`` in order, or the reason why there is none."""
        flaws = self.verify_goals(goals, snapshot)
        if flaws:
            return Impossible(reason=flaws[0].message, nodes=flaws[0].nodes, code=flaws[0].code)
        state = self.state(snapshot)
        found = self._searched(goals, state)
        if isinstance(found, Exhausted):
            left = next((goal for goal in goals if not holds(goal, state, self._settings.goals)), goals[0])
            return _impossible(left, found, snapshot)
        length_m, end = self._carried_out(found.steps, state)
        plan = Plan(
            source=source,
            revision=snapshot.revision,
            goals=tuple(goals),
            steps=found.steps,
            expected_s=found.cost_s,
            expected_m=length_m,
            changes=forecast(state, end, [arg for step in found.steps for arg in step.args]),
        )
        unproven = self.check_plan(plan, snapshot)
        if unproven:
            return Impossible(reason=unproven[0].message, nodes=unproven[0].nodes, code=unproven[0].code)
        return plan

    def _searched(self, goals: Sequence[Goal], state: PlanState) -> Found | Exhausted:
        """The cheapest steps, all goals considered at once; where that takes too long, the cheapest for each in turn.

        Goals whose order is open come in the cheapest one as far as the budget reaches, and as they were told where
        others lead nowhere.
        """
        best: Found | Exhausted | None = None
        expanded = 0
        for order in orders(goals, state, self._leg_s(state), self._settings):
            if best is not None and expanded >= self._budget:
                break
            below_s = best.cost_s if isinstance(best, Found) else inf
            found = Search(order, self._skills, state, budget=self._budget, settings=self._settings).run(
                below_s=below_s
            )
            expanded += found.expanded
            if isinstance(found, Exhausted) and found.out_of_budget and not isinstance(best, Found):
                found = one_by_one(order, self._skills, state, budget=self._budget, settings=self._settings)
            if isinstance(found, Found) or not isinstance(best, Found):
                best = found
        return best if best is not None else Exhausted(expanded=0, out_of_budget=False, unmet=())

    def _leg_s(self, state: PlanState) -> Leg:
        """Seconds to go from one node to another; far when there is no way."""

        def leg_s(here: str, there: str) -> float:
            if state.anchor(here) == state.anchor(there):
                return 0.0
            return self._skills[GOTO].cost_s(state.after(robot_at=here, near=frozenset()), (there,))

        return leg_s

    def check_plan(self, plan: Plan, snapshot: Snapshot) -> list[Flaw]:
        """What keeps ``plan`` from being carried out on this graph, by symbolic execution; empty when nothing does.

        Steps that are done already must have been taken off. A plan that seeks an object promises no goal.
        """
        state = self.state(snapshot)
        gone = [arg for step in plan.steps for arg in step.args if arg not in state.world.things]
        if gone:
            return [Flaw(message=f"{gone[0]} is no longer on my map.", nodes=(gone[0],))]
        for step in plan.steps:
            unmet = self._skills[step.skill].conditions(state, step.args)
            if unmet:
                return [Flaw(message=each.message, nodes=each.nodes or step.args, code=each.code) for each in unmet]
            state = self._skills[step.skill].effects(state, step.args)
        if plan.seeking is not None:
            return []
        return [
            Flaw(message=f"The plan does not make it so that {goal_phrase(goal, snapshot)}.", nodes=goal.args)
            for goal in lasting(plan.goals)
            if not holds(goal, state, self._settings.goals)
        ]

    def search_plan(
        self, object_id: str, snapshot: Snapshot, since_s: float, already_looked: Collection[str] = ()
    ) -> Plan | Impossible:
        """Places to look for ``object_id``, most likely first; Impossible when all were looked at since ``since_s``."""
        if object_id not in snapshot:
            return Impossible(reason=f"{object_id} is not in the scene graph.")
        return lost_object_plan(
            object_id, snapshot, self.state(snapshot), since_s, already_looked, self._settings.object_search
        )

    def scouting_plan(
        self, kind: str, snapshot: Snapshot, since_s: float, already_looked: Collection[str] = ()
    ) -> Plan | None:
        """Places to look for a thing of a ``kind`` of which none was ever seen; None when no place is left."""
        return scouting_plan(
            kind, snapshot, self.state(snapshot), since_s, already_looked, self._settings.object_search
        )

    def state(self, snapshot: Snapshot) -> PlanState:
        """The facts of ``snapshot``; those of the last one asked for are kept."""
        if self._read is None or self._read[0] is not snapshot:
            self._read = (snapshot, read_state(snapshot))
        return self._read[1]

    def _carried_out(self, steps: Sequence[Step], state: PlanState) -> tuple[float, PlanState]:
        """How far the robot goes on a sound plan, in meters, and the state at its end."""
        length_m = 0.0
        for step in steps:
            after = self._skills[step.skill].effects(state, step.args)
            length_m += state.distance_m(state.robot_at, after.robot_at) or 0.0
            state = after
        return length_m, state


def _impossible(left: Goal, exhausted: Exhausted, snapshot: Snapshot) -> Impossible:
    """Why there is no plan; ``left``: the first goal that does not hold."""
    if exhausted.out_of_budget:
        reason = f"I found no plan within {exhausted.expanded} steps of thought: ask for less at once."
    elif exhausted.unmet:
        final = [condition for condition in exhausted.unmet if condition.final]
        why = final[0] if final else exhausted.unmet[-1]
        return Impossible(reason=humanize(why.message, snapshot), nodes=why.nodes or left.args, code=why.code)
    else:
        reason = f"I know of no way to make it so that {goal_phrase(left, snapshot)}."
    return Impossible(reason=reason, nodes=left.args)
