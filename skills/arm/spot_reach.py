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
from skills.arm.arm_way import BARRED_COST_M, pushes_aside, spared_nodes
from skills.arm.finger_room import palm_meets_rims
from skills.arm.grasping import DOWN_RAD, PAD_DEPTH_M, PALM_HALF_HEIGHT_M, level_meets_rims
from skills.furniture.boards import HAND_HALF_WIDTH_M, LOWEST_M, PALM_BEFORE_M, TURN_RAD, headroom_m, is_before
from skills.furniture.seats import rims
from skills.geometry import Points, Pose2, wrap_rad
from skills.navigation.pose import in_base, robot_frame
from skills.outline import disc
from skills.place.place_spot import Spot

ABOVE_RIM_M = 0.04
SPARE_LIFT_M = 0.02
"""A surface may turn out to be a little higher when it is seen from near."""
DEFAULT_GRIP_SHARE = 0.6
STEEP_RAD = 0.1
"""A hand that is off the vertical by less points down, and one that is off the horizontal by less is level."""

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
    context: RobotContext, spot: Spot, places: Points, *, turn_rad: float = TURN_RAD, spared: Collection[str] = ()
) -> NDArray[np.bool_]:
    """From which of (N, 2) places, in the robot's frame, the hand gets to a spot: to one below a board, from straight
    before; to any other, where what it holds is brought over all that lies on the way, however low the lift ends; and
    to one on a seat, where the hand meets neither back nor arms. ``spared``: things that are thought away.
    """
    on, frame = spot.anchor, robot_frame(context.snapshot)
    if spot.is_covered:
        return is_before(context.snapshot, on.node_id, on.point_m, places, frame, sides=spot.sides, turn_rad=turn_rad)
    target = on.position(context.snapshot, frame)
    no_obstacle, low_m = spared_nodes(context.snapshot, on.node_id) | set(spared), highest_underside_m(context)
    wide_m = held_radius_m(context)
    free = ~pushes_aside(context.snapshot, frame, target, places, no_obstacle, low_m=low_m, wide_m=wide_m)
    seat = context.snapshot.get(on.node_id)
    if spot.inside or not isinstance(seat, ObjectNode) or not rims(seat):
        return free
    x_m, y_m, surface_z_m = target
    T_frame_seat = context.snapshot.transform(frame, seat.id)
    pose, seat_z_m = Pose2.of(T_frame_seat), float(T_frame_seat.z_m)
    facing_rad = np.arctan2(y_m - places[:, 1], x_m - places[:, 0])
    if not _points_down(context):
        low_m = float(surface_z_m) + above_bottom_m(context) - PALM_HALF_HEIGHT_M
        return free & ~level_meets_rims(seat, pose, seat_z_m, target[:2], facing_rad, low_m)
    if spot.turn_rad is None:
        # from above, fingers that close along a, from where the robot faces, take a roll of pi/2 - a
        toward_rad = facing_rad + pi / 2 - context.body.arm.wrist_roll_rad
    else:
        toward_rad = np.full(len(places), pose.yaw_rad + spot.turn_rad + pi / 2)
    palm_m = float(surface_z_m) + above_bottom_m(context) + PAD_DEPTH_M
    return free & ~palm_meets_rims(seat, pose, seat_z_m, target[:2], toward_rad, palm_m)


def pressing_m(context: RobotContext, spot: Spot, places: Points, *, spared: Collection[str] = ()) -> Points:
    """What it costs, (N,), that a level hand which is lowered at a spot, with its arm straight from each of (N, 2)
    places in the robot's frame, comes down on a small thing before it. ``spared``: things that are thought away.
    """
    if spot.is_covered or spot.inside or abs(context.body.arm.wrist_pitch_rad) > STEEP_RAD:
        return np.zeros(len(places))
    on, frame = spot.anchor, robot_frame(context.snapshot)
    target = on.position(context.snapshot, frame)
    met = pushes_aside(
        context.snapshot,
        frame,
        target,
        places,
        spared_nodes(context.snapshot, on.node_id) | set(spared),
        low_m=float(target[2]) + above_bottom_m(context) - PALM_HALF_HEIGHT_M,
        wide_m=HAND_HALF_WIDTH_M,
        short_m=PALM_BEFORE_M,
    )
    return np.where(met, BARRED_COST_M, 0.0)


def highest_underside_m(context: RobotContext) -> float:
    """How high over the floor the lift brings the bottom of what the hand holds, with the wrist as it is."""
    hand_m = context.geometry.hand_length_m * sin(context.body.arm.wrist_pitch_rad)
    return context.limits.lift_m[1] + hand_m - above_bottom_m(context)


def _points_down(context: RobotContext) -> bool:
    return abs(context.body.arm.wrist_pitch_rad - DOWN_RAD) < STEEP_RAD


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
    snapshot, arm = context.snapshot, context.body.arm
    surface_z_m = float(spot.anchor.position(snapshot, robot_frame(snapshot))[2])
    above_m, pitch_rad = above_bottom_m(context), arm.wrist_pitch_rad
    rim_m = ABOVE_RIM_M if spot.inside else 0.0
    lift_m = surface_z_m + above_m + rim_m - context.geometry.hand_length_m * sin(pitch_rad)
    low_m, high_m = context.limits.lift_m
    if not low_m <= lift_m <= high_m - SPARE_LIFT_M:
        return False
    needed_m = headroom_m(held_height_m(context), above_m, pitch_rad, context.geometry)
    return not spot.is_covered or (surface_z_m >= LOWEST_M and needed_m <= spot.free_m)


def held_height_m(context: RobotContext) -> float:
    """Height of what the hand holds."""
    if context.grip is not None:
        return context.grip.size_m[2]
    robot = context.snapshot.robot
    node = context.snapshot.get(robot.holding) if robot is not None and robot.holding is not None else None
    return node.size_m[2] if isinstance(node, ObjectNode) else 0.2


def held_radius_m(context: RobotContext) -> float:
    """How far what the hand holds reaches to the sides, however it is turned; 0 where nothing is known of it."""
    return disc(context.grip.size_m).radius_m if context.grip is not None else 0.0


def above_bottom_m(context: RobotContext) -> float:
    """Height of the pads over the bottom of what the hand holds."""
    grip, hand = context.grip, context.body.T_base_gripper
    if grip is not None:
        return float(hand.z_m - (hand @ grip.T_gripper_object).z_m + grip.size_m[2] / 2)
    robot = context.snapshot.robot
    node = context.snapshot.get(robot.holding) if robot is not None and robot.holding is not None else None
    return DEFAULT_GRIP_SHARE * node.size_m[2] if isinstance(node, ObjectNode) else 0.1
