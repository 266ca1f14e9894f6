"""Doubles for tests: a body that moves perfectly, obstacles it can hit, and a rehearsal that ticks actions on both.

Nothing here knows dynamics; a base command is carried out within the acceleration limits, an arm target at constant
speed.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import copysign

import numpy as np
from py_trees.common import Status

from scene_graph.edges import InEdge, RtEdge
from scene_graph.edits import PutEdge, RemoveEdge
from scene_graph.geometry.se3 import SE3
from scene_graph.memory import WorkingMemory
from scene_graph.nodes import ROBOT_ID
from skills.action import Action, RobotContext
from skills.arm.kinematics import gripper_pose
from skills.arm.settings import ArmSettings
from skills.failures import Failure
from skills.geometry import Box2, Points, Pose2
from skills.ports import ArmGeometry, ArmTarget, BodyLimits, BodyState

ARM_SPEED = 0.4
FINGER_MPS = 0.1
CAMERA_RADPS = 2.0


@dataclass(kw_only=True)
class FakeBody:
    """A kinematic body (``BodyPort``). ``grasped_width_m`` says what is between the fingers; ``None`` closes on
    nothing.
    """

    pose: Pose2 = field(default_factory=lambda: Pose2(0.0, 0.0))
    limits: BodyLimits = field(default_factory=BodyLimits)
    geometry: ArmGeometry = field(default_factory=ArmGeometry)
    grasped_width_m: Callable[[FakeBody], float | None] = lambda _: None
    stamp_s: float = 0.0
    velocity: tuple[float, float] = (0.0, 0.0)
    arm: ArmTarget = field(default_factory=lambda: ArmSettings().stowed)
    opening_m: float = 0.0
    camera: tuple[float, float] = (0.0, 0.0)
    stopped: bool = False
    _drive: tuple[float, float] = (0.0, 0.0)
    _drive_s: float = -1.0
    _arm: ArmTarget | None = None
    _opening_m: float = 0.0
    _camera: tuple[float, float] = (0.0, 0.0)

    async def state(self) -> BodyState:
        """As measured, without noise."""
        width_m = self.grasped_width_m(self)
        touching = width_m is not None and self.opening_m <= width_m + 1e-6
        return BodyState(
            stamp_s=self.stamp_s,
            linear_mps=self.velocity[0],
            angular_radps=self.velocity[1],
            arm=self.arm,
            gripper_opening_m=self.opening_m,
            finger_contacts=(touching, touching),
            pan_rad=self.camera[0],
            tilt_rad=self.camera[1],
            bumped=False,
            stopped=self.stopped,
            T_base_gripper=gripper_pose(self.arm, self.geometry),
        )

    async def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Take a base velocity."""
        self._drive, self._drive_s = (linear_mps, angular_radps), self.stamp_s

    async def look(self, pan_rad: float, tilt_rad: float) -> None:
        """Take a camera direction."""
        self._camera = (pan_rad, tilt_rad)

    async def move_arm(self, target: ArmTarget) -> None:
        """Take an arm target."""
        self._arm = target

    async def grip(self, opening_m: float, effort_n: float = 15.0) -> None:
        """Take a finger opening."""
        del effort_n
        self._opening_m = opening_m

    def stop(self) -> None:
        """Latch the stop."""
        self.stopped = True

    def release_stop(self) -> None:
        """Lift the stop."""
        self.stopped = False

    def advance(self, dt_s: float) -> None:
        """Move everything by one time step."""
        self.stamp_s += dt_s
        lapsed = self.stopped or self.stamp_s - self._drive_s > self.limits.command_timeout_s
        linear, angular = (0.0, 0.0) if lapsed else self._drive
        linear = _toward(self.velocity[0], _clip(linear, self.limits.linear_mps), self.limits.linear_mps2 * dt_s)
        angular = _toward(
            self.velocity[1], _clip(angular, self.limits.angular_radps), self.limits.angular_radps2 * dt_s
        )
        self.velocity = (linear, angular)
        self.pose = self.pose.advanced(linear * dt_s, angular * dt_s)
        if not self.stopped:
            self._advance_joints(dt_s)

    def _advance_joints(self, dt_s: float) -> None:
        step = ARM_SPEED * dt_s
        if self._arm is not None:
            self.arm = ArmTarget(
                lift_m=_toward(self.arm.lift_m, self._arm.lift_m, step),
                extension_m=_toward(self.arm.extension_m, self._arm.extension_m, step),
                wrist_pitch_rad=_toward(self.arm.wrist_pitch_rad, self._arm.wrist_pitch_rad, 4 * step),
                wrist_roll_rad=_toward(self.arm.wrist_roll_rad, self._arm.wrist_roll_rad, 4 * step),
            )
        pan, tilt = (_toward(a, b, CAMERA_RADPS * dt_s) for a, b in zip(self.camera, self._camera, strict=True))
        self.camera = (pan, tilt)
        self.opening_m = _toward(self.opening_m, self._opening_m, FINGER_MPS * dt_s)
        width_m = self.grasped_width_m(self)
        if width_m is not None and self._opening_m < width_m:
            self.opening_m = max(self.opening_m, width_m)


@dataclass(frozen=True, kw_only=True)
class BoxWorld:
    """Boxes that stand around, in the frame of the body's pose; all of them are seen from everywhere."""

    boxes: tuple[Box2, ...] = ()
    heights_m: tuple[float, ...] = (0.3, 0.6, 1.2)
    range_m: float = 4.0

    @cached_property
    def outline(self) -> Points:
        """Points (N, 2) on the outlines, about 3 cm apart."""
        sides = [side for box in self.boxes for side in _sides(box)]
        return np.concatenate([np.linspace(a, b, max(int(np.hypot(*(b - a)) / 0.03), 2)) for a, b in sides])

    def points_base(self, pose: Pose2) -> Points:
        """Points (N, 3) on the outlines in range, base frame."""
        points = pose.inverse_apply(self.outline) if self.boxes else np.zeros((0, 2))
        points = points[np.hypot(*points.T) < self.range_m]
        return np.concatenate([np.column_stack([points, np.full(len(points), z)]) for z in self.heights_m])

    def clearance_m(self, pose: Pose2) -> float:
        """Distance from the body's axis to the nearest box."""
        here = np.array([pose.point])
        return min((float(box.distance_m(here)[0]) for box in self.boxes), default=10.0)


@dataclass(kw_only=True)
class Rehearsal:
    """Runs actions with a ``FakeBody``; the graph is told the body's true pose, as a perfect localization would.

    ``frame``: the node in whose frame the body moves. ``observe`` is called every tick, to play perception.
    """

    memory: WorkingMemory
    body: FakeBody = field(default_factory=FakeBody)
    world: BoxWorld = field(default_factory=BoxWorld)
    frame: str = "room_1"
    observe: Callable[[Rehearsal], None] = lambda _: None
    dt_s: float = 0.05
    least_clearance_m: float = 10.0
    context: RobotContext | None = None

    async def prepare(self) -> RobotContext:
        """A context in step with the body."""
        self._localize()
        if self.context is None:
            state = await self.body.state()
            limits, geometry = self.body.limits, self.body.geometry
            self.context = RobotContext(memory=self.memory, limits=limits, geometry=geometry, body=state)
        self.context.body, self.context.stamp_s = await self.body.state(), self.body.stamp_s
        self.context.obstacles_base = self.world.points_base(self.body.pose)
        return self.context

    async def run(self, actions: Sequence[Action], limit_s: float = 300.0) -> Failure | None:
        """Tick the actions one after the other until one fails or all are done; the failure, if any."""
        for action in actions:
            while True:
                context = await self.prepare()
                self.observe(self)
                action.tick_once()
                await context.commands.flush(self.body)
                self.body.advance(self.dt_s)
                self.least_clearance_m = min(self.least_clearance_m, self.world.clearance_m(self.body.pose))
                if action.status is Status.FAILURE:
                    return action.failure
                if action.status is Status.SUCCESS:
                    break
                if self.body.stamp_s > limit_s:
                    raise TimeoutError(f"{action.name} was still running after {limit_s} s")
        return None

    def _localize(self) -> None:
        snapshot = self.memory.snapshot()
        pose = self.body.pose
        T_frame_robot = SE3.from_xyz_yaw(pose.x_m, pose.y_m, 0.0, pose.yaw_rad)
        old = snapshot.parent(ROBOT_ID)
        edits: list[PutEdge | RemoveEdge] = []
        if old is not None and old.source != self.frame:
            edits.append(RemoveEdge(old.key))
        rt = RtEdge(source=self.frame, target=ROBOT_ID, T_source_target=T_frame_robot, stamp_s=self.body.stamp_s)
        edits.append(PutEdge(rt))
        if snapshot.current_room is None and self.frame.startswith("room"):
            edits.append(PutEdge(InEdge(source=ROBOT_ID, target=self.frame)))
        self.memory.commit(edits, agent="rehearsal", stamp_s=self.body.stamp_s)


def _toward(value: float, goal: float, step: float) -> float:
    return goal if abs(goal - value) <= step else value + copysign(step, goal - value)


def _clip(value: float, limit: float) -> float:
    return min(max(value, -limit), limit)


def _sides(box: Box2) -> list[tuple[Points, Points]]:
    corners = box.corners()
    return list(zip(corners, np.roll(corners, -1, axis=0), strict=True))
