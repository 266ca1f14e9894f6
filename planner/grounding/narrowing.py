"""Narrows what a noun may name by color, size, place and order: *the largest red cup next to the laptop*."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import hypot, inf, prod
from typing import TYPE_CHECKING

from planner.goals import gap_m
from planner.grounding.naming import name_of
from planner.grounding.openness import OPENNESS, is_open
from planner.grounding.spatial import VIEWED, is_between, is_in_view, is_related, leftwards_m, relation_name
from planner.language.grammar.syntax import NounPhrase, Pronoun, Reference, Restriction
from scene_graph.identifiers import natural_key
from scene_graph.nodes import ROBOT_ID, DoorNode, ObjectNode, ObjectState, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState

if TYPE_CHECKING:
    from planner.grounding.grounding import Context, Grounding, NoReferent

BESIDE_M = 0.6
"""*Next to* means closer than this, between extents, if anything is; else ``LOOSELY_BESIDE_M``."""
LOOSELY_BESIDE_M = 1.5
CLEARLY = 1.2
"""*Big* fits what has more than this many times the volume of the next."""
BUILDING = frozenset({"house", "home", "building", "flat", "apartment", "place", "whole house", "entire house"})
"""Words for all that is known, which narrow nothing."""
KINDS_OF_BUILDING = frozenset({"school", "hospital", "office", "studio", "villa", "clinic", "ward"})
"""Words for it as well, where no room is called so."""
_LASTING = frozenset({"color", "state", "is", "kind", "sort", "spoken", "held", "of", "of person", "with"})
"""Relations that say what a thing is or whose, not where: those hold wherever it has been put."""
_COMPARATIVE = {
    "bigger": "largest",
    "larger": "largest",
    "taller": "largest",
    "smaller": "smallest",
    "shorter": "smallest",
}


class Narrowing:
    """Applies the modifiers of a noun phrase to candidates."""

    def __init__(self, snapshot: Snapshot, state: PlanState, grounding: Grounding) -> None:
        self._snapshot, self._state, self._grounding = snapshot, state, grounding
        self._places: dict[str, frozenset[str]] = {}

    def narrow(self, found: tuple[str, ...], phrase: NounPhrase, context: Context) -> tuple[str, ...]:
        """Those of ``found`` that fit color, restriction, size and superlative, in this order."""
        kept = self._colored(found, phrase.colors, any_of_them=phrase.either) if phrase.colors else list(found)
        if phrase.quantity == "this":
            kept = [i for i in kept if self._state.room_of(i) == self._snapshot.current_room] or kept
        for restriction in sorted(phrase.restrictions, key=lambda each: each.relation != "color"):
            kept = self.restricted(kept, restriction, context)
        kept = self._without(kept, phrase, context)
        for size in phrase.sizes:
            kept = self._sized(kept, size)
        if phrase.superlative is not None and kept:
            kept = self._extreme(kept, phrase.superlative, phrase.rank or 1)
        return tuple(kept)

    def _without(self, found: list[str], phrase: NounPhrase, context: Context) -> list[str]:
        excluded = {i for exception in phrase.exceptions for i in self.excepted(exception, phrase, context)}
        return [i for i in found if i not in excluded]

    def excepted(self, exception: Reference, phrase: NounPhrase, context: Context) -> tuple[str, ...]:
        """What *except the red one* leaves out of ``phrase``."""
        if isinstance(exception, NounPhrase):
            return self._grounding.matches(exception, replace(context, noun=phrase.head))
        found = self._grounding.things(exception, context)
        return found if isinstance(found, tuple) else ()

    def restricted(self, found: Iterable[str], restriction: Restriction, context: Context) -> list[str]:
        """Those of ``found`` that are where ``restriction`` says."""
        candidates = list(found)
        if restriction.relation == "color":
            candidates = [i for i in candidates if isinstance(self._snapshot.get(i), ObjectNode)]
        if restriction.negated and restriction.word in OPENNESS:
            other = "closed" if restriction.word == "open" else "open"
            return self._fitting(candidates, replace(restriction, word=other, negated=False), context)
        if restriction.negated:
            fitting = self._fitting(candidates, replace(restriction, negated=False), context)
            return [i for i in candidates if i not in fitting]
        fitting = self._fitting(candidates, restriction, context)
        if context.displaced.isdisjoint(candidates) or restriction.relation in _LASTING:
            return fitting
        return [i for i in candidates if i in fitting or i in context.displaced]

    def _fitting(self, candidates: list[str], restriction: Restriction, context: Context) -> list[str]:
        relation, reference = restriction.relation, restriction.reference
        if isinstance(reference, NounPhrase) and self.is_everywhere(reference):
            return candidates
        told = self._of_themselves(candidates, restriction, context)
        if told is not None:
            return told
        targets = self.targets(restriction, context)
        if relation in ("nearest", "farthest"):
            return self._closest(candidates, targets, farthest=relation == "farthest")
        if relation in ("of", "of person"):
            return self._of(candidates, targets, restriction)
        if relation == "near" and any(isinstance(self._snapshot.get(i), RoomNode) for i in candidates):
            doors = [set(door.rooms) for door in self._state.world.doors]
            return [i for i in candidates if any({i, target} in doors for target in targets)]
        if relation == "near":
            return self._beside(candidates, targets)
        if relation == "between":
            others = self.targets(Restriction(relation="at", reference=restriction.other), context)
            return [i for i in candidates if any(self._is_between(i, a, b) for a in targets for b in others)]
        if relation == "with":
            return self._holding(candidates, targets)
        if relation == "same room":
            rooms = {self._state.room_of(target) for target in targets}
            return [i for i in candidates if self._state.room_of(i) in rooms and i not in targets]
        if relation in ("on", "in", "from", "at", "to", "into", "out of"):
            if restriction.other is not None:
                targets += self.targets(replace(restriction, reference=restriction.other, other=None), context)
            return self._at_any(candidates, targets)
        return [i for i in candidates if any(is_related(i, relation, target, self._snapshot) for target in targets)]

    def _of_themselves(self, candidates: list[str], restriction: Restriction, context: Context) -> list[str] | None:
        """What is told without a second thing: color, state, *on the floor*, *the red one*, *here*; None of others."""
        here = self._snapshot.current_room
        match restriction.relation:
            case "color":
                return self._colored(candidates, (restriction.word,))
            case "state":
                return [i for i in candidates if self._is_state(i, restriction.word)]
            case "floor":
                return [i for i in candidates if self._snapshot.support_of(i) is None]
            case "is" | "kind":
                return [i for i in candidates if i in self._alike(candidates, restriction)]
            case "sort":
                return self._of_sort(candidates, restriction)
            case "spoken" if restriction.reference is not None:
                spoken = self._grounding.things(restriction.reference, context)
                return [i for i in candidates if i in spoken] if isinstance(spoken, tuple) else []
            case "held":
                return [i for i in candidates if i == self._state.holding]
            case "here":
                return [i for i in candidates if here is not None and self.is_at(i, here)]
            case "there":
                return self._there(candidates, context)
            case _:
                return None

    def _is_between(self, node_id: str, one: str, other: str) -> bool:
        node = self._snapshot.get(node_id)
        if isinstance(node, DoorNode):
            return {one, other} <= set(node.rooms)
        return is_between(node_id, one, other, self._snapshot)

    def _alike(self, candidates: list[str], restriction: Restriction) -> tuple[str, ...]:
        """Those of ``candidates`` that *are the red one*, or *look like a tool*."""
        phrase = restriction.reference
        if not isinstance(phrase, NounPhrase):
            return ()
        if restriction.relation == "is":
            return self._grounding.among(candidates, phrase)
        alike = self._grounding.matches(phrase, self._grounding.nowhere)
        return tuple(i for i in candidates if i in alike)

    def _there(self, candidates: list[str], context: Context) -> list[str]:
        """Those in the room spoken of last in which there are any."""
        spoken = (*context.places, *context.fresh, *context.mentioned)
        rooms = [room for i in spoken if (room := self._state.room_of(i)) is not None]
        for room in (*rooms, self._snapshot.current_room):
            found = [i for i in candidates if room is not None and self.is_at(i, room)]
            if found:
                return found
        return []

    def _of(self, candidates: list[str], targets: tuple[str, ...], restriction: Restriction) -> list[str]:
        """*the desk of Anna*, *the pharmacy's counter*, *the bowl of fruit*."""
        if not targets and isinstance(restriction.reference, Pronoun):
            return candidates
        people = tuple(i for i in targets if isinstance(self._snapshot.get(i), PersonNode))
        if people:
            return self._owned(candidates, people)
        there = self._at_any(candidates, targets)
        return there or self._holding(candidates, targets)

    def _owned(self, found: list[str], owners: tuple[str, ...]) -> list[str]:
        """*Anna's mug*: the only one there is, else what is where Anna is; her room is the one she is in."""
        rooms = {self._state.room_of(owner) for owner in owners}
        if any(isinstance(self._snapshot.get(i), RoomNode) for i in found):
            return [i for i in found if i in rooms]
        return found if len(found) == 1 else [i for i in found if self._state.room_of(i) in rooms]

    def _is_state(self, node_id: str, word: str) -> bool:
        node = self._snapshot.get(node_id)
        if word in ("lost", "missing", "gone"):
            return isinstance(node, ObjectNode) and node.state is ObjectState.MISSING
        return is_open(node_id, self._snapshot) is (word == "open")

    def targets(self, restriction: Restriction, context: Context) -> tuple[str, ...]:
        """Every node the restriction's reference may mean; *the cup on the table* does not ask which table."""
        reference = restriction.reference
        if reference is None:
            return ()
        if not isinstance(reference, NounPhrase):
            found = self._grounding.place(reference, context)
            return found if isinstance(found, tuple) else ()
        found = self._grounding.meant(reference, context, widely=False)
        if reference.other:
            spoken = {*context.fresh, *context.mentioned}
            return tuple(i for i in found if i not in spoken) or found
        return found

    def missing_reference(self, phrase: NounPhrase, context: Context) -> NoReferent | None:
        """When it is the place in a restriction that nobody knows, that is the news."""
        for restriction in phrase.restrictions:
            for reference in (restriction.reference, restriction.other):
                trouble = self._unmet(replace(restriction, reference=reference), context)
                if trouble is not None:
                    return trouble
        for exception in phrase.exceptions:
            if isinstance(exception, NounPhrase) and not self.excepted(exception, phrase, context):
                return self._grounding.nothing(exception, replace(context, noun=phrase.head))
        return None

    def _unmet(self, restriction: Restriction, context: Context) -> NoReferent | None:
        reference = restriction.reference
        if not isinstance(reference, NounPhrase) or self.is_everywhere(reference):
            return None
        targets = self.targets(restriction, context)
        if not targets:
            return self._grounding.nothing(reference, context)
        relation = relation_name(restriction.relation)
        if relation in VIEWED and not any(is_in_view(target, self._snapshot) for target in targets):
            return self._grounding.unseen(f"{relation} {name_of(targets[0], self._snapshot)}")
        return None

    def is_everywhere(self, place: NounPhrase) -> bool:
        """*In the house*, *in our school*: the whole building."""
        known = self._grounding.names.named(place.head, None, widely=False)
        return place.head in BUILDING or (place.head in KINDS_OF_BUILDING and not known)

    def by_distance(self, found: Iterable[str]) -> list[str]:
        """Reachable ones, the nearest to the robot first."""
        distances = [(self._distance_m(self._state.robot_at, i), natural_key(i), i) for i in found]
        return [i for distance_m, _, i in sorted(distances) if distance_m < inf]

    def _colored(self, found: Sequence[str], colors: Sequence[str], *, any_of_them: bool = False) -> list[str]:
        """Those of these colors; where none is, those that have them too: a phone is called by the color of its case,
        and what is seen of it is its screen.
        """
        has = any if any_of_them else all
        nodes = [(i, node) for i in found if isinstance(node := self._snapshot.node(i), ObjectNode)]
        mainly = [i for i, node in nodes if has(_color(node.color) == color for color in colors)]
        return mainly or [i for i, node in nodes if has(color in _colors(node) for color in colors)]

    def is_at(self, node_id: str, place: str) -> bool:
        """Whether a node is in a room or region, or on or in a thing, perhaps with others in between."""
        return place in self._places_of(node_id)

    def _of_sort(self, candidates: list[str], restriction: Restriction) -> list[str]:
        """Those that a noun may name, in its widest sense."""
        noun = restriction.reference.head if isinstance(restriction.reference, NounPhrase) else ""
        named = frozenset(self._grounding.names.named(noun, None, widely=True))
        return [i for i in candidates if i in named]

    def _at_any(self, found: Iterable[str], places: Iterable[str]) -> list[str]:
        """Those that are at one of the places."""
        wanted = frozenset(places)
        return [i for i in found if not wanted.isdisjoint(self._places_of(i))]

    def _holding(self, places: Iterable[str], things: Iterable[str]) -> list[str]:
        """Those places at which one of the things is."""
        taken = {place for thing in things for place in self._places_of(thing)}
        return [place for place in places if place in taken]

    def _places_of(self, node_id: str) -> frozenset[str]:
        """Everything that a node is in, on, or on something that is; of a door both rooms."""
        if node_id not in self._places:
            self._places[node_id] = self._find_places(node_id)
        return self._places[node_id]

    def _find_places(self, node_id: str) -> frozenset[str]:
        node = self._snapshot.get(node_id)
        if isinstance(node, DoorNode):
            return frozenset(room for room in node.rooms if room is not None)
        room = self._state.room_of(node_id)
        here = self._state.robot_room if node_id == ROBOT_ID else room
        region = self._snapshot.region_of(room) if room is not None else None
        around = [i for i in (here, region) if i is not None and i != node_id]
        carriers = [i for i in list(self._chain(node_id))[1:] if not isinstance(self._snapshot.get(i), RoomNode)]
        return frozenset((*around, *carriers))

    def _chain(self, node_id: str) -> Iterable[str]:
        seen: list[str] = []
        current: str | None = node_id
        while current is not None and current not in seen:
            seen.append(current)
            current = self._snapshot.support_of(current) if current in self._snapshot else None
        return seen

    def _beside(self, found: list[str], targets: tuple[str, ...]) -> list[str]:
        """Those next to a target: in its room, and neither carries the other."""
        carriers = {target: frozenset(self._chain(target)) for target in targets}
        in_room: dict[str | None, list[str]] = defaultdict(list)
        for target in targets:
            in_room[self._state.room_of(target)].append(target)
        gaps = dict.fromkeys(found, inf)
        for i in found:
            if isinstance(self._snapshot.get(i), RoomNode):
                continue
            own = frozenset(self._chain(i))
            others = [t for t in in_room[self._state.room_of(i)] if t not in own and i not in carriers[t]]
            gaps[i] = min((gap_m(self._snapshot, i, other) for other in others), default=inf)
        close = [i for i in found if gaps[i] <= BESIDE_M]
        return close or [i for i in found if gaps[i] <= LOOSELY_BESIDE_M]

    def _closest(self, found: list[str], targets: tuple[str, ...], *, farthest: bool = False) -> list[str]:
        others = [(min((self._distance_m(i, t) for t in targets if t != i), default=inf), i) for i in found]
        reachable = [(distance_m, i) for distance_m, i in others if distance_m < inf]
        sign = -1 if farthest else 1
        return [min(reachable, key=lambda pair: (sign * pair[0], natural_key(pair[1])))[1]] if reachable else []

    def _sized(self, found: list[str], size: str) -> list[str]:
        """Of several, those clearly at that end of the sizes."""
        if len(found) < 2:
            return found
        if size in _COMPARATIVE:
            if len(found) == 2:
                return self._extreme(found, _COMPARATIVE[size], 1)
            size = "big" if _COMPARATIVE[size] == "largest" else "small"
        ordered = sorted(found, key=self.volume_m3, reverse=size == "big")
        edge = self.volume_m3(ordered[0])
        limit = edge / CLEARLY if size == "big" else edge * CLEARLY
        return [i for i in found if (self.volume_m3(i) >= limit) == (size == "big") or self.volume_m3(i) == limit]

    def _extreme(self, found: list[str], superlative: str, rank: int) -> list[str]:
        """The first, second … at one end; several when they are as near or large as each other."""
        if superlative in ("nearest", "farthest"):
            ordered = self.by_distance(found)
            return (ordered if superlative == "nearest" else ordered[::-1])[rank - 1 : rank]
        if superlative in ("leftmost", "rightmost"):
            return self._at_side(found, superlative)[rank - 1 : rank]
        volumes = sorted({self.volume_m3(i) for i in found}, reverse=superlative == "largest")
        edge = volumes[rank - 1 : rank]
        return [i for i in found if self.volume_m3(i) in edge]

    def _at_side(self, found: list[str], side: str) -> list[str]:
        """From left to right or back, as the robot sees them; all as they are when it does not."""
        if not all(is_in_view(i, self._snapshot) for i in found):
            return []
        left = {i: leftwards_m(i, tuple(found), self._snapshot) for i in found}
        return sorted(found, key=lambda i: -left[i] if side == "leftmost" else left[i])

    def volume_m3(self, node_id: str) -> float:
        """Of an object; of a room its area, in m²; 0 of others."""
        node = self._snapshot.node(node_id)
        if isinstance(node, ObjectNode):
            return prod(node.size_m)
        if isinstance(node, RoomNode):
            return _area_m2(node.polygon_m)
        return 0.0

    def _distance_m(self, a: str, b: str) -> float:
        """Walking distance; within one room the straight line between the things themselves."""
        distance = self._state.distance_m(a, b)
        if distance is None:
            return inf
        things = self._state.world.things
        one, other = things.get(a), things.get(b)
        if one and other and one.room == other.room and one.position_m and other.position_m:
            return hypot(one.position_m[0] - other.position_m[0], one.position_m[1] - other.position_m[1])
        return distance


def _color(color: str) -> str:
    return {"grey": "gray"}.get(color.casefold(), color.casefold())


def _colors(node: ObjectNode) -> frozenset[str]:
    return frozenset(map(_color, (node.color, *node.accents)))


def _area_m2(polygon: tuple[tuple[float, float], ...]) -> float:
    pairs = zip(polygon, (*polygon[1:], *polygon[:1]), strict=True)
    return abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in pairs)) / 2
