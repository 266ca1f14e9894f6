"""What is over a thing, and whether the hand comes to it from above all the same."""

from __future__ import annotations

from math import inf

from scene_graph.nodes import ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.arm.hand import DOWN_RAD, Hand
from skills.furniture.furniture import Furniture
from skills.furniture.standing import stand_below


def is_covered(snapshot: Snapshot, object_id: str, room: str, hand: Hand) -> bool:
    """Whether something reaches over the object: another thing's extent, or a surface of it, is above its center,
    within half a meter.

    Arms and back of a seat do not: over the seat itself there is nothing.
    """
    node, support = snapshot.object(object_id), snapshot.support_of(object_id)
    top_m = float(snapshot.position(object_id, room)[2]) + node.size_m[2] / 2
    low_m, high_m = (top_m + beyond_m for beyond_m in hand.settings.roof_m)
    for other in snapshot.of_type(ObjectNode):
        if other.id == object_id or other.state is not ObjectState.PRESENT or snapshot.room_of(other.id) != room:
            continue
        x_m, y_m, _ = snapshot.transform(other.id, object_id).translation_m
        if abs(x_m) >= other.size_m[0] / 2 or abs(y_m) >= other.size_m[1] / 2:
            continue
        center_m = float(snapshot.position(other.id, room)[2])
        roofs_m = Furniture.of(other).roofs_m(carries=other.id == support)
        if any(low_m < center_m + roof_m < high_m for roof_m in roofs_m):
            return True
    return False


def roof_over_m(snapshot: Snapshot, object_id: str, hand: Hand) -> float:
    """How high over the middle of a thing the pads of a hand that points down may be, so that the arm behind it stays
    below what is over the thing: infinite where nothing is, minus infinity where nobody knows how low that reaches.
    """
    room = snapshot.room_of(object_id)
    if room is None or not is_covered(snapshot, object_id, room, hand):
        return inf
    stand = stand_below(snapshot, object_id)
    if stand is None:
        return -inf
    hand_m = hand.headroom_m(0.0, 0.0, DOWN_RAD)
    return stand.surface.free_m - snapshot.object(object_id).size_m[2] / 2 - hand_m


def comes_from_above(snapshot: Snapshot, object_id: str, hand: Hand) -> bool:
    """Whether a thing below a board is so low that a level hand would close on its upper edge, while there is room over
    it for a hand that points down.
    """
    size_m = snapshot.object(object_id).size_m
    return hand.is_low(size_m) and hand.has_room_above(size_m, roof_over_m(snapshot, object_id, hand))


def underside_below_board_m(snapshot: Snapshot, object_id: str, center_z_m: float, hand: Hand) -> float:
    """Height of the lowest part of the hand on its way in to a thing below a board, with a little air; in the frame of
    the height of the thing's middle.
    """
    size_m, air_m = snapshot.object(object_id).size_m, hand.settings.level_air_m
    if comes_from_above(snapshot, object_id, hand):
        return hand.hover_m(size_m, center_z_m, roof_over_m(snapshot, object_id, hand)) - hand.tip_m - air_m
    return hand.level_pads_m(size_m, center_z_m) - hand.geometry.palm_half_m[1] - air_m
