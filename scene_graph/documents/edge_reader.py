"""Edges from their records in a scene document, and those that the nodes imply."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from scene_graph.documents.document import (
    AffordanceRecord,
    DoorRecord,
    EdgeRecord,
    NodeRecord,
    ObjectRecord,
    PersonRecord,
    RegionRecord,
    RobotRecord,
    RootRecord,
    SceneDocument,
)
from scene_graph.documents.places import Places
from scene_graph.edges import (
    ConnectsEdge,
    Edge,
    EdgeType,
    HasEdge,
    HasIntentionEdge,
    InEdge,
    MatchEdge,
    RelationEdge,
    RtEdge,
)
from scene_graph.errors import SceneFormatError
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ROBOT_ID, ROOT_ID

# Predicates that may stand as the type of an edge, as people write them by hand; "in" is told apart by its target.
PREDICATES = ("on", "over", "under", "beside", "in front of", "attached to", "leaning on", "hanging from")


class EdgeReader:
    """Reads the edges of one document."""

    def __init__(self, document: SceneDocument, places: Places) -> None:
        self._document = document
        self._places = places

    def stated(self) -> Iterator[tuple[int, Edge]]:
        """Edges that the document lists, each with its place in the list.

        Raises:
            SceneFormatError: an edge of unknown type, a relation without predicate, or *on* and the like from a node to
                itself.
        """
        for i, record in enumerate(self._document.edges):
            yield i, self._read(record, f"edges[{i}]")

    def implied(self) -> Iterator[Edge]:
        """Frames, rooms, doors and owners that only the nodes tell of.

        A node whose frame the document states comes from a full document: nothing is added to it.
        """
        if ROBOT_ID not in self._places.records:
            room = self._places.first_room()
            yield self._rt(room or ROOT_ID, ROBOT_ID)
            if room is not None:
                yield InEdge(source=ROBOT_ID, target=room)
        for record in self._document.nodes:
            if isinstance(record, AffordanceRecord):
                yield from self._owner(record)
            elif isinstance(record, RegionRecord):
                yield from (InEdge(source=room, target=record.id) for room in self._rooms_of(record))
            elif not isinstance(record, RootRecord) and not self._places.is_hung(record.id):
                yield self._rt(self._places.parent(record), record.id)
                yield from self._rooms(record)

    def _read(self, record: EdgeRecord, path: str) -> Edge:
        source, target = record.source, record.target
        is_room = self._places.is_room(target) or self._places.is_region(target)
        match record.type:
            case EdgeType.RT:
                return self._rt(source, target)
            case EdgeType.IN if is_room:
                return InEdge(source=source, target=target)
            case EdgeType.RELATION if not record.label:
                raise SceneFormatError(f"{path}.label", "a relation needs its predicate as label")
            case EdgeType.RELATION:
                return _relation(record, record.label)
            case EdgeType.CONNECTS:
                return ConnectsEdge(source=source, target=target)
            case EdgeType.MATCH:
                return MatchEdge(source=min(source, target), target=max(source, target))
            case EdgeType.HAS:
                return HasEdge(source=source, target=target)
            case EdgeType.HAS_INTENTION:
                return _intention(record)
            case predicate if predicate in {EdgeType.IN, *PREDICATES} and source == target:
                raise SceneFormatError(path, f"{source!r} is at both ends")
            case predicate if predicate in {EdgeType.IN, *PREDICATES}:
                return _relation(record, str(predicate))
            case _:
                known = ", ".join([*EdgeType, *PREDICATES])
                raise SceneFormatError(f"{path}.type", f"no edge type {record.type!r}; edge types: {known}")

    def _rt(self, source: str, target: str) -> RtEdge:
        T_source_target = self._places.pose(source).inverse() @ self._places.pose(target)
        covariance = _covariance(self._places.records.get(target), T_source_target)
        return RtEdge(
            source=source,
            target=target,
            T_source_target=T_source_target,
            covariance=covariance,
            stamp_s=self._document.stamp_s,
        )

    def _rooms(self, record: NodeRecord) -> Iterator[Edge]:
        if isinstance(record, DoorRecord):
            for room in self._places.door_rooms(record):
                yield ConnectsEdge(source=record.id, target=room)
        if isinstance(record, ObjectRecord | PersonRecord | RobotRecord):
            room_of = self._places.room(record)
            if room_of is not None:
                yield InEdge(source=record.id, target=room_of)

    def _rooms_of(self, region: RegionRecord) -> tuple[str, ...]:
        for room in region.rooms:
            if not self._places.is_room(room):
                raise SceneFormatError(f"nodes of {region.id}.rooms", f"no room {room!r}")
        return region.rooms

    def _owner(self, record: AffordanceRecord) -> Iterator[Edge]:
        owned = any(edge.type == EdgeType.HAS and edge.target == record.id for edge in self._document.edges)
        if not owned and record.target in self._places.records:
            yield HasEdge(source=record.target, target=record.id)


def _relation(record: EdgeRecord, predicate: str) -> RelationEdge:
    return RelationEdge(source=record.source, target=record.target, predicate=predicate, probability=record.probability)


def _intention(record: EdgeRecord) -> HasIntentionEdge:
    return HasIntentionEdge(
        source=record.source,
        target=record.target,
        agent=record.label,
        action=record.action,
        status=record.status,
        priority=record.priority,
        standoff_m=record.standoff_m,
        side_rad=record.side_rad,
        proposed_s=record.proposed_s,
        reason=record.reason,
        needs=record.needs,
    )


def _covariance(record: NodeRecord | None, T_parent_child: SE3) -> NDArray[np.float64]:
    """Of an object: standard deviations along the parent's axes, turned into the frame of the child."""
    covariance = np.zeros((6, 6))
    if isinstance(record, ObjectRecord):
        R = T_parent_child.rotation()
        covariance[:3, :3] = R.T @ np.diag(np.square(record.position_std_m)) @ R
    return covariance
