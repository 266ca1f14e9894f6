"""The symbolic state that skills' conditions and effects speak about; a picture of the graph in facts.

The verifier's search runs on it, and symbolic execution checks a plan with it before anything moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from skills.state.placement import Place, Placement, PlaceRelation
from skills.state.world import DoorLink, Thing, World

__all__ = ["DoorLink", "PlaceRelation", "PlanState", "Thing", "World"]


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
