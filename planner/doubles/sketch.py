"""A scene graph from a few words: rooms, doors, things and people on a map, for tests, examples and measurements."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from scene_graph.edges import ConnectsEdge, Edge, InEdge, MatchEdge, RelationEdge, RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import (
    ROBOT_ID,
    ROOT_ID,
    CrossingStatus,
    DoorNode,
    DoorState,
    Node,
    ObjectNode,
    ObjectState,
    PersonNode,
    RobotNode,
    RoomNode,
    RoomStatus,
)
from scene_graph.snapshot import Snapshot

Point = tuple[float, float]
FURNITURE_SIZE_M = (1.2, 0.8, 0.75)
SEEN_S = 90.0
"""When everything was last seen, unless told otherwise."""
THING_SIZE_M = (0.07, 0.07, 0.12)


class Sketch:
    """Collects nodes and edges; ``snapshot`` commits them to a working memory, so that they obey its invariants.

    Positions are meters on the map; rooms are squares around their ``at``.
    """

    def __init__(self) -> None:
        self._nodes: list[Node] = []
        self._edges: list[Edge] = []
        self._at: dict[str, Point] = {ROOT_ID: (0.0, 0.0)}
        self._room: dict[str, str] = {}
        self._height_m: dict[str, float] = {}

    def room(self, room_id: str, label: str = "", *, at: Point, side_m: float = 4.0, **fields: Any) -> Sketch:
        """A permanent square room."""
        half = side_m / 2
        corners = ((-half, -half), (half, -half), (half, half), (-half, half))
        node = RoomNode(id=room_id, label=label, polygon_m=corners, status=RoomStatus.PERMANENT)
        self._hang(replace(node, **fields), ROOT_ID, at)
        return self

    def door(self, room_a: str, room_b: str, *, at: Point, state: DoorState = DoorState.OPEN) -> Sketch:
        """A crossed door: one node in each room, matched."""
        pair = []
        for own, other in ((room_a, room_b), (room_b, room_a)):
            k = sum(isinstance(node, DoorNode) and node.rooms[0] == own for node in self._nodes)
            door_id = f"door_{own.rpartition('_')[2]}_0_{k}"
            crossed = CrossingStatus.CROSSED
            node = DoorNode(
                id=door_id, rooms=(own, other), width_m=0.9, state=state, provisional=False, crossing=crossed
            )
            self._hang(node, own, at)
            self._edges += [ConnectsEdge(source=door_id, target=own), ConnectsEdge(source=door_id, target=other)]
            pair.append(door_id)
        source, target = sorted(pair)
        self._edges.append(MatchEdge(source=source, target=target))
        return self

    def furniture(self, node_id: str, label: str, room: str, *, at: Point, **fields: Any) -> Sketch:
        """Something to put things on, at a place on the map."""
        size_m = fields.pop("size_m", FURNITURE_SIZE_M)
        node = ObjectNode(id=node_id, label=label, size_m=size_m, support=fields.pop("support", True))
        self._height_m[node_id] = size_m[2]
        return self._object(replace(node, **fields), room, at, size_m[2] / 2)

    def thing(self, node_id: str, label: str, *, on: str, at: Point | None = None, **fields: Any) -> Sketch:
        """Something to carry, on (or in) a piece of furniture or on the floor of a room; ``relation`` says how, and
        ``bottom_m`` how high above the floor its bottom is, if it is not on top.
        """
        place = at if at is not None else self._at[on]
        relation, bottom_m = fields.pop("relation", "on"), fields.pop("bottom_m", self._height_m.get(on, 0.0))
        node = replace(ObjectNode(id=node_id, label=label, size_m=THING_SIZE_M, graspable=True), **fields)
        if on in self._room:
            self._edges.append(RelationEdge(source=node_id, target=on, predicate=relation, probability=0.9))
        room = self._room.get(on, on)
        self._height_m[node_id] = bottom_m + node.size_m[2]
        return self._object(node, room, place, bottom_m + node.size_m[2] / 2)

    def person(self, node_id: str, name: str, room: str, *, at: Point) -> Sketch:
        """A person who stands somewhere."""
        self._hang(PersonNode(id=node_id, name=name), room, at)
        self._edges.append(InEdge(source=node_id, target=room))
        return self

    def snapshot(self, *, robot_in: str, at: Point, holding: str | None = None, stamp_s: float = 100.0) -> Snapshot:
        """The graph with the robot in a room."""
        return self.memory(robot_in=robot_in, at=at, holding=holding, stamp_s=stamp_s).snapshot()

    def memory(self, *, robot_in: str, at: Point, holding: str | None = None, stamp_s: float = 100.0) -> WorkingMemory:
        """A working memory that holds the graph."""
        memory = WorkingMemory()
        with memory.edit("sketch", stamp_s) as tx:
            tx.remove(RtEdge(source=ROOT_ID, target=ROBOT_ID, T_source_target=SE3.identity()).key)
            for node in self._nodes:
                held = isinstance(node, ObjectNode) and node.id == holding
                tx.put(replace(node, state=ObjectState.HELD) if isinstance(node, ObjectNode) and held else node)
            tx.put(RobotNode(holding=holding))
            for edge in [*self._edges, InEdge(source=ROBOT_ID, target=robot_in)]:
                if edge.source != holding or not isinstance(edge, RelationEdge):
                    tx.put(edge)
            x_m, y_m = _minus(at, self._at[robot_in])
            pose = SE3.from_xyz_yaw(x_m, y_m, 0.0, 0.0)
            tx.put(RtEdge(source=robot_in, target=ROBOT_ID, T_source_target=pose))
            if holding is not None:
                old = next(edge for edge in self._edges if isinstance(edge, RtEdge) and edge.target == holding)
                tx.remove(old.key)
                hand = SE3.from_xyz_yaw(0.3, 0.0, 0.8, 0.0)
                tx.put(RtEdge(source=ROBOT_ID, target=holding, T_source_target=hand))
        return memory

    def _object(self, node: ObjectNode, room: str, at: Point, z_m: float) -> Sketch:
        self._hang(replace(node, last_seen_s=node.last_seen_s or SEEN_S), room, at, z_m)
        self._edges.append(InEdge(source=node.id, target=room))
        self._room[node.id] = room
        return self

    def _hang(self, node: Node, parent: str, at: Point, z_m: float = 0.0) -> None:
        x_m, y_m = _minus(at, self._at[parent])
        self._nodes.append(node)
        self._at[node.id] = at
        pose = SE3.from_xyz_yaw(x_m, y_m, z_m, 0.0)
        self._edges.append(RtEdge(source=parent, target=node.id, T_source_target=pose))


def _minus(a: Point, b: Point) -> Point:
    return a[0] - b[0], a[1] - b[1]


def flat() -> Sketch:
    """Kitchen, hall, living room and office with everyday things; the home of examples and tests."""
    sketch = Sketch()
    sketch.room("room_1", "kitchen", at=(0.0, 0.0)).room("room_2", "hall", at=(4.2, 0.0))
    sketch.room("room_3", "living room", at=(8.4, 0.0)).room("room_4", "office", at=(4.2, 4.2))
    sketch.door("room_1", "room_2", at=(2.1, 0.0)).door("room_2", "room_3", at=(6.3, 0.0))
    sketch.door("room_2", "room_4", at=(4.2, 2.1))
    sketch.furniture("table_1", "table", "room_1", at=(0.0, 1.0)).furniture(
        "counter_1", "counter", "room_1", at=(-1.5, 0.0)
    )
    sketch.furniture("table_2", "table", "room_3", at=(8.4, 1.0)).furniture(
        "couch_1", "couch", "room_3", at=(9.6, -1.2)
    )
    sketch.furniture("desk_1", "desk", "room_4", at=(4.2, 5.2)).furniture("shelf_1", "shelf", "room_4", at=(2.8, 4.2))
    sketch.furniture("box_1", "box", "room_4", at=(5.6, 3.4), size_m=(0.4, 0.4, 0.3))
    sketch.furniture("plant_1", "potted plant", "room_2", at=(5.6, -1.4), support=False, size_m=(0.4, 0.4, 0.9))
    sketch.thing("bottle_1", "bottle", on="table_1", at=(0.3, 1.1), color="blue")
    sketch.thing("bottle_2", "bottle", on="desk_1", at=(4.0, 5.2), color="red", size_m=(0.09, 0.09, 0.3))
    sketch.thing("cup_1", "cup", on="table_1", at=(-0.3, 1.0), color="red")
    sketch.thing("cup_2", "cup", on="counter_1", at=(-1.5, 0.3), color="green")
    sketch.thing("cup_3", "cup", on="table_2", at=(8.2, 1.0), color="white", size_m=(0.1, 0.1, 0.16))
    sketch.thing(
        "laptop_1", "laptop", on="desk_1", at=(4.5, 5.2), color="gray", graspable=False, size_m=(0.3, 0.2, 0.2)
    )
    sketch.thing("apple_1", "apple", on="counter_1", at=(-1.5, -0.3), color="red", categories=("fruit",))
    sketch.thing("book_1", "book", on="shelf_1", color="green", size_m=(0.05, 0.15, 0.2))
    sketch.thing("remote_1", "remote", on="couch_1", color="black", size_m=(0.05, 0.16, 0.03))
    return sketch.person("person_1", "Anna", "room_3", at=(8.4, -1.0)).person(
        "person_2", "user", "room_2", at=(4.2, 0.5)
    )
