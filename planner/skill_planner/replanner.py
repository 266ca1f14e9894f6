"""Plans from the graph as it is now: to the goals when their objects are where they should be, else to look for one."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import ClassVar, Protocol

from planner.controller.situation import is_missing
from planner.explainer.explainer import exhausted_reason
from planner.goals import Goal
from planner.plan import Flaw, Impossible, Plan, Reinterpret, Source
from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot


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

    def scouting_plan(
        self, kind: str, snapshot: Snapshot, since_s: float, already_looked: Sequence[str]
    ) -> Plan | None:
        """Places to look for a thing of a kind of which none was ever seen."""
        ...


@dataclass(kw_only=True)
class ObjectSearch:
    """The search for one object: since when, where the robot has looked, and where it could not get to.

    ``asked_s``: when the task was planned; ``by_looks``: what looks like it and turned up since then may be it, under
    another identifier. ``seen_there``: what is told of a place that was looked at.
    """

    seen_there: ClassVar[str] = "looked there, and did not find it"
    object_id: str
    since_s: float
    asked_s: float = 0.0
    by_looks: bool = True
    looked: list[str] = field(default_factory=list)
    skipped: list[str] = field(default_factory=list)

    def found(self, snapshot: Snapshot) -> bool:
        """Whether the object has been seen since the search began."""
        node = snapshot.get(self.object_id)
        if not isinstance(node, ObjectNode):
            return False
        seen = node.state is not ObjectState.MISSING and node.last_seen_s > self.since_s
        return seen or self.turned_up(snapshot)

    def turned_up(self, snapshot: Snapshot) -> bool:
        """Whether something that looks like it turned up after it was last seen itself."""
        return bool(self.look_alikes(snapshot))

    def look_alikes(self, snapshot: Snapshot) -> frozenset[str]:
        """What looks like it and turned up after it was last seen itself."""
        lost = snapshot.get(self.object_id)
        if not (self.by_looks and isinstance(lost, ObjectNode) and lost.state is ObjectState.MISSING):
            return frozenset()
        return frozenset(node.id for node in snapshot.of_type(ObjectNode) if self._is_like(node, lost, snapshot))

    def _is_like(self, node: ObjectNode, lost: ObjectNode, snapshot: Snapshot) -> bool:
        """Whether a thing has kind and color of a lost one, and was first seen after that was last seen and since the
        task was planned, and not only because what it stands on was not known before: it may always have stood there.
        """
        alike = (node.label, node.color, node.graspable) == (lost.label, lost.color, lost.graspable)
        place = snapshot.get(snapshot.support_of(node.id) or "")
        place_known = not isinstance(place, ObjectNode) or place.first_seen_s <= lost.last_seen_s
        later = node.first_seen_s > max(lost.last_seen_s, self.asked_s) and place_known
        return node.id != lost.id and node.state is ObjectState.PRESENT and alike and later


class PlanMaker(Protocol):
    """What a task under way asks for plans, until one is done or none is left."""

    def search_for(self, object_id: str) -> ObjectSearch | None:
        """The search for an object, if one has begun."""
        ...

    def plan(self, goals: Sequence[Goal], snapshot: Snapshot, stamp_s: float) -> Plan | Impossible | Reinterpret:
        """The next plan to the goals."""
        ...

    def flaws(self, plan: Plan, snapshot: Snapshot) -> Sequence[Flaw]:
        """What keeps the rest of a plan from being carried out."""
        ...


class Replanner:
    """Makes every plan of one task after its goals are known, and remembers the searches."""

    def __init__(self, verifier: Verifier, source: Source = Source.GRAMMAR) -> None:
        self._verifier, self._source = verifier, source
        self._searches: dict[str, ObjectSearch] = {}
        self._asked_s = 0.0

    def search_for(self, object_id: str) -> ObjectSearch | None:
        """The search for an object, if one has begun."""
        return self._searches.get(object_id)

    def first_plan(self, goals: Sequence[Goal], snapshot: Snapshot, stamp_s: float) -> Plan | Impossible:
        """The plan to begin with: where the words mean what is missing, that is looked for, whatever looks like it."""
        self._asked_s = stamp_s
        missing = _missing(goals, snapshot)
        if missing is None:
            return self._direct(goals, snapshot)
        search = self._begun(missing, stamp_s)
        search.by_looks = not search.turned_up(snapshot)
        return self._plan_of(search, snapshot)

    def plan(self, goals: Sequence[Goal], snapshot: Snapshot, stamp_s: float) -> Plan | Impossible | Reinterpret:
        """A plan to the goals, or a plan to look for the first object that is missing; what looks like that and turned
        up later has the request understood anew.
        """
        missing = _missing(goals, snapshot)
        if missing is None:
            return self._direct(goals, snapshot)
        search = self._begun(missing, stamp_s)
        turned_up = search.look_alikes(snapshot)
        return Reinterpret(displaced=turned_up | {missing}) if turned_up else self._plan_of(search, snapshot)

    def _direct(self, goals: Sequence[Goal], snapshot: Snapshot) -> Plan | Impossible:
        self._searches.clear()
        plan = self._verifier.plan_for(goals, snapshot)
        return replace(plan, source=self._source) if isinstance(plan, Plan) else plan

    def flaws(self, plan: Plan, snapshot: Snapshot) -> Sequence[Flaw]:
        """What keeps the rest of a plan from being carried out."""
        return self._verifier.check_plan(plan, snapshot) if plan.revision != snapshot.revision else ()

    def _begun(self, object_id: str, stamp_s: float) -> ObjectSearch:
        return self._searches.setdefault(
            object_id, ObjectSearch(object_id=object_id, since_s=stamp_s, asked_s=self._asked_s)
        )

    def _plan_of(self, search: ObjectSearch, snapshot: Snapshot) -> Plan | Impossible:
        object_id, been = search.object_id, (*search.looked, *search.skipped)
        plan = self._verifier.search_plan(object_id, snapshot, search.since_s, been)
        if isinstance(plan, Plan) and plan.steps:
            return plan
        reason = exhausted_reason(object_id, search.looked, search.skipped, snapshot)
        return Impossible(reason=reason, nodes=(object_id,), lost=object_id)


def _missing(goals: Sequence[Goal], snapshot: Snapshot) -> str | None:
    """The first node that goals need and that is not where it was."""
    return next((node_id for node_id in _needed(goals) if is_missing(node_id, snapshot)), None)


def _needed(goals: Sequence[Goal]) -> list[str]:
    """Nodes that the goals speak of, each once, in order."""
    return list(dict.fromkeys(arg for goal in goals for arg in goal.args))
