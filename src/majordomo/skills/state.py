"""The symbolic state that skills' conditions and effects speak about; a picture of the graph in facts.

The verifier's search runs on it, and symbolic execution checks a plan with it before anything moves.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum
from functools import cached_property

from majordomo.scene_graph.snapshot import Snapshot
from majordomo.skills.ways import Ways


class PlaceRelation(StrEnum):
    """How an object is placed."""

    ON = "on"
    IN = "in"
    GIVEN = "given"


@dataclass(frozen=True, kw_only=True)
class Thing:
    """What planning needs to know of one node, and never changes while planning.

    ``kind`` is ``object``, ``room``, ``person`` or ``door``. ``room`` is where a fixed thing stands. ``width_m`` is the
    smaller horizontal extent, what the fingers must span. ``position_m``: map frame (``root``), on the floor.
    """

    id: str
    kind: str
    label: str
    room: str | None = None
    graspable: bool = False
    support: bool = False
    container: bool = False
    width_m: float = 0.0
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
    one.
    """

    things: Mapping[str, Thing]
    doors: tuple[DoorLink, ...]

    def distance_m(self, a: str, b: str) -> float | None:
        """Walking distance between two nodes through open doors, ``None`` if there is no way."""
        return self.ways.distance_m(a, b)

    def closed_doors(self, room_a: str, room_b: str) -> tuple[str, ...]:
        """Closed doors on the shortest way that would lead from one room to the other if every door were open."""
        return self.ways.closed_doors(room_a, room_b)

    @cached_property
    def ways(self) -> Ways:
        """Shortest ways through the doors, computed once."""
        rooms = {thing.id: thing.id if thing.kind == "room" else thing.room for thing in self.things.values()}
        positions = {thing.id: thing.position_m for thing in self.things.values()}
        return Ways(rooms, positions, tuple((link.door, link.rooms, link.open) for link in self.doors))


@dataclass(frozen=True, kw_only=True, eq=False)
class PlanState:
    """Facts that plans change. Equal, and of equal hash, when the facts are.

    ``robot_at``: node the robot stands at (a room, object, person or door). ``holding``: object in the gripper.
    ``places``: object -> (relation, place) for every object that can be carried; held objects are absent.
    ``missing``: objects that are not where they should be. ``near``: more nodes the robot stands at, known only of the
    state read from a snapshot.
    """

    world: World
    robot_at: str
    robot_room: str | None
    holding: str | None
    places: Mapping[str, tuple[PlaceRelation, str]]
    missing: frozenset[str] = frozenset()
    near: frozenset[str] = frozenset()

    @classmethod
    def from_snapshot(cls, snapshot: Snapshot) -> PlanState:
        """The facts that ``snapshot`` believes."""
        from majordomo.skills.facts import read_state  # facts builds the classes of this module

        return read_state(snapshot)

    @cached_property
    def key(self) -> tuple[object, ...]:
        """The facts as one hashable value, the same for equal states."""
        return (self.robot_at, self.holding, frozenset(self.places.items()), self.missing, self.near, self.robot_room)

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
        """Room of a node as things stand in this state."""
        for link in self.chain(node_id):
            if link == self.holding:
                return self.robot_room
            last = link
        thing = self.world.things.get(last)
        if thing is None:
            return None
        return thing.id if thing.kind == "room" else thing.room

    def anchor(self, node_id: str) -> str:
        """The node whose known position stands for ``node_id`` in this state: itself unless it can be carried."""
        *_, last = self.chain(node_id)
        return self.robot_at if last == self.holding else last

    def distance_m(self, a: str, b: str) -> float | None:
        """Walking distance between two nodes as things stand in this state, ``None`` if there is no way."""
        return self.world.distance_m(self.anchor(a), self.anchor(b))

    def is_at(self, node_id: str) -> bool:
        """Whether the robot stands at ``node_id``: at the node, or at what it stands on, or at its neighbor there."""
        around = {self.robot_at, *self.near}
        here = {link for node in around for link in self.chain(node) if self._is_spot(link)}
        return node_id in around or any(link in here for link in self.chain(node_id) if self._is_spot(link))

    def on_top_of(self, node_id: str) -> tuple[str, ...]:
        """Objects that stand on or in ``node_id``, sorted."""
        return tuple(sorted(thing for thing, (_, place) in self.places.items() if place == node_id))

    def after(self, **changes: object) -> PlanState:
        """A copy with ``changes``."""
        return replace(self, **changes)  # type: ignore[arg-type]

    def _is_spot(self, node_id: str) -> bool:
        """Whether being at ``node_id`` brings what stands there within reach: true of all but rooms and doors."""
        thing = self.world.things.get(node_id)
        return thing is not None and thing.kind in ("object", "person")
