"""What stands before a thing on a board below another, so that the hand would push it on its way in."""

from __future__ import annotations

import numpy as np

from scene_graph.nodes import UNKNOWN_LABEL, ObjectNode
from scene_graph.snapshot import Snapshot
from skills.arm.hand import Hand
from skills.arm.roof import underside_below_board_m
from skills.arm.way_in import BOTH_SIDES, beside
from skills.furniture.standing import Stand, extent_on, stand_below
from skills.geometry import inside_polygon
from skills.obstacles.walls import whole_room


def barring(snapshot: Snapshot, object_id: str, hand: Hand = Hand()) -> tuple[str, ...]:
    """The small things that stand before a thing on its board, the foremost first, so that the hand would meet them on
    its way straight in from the front: from the side with fewer of them, where both may be open. None for a thing that
    is not below a board.
    """
    stand = stand_below(snapshot, object_id)
    if stand is None:
        return ()
    others = [node for node in beside(snapshot, object_id, stand) if _can_be_taken(node, hand)]
    sides = [side for side in BOTH_SIDES if not _is_at_wall(snapshot, stand, side, hand)] if others else []
    return min((_before(snapshot, object_id, stand, others, side, hand) for side in sides), key=len, default=())


def is_small_and_nameless(node: ObjectNode, hand: Hand) -> bool:
    """Whether it may well be no thing of its own, but a part of what lies there."""
    return node.label == UNKNOWN_LABEL and max(node.size_m) < hand.settings.nameless_m


def _can_be_taken(node: ObjectNode, hand: Hand) -> bool:
    """Whether it can be taken away from there and has a name."""
    narrow = min(node.size_m[:2]) <= hand.settings.doubtful_width_m
    return node.graspable and narrow and not is_small_and_nameless(node, hand)


def _before(
    snapshot: Snapshot, object_id: str, stand: Stand, others: list[ObjectNode], side: int, hand: Hand
) -> tuple[str, ...]:
    """Those that the hand would meet on its way in from one side, the foremost first.

    What is nearer than half a palm to the middle of the hand's way is surely met; the fingers may be that much wider
    than what they take to get by.
    """
    long, short = stand.furniture.long, stand.furniture.short
    at_m = snapshot.position(object_id, stand.on)
    low_m = underside_below_board_m(snapshot, object_id, float(at_m[2]), hand)
    clear_m = hand.geometry.palm_half_m[0] - hand.finger_spare_m(snapshot.object(object_id).size_m, hand.span_m)
    met: list[tuple[float, str]] = []
    for other in others:
        middle, half = extent_on(snapshot, stand.on, other)
        top_m = float(snapshot.position(other.id, stand.on)[2]) + other.size_m[2] / 2
        out_m = side * float(middle[short] - at_m[short])
        ahead = abs(float(middle[long] - at_m[long])) - half[long] < clear_m
        if ahead and top_m > low_m and out_m > 0.0 and out_m + half[short] > hand.geometry.palm_to_pads_m:
            met.append((-out_m, other.id))
    return tuple(name for _, name in sorted(met))


def _is_at_wall(snapshot: Snapshot, stand: Stand, side: int, hand: Hand) -> bool:
    """Whether there is surely no place to stand before one of the long sides: it would be beyond the room's wall."""
    room = whole_room(snapshot, snapshot.room_of(stand.on) or "")
    if room is None:
        return False
    point, short = np.zeros(3), stand.furniture.short
    point[short] = side * (stand.furniture.size_m[short] / 2 + hand.settings.stand_m)
    at = snapshot.transform(room.id, stand.on).apply(point[None])[:, :2]
    return not bool(inside_polygon(room.polygon_m, at)[0])
