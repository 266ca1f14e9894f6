"""A robot behind rosbridge as the service sees it: both ports, a clock and an end."""

from __future__ import annotations

import asyncio
import contextlib
import math
import time
from collections.abc import Coroutine
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Self

from drivers.rosbridge.actuators import Actuators
from drivers.rosbridge.connection import Connection, ConnectionSettings, not_reached
from drivers.rosbridge.governor import Governor
from drivers.rosbridge.messages import time_message, twist
from drivers.rosbridge.profile import Profile, read_profile
from drivers.rosbridge.sensors import Sensors, SensorSettings
from perception.errors import SensorSilent
from perception.ports import JointState, LidarScan, Odometry, RgbdFrame
from skills.arm.kinematics import gripper_pose
from skills.errors import BodySilent
from skills.ports import ArmGeometry, ArmTarget, BodyLimits, BodyState


@dataclass(frozen=True, kw_only=True)
class DriverSettings:
    """How the robot is told and heard."""

    pace_s: float = 0.05
    """How often the base is told its speed while it moves: well within the time-outs of common bases."""
    standing_s: float = 0.5
    """How long it is told to stand after it has moved; then others may drive it."""
    start_limit_s: float = 10.0
    """Within which every sensor must have been heard: chosen."""
    connection: ConnectionSettings = field(default_factory=ConnectionSettings)
    sensors: SensorSettings = field(default_factory=SensorSettings)


async def connect(where: str) -> RosbridgeRobot:
    """The robot of a profile's file, once it has said where it is and what it sees.

    Raises:
        BadProfile: the file is faulty; names the field.
        RobotNotReached: nobody answers, or nothing comes of a sensor.
    """
    return await RosbridgeRobot.reach(read_profile(Path(where)))


class RosbridgeRobot:
    """``SensorPort`` and ``BodyPort`` over one websocket. Make one with ``await RosbridgeRobot.reach(profile)``.

    Its time is that of its odometry's stamps, from zero on. When the connection is lost whatever was commanded is
    forgotten; the base is then held by its own command timeout, which it must have. When the connection is back the
    robot is first told to stand still, and does nothing until it is told anew.
    """

    def __init__(self, profile: Profile, settings: DriverSettings = DriverSettings()) -> None:
        self._profile, self._limits, self._settings = profile, profile.body_limits, settings
        self._sensors = Sensors(profile, settings=settings.sensors)
        self._governor = Governor(self._limits)
        self._connection = Connection(
            profile.url,
            subscriptions=self._sensors.subscriptions,
            advertised={profile.drive: profile.drive_type} | Actuators.topics(profile),
            hear=self._sensors.hear,
            on_change=self._on_change,
            settings=settings.connection,
        )
        self._actuators = Actuators(profile, self._connection)
        self._stopped = False
        self._hold_due = False
        self._moved_s = -math.inf
        self._loop = asyncio.get_running_loop()
        self._tasks: list[asyncio.Task[None]] = []

    @classmethod
    async def reach(cls, profile: Profile, *, settings: DriverSettings = DriverSettings()) -> Self:
        """Connect, and wait until odometry, joints and LiDAR have been heard.

        Raises:
            RobotNotReached: that took longer than ``start_limit_s``; says what is missing.
        """
        robot = cls(profile, settings)
        robot._begin(robot._connection.run(), robot._pace())
        deadline_s = time.monotonic() + settings.start_limit_s
        while robot._sensors.waiting_for and time.monotonic() < deadline_s:  # noqa: ASYNC110 - once, at the start
            await asyncio.sleep(0.05)
        if missing := robot._sensors.waiting_for:
            reason = not_reached(robot._connection, profile.url, missing)
            await robot.close()
            raise reason
        return robot

    @property
    def limits(self) -> BodyLimits:
        """The body's limits, enforced here."""
        return self._limits

    @property
    def geometry(self) -> ArmGeometry:
        """The arm's dimensions."""
        return self._profile.arm_geometry

    @property
    def now_s(self) -> float:
        """Robot time in seconds, since the driver began."""
        return self._sensors.now_s

    @property
    def stopped(self) -> bool:
        """Whether the software stop is latched."""
        return self._stopped

    async def odometry(self) -> Odometry:
        """Newest odometry."""
        return self._sensors.odometry()

    async def scan(self) -> LidarScan:
        """Newest LiDAR revolution."""
        return await self._sensors.scan()

    async def frame(self) -> RgbdFrame:
        """Newest color and depth image."""
        return await self._sensors.frame()

    async def joints(self) -> JointState:
        """Newest joint and gripper state."""
        stamp_s, actuators = self._joints_stamp_s(), self._actuators.measured(self._sensors.joints)
        arm = actuators.arm
        return JointState(
            stamp_s=stamp_s,
            lift_m=arm.lift_m,
            extension_m=arm.extension_m,
            wrist_pitch_rad=arm.wrist_pitch_rad,
            wrist_roll_rad=arm.wrist_roll_rad,
            gripper_opening_m=actuators.gripper_opening_m,
            pan_rad=actuators.pan_rad,
            tilt_rad=actuators.tilt_rad,
            finger_contacts=actuators.finger_contacts,
            T_base_gripper=gripper_pose(arm, self.geometry),
        )

    async def state(self) -> BodyState:
        """The body as measured.

        Raises:
            BodySilent: the connection is lost, or the robot has fallen silent.
        """
        self._check_body()
        try:
            odometry, joints = self._sensors.odometry(), await self.joints()
        except SensorSilent as silence:
            raise BodySilent(str(silence)) from silence
        actuators = self._actuators.measured(self._sensors.joints)
        return BodyState(
            stamp_s=joints.stamp_s,
            linear_mps=odometry.linear_mps,
            angular_radps=odometry.angular_radps,
            arm=actuators.arm,
            gripper_opening_m=actuators.gripper_opening_m,
            finger_contacts=actuators.finger_contacts,
            pan_rad=actuators.pan_rad,
            tilt_rad=actuators.tilt_rad,
            bumped=self._sensors.bumped,
            stopped=self._stopped,
            T_base_gripper=joints.T_base_gripper,
        )

    async def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Command the base; lapses after the dead-man timeout."""
        if self._may_move():
            self._governor.want(linear_mps, angular_radps)

    async def look(self, pan_rad: float, tilt_rad: float) -> None:
        """Aim the camera."""
        if self._may_move():
            self._actuators.look(pan_rad, tilt_rad, self._sensors.joints)

    async def move_arm(self, target: ArmTarget) -> None:
        """Move the arm."""
        if self._may_move():
            self._actuators.move_arm(target, self._sensors.joints)

    async def grip(self, opening_m: float, effort_n: float = 15.0) -> None:
        """Move the fingers."""
        if self._may_move():
            self._actuators.grip(opening_m, effort_n)

    def stop(self) -> None:
        """Latch the stop: base and arm stand, the gripper keeps its grip. From any thread; never waits."""
        self._stopped = True
        self._loop.call_soon_threadsafe(self._stand_still)

    def release_stop(self) -> None:
        """Release the stop; nothing moves until the next command."""
        self._stopped = False

    async def advance(self, duration_s: float) -> float:
        """Wait: nobody can advance a real robot's time."""
        await asyncio.sleep(duration_s)
        return self.now_s

    async def close(self) -> None:
        """Stand still, and let go of the robot."""
        self._stand_still()
        await self._connection.sent(limit_s=0.5)
        for task in self._tasks:
            task.cancel()
        for task in self._tasks:
            with contextlib.suppress(asyncio.CancelledError):
                await task

    def _begin(self, *works: Coroutine[Any, Any, None]) -> None:
        self._tasks = [asyncio.create_task(work, name="rosbridge") for work in works]

    def _may_move(self) -> bool:
        """Whether commands are carried out.

        Raises:
            BodySilent: the connection is lost.
        """
        self._check_body()
        return not self._stopped

    def _check_body(self) -> None:
        for task in self._tasks:
            if task.done() and not task.cancelled():
                raise BodySilent(f"its driver ended: {task.exception()}")
        if not self._connection.up:
            raise BodySilent(f"the connection to {self._profile.url} is lost: {self._connection.problem}")
        if missing := self._sensors.waiting_for:
            raise BodySilent(f"nothing has come on {', '.join(missing)} yet")

    def _joints_stamp_s(self) -> float:
        """A robot without joints measures them whenever it measures where it is."""
        return self._sensors.check_joints() if self._profile.joint_names else self._sensors.odometry().stamp_s

    def _on_change(self, up: bool) -> None:
        self._governor.halt()
        self._actuators.forget()
        self._hold_due = up
        if up:
            self._sensors.joints.position.clear()
            self._drive_at(0.0, 0.0)

    def _stand_still(self) -> None:
        self._governor.halt()
        self._drive_at(0.0, 0.0)
        self._actuators.hold(self._sensors.joints)

    async def _pace(self) -> None:
        """Command the base, twenty times a second while there is a reason to."""
        before_s = time.monotonic()
        while True:
            await asyncio.sleep(self._settings.pace_s)
            now_s = time.monotonic()
            dt_s, before_s = now_s - before_s, now_s
            self._hold_once_seen()
            speed = (0.0, 0.0) if self._stopped else self._governor.step(min(dt_s, 2 * self._settings.pace_s))
            if speed != (0.0, 0.0):
                self._moved_s = now_s
            if self._stopped or now_s - self._moved_s <= self._settings.standing_s:
                self._drive_at(*speed)

    def _hold_once_seen(self) -> None:
        """After a connection is made the arm is held where it is, as soon as it is known where that is."""
        if self._hold_due and not self._sensors.waiting_for:
            self._hold_due = False
            self._actuators.hold(self._sensors.joints)

    def _drive_at(self, linear_mps: float, angular_radps: float) -> None:
        message = twist(linear_mps, angular_radps)
        if self._profile.drive_type == "geometry_msgs/TwistStamped":
            header = {"stamp": time_message(0.0, self._profile.ros), "frame_id": self._profile.base_frame}
            message = {"header": header, "twist": message}
        self._connection.publish(self._profile.drive, message)
