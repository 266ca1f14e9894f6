"""Where things are in a scene document that does not say it outright: rooms, parent frames and positions."""

from __future__ import annotations

from collections.abc import Sequence

from scene_graph.documents.document import (
    CornerRecord,
    DoorRecord,
    EdgeRecord,
    NodeRecord,
    ObjectRecord,
    PersonRecord,
    Point2,
    RegionRecord,
    RobotRecord,
    RoomRecord,
    SceneDocument,
    WallRecord,
)
from scene_graph.errors import SceneFormatError
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ROBOT_ID, ROOT_ID, ObjectState

_SUPPORTING = ("on", "in")


class Places:
    """Fills in rooms, parents and map poses of the nodes of one document."""

    def __init__(self, document: SceneDocument) -> None:
        self.records: dict[str, NodeRecord] = {record.id: record for record in document.nodes}
        self._index = {record.id: i for i, record in enumerate(document.nodes)}
        self._rooms = {record.id: record for record in document.nodes if isinstance(record, RoomRecord)}
        self._stated_parents = {edge.target: edge.source for edge in document.edges if edge.type == "rt"}
        self._stated_rooms = {
            edge.source: edge.target for edge in document.edges if edge.type == "in" and edge.target in self._rooms
        }
        self._regions = frozenset(record.id for record in document.nodes if isinstance(record, RegionRecord))
        self._supports = {edge.source: edge for edge in document.edges if self._is_support(edge)}
        self._connected: dict[str, list[str]] = {}
        for edge in document.edges:
            if edge.type == "connects":
                self._connected.setdefault(edge.source, []).append(edge.target)
        self._supported = frozenset(edge.target for edge in self._supports.values())
        self.held_id = _held_id(document)

    def is_hung(self, node_id: str) -> bool:
        """Whether the document itself says from which frame the node hangs; then its other edges are told too."""
        return node_id in self._stated_parents

    def is_held(self, record: ObjectRecord) -> bool:
        """Whether the object is in the gripper, by its state or else by what the robot holds."""
        return record.state is ObjectState.HELD or (record.state is None and record.id == self.held_id)

    def is_room(self, node_id: str) -> bool:
        """Whether the node is a room."""
        return node_id in self._rooms

    def is_region(self, node_id: str) -> bool:
        """Whether the node is a region."""
        return node_id in self._regions

    def supports(self, node_id: str) -> bool:
        """Whether something is on or in the node."""
        return node_id in self._supported

    def is_supported(self, node_id: str) -> bool:
        """Whether the node is on or in something."""
        return node_id in self._supports

    def door_rooms(self, record: DoorRecord) -> tuple[str, ...]:
        """The one or two rooms of a door.

        Raises:
            SceneFormatError: none is told, or one does not exist.
        """
        told = (*(room for room in record.rooms if room is not None), *self._connected.get(record.id, ()))
        rooms = tuple(dict.fromkeys((*told, *([record.room] if record.room and not told else []))))
        for room in rooms:
            if room not in self._rooms:
                raise self._error(record, "rooms", f"no room {room!r}; rooms: {', '.join(self._rooms) or 'none'}")
        if not rooms:
            raise self._error(record, "rooms", "a door needs at least one room")
        return rooms

    def room(self, record: NodeRecord, above: tuple[str, ...] = ()) -> str | None:
        """The room a node is in: told by itself or by an edge, or the one around it."""
        if isinstance(record, DoorRecord):
            return self.door_rooms(record)[0]
        if record.room is not None:
            if record.room not in self._rooms:
                problem = f"no room {record.room!r}; rooms: {', '.join(self._rooms) or 'none'}"
                raise self._error(record, "room", problem)
            return record.room
        if record.id in self._stated_rooms:
            return self._stated_rooms[record.id]
        if isinstance(record, WallRecord | CornerRecord | ObjectRecord | PersonRecord | RobotRecord):
            return self._room_around(record, above)
        return None

    def parent(self, record: NodeRecord) -> str:
        """The frame from which a node hangs."""
        if record.id in self._stated_parents:
            return self._stated_parents[record.id]
        if isinstance(record, RoomRecord):
            return ROOT_ID
        if isinstance(record, ObjectRecord) and self.is_held(record):
            return ROBOT_ID
        room = self.room(record)
        if room is None and isinstance(record, WallRecord | CornerRecord):
            raise self._error(record, "room", f"a {record.type} needs a room")
        return room or ROOT_ID

    def pose(self, node_id: str) -> SE3:
        """``T_map_node``."""
        record = self.records.get(node_id)
        if record is None or record.id == ROOT_ID:
            return SE3.identity()
        x, y, z = record.position_m or self._filled_position(record)
        return SE3.from_xyz_yaw(x, y, z, record.yaw_rad)

    def _filled_position(self, record: NodeRecord) -> tuple[float, float, float]:
        """Of a room, the center of its polygon; of an object, on or in its support; else that of its room."""
        if isinstance(record, RoomRecord):
            return (*_center(record.polygon_m), 0.0)
        edge = self._supports.get(record.id)
        support = self.records.get(edge.target) if edge else None
        if isinstance(record, ObjectRecord) and isinstance(support, ObjectRecord) and support.position_m:
            x, y, z = support.position_m
            inside = edge is not None and "in" in (edge.type, edge.label)
            return (x, y, z if inside else z + (support.size_m[2] + record.size_m[2]) / 2.0)
        if isinstance(record, ObjectRecord) and self.is_held(record):
            return self._position(ROBOT_ID)
        room = self.room(record)
        return self._position(room) if room else (0.0, 0.0, 0.0)

    def _position(self, node_id: str) -> tuple[float, float, float]:
        pose = self.pose(node_id)
        return (pose.x_m, pose.y_m, pose.z_m)

    def _room_around(self, record: NodeRecord, above: tuple[str, ...]) -> str | None:
        """The room whose polygon holds the position, or that of the support, or the only one there is.

        ``above`` are the nodes on which the question came down, so that things on each other end it.
        """
        if record.position_m is not None:
            for room in self._rooms.values():
                if _contains(room.polygon_m, record.position_m[:2]):
                    return room.id
        edge = self._supports.get(record.id)
        if edge is not None and edge.target in self.records and edge.target not in above:
            return self.room(self.records[edge.target], (*above, record.id))
        if isinstance(record, RobotRecord) and record.position_m is None:
            return self.first_room()
        return next(iter(self._rooms)) if len(self._rooms) == 1 else None

    def first_room(self) -> str | None:
        """The room of a robot of which nothing is told: around the origin of the map, or the first."""
        around = (room.id for room in self._rooms.values() if _contains(room.polygon_m, (0.0, 0.0)))
        return next(around, next(iter(self._rooms), None))

    def _is_support(self, edge: EdgeRecord) -> bool:
        predicate = edge.label if edge.type == "relation" else edge.type
        return predicate in _SUPPORTING and edge.target not in self._rooms and edge.target not in self._regions

    def _error(self, record: NodeRecord, field: str, problem: str) -> SceneFormatError:
        return SceneFormatError(f"nodes[{self._index[record.id]}].{field}", problem)


def _held_id(document: SceneDocument) -> str | None:
    """What the robot says it holds, or else the object that says it is held."""
    named = [record.holding for record in document.nodes if isinstance(record, RobotRecord)]
    held = [
        record.id for record in document.nodes if isinstance(record, ObjectRecord) and record.state is ObjectState.HELD
    ]
    return next((node_id for node_id in (*named, *held) if node_id is not None), None)


def _center(polygon_m: Sequence[Point2]) -> Point2:
    """Center of the bounding rectangle."""
    if not polygon_m:
        return (0.0, 0.0)
    xs, ys = [x for x, _ in polygon_m], [y for _, y in polygon_m]
    return ((min(xs) + max(xs)) / 2.0, (min(ys) + max(ys)) / 2.0)


def _contains(polygon_m: Sequence[Point2], point_m: Point2) -> bool:
    """Even-odd rule: a ray along x from an inner point crosses the boundary an odd number of times."""
    x, y = point_m
    inside = False
    for (x0, y0), (x1, y1) in zip(polygon_m, (*polygon_m[1:], *polygon_m[:1]), strict=True):
        if (y0 > y) != (y1 > y) and x < x0 + (y - y0) * (x1 - x0) / (y1 - y0):
            inside = not inside
    return inside
