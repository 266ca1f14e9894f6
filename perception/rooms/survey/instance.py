"""From a fit to the nodes and edges of a room: its frame, walls and corners (Concepts, 3.4 and 3.5.1, figure 2)."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2, spatial_covariance
from perception.geometry.polygon import wall_lengths
from perception.localization.motion_model import odometry_covariance
from perception.rooms.outline.outline import Outline
from perception.rooms.survey.measurement import Fit
from scene_graph.edges import RtEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.identifiers import corner_id_of, wall_id_of
from scene_graph.nodes import CornerNode, RoomNode, RoomStatus, WallNode

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class InstanceSettings:
    """What of a fit goes into the graph, and how sure it is."""

    seen_wall: float = 0.5
    """Share of a partial room's wall that must have been seen to put it in the graph. Chosen: most of it."""
    confirmed_m: float = 0.10
    """So near to a corner of the outline an optimized corner confirms it. Chosen: five times its usual error."""
    votes: int = 3
    """Views that an optimized corner must have been seen in to confirm one. Chosen: two may be chance."""
    least_std_m: float = 0.001
    """Added to the standard deviation of every wall: averages of many returns are not that sure. Chosen."""


@dataclass(frozen=True, kw_only=True, eq=False)
class MeasuredRoom:
    """A room in its own frame: origin at the center of its bounding rectangle, axes along the walls.

    ``polygon``: (N, 2), corner zero is the first to the left of the robot's heading. ``wall_seen``, ``wall_std_m``:
    (N,).
    ``T_parent_room`` with (3, 3) ``covariance``: in the frame from which the robot came. ``T_room_base``: the robot.
    """

    polygon: Array
    wall_seen: Array
    wall_std_m: Array
    T_parent_room: Pose2
    covariance: Array
    T_room_base: Pose2
    confidence: float


def measured_room(
    fit: Fit,
    parent_covariance: Array,
    T_view_base: Pose2,
    *,
    least_matched: float,
    settings: InstanceSettings = InstanceSettings(),
) -> MeasuredRoom:
    """Put a fit into its room frame.

    Args:
        fit: outline and poses in the frame of the views.
        parent_covariance: (3, 3) of the pose in the parent at the first view.
        T_view_base: where the base is now, seen from the last view.
        least_matched: share of returns on the outline that a view needs to tie the room to the parent.
        settings: what confirms a corner.
    """
    T_frame_base = fit.views[-1].T_frame_base @ T_view_base
    T_frame_room = _room_frame(fit.outline, T_frame_base)
    T_room_frame = T_frame_room.inverse()
    polygon = T_room_frame.apply(fit.outline.polygon)
    T_room_base = T_room_frame @ T_frame_base
    start = _first_left_corner(polygon, T_room_base)
    anchor = fit.anchor(least_matched)
    T_anchor_room = fit.views[anchor].T_frame_base.inverse() @ T_frame_room
    covariance = parent_covariance + _way_covariance(fit.in_parent[: anchor + 1]) + np.diag([0.002, 0.002, 0.0005]) ** 2
    adjoint = T_anchor_room.inverse().adjoint()
    return MeasuredRoom(
        polygon=np.roll(polygon, -start, axis=0),
        wall_seen=np.roll(fit.outline.support, -start),
        wall_std_m=np.roll(fit.outline.offset_std_m, -start),
        T_parent_room=fit.in_parent[anchor] @ T_anchor_room,
        covariance=adjoint @ covariance @ adjoint.T,
        T_room_base=T_room_base,
        confidence=_confidence(fit, settings),
    )


def _way_covariance(poses: Sequence[Pose2]) -> Array:
    """Dead reckoning along successive poses, as one covariance."""
    total = np.zeros((3, 3))
    for before, after in pairwise(poses):
        total += odometry_covariance(before.inverse() @ after)
    return total


def _room_frame(outline: Outline, T_frame_base: Pose2) -> Pose2:
    """Center of the bounding rectangle; x along the wall direction nearest to the robot's heading."""
    quarter = np.pi / 2.0
    turns = round((T_frame_base.yaw_rad - outline.direction_rad) / quarter)
    axes = Pose2(0.0, 0.0, outline.direction_rad + turns * quarter)
    aligned = axes.inverse().apply(outline.polygon)
    center = (aligned.min(axis=0) + aligned.max(axis=0)) / 2.0
    return axes @ Pose2(float(center[0]), float(center[1]), 0.0)


def _first_left_corner(polygon: Array, T_room_base: Pose2) -> int:
    """Index of the corner met first when turning left from the robot's heading."""
    seen = T_room_base.inverse().apply(polygon)
    bearing = np.arctan2(seen[:, 1], seen[:, 0]) % (2.0 * np.pi)
    return int(np.argmin(bearing))


def _confidence(fit: Fit, settings: InstanceSettings) -> float:
    """Share of the outline's corners that optimized corner landmarks voted for, times the share of wall seen."""
    lengths = wall_lengths(fit.outline.polygon)
    seen = float((fit.outline.support * lengths).sum() / lengths.sum())
    voted = np.array([corner.point for corner in fit.corners if corner.votes >= settings.votes]).reshape(-1, 2)
    if len(voted) == 0:
        return 0.5 * seen
    distance = np.linalg.norm(fit.outline.polygon[:, None] - voted[None], axis=2).min(axis=1)
    return float(np.clip(seen * (0.5 + 0.5 * (distance < settings.confirmed_m).mean()), 0.0, 1.0))


def room_elements(
    room: MeasuredRoom,
    room_id: str,
    *,
    status: RoomStatus,
    height_m: float,
    stamp_s: float,
    settings: InstanceSettings = InstanceSettings(),
) -> list[RoomNode | WallNode | CornerNode | RtEdge]:
    """Room, walls and corners with the edges that hang them, without the room's own ``rt`` edge."""
    polygon = room.polygon
    elements: list[RoomNode | WallNode | CornerNode | RtEdge] = [
        RoomNode(
            id=room_id,
            confidence=room.confidence,
            polygon_m=tuple((float(x), float(y)) for x, y in polygon),
            height_m=height_m,
            status=status,
        )
    ]
    for k in range(len(polygon)):
        if status is RoomStatus.PERMANENT or room.wall_seen[k] > settings.seen_wall:
            std_m = float(room.wall_std_m[k]) + settings.least_std_m
            confidence = float(np.clip(room.wall_seen[k], 0.0, 1.0))
            elements += wall_elements(polygon, room_id, k, std_m=std_m, confidence=confidence, stamp_s=stamp_s)
    return elements


def wall_elements(
    polygon: Array, room_id: str, k: int, *, std_m: float, confidence: float, stamp_s: float
) -> list[WallNode | CornerNode | RtEdge]:
    """Side ``k`` of a room's outline (N, 2), room frame, and the corner that it begins with.

    ``std_m``: standard deviation of the wall's place along its normal.
    """
    start, end = polygon[k], polygon[(k + 1) % len(polygon)]
    along = end - start
    length_m, yaw_rad = float(np.hypot(*along)), float(np.arctan2(along[1], along[0]))
    normal = (-float(along[1]) / length_m, float(along[0]) / length_m)
    middle = (start + end) / 2.0
    covariance = spatial_covariance(np.diag([std_m, std_m, 2.0 * std_m / max(length_m, 0.2)]) ** 2)
    wall_id, corner_id = wall_id_of(room_id, k), corner_id_of(room_id, k)
    return [
        WallNode(
            id=wall_id,
            confidence=confidence,
            parent_room=room_id,
            normal=normal,
            offset_m=float(normal[0] * start[0] + normal[1] * start[1]),
            length_m=length_m,
        ),
        CornerNode(id=corner_id, confidence=confidence),
        RtEdge(
            source=room_id,
            target=wall_id,
            T_source_target=SE3.from_xyz_yaw(float(middle[0]), float(middle[1]), 0.0, yaw_rad),
            covariance=covariance,
            stamp_s=stamp_s,
        ),
        RtEdge(
            source=wall_id,
            target=corner_id,
            T_source_target=SE3.from_xyz_yaw(-length_m / 2.0, 0.0, 0.0, 0.0),
            covariance=covariance,
            stamp_s=stamp_s,
        ),
    ]
