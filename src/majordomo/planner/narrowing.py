"""Narrows what a noun may name by color, size, place and order: *the largest red cup next to the laptop*."""

from __future__ import annotations

from collections.abc import Iterable
from math import hypot, inf, prod
from typing import TYPE_CHECKING

from majordomo.planner.goals import gap_m
from majordomo.planner.grammar.syntax import NounPhrase, Pronoun, Restriction
from majordomo.scene_graph.identifiers import natural_key
from majordomo.scene_graph.nodes import ObjectNode, RoomNode
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.skills.state import PlanState

if TYPE_CHECKING:
    from majordomo.planner.grounding import Context, Grounding, NoReferent

BESIDE_M = 0.6
"""*Next to* means closer than this, between extents, if anything is; else ``LOOSELY_BESIDE_M``."""
LOOSELY_BESIDE_M = 1.5
CLEARLY = 1.2
"""*Big* fits what has more than this many times the volume of the next."""
SPATIAL = {
    "under": ("under", "below", "beneath", "underneath"),
    "behind": ("behind",),
    "in front of": ("in front of",),
    "over": ("over", "above"),
    "against": ("against", "attached to", "leaning on"),
}
"""Relations that a panoptic scene graph may hold, by the word that asks for them."""


class Narrowing:
    """Applies the modifiers of a noun phrase to candidates."""

    def __init__(self, snapshot: Snapshot, state: PlanState, grounding: Grounding) -> None:
        self._snapshot, self._state, self._grounding = snapshot, state, grounding

    def narrow(self, found: tuple[str, ...], phrase: NounPhrase, context: Context) -> tuple[str, ...]:
        """Those of ``found`` that fit color, restriction, size and superlative, in this order."""
        kept = [i for i in found if self._has_colors(i, phrase.colors)]
        if phrase.quantity == "this":
            kept = [i for i in kept if self._state.room_of(i) == self._snapshot.current_room] or kept
        if phrase.restriction is not None:
            kept = self.restricted(kept, phrase.restriction, context)
        for size in phrase.sizes:
            kept = self._sized(kept, size)
        if phrase.superlative is not None and kept:
            kept = self._extreme(kept, phrase.superlative)
        return tuple(kept)

    def restricted(self, found: Iterable[str], restriction: Restriction, context: Context) -> list[str]:
        """Those of ``found`` that are where ``restriction`` says."""
        relation = restriction.relation
        candidates = list(found)
        if relation == "held":
            return [i for i in candidates if i == self._state.holding]
        if relation in ("here", "there"):
            room = self._snapshot.current_room if relation == "here" else next(iter(context.places), None)
            return [i for i in candidates if room is not None and self.is_at(i, room)]
        targets = self.targets(restriction, context)
        if relation == "nearest":
            return self._closest(candidates, targets)
        if relation == "near":
            return self._beside(candidates, targets)
        if relation in ("on", "in", "from", "at"):
            return [i for i in candidates if any(self.is_at(i, target) for target in targets if target != i)]
        return [i for i in candidates if any(self._related(i, relation, target) for target in targets)]

    def targets(self, restriction: Restriction, context: Context) -> tuple[str, ...]:
        """Every node the restriction's reference may mean; *the cup on the table* does not ask which table."""
        reference = restriction.reference
        if reference is None:
            return ()
        if isinstance(reference, Pronoun):
            found = self._grounding.place(reference, context)
            return found if isinstance(found, tuple) else ()
        return self._grounding.matches(reference, context, widely=False)

    def missing_reference(self, phrase: NounPhrase, context: Context) -> NoReferent | None:
        """When it is the place in a restriction that nobody knows, that is the news."""
        restriction = phrase.restriction
        if restriction is None or not isinstance(restriction.reference, NounPhrase):
            return None
        if self.targets(restriction, context):
            return None
        return self._grounding.nothing(restriction.reference, context)

    def by_distance(self, found: Iterable[str]) -> list[str]:
        """Reachable ones, the nearest to the robot first."""
        distances = [(self._distance_m(self._state.robot_at, i), natural_key(i), i) for i in found]
        return [i for distance_m, _, i in sorted(distances) if distance_m < inf]

    def _has_colors(self, node_id: str, colors: tuple[str, ...]) -> bool:
        node = self._snapshot.node(node_id)
        return not colors or (isinstance(node, ObjectNode) and all(_color(node.color) == c for c in colors))

    def is_at(self, node_id: str, place: str) -> bool:
        """Whether a node is in a room, or on or in a thing, perhaps with others in between."""
        if isinstance(self._snapshot.get(place), RoomNode):
            return node_id != place and self._state.room_of(node_id) == place
        return place in list(self._chain(node_id))[1:]

    def _chain(self, node_id: str) -> Iterable[str]:
        seen: list[str] = []
        current: str | None = node_id
        while current is not None and current not in seen:
            seen.append(current)
            current = self._snapshot.support_of(current) if current in self._snapshot else None
        return seen

    def _beside(self, found: list[str], targets: tuple[str, ...]) -> list[str]:
        gaps = {
            i: min((gap_m(self._snapshot, i, target) for target in targets if self._together(i, target)), default=inf)
            for i in found
        }
        close = [i for i in found if gaps[i] <= BESIDE_M]
        return close or [i for i in found if gaps[i] <= LOOSELY_BESIDE_M]

    def _together(self, node_id: str, target: str) -> bool:
        return node_id != target and self._state.room_of(node_id) == self._state.room_of(target)

    def _closest(self, found: list[str], targets: tuple[str, ...]) -> list[str]:
        others = [(min((self._distance_m(i, t) for t in targets if t != i), default=inf), i) for i in found]
        reachable = [(distance_m, i) for distance_m, i in others if distance_m < inf]
        return [min(reachable, key=lambda pair: (pair[0], natural_key(pair[1])))[1]] if reachable else []

    def _related(self, node_id: str, relation: str, target: str) -> bool:
        names = next((words for words in SPATIAL.values() if relation in words), (relation,))
        return any(self._snapshot.relations(node_id, name, target) for name in names)

    def _sized(self, found: list[str], size: str) -> list[str]:
        """Of several, those clearly at that end of the sizes."""
        if len(found) < 2:
            return found
        ordered = sorted(found, key=self._volume_m3, reverse=size == "big")
        edge = self._volume_m3(ordered[0])
        limit = edge / CLEARLY if size == "big" else edge * CLEARLY
        return [i for i in found if (self._volume_m3(i) >= limit) == (size == "big") or self._volume_m3(i) == limit]

    def _extreme(self, found: list[str], superlative: str) -> list[str]:
        if superlative == "nearest":
            return self.by_distance(found)[:1]
        best = max if superlative == "largest" else min
        edge = best(self._volume_m3(i) for i in found)
        return [i for i in found if self._volume_m3(i) == edge]

    def _volume_m3(self, node_id: str) -> float:
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


def _area_m2(polygon: tuple[tuple[float, float], ...]) -> float:
    pairs = zip(polygon, (*polygon[1:], *polygon[:1]), strict=True)
    return abs(sum(ax * by - bx * ay for (ax, ay), (bx, by) in pairs)) / 2
