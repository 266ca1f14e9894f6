"""Nodes from their records in a scene document, with what the record leaves out filled in."""

from __future__ import annotations

import re
from typing import assert_never

from scene_graph.documents.document import (
    AffordanceRecord,
    CornerRecord,
    DoorRecord,
    NodeRecord,
    ObjectRecord,
    PersonRecord,
    RegionRecord,
    RobotRecord,
    RoomRecord,
    RootRecord,
    WallRecord,
)
from scene_graph.documents.everyday import bears, is_carried
from scene_graph.documents.places import Places
from scene_graph.nodes import (
    AffordanceNode,
    CornerNode,
    CrossingStatus,
    DoorNode,
    Node,
    ObjectNode,
    ObjectState,
    PersonNode,
    RegionNode,
    RobotNode,
    RoomNode,
    RootNode,
    WallNode,
)

_NUMBER = re.compile(r"_[0-9]+$")


def read_node(record: NodeRecord, places: Places, stamp_s: float) -> Node:
    """The node of a record; what was never dated was seen at ``stamp_s``."""
    label = record.label or ""
    match record:
        case RootRecord():
            return RootNode(id=record.id, label=label, confidence=record.confidence, explored=record.explored)
        case RoomRecord():
            return _room(record, places)
        case WallRecord():
            return _wall(record, places)
        case CornerRecord():
            return CornerNode(id=record.id, label=label, confidence=record.confidence)
        case DoorRecord():
            return _door(record, places)
        case ObjectRecord():
            return _object(record, places, stamp_s)
        case PersonRecord():
            seen_s = stamp_s if record.last_seen_s is None else record.last_seen_s
            return PersonNode(
                id=record.id,
                label=label or "person",
                confidence=record.confidence,
                name=record.name,
                last_seen_s=seen_s,
            )
        case RobotRecord():
            return RobotNode(
                id=record.id,
                label=label or "robot",
                confidence=record.confidence,
                holding=places.held_id,
                battery=record.battery,
                status=record.status,
                localized=record.localized,
            )
        case AffordanceRecord():
            return AffordanceNode(
                id=record.id, label=label, confidence=record.confidence, kind=record.kind, target=record.target
            )
        case RegionRecord():
            return RegionNode(id=record.id, label=label, confidence=record.confidence)
        case _:
            assert_never(record)


def _room(record: RoomRecord, places: Places) -> RoomNode:
    """Its polygon is told in the map and kept in the frame of the room."""
    corners = [(x, y, 0.0) for x, y in record.polygon_m]
    polygon = places.pose(record.id).inverse().apply(corners).tolist() if corners else []
    certain = 1.0 if record.label else 0.0
    return RoomNode(
        id=record.id,
        label=record.label or "",
        label_probability=certain if record.label_probability is None else record.label_probability,
        label_taught=record.label_taught,
        confidence=record.confidence,
        polygon_m=tuple((x, y) for x, y, _ in polygon),
        height_m=record.height_m,
        status=record.status,
    )


def _wall(record: WallRecord, places: Places) -> WallNode:
    return WallNode(
        id=record.id,
        label=record.label or "",
        confidence=record.confidence,
        parent_room=places.room(record) or "",
        normal=record.normal,
        offset_m=record.offset_m,
        length_m=record.length_m,
    )


def _door(record: DoorRecord, places: Places) -> DoorNode:
    """A door whose two rooms are known counts as crossed."""
    first, *others = places.door_rooms(record)
    crossed = CrossingStatus.CROSSED if others else CrossingStatus.UNCROSSED
    return DoorNode(
        id=record.id,
        label=record.label or "",
        confidence=record.confidence,
        rooms=(first, others[0] if others else None),
        width_m=record.width_m,
        height_m=record.height_m,
        state=record.state,
        provisional=record.provisional,
        crossing=record.crossing or crossed,
        crossing_reason=record.crossing_reason,
    )


def _object(record: ObjectRecord, places: Places, stamp_s: float) -> ObjectNode:
    """Something is a support when things are on or in it, or it stands on the floor and its label says so; graspable
    when it is on or in something or its label says so, and it is no support.
    """
    label = record.label or _NUMBER.sub("", record.id).replace("_", " ")
    standing = places.is_supported(record.id)
    carried = is_carried(label) or standing
    supports = places.supports(record.id) or (bears(label) and not standing and not record.graspable)
    supports = supports if record.support is None else record.support
    graspable = carried and not supports if record.graspable is None else record.graspable
    held = ObjectState.HELD if places.is_held(record) else ObjectState.PRESENT
    return ObjectNode(
        id=record.id,
        label=label,
        confidence=record.confidence,
        label_distribution=((label, 1.0),) if record.label_distribution is None else record.label_distribution,
        color=record.attributes.color or "",
        accents=record.attributes.accents or (),
        categories=record.attributes.categories or (),
        name=record.attributes.name or "",
        size_m=record.size_m,
        first_seen_s=record.first_seen_s,
        last_seen_s=stamp_s if record.last_seen_s is None else record.last_seen_s,
        state=record.state or held,
        existence=record.existence,
        graspable=graspable,
        support=supports,
        inspected_s=record.inspected_s,
        observations=record.observations,
        surfaces_m=tuple(sorted(record.surfaces_m)),
        back_rad=record.back_rad,
        back_m=record.back_m,
    )
