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
from skills.arm.grasping import FINGER_M, PAD_DEPTH_M, TIP_M, pads_from_above_m
from skills.furniture.seats import ends, rims
from skills.geometry import Points, Pose2
from skills.navigation.pose import in_base, robot_frame

AIR_M = 0.01
"""Around a finger, and what neighbors may be larger than believed."""
THICKER_M = 0.01
"""What back and arms of a seat may be thicker than believed: that is known of the kind only."""
_PALM_HALF_M = (0.08, 0.02)
"""Of the palm's sides along the direction in which the fingers close, and across."""
_PALM_AT = tuple((along, out) for along in (0.25, 0.5, 0.75, 1.0) for out in (-1.0, 0.0, 1.0))
"""Points of half a palm, as shares of its sides: four along, three across."""


def fingers_met(context: RobotContext, object_id: str) -> Callable[[float, float], int]:
    """How many of two fingers, and of the two halves of the palm, would come down on something, as a function of the
    direction in which the fingers close, in the base frame, and of how far their pads then are from the middle of the
    object.
    """
    snapshot, T_base_object = context.snapshot, in_base(context, object_id)
    size_m = snapshot.object(object_id).size_m
    lowest_m = T_base_object.z_m - size_m[2] / 2 + TIP_M
    palm_m = pads_from_above_m(size_m, T_base_object.z_m) + PAD_DEPTH_M
    neighbors = [_Solid(context, node) for node in _neighbors(context, object_id)]
    solids = [solid for solid in neighbors if solid.top_m > lowest_m]
    high = [solid for solid in neighbors if solid.top_m > palm_m + AIR_M]
    support_id = snapshot.support_of(object_id)
    seat = _Seat(context, snapshot.object(support_id), object_id) if support_id is not None else None

    def count(direction_rad: float, pad_m: float) -> int:
        toward = np.array((cos(direction_rad), sin(direction_rad)))
        middle, aside = T_base_object.translation_m[:2], np.array((-toward[1], toward[0]))
        fingers = [middle + sign * (pad_m + FINGER_M / 2) * toward for sign in (1, -1)]
        met = sum(
            any(solid.covers(finger) for solid in solids) or (seat is not None and seat.covers(finger))
            for finger in fingers
        )
        half_m, broad_m = _PALM_HALF_M
        for sign in (1, -1):
            palm = [middle + sign * along * half_m * toward + out * broad_m * aside for along, out in _PALM_AT]
            met += any(solid.covers(point) for solid in high for point in palm) or (
                seat is not None and any(seat.covers_above(point, palm_m) for point in palm)
            )
        return met

    return count


def palm_meets_rims(
    seat: ObjectNode, pose: Pose2, seat_z_m: float, middle: Points, toward_rad: Points, low_m: float
) -> NDArray[np.bool_]:
    """(N,) whether a palm over ``middle`` (2,) meets the back or an arm of a seat, for each of the directions
    ``toward_rad`` (N,) in which its fingers may close; all in one frame, in which the seat has that ``pose`` and its
    middle is ``seat_z_m`` high. ``low_m``: height of what is lowest of the palm.
    """
    toward = np.stack((np.cos(toward_rad), np.sin(toward_rad)), axis=-1)[:, None]
    aside = np.stack((-toward[..., 1], toward[..., 0]), axis=-1)
    shares = np.array([(sign * along, out) for sign in (1.0, -1.0) for along, out in _PALM_AT]) * _PALM_HALF_M
    palm = pose.inverse_apply(middle + shares[:, :1] * toward + shares[:, 1:] * aside)
    met = np.zeros(len(toward_rad), np.bool_)
    for rim in rims(seat):
        if seat_z_m + rim.top_m > low_m - AIR_M:
            met |= rim.covers(palm, AIR_M + THICKER_M).any(axis=1)
    return met


def _neighbors(context: RobotContext, object_id: str) -> list[ObjectNode]:
    snapshot, spared = context.snapshot, spared_nodes(context.snapshot, object_id)
    here = [node for node in snapshot.of_type(ObjectNode) if snapshot.room_of(node.id) == robot_frame(snapshot)]
    return [node for node in here if node.state is ObjectState.PRESENT and node.id not in spared]


class _Solid:
    """The outline of a thing, seen from above, in the base frame."""

    def __init__(self, context: RobotContext, node: ObjectNode) -> None:
        T_base_node: SE3 = in_base(context, node.id)
        self._T_node_base = T_base_node.inverse()
        self._half_m = np.array(node.size_m[:2]) / 2
        self.top_m = T_base_node.z_m + node.size_m[2] / 2

    def local(self, point: Points) -> Points:
        """A point (2,) of the base frame in its own."""
        return np.asarray(self._T_node_base.apply((*point, 0.0))[:2])

    def covers(self, point: Points) -> bool:
        """Whether a finger there would meet it."""
        return bool((np.abs(self.local(point)) < self._half_m + AIR_M).all())


class _Seat(_Solid):
    """What carries a thing: its back and its arms, no nearer than the thing itself. Of a seat whose back nobody has
    seen, it may be at either end.
    """

    def __init__(self, context: RobotContext, node: ObjectNode, carried_id: str) -> None:
        super().__init__(context, node)
        at = context.snapshot.position(carried_id, node.id)[:2]
        known = rims(node) or ends(node, top_m=node.size_m[2] / 2)
        self._rims = tuple(replace(rim, thick_m=rim.thick_m + THICKER_M).beyond(at) for rim in known)
        self._middle_m = self.top_m - node.size_m[2] / 2

    def covers(self, point: Points) -> bool:
        """Whether a finger there would meet an arm, or the back."""
        return self.covers_above(point, -inf)

    def covers_above(self, point: Points, low_m: float) -> bool:
        """Whether what is there, ``low_m`` over the floor, would meet an arm, or the back."""
        local = self.local(point)
        return any(self._middle_m + rim.top_m > low_m and bool(rim.covers(local, AIR_M)) for rim in self._rims)
