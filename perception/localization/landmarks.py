"""Nominal corners and door posts of the current room, and their association with what the scan shows."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from perception.localization.alignment import Walls
from perception.localization.planar import Pose2
from perception.localization.window import LandmarkSighting
from perception.rooms.views.corners import CornerSighting
from scene_graph.identifiers import wall_id_of
from scene_graph.nodes import Point2, RoomNode, RoomStatus
from scene_graph.snapshot import Snapshot

Array = NDArray[np.float64]

_GATE = 9.21  # chi-square, two degrees of freedom, 99 %
_SIGHTING_FLOOR_M = 0.008


@dataclass(frozen=True, kw_only=True, eq=False)
class RoomModel:
    """What the scan should show in a room: its wall faces and corners, room frame."""

    room_id: str
    polygon: Array
    walls: Walls

    def contains(self, point: Array) -> bool:
        """Whether (2,) ``point`` lies inside the outline."""
        return inside(self.polygon, point)

    def depth_m(self, point: Array) -> float:
        """Distance of (2,) ``point`` from the outline, positive inside."""
        distance = distance_to_outline(self.polygon, point)
        return distance if inside(self.polygon, point) else -distance


def room_model(snapshot: Snapshot, room_id: str | None) -> RoomModel | None:
    """The model of a room that stands in the graph; ``None`` for a room still being measured or none at all.

    Of a partial room only the walls that are in the graph are used.
    """
    room = snapshot.get(room_id) if room_id is not None else None
    if not isinstance(room, RoomNode) or room.status is RoomStatus.TEMPORARY or len(room.polygon_m) < 3:
        return None
    known = tuple(wall_id_of(room.id, k) in snapshot for k in range(len(room.polygon_m)))
    return _model_of(room.id, room.polygon_m, known)


@lru_cache(maxsize=256)
def _model_of(room_id: str, polygon_m: tuple[Point2, ...], known: tuple[bool, ...]) -> RoomModel:
    polygon = np.array(polygon_m)
    polygon.setflags(write=False)
    return RoomModel(room_id=room_id, polygon=polygon, walls=Walls.of_polygon(polygon, np.array(known)))


def match_corners(
    nominal: Array, sightings: Sequence[CornerSighting], pose: Pose2, covariance: Array
) -> list[LandmarkSighting]:
    """Sightings that pass the Mahalanobis gate of a nominal corner, at most one for each (Concepts, section 3.7)."""
    matches: list[LandmarkSighting] = []
    if len(sightings) == 0:
        return matches
    points = np.array([sighting.point for sighting in sightings])
    stds = np.hypot([sighting.std_m for sighting in sightings], _SIGHTING_FLOOR_M)
    predicted = pose.inverse().apply(nominal)
    for index, expected in enumerate(predicted):
        jacobian = np.array([[-1.0, 0.0, expected[1]], [0.0, -1.0, -expected[0]]])
        (xx, xy), (_, yy) = jacobian @ covariance @ jacobian.T
        dx, dy = (points - expected).T
        var_x, var_y = xx + stds**2, yy + stds**2
        distances = 2.0 * (var_y * dx**2 - 2.0 * xy * dx * dy + var_x * dy**2) / (var_x * var_y - xy**2)
        best = int(np.argmin(distances))
        if distances[best] < _GATE:
            matches.append(LandmarkSighting(index=index, point=points[best], std_m=float(stds[best])))
    return matches


def inside(polygon: Array, point: Array) -> bool:
    """Whether (2,) ``point`` lies in (N, 2) ``polygon``."""
    return bool(points_inside(polygon, point[None])[0])


def points_inside(polygon: Array, points: Array) -> NDArray[np.bool_]:
    """(P,) which of (P, 2) ``points`` lie in (N, 2) ``polygon``: as many edges to the right as make an odd number."""
    x, y = polygon[:, 0], polygon[:, 1]
    x_next, y_next = np.append(x[1:], x[0]), np.append(y[1:], y[0])
    right, up = points[:, :1], points[:, 1:]
    straddles = (y > up) != (y_next > up)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = x + (up - y) / (y_next - y) * (x_next - x)
    return np.asarray(np.count_nonzero(straddles & (right < crossing), axis=1) % 2 == 1)


def shared_area(first: Array, second: Array, *, samples: int = 32) -> tuple[int, int, int]:
    """Areas of two (N, 2) polygons and of what they share, as numbers of points of a grid over both."""
    low, high = np.minimum(first.min(axis=0), second.min(axis=0)), np.maximum(first.max(axis=0), second.max(axis=0))
    axes = [
        np.linspace(a, b, samples, endpoint=False) + (b - a) / (2 * samples) for a, b in zip(low, high, strict=True)
    ]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).reshape(-1, 2)
    in_first, in_second = points_inside(first, points), points_inside(second, points)
    return int(in_first.sum()), int(in_second.sum()), int((in_first & in_second).sum())


def distance_to_outline(polygon: Array, point: Array) -> float:
    """Distance of (2,) ``point`` from the nearest edge of (N, 2) ``polygon``."""
    edges = np.concatenate([polygon[1:], polygon[:1]]) - polygon
    offset = point - polygon
    station = np.clip((offset * edges).sum(axis=1) / (edges**2).sum(axis=1), 0.0, 1.0)
    return float(np.linalg.norm(offset - station[:, None] * edges, axis=1).min())
