"""Free spots for what the hand holds: on a support's top, on the boards of a shelf, in a container."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from scene_graph.edges import EdgeType
from scene_graph.identifiers import natural_key
from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.anchor import Anchor
from skills.arm.grasping import is_tall
from skills.furniture.boards import (
    ASIDE_M,
    BOTH_SIDES,
    Board,
    axes,
    bars_way_to,
    board_at,
    boards_of,
    extent_on,
    open_sides,
)
from skills.furniture.containers import is_open_container
from skills.furniture.seats import back, rims_m, seat_share
from skills.geometry import Points
from skills.outline import Outline, disc, turned
from skills.room_contents import in_room

EDGE_MARGIN_M = 0.04
GAP_M = 0.03
"""Between the object and its neighbors; what a finger needs to open between them."""
STEP_M = 0.04
FINE_STEP_M = 0.01
"""Tried where no spot of the coarse steps is free: a gap between things need not lie on them."""
AMPLE_M = 0.10
"""More room than this around a thing is no better."""
BACK_AIR_M = 0.03
"""Between a thing and the back of a seat: nearer, what is brought over the seat meets the back, which is higher."""
STRIP_M = 0.48
"""How far in from an edge the arm reaches: 0.80 m from the axis less the base and its clearance."""
TOP_TOLERANCE_M = 0.12


@dataclass(frozen=True, kw_only=True)
class Spot:
    """Where to put something down: a point on the surface, tied to what carries it, and how free it is there.

    ``room_m``: air to the nearest neighbor; ``edge_m``: what is left between the thing and the edge, of which nobody
    knows to the centimeter where it is. ``inside``: dropped into a container, from above its rim. ``free_m``: height up
    to the board above; below one, the hand comes in level-wise, across one of the ``sides`` of the support.
    ``bars``: how many things on the board it would bar the hand's way to.
    ``turn_rad``: where the long side of the thing must point, in the frame of what carries it; ``None`` where any turn
    does.
    """

    anchor: Anchor
    room_m: float
    edge_m: float = inf
    turn_rad: float | None = None
    inside: bool = False
    free_m: float = inf
    sides: tuple[int, ...] = BOTH_SIDES
    bars: int = 0

    @property
    def air_m(self) -> float:
        """What there is around the thing before it meets a neighbor or the edge."""
        return min(self.room_m, self.edge_m)

    @property
    def is_covered(self) -> bool:
        """Whether there is a board above."""
        return self.free_m < inf


def spots_on(
    snapshot: Snapshot,
    support_id: str,
    size_m: tuple[float, float, float],
    held: str | None,
    *,
    as_empty: bool = False,
) -> list[Spot]:
    """Free spots on ``support_id`` for an object of ``size_m``, the freest first; ``as_empty``: if nothing stood there.

    The object's outline is taken as the disc around its horizontal extent, so that any turn of it fits. Where nothing
    is free for that, an oblong one is laid along or across the support.
    """
    support = snapshot.object(support_id)
    if is_open_container(support.label):
        return [
            Spot(anchor=Anchor(support_id, (0.0, 0.0, surface_m(snapshot, support_id, held))), room_m=0.0, inside=True)
        ]
    spots = [
        spot
        for board in boards_of(support) or (Board(height_m=surface_m(snapshot, support_id, held)),)
        if board.free_m > size_m[2]
        for spot in _spots_at(
            snapshot, support, board, size_m, [] if as_empty else stands_at(snapshot, support_id, board, held)
        )
    ]
    return sorted(spots, key=lambda spot: -min(spot.air_m, AMPLE_M))


def _spots_at(
    snapshot: Snapshot,
    support: ObjectNode,
    board: Board,
    size_m: tuple[float, float, float],
    others: Sequence[ObjectNode],
) -> list[Spot]:
    """Spots on one surface, in rows, that ``others`` leave free."""
    for outlines, step_m in laid(size_m, board):
        spots = [spot for outline in outlines for spot in _spots_for(snapshot, support, board, outline, step_m, others)]
        if spots:
            return spots
    return []


def laid(size_m: tuple[float, float, float], board: Board) -> Iterator[tuple[tuple[Outline, ...], float]]:
    """The ways in which a thing may stand, and in steps of what length spots are looked for, the first choice first:
    turned anyhow before turned so that it fits, which the hand does to what it holds from above.
    """
    anyhow, fitting = (disc(size_m),), () if board.is_covered or is_tall(size_m) else tuple(turned(size_m))
    yield from ((outlines, step_m) for outlines in (anyhow, fitting) if outlines for step_m in (STEP_M, FINE_STEP_M))


def _spots_for(
    snapshot: Snapshot,
    support: ObjectNode,
    board: Board,
    outline: Outline,
    step_m: float,
    others: Sequence[ObjectNode],
) -> list[Spot]:
    points = lattice(support, outline, step_m, covered=board.is_covered)
    room = room_m(snapshot, support.id, points, outline, others)
    sides = ways_in(snapshot, support, board, points, outline, others)
    bars = np.zeros(len(points), np.int64)
    if board.is_covered:
        bars = bars_way_to(support, points, outline.radius_m, [extent_on(snapshot, support.id, o) for o in others])
    edge = (np.array(support.size_m[:2]) / 2 - np.abs(points) - outline.half_m).min(axis=1)
    return [
        Spot(
            anchor=Anchor(support.id, (float(points[i, 0]), float(points[i, 1]), board.height_m)),
            room_m=float(room[i]),
            edge_m=float(edge[i]),
            turn_rad=outline.turn_rad,
            free_m=board.free_m,
            sides=tuple(side for side, is_open in zip(BOTH_SIDES, sides[i], strict=True) if is_open),
            bars=int(bars[i]),
        )
        for i in np.nonzero((room >= GAP_M) & sides.any(axis=1))[0]
    ]


def ways_in(
    snapshot: Snapshot,
    support: ObjectNode,
    board: Board,
    points: Points,
    outline: Outline,
    others: Sequence[ObjectNode],
    more: Sequence[tuple[Points, Points]] = (),
) -> NDArray[np.bool_]:
    """(N, 2): from which of the two sides the hand gets to the points (N, 2) on a board; from both, to a top.

    ``more``: middles (2,) and half extents (2,) of what is not there yet.
    """
    if not board.is_covered:
        return np.ones((len(points), 2), dtype=bool)
    return open_sides(
        support, points, outline.radius_m, [*(extent_on(snapshot, support.id, node) for node in others), *more]
    )


def surface_m(snapshot: Snapshot, support_id: str, held: str | None) -> float:
    """Height of the surface of a support in its own frame: of a shelf, the board that ``held`` stands on; else where
    things stand on it already, or what its kind suggests.
    """
    support = snapshot.object(support_id)
    boards = boards_of(support)
    if boards and held is not None and snapshot.support_of(held) == support_id:
        return board_at(boards, _bottom_m(snapshot, support_id, snapshot.object(held))).height_m
    bottoms = [
        _bottom_m(snapshot, support_id, node)
        for node in _objects_beside(snapshot, support_id)
        if node.id != held and node.state is ObjectState.PRESENT and snapshot.support_of(node.id) == support_id
    ]
    share = seat_share(support.label)
    expected_m = (share - 0.5) * support.size_m[2]
    return expected_m if share == 1.0 or not bottoms else float(np.median(bottoms))


def _bottom_m(snapshot: Snapshot, support_id: str, node: ObjectNode) -> float:
    return float(snapshot.position(node.id, support_id)[2]) - node.size_m[2] / 2


def stands_on(snapshot: Snapshot, support_id: str, held: str | None) -> list[ObjectNode]:
    """Objects whose extent touches the top of ``support_id``, or one of its boards, by relation or by geometry."""
    support = snapshot.object(support_id)
    heights = [board.height_m for board in boards_of(support)] or [support.size_m[2] / 2]
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
        if over and any(abs(z_m - node.size_m[2] / 2 - height_m) < TOP_TOLERANCE_M for height_m in heights):
            found.append(node)
    return found


def stands_at(snapshot: Snapshot, support_id: str, board: Board, held: str | None) -> list[ObjectNode]:
    """Those of them that stand on that surface."""
    others, boards = stands_on(snapshot, support_id, held), boards_of(snapshot.object(support_id))
    if not boards:
        return others
    return [node for node in others if board_at(boards, _bottom_m(snapshot, support_id, node)) == board]


def _objects_beside(snapshot: Snapshot, support_id: str) -> list[ObjectNode]:
    """Objects of the support's room, and whatever is said to be on it."""
    room = snapshot.room_of(support_id)
    related = (edge.source for edge in snapshot.edges_to(support_id, EdgeType.RELATION))
    near = dict.fromkeys((*(in_room(snapshot, room) if room is not None else ()), *related))
    nodes = (snapshot.get(node_id) for node_id in sorted(near, key=natural_key))
    return [node for node in nodes if isinstance(node, ObjectNode)]


def lattice(support: ObjectNode, outline: Outline, step_m: float = STEP_M, *, covered: bool = False) -> Points:
    """Points (N, 2) about ``step_m`` apart on the top of ``support``, in rows, where a thing stands within the arm's
    reach, clear of arms and back; none where it is too large. ``covered``: on a board below the top, where the hand
    passes between the ends.
    """
    size_m, rim_m = support.size_m, rims_m(support.label)
    half = np.array(size_m[:2]) / 2 - EDGE_MARGIN_M - np.array(outline.half_m)
    if covered:
        long, _ = axes(support)
        half[long] = min(half[long], size_m[long] / 2 - ASIDE_M)
    if (half < 0).any():
        return np.zeros((0, 2))
    half = np.maximum(half - (rim_m if size_m[0] >= size_m[1] else rim_m[::-1]), 0.0)
    low, high = _before_back(support, outline, -half, half)
    if (low > high).any():
        return np.zeros((0, 2))
    bounds = zip(low, high, strict=True)
    x, y = (np.linspace(a, b, int((b - a) / step_m) + 1) if b > a else np.array([a]) for a, b in bounds)
    points = np.stack([axis.ravel() for axis in np.meshgrid(x, y, indexing="ij")], axis=1)
    return np.asarray(points[_edge_distance_m(points, size_m) <= STRIP_M])


def _before_back(support: ObjectNode, outline: Outline, low: Points, high: Points) -> tuple[Points, Points]:
    """Bounds (2,) of where a thing's middle may be, drawn in so that it stays clear of the back of a seat, where the
    face of that was measured.
    """
    rim = back(support)
    if rim is None or support.back_m is None:
        return low, high
    farthest_m = rim.half_m - rim.thick_m - BACK_AIR_M - outline.half_m[rim.axis]
    along = np.arange(2) == rim.axis
    if rim.sign > 0:
        return low, np.where(along, np.minimum(high, farthest_m), high)
    return np.where(along, np.maximum(low, -farthest_m), low), high


def room_m(
    snapshot: Snapshot, support_id: str, points: Points, outline: Outline, others: Sequence[ObjectNode]
) -> Points:
    """Air (N,) between a thing at points on a support and the nearest of ``others``, at most 1 m."""
    room = np.full(len(points), 1.0)
    for node in others:
        T_support_node = snapshot.transform(support_id, node.id)
        middle, half_m = np.array(T_support_node.translation_m[:2]), np.array(node.size_m[:2]) / 2
        room = np.minimum(room, outline.gap_to_box_m(points, middle, half_m, T_support_node.yaw_rad))
    return room


def _edge_distance_m(points: Points, size_m: tuple[float, float, float]) -> Points:
    half = np.array(size_m[:2]) / 2
    return np.asarray((half - np.abs(points)).min(axis=1))
