"""The symbolic state that skills' conditions and effects speak about; a picture of the graph in facts.

The verifier's search runs on it, and symbolic execution checks a plan with it before anything moves.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from scene_graph.snapshot import Snapshot
from skills.state.placement import Place, Placement, PlaceRelation
from skills.state.ways import Ways

__all__ = ["DoorLink", "PlaceRelation", "PlanState", "Thing", "World"]

_INSIDE = ("object", "person")


@dataclass(frozen=True, kw_only=True)
class Thing:
    """What planning needs to know of one node, and never changes while planning.

    ``kind`` is ``object``, ``room``, ``person`` or ``door``. ``room`` is where a fixed thing stands. ``width_m`` is the
    smaller horizontal extent, what the fingers must span. ``size_m``: extents, 0 where unknown. ``position_m``: map
    frame (``root``), on the floor.
    """

    id: str
    kind: str
    label: str
    room: str | None = None
    graspable: bool = False
    support: bool = False
    container: bool = False
    width_m: float = 0.0
    size_m: tuple[float, float, float] = (0.0, 0.0, 0.0)
    position_m: tuple[float, float] | None = None


@dataclass(frozen=True, kw_only=True)
class DoorLink:
    """A passage between two rooms; ``door`` names the first of the door nodes that are one door."""

    door: str
    rooms: tuple[str, str]
    open: bool = True


@dataclass(frozen=True, kw_only=True, eq=False)
class World:
    """What does not change during a plan: things, and the doors between rooms. Two worlds are equal when they are
    one. ``inside``: what is in a room; without it all things are gone through. ``fits``: whether things that
    come fit at a place beside those that stay; without it everything fits. ``bars``: what stands before a thing, in the
    way of the hand; without it nothing does.
    """

    things: Mapping[str, Thing]
    doors: tuple[DoorLink, ...]
    inside: Callable[[str], tuple[str, ...]] | None = None
    fits: Callable[[Thing, Collection[str], Collection[str]], bool] | None = None
    bars: Callable[[str], tuple[str, ...]] | None = None
    variants: dict[tuple[DoorLink, ...], World] = field(default_factory=dict, repr=False)

    def with_door(self, door: str, *, is_open: bool) -> World:
        """The world after a skill has opened or closed a door; one and the same however it came about."""
        self.variants.setdefault(self.doors, self)
        links = tuple(replace(link, open=is_open) if link.door == door else link for link in self.doors)
        return self.variants.setdefault(links, replace(self, doors=links))

    @cached_property
    def sides(self) -> Mapping[str, tuple[str, str]]:
        """The two rooms of each door."""
        return {link.door: link.rooms for link in self.doors}

    def distance_m(self, a: str, b: str) -> float | None:
        """Walking distance between two nodes through open doors, ``None`` if there is no way."""
        return self.ways.distance_m(a, b)

    def closed_doors(self, room_a: str, room_b: str) -> tuple[str, ...]:
        """Closed doors on the shortest way that would lead from one room to the other if every door were open."""
        return self.ways.closed_doors(room_a, room_b)

    def in_room(self, room: str | None) -> tuple[Thing, ...]:
        """The objects and persons in a room; what can be carried counts where it was before the plan."""
        if self.inside is not None:
            return tuple(self.things[node_id] for node_id in self.inside(room)) if room is not None else ()
        return tuple(thing for thing in self.things.values() if thing.room == room and thing.kind in _INSIDE)

    @cached_property
    def ways(self) -> Ways:
        """Shortest ways through the doors, computed once."""
        return Ways(self.whereabouts, tuple((link.door, link.rooms, link.open) for link in self.doors))

    def whereabouts(self, node_id: str) -> tuple[str | None, tuple[float, float] | None]:
        """Room and position of a node, as far as they are known."""
        thing = self.things.get(node_id)
        if thing is None:
            return None, None
        return thing.id if thing.kind == "room" else thing.room, thing.position_m


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanState:
    """Facts that plans change. Equal, and of equal hash, when the facts are.

    ``robot_at``: node the robot stands at (a room, object, person or door). ``holding``: object in the gripper.
    ``places``: object -> (relation, place) for every object that can be carried; held objects are absent.
    ``missing``: objects that are not where they should be. ``near``: more nodes the robot stands at, known only of the
    state read from a snapshot. ``beyond_walls``: the robot came from ``robot_room``, but is outside of its walls.
    """

    world: World
    robot_at: str
    robot_room: str | None
    holding: str | None
    places: Mapping[str, Place]
    missing: frozenset[str] = frozenset()
    near: frozenset[str] = frozenset()
    beyond_walls: bool = False

    @classmethod
    def from_snapshot(cls, snapshot: Snapshot) -> PlanState:
        """The facts that ``snapshot`` believes."""
        from skills.facts import read_state  # facts builds the classes of this module

        return read_state(snapshot)

    @cached_property
    def key(self) -> tuple[object, ...]:
        """The facts as one hashable value, the same for equal states."""
        places = self.places.key if isinstance(self.places, Placement) else frozenset(self.places.items())
        return (self.robot_at, self.holding, places, self.missing, self.near, self.robot_room, self.beyond_walls)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, PlanState) and self.world is other.world and self.key == other.key

    def __hash__(self) -> int:
        return self._hash

    @cached_property
    def _hash(self) -> int:
        return hash(self.key)

    def chain(self, node_id: str) -> Iterator[str]:
        """``node_id``, what it stands on or in, what that stands on or in, and so on; ends at a fixed thing."""
        seen: set[str] = set()
        while node_id not in seen:
            seen.add(node_id)
            yield node_id
            place = self.places.get(node_id)
            if place is None:
                return
            node_id = place[1]

    def room_of(self, node_id: str) -> str | None:
        """Room of a node as things stand in this state; of a door, the one on the robot's side."""
        for link in self.chain(node_id):
            if link == self.holding:
                return self.robot_room
            last = link
        thing = self.world.things.get(last)
        if thing is None:
            return None
        if thing.kind == "door" and thing.id in self.world.sides:
            return self._near_side(self.world.sides[thing.id])
        return thing.id if thing.kind == "room" else thing.room

    def _near_side(self, rooms: tuple[str, str]) -> str:
        """The robot's room, or one it can get to; the first, where it can get to neither."""
        here = self.robot_room
        if here is None or here in rooms:
            return here or rooms[0]
        return next((room for room in rooms if self.world.distance_m(here, room) is not None), rooms[0])

    def anchor(self, node_id: str) -> str:
        """The node whose known position stands for ``node_id`` in this state: itself unless it can be carried."""
        *_, last = self.chain(node_id)
        return self.robot_at if last == self.holding else last

    def distance_m(self, a: str, b: str) -> float | None:
        """Walking distance between two nodes as things stand in this state, ``None`` if there is no way."""
        return self.world.distance_m(self.anchor(a), self.anchor(b))

    def is_inside(self, room: str) -> bool:
        """Whether the robot is within the walls of a room."""
        return self.robot_room == room and not self.beyond_walls

    def is_at(self, node_id: str) -> bool:
        """Whether the robot stands at ``node_id``: at the node, or at what it stands on, or at its neighbor there."""
        around = {self.robot_at, *self.near}
        here = {link for node in around for link in self.chain(node) if self._is_spot(link)}
        return node_id in around or any(link in here for link in self.chain(node_id) if self._is_spot(link))

    def on_top_of(self, node_id: str) -> tuple[str, ...]:
        """Objects that stand on or in ``node_id``, sorted."""
        if isinstance(self.places, Placement):
            return tuple(sorted(self.places.at(node_id)))
        return tuple(sorted(thing for thing, (_, place) in self.places.items() if place == node_id))

    def standing_on(self, node_id: str) -> tuple[str, ...]:
        """Objects on ``node_id`` that are in the way of carrying it; what is in it is not. Sorted."""
        return tuple(thing for thing in self.on_top_of(node_id) if self.places[thing][0] is not PlaceRelation.IN)

    def in_the_way_of(self, node_id: str) -> tuple[str, ...]:
        """Objects that must be taken before an object can be: what stands on it, and what stands before it as long as
        both are where the graph has them.
        """
        before: tuple[str, ...] = ()
        if self.world.bars is not None and node_id in self.places and not self._came(node_id):
            before = tuple(x for x in self.world.bars(node_id) if x in self.places and not self._came(x))
        return (*self.standing_on(node_id), *before)

    def has_room_for(self, object_id: str, place: str) -> bool:
        """Whether an object fits on or in a place beside what is there in this state.

        What stood there in the graph fits there again while nothing has come.
        """
        target = self.world.things[place]
        if self.world.fits is None or target.kind != "object":
            return True
        there = self.on_top_of(place)
        if (
            isinstance(self.places, Placement)
            and self.places.was_at(object_id, place)
            and not any(map(self._came, there))
        ):
            return True
        stays = frozenset(thing for thing in there if not self._came(thing))
        return self.world.fits(target, stays, (object_id, *(thing for thing in there if thing not in stays)))

    def _came(self, object_id: str) -> bool:
        """Whether a plan has put an object where the graph did not have it."""
        return isinstance(self.places, Placement) and self.places.is_moved(object_id)

    def moved(self, object_id: str, place: Place | None) -> Mapping[str, Place]:
        """``places`` after an object was put somewhere, or taken away (None)."""
        if isinstance(self.places, Placement):
            return self.places.with_moved(object_id, place)
        kept = {thing: at for thing, at in self.places.items() if thing != object_id}
        return kept if place is None else {**kept, object_id: place}

    def after(self, **changes: object) -> PlanState:
        """A copy with ``changes``; ``places`` may be any mapping."""
        places = changes.get("places")
        if isinstance(self.places, Placement) and isinstance(places, Mapping) and not isinstance(places, Placement):
            changes["places"] = self.places.like(places)
        return replace(self, **changes)  # type: ignore[arg-type]

    def _is_spot(self, node_id: str) -> bool:
        """Whether being at ``node_id`` brings what stands there within reach: true of all but rooms and doors."""
        thing = self.world.things.get(node_id)
        return thing is not None and thing.kind in ("object", "person")
