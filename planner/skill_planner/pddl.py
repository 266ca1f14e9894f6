"""A planning problem as PDDL text, for any planner that minimizes action costs (PDDL 2.1 with ``:action-costs``).

Typed STRIPS, costs in tenths of a second. Exported are the goals' things, what stands on or under them, what the hand
holds, and their rooms: no cheaper plan needs more. Goals come in their order, as ``turn``; in its turn a goal's own
object is moved, and what stands on or is in it out of the way, though the search carries along what is in it. Free
space is told as it is at the start; to find a thing is to come to where it is.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

from planner.goals import PLACING, Goal, Predicate, lasting
from planner.skill_planner.operators import GOTO, PICK, PLACE, Operators
from planner.skill_planner.stops import Stops
from skills.pick.pick import Pick
from skills.place.place import relation_to
from skills.skill import Skill
from skills.state.state import PlaceRelation, PlanState

UNITS_PER_S = 10
START = "start"
"""Where the robot stands at first; what is within reach from there need not be gone to."""

DOMAIN = """(define (domain majordomo)
  (:requirements :strips :typing :action-costs)
  (:types place item turn amount - object room spot - place)
  (:constants{constants})
  (:predicates
    (robot-at ?p - place) (hand-empty) (holding ?i - item) (fixed ?p - place) (leads ?from - place ?to - place)
    (part-of ?p - place ?r - room) (robot-in ?r - room) (reaches ?from - place ?s - spot)
    (located ?i - item ?s - spot) (upon ?i - item ?p - object) (inside ?i - item ?r - room)
    (floor ?s - spot ?i - item ?r - room) (surface ?s - spot) (graspable ?i - item)
    (bears ?i - item ?n - amount) (follows ?n - amount ?m - amount)
    (turn ?t - turn) (may-pick ?i - item ?t - turn) (may-put ?i - item ?p - object ?t - turn)
    (linked ?from - place ?to - place) (done))
  (:functions (total-cost) - number (way ?from - place ?to - place) - number)
  (:action goto
    :parameters (?from - place ?to - place ?out-of - room ?into - room)
    :precondition (and (robot-at ?from) (part-of ?from ?out-of) (part-of ?to ?into) (robot-in ?out-of)
      (fixed ?to) (linked ?from ?to))
    :effect (and (not (robot-at ?from)) (not (robot-in ?out-of)) (robot-at ?to) (robot-in ?into)
      (increase (total-cost) (way ?from ?to))))
  (:action goto-item
    :parameters (?from - place ?to - spot ?i - item ?j - item ?out-of - room ?into - room)
    :precondition (and (robot-at ?from) (part-of ?from ?out-of) (floor ?to ?j ?into) (robot-in ?out-of)
      (located ?i ?to) (linked ?from ?to))
    :effect (and (not (robot-at ?from)) (not (robot-in ?out-of)) (robot-at ?to) (robot-in ?into)
      (increase (total-cost) (way ?from ?to))))
  (:action pick
    :parameters (?i - item ?at - place ?s - spot ?p - place ?r - room ?t - turn)
    :precondition (and (turn ?t) (may-pick ?i ?t) (graspable ?i) (hand-empty) (robot-at ?at) (reaches ?at ?s)
      (surface ?s) (located ?i ?s) (upon ?i ?p) (inside ?i ?r) (bears ?i zero))
    :effect (and (not (hand-empty)) (not (located ?i ?s)) (not (upon ?i ?p)) (not (inside ?i ?r)) (holding ?i)
      (increase (total-cost) {pick})))
  (:action pick-up
    :parameters (?i - item ?at - place ?after - place ?s - spot ?r - room ?t - turn)
    :precondition (and (turn ?t) (may-pick ?i ?t) (graspable ?i) (hand-empty) (robot-at ?at) (reaches ?at ?s)
      (floor ?s ?i ?r) (leads ?at ?after) (located ?i ?s) (upon ?i ?r) (inside ?i ?r) (bears ?i zero))
    :effect (and (not (hand-empty)) (not (located ?i ?s)) (not (upon ?i ?r)) (not (inside ?i ?r)) (holding ?i)
      (not (robot-at ?at)) (robot-at ?after) (increase (total-cost) {pick})))
  (:action pick-off
    :parameters (?i - item ?at - place ?s - spot ?p - item ?r - room ?t - turn ?n - amount ?m - amount)
    :precondition (and (turn ?t) (may-pick ?i ?t) (graspable ?i) (hand-empty) (robot-at ?at) (reaches ?at ?s)
      (located ?i ?s) (upon ?i ?p) (inside ?i ?r) (bears ?i zero) (bears ?p ?n) (follows ?m ?n))
    :effect (and (not (hand-empty)) (not (located ?i ?s)) (not (upon ?i ?p)) (not (inside ?i ?r)) (holding ?i)
      (not (bears ?p ?n)) (bears ?p ?m) (increase (total-cost) {pick})))
  (:action place
    :parameters (?i - item ?at - place ?s - spot ?r - room ?t - turn)
    :precondition (and (turn ?t) (may-put ?i ?s ?t) (holding ?i) (robot-at ?at) (reaches ?at ?s) (surface ?s)
      (part-of ?s ?r))
    :effect (and (not (holding ?i)) (hand-empty) (located ?i ?s) (upon ?i ?s) (inside ?i ?r)
      (increase (total-cost) {place})))
  (:action place-on
    :parameters (?i - item ?at - place ?s - spot ?p - item ?r - room ?t - turn ?n - amount ?m - amount)
    :precondition (and (turn ?t) (may-put ?i ?p ?t) (holding ?i) (robot-at ?at) (reaches ?at ?s) (located ?p ?s)
      (part-of ?s ?r) (bears ?p ?n) (follows ?n ?m))
    :effect (and (not (holding ?i)) (hand-empty) (located ?i ?s) (upon ?i ?p) (inside ?i ?r)
      (not (bears ?p ?n)) (bears ?p ?m) (increase (total-cost) {place})))
  (:action put-down
    :parameters (?i - item ?s - spot ?r - room ?t - turn)
    :precondition (and (turn ?t) (may-put ?i ?r ?t) (holding ?i) (robot-in ?r) (floor ?s ?i ?r))
    :effect (and (not (holding ?i)) (hand-empty) (located ?i ?s) (upon ?i ?r) (inside ?i ?r)
      (increase (total-cost) {place})))
{turns})
"""


@dataclass(frozen=True, kw_only=True)
class Problem:
    """The two texts that a planner is given."""

    domain: str
    problem: str


def export(goals: Sequence[Goal], state: PlanState, skills: Mapping[str, Skill]) -> Problem:
    """Ordered ``goals`` from ``state`` as PDDL. The plan's cost is the search's in tenths of a second, rounded."""
    return _Export(goals, state, skills).text()


class _Export:
    """Collects the facts of one problem."""

    def __init__(self, goals: Sequence[Goal], state: PlanState, skills: Mapping[str, Skill]) -> None:
        self._goals, self._state, self._skills = tuple(goals), state, skills
        self._operators = Operators(skills, goals, state)
        self._places: list[tuple[str, ...]] = [self._operators.places(goal, state) for goal in goals]
        self._stops = Stops(self._spoken_of(), state)
        found = dict.fromkeys(link for node in self._spoken_of() for link in self._around(node))
        kinds = {node: state.world.things[node].kind for node in found}
        self._items = [node for node in found if node in state.places or node == state.holding]
        rooms = [state.robot_room, *(state.room_of(node) for node in found)]
        rooms += [node for node, kind in kinds.items() if kind == "room"]
        self._rooms = list(dict.fromkeys(room for room in rooms if room is not None))
        self._spots = [node for node in found if node not in self._items and kinds[node] != "room"]
        self._floors = {(item, room): f"floor-{item}-{room}" for item in self._items for room in self._rooms}

    def text(self) -> Problem:
        """Domain and problem."""
        constants = [*_typed(self._items, "item"), *_typed(self._rooms, "room"), *_typed(self._spots, "spot")]
        constants += [*_typed(self._floors.values(), "spot"), f"{START} - place", "zero - amount"]
        constants += _typed([f"t{k}" for k in range(len(self._goals) + 1)], "turn")
        domain = DOMAIN.format(
            constants="".join(f"\n    {entry}" for entry in constants),
            pick=self._units(PICK, (self._any_item(),)),
            place=self._units(PLACE, (self._any_item(), self._rooms[0] if self._rooms else "")),
            turns="\n".join(self._turns()),
        )
        facts = "".join(f"\n    {fact}" for fact in self._facts())
        numbers = " ".join(f"n{k}" for k in range(1, len(self._items) + 1))
        objects = f"\n  (:objects {numbers} - amount)" if numbers else ""
        problem = (
            f"(define (problem request)\n  (:domain majordomo){objects}\n  (:init{facts})\n"
            "  (:goal (done))\n  (:metric minimize (total-cost)))\n"
        )
        return Problem(domain=domain, problem=problem)

    def _spoken_of(self) -> Iterator[str]:
        for goal, places in zip(self._goals, self._places, strict=True):
            yield from goal.args
            yield from places
        if self._state.holding is not None:
            yield self._state.holding

    def _around(self, node: str) -> Iterator[str]:
        yield from self._state.chain(node)
        for above in self._state.on_top_of(node):
            if node in self._state.places:
                yield from self._around(above)

    def _any_item(self) -> str:
        return self._items[0] if self._items else ""

    def _facts(self) -> Iterator[str]:
        state = self._state
        yield "(= (total-cost) 0)"
        yield f"(robot-at {START})"
        if state.robot_room is not None:
            yield f"(robot-in {state.robot_room})"
            yield f"(part-of {START} {state.robot_room})"
        yield "(hand-empty)" if state.holding is None else f"(holding {state.holding})"
        yield "(turn t0)"
        yield from (f"(follows {a} {b})" for a, b in zip(self._numbers(), self._numbers()[1:], strict=False))
        yield from self._item_facts()
        yield from self._place_facts()
        yield from self._permissions()
        yield from self._ways()

    def _numbers(self) -> list[str]:
        return ["zero", *(f"n{k}" for k in range(1, len(self._items) + 1))]

    def _item_facts(self) -> Iterator[str]:
        state, pick = self._state, Pick()
        for item in self._items:
            yield f"(bears {item} {self._numbers()[len([i for i in state.on_top_of(item) if i in self._items])]})"
            beside = state.after(robot_at=item, holding=None, places=state.moved(item, None))
            if not any(unmet.final for unmet in pick.conditions(beside, (item,))) and item not in state.missing:
                yield f"(graspable {item})"
            if item != state.holding:
                *_, under = state.chain(item)
                room = state.room_of(item)
                spot = under
                if under in self._rooms:
                    spot = self._floors[self._bottom(item), under]
                yield f"(located {item} {spot})"
                yield f"(upon {item} {state.places[item][1]})"
                yield f"(inside {item} {room})"

    def _bottom(self, item: str) -> str:
        """The last link of a stack that can be carried."""
        *_, last = (link for link in self._state.chain(item) if link in self._items)
        return last

    def _place_facts(self) -> Iterator[str]:
        state = self._state
        yield f"(leads {START} {START})"
        for room in self._rooms:
            yield f"(part-of {room} {room})"
            yield f"(fixed {room})"
        for spot in self._spots:
            yield f"(fixed {spot})"
            yield f"(part-of {spot} {state.room_of(spot)})"
            thing = state.world.things[spot]
            if thing.kind in ("object", "person"):
                yield f"(reaches {spot} {spot})"
                yield f"(surface {spot})"
            if state.is_at(spot):
                yield f"(reaches {START} {spot})"
        for (item, room), spot in self._floors.items():
            yield f"(floor {spot} {item} {room})"
            yield f"(part-of {spot} {room})"
            yield f"(reaches {spot} {spot})"
            yield f"(leads {spot} {room})"
            if state.is_at(item) and item in state.places and state.anchor(item) == room:
                yield f"(reaches {START} {spot})"

    def _permissions(self) -> Iterator[str]:
        """What may be picked up and put where, in whose turn; in the end whatever an undone goal needs."""
        for turn in range(len(self._goals) + 1):
            now = [turn] if turn < len(self._goals) else range(len(self._goals))
            mine = {self._goals[k].object_id for k in now if self._goals[k].predicate is not Predicate.FOUND}
            for item in self._items:
                chain = {
                    *self._state.chain(item),
                    *(g.args[1] for g in self._goals if g.args[0] == item and g.args[1:]),
                }
                if mine & chain or item in mine:
                    yield f"(may-pick {item} t{turn})"
                if item not in mine or turn == len(self._goals):
                    later = self._goals[turn + 1 :]
                    rooms = (room for room in self._rooms if self._stops.may_lie_in(item, room, later))
                    yield from (f"(may-put {item} {room} t{turn})" for room in rooms)
            for k in now:
                yield from self._puts(k, turn)

    def _puts(self, k: int, turn: int) -> Iterator[str]:
        goal = self._goals[k]
        if goal.predicate in PLACING:
            roomy = (place for place in self._places[k] if self._state.has_room_for(goal.args[0], place))
            yield from (f"(may-put {goal.args[0]} {place} t{turn})" for place in roomy)

    def _ways(self) -> Iterator[str]:
        """Costs between all places; those of a floor are its room's."""
        nodes = {place: place for place in (*self._rooms, *self._spots) if place not in self._state.missing}
        nodes |= {spot: room for (_, room), spot in self._floors.items()}
        for (one, a), (other, b) in product([*nodes.items(), (START, self._state.robot_at)], nodes.items()):
            if self._state.distance_m(a, b) is not None:
                there = self._state.after(robot_at=a, robot_room=self._state.room_of(a), near=frozenset())
                yield f"(linked {one} {other})"
                yield f"(= (way {one} {other}) {self._units(GOTO, (b,), there)})"

    def _units(self, skill: str, args: tuple[str, ...], state: PlanState | None = None) -> int:
        return round(UNITS_PER_S * self._skills[skill].cost_s(state or self._state, args))

    def _turns(self) -> Iterator[str]:
        for k, goal in enumerate(self._goals):
            for n, condition in enumerate(self._ways_to_hold(goal, self._places[k])):
                effect = f"(and (not (turn t{k})) (turn t{k + 1}) (increase (total-cost) 0))"
                yield _action(f"goal-{k + 1}-{n + 1}", f"(turn t{k})", condition, effect)
        last = lasting(self._goals)
        kept = [self._ways_to_hold(goal, self._places[self._goals.index(goal)]) for goal in last]
        for n, conditions in enumerate(product(*kept)):
            effect = "(and (done) (increase (total-cost) 0))"
            yield _action(f"finish-{n + 1}", f"(turn t{len(self._goals)})", " ".join(conditions), effect)

    def _ways_to_hold(self, goal: Goal, places: Sequence[str]) -> list[str]:
        """Conditions each of which makes ``goal`` hold."""
        first, last = goal.args[0], goal.args[-1]
        match goal.predicate:
            case Predicate.HOLDING:
                return [f"(holding {first})"]
            case Predicate.OPEN:
                return [f"(passable {first})"]
            case Predicate.IN if last in self._rooms:
                return [f"(inside {first} {last})"]
            case Predicate.ROBOT_AT if last in self._rooms:
                return [f"(robot-in {last})"]
            case Predicate.ROBOT_AT | Predicate.FOUND if last in self._items:
                spots = [*self._spots, *(spot for (item, _), spot in self._floors.items() if item == last)]
                beside = [f"(robot-at {spot}) (located {last} {spot})" for spot in spots]
                return [*beside, f"(holding {last})"] if goal.predicate is Predicate.FOUND else beside
            case Predicate.ROBOT_AT | Predicate.FOUND:
                near = self._state.is_at(last) and goal.predicate is Predicate.ROBOT_AT
                return [f"(robot-at {last})", *([f"(robot-at {START})"] if near else [])]
            case _:
                given = PlaceRelation.GIVEN
                things = self._state.world.things
                fit = [p for p in places if goal.predicate is not Predicate.GIVEN or relation_to(things[p]) is given]
                return [f"(upon {first} {place})" for place in fit]


def _typed(names: Iterable[str], kind: str) -> list[str]:
    listed = " ".join(names)
    return [f"{listed} - {kind}"] if listed else []


def _action(name: str, turn: str, condition: str, effect: str) -> str:
    return f"  (:action {name}\n    :parameters ()\n    :precondition (and {turn} {condition})\n    :effect {effect})"
