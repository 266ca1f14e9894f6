"""A snapshot as a JSON document (design, section 9)."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping
from types import MappingProxyType
from typing import Any, Literal

import numpy as np
from numpy.typing import NDArray

from scene_graph.documents.document import DECIMALS
from scene_graph.edges import Edge, EdgeType, HasIntentionEdge, RelationEdge
from scene_graph.errors import UnknownLayer
from scene_graph.geometry.se3 import SE3
from scene_graph.geometry.uncertainty import position_covariance
from scene_graph.nodes import (
    NODE_CLASSES,
    AffordanceNode,
    DoorNode,
    Node,
    NodeType,
    ObjectNode,
    PersonNode,
    RegionNode,
    RobotNode,
    RoomNode,
    RootNode,
    WallNode,
    node_type,
)
from scene_graph.queries.doors import PhysicalDoor, physical_doors
from scene_graph.queries.laid_out import laid_out
from scene_graph.queries.poses import MapPoses
from scene_graph.snapshot import Snapshot

Frame = Literal["map", "room"]
Record = dict[str, Any]
_IDENTITY = SE3.identity()
LAYERS: Mapping[str, NodeType] = MappingProxyType(
    {name: kind for kind in NodeType for name in (kind.value, f"{kind}s")}
)
"""Node types by name, singular and plural."""


def layers_named(layers: Collection[str] | None) -> frozenset[NodeType]:
    """Node types by name, singular or plural; None means all.

    Raises:
        UnknownLayer: there is no node type of this name.
    """
    if layers is None:
        return frozenset(NodeType)
    for layer in layers:
        if layer not in LAYERS:
            raise UnknownLayer(layer, [kind.value for kind in NodeType])
    return frozenset(LAYERS[layer] for layer in layers)


class SceneWriter:
    """Writes the nodes and edges of one snapshot.

    In the map, rooms are as the layout has them, a physical door is one node in the middle of its wall, and everything
    that refers to its other node refers to it.
    """

    def __init__(self, snapshot: Snapshot, frame: Frame, layers: frozenset[NodeType]) -> None:
        snapshot = laid_out(snapshot) if frame == "map" else snapshot
        self._snapshot = snapshot
        self._frame = frame
        self._layers = layers
        self._poses = MapPoses(snapshot)
        self._doors: dict[str, PhysicalDoor] = {}
        self._stands_for: dict[str, str] = {}
        if frame == "map":
            doors = physical_doors(snapshot)
            self._doors = {door.id: door for door in doors}
            self._stands_for = {member.id: door.id for door in doors for member in door.members[1:]}

    def nodes(self) -> list[Record]:
        """One record a node, by type and then in natural order."""
        return [
            self._node(node)
            for kind, cls in NODE_CLASSES.items()
            if kind in self._layers
            for node in self._snapshot.of_type(cls)
            if node.id not in self._stands_for
        ]

    def edges(self) -> list[Record]:
        """One record an edge, by type and then in the order in which they were put."""
        records: dict[tuple[str, str, str, str], Record] = {}
        hung: set[str] = set()
        for edge in self._snapshot.edges.values():
            record = self._edge(edge)
            source, target = record["source"], record["target"]
            merged = self._frame == "map" and edge.key.type is EdgeType.MATCH
            hung_twice = edge.key.type is EdgeType.RT and target in hung
            if merged or hung_twice or not self._shows(source) or not self._shows(target):
                continue
            if edge.key.type is EdgeType.RT:
                hung.add(target)
            records.setdefault((record["type"], source, target, record["label"]), record)
        return list(records.values())

    def _shows(self, node_id: str) -> bool:
        return node_type(self._snapshot.node(node_id)) in self._layers

    def _node(self, node: Node) -> Record:
        anchor = self._anchor(node)
        room = self._snapshot.room_of(anchor)
        pose = self._region_pose(node.id) if isinstance(node, RegionNode) else self._pose(anchor, room)
        if (shared := self._shared_point(anchor)) is not None:
            pose = SE3(pose.quat_wxyz, shared)
        return {
            "id": node.id,
            "type": node_type(node).value,
            "label": node.label,
            "room": room,
            "position_m": _rounded(pose.translation_m.tolist()),
            "yaw_rad": _rounded_number(pose.yaw_rad),
            "confidence": node.confidence,
            **self._details(node, pose),
        }

    def _anchor(self, node: Node) -> str:
        """What says where the node is: itself, or the owner of an affordance."""
        if not isinstance(node, AffordanceNode):
            return node.id
        owner = next((edge.source for edge in self._snapshot.edges_to(node.id, EdgeType.HAS)), node.id)
        return self._stands_for.get(owner, owner)

    def _pose(self, node_id: str, room: str | None) -> SE3:
        """In the map or the node's room; the origin for what hangs from neither."""
        T_map_node = self._poses.pose(node_id)
        if T_map_node is None:
            return _IDENTITY
        T_map_room = self._poses.pose(room) if room is not None and self._frame == "room" else None
        return T_map_room.inverse() @ T_map_node if T_map_room else T_map_node

    def _shared_point(self, node_id: str) -> NDArray[np.float64] | None:
        """(3,) where a physical door is in the map; None unless it is known from both its rooms.

        Midway between the two faces of its wall; along them, where its two stations agree best, each weighed by how
        well it was measured.
        """
        door = self._doors.get(node_id)
        poses = [self._poses.pose(member.id) for member in door.members] if door else []
        if door is None or len(poses) != 2 or poses[0] is None or poses[1] is None:
            return None
        first, second = (self._station_variance(member.id) for member in door.members)
        share = first / (first + second) if first + second > 0.0 else 0.5
        x_m, y_m, z_m = (poses[0].inverse() @ poses[1]).translation_m
        return poses[0].apply((share * x_m, y_m / 2.0, z_m / 2.0))

    def _station_variance(self, door_id: str) -> float:
        """Square meters, along the wall that a door hangs from."""
        edge = self._snapshot.parent(door_id)
        return float(edge.covariance[0, 0]) if edge is not None else 0.0

    def _region_pose(self, region: str) -> SE3:
        """In the middle of its rooms."""
        poses = [pose for room in self._snapshot.rooms_in(region) if (pose := self._poses.pose(room)) is not None]
        if not poses or self._frame == "room":
            return _IDENTITY
        x_m, y_m, z_m = (sum(axis) / len(poses) for axis in zip(*(pose.translation_m for pose in poses), strict=True))
        return SE3.from_xyz_yaw(x_m, y_m, z_m, 0.0)

    def _details(self, node: Node, pose: SE3) -> Record:
        match node:
            case RootNode():
                return {"explored": node.explored}
            case RoomNode():
                corners = pose.apply([(x, y, 0.0) for x, y in node.polygon_m]) if node.polygon_m else ()
                return {
                    "polygon_m": [_rounded(corner[:2]) for corner in corners],
                    "height_m": node.height_m,
                    "status": node.status.value,
                    "label_probability": node.label_probability,
                    "label_taught": node.label_taught,
                    "region": self._snapshot.region_of(node.id),
                }
            case WallNode():
                return {"length_m": node.length_m, "normal": list(node.normal), "offset_m": node.offset_m}
            case DoorNode():
                return self._door_details(node)
            case ObjectNode():
                return {**_object_details(node), "position_std_m": self._position_std_m(node.id)}
            case PersonNode():
                return {"name": node.name, "last_seen_s": node.last_seen_s}
            case RobotNode():
                return {
                    "holding": node.holding,
                    "battery": node.battery,
                    "status": node.status,
                    "localized": node.localized,
                }
            case AffordanceNode():
                target = self._stands_for.get(node.target, node.target)
                return {"kind": node.kind.value, "target": target}
            case RegionNode():
                return {"rooms": list(self._snapshot.rooms_in(node.id))}
            case _:
                return {}

    def _door_details(self, node: DoorNode) -> Record:
        door = self._doors.get(node.id)
        return {
            "width_m": node.width_m,
            "height_m": node.height_m,
            "rooms": list(door.rooms) if door else [room for room in node.rooms if room is not None],
            "state": (door or node).state.value,
            "provisional": (door or node).provisional,
            "crossing": (door or node).crossing.value,
            "crossing_reason": node.crossing_reason,
        }

    def _position_std_m(self, node_id: str) -> list[float]:
        """Standard deviation along the axes of the parent frame, which for objects is their room."""
        edge = self._snapshot.parent(node_id)
        if edge is None or not edge.covariance.any():
            return [0.0, 0.0, 0.0]
        variances = position_covariance(edge.T_source_target, edge.covariance).diagonal().tolist()
        return _rounded([math.sqrt(max(variance, 0.0)) for variance in variances])

    def _edge(self, edge: Edge) -> Record:
        key = edge.key
        record: Record = {
            "source": self._stands_for.get(key.source, key.source),
            "target": self._stands_for.get(key.target, key.target),
            "type": key.type.value,
            "label": key.label,
            "probability": edge.probability if isinstance(edge, RelationEdge) else 1.0,
        }
        if isinstance(edge, HasIntentionEdge):
            record.update(dict(_intention_details(edge)))
        return record


def _object_details(node: ObjectNode) -> Record:
    return {
        "attributes": {
            "color": node.color,
            "accents": list(node.accents),
            "categories": list(node.categories),
            "name": node.name,
        },
        "label_distribution": [[label, probability] for label, probability in node.label_distribution],
        "size_m": list(node.size_m),
        "state": node.state.value,
        "first_seen_s": node.first_seen_s,
        "last_seen_s": node.last_seen_s,
        "existence": node.existence,
        "graspable": node.graspable,
        "support": node.support,
        "inspected_s": node.inspected_s,
        "observations": node.observations,
        "surfaces_m": list(node.surfaces_m),
        "back_rad": node.back_rad,
        "back_m": node.back_m,
    }


def _intention_details(edge: HasIntentionEdge) -> Iterator[tuple[str, object]]:
    yield "action", edge.action.value
    yield "status", edge.status.value
    yield "priority", int(edge.priority)
    yield "standoff_m", edge.standoff_m
    yield "side_rad", edge.side_rad
    yield "proposed_s", edge.proposed_s
    yield "reason", edge.reason
    yield "needs", list(edge.needs)


def _rounded(numbers: Collection[float]) -> list[float]:
    return [_rounded_number(number) for number in numbers]


def _rounded_number(number: float) -> float:
    return round(float(number), DECIMALS) + 0.0
