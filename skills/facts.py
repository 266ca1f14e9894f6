"""Reads the facts that planning needs from a snapshot of the graph."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from functools import cache, partial
from typing import TypeGuard

from scene_graph.edges import EdgeType
from scene_graph.nodes import (
    ROOT_ID,
    DoorNode,
    DoorState,
    Node,
    ObjectNode,
    ObjectState,
    PersonNode,
    RoomNode,
    RoomStatus,
)
from scene_graph.queries.doors import physical_doors
from scene_graph.queries.poses import MapPoses
from scene_graph.snapshot import Snapshot
from skills.arm.barring import barring
from skills.arm.hand import Hand
from skills.furniture.kinds import is_container
from skills.goto.nearness import is_at
from skills.goto.settings import NearnessSettings
from skills.obstacles.walls import robot_beyond_m
from skills.place.capacity import Capacity
from skills.room_contents import in_room
from skills.settings import SkillSettings
from skills.state.placement import Place, Placement, PlaceRelation
from skills.state.state import DoorLink, PlanState, Thing, World

_KINDS = (RoomNode, DoorNode, ObjectNode, PersonNode)


def read_state(snapshot: Snapshot, hand: Hand = Hand(), settings: SkillSettings = SkillSettings()) -> PlanState:
    """The facts that ``snapshot`` believes. Of thousands of things only those are read that a plan asks for.

    ``hand``: what the robot can take hold of, and where that fits; ``settings``: of the skills.
    """
    robot, room = snapshot.robot, snapshot.current_room
    beyond = robot_beyond_m(snapshot, settings.obstacles.map) > 0.0
    places = StoodPlaces(snapshot)
    return PlanState(
        world=read_world(snapshot, hand, settings),
        robot_at=ROOT_ID if room is None or beyond else room,
        robot_room=room,
        beyond_walls=beyond,
        holding=robot.holding if robot is not None else None,
        places=Placement(places, places.at, {}),
        missing=frozenset(node.id for node in snapshot.of_type(ObjectNode) if node.state is ObjectState.MISSING),
        near=_near(snapshot, settings.goto.near),
    )


def read_world(snapshot: Snapshot, hand: Hand = Hand(), settings: SkillSettings = SkillSettings()) -> World:
    """The things that plans speak about, and the physical doors between rooms that both are known."""
    return World(
        things=KnownThings(snapshot),
        doors=_door_links(snapshot),
        inside=lambda room: in_room(snapshot, room),
        fits=Capacity(snapshot, hand, settings.place.spots).fits,
        bars=cache(partial(barring, snapshot, hand=hand)),
    )


class KnownThings(Mapping[str, Thing]):
    """The rooms that stand, doors, objects and persons of a snapshot, each read when it is first asked for."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._poses = MapPoses(snapshot)
        self._read: dict[str, Thing] = {}

    def __getitem__(self, node_id: str) -> Thing:
        if node_id not in self._read:
            node = self._snapshot.get(node_id)
            if not _is_thing(node):
                raise KeyError(node_id)
            self._read[node_id] = _thing(self._snapshot, self._poses, node)
        return self._read[node_id]

    def __contains__(self, node_id: object) -> bool:
        return isinstance(node_id, str) and _is_thing(self._snapshot.get(node_id))

    def __iter__(self) -> Iterator[str]:
        for kind in _KINDS:
            yield from (node.id for node in self._snapshot.of_type(kind) if _is_thing(node))

    def __len__(self) -> int:
        return sum(1 for _ in self)


class StoodPlaces(Mapping[str, Place]):
    """Where the objects of a snapshot that can be carried are; held ones are nowhere."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._read: dict[str, Place | None] = {}

    def at(self, place: str) -> tuple[str, ...]:
        """The objects on or in a place."""
        if place not in self._snapshot:
            return ()
        standing = (edge.source for edge in self._snapshot.edges_to(place, EdgeType.RELATION))
        inside = () if not isinstance(self._snapshot.get(place), RoomNode) else in_room(self._snapshot, place)
        found = dict.fromkeys((*standing, *inside))
        return tuple(thing for thing in found if (at := self.get(thing)) is not None and at[1] == place)

    def __getitem__(self, object_id: str) -> Place:
        if object_id not in self._read:
            node = self._snapshot.get(object_id)
            carried = node if isinstance(node, ObjectNode) and _can_be_carried(node) else None
            self._read[object_id] = None if carried is None else _place(self._snapshot, carried)
        place = self._read[object_id]
        if place is None:
            raise KeyError(object_id)
        return place

    def __iter__(self) -> Iterator[str]:
        carried = (node.id for node in self._snapshot.of_type(ObjectNode) if _can_be_carried(node))
        return (object_id for object_id in carried if object_id in self)

    def __len__(self) -> int:
        return sum(1 for _ in self)


def _is_thing(node: Node | None) -> TypeGuard[RoomNode | DoorNode | ObjectNode | PersonNode]:
    return isinstance(node, _KINDS) and not (isinstance(node, RoomNode) and node.status is RoomStatus.TEMPORARY)


def _can_be_carried(node: ObjectNode) -> bool:
    return node.graspable and node.state is not ObjectState.HELD


def _thing(snapshot: Snapshot, poses: MapPoses, node: RoomNode | DoorNode | ObjectNode | PersonNode) -> Thing:
    room = snapshot.room_of(node.id)
    pose = poses.pose(node.id)
    position = None if pose is None else (pose.x_m, pose.y_m)
    if isinstance(node, ObjectNode):
        return Thing(
            id=node.id,
            kind="object",
            label=node.label,
            room=room,
            graspable=node.graspable,
            support=node.support,
            container=is_container(node.label),
            width_m=min(node.size_m[:2]),
            size_m=node.size_m,
            position_m=position,
        )
    kind = {RoomNode: "room", DoorNode: "door", PersonNode: "person"}[type(node)]
    return Thing(id=node.id, kind=kind, label=node.label, room=room, position_m=position)


def _door_links(snapshot: Snapshot) -> tuple[DoorLink, ...]:
    return tuple(
        DoorLink(door=door.id, rooms=(door.rooms[0], door.rooms[1]), open=door.state is not DoorState.CLOSED)
        for door in physical_doors(snapshot)
        if len(door.rooms) == 2
    )


def _place(snapshot: Snapshot, node: ObjectNode) -> tuple[PlaceRelation, str] | None:
    support = snapshot.support_of(node.id)
    room = snapshot.room_of(node.id)
    if support is not None and support in snapshot:
        inside = isinstance(target := snapshot.node(support), ObjectNode) and is_container(target.label)
        return (PlaceRelation.IN if inside else PlaceRelation.ON), support
    return (PlaceRelation.IN, room) if room is not None else None


def _near(snapshot: Snapshot, settings: NearnessSettings) -> frozenset[str]:
    """Objects and persons that the robot is at; not what it would stand in, for there a place was never told."""
    room, holding = snapshot.current_room, snapshot.robot.holding if snapshot.robot is not None else None
    if room is None:
        return frozenset()
    return frozenset(
        node_id for node_id in in_room(snapshot, room) if node_id != holding and is_at(snapshot, node_id, settings)
    )
