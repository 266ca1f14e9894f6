"""Where the robot is: the graph's newest estimate carried forward by the measured velocity."""

from __future__ import annotations

from math import atan2

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ROBOT_ID, ROOT_ID
from scene_graph.snapshot import Snapshot
from skills.action import RobotContext
from skills.geometry import Pose2

ANYWHERE = "anywhere"
"""Stands for the frame of a robot that does not know where it is: what it sees there is worth nothing elsewhere."""


def robot_frame(snapshot: Snapshot) -> str:
    """The frame that the robot hangs from: its room, or ``root`` until a room stands."""
    edge = snapshot.parent(ROBOT_ID)
    return edge.source if edge is not None else ROOT_ID


def base_pose(context: RobotContext, frame: str) -> SE3:
    """``T_frame_base`` now: the estimate in the graph plus what the base moved since its stamp."""
    snapshot = context.snapshot
    edge = snapshot.parent(ROBOT_ID)
    pose = snapshot.transform(frame, ROBOT_ID)
    age_s = context.stamp_s - edge.stamp_s if edge is not None else 0.0
    most_s = context.settings.navigation.prediction_s
    if not 0.0 < age_s <= 2 * most_s:
        return pose
    age_s = min(age_s, most_s)
    moved = Pose2(0.0, 0.0).advanced(context.body.linear_mps * age_s, context.body.angular_radps * age_s)
    return pose @ SE3.from_xyz_yaw(moved.x_m, moved.y_m, 0.0, moved.yaw_rad)


def planar_pose(context: RobotContext, frame: str) -> Pose2:
    """The planar part of ``base_pose``."""
    return Pose2.of(base_pose(context, frame))


def in_base(context: RobotContext, node_id: str) -> SE3:
    """``T_base_node`` now."""
    frame = robot_frame(context.snapshot)
    return base_pose(context, frame).inverse() @ context.snapshot.transform(frame, node_id)


def look_around(context: RobotContext) -> None:
    """Take the newest obstacle points into the memory of the surroundings, in the robot's present frame.

    What was there before the robot was carried away is forgotten, and so is what it saw until it knew where it was.
    """
    snapshot = context.snapshot
    frame, around = robot_frame(snapshot), context.surroundings
    lost = snapshot.robot is not None and not snapshot.robot.localized
    name = ANYWHERE if lost else frame
    if around.frame != name:
        known = around.frame in snapshot and not lost
        around.move_to(name, snapshot.transform(frame, around.frame) if known else None)
    arm_reach_m = context.body.T_base_gripper.x_m + around.settings.beyond_hand_m
    reach_m = arm_reach_m if context.body.arm.extension_m > around.settings.out_m else 0.0
    T_frame_base = snapshot.transform(frame, ROBOT_ID)
    around.observe(context.obstacles_base, T_frame_base, context.stamp_s, reach_m)
    around.observe_floor(context.floor_base, T_frame_base, context.stamp_s, reach_m)


def footprint_radius_m(context: RobotContext) -> float:
    """Radius of a disc around the axis that holds the base, and the hand with what it holds."""
    held_m = max(context.grip.size_m[:2]) / 2 if context.grip is not None else 0.0
    hand_m = context.body.T_base_gripper.x_m + max(held_m, 0.04)
    return max(context.limits.footprint_radius_m, hand_m)


def bearing_rad(context: RobotContext, node_id: str) -> float:
    """Direction from a node to the base, in the frame that the robot hangs from."""
    frame = robot_frame(context.snapshot)
    x_m, y_m, _ = base_pose(context, frame).translation_m - context.snapshot.position(node_id, frame)
    return atan2(y_m, x_m)
