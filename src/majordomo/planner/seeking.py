"""Where to look for something that is not in its place, most likely first."""

from __future__ import annotations

from collections.abc import Collection
from math import inf

from majordomo.planner.goals import goal
from majordomo.planner.naming import name_of
from majordomo.planner.plan import Impossible, Plan, Source, Step
from majordomo.scene_graph.identifiers import natural_key
from majordomo.scene_graph.nodes import ObjectNode, RoomNode
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.skills.state import PlanState, Thing

LOOK_S = 6.0
"""Expected time to look at a place."""
SPEED_MPS = 0.4
"""Expected average speed of driving."""


def seeking_plan(
    object_id: str, snapshot: Snapshot, state: PlanState, since_s: float, already_looked: Collection[str]
) -> Plan | Impossible:
    """A tour of the places where ``object_id`` may be.

    Rooms nearest to where it was last known come first; in a room, surfaces that were never inspected, then the others,
    each time the nearest one, and at last the room as a whole. Left out is what was looked at since ``since_s`` or is
    in ``already_looked``, and what cannot be reached.
    """
    last_room = snapshot.room_of(object_id) or state.robot_room
    rooms = (room.id for room in snapshot.of_type(RoomNode))
    surfaces = (node.id for node in snapshot.of_type(ObjectNode) if node.support)
    places = (state.world.things[place] for place in (*rooms, *surfaces) if place in state.world.things)
    open_places = [
        thing
        for thing in places
        if thing.id != object_id and thing.id not in already_looked and _may_hold(thing, snapshot, since_s)
    ]
    reachable = [thing for thing in open_places if _distance_m(state, state.robot_at, thing.id) < inf]
    if not reachable:
        name = name_of(object_id, snapshot)
        return Impossible(reason=f"I have looked everywhere I can get to and did not find {name}.", nodes=(object_id,))
    tour, length_m = _tour(reachable, last_room, snapshot, state)
    return Plan(
        source=Source.SEARCH,
        revision=snapshot.revision,
        goals=(goal("found", object_id),),
        steps=tuple(Step(skill="GOTO", args=(place,)) for place in tour),
        expected_s=length_m / SPEED_MPS + LOOK_S * len(tour),
        expected_m=length_m,
        seeking=object_id,
    )


def _may_hold(thing: Thing, snapshot: Snapshot, since_s: float) -> bool:
    if thing.kind == "room":
        return True
    node = snapshot.get(thing.id)
    if not isinstance(node, ObjectNode) or not thing.support or thing.graspable:
        return False
    return node.inspected_s is None or node.inspected_s < since_s


def _tour(places: list[Thing], last_room: str | None, snapshot: Snapshot, state: PlanState) -> tuple[list[str], float]:
    rooms = sorted(
        {thing.room or thing.id for thing in places},
        key=lambda room: (_distance_m(state, last_room or room, room), natural_key(room)),
    )
    tour: list[str] = []
    here, length_m = state.robot_at, 0.0
    for room in rooms:
        left = [thing for thing in places if (thing.room or thing.id) == room]
        while left:
            best = min(left, key=lambda thing: (*_rank(thing, snapshot), _distance_m(state, here, thing.id), thing.id))
            length_m += _distance_m(state, here, best.id)
            here = best.id
            tour.append(best.id)
            left.remove(best)
    return tour, length_m


def _rank(thing: Thing, snapshot: Snapshot) -> tuple[bool, bool]:
    node = snapshot.get(thing.id)
    inspected = isinstance(node, ObjectNode) and node.inspected_s is not None
    return thing.kind == "room", inspected


def _distance_m(state: PlanState, a: str, b: str) -> float:
    distance = state.distance_m(a, b)
    return inf if distance is None else distance
