"""Arm, head and gripper behind rosbridge: trajectories to controllers, a gripper's action, and what joints say."""

from __future__ import annotations

import math
from dataclasses import dataclass

from drivers.rosbridge.connection import Connection
from drivers.rosbridge.messages import Joints, trajectory
from drivers.rosbridge.profile import Profile
from skills.ports import ArmTarget

TRAJECTORY = "trajectory_msgs/JointTrajectory"
GRIPPER_COMMAND = "control_msgs/action/GripperCommand"
GRIPPER_GOAL_1 = "control_msgs/GripperCommandActionGoal"
"""In ROS 1 an action's goal is a message on a topic of its own."""
SHORTEST_S = 0.1
"""A trajectory takes no less: controllers refuse those that are over at once."""
STOWED = ArmTarget(lift_m=0.75, extension_m=0.0, wrist_pitch_rad=-math.pi / 2)
"""What is said of an arm that is not there."""


@dataclass(frozen=True, kw_only=True)
class Measured:
    """Actuators as measured: meters and radians."""

    arm: ArmTarget
    pan_rad: float
    tilt_rad: float
    gripper_opening_m: float
    finger_contacts: tuple[bool, bool]


class Actuators:
    """Commands are clipped to the limits, and sent when they change: a controller begins anew with each."""

    def __init__(self, profile: Profile, connection: Connection) -> None:
        self._profile, self._limits, self._connection = profile, profile.body_limits, connection
        self._told: dict[str, object] = {}

    @staticmethod
    def topics(profile: Profile) -> dict[str, str]:
        """Topic -> type of what is published here."""
        topics = {limb.topic: TRAJECTORY for limb in (profile.arm, profile.head) if limb is not None}
        if profile.ros == 1 and profile.gripper is not None:
            topics[f"{profile.gripper.action}/goal"] = GRIPPER_GOAL_1
        return topics

    def measured(self, joints: Joints) -> Measured:
        """What the joints say; of actuators that are not there, that they rest."""
        arm, head, gripper = self._profile.arm, self._profile.head, self._profile.gripper
        at, effort = joints.position, joints.effort
        return Measured(
            arm=STOWED
            if arm is None
            else ArmTarget(
                lift_m=at[arm.lift],
                extension_m=at[arm.extension],
                wrist_pitch_rad=at[arm.wrist_pitch],
                wrist_roll_rad=at[arm.wrist_roll],
            ),
            pan_rad=0.0 if head is None else at[head.pan],
            tilt_rad=0.0 if head is None else at[head.tilt],
            gripper_opening_m=0.0 if gripper is None else max(0.0, sum(at[finger] for finger in gripper.fingers)),
            finger_contacts=(False, False)
            if gripper is None
            else (
                abs(effort.get(gripper.fingers[0], 0.0)) >= gripper.contact_effort,
                abs(effort.get(gripper.fingers[1], 0.0)) >= gripper.contact_effort,
            ),
        )

    def move_arm(self, target: ArmTarget, joints: Joints) -> None:
        """Move the arm there, no faster than the profile says."""
        arm, limits = self._profile.arm, self._limits
        if arm is None:
            return
        wanted = {
            arm.lift: _clip(target.lift_m, limits.lift_m),
            arm.extension: _clip(target.extension_m, limits.extension_m),
            arm.wrist_pitch: _clip(target.wrist_pitch_rad, limits.wrist_pitch_rad),
            arm.wrist_roll: _clip(target.wrist_roll_rad, limits.wrist_roll_rad),
        }
        speeds = dict.fromkeys((arm.lift, arm.extension), arm.linear_mps)
        speeds |= dict.fromkeys((arm.wrist_pitch, arm.wrist_roll), arm.angular_radps)
        self._move(arm.topic, wanted, speeds, joints)

    def look(self, pan_rad: float, tilt_rad: float, joints: Joints) -> None:
        """Aim the camera."""
        head, limits = self._profile.head, self._limits
        if head is None:
            return
        wanted = {head.pan: _clip(pan_rad, limits.pan_rad), head.tilt: _clip(tilt_rad, limits.tilt_rad)}
        self._move(head.topic, wanted, dict.fromkeys(wanted, head.angular_radps), joints)

    def grip(self, opening_m: float, effort_n: float) -> None:
        """Move the fingers, with ``effort_n`` at most."""
        gripper = self._profile.gripper
        if gripper is None:
            return
        opening_m, effort_n = (
            _clip(opening_m, self._limits.gripper_opening_m),
            _clip(effort_n, self._limits.gripper_effort_n),
        )
        if self._told.get(gripper.action) != (opening_m, effort_n):
            self._told[gripper.action] = (opening_m, effort_n)
            goal = {"command": {"position": opening_m, "max_effort": effort_n}}
            if self._profile.ros == 1:
                self._connection.publish(f"{gripper.action}/goal", {"goal": goal})
            else:
                self._connection.send_goal(gripper.action, GRIPPER_COMMAND, goal)

    def hold(self, joints: Joints) -> None:
        """Keep arm and head where they are; the gripper keeps its grip."""
        arm, head = self._profile.arm, self._profile.head
        if arm is not None:
            self._hold(arm.topic, (arm.lift, arm.extension, arm.wrist_pitch, arm.wrist_roll), joints)
        if head is not None:
            self._hold(head.topic, (head.pan, head.tilt), joints)

    def forget(self) -> None:
        """What was told is no longer what the controllers do."""
        self._told.clear()

    def _move(self, topic: str, wanted: dict[str, float], speeds: dict[str, float], joints: Joints) -> None:
        if self._told.get(topic) == wanted:
            return
        self._told[topic] = wanted
        way_s = [abs(wanted[name] - joints.position[name]) / speeds[name] for name in wanted]
        self._connection.publish(topic, trajectory(wanted, max(SHORTEST_S, *way_s), self._profile.ros))

    def _hold(self, topic: str, names: tuple[str, ...], joints: Joints) -> None:
        self._told.pop(topic, None)
        if all(name in joints.position for name in names):
            here = {name: joints.position[name] for name in names}
            self._connection.publish(topic, trajectory(here, SHORTEST_S, self._profile.ros))


def _clip(value: float, limits: tuple[float, float]) -> float:
    """``value`` within the limits; what is no number counts as zero, since no comparison would hold it."""
    return min(max(0.0 if math.isnan(value) else value, limits[0]), limits[1])
