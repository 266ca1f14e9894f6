"""What does not change during a plan: the things that it is about, and the doors between rooms."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property

from skills.state.ways import Ways

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
