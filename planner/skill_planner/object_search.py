"""Where to look for something that is not in its place, most likely first."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from math import inf

from planner.goals import goal
from planner.language.lexicon.vocabulary import PERSON, words_for
from planner.naming import name_of
from planner.plan import Impossible, Plan, Source, Step
from planner.skill_planner.likely_rooms import room_weights
from planner.skill_planner.settings import ObjectSearchSettings
from scene_graph.identifiers import natural_key
from scene_graph.nodes import UNKNOWN_LABEL, ObjectNode, ObjectState, RoomNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState, Thing


def lost_object_plan(
    object_id: str,
    snapshot: Snapshot,
    state: PlanState,
    since_s: float,
    already_looked: Collection[str],
    settings: ObjectSearchSettings = ObjectSearchSettings(),
) -> Plan | Impossible:
    """A tour of the places where ``object_id`` may be.

    The next room is the one that is likeliest to hold it for the time that it takes to get there and to look through
    it; in a room, surfaces that were never inspected come first, then the others, each time the nearest one, and at
    last the room as a whole. Small things without a name that turned up after ``object_id`` was last seen are looked at
    from near: one of them may be it. Left out is what was looked at since ``since_s`` or is in ``already_looked``, and
    what cannot be reached.
    """
    node = snapshot.get(object_id)
    last_room = snapshot.room_of(object_id) or state.robot_room
    rooms = (room.id for room in snapshot.of_type(RoomNode))
    seen_s = node.last_seen_s if isinstance(node, ObjectNode) else inf
    places = (
        each.id
        for each in snapshot.of_type(ObjectNode)
        if each.support or (_is_unlabeled(each) and each.first_seen_s > seen_s)
    )
    reachable = _reachable((*rooms, *places), {object_id, *already_looked}, snapshot, state, since_s)
    if not reachable:
        name = name_of(object_id, snapshot)
        return Impossible(reason=f"I have looked everywhere I can get to and did not find {name}.", nodes=(object_id,))
    called = (node.label, *node.categories) if isinstance(node, ObjectNode) else ()
    plan = _plan(reachable, room_weights(called, last_room, snapshot, settings), snapshot, state, settings)
    return replace(plan, goals=(goal("found", object_id),), seeking=object_id)


def scouting_plan(
    kind: str,
    snapshot: Snapshot,
    state: PlanState,
    since_s: float,
    already_looked: Collection[str],
    settings: ObjectSearchSettings = ObjectSearchSettings(),
) -> Plan | None:
    """A tour of the places where a thing of a ``kind`` may be of which none was ever seen; None when none is left.

    As for a thing that is lost, but that it was nowhere before; and small things that have no name yet are
    looked at from near, since one of them may be it. People are in rooms, not on furniture.
    """
    rooms = (room.id for room in snapshot.of_type(RoomNode))
    nodes = snapshot.of_type(ObjectNode) if PERSON not in words_for(kind) else ()
    things = (node.id for node in nodes if node.support or _is_unlabeled(node))
    reachable = _reachable((*rooms, *things), set(already_looked), snapshot, state, since_s)
    if not reachable:
        return None
    weights = room_weights((kind,), None, snapshot, settings)
    return replace(_plan(reachable, weights, snapshot, state, settings), seeking=kind)


def _reachable(
    places: Iterable[str], without: set[str], snapshot: Snapshot, state: PlanState, since_s: float
) -> list[Thing]:
    things = [state.world.things[place] for place in places if place in state.world.things and place not in without]
    there = [thing for thing in things if _may_hold(thing, snapshot, since_s)]
    return [thing for thing in there if _distance_m(state, state.robot_at, thing.id) < inf]


def _plan(
    places: list[Thing],
    weights: Mapping[str, float],
    snapshot: Snapshot,
    state: PlanState,
    settings: ObjectSearchSettings,
) -> Plan:
    tour, length_m = _tour(places, weights, snapshot, state, settings)
    return Plan(
        source=Source.SEARCH,
        revision=snapshot.revision,
        goals=(),
        steps=tuple(Step(skill="GOTO", args=(place,)) for place in tour),
        expected_s=length_m / settings.speed_mps + settings.look_s * len(tour),
        expected_m=length_m,
    )


def _is_unlabeled(node: ObjectNode) -> bool:
    return node.graspable and node.label == UNKNOWN_LABEL and node.state is ObjectState.PRESENT


def _may_hold(thing: Thing, snapshot: Snapshot, since_s: float) -> bool:
    if thing.kind == "room":
        return True
    node = snapshot.get(thing.id)
    if isinstance(node, ObjectNode) and _is_unlabeled(node):
        return True
    if not isinstance(node, ObjectNode) or not thing.support or thing.graspable:
        return False
    return node.inspected_s is None or node.inspected_s < since_s


def _tour(
    places: list[Thing],
    weights: Mapping[str, float],
    snapshot: Snapshot,
    state: PlanState,
    settings: ObjectSearchSettings,
) -> tuple[list[str], float]:
    """The places in the order in which to look at them, and the length of the way."""
    tour: list[str] = []
    here, length_m = state.robot_at, 0.0
    rooms = _by_room(places)
    while rooms:
        worth = {room: _worth(room, there, weights, here, state, settings) for room, there in rooms.items()}
        room = min(worth, key=lambda room: (-worth[room], natural_key(room)))
        left = rooms.pop(room)
        while left:
            best = min(left, key=lambda thing: (*_rank(thing, snapshot), _distance_m(state, here, thing.id), thing.id))
            length_m += _distance_m(state, here, best.id)
            here = best.id
            tour.append(best.id)
            left.remove(best)
    return tour, length_m


def _by_room(places: Iterable[Thing]) -> dict[str, list[Thing]]:
    rooms: dict[str, list[Thing]] = {}
    for thing in places:
        rooms.setdefault(thing.room or thing.id, []).append(thing)
    return rooms


def _worth(
    room: str,
    places: Sequence[Thing],
    weights: Mapping[str, float],
    here: str,
    state: PlanState,
    settings: ObjectSearchSettings,
) -> float:
    """Likelihood per second: looking in that order finds a thing in the least time on the average."""
    way_m = min(_distance_m(state, here, thing.id) for thing in places)
    return weights.get(room, 1.0) / (way_m / settings.speed_mps + settings.look_s * len(places))


def _rank(thing: Thing, snapshot: Snapshot) -> tuple[bool, bool]:
    node = snapshot.get(thing.id)
    inspected = isinstance(node, ObjectNode) and node.inspected_s is not None
    return thing.kind == "room", inspected


def _distance_m(state: PlanState, a: str, b: str) -> float:
    distance = state.distance_m(a, b)
    return inf if distance is None else distance
