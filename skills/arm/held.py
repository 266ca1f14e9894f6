"""What the hand holds: how high, how wide, and how deep below the pads."""

from __future__ import annotations

from math import sin

from scene_graph.nodes import ObjectNode
from skills.action import RobotContext
from skills.outline import disc


def is_holding(context: RobotContext) -> bool:
    """Whether the hand holds something, by the grip just made or by the graph."""
    robot = context.snapshot.robot
    return context.grip is not None or (robot is not None and robot.holding is not None)


def held_size_m(context: RobotContext, held: str | None = None) -> tuple[float, float, float]:
    """Extent of what the hand holds, by default what the graph says that is."""
    grip, robot = context.grip, context.snapshot.robot
    if grip is not None and held in (None, grip.object_id):
        return grip.size_m
    held = held if held is not None or robot is None else robot.holding
    node = context.snapshot.get(held) if held is not None else None
    return node.size_m if isinstance(node, ObjectNode) else context.settings.hand.unknown_size_m


def held_radius_m(context: RobotContext) -> float:
    """How far what the hand holds reaches to the sides, however it is turned; 0 where nothing is known of it."""
    return disc(context.grip.size_m).radius_m if context.grip is not None else 0.0


def above_bottom_m(context: RobotContext) -> float:
    """Height of the pads over the bottom of what the hand holds."""
    grip, hand = context.grip, context.body.T_base_gripper
    if grip is not None:
        return float(hand.z_m - (hand @ grip.T_gripper_object).z_m + grip.size_m[2] / 2)
    return context.settings.hand.unknown_grip * held_size_m(context)[2]


def highest_underside_m(context: RobotContext) -> float:
    """How high over the floor the lift brings the bottom of what the hand holds, with the wrist as it is."""
    hand_m = context.geometry.hand_length_m * sin(context.body.arm.wrist_pitch_rad)
    return context.limits.lift_m[1] + hand_m - above_bottom_m(context)
