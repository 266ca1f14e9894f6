"""Tracks to nodes and edges: only what has changed enough to matter is written.

Always computed from the newest snapshot, so that what others wrote (a name, a status) is kept.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from perception.objects.publishing.people import PersonTrack
from perception.objects.tracking.relations import Key
from perception.objects.tracking.track import Track
from perception.vocabulary import carries_things, category_of, is_graspable
from scene_graph.edges import EdgeKey, EdgeType, InEdge, RelationEdge, RtEdge
from scene_graph.edits import Edit, PutEdge, PutNode, RemoveEdge, RemoveNode
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ROBOT_ID, ObjectNode, ObjectState, PersonNode, Point3, RobotNode
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PublicationSettings:
    """Smaller changes than these are not written; ``seen_s`` bounds how stale ``last_seen_s`` may get."""

    moved_m: float = 0.004
    turned_rad: float = 0.03
    sigma_ratio: float = 1.3
    size_m: float = 0.006
    probability: float = 0.05
    seen_s: float = 0.35


def node_of(node_id: str, track: Track, before: ObjectNode | None, inspected_s: float | None) -> ObjectNode:
    """The node that says what ``track`` believes; fields that others own are kept from ``before``."""
    label = track.label.best
    sides = tuple(round(float(side), 4) for side in track.box.size_m)
    size_m = (sides[0], sides[1], sides[2])
    return ObjectNode(
        id=node_id,
        label=label,
        confidence=track.label.confidence,
        label_distribution=track.label.distribution,
        color=track.color.best,
        accents=tuple(color for color in track.accents.colors if color != track.color.best),
        categories=category_of(label, size_m).tags,
        name=before.name if before is not None else "",
        size_m=size_m,
        first_seen_s=track.first_seen_s,
        last_seen_s=track.last_seen_s,
        state=track.state,
        existence=track.existence,
        graspable=_is_graspable(track, label, size_m),
        support=carries_things(label, size_m),
        inspected_s=inspected_s if inspected_s is not None or before is None else before.inspected_s,
        observations=track.hits,
        surfaces_m=tuple(round(height_m, 4) for height_m in track.surfaces_m),
        back_rad=_back_rad(track),
        back_m=_back_m(track),
    )


def _is_graspable(track: Track, label: str, size_m: Point3) -> bool:
    """As it was measured; by its name alone while it is missing: what was thrown over, or had something beside it, may
    have been measured wrongly just before, and is measured anew where it is found.
    """
    missed = track.state is ObjectState.MISSING and category_of(label, size_m).graspable
    return missed or is_graspable(label, size_m)


def object_edits(
    snapshot: Snapshot,
    tracks: Sequence[Track],
    inspected: Mapping[str, float],
    stamp_s: float,
    settings: PublicationSettings,
) -> list[Edit]:
    """Nodes, rt and in edges of every confirmed thing whose room is in working memory."""
    edits: list[Edit] = []
    for track in tracks:
        if track.node_id is None or track.room not in snapshot:
            continue
        before = snapshot.get(track.node_id)
        before = before if isinstance(before, ObjectNode) else None
        node = node_of(track.node_id, track, before, inspected.get(track.node_id))
        if before is None or _worth_writing(before, node, settings):
            edits.append(PutNode(node))
        if track.state is not ObjectState.HELD:
            edits.extend(_placed(snapshot, track.node_id, track, stamp_s, settings))
        edits.extend(_in_room(snapshot, track.node_id, track.room))
    return edits


def held_edits(
    snapshot: Snapshot, node_id: str, T_robot_object: SE3, room: str, stamp_s: float, settings: PublicationSettings
) -> list[Edit]:
    """What hangs from the gripper: rt robot -> object, in the robot's room."""
    edits: list[Edit] = []
    parent = snapshot.parent(node_id)
    if (
        parent is None
        or parent.source != ROBOT_ID
        or not parent.T_source_target.is_close(T_robot_object, settings.moved_m)
    ):
        edits.extend(_hang(parent, ROBOT_ID, node_id, T_robot_object, np.diag([1e-4] * 3 + [1e-2] * 3), stamp_s))
    return edits + _in_room(snapshot, node_id, room)


def robot_edits(snapshot: Snapshot, holding: str | None) -> list[Edit]:
    """The robot's hand, everything else of the robot as it is."""
    robot = snapshot.robot
    if not isinstance(robot, RobotNode) or robot.holding == holding:
        return []
    return [PutNode(replace(robot, holding=holding))]


def united_edits(snapshot: Snapshot, removed: dict[str, Track | None]) -> list[Edit]:
    """Take out nodes that turned out to be a part of another, or another itself; forgotten here once they are gone."""
    for node_id in removed.keys() - set(snapshot.nodes):
        if node_id not in snapshot.elsewhere:
            del removed[node_id]
    return [RemoveNode(node_id) for node_id in sorted(removed.keys() & set(snapshot.nodes))]


def person_edits(
    snapshot: Snapshot, persons: Sequence[PersonTrack], stamp_s: float, settings: PublicationSettings
) -> list[Edit]:
    """Nodes and edges of persons; unnamed ones that have gone are removed."""
    edits: list[Edit] = []
    for person in persons:
        if person.node_id is None or person.room not in snapshot:
            continue
        before = snapshot.get(person.node_id)
        if person.gone:
            edits.extend([RemoveNode(person.node_id)] if before is not None else [])
            continue
        name = before.name if isinstance(before, PersonNode) else ""
        node = PersonNode(id=person.node_id, confidence=person.confidence, name=name, last_seen_s=person.last_seen_s)
        if (
            not isinstance(before, PersonNode)
            or abs(before.confidence - node.confidence) > settings.probability
            or node.last_seen_s - before.last_seen_s > settings.seen_s
        ):
            edits.append(PutNode(node))
        parent = snapshot.parent(person.node_id)
        T_room_person = SE3.from_xyz_yaw(float(person.position[0]), float(person.position[1]), 0.0, 0.0)
        moved = (
            parent is None or parent.source != person.room or not parent.T_source_target.is_close(T_room_person, 0.03)
        )
        if moved:
            covariance = np.diag([0.1**2, 0.1**2, 1e-4, 1e-4, 1e-4, 10.0])
            edits.extend(_hang(parent, person.room, person.node_id, T_room_person, covariance, stamp_s))
        edits.extend(_in_room(snapshot, person.node_id, person.room))
    return edits


def relation_edits(
    snapshot: Snapshot,
    stated: Mapping[Key, float],
    tracks: Sequence[Track],
    published: set[EdgeKey],
    stamp_s: float,
    settings: PublicationSettings,
) -> list[Edit]:
    """Relations to put and to take back, among things whose rooms are in working memory.

    ``published``: those written by this agent, kept up to date here.
    """
    node_of_number = {track.number: track.node_id for track in tracks if track.room in snapshot}
    wanted: dict[EdgeKey, float] = {}
    for (a, b, predicate), probability in stated.items():
        source, target = node_of_number.get(a), node_of_number.get(b)
        if source is not None and target is not None:
            wanted[EdgeKey(EdgeType.RELATION, source, target, predicate)] = round(probability, 4)
    edits: list[Edit] = [RemoveEdge(key) for key in sorted(published - wanted.keys()) if key in snapshot.edges]
    for key, probability in wanted.items():
        old = snapshot.edges.get(key)
        if not isinstance(old, RelationEdge) or abs(old.probability - probability) > settings.probability:
            edge = RelationEdge(
                source=key.source, target=key.target, predicate=key.label, probability=probability, stamp_s=stamp_s
            )
            edits.append(PutEdge(edge))
    published.clear()
    published.update(wanted)
    return edits


def _worth_writing(before: ObjectNode, after: ObjectNode, settings: PublicationSettings) -> bool:
    return (
        _told(before) != _told(after)
        or abs(before.confidence - after.confidence) > settings.probability
        or abs(before.existence - after.existence) > settings.probability
        or after.last_seen_s - before.last_seen_s > settings.seen_s
        or float(np.abs(np.subtract(before.size_m, after.size_m)).max()) > settings.size_m
        or _differ(before.surfaces_m, after.surfaces_m, settings.size_m)
        or _differ(_known(before.back_m), _known(after.back_m), settings.size_m)
    )


def _told(node: ObjectNode) -> tuple[object, ...]:
    """What is no measure: any change of it is worth writing."""
    looks = (node.label, node.color, frozenset(node.accents), node.back_rad)
    return (*looks, node.state, node.graspable, node.support, node.inspected_s)


def _back_rad(track: Track) -> float | None:
    """Where its back is, seen from its own frame: along one of its sides."""
    if track.back is None:
        return None
    sides = round((track.back.toward_rad - track.box.yaw_rad) / (math.pi / 2.0))
    return round(math.remainder(sides * math.pi / 2.0, 2.0 * math.pi), 4)


def _back_m(track: Track) -> float | None:
    """How far from its middle its back begins."""
    return None if track.back is None or track.back.face_m is None else round(track.back.face_m, 3)


def _known(length_m: float | None) -> tuple[float, ...]:
    return () if length_m is None else (length_m,)


def _differ(before: tuple[float, ...], after: tuple[float, ...], tolerance_m: float) -> bool:
    """Whether these are other lengths."""
    return len(before) != len(after) or any(abs(a - b) > tolerance_m for a, b in zip(before, after, strict=True))


def _placed(
    snapshot: Snapshot, node_id: str, track: Track, stamp_s: float, settings: PublicationSettings
) -> list[Edit]:
    parent = snapshot.parent(node_id)
    T_room_object = track.T_room_object
    R = T_room_object.rotation()
    covariance = np.zeros((6, 6))
    covariance[:3, :3] = R.T @ track.covariance @ R
    covariance[3:, 3:] = np.diag((1e-4, 1e-4, 0.03 if track.box.size_m[0] > 1.15 * track.box.size_m[1] else 1.0))
    covariance = (covariance + covariance.T) / 2.0
    if parent is not None and parent.source == track.room:
        change = parent.T_source_target.inverse() @ T_room_object
        still = (
            float(np.linalg.norm(change.translation_m)) <= settings.moved_m
            and abs(change.yaw_rad) <= settings.turned_rad
        )
        old, new = (float(np.sqrt(max(np.trace(C[:3, :3]), 1e-12))) for C in (parent.covariance, covariance))
        if still and 1.0 / settings.sigma_ratio < new / old < settings.sigma_ratio:
            return []
    return _hang(parent, track.room, node_id, T_room_object, covariance, stamp_s)


def _hang(
    parent: RtEdge | None, source: str, target: str, T_source_target: SE3, covariance: Array, stamp_s: float
) -> list[Edit]:
    edits: list[Edit] = [RemoveEdge(parent.key)] if parent is not None and parent.source != source else []
    edge = RtEdge(source=source, target=target, T_source_target=T_source_target, covariance=covariance, stamp_s=stamp_s)
    return [*edits, PutEdge(edge)]


def _in_room(snapshot: Snapshot, node_id: str, room: str) -> list[Edit]:
    stated = snapshot.edges_from(node_id, EdgeType.IN) if node_id in snapshot else ()
    if any(edge.target == room for edge in stated):
        return []
    removed: list[Edit] = [RemoveEdge(edge.key) for edge in stated]
    return [*removed, PutEdge(InEdge(source=node_id, target=room))]
