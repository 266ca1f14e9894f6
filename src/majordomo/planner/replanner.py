"""Plans from the graph as it is now: to the goals when their objects are where they should be, else to look for one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Protocol

from majordomo.planner.explainer import exhausted_reason
from majordomo.planner.goals import Goal
from majordomo.planner.plan import Flaw, Impossible, Plan, Source
from majordomo.planner.situation import is_missing
from majordomo.scene_graph.nodes import ObjectNode, ObjectState
from majordomo.scene_graph.snapshot import Snapshot


class Verifier(Protocol):
    """What the verifier offers: plans that are checked, checks of plans, and plans that search."""

    def plan_for(self, goals: Sequence[Goal], snapshot: Snapshot) -> Plan | Impossible:
        """Steps that achieve ``goals`` in order."""
        ...

    def check_plan(self, plan: Plan, snapshot: Snapshot) -> Sequence[Flaw]:
        """What keeps ``plan`` from being carried out on this graph; empty when nothing does."""
        ...

    def search_plan(
        self, object_id: str, snapshot: Snapshot, since_s: float, already_looked: Sequence[str]
    ) -> Plan | Impossible:
        """Places to look for an object, most likely first."""
        ...


@dataclass(kw_only=True)
class Hunt:
    """The search for one object: since when, where the robot has looked, and where it could not get to."""

    object_id: str
    since_s: float
    looked: list[str] = field(default_factory=list)
    skipped: list[str] = field(default_factory=list)

    def found(self, snapshot: Snapshot) -> bool:
        """Whether the object has been seen since the search began."""
        node = snapshot.get(self.object_id)
        present = isinstance(node, ObjectNode) and node.state is not ObjectState.MISSING
        return present and isinstance(node, ObjectNode) and node.last_seen_s > self.since_s


class Replanner:
    """Makes every plan of one task after its goals are known, and remembers the searches."""

    def __init__(self, verifier: Verifier, source: Source = Source.GRAMMAR) -> None:
        self._verifier, self._source = verifier, source
        self._hunts: dict[str, Hunt] = {}

    def hunt(self, object_id: str) -> Hunt | None:
        """The search for an object, if one has begun."""
        return self._hunts.get(object_id)

    def plan(self, goals: Sequence[Goal], snapshot: Snapshot, stamp_s: float) -> Plan | Impossible:
        """A plan to the goals, or a plan to look for the first object that is missing."""
        missing = next((node_id for node_id in _needed(goals) if is_missing(node_id, snapshot)), None)
        if missing is not None:
            return self._search(missing, snapshot, stamp_s)
        self._hunts.clear()
        plan = self._verifier.plan_for(goals, snapshot)
        return replace(plan, source=self._source) if isinstance(plan, Plan) else plan

    def flaws(self, plan: Plan, snapshot: Snapshot) -> Sequence[Flaw]:
        """What keeps the rest of a plan from being carried out."""
        return self._verifier.check_plan(plan, snapshot) if plan.revision != snapshot.revision else ()

    def _search(self, object_id: str, snapshot: Snapshot, stamp_s: float) -> Plan | Impossible:
        hunt = self._hunts.setdefault(object_id, Hunt(object_id=object_id, since_s=stamp_s))
        been = (*hunt.looked, *hunt.skipped)
        plan = self._verifier.search_plan(object_id, snapshot, hunt.since_s, been)
        if isinstance(plan, Plan) and plan.steps:
            return plan
        reason = exhausted_reason(object_id, hunt.looked, hunt.skipped, snapshot)
        return Impossible(reason=reason, nodes=(object_id,), lost=object_id)


def _needed(goals: Sequence[Goal]) -> list[str]:
    """Nodes that the goals speak of, each once, in order."""
    return list(dict.fromkeys(arg for goal in goals for arg in goal.args))
