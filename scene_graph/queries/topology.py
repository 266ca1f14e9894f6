"""Rooms and doors as a graph: which way leads from one room to another, and how long it is."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import combinations, groupby, pairwise
from math import dist, inf
from typing import NamedTuple

from scene_graph.errors import FramesNotConnected, UnknownRoom
from scene_graph.nodes import DoorState, RegionNode, RoomNode
from scene_graph.queries.doors import PhysicalDoor, physical_doors
from scene_graph.queries.graph_library import igraph
from scene_graph.queries.poses import layout
from scene_graph.snapshot import Snapshot

__all__ = ["Path", "Topology", "layout", "path_between"]

Point = Sequence[float]


@dataclass(frozen=True, kw_only=True)
class Path:
    """A way through the building.

    Attributes:
        rooms: from start to goal, both included.
        doors: one less than rooms; each is named by its node in the room that it leaves, where there is one.
        length_m: straight lines from the start to the first door, from door to door, and to the goal.
    """

    rooms: tuple[str, ...]
    doors: tuple[str, ...]
    length_m: float


class _Leg(NamedTuple):
    """A straight line within one room, between its center and a door or between two doors."""

    room: str
    doors: tuple[PhysicalDoor, ...]
    points_m: tuple[tuple[float, float], ...]
    length_m: float


class Topology:
    """Vertices are rooms (their centers) and physical doors; edges are the straight lines between them in a room.

    Built for one snapshot. Distances are measured in room frames, so they do not depend on how well the rooms are laid
    out in the map.
    """

    def __init__(self, rooms: Sequence[str], doors: Sequence[PhysicalDoor], legs: Sequence[_Leg]) -> None:
        """Use ``from_snapshot``."""
        self._rooms = {room: i for i, room in enumerate(rooms)}
        self._doors = tuple(doors)
        self._doors_of = _doors_by_room(rooms, doors)
        self._legs = tuple(legs)
        vertex = {door.id: len(rooms) + i for i, door in enumerate(doors)}
        self._graph = igraph.Graph(n=len(rooms) + len(doors))
        self._graph.add_edges(
            [
                (vertex[leg.doors[0].id], vertex[leg.doors[1].id] if len(leg.doors) > 1 else self._rooms[leg.room])
                for leg in self._legs
            ]
        )

    @classmethod
    def from_snapshot(cls, snapshot: Snapshot) -> Topology:
        """The topology of all rooms and doors in the snapshot; computed once until one of them changes."""
        known = snapshot.passages.get(cls.__name__)
        if not isinstance(known, Topology):
            known = snapshot.passages[cls.__name__] = cls._computed(snapshot)
        return known

    @classmethod
    def _computed(cls, snapshot: Snapshot) -> Topology:
        doors = physical_doors(snapshot)
        rooms = [room.id for room in snapshot.of_type(RoomNode)]
        doors_of = _doors_by_room(rooms, doors)
        legs = [leg for room in rooms for leg in _legs_in(snapshot, room, doors_of[room])]
        return cls(rooms, doors, legs)

    def neighbors(self, room: str, *, only_open: bool = False) -> tuple[str, ...]:
        """Rooms that a door joins to this one, in natural order; by default closed doors count."""
        self._require(room)
        beyond = {
            other
            for door in self._doors_of[room]
            if not (only_open and door.state is DoorState.CLOSED)
            for other in door.rooms
        }
        return tuple(sorted(beyond - {room}, key=self._rooms.__getitem__))

    def path(
        self,
        room_a: str,
        room_b: str,
        avoid_doors: Collection[str] = frozenset(),
        only_open: bool = True,
        *,
        start_m: Point | None = None,
        goal_m: Point | None = None,
    ) -> Path | None:
        """The shortest way from one room to another, or None.

        Args:
            room_a: where it starts.
            room_b: where it ends.
            avoid_doors: doors not to use, named by any of their nodes.
            only_open: whether closed doors bar the way; doors of unknown state do not.
            start_m: starting point (x, y) in the frame of ``room_a``; its origin by default.
            goal_m: end point (x, y) in the frame of ``room_b``; its origin by default.

        Raises:
            UnknownRoom: one of the rooms does not exist.
        """
        a, b = self._require(room_a), self._require(room_b)
        start, goal = tuple(start_m or (0.0, 0.0))[:2], tuple(goal_m or (0.0, 0.0))[:2]
        if a == b:
            return Path(rooms=(room_a,), doors=(), length_m=dist(start, goal))
        barred = {door.id for door in self._doors if _is_barred(door, avoid_doors, only_open)}
        lengths = [self._length(leg, barred, {room_a: start, room_b: goal}) for leg in self._legs]
        length_m = self._graph.distances(a, b, weights=lengths)[0][0]
        if length_m == inf:
            return None
        legs = self._graph.get_shortest_path(a, b, weights=lengths, output="epath")
        return self._named([self._legs[leg] for leg in legs], length_m)

    def _require(self, room: str) -> int:
        if room not in self._rooms:
            raise UnknownRoom(room, self._rooms)
        return self._rooms[room]

    @staticmethod
    def _length(leg: _Leg, barred: Collection[str], ends: dict[str, tuple[float, ...]]) -> float:
        if any(door.id in barred for door in leg.doors):
            return inf
        if len(leg.doors) == 1 and leg.room in ends:
            return dist(leg.points_m[0], ends[leg.room])
        return leg.length_m

    def _named(self, legs: Sequence[_Leg], length_m: float) -> Path:
        stays = [(room, list(group)) for room, group in groupby(legs, key=lambda leg: leg.room)]
        doors: list[str] = []
        for (room, here), (_, there) in pairwise(stays):
            shared = next(door for door in here[-1].doors if any(door.id == other.id for other in there[0].doors))
            doors.append(shared.side(room).id)
        return Path(rooms=tuple(room for room, _ in stays), doors=tuple(doors), length_m=length_m)


def path_between(
    snapshot: Snapshot, source: str, target: str, *, avoid_doors: Collection[str] = frozenset(), only_open: bool = True
) -> Path | None:
    """The shortest way between two nodes of any type, measured from the one to the other; None when there is none.

    None is also the answer when one of them is in no known room. A region is reached in its nearest room.

    Raises:
        NodeNotFound: one of the nodes does not exist.
    """
    topology = Topology.from_snapshot(snapshot)
    ways = [
        topology.path(
            room_a,
            room_b,
            avoid_doors,
            only_open,
            start_m=_planar(snapshot, source, room_a),
            goal_m=_planar(snapshot, target, room_b),
        )
        for room_a in _rooms_of(snapshot, source)
        for room_b in _rooms_of(snapshot, target)
    ]
    return min((way for way in ways if way is not None), key=lambda way: way.length_m, default=None)


def _is_barred(door: PhysicalDoor, avoid_doors: Collection[str], only_open: bool) -> bool:
    closed = only_open and door.state is DoorState.CLOSED
    return closed or any(member.id in avoid_doors for member in door.members)


def _doors_by_room(rooms: Sequence[str], doors: Sequence[PhysicalDoor]) -> dict[str, list[PhysicalDoor]]:
    doors_of: dict[str, list[PhysicalDoor]] = {room: [] for room in rooms}
    for door in doors:
        for room in door.rooms:
            if room in doors_of:
                doors_of[room].append(door)
    return doors_of


def _legs_in(snapshot: Snapshot, room: str, doors: Sequence[PhysicalDoor]) -> list[_Leg]:
    here = [(door, _planar(snapshot, door.side(room).id, room)) for door in doors]
    to_center = [_Leg(room, (door,), (point,), dist(point, (0.0, 0.0))) for door, point in here]
    across = [_Leg(room, (a, b), (p, q), dist(p, q)) for (a, p), (b, q) in combinations(here, 2)]
    return [*to_center, *across]


def _rooms_of(snapshot: Snapshot, node_id: str) -> tuple[str, ...]:
    """The room that a node is in, or the rooms of a region."""
    if isinstance(snapshot.node(node_id), RegionNode):
        return snapshot.rooms_in(node_id)
    room = snapshot.room_of(node_id)
    return (room,) if room is not None else ()


def _planar(snapshot: Snapshot, node_id: str, room: str) -> tuple[float, float]:
    """Horizontal position of a node in a room, or the room's center for what has no place in it."""
    try:
        pose = snapshot.transform(room, node_id)
    except FramesNotConnected:
        return (0.0, 0.0)
    return (pose.x_m, pose.y_m)
