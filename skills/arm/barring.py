"""What stands before a thing on a board below another, so that the hand would push it on its way in."""

from __future__ import annotations

import numpy as np

from scene_graph.edges import EdgeType
from scene_graph.nodes import UNKNOWN_LABEL, ObjectNode, ObjectState
from scene_graph.snapshot import Snapshot
from skills.arm.grasping import DOUBTFUL_WIDTH_M, MAX_WIDTH_M, underside_below_board_m
from skills.furniture.boards import BOTH_SIDES, FINGER_AIR_M, PALM_BEFORE_M, Board, axes, board_under, extent_on
from skills.geometry import inside_polygon
from skills.navigation.walls import whole_room

PALM_HALF_WIDTH_M = 0.08
"""What is nearer than this to the middle of the hand's way is surely met; the fingers may be that much wider than what
they take to get by.
"""
STAND_M = 0.4
"""So far before a shelf the middle of the base is, at least."""
NAMELESS_M = 0.35
"""What is smaller and has no name does not bar the way: the hand may have to push it, as what can be grasped."""


def barring(snapshot: Snapshot, object_id: str) -> tuple[str, ...]:
    """The small things that stand before a thing on its board, the foremost first, so that the hand would meet them on
    its way straight in from the front: from the side with fewer of them, where both may be open. None for a thing that
    is not below a board.
    """
    support_id, board = snapshot.support_of(object_id), board_under(snapshot, object_id)
    if support_id is None or board is None or not board.is_covered:
        return ()
    beside = _beside(snapshot, object_id, support_id, board)
    sides = [side for side in BOTH_SIDES if not _is_at_wall(snapshot, support_id, side)] if beside else []
    return min((_before(snapshot, object_id, support_id, beside, side) for side in sides), key=len, default=())


def is_small_and_nameless(node: ObjectNode) -> bool:
    """Whether it may well be no thing of its own, but a part of what lies there."""
    return node.label == UNKNOWN_LABEL and max(node.size_m) < NAMELESS_M


def _beside(snapshot: Snapshot, object_id: str, support_id: str, board: Board) -> list[ObjectNode]:
    """The other things on that board that can be taken away from there and have a name."""
    names = (edge.source for edge in snapshot.edges_to(support_id, EdgeType.RELATION) if edge.source != object_id)
    others = (snapshot.get(name) for name in dict.fromkeys(names))
    return [
        node
        for node in others
        if isinstance(node, ObjectNode)
        and node.graspable
        and min(node.size_m[:2]) <= DOUBTFUL_WIDTH_M
        and node.state is ObjectState.PRESENT
        and not is_small_and_nameless(node)
        and board_under(snapshot, node.id) == board
    ]


def _before(
    snapshot: Snapshot, object_id: str, support_id: str, beside: list[ObjectNode], side: int
) -> tuple[str, ...]:
    """Those that the hand would meet on its way in from one side, the foremost first."""
    long, short = axes(snapshot.object(support_id))
    at_m = snapshot.position(object_id, support_id)
    low_m = underside_below_board_m(snapshot, object_id, float(at_m[2]))
    spare_m = max((MAX_WIDTH_M - max(snapshot.object(object_id).size_m[:2])) / 2 - FINGER_AIR_M, 0.0)
    met: list[tuple[float, str]] = []
    for other in beside:
        middle, half = extent_on(snapshot, support_id, other)
        top_m = float(snapshot.position(other.id, support_id)[2]) + other.size_m[2] / 2
        out_m = side * float(middle[short] - at_m[short])
        ahead = abs(float(middle[long] - at_m[long])) - half[long] < PALM_HALF_WIDTH_M - spare_m
        if ahead and top_m > low_m and out_m > 0.0 and out_m + half[short] > PALM_BEFORE_M:
            met.append((-out_m, other.id))
    return tuple(name for _, name in sorted(met))


def _is_at_wall(snapshot: Snapshot, support_id: str, side: int) -> bool:
    """Whether there is surely no place to stand before one of the long sides: it would be beyond the room's wall."""
    room = whole_room(snapshot, snapshot.room_of(support_id) or "")
    if room is None:
        return False
    support = snapshot.object(support_id)
    _, short = axes(support)
    point = np.zeros(3)
    point[short] = side * (support.size_m[short] / 2 + STAND_M)
    at = snapshot.transform(room.id, support_id).apply(point[None])[:, :2]
    return not bool(inside_polygon(room.polygon_m, at)[0])
