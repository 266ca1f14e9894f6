"""Filters over nodes, with order, count and limit: nearest and largest are computed here, never by a model."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from enum import StrEnum
from functools import partial
from itertools import pairwise
from math import dist, inf, prod
from typing import Any

from scene_graph.edges import EdgeType
from scene_graph.errors import UnknownRegion, UnknownRoom
from scene_graph.identifiers import natural_key, next_id
from scene_graph.nodes import (
    NODE_CLASSES,
    ROBOT_ID,
    DoorNode,
    Node,
    NodeType,
    ObjectNode,
    PersonNode,
    RegionNode,
    RobotNode,
    RoomNode,
    WallNode,
)
from scene_graph.queries.poses import MapPoses
from scene_graph.snapshot import Snapshot

__all__ = ["Near", "NodeFilter", "OrderBy", "Related", "Selection", "next_id", "select"]


class OrderBy(StrEnum):
    """What to sort by; ties, and nothing else, go by identifier."""

    ID = "id"
    LABEL = "label"
    DISTANCE = "distance"
    LAST_SEEN = "last_seen"
    SIZE = "size"
    CONFIDENCE = "confidence"


@dataclass(frozen=True, kw_only=True)
class Related:
    """Has a relation with this predicate to this target; None matches all."""

    predicate: str | None = None
    target: str | None = None


@dataclass(frozen=True, kw_only=True)
class Near:
    """Within ``radius_m`` of a node's origin, or of a point in the map: (x, y), measured in the plane, or (x, y, z)."""

    node: str | None = None
    point_m: tuple[float, ...] | None = None
    radius_m: float = inf

    def __post_init__(self) -> None:
        if (self.node is None) == (self.point_m is None):
            raise ValueError("near takes either a node or a point")


@dataclass(frozen=True, kw_only=True)
class NodeFilter:
    """Conditions that a node must all meet; the default of each admits every node.

    Attributes:
        types: any of these.
        label: compared without case, ``_`` as space; no synonyms.
        color, name: attributes, compared in the same way.
        categories: the node has all of these.
        room: identifier of a room, or a room label, which may stand for several rooms.
        region: identifier or label of a region; the region itself, its rooms and all that is in them pass.
        state: of an object or door, status of a room or robot.
        max_age_s: last seen at most this long before the snapshot's stamp; for nodes that do not say, the age of their
            pose counts.
        order_by: ``distance`` is from what ``near`` names, or from the robot; ``size`` is volume, area or length.
        limit, offset: which part of the sorted result to return; ``Selection.total`` counts all of it.
    """

    types: tuple[NodeType, ...] = ()
    label: str | None = None
    color: str | None = None
    categories: tuple[str, ...] = ()
    name: str | None = None
    room: str | None = None
    region: str | None = None
    related: Related | None = None
    near: Near | None = None
    state: str | None = None
    max_age_s: float | None = None
    order_by: OrderBy = OrderBy.ID
    descending: bool = False
    limit: int | None = None
    offset: int = 0

    def __post_init__(self) -> None:
        if self.offset < 0 or (self.limit is not None and self.limit < 0):
            raise ValueError(f"limit and offset must not be negative, not {self.limit} and {self.offset}")


@dataclass(frozen=True, kw_only=True)
class Selection:
    """Nodes that passed a filter, in order, and how many there were before ``limit`` and ``offset``."""

    nodes: tuple[Node, ...]
    total: int


def select(snapshot: Snapshot, wanted: NodeFilter) -> Selection:
    """The nodes that pass the filter.

    Raises:
        UnknownRoom, UnknownRegion: ``room`` names no room, ``region`` no region.
        NodeNotFound: ``near`` or ``related`` names no node.
    """
    distance = _distances(snapshot, wanted.near)
    conditions = list(_conditions(snapshot, wanted, distance))
    kinds = wanted.types or tuple(NodeType)
    candidates = (node for kind in NodeType if kind in kinds for node in snapshot.of_type(NODE_CLASSES[kind]))
    found = [node for node in candidates if all(holds(node) for holds in conditions)]
    found.sort(key=lambda node: natural_key(node.id))
    if wanted.order_by is not OrderBy.ID or wanted.descending:
        found.sort(key=_sort_key(wanted.order_by, distance), reverse=wanted.descending)
    end = None if wanted.limit is None else wanted.offset + wanted.limit
    return Selection(nodes=tuple(found[wanted.offset : end]), total=len(found))


def _conditions(
    snapshot: Snapshot, wanted: NodeFilter, distance: Callable[[Node], float]
) -> Iterator[Callable[[Node], bool]]:
    texts = {"label": wanted.label, "color": wanted.color, "name": wanted.name}
    for field, text in texts.items():
        if text is not None:
            yield partial(_says, field, _plain(text))
    if wanted.categories:
        categories = {_plain(category) for category in wanted.categories}
        yield lambda node: isinstance(node, ObjectNode) and categories <= set(map(_plain, node.categories))
    if wanted.state is not None:
        state = _plain(wanted.state)
        yield lambda node: _plain(_state(node)) == state
    if wanted.max_age_s is not None:
        oldest_s = snapshot.stamp_s - wanted.max_age_s
        yield lambda node: _last_seen_s(snapshot, node) >= oldest_s
    if wanted.room is not None:
        rooms = _rooms_named(snapshot, wanted.room)
        yield lambda node: snapshot.room_of(node.id) in rooms
    if wanted.region is not None:
        regions = _regions_named(snapshot, wanted.region)
        yield lambda node: snapshot.region_of(node.id) in regions
    if wanted.related is not None:
        related = _related(snapshot, wanted.related)
        yield lambda node: node.id in related
    if wanted.near is not None:
        near = wanted.near
        yield lambda node: node.id != near.node and distance(node) <= near.radius_m and distance(node) < inf


def _says(field: str, text: str, node: Node) -> bool:
    return _plain(getattr(node, field, "")) == text


def _plain(text: str) -> str:
    return text.casefold().replace("_", " ").strip()


def _state(node: Node) -> str:
    match node:
        case ObjectNode() | DoorNode():
            return node.state
        case RoomNode() | RobotNode():
            return node.status
        case _:
            return ""


def _last_seen_s(snapshot: Snapshot, node: Node) -> float:
    if isinstance(node, ObjectNode | PersonNode):
        return node.last_seen_s
    edge = snapshot.parent(node.id)
    return edge.stamp_s if edge else -inf


def _rooms_named(snapshot: Snapshot, name: str) -> frozenset[str]:
    rooms = snapshot.of_type(RoomNode)
    named = {room.id for room in rooms if room.id == name} or {
        room.id for room in rooms if room.label and _plain(room.label) == _plain(name)
    }
    if not named:
        raise UnknownRoom(name, [known for room in rooms for known in (room.id, room.label) if known])
    return frozenset(named)


def _regions_named(snapshot: Snapshot, name: str) -> frozenset[str]:
    regions = snapshot.of_type(RegionNode)
    named = {region.id for region in regions if region.id == name or _plain(region.label) == _plain(name)}
    if not named:
        raise UnknownRegion(name, [known for region in regions for known in (region.id, region.label) if known])
    return frozenset(named)


def _related(snapshot: Snapshot, wanted: Related) -> frozenset[str]:
    """Sources of the relations; being ``in`` a room counts, though that is an edge of its own type."""
    found = {edge.source for edge in snapshot.relations(predicate=wanted.predicate, target=wanted.target)}
    if wanted.target is not None:
        snapshot.node(wanted.target)
        if wanted.predicate in {"in", None}:
            found.update(edge.source for edge in snapshot.edges_to(wanted.target, EdgeType.IN))
    return frozenset(found)


def _distances(snapshot: Snapshot, near: Near | None) -> Callable[[Node], float]:
    """Distance in the map from what ``near`` names, or from the robot; infinite for what hangs in the air."""
    poses = MapPoses(snapshot)
    if near is not None and near.point_m is not None:
        origin = near.point_m
    else:
        center = poses.pose(snapshot.node(near.node).id if near is not None and near.node else ROBOT_ID)
        origin = tuple(center.translation_m.tolist()) if center else ()

    def distance(node: Node) -> float:
        pose = poses.pose(node.id)
        return dist(pose.translation_m[: len(origin)], origin) if pose and origin else inf

    return distance


def _sort_key(order: OrderBy, distance: Callable[[Node], float]) -> Callable[[Node], Any]:
    match order:
        case OrderBy.ID:
            return lambda node: natural_key(node.id)
        case OrderBy.LABEL:
            return lambda node: _plain(node.label)
        case OrderBy.DISTANCE:
            return distance
        case OrderBy.LAST_SEEN:
            return lambda node: node.last_seen_s if isinstance(node, ObjectNode | PersonNode) else -inf
        case OrderBy.SIZE:
            return _size
        case OrderBy.CONFIDENCE:
            return lambda node: node.confidence


def _size(node: Node) -> tuple[float, float]:
    """Volume of an object, area of a room or door, length of a wall; then the longest side, for what is flat."""
    match node:
        case ObjectNode():
            return (prod(node.size_m), max(node.size_m))
        case RoomNode():
            corners = node.polygon_m
            around = pairwise((*corners, *corners[:1]))
            return (abs(sum(x0 * y1 - x1 * y0 for (x0, y0), (x1, y1) in around)) / 2.0, 0.0)
        case DoorNode():
            return (node.width_m * node.height_m, node.width_m)
        case WallNode():
            return (node.length_m, node.length_m)
        case _:
            return (0.0, 0.0)
