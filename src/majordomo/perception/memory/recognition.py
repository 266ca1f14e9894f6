"""Recognizing a room: is the robot in a room that is known already (loop closure, Concepts, section 3.6)?"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from majordomo.perception.localization.alignment import AlignmentSettings, align
from majordomo.perception.localization.landmarks import RoomModel, inside, room_model
from majordomo.perception.localization.planar import Pose2, diagonal_covariance
from majordomo.perception.memory.dual import root_pose
from majordomo.scene_graph.nodes import RoomNode
from majordomo.scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]

_DRIFT = diagonal_covariance(0.15, 0.15, 0.04)
_LEAST_MATCHED = 0.8
_OVERLAP = 0.5


@dataclass(frozen=True, kw_only=True)
class Recognized:
    """The known room that the robot is in, and where in it."""

    room_id: str
    T_room_base: Pose2


def recognize(
    snapshot: Snapshot, T_root_base: Pose2, points_base: Array, *, other_than: str | None
) -> Recognized | None:
    """The known room in which the layout puts the robot and whose walls the scan shows there."""
    settings = AlignmentSettings(gates_m=(0.6, 0.4, 0.2, 0.1, 0.08))
    for room in snapshot.of_type(RoomNode):
        model = room_model(snapshot, room.id)
        if model is None or room.id == other_than:
            continue
        guess = root_pose(snapshot, room.id).inverse() @ T_root_base
        if model.depth_m(guess.position_m) < 0.05:
            continue
        found = align(points_base, model.walls, guess, _DRIFT, settings)
        if found is not None and found.matched > _LEAST_MATCHED and found.conditioned:
            return Recognized(room_id=room.id, T_room_base=found.pose)
    return None


def same_room(snapshot: Snapshot, room_id: str) -> str | None:
    """An older room that takes the same place in the layout as a newly measured one."""
    new = room_model(snapshot, room_id)
    if new is None:
        return None
    T_root_new = root_pose(snapshot, room_id)
    for room in snapshot.of_type(RoomNode):
        old = room_model(snapshot, room.id)
        if old is not None and room.id != room_id:
            T_old_new = root_pose(snapshot, room.id).inverse() @ T_root_new
            if overlap(old, T_old_new.apply(new.polygon)) > _OVERLAP:
                return room.id
    return None


def overlap(room: RoomModel, polygon: Array) -> float:
    """Shared area of a room and a polygon in its frame, over the area of both together; by sampling."""
    low = np.minimum(room.polygon.min(axis=0), polygon.min(axis=0))
    high = np.maximum(room.polygon.max(axis=0), polygon.max(axis=0))
    axes = [np.linspace(a, b, 32, endpoint=False) + (b - a) / 64 for a, b in zip(low, high, strict=True)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    in_room = np.array([inside(room.polygon, point) for point in points])
    in_other = np.array([inside(polygon, point) for point in points])
    return float((in_room & in_other).sum() / max((in_room | in_other).sum(), 1))
