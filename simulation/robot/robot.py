"""The mobile manipulator's body in PyBullet: motors, limits, dead man, joint measurements (design, section 5)."""

from __future__ import annotations

import math
import tempfile
from dataclasses import dataclass
from itertools import product
from pathlib import Path
from typing import Any

import pybullet as p

from scene_graph.geometry.se3 import SE3
from simulation.robot.contacts import ContactSettings
from simulation.robot.description import Motor, RobotDescription
from simulation.robot.robot_urdf import robot_urdf
from skills.ports import ArmGeometry, ArmTarget

HAND_TURNS = ("base_yaw", "wrist_pitch", "wrist_roll")
"""Joints that turn the hand."""


@dataclass(frozen=True, kw_only=True)
class Joints:
    """Joint positions as they are: meters and radians."""

    lift_m: float
    extension_m: float
    wrist_pitch_rad: float
    wrist_roll_rad: float
    gripper_opening_m: float
    pan_rad: float
    tilt_rad: float


class RobotBody:
    """The robot in a physics client. ``advance`` must be called before every physics step."""

    def __init__(
        self,
        client: int,
        pose: tuple[float, float, float],
        *,
        description: RobotDescription = RobotDescription(),
        contacts: ContactSettings = ContactSettings(),
    ) -> None:
        self.description, self.limits, self.geometry = description, description.limits, description.geometry
        self._contacts = contacts
        self._client = client
        self.body_id = self._load()
        self._joint = {
            p.getJointInfo(self.body_id, index, physicsClientId=client)[1].decode(): index
            for index in range(p.getNumJoints(self.body_id, physicsClientId=client))
        }
        self._target_drive = (0.0, 0.0)
        self._drive = (0.0, 0.0)
        self._drive_age_s = math.inf
        self._opening_m, self._effort_n = self.limits.gripper_opening_m[1], description.usual_effort_n
        self._met_at: tuple[float, ...] = (0.0, 0.0, 0.0)
        self._met_opening_m = 0.0
        self._targets: dict[str, float] = {}
        self.set_pose(pose)
        self._reset_arm()
        self._set_up_contacts()

    @property
    def pose(self) -> tuple[float, float, float]:
        """True pose of the base: x, y in meters, yaw in radians, house coordinates."""
        x_m, y_m, yaw_rad = (self._position(name) for name in ("base_x", "base_y", "base_yaw"))
        return x_m, y_m, math.remainder(yaw_rad, math.tau)

    @property
    def velocity(self) -> tuple[float, float]:
        """Forward and turning velocity of the base as it is."""
        vx, vy, w = (
            p.getJointState(self.body_id, self._joint[name], physicsClientId=self._client)[1]
            for name in ("base_x", "base_y", "base_yaw")
        )
        yaw_rad = self._position("base_yaw")
        return vx * math.cos(yaw_rad) + vy * math.sin(yaw_rad), w

    def set_pose(self, pose: tuple[float, float, float]) -> None:
        """Put the base somewhere, at rest (start, and kidnapping)."""
        for name, value in zip(("base_x", "base_y", "base_yaw"), pose, strict=True):
            p.resetJointState(self.body_id, self._joint[name], value, 0.0, physicsClientId=self._client)
        self._drive = self._target_drive = (0.0, 0.0)

    def command_drive(self, linear_mps: float, angular_radps: float) -> None:
        """Set the velocity to reach, clipped to the limits; lapses after the dead-man timeout."""
        limits = self.limits
        self._target_drive = (
            _clip(linear_mps, (-limits.linear_mps, limits.linear_mps)),
            _clip(angular_radps, (-limits.angular_radps, limits.angular_radps)),
        )
        self._drive_age_s = 0.0

    def command_arm(self, target: ArmTarget) -> None:
        """Set arm joint targets, clipped to the limits."""
        limits = self.limits
        self._targets["lift"] = _clip(target.lift_m, limits.lift_m)
        self._targets["extension"] = _clip(target.extension_m, limits.extension_m)
        self._targets["wrist_pitch"] = _clip(target.wrist_pitch_rad, limits.wrist_pitch_rad)
        self._targets["wrist_roll"] = _clip(target.wrist_roll_rad, limits.wrist_roll_rad)

    def command_look(self, pan_rad: float, tilt_rad: float) -> None:
        """Set the camera's targets, clipped to the limits."""
        self._targets["pan"] = _clip(pan_rad, self.limits.pan_rad)
        self._targets["tilt"] = _clip(tilt_rad, self.limits.tilt_rad)

    def command_grip(self, opening_m: float, effort_n: float) -> None:
        """Set the fingers' target opening and the force of each."""
        self._opening_m = _clip(opening_m, self.limits.gripper_opening_m)
        self._effort_n = _clip(effort_n, self.limits.gripper_effort_n)

    def advance(self, dt_s: float, *, stopped: bool) -> None:
        """Set all motors for the next physics step of ``dt_s``. ``stopped``: everything holds its place at once."""
        self._drive_age_s += dt_s
        self._meet_anew()
        if stopped:
            self._hold()
            return
        lapsed = self._drive_age_s > self.limits.command_timeout_s
        target = (0.0, 0.0) if lapsed else self._target_drive
        self._drive = (
            _ramp(self._drive[0], target[0], self.limits.linear_mps2 * dt_s),
            _ramp(self._drive[1], target[1], self.limits.angular_radps2 * dt_s),
        )
        self._move_base()
        for name, target_value in self._targets.items():
            self._servo(name, target_value, self.description.motors[name])
        self._move_fingers()

    def joints(self) -> Joints:
        """Joint positions."""
        return Joints(
            lift_m=self._position("lift"),
            extension_m=self._position("extension"),
            wrist_pitch_rad=self._position("wrist_pitch"),
            wrist_roll_rad=self._position("wrist_roll"),
            gripper_opening_m=max(0.0, self._position("finger_left") + self._position("finger_right")),
            pan_rad=self._position("pan"),
            tilt_rad=self._position("tilt"),
        )

    def finger_bodies(self) -> tuple[set[int], set[int]]:
        """Bodies that touch the left and the right finger."""
        return self._touching("finger_left"), self._touching("finger_right")

    def bodies_touched(self) -> list[tuple[int, int]]:
        """(body, own link) of all contacts with other bodies. The physics also reports what is merely near."""
        contacts = p.getContactPoints(bodyA=self.body_id, physicsClientId=self._client) or ()
        touching = (contact for contact in contacts if contact[2] != self.body_id and self._is_touch(contact))
        return [(int(contact[2]), int(contact[3])) for contact in touching]

    def is_finger(self, link: int) -> bool:
        """Whether a link of the robot is a finger."""
        return link in (self._joint["finger_left"], self._joint["finger_right"])

    def _touching(self, link: str) -> set[int]:
        contacts = (
            p.getContactPoints(bodyA=self.body_id, linkIndexA=self._joint[link], physicsClientId=self._client) or ()
        )
        pressed = (contact for contact in contacts if contact[9] > self._contacts.pressed_n)
        return {int(contact[2]) for contact in pressed if contact[2] != self.body_id}

    def _is_touch(self, contact: tuple[Any, ...]) -> bool:
        distance_m, force_n = contact[8], contact[9]
        return bool(distance_m < self._contacts.touching_m or force_n > 0.0)

    def _hold(self) -> None:
        self._drive = self._target_drive = (0.0, 0.0)
        self._drive_age_s = math.inf
        self._move_base()
        joints = self.joints()
        held = {
            "lift": joints.lift_m,
            "extension": joints.extension_m,
            "wrist_pitch": joints.wrist_pitch_rad,
            "wrist_roll": joints.wrist_roll_rad,
            "pan": joints.pan_rad,
            "tilt": joints.tilt_rad,
        }
        moving = any(abs(held[name] - target) > self._contacts.still for name, target in self._targets.items())
        if moving:
            self._targets = held
        for name, target in self._targets.items():
            self._servo(name, target, self.description.motors[name])
        self._move_fingers()

    def _move_base(self) -> None:
        yaw_rad = self._position("base_yaw")
        linear, angular = self._drive
        speeds = {"base_x": linear * math.cos(yaw_rad), "base_y": linear * math.sin(yaw_rad), "base_yaw": angular}
        for name, speed in speeds.items():
            p.setJointMotorControl2(
                self.body_id,
                self._joint[name],
                p.VELOCITY_CONTROL,
                targetVelocity=speed,
                force=self.description.base_torque_nm if name == "base_yaw" else self.description.base_force_n,
                physicsClientId=self._client,
            )

    def _move_fingers(self) -> None:
        for name in ("finger_left", "finger_right"):
            motor = Motor(force=self._effort_n, speed=self.description.finger_speed_mps)
            self._servo(name, self._opening_m / 2, motor)

    def _servo(self, name: str, target: float, motor: Motor) -> None:
        p.setJointMotorControl2(
            self.body_id,
            self._joint[name],
            p.POSITION_CONTROL,
            targetPosition=target,
            positionGain=self._contacts.position_gain,
            velocityGain=self._contacts.velocity_gain,
            force=motor.force,
            maxVelocity=motor.speed,
            physicsClientId=self._client,
        )

    def _position(self, name: str) -> float:
        return float(p.getJointState(self.body_id, self._joint[name], physicsClientId=self._client)[0])

    def _load(self) -> int:
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "robot.urdf"
            path.write_text(robot_urdf(self.description), encoding="ascii")
            return int(p.loadURDF(str(path), useFixedBase=True, physicsClientId=self._client))

    def _reset_arm(self) -> None:
        self.command_arm(self.description.stow)
        self.command_look(0.0, self.description.tilt_at_start_rad)
        for name, target in self._targets.items():
            p.resetJointState(self.body_id, self._joint[name], target, 0.0, physicsClientId=self._client)
        for name in ("finger_left", "finger_right"):
            p.resetJointState(self.body_id, self._joint[name], self._opening_m / 2, 0.0, physicsClientId=self._client)

    def _set_up_contacts(self) -> None:
        for link in range(-1, p.getNumJoints(self.body_id, physicsClientId=self._client)):
            p.changeDynamics(
                self.body_id,
                link,
                linearDamping=0.0,
                angularDamping=0.0,
                lateralFriction=self._contacts.body_friction,
                physicsClientId=self._client,
            )
        for name in ("finger_left", "finger_right"):
            p.changeDynamics(
                self.body_id,
                self._joint[name],
                lateralFriction=self._contacts.finger_lateral_friction,
                spinningFriction=self._contacts.finger_spinning_friction,
                rollingFriction=self._contacts.finger_rolling_friction,
                contactStiffness=self._contacts.finger_stiffness_npm,
                contactDamping=self._contacts.finger_damping_nspm,
                physicsClientId=self._client,
            )
        self._couple_fingers()

    def _meet_anew(self) -> None:
        """Forget the contacts of the fingers once the hand has turned or they have opened; the next step finds them."""
        joints = [self._joint[name] for name in (*HAND_TURNS, "finger_left", "finger_right")]
        *turned, left_m, right_m = (
            state[0] for state in p.getJointStates(self.body_id, joints, physicsClientId=self._client)
        )
        self._met_opening_m = min(self._met_opening_m, left_m + right_m)
        turned_rad = max(abs(now - before) for now, before in zip(turned, self._met_at, strict=True))
        if turned_rad < self._contacts.fresh_rad and left_m + right_m < self._met_opening_m + self._contacts.fresh_m:
            return
        self._met_at, self._met_opening_m = tuple(turned), left_m + right_m
        for name in ("finger_left", "finger_right"):
            for body, enabled in product(sorted(self._touching(name)), (0, 1)):
                p.setCollisionFilterPair(
                    self.body_id, body, self._joint[name], -1, enabled, physicsClientId=self._client
                )

    def _couple_fingers(self) -> None:
        """Make the fingers move as mirror images, as one drive moves both in a real gripper."""
        gear = p.createConstraint(
            self.body_id,
            self._joint["finger_left"],
            self.body_id,
            self._joint["finger_right"],
            jointType=p.JOINT_GEAR,
            jointAxis=[0, 1, 0],
            parentFramePosition=[0, 0, 0],
            childFramePosition=[0, 0, 0],
            physicsClientId=self._client,
        )
        erp, force_n = self._contacts.gear_erp, self._contacts.gear_force_n
        p.changeConstraint(gear, gearRatio=-1, erp=erp, maxForce=force_n, physicsClientId=self._client)


def T_base_gripper(joints: Joints, geometry: ArmGeometry) -> SE3:
    """Forward kinematics: frame between the finger pads, x out of the hand, y the closing direction."""
    cos_pitch, sin_pitch = math.cos(joints.wrist_pitch_rad), math.sin(joints.wrist_pitch_rad)
    pitch = SE3(
        quat_wxyz=(math.cos(-joints.wrist_pitch_rad / 2), 0.0, math.sin(-joints.wrist_pitch_rad / 2), 0.0),
        translation_m=(
            geometry.wrist_x_m + joints.extension_m + geometry.hand_length_m * cos_pitch,
            0.0,
            joints.lift_m + geometry.hand_length_m * sin_pitch,
        ),
    )
    roll = SE3(
        quat_wxyz=(math.cos(joints.wrist_roll_rad / 2), math.sin(joints.wrist_roll_rad / 2), 0.0, 0.0),
        translation_m=(0.0, 0.0, 0.0),
    )
    return pitch @ roll


def _clip(value: float, limits: tuple[float, float]) -> float:
    """``value`` within the limits; what is no number counts as zero, since no comparison would hold it."""
    value = 0.0 if math.isnan(value) else value
    return min(max(value, limits[0]), limits[1])


def _ramp(value: float, target: float, step: float) -> float:
    return value + _clip(target - value, (-step, step))
