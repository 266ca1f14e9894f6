"""House, robot and sensors in one physics client, and simulated time (design, section 5)."""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from typing import Any

import numpy as np
import pybullet as p

from perception.ports import JointState, LidarScan, Odometry, RgbdFrame
from scene_graph.geometry.se3 import SE3
from simulation.houses.disturbances import parse_disturbance
from simulation.houses.house import House
from simulation.process.messages import Readings
from simulation.robot.camera import T_base_camera, render
from simulation.robot.description import RobotDescription
from simulation.robot.lidar import Lidar
from simulation.robot.noise import NoisyOdometry, noisy_depth, noisy_ranges
from simulation.robot.robot import RobotBody, T_base_gripper
from simulation.world.bodies import carry_along
from simulation.world.physics import PhysicsSettings
from simulation.world.world import World
from skills.ports import ArmTarget, BodyState

STEPS_BETWEEN_READINGS = 12
"""The wheels are read, and collisions counted, twenty times a second."""
HARMLESS = frozenset({"floor"})
TOUCHED_KEPT = 100
"""Of so many collisions it is known what was touched."""


class Engine:
    """One simulated house with its robot. Not thread-safe; ``stop_latched`` is asked before every physics step."""

    def __init__(
        self,
        house: House,
        seed: int,
        stop_latched: Callable[[], bool],
        *,
        robot: RobotDescription = RobotDescription(),
        physics: PhysicsSettings = PhysicsSettings(),
    ) -> None:
        self._house, self._stop_latched = house, stop_latched
        self._step_s = physics.step_s
        self._client = p.connect(p.DIRECT)
        p.setPhysicsEngineParameter(
            fixedTimeStep=physics.step_s,
            numSolverIterations=physics.solver_iterations,
            deterministicOverlappingPairs=1,
            physicsClientId=self._client,
        )
        world_seed, *sensor_seeds = np.random.SeedSequence(seed).spawn(4)
        self._world = World(house, client=self._client, rng=np.random.default_rng(world_seed), physics=physics)
        self._world.move_robot = self._carry
        self._robot = RobotBody(self._client, house.robot.pose, description=robot)
        self._lidar = Lidar(robot.lidar)
        odometry, lidar, depth = (np.random.default_rng(child) for child in sensor_seeds)
        self._odometry = NoisyOdometry(house.noise, odometry, self._robot.pose)
        self._lidar_rng, self._depth_rng = lidar, depth
        self._steps = 0
        self._collisions = 0
        self._met: set[int] = set()
        self._colliding: frozenset[int] = frozenset()
        self._touched: deque[str] = deque(maxlen=TOUCHED_KEPT)

    @property
    def now_s(self) -> float:
        """Simulated time in seconds."""
        return self._steps * self._step_s

    def advance(self, duration_s: float) -> float:
        """Step physics for ``duration_s``; the new time."""
        for _ in range(round(duration_s / self._step_s)):
            self._robot.advance(self._step_s, stopped=self._stop_latched())
            self._world.advance(self._step_s, self.now_s)
            p.stepSimulation(physicsClientId=self._client)
            self._steps += 1
            self._met |= self._collided_with()
            if self._steps % STEPS_BETWEEN_READINGS == 0:
                self._odometry.advance(self._robot.pose)
                self._count_collisions()
        return self.now_s

    def odometry(self) -> Odometry:
        """Dead reckoning as the wheels tell it."""
        self._odometry.advance(self._robot.pose)
        x_m, y_m, yaw_rad = self._odometry.pose
        linear, angular = self._robot.velocity
        return Odometry(stamp_s=self.now_s, x_m=x_m, y_m=y_m, yaw_rad=yaw_rad, linear_mps=linear, angular_radps=angular)

    def scan(self) -> LidarScan:
        """One LiDAR revolution, taken at this instant."""
        x_m, y_m, yaw_rad = self._robot.pose
        height_m = self._robot.geometry.lidar_height_m
        ranges_m = self._lidar.scan_ranges(self._world.solids.now(self._gripped()), (x_m, y_m, height_m), yaw_rad)
        return LidarScan(
            stamp_s=self.now_s,
            ranges_m=noisy_ranges(ranges_m, self._house.noise.lidar_range_std_m, self._lidar_rng),
            elevations_rad=self._lidar.elevations_rad,
            azimuths_rad=self._lidar.azimuths_rad,
            T_base_lidar=SE3.from_xyz_yaw(0.0, 0.0, height_m, 0.0),
        )

    def frame(self) -> RgbdFrame:
        """Color and depth as the camera sees now."""
        camera = self._robot.description.camera
        T_camera = T_base_camera(self._robot.joints(), self._robot.description)
        x_m, y_m, yaw_rad = self._robot.pose
        picture = render(SE3.from_xyz_yaw(x_m, y_m, 0.0, yaw_rad) @ T_camera, self._client, camera)
        depth_m = noisy_depth(picture.depth_m, self._house.noise.depth_std_m_per_m2, self._depth_rng)
        return RgbdFrame(
            stamp_s=self.now_s, rgb=picture.rgb, depth_m=depth_m, intrinsics=camera.intrinsics, T_base_camera=T_camera
        )

    def joints(self) -> JointState:
        """Arm, gripper and camera as measured."""
        joints, touched = self._robot.joints(), self._finger_contacts()
        return JointState(
            stamp_s=self.now_s,
            lift_m=joints.lift_m,
            extension_m=joints.extension_m,
            wrist_pitch_rad=joints.wrist_pitch_rad,
            wrist_roll_rad=joints.wrist_roll_rad,
            gripper_opening_m=joints.gripper_opening_m,
            pan_rad=joints.pan_rad,
            tilt_rad=joints.tilt_rad,
            finger_contacts=touched,
            T_base_gripper=T_base_gripper(joints, self._robot.geometry),
        )

    def body_state(self) -> BodyState:
        """The same for skills."""
        return self._body_state(self.joints())

    def readings(self) -> Readings:
        """All that the body measures by itself."""
        joints = self.joints()
        return Readings(odometry=self.odometry(), joints=joints, state=self._body_state(joints))

    def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Set the base's velocity."""
        self._robot.command_drive(linear_mps, angular_radps)

    def look(self, pan_rad: float, tilt_rad: float) -> None:
        """Aim the camera."""
        self._robot.command_look(pan_rad, tilt_rad)

    def move_arm(self, target: ArmTarget) -> None:
        """Move the arm."""
        self._robot.command_arm(target)

    def grip(self, opening_m: float, effort_n: float) -> None:
        """Move the fingers."""
        self._robot.command_grip(opening_m, effort_n)

    def truth(self) -> dict[str, Any]:
        """The simulator's truth, for scoring."""
        held = [name for body in sorted(self._gripped()) if (name := self._world.id_of(body)) is not None]
        return self._world.truth(
            stamp_s=self.now_s,
            robot_pose=self._robot.pose,
            holding=held[0] if held else None,
            collisions=self._collisions,
            touched=list(self._touched),
        )

    def disturb(self, event: dict[str, Any]) -> None:
        """Carry out one disturbance at once."""
        self._world.apply(parse_disturbance(event))

    def close(self) -> None:
        """Release the physics client."""
        p.disconnect(physicsClientId=self._client)

    def _body_state(self, joints: JointState) -> BodyState:
        linear, angular = self._robot.velocity
        return BodyState(
            stamp_s=joints.stamp_s,
            linear_mps=linear,
            angular_radps=angular,
            arm=ArmTarget(
                lift_m=joints.lift_m,
                extension_m=joints.extension_m,
                wrist_pitch_rad=joints.wrist_pitch_rad,
                wrist_roll_rad=joints.wrist_roll_rad,
            ),
            gripper_opening_m=joints.gripper_opening_m,
            finger_contacts=joints.finger_contacts,
            pan_rad=joints.pan_rad,
            tilt_rad=joints.tilt_rad,
            bumped=bool(self._colliding),
            stopped=self._stop_latched(),
            T_base_gripper=joints.T_base_gripper,
        )

    def _carry(self, pose: tuple[float, float, float]) -> None:
        """Put the robot elsewhere, with what it holds."""
        before, held = self._robot.pose, self._gripped()
        self._robot.set_pose(pose)
        for body in held:
            carry_along(self._client, body, before, pose)
        self._odometry.jump(pose)

    def _finger_contacts(self) -> tuple[bool, bool]:
        left, right = self._robot.finger_bodies()
        return bool(left), bool(right)

    def _gripped(self) -> set[int]:
        left, right = self._robot.finger_bodies()
        return left & right

    def _collided_with(self) -> set[int]:
        """Bodies that the robot touches, but the floor and what its fingers touch."""
        met = {body for body, link in self._robot.bodies_touched() if not self._robot.is_finger(link)}
        met = {body for body in met if self._world.category_of(body) not in HARMLESS}
        return met - self._gripped() if met else met

    def _count_collisions(self) -> None:
        """Count each new contact since the last time."""
        fresh = sorted(self._met - self._colliding)
        self._collisions += len(fresh)
        self._touched += [self._world.id_of(body) or self._world.category_of(body) or "" for body in fresh]
        self._colliding = frozenset(self._met)
        self._met.clear()
