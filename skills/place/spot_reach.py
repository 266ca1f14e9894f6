"""Whether and from where the hand gets to a spot with what it holds: what the actions of one PLACE share."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Sequence
from dataclasses import dataclass
from math import pi, sin

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ObjectNode
from skills.action import RobotContext
from skills.anchor import Anchor
from skills.arm.arm_way import pushes_aside, spared_nodes
from skills.arm.finger_room import palm_meets
from skills.arm.hand import DOWN_RAD
from skills.arm.held import above_bottom_m, held_radius_m, held_size_m, highest_underside_m
from skills.arm.level_hand import level_meets
from skills.arm.way_in import is_before
from skills.furniture.furniture import Entry, Furniture
from skills.geometry import Points, Pose2, wrap_rad
from skills.navigation.pose import in_base, robot_frame
from skills.place.place_spot import Spot

SpotSource = Callable[[], Sequence[Spot]]
"""Gives the free spots as the graph is now."""


@dataclass(kw_only=True)
class Placement:
    """What the actions of one PLACE share: the object, where it may go, and the spot chosen.

    ``further``: where else it may go, worse ones after better ones, if none of the spots is within reach;
    ``spots_if_empty``: where it could go if nothing else stood there.
    """

    object_id: str
    target: str
    spots: SpotSource
    further: Callable[[], Iterable[Sequence[Spot]]] = list
    spots_if_empty: SpotSource = list
    spot: Spot | None = None

    def spots_at(self, node_id: str) -> list[Spot]:
        """Where it may go on that piece of furniture, or on the floor of that room."""
        return [spot for spots in (self.spots(), *self.further()) for spot in spots if spot.anchor.node_id == node_id]

    def anchor(self) -> Anchor:
        """The chosen spot; the target itself until one is chosen."""
        return self.spot.anchor if self.spot is not None else Anchor(self.target)

    def price_m(self, context: RobotContext, places: Points) -> Points:
        """What it costs, (N,), that the hand gets to the chosen spot badly from places (N, 2) in the robot's frame;
        infinite where it does not.
        """
        if self.spot is None:
            return np.zeros(len(places))
        return np.where(admitted(context, self.spot, places), pressing_m(context, self.spot, places), np.inf)


def admitted(
    context: RobotContext, spot: Spot, places: Points, *, slack_rad: float = 0.0, spared: Collection[str] = ()
) -> NDArray[np.bool_]:
    """From which of (N, 2) places, in the robot's frame, the hand gets to a spot: to one below a board, from straight
    before; to any other, where what it holds is brought over all that lies on the way, however low the lift ends; and
    to one on a seat, where the hand meets neither back nor arms. ``spared``: things that are thought away.
    """
    on, frame, hand = spot.anchor, robot_frame(context.snapshot), context.hand
    if spot.is_covered:
        return is_before(
            context.snapshot, on.node_id, on.point_m, places, frame, hand, sides=spot.sides, slack_rad=slack_rad
        )
    target = on.position(context.snapshot, frame)
    no_obstacle, low_m = spared_nodes(context.snapshot, on.node_id) | set(spared), highest_underside_m(context)
    free = ~pushes_aside(context, target, places, no_obstacle, low_m=low_m, wide_m=held_radius_m(context))
    node = context.snapshot.get(on.node_id)
    if spot.inside or not isinstance(node, ObjectNode) or not (furniture := Furniture.of(node)).obstacles:
        return free
    x_m, y_m, _ = target
    pose, pads_m = Pose2.of(context.snapshot.transform(frame, node.id)), on.point_m[2] + above_bottom_m(context)
    facing_rad = np.arctan2(y_m - places[:, 1], x_m - places[:, 0])
    if not _points_down(context):
        low_m = pads_m - hand.geometry.palm_half_m[1]
        return free & ~level_meets(furniture, pose, target[:2], facing_rad, low_m, hand)
    if spot.turn_rad is None:
        # from above, fingers that close along a, from where the robot faces, take a roll of pi/2 - a
        toward_rad = facing_rad + pi / 2 - context.body.arm.wrist_roll_rad
    else:
        toward_rad = np.full(len(places), pose.yaw_rad + spot.turn_rad + pi / 2)
    return free & ~palm_meets(furniture, pose, target[:2], toward_rad, pads_m + hand.settings.bite_m, hand)


def pressing_m(context: RobotContext, spot: Spot, places: Points, *, spared: Collection[str] = ()) -> Points:
    """What it costs, (N,), that a level hand which is lowered at a spot, with its arm straight from each of (N, 2)
    places in the robot's frame, comes down on a small thing before it. ``spared``: things that are thought away.
    """
    level = abs(context.body.arm.wrist_pitch_rad) <= context.settings.place.put_down.steep_rad
    if spot.surface.entry is not Entry.ABOVE or not level:
        return np.zeros(len(places))
    on, frame = spot.anchor, robot_frame(context.snapshot)
    target = on.position(context.snapshot, frame)
    met = pushes_aside(
        context,
        target,
        places,
        spared_nodes(context.snapshot, on.node_id) | set(spared),
        low_m=float(target[2]) + above_bottom_m(context) - context.geometry.palm_half_m[1],
        wide_m=context.geometry.hand_half_width_m,
        short_m=context.geometry.palm_to_pads_m,
    )
    return np.where(met, context.settings.reach.barred_cost_m, 0.0)


def _points_down(context: RobotContext) -> bool:
    return abs(context.body.arm.wrist_pitch_rad - DOWN_RAD) < context.settings.place.put_down.steep_rad


def is_within_wrist(context: RobotContext, spot: Spot) -> bool:
    """Whether the wrist turns what is held as it must stand: that takes a hand that points down."""
    return spot.turn_rad is None or _points_down(context)


def roll_at(context: RobotContext, spot: Spot) -> float:
    """The wrist's roll with which what is held stands at a spot as it must, the base being turned as it is."""
    roll_rad, grip = context.body.arm.wrist_roll_rad, context.grip
    if spot.turn_rad is None or grip is None:
        return roll_rad
    crosswise = pi / 2 if grip.size_m[0] < grip.size_m[1] else 0.0
    held_rad = (context.body.T_base_gripper @ grip.T_gripper_object).yaw_rad + crosswise
    more_rad = in_base(context, spot.anchor.node_id).yaw_rad + spot.turn_rad - held_rad
    # the hand points down: what it holds turns the other way about the vertical than the wrist about the hand
    return wrap_rad(2 * (roll_rad - more_rad)) / 2


def is_within_lift(context: RobotContext, spot: Spot) -> bool:
    """Whether the lift gets the hand with what it holds over the spot, and below the board above, if there is one."""
    if not is_within_wrist(context, spot):
        return False
    snapshot, settings, hand = context.snapshot, context.settings.place.put_down, context.hand
    above_m, pitch_rad = above_bottom_m(context), context.body.arm.wrist_pitch_rad
    surface_z_m = float(spot.anchor.position(snapshot, robot_frame(snapshot))[2])
    rim_m = settings.above_rim_m if spot.inside else 0.0
    lift_m = surface_z_m + above_m + rim_m - context.geometry.hand_length_m * sin(pitch_rad)
    low_m, high_m = context.limits.lift_m
    if not low_m <= lift_m <= high_m - settings.spare_lift_m:
        return False
    needed_m = hand.headroom_m(held_size_m(context)[2], above_m, pitch_rad)
    high_enough = surface_z_m >= hand.settings.lowest_board_m
    return not spot.is_covered or (high_enough and needed_m <= spot.surface.free_m)
