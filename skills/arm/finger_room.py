"""Where there is room for the hand around what it takes or puts down from above: no finger in a neighbor, or in the arm
or the back of a seat, nor the palm above the fingers.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import cos, inf, sin

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode, ObjectState
from skills.action import RobotContext
from skills.arm.arm_way import spared_nodes
from skills.arm.hand import Hand
from skills.furniture.furniture import Furniture
from skills.geometry import Points, Pose2
from skills.navigation.pose import in_base, robot_frame

_PALM_AT = np.array(
    [[(sign * along, out) for along in (0.25, 0.5, 0.75, 1.0) for out in (-1.0, 0.0, 1.0)] for sign in (1.0, -1.0)]
)
"""Points of both halves of a palm, (2, 12, 2), as shares of its sides: four along, three across."""


def fingers_met(context: RobotContext, object_id: str) -> Callable[[float, float], int]:
    """How many of two fingers, and of the two halves of the palm, would come down on something, as a function of the
    direction in which the fingers close, in the base frame, and of how far their pads then are from the middle of the
    object.
    """
    snapshot, hand, T_base_object = context.snapshot, context.hand, in_base(context, object_id)
    size_m = snapshot.object(object_id).size_m
    lowest_m = T_base_object.z_m - size_m[2] / 2 + hand.tip_m
    palm_m = hand.pads_from_above_m(size_m, T_base_object.z_m) + hand.settings.bite_m
    neighbors = [_Solid(context, node) for node in _neighbors(context, object_id)]
    solids = [solid for solid in neighbors if solid.top_m > lowest_m]
    high = [solid for solid in neighbors if solid.top_m > palm_m + hand.settings.neighbor_air_m]
    support_id = snapshot.support_of(object_id)
    if support_id is not None:
        support = snapshot.object(support_id)
        solids.append(_Support(context, support, object_id, -inf))
        high.append(_Support(context, support, object_id, palm_m))

    def count(direction_rad: float, pad_m: float) -> int:
        middle = T_base_object.translation_m[:2]
        ahead = (pad_m + hand.geometry.finger_m / 2) * np.array((cos(direction_rad), sin(direction_rad)))
        fingers, (halves,) = (middle + ahead, middle - ahead), _palm(hand, middle, np.array([direction_rad]))
        met = sum(any(solid.covers(finger) for solid in solids) for finger in fingers)
        return met + sum(any(solid.covers(point) for solid in high for point in half) for half in halves)

    return count


def palm_meets(
    furniture: Furniture, pose: Pose2, middle: Points, toward_rad: Points, low_m: float, hand: Hand
) -> NDArray[np.bool_]:
    """(N,) whether a palm over ``middle`` (2,) meets a back or an arm of furniture, for each of the directions
    ``toward_rad`` (N,) in which its fingers may close; all in one frame, in which the furniture has that ``pose``.
    ``low_m``: height of what is lowest of the palm over the middle of the furniture.
    """
    palm = pose.inverse_apply(_palm(hand, middle, toward_rad).reshape(len(toward_rad), -1, 2))
    air_m, thicker_m = hand.settings.neighbor_air_m, hand.settings.thicker_m
    return np.asarray(furniture.met(palm, low_m - air_m, air_m=air_m + thicker_m).any(axis=1))


def _palm(hand: Hand, middle: Points, toward_rad: Points) -> Points:
    """(N, 2, 12, 2): points of both halves of a palm over ``middle`` whose fingers close in each of the directions."""
    toward = np.stack((np.cos(toward_rad), np.sin(toward_rad)), axis=-1)[:, None, None]
    aside = np.stack((-toward[..., 1], toward[..., 0]), axis=-1)
    shares = _PALM_AT * hand.geometry.palm_half_m
    return np.asarray(middle + shares[..., :1] * toward + shares[..., 1:] * aside)


def _neighbors(context: RobotContext, object_id: str) -> list[ObjectNode]:
    snapshot, spared = context.snapshot, spared_nodes(context.snapshot, object_id)
    here = [node for node in snapshot.of_type(ObjectNode) if snapshot.room_of(node.id) == robot_frame(snapshot)]
    return [node for node in here if node.state is ObjectState.PRESENT and node.id not in spared]


class _Solid:
    """The outline of a thing, seen from above, in the base frame."""

    def __init__(self, context: RobotContext, node: ObjectNode) -> None:
        T_base_node: SE3 = in_base(context, node.id)
        self._T_node_base, self._air_m = T_base_node.inverse(), context.settings.hand.neighbor_air_m
        self._half_m = np.array(node.size_m[:2]) / 2
        self.top_m = T_base_node.z_m + node.size_m[2] / 2

    def local(self, point: Points) -> Points:
        """A point (2,) of the base frame in its own."""
        return np.asarray(self._T_node_base.apply((*point, 0.0))[:2])

    def covers(self, point: Points) -> bool:
        """Whether what is there would meet it."""
        return bool((np.abs(self.local(point)) < self._half_m + self._air_m).all())


class _Support(_Solid):
    """What carries a thing: a back and arms, no nearer than the thing itself. Of a seat whose back nobody has seen, it
    may be at either end.
    """

    def __init__(self, context: RobotContext, node: ObjectNode, carried_id: str, low_m: float) -> None:
        """``low_m``: what rises no higher over the floor is left out."""
        super().__init__(context, node)
        at, furniture = context.snapshot.position(carried_id, node.id)[:2], Furniture.of(node)
        middle_m, thicker_m = self.top_m - node.size_m[2] / 2, context.settings.hand.thicker_m
        high = [rim for rim in furniture.suspects if middle_m + rim.top_m > low_m]
        self._rims = [furniture.beside(replace(rim, thick_m=rim.thick_m + thicker_m), at) for rim in high]

    def covers(self, point: Points) -> bool:
        """Whether what is there would meet an arm, or the back."""
        return any(bool(rim.covers(self.local(point), self._air_m)) for rim in self._rims)
