"""Where things are, for *on the table*, *next to the laptop* and *the nearest*."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from math import hypot, inf

from planner.goals import gap_m
from planner.grounding.settings import GroundingSettings
from scene_graph.identifiers import natural_key
from scene_graph.nodes import ROBOT_ID, DoorNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.state.state import PlanState


class Places:
    """Containment, nearness and distances of nodes on one graph."""

    def __init__(self, snapshot: Snapshot, state: PlanState, settings: GroundingSettings) -> None:
        self._snapshot, self._state, self._settings = snapshot, state, settings
        self._places: dict[str, frozenset[str]] = {}

    def is_at(self, node_id: str, place: str) -> bool:
        """Whether a node is in a room or region, or on or in a thing, perhaps with others in between."""
        return place in self._places_of(node_id)

    def at_any(self, found: Iterable[str], places: Iterable[str]) -> list[str]:
        """Those that are at one of the places."""
        wanted = frozenset(places)
        return [i for i in found if not wanted.isdisjoint(self._places_of(i))]

    def holding(self, places: Iterable[str], things: Iterable[str]) -> list[str]:
        """Those places at which one of the things is."""
        taken = {place for thing in things for place in self._places_of(thing)}
        return [place for place in places if place in taken]

    def origin(self, node_id: str) -> str | None:
        """Where a thing is now, as a place to put it back: its support, else its room."""
        return self._snapshot.support_of(node_id) or self._state.room_of(node_id)

    def in_same_room(self, found: Iterable[str], targets: tuple[str, ...]) -> list[str]:
        """Those in the room of one of the targets, which are not among them."""
        rooms = {self._state.room_of(target) for target in targets}
        return [i for i in found if self._state.room_of(i) in rooms and i not in targets]

    def next_to(self, found: list[str], targets: tuple[str, ...]) -> list[str]:
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
        close = [i for i in found if gaps[i] <= self._settings.next_to_m]
        return close or [i for i in found if gaps[i] <= self._settings.loosely_next_to_m]

    def by_distance(self, found: Iterable[str]) -> list[str]:
        """Reachable ones, the nearest to the robot first."""
        distances = [(self._distance_m(self._state.robot_at, i), natural_key(i), i) for i in found]
        return [i for distance_m, _, i in sorted(distances) if distance_m < inf]

    def closest(self, found: list[str], targets: tuple[str, ...], *, farthest: bool = False) -> list[str]:
        """The one nearest to a target, or farthest from all; none where no way leads."""
        others = [(min((self._distance_m(i, t) for t in targets if t != i), default=inf), i) for i in found]
        reachable = [(distance_m, i) for distance_m, i in others if distance_m < inf]
        sign = -1 if farthest else 1
        return [min(reachable, key=lambda pair: (sign * pair[0], natural_key(pair[1])))[1]] if reachable else []

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
