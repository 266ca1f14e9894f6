"""A second look: what was full when it was last seen may have been cleared since, before a request is turned down."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from planner.goals import Goal
from planner.naming import capital, name_of
from planner.plan import Flaw, Impossible, Plan, Reinterpret, Source, Step
from planner.skill_planner.replanner import ObjectSearch, Verifier
from scene_graph.edits import PutNode
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.failures import FailureCode
from skills.furniture.standing import stands_on


class LookOnce(ObjectSearch):
    """A look at one support; nothing that is seen from farther away ends it early."""

    seen_there = "looked at what stands there"

    def found(self, snapshot: Snapshot) -> bool:
        """Never: it ends when the robot has looked."""
        del snapshot
        return False


class SecondLook:
    """Has the robot look at a support. Whether there is room on it then, the request says when it is planned anew."""

    def __init__(self, support: str, verifier: Verifier, stamp_s: float) -> None:
        self._support, self._verifier = support, verifier
        self._search = LookOnce(object_id=support, since_s=stamp_s)

    def look(self, snapshot: Snapshot) -> Plan | None:
        """The way to the support, if there is one."""
        plan = Plan(
            source=Source.SEARCH,
            revision=snapshot.revision,
            goals=(),
            steps=(Step(skill="GOTO", args=(self._support,)),),
            seeking=self._support,
        )
        return None if self._verifier.check_plan(plan, snapshot) else plan

    def told(self, snapshot: Snapshot) -> str:
        """What the robot is going to do, as a sentence."""
        name = capital(name_of(self._support, snapshot))
        return f"{name} was full when I last saw it; I will look whether it still is."

    def search_for(self, object_id: str) -> ObjectSearch:
        """The look itself."""
        del object_id
        return self._search

    def plan(self, goals: Sequence[Goal], snapshot: Snapshot, stamp_s: float) -> Plan | Impossible | Reinterpret:
        """Nothing but planning anew: the robot has looked, or could not get there."""
        del goals, snapshot, stamp_s
        return Reinterpret()

    def flaws(self, plan: Plan, snapshot: Snapshot) -> Sequence[Flaw]:
        """What keeps the rest of a plan from being carried out."""
        return self._verifier.check_plan(plan, snapshot) if plan.revision != snapshot.revision else ()


def perhaps_cleared(
    why: Impossible, goals: Sequence[Goal], verifier: Verifier, snapshot: Snapshot, stamp_s: float, *, fresh_s: float
) -> str | None:
    """The support that is why there is no plan to the goals, if there were one without what stood on it long ago.

    ``None`` where something else is why, or where the support is too small and stays so.
    ``fresh_s``: what was seen so long ago at most is still so.
    """
    support = why.nodes[0] if why.code is FailureCode.SUPPORT_FULL else ""
    if not isinstance(snapshot.get(support), ObjectNode):
        return None
    needed = {arg for goal in goals for arg in goal.args}
    stand = [node for node in stands_on(snapshot, support, None) if node.id not in needed]
    old = [node for node in stand if node.last_seen_s < stamp_s - fresh_s]
    if not old:
        return None
    supposed = WorkingMemory(snapshot)
    gone = [PutNode(replace(node, state=ObjectState.MISSING)) for node in old]
    cleared = supposed.commit(gone, agent="second look", stamp_s=stamp_s)
    return support if isinstance(verifier.plan_for(goals, cleared), Plan) else None
