"""The boards of a shelf: which there are, how much room is over each, and from where the arm gets in between.

What stands on a board below another is put there and taken from there level-wise, through the open front: the longer
side of the piece. Which of the two long sides is open is not known; the one at a wall has no place to stand before it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import copysign, inf, pi, sin, tan

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ROBOT_ID, ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.anchor import Anchor
from skills.furniture.containers import is_open_container
from skills.furniture.seats import is_seat
from skills.geometry import Points
from skills.ports import ArmGeometry

HIGHEST_M = 1.15
"""On what is higher than this above the floor, the arm puts nothing."""
LOWEST_M = 0.28
"""Nor on a board lower than this: what the hand holds passes over the base on its way in."""
THICKNESS_M = 0.035
"""Of a board, at most: only its upper side is measured."""
TOP_M = 0.10
"""What is measured so near to the top is the top."""
HAND_HALF_WIDTH_M = 0.09
"""Half the width of palm and open fingers: what a hand sweeps to each side of its way."""
ASIDE_M = HAND_HALF_WIDTH_M + 0.04
"""From the end of a board, with its side, to the middle of the hand."""
SIDE_M = 0.025
"""How thick the side of a shelf is, at its ends."""
PALM_BEFORE_M = 0.07
"""A palm stays so far before the middle of what the fingers hold."""
BESIDE_M = 0.015
"""Air between what moves in between boards and what stands there."""
ARM_HALF_M = 0.03
AIR_M = 0.03
"""Spared over the hand, and under what it holds while it comes in, together."""
TURN_RAD = 22.0 * pi / 180.0
"""The arm comes in at most so far from straight."""
HAND_MARGIN_M = 0.05
FINGER_AIR_M = 0.008
"""Between a finger and what it comes down beside."""

BOTH_SIDES = (-1, 1)


@dataclass(frozen=True, kw_only=True)
class Board:
    """One surface of a support. ``height_m``: over the support's center. ``free_m``: from there to what is above it."""

    height_m: float
    free_m: float = inf

    @property
    def is_covered(self) -> bool:
        """Whether there is another above."""
        return self.free_m < inf


def boards_of(support: ObjectNode) -> tuple[Board, ...]:
    """All surfaces of a support that has any below its top, as measured, lowest first, its top last; else none."""
    half_m = support.size_m[2] / 2
    if is_seat(support.label) or is_open_container(support.label):
        return ()
    inner = [height_m - half_m for height_m in support.surfaces_m if height_m < support.size_m[2] - TOP_M]
    if not inner:
        return ()
    tops = [height_m - half_m for height_m in support.surfaces_m if height_m >= support.size_m[2] - TOP_M]
    heights = [*inner, tops[-1] if tops else half_m]
    free = [above - here - THICKNESS_M for here, above in pairwise(heights)]
    return tuple(Board(height_m=here, free_m=air) for here, air in zip(heights, (*free, inf), strict=True))


def board_at(boards: Sequence[Board], bottom_m: float) -> Board:
    """The board on which something stands whose bottom is there, over the support's center."""
    return min(boards, key=lambda board: abs(board.height_m - bottom_m))


def is_in_reach(board: Board, center_m: float) -> bool:
    """Whether the arm gets to a board of a support whose center is so high above the floor."""
    height_m = center_m + board.height_m
    return height_m <= HIGHEST_M and (height_m >= LOWEST_M or not board.is_covered)


def headroom_m(height_m: float, above_bottom_m: float, pitch_rad: float, geometry: ArmGeometry) -> float:
    """How much must be free over a board for a hand to come in with a thing so high that it holds there, and so."""
    arm_m = above_bottom_m + max(-sin(pitch_rad), 0.0) * geometry.hand_length_m + ARM_HALF_M
    return max(height_m, arm_m) + AIR_M


def open_sides(
    support: ObjectNode, points: Points, radius_m: float, others: Sequence[tuple[Points, Points]]
) -> NDArray[np.bool_]:
    """(N, 2): whether the hand gets straight in to each of the points (N, 2) from the one and from the other long side.

    ``others``: middle (2,) and half extents (2,) of what stands on that board, along the support's own axes.
    """
    free = np.ones((len(points), 2), dtype=bool)
    for middle, half in others:
        free &= ~_bars(support, points, radius_m, middle, half)
    return free


def bars_way_to(
    support: ObjectNode, points: Points, radius_m: float, others: Sequence[tuple[Points, Points]]
) -> NDArray[np.int64]:
    """(N,): to how many of ``others`` the hand would no longer get straight in from the one or from the other long
    side if a thing stood at each of the points (N, 2); both as ``open_sides`` takes them.
    """
    count = np.zeros(len(points), np.int64)
    for middle, half in others:
        count += _bars(support, middle, float(half.max()), points, np.full(2, radius_m)).any(axis=1)
    return count


def _bars(support: ObjectNode, goal: Points, radius_m: float, middle: Points, half: Points) -> NDArray[np.bool_]:
    """(N, 2): whether a thing at ``middle``, of half extents (2,), is met on the way of the hand, straight in from the
    one and from the other long side, to or with a thing of that radius at ``goal``; either point may be (N, 2).
    """
    long, short = axes(support)
    clear_m = max(radius_m, HAND_HALF_WIDTH_M) + BESIDE_M
    ahead = np.abs(goal[..., long] - middle[..., long]) < half[long] + clear_m
    before = [side * (middle[..., short] - goal[..., short]) + half[short] > -radius_m for side in BOTH_SIDES]
    return np.stack([ahead & met for met in before], axis=-1)


def is_before(
    snapshot: Snapshot,
    support_id: str,
    point_m: tuple[float, float, float],
    places: Points,
    frame: str,
    *,
    sides: Collection[int] = BOTH_SIDES,
    turn_rad: float = TURN_RAD,
) -> NDArray[np.bool_]:
    """Which of the places (N, 2) in ``frame`` are before a long side of the support, one of ``sides``, so that the arm
    gets straight in to a point in the support's frame without touching the ends.
    """
    support = snapshot.object(support_id)
    long, short = axes(support)
    local = snapshot.transform(support_id, frame).apply(np.column_stack((places, np.zeros(len(places)))))
    aside, away = local[:, long] - point_m[long], local[:, short] - point_m[short]
    side = np.sign(local[:, short])
    depth = support.size_m[short] / 2 - side * point_m[short]
    outside = np.abs(local[:, short]) > support.size_m[short] / 2
    straight = np.abs(aside) <= tan(turn_rad) * np.abs(away)
    enters = point_m[long] + aside * depth / np.maximum(np.abs(away), 1e-6)
    clear = np.abs(enters) <= support.size_m[long] / 2 - ASIDE_M + BESIDE_M
    return np.asarray(outside & straight & clear & np.isin(side, list(sides)))


def axes(support: ObjectNode) -> tuple[int, int]:
    """Which of its own axes is along its long side, and which across."""
    return (0, 1) if support.size_m[0] >= support.size_m[1] else (1, 0)


def board_under(snapshot: Snapshot, object_id: str) -> Board | None:
    """The board on which a thing stands on its support; ``None`` where that has none that are known."""
    support_id = snapshot.support_of(object_id)
    support = snapshot.get(support_id) if support_id is not None else None
    if support_id is None or not isinstance(support, ObjectNode) or not (boards := boards_of(support)):
        return None
    bottom_m = float(snapshot.position(object_id, support_id)[2]) - snapshot.object(object_id).size_m[2] / 2
    return board_at(boards, bottom_m)


def off_end(snapshot: Snapshot, object_id: str, opening_m: float) -> Anchor:
    """Where the hand goes to take a thing: at its middle; below a board, near an end or a neighbor, as far beside it as
    fingers that are ``opening_m`` apart allow, so that the hand passes both.
    """
    room_m = palm_room_m(snapshot, object_id)
    support_id = snapshot.support_of(object_id) if room_m is not None else None
    if room_m is None or support_id is None:
        return Anchor(object_id)
    support, node = snapshot.object(support_id), snapshot.object(object_id)
    long, _ = axes(support)
    point = [float(value) for value in snapshot.position(object_id, support_id)]
    spare_m = max((opening_m - max(node.size_m[:2])) / 2 - FINGER_AIR_M, 0.0)
    low_m, high_m = room_m
    short_m = max(ASIDE_M - SIDE_M - min(low_m, high_m), 0.0)
    point[long] += copysign(min(short_m, spare_m, abs(high_m - low_m) / 2), high_m - low_m)
    return Anchor(support_id, (point[0], point[1], point[2]))


def palm_room_m(snapshot: Snapshot, object_id: str) -> tuple[float, float] | None:
    """How far a palm that comes to a thing below a board may be to both sides of the thing's middle, along the
    support's long axis: to the ends, or to what stands on the board beside its way; ``None`` for any other thing.
    """
    support_id = snapshot.support_of(object_id) if object_id in snapshot else None
    board = board_under(snapshot, object_id) if support_id is not None else None
    if board is None or support_id is None or not board.is_covered:
        return None
    support = snapshot.object(support_id)
    long, short = axes(support)
    point, half_m = snapshot.position(object_id, support_id), support.size_m[long] / 2 - SIDE_M
    rooms = [half_m + float(point[long]), half_m - float(point[long])]
    robot = snapshot.transform(support_id, ROBOT_ID).translation_m if ROBOT_ID in snapshot else np.zeros(3)
    side = float(np.sign(robot[short]))
    for other in snapshot.of_type(ObjectNode):
        beside = other.id != object_id and snapshot.support_of(other.id) == support_id
        if not beside or other.state is not ObjectState.PRESENT or board_under(snapshot, other.id) != board:
            continue
        middle, half = extent_on(snapshot, support_id, other)
        away, beyond = middle - point[:2], int(middle[long] > point[long])
        if side * float(away[short]) + half[short] > PALM_BEFORE_M:
            rooms[beyond] = min(rooms[beyond], float(abs(away[long]) - half[long]))
    return max(rooms[0], 0.0), max(rooms[1], 0.0)


def extent_on(snapshot: Snapshot, support_id: str, node: ObjectNode) -> tuple[Points, Points]:
    """Middle (2,) and half extents (2,) of a thing along the axes of what carries it."""
    T_support_node = snapshot.transform(support_id, node.id)
    c, s = abs(np.cos(T_support_node.yaw_rad)), abs(np.sin(T_support_node.yaw_rad))
    half = np.array([[c, s], [s, c]]) @ np.array(node.size_m[:2]) / 2
    return np.asarray(T_support_node.translation_m[:2]), half


def is_among_boards(snapshot: Snapshot, frame: str, point: Points) -> bool:
    """Whether a point (3,) is between the boards of something, or just before them."""
    for node in snapshot.of_type(ObjectNode):
        boards = boards_of(node)
        if not boards or snapshot.room_of(node.id) != snapshot.current_room:
            continue
        x_m, y_m, z_m = snapshot.transform(node.id, frame).apply(point)
        beside = max(abs(x_m) - node.size_m[0] / 2, abs(y_m) - node.size_m[1] / 2)
        if beside < HAND_MARGIN_M and z_m < boards[-1].height_m:
            return True
    return False
