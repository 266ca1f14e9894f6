"""Goals: what a request wants to be true, as predicates over graph identifiers (design, section 8).

A request is an ordered list of goals. They are achieved in order; each still holds at the end unless a later one
supersedes it (see ``superseded``): nobody stays in the kitchen who was then sent to the hall.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from math import hypot

from planner.errors import WrongArity
from planner.surfaces import surfaces_near
from scene_graph.errors import FramesNotConnected
from scene_graph.nodes import ObjectNode, ObjectState, PersonNode
from scene_graph.snapshot import Snapshot
from skills.facts import read_state
from skills.state.state import PlaceRelation, PlanState


@dataclass(frozen=True, kw_only=True)
class GoalSettings:
    """From when on goals count as true."""

    near_m: float = 1.5
    """Two things count as near each other when they are closer than this. Chosen: within two steps of a person."""
    given_m: float = 1.6
    """Something counts as given when it is out of the robot's hand and this close to the person, between extents.
    Chosen: what a person reaches for with one step, and more than the arm's reach.
    """
    fresh_s: float = 5.0
    """An object counts as seen *now* when it was seen this long ago or less. Chosen: a few frames' gap."""


class Predicate(StrEnum):
    """Closed set of goals; the value is what the API and the language model see. ``found`` is internal to *find*.

    ``open`` is about a door, and needs the skill of an installed package.
    """

    ON = "on"
    IN = "in"
    NEAR = "near"
    HOLDING = "holding"
    ROBOT_AT = "robot_at"
    GIVEN = "given"
    FOUND = "found"
    OPEN = "open"


ARITY: dict[Predicate, int] = {
    Predicate.ON: 2,
    Predicate.IN: 2,
    Predicate.NEAR: 2,
    Predicate.HOLDING: 1,
    Predicate.ROBOT_AT: 1,
    Predicate.GIVEN: 2,
    Predicate.FOUND: 1,
    Predicate.OPEN: 1,
}
PLACING = frozenset({Predicate.ON, Predicate.IN, Predicate.NEAR, Predicate.GIVEN})
"""Goals about where an object ends up; the first argument is the object, the second the place."""


@dataclass(frozen=True, kw_only=True)
class Goal:
    """One predicate over graph identifiers: ``on(cup_1, table_2)``.

    ``any_order``: nobody said whether it comes before or after the goal before it, as among *all the cups*; no part of
    what the goal says, so it does not count when goals are compared.
    """

    predicate: Predicate
    args: tuple[str, ...]
    any_order: bool = field(default=False, compare=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "predicate", Predicate(self.predicate))
        object.__setattr__(self, "args", tuple(self.args))
        if len(self.args) != ARITY[self.predicate]:
            raise WrongArity(self.predicate, len(self.args), ARITY[self.predicate])

    def __str__(self) -> str:
        return f"{self.predicate}({', '.join(self.args)})"

    @property
    def object_id(self) -> str | None:
        """The object that must be handled or seen, ``None`` for ``robot_at`` and ``open``."""
        return None if self.predicate in (Predicate.ROBOT_AT, Predicate.OPEN) else self.args[0]


def goal(predicate: str, *args: str) -> Goal:
    """Shorthand: ``goal("on", "cup_1", "table_2")``."""
    return Goal(predicate=Predicate(predicate), args=args)


def superseded(goals: Sequence[Goal], index: int) -> bool:
    """Whether a later goal makes it irrelevant that ``goals[index]`` stops holding."""
    this, later = goals[index], goals[index + 1 :]
    if this.predicate in (Predicate.ROBOT_AT, Predicate.FOUND):
        return bool(later)
    return this.object_id is not None and any(
        other.object_id == this.object_id and (other.predicate in PLACING or other.predicate is Predicate.HOLDING)
        for other in later
    )


def lasting(goals: Sequence[Goal]) -> tuple[Goal, ...]:
    """The goals that must hold when everything is done."""
    return tuple(this for index, this in enumerate(goals) if not superseded(goals, index))


def holds(goal: Goal, state: PlanState, settings: GoalSettings = GoalSettings()) -> bool:
    """Whether ``goal`` is true in a symbolic state."""
    first, second = goal.args[0], goal.args[-1]
    match goal.predicate:
        case Predicate.HOLDING:
            return state.holding == first
        case Predicate.ROBOT_AT:
            return state.is_inside(second) or state.is_at(second)
        case Predicate.OPEN:
            return any(link.door == first and link.open for link in state.world.doors)
        case Predicate.FOUND:
            return first not in state.missing and first in (state.holding, state.robot_at)
        case Predicate.GIVEN:
            return state.places.get(first) == (PlaceRelation.GIVEN, second)
        case Predicate.NEAR:
            return first not in state.missing and _near(state, first, second, settings.near_m)
        case Predicate.ON | Predicate.IN:
            return first not in state.missing and _placed(state, first, second)


def holds_in(
    goal: Goal, snapshot: Snapshot, *, since_s: float | None = None, settings: GoalSettings = GoalSettings()
) -> bool:
    """Whether the graph believes ``goal``. ``found``: the object was seen at or after ``since_s``."""
    first, second = goal.args[0], goal.args[-1]
    if any(arg not in snapshot for arg in goal.args):
        return False
    node = snapshot.node(first)
    if isinstance(node, ObjectNode) and node.state is ObjectState.MISSING:
        return False
    match goal.predicate:
        case Predicate.FOUND:
            threshold_s = snapshot.stamp_s - settings.fresh_s if since_s is None else since_s
            return isinstance(node, ObjectNode) and node.last_seen_s >= threshold_s
        case Predicate.GIVEN | Predicate.NEAR:
            limit_m = settings.given_m if goal.predicate is Predicate.GIVEN else settings.near_m
            same_room = snapshot.room_of(first) == snapshot.room_of(second)
            return same_room and not _held(snapshot, first) and gap_m(snapshot, first, second) <= limit_m
        case Predicate.ROBOT_AT if holds(goal, read_state(snapshot), settings):
            return True
        case Predicate.ROBOT_AT:
            here = snapshot.robot
            near = here is not None and gap_m(snapshot, here.id, second) <= settings.near_m
            return near and second not in _rooms(snapshot)
        case _:
            return holds(goal, read_state(snapshot), settings)


def _is_room(state: PlanState, node_id: str) -> bool:
    thing = state.world.things.get(node_id)
    return thing is not None and thing.kind == "room"


def _placed(state: PlanState, object_id: str, place_id: str) -> bool:
    if object_id not in state.places:
        return False
    if _is_room(state, place_id):
        return state.room_of(object_id) == place_id
    relation, place = state.places[object_id]
    return place == place_id and relation is not PlaceRelation.GIVEN


def _near(state: PlanState, first: str, second: str, near_m: float) -> bool:
    if first not in state.places:
        return False
    relation, place = state.places[first]
    if relation is PlaceRelation.GIVEN:
        return place == second
    return place in surfaces_near(second, state, near_m)


def _held(snapshot: Snapshot, object_id: str) -> bool:
    return snapshot.robot is not None and snapshot.robot.holding == object_id


def _rooms(snapshot: Snapshot) -> set[str]:
    return {node_id for node_id in snapshot.nodes if snapshot.room_of(node_id) == node_id}


def gap_m(snapshot: Snapshot, first: str, second: str) -> float:
    """Horizontal distance between the extents of two nodes; infinite when no frame connects them."""
    try:
        x_m, y_m, _ = (float(value) for value in snapshot.position(first, second))
    except FramesNotConnected:
        return float("inf")
    return max(hypot(x_m, y_m) - _radius_m(snapshot, first) - _radius_m(snapshot, second), 0.0)


def _radius_m(snapshot: Snapshot, node_id: str) -> float:
    node = snapshot.node(node_id)
    if isinstance(node, ObjectNode):
        return min(node.size_m[:2]) / 2
    return 0.25 if isinstance(node, PersonNode) else 0.0
