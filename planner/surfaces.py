"""Where something can be put: surfaces, and what *next to* means in a symbolic state."""

from __future__ import annotations

from math import hypot, inf

from skills.state.state import PlanState, Thing


def surfaces_near(node_id: str, state: PlanState, near_m: float) -> tuple[str, ...]:
    """Surfaces on which something stands next to ``node_id``, the nearest first.

    Next to a thing that stands on a table is on that table; next to a piece of furniture or a person is on any surface
    within ``near_m``, the furniture's own included. Nothing is next to what is held or lies on the floor.
    """
    if node_id == state.holding or node_id not in state.world.things:
        return ()
    place = state.places.get(node_id)
    if place is not None:
        return (place[1],) if _is_surface(state.world.things[place[1]]) else ()
    thing = state.world.things[node_id]
    gaps = sorted((_gap_m(thing, other), other.id) for other in state.world.in_room(thing.room) if _is_surface(other))
    close = tuple(surface for gap_m, surface in gaps if gap_m <= near_m and surface not in state.missing)
    return close if thing.support or thing.kind == "person" else close[:1]


def _is_surface(thing: Thing) -> bool:
    return thing.kind == "object" and thing.support and not thing.graspable and not thing.container


def _gap_m(one: Thing, other: Thing) -> float:
    if one.id == other.id:
        return 0.0
    if one.room != other.room or one.position_m is None or other.position_m is None:
        return inf
    return hypot(one.position_m[0] - other.position_m[0], one.position_m[1] - other.position_m[1])
