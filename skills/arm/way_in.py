"""From where the hand gets in between boards: level-wise, straight through one of the two long sides.

Which of the two is open is not known; the one at a wall has no place to stand before it.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from math import copysign, tan

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ROBOT_ID, ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.anchor import Anchor
from skills.arm.hand import Hand
from skills.furniture.furniture import Furniture
from skills.furniture.standing import Stand, extent_on, stand_below, stand_of
from skills.geometry import Points

BOTH_SIDES = (-1, 1)


def open_sides(
    furniture: Furniture, points: Points, radius_m: float, others: Sequence[tuple[Points, Points]], hand: Hand
) -> NDArray[np.bool_]:
    """(N, 2): whether the hand gets straight in to each of the points (N, 2) from the one and from the other long side.

    ``others``: middle (2,) and half extents (2,) of what stands on that board, along the furniture's own axes.
    """
    free = np.ones((len(points), 2), dtype=bool)
    for middle, half in others:
        free &= ~_bars(furniture, points, radius_m, middle, half, hand)
    return free


def bars_way_to(
    furniture: Furniture, points: Points, radius_m: float, others: Sequence[tuple[Points, Points]], hand: Hand
) -> NDArray[np.int64]:
    """(N,): to how many of ``others`` the hand would no longer get straight in from the one or from the other long
    side if a thing stood at each of the points (N, 2); both as ``open_sides`` takes them.
    """
    count = np.zeros(len(points), np.int64)
    for middle, half in others:
        count += _bars(furniture, middle, float(half.max()), points, np.full(2, radius_m), hand).any(axis=1)
    return count


def _bars(
    furniture: Furniture, goal: Points, radius_m: float, middle: Points, half: Points, hand: Hand
) -> NDArray[np.bool_]:
    """(N, 2): whether a thing at ``middle``, of half extents (2,), is met on the way of the hand, straight in from the
    one and from the other long side, to or with a thing of that radius at ``goal``; either point may be (N, 2).
    """
    long, short = furniture.long, furniture.short
    clear_m = max(radius_m, hand.geometry.hand_half_width_m) + hand.settings.beside_m
    ahead = np.abs(goal[..., long] - middle[..., long]) < half[long] + clear_m
    before = [side * (middle[..., short] - goal[..., short]) + half[short] > -radius_m for side in BOTH_SIDES]
    return np.stack([ahead & met for met in before], axis=-1)


def is_before(
    snapshot: Snapshot,
    support_id: str,
    point_m: tuple[float, float, float],
    places: Points,
    frame: str,
    hand: Hand,
    *,
    sides: Collection[int] = BOTH_SIDES,
    slack_rad: float = 0.0,
) -> NDArray[np.bool_]:
    """Which of the places (N, 2) in ``frame`` are before a long side of the support, one of ``sides``, so that the arm
    gets straight in to a point in the support's frame without touching the ends; ``slack_rad``: what it may be off.
    """
    furniture = Furniture.of(snapshot.object(support_id))
    long, short = furniture.long, furniture.short
    local = snapshot.transform(support_id, frame).apply(np.column_stack((places, np.zeros(len(places)))))
    aside, away = local[:, long] - point_m[long], local[:, short] - point_m[short]
    side = np.sign(local[:, short])
    depth = furniture.size_m[short] / 2 - side * point_m[short]
    outside = np.abs(local[:, short]) > furniture.size_m[short] / 2
    straight = np.abs(aside) <= tan(hand.settings.turn_rad + slack_rad) * np.abs(away)
    enters = point_m[long] + aside * depth / np.maximum(np.abs(away), 1e-6)
    clear = np.abs(enters) <= furniture.inner_half_m - hand.geometry.hand_half_width_m
    return np.asarray(outside & straight & clear & np.isin(side, list(sides)))


def off_end(snapshot: Snapshot, object_id: str, hand: Hand) -> Anchor:
    """Where the hand goes to take a thing: at its middle; below a board, near an end or a neighbor, as far beside it as
    the fingers allow, so that the hand passes both.
    """
    stand, room_m = stand_below(snapshot, object_id), palm_room_m(snapshot, object_id, hand)
    if stand is None or room_m is None:
        return Anchor(object_id)
    point, (low_m, high_m) = list(stand.point_m), room_m
    spare_m = hand.finger_spare_m(snapshot.object(object_id).size_m, hand.limits.gripper_opening_m[1])
    short_m = max(hand.geometry.hand_half_width_m + hand.settings.beside_m - min(low_m, high_m), 0.0)
    aside_m = min(short_m, spare_m, abs(high_m - low_m) / 2)
    point[stand.furniture.long] += copysign(aside_m, high_m - low_m)
    return Anchor(stand.on, (point[0], point[1], point[2]))


def palm_room_m(snapshot: Snapshot, object_id: str, hand: Hand) -> tuple[float, float] | None:
    """How far a palm that comes to a thing below a board may be to both sides of the thing's middle, along the
    support's long axis: to the ends, or to what stands on the board beside its way; ``None`` for any other thing.
    """
    stand = stand_below(snapshot, object_id)
    if stand is None:
        return None
    long, short = stand.furniture.long, stand.furniture.short
    half_m, along_m = stand.furniture.inner_half_m, stand.point_m[long]
    rooms = [half_m + along_m, half_m - along_m]
    robot = snapshot.transform(stand.on, ROBOT_ID).translation_m if ROBOT_ID in snapshot else np.zeros(3)
    side = float(np.sign(robot[short]))
    for other in beside(snapshot, object_id, stand):
        middle, half = extent_on(snapshot, stand.on, other)
        away, beyond = middle - stand.point_m[:2], int(middle[long] > along_m)
        if side * float(away[short]) + half[short] > hand.geometry.palm_to_pads_m:
            rooms[beyond] = min(rooms[beyond], float(abs(away[long]) - half[long]))
    return max(rooms[0], 0.0), max(rooms[1], 0.0)


def beside(snapshot: Snapshot, object_id: str, stand: Stand) -> list[ObjectNode]:
    """The other things that stand on the same surface as an object."""
    found = []
    for other in snapshot.of_type(ObjectNode):
        near = other.id != object_id and other.state is ObjectState.PRESENT
        if near and snapshot.support_of(other.id) == stand.on:
            there = stand_of(snapshot, other.id)
            if there is not None and there.surface == stand.surface:
                found.append(other)
    return found


def is_among_boards(snapshot: Snapshot, frame: str, point: Points, hand: Hand) -> bool:
    """Whether a point (3,) is between the boards of something, or just before them."""
    for node in snapshot.of_type(ObjectNode):
        furniture = Furniture.of(node)
        if not furniture.surfaces[0].is_covered or snapshot.room_of(node.id) != snapshot.current_room:
            continue
        at_m = snapshot.transform(node.id, frame).apply(point)
        near = (np.abs(at_m[:2]) - furniture.half_m).max() < hand.settings.before_m
        if near and at_m[2] < furniture.surfaces[-1].height_m:
            return True
    return False
