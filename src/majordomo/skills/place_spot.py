"""Free spots for what the hand holds: on a support's top, in a container, or on the floor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot

import numpy as np

from majordomo.scene_graph.edges import EdgeType
from majordomo.scene_graph.identifiers import natural_key
from majordomo.scene_graph.nodes import ObjectNode, ObjectState
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.skills.anchor import Anchor
from majordomo.skills.containers import is_container
from majordomo.skills.geometry import Points
from majordomo.skills.rooms import in_room

EDGE_MARGIN_M = 0.04
GAP_M = 0.03
"""Between the object and its neighbors; what a finger needs to open between them."""
STEP_M = 0.04
FINE_STEP_M = 0.01
"""Tried where no spot of the coarse steps is free: a gap between things need not lie on them."""
STRIP_M = 0.48
"""How far in from an edge the arm reaches: 0.80 m from the axis less the base and its clearance."""
TOP_TOLERANCE_M = 0.12
SEAT_SHARES = {"chair": 0.5, "couch": 0.5, "sofa": 0.5, "bed": 0.55, "toilet": 0.5}
"""Height of the surface as a share of the whole, for furniture that rises above what things are put on."""
SEAT_RIMS_M = {"chair": (0.03, 0.03), "couch": (0.2, 0.22), "sofa": (0.2, 0.22), "bed": (0.06, 0.06)}
"""What arms and back take of the surface at the ends and at both of the long sides: which has the back is not known."""


@dataclass(frozen=True, kw_only=True)
class Spot:
    """Where to put something down: a point on the surface, tied to what carries it, and how free it is there.

    ``inside``: dropped into a container, from above its rim.
    """

    anchor: Anchor
    room_m: float
    inside: bool = False


def spots_on(snapshot: Snapshot, support_id: str, size_m: tuple[float, float, float], held: str | None) -> list[Spot]:
    """Free spots on ``support_id`` for an object of ``size_m``, the freest first.

    The object's outline is taken as the disc around its horizontal extent, so any turn of it fits.
    """
    support = snapshot.object(support_id)
    top_m = surface_m(snapshot, support_id, held)
    if is_container(support.label):
        return [Spot(anchor=Anchor(support_id, (0.0, 0.0, top_m)), room_m=0.0, inside=True)]
    radius_m = outline_radius_m(size_m)
    others = stands_on(snapshot, support_id, held)
    for step_m in (STEP_M, FINE_STEP_M):
        points = lattice(support, radius_m, step_m)
        room = room_m(snapshot, support_id, points, others) - radius_m
        if (room >= GAP_M).any():
            break
    order = np.argsort(-np.minimum(room, 0.10), kind="stable")
    return [
        Spot(anchor=Anchor(support_id, (float(points[i, 0]), float(points[i, 1]), top_m)), room_m=float(room[i]))
        for i in order
        if room[i] >= GAP_M
    ]


def surface_m(snapshot: Snapshot, support_id: str, held: str | None) -> float:
    """Height of the surface of a support in its own frame: where things stand on it already, else what its kind
    suggests.
    """
    support = snapshot.object(support_id)
    bottoms = [
        snapshot.position(node.id, support_id)[2] - node.size_m[2] / 2
        for node in _objects_beside(snapshot, support_id)
        if node.id != held and node.state is ObjectState.PRESENT and snapshot.support_of(node.id) == support_id
    ]
    share = SEAT_SHARES.get(_plain(support.label), 1.0)
    expected_m = (share - 0.5) * support.size_m[2]
    return expected_m if share == 1.0 or not bottoms else float(np.median(bottoms))


def outline_radius_m(size_m: tuple[float, float, float]) -> float:
    """Radius of a disc that holds the object however it is turned; round things are as wide as they are deep."""
    narrow, wide = sorted(size_m[:2])
    return wide / 2 if wide - narrow < 0.02 else hypot(narrow, wide) / 2


def stands_on(snapshot: Snapshot, support_id: str, held: str | None) -> list[ObjectNode]:
    """Objects whose extent touches the top of ``support_id``, by relation or by geometry."""
    support = snapshot.object(support_id)
    found = []
    for node in _objects_beside(snapshot, support_id):
        if node.id in (support_id, held) or node.state is not ObjectState.PRESENT:
            continue
        if snapshot.support_of(node.id) == support_id:
            found.append(node)
            continue
        if snapshot.room_of(node.id) != snapshot.room_of(support_id) or snapshot.support_of(support_id) == node.id:
            continue
        x_m, y_m, z_m = snapshot.transform(support_id, node.id).translation_m
        over = abs(x_m) < support.size_m[0] / 2 + 0.1 and abs(y_m) < support.size_m[1] / 2 + 0.1
        if over and abs(z_m - node.size_m[2] / 2 - support.size_m[2] / 2) < TOP_TOLERANCE_M:
            found.append(node)
    return found


def is_seat(label: str) -> bool:
    """Whether furniture of that name carries things lower than its top, with nothing over them."""
    return _plain(label) in SEAT_SHARES


def _plain(label: str) -> str:
    return label.replace("_", " ")


def _objects_beside(snapshot: Snapshot, support_id: str) -> list[ObjectNode]:
    """Objects of the support's room, and whatever is said to be on it."""
    room = snapshot.room_of(support_id)
    related = (edge.source for edge in snapshot.edges_to(support_id, EdgeType.RELATION))
    near = dict.fromkeys((*(in_room(snapshot, room) if room is not None else ()), *related))
    nodes = (snapshot.get(node_id) for node_id in sorted(near, key=natural_key))
    return [node for node in nodes if isinstance(node, ObjectNode)]


def lattice(support: ObjectNode, radius_m: float, step_m: float = STEP_M) -> Points:
    """Points (N, 2) about ``step_m`` apart on the top of ``support``, in rows, where a disc stands within the arm's
    reach, clear of arms and back; none where it is too large.
    """
    size_m, rim_m = support.size_m, SEAT_RIMS_M.get(_plain(support.label), (0.0, 0.0))
    half = np.array(size_m[:2]) / 2 - EDGE_MARGIN_M - radius_m
    if (half < 0).any():
        return np.zeros((0, 2))
    half = np.maximum(half - (rim_m if size_m[0] >= size_m[1] else rim_m[::-1]), 0.0)
    x, y = (np.linspace(-h, h, max(int(2 * h / step_m) + 1, 1)) if h > 0 else np.zeros(1) for h in half)
    points = np.stack([axis.ravel() for axis in np.meshgrid(x, y, indexing="ij")], axis=1)
    return np.asarray(points[_edge_distance_m(points, size_m) <= STRIP_M])


def room_m(snapshot: Snapshot, support_id: str, points: Points, others: Sequence[ObjectNode]) -> Points:
    """Distance (N,) from points on a support to the nearest of ``others``, at most 1 m."""
    room = np.full(len(points), 1.0)
    for node in others:
        T_support_node = snapshot.transform(support_id, node.id)
        c, s = np.cos(T_support_node.yaw_rad), np.sin(T_support_node.yaw_rad)
        local = (points - T_support_node.translation_m[:2]) @ np.array([[c, -s], [s, c]])
        beyond = np.maximum(np.abs(local) - np.array(node.size_m[:2]) / 2, 0.0)
        room = np.minimum(room, np.hypot(*beyond.T))
    return room


def _edge_distance_m(points: Points, size_m: tuple[float, float, float]) -> Points:
    half = np.array(size_m[:2]) / 2
    return np.asarray((half - np.abs(points)).min(axis=1))
