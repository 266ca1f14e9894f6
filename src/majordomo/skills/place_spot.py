"""Free spots for what the hand holds: on a support's top, in a container, or on the floor."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

import numpy as np

from majordomo.scene_graph.nodes import ObjectNode, ObjectState
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.skills.anchor import Anchor
from majordomo.skills.facts import is_container
from majordomo.skills.geometry import Points

EDGE_MARGIN_M = 0.04
GAP_M = 0.03
"""Between the object and its neighbors; what a finger needs to open between them."""
STEP_M = 0.04
STRIP_M = 0.48
"""How far in from an edge the arm reaches: 0.80 m from the axis less the base and its clearance."""
TOP_TOLERANCE_M = 0.12
SEAT_SHARES = {"chair": 0.5, "couch": 0.5, "sofa": 0.5, "bed": 0.55, "toilet": 0.5}
"""Height of the surface as a share of the whole, for furniture that rises above what things are put on."""


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
    half = np.array(support.size_m[:2]) / 2 - EDGE_MARGIN_M - radius_m
    if (half < 0).any():
        return []
    points = _lattice(half)
    points = points[_edge_distance_m(points, support.size_m) <= STRIP_M]
    room = _room_m(snapshot, support_id, points, radius_m, held)
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
        for node in snapshot.of_type(ObjectNode)
        if node.id != held and node.state is ObjectState.PRESENT and snapshot.support_of(node.id) == support_id
    ]
    share = SEAT_SHARES.get(support.label.replace("_", " "), 1.0)
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
    for node in snapshot.of_type(ObjectNode):
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


def _lattice(half: Points) -> Points:
    """Points (N, 2) about ``STEP_M`` apart within plus or minus ``half``, its border included."""
    x, y = (np.linspace(-h, h, max(int(2 * h / STEP_M) + 1, 1)) if h > 0 else np.zeros(1) for h in half)
    grid = np.meshgrid(x, y, indexing="ij")
    return np.stack([axis.ravel() for axis in grid], axis=1)


def _edge_distance_m(points: Points, size_m: tuple[float, float, float]) -> Points:
    half = np.array(size_m[:2]) / 2
    return np.asarray((half - np.abs(points)).min(axis=1))


def _room_m(snapshot: Snapshot, support_id: str, points: Points, radius_m: float, held: str | None) -> Points:
    """Air between the object and the nearest thing on the support, for each point (N,)."""
    room = np.full(len(points), 1.0)
    for node in stands_on(snapshot, support_id, held):
        T_support_node = snapshot.transform(support_id, node.id)
        c, s = np.cos(T_support_node.yaw_rad), np.sin(T_support_node.yaw_rad)
        local = (points - T_support_node.translation_m[:2]) @ np.array([[c, -s], [s, c]])
        beyond = np.maximum(np.abs(local) - np.array(node.size_m[:2]) / 2, 0.0)
        room = np.minimum(room, np.hypot(*beyond.T) - radius_m)
    return room
