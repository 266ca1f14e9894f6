"""How a plan changes the graph, told before anything moves: the facts that will have come about, and gone."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass

from planner.goals import Goal, Predicate
from skills.state.state import PlanState


@dataclass(frozen=True, kw_only=True)
class Forecast:
    """Facts, as goals name them, that hold at a plan's end and did not before, and the other way round."""

    added: tuple[Goal, ...] = ()
    removed: tuple[Goal, ...] = ()


NO_CHANGES = Forecast()


def forecast(before: PlanState, after: PlanState, touched: Collection[str]) -> Forecast:
    """What differs between two states about the robot, the doors, and the nodes that a plan touches."""
    old, new = _facts(before, touched), _facts(after, touched)
    return Forecast(
        added=tuple(fact for fact in new if fact not in old), removed=tuple(fact for fact in old if fact not in new)
    )


def _facts(state: PlanState, touched: Collection[str]) -> list[Goal]:
    """Each fact once, in the order in which the nodes are touched; the robot's room last."""
    found = []
    for node_id in dict.fromkeys(touched):
        place = state.places.get(node_id)
        if node_id == state.holding:
            found.append(Goal(predicate=Predicate.HOLDING, args=(node_id,)))
        elif place is not None:
            found.append(Goal(predicate=Predicate(place[0].value), args=(node_id, place[1])))
        if any(link.door == node_id and link.open for link in state.world.doors):
            found.append(Goal(predicate=Predicate.OPEN, args=(node_id,)))
    if state.robot_room is not None:
        found.append(Goal(predicate=Predicate.ROBOT_AT, args=(state.robot_room,)))
    return found
