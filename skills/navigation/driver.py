"""Drives the base to one of several goals in the robot's present frame: plan, follow, watch, replan."""

from __future__ import annotations

from collections.abc import Collection
from enum import Enum, auto

import numpy as np

from skills.action import RobotContext
from skills.geometry import Point2, Pose2, wrap_rad
from skills.navigation.advance import Advance
from skills.navigation.plan import Goal, GoalSource, Plan, make_plan
from skills.navigation.pose import look_around, planar_pose, robot_frame
from skills.navigation.pursuit import Pursuit, deviation_m, point_ahead, turn_rate
from skills.navigation.route import path_length_m
from skills.navigation.safety import admissible, retreat
from skills.navigation.settings import DriverSettings


class Progress(Enum):
    """How the drive goes."""

    RUNNING = auto()
    ARRIVED = auto()
    NO_WAY = auto()
    BLOCKED = auto()


class Driver:
    """One drive. Call ``step`` every tick; it leaves a drive command in the context."""

    def __init__(
        self,
        context: RobotContext,
        goals: GoalSource,
        *,
        ignore: Collection[str] = (),
        settings: DriverSettings | None = None,
    ) -> None:
        self._context, self._goals, self._ignore = context, goals, frozenset(ignore)
        self._settings = settings or context.settings.navigation.driver
        self._pursuit = Pursuit(context.limits, context.settings.navigation.pursuit)
        self._plan: Plan | None = None
        self._tried_s, self._advance = -np.inf, Advance(stamp_s=context.stamp_s, settings=self._settings)
        self._turning = False

    @property
    def goal(self) -> Goal | None:
        """The goal being driven to."""
        return self._plan.goal if self._plan is not None else None

    @property
    def length_m(self) -> float:
        """Length of the path being followed."""
        return path_length_m(self._plan.path) if self._plan is not None else 0.0

    def step(self) -> Progress:
        """One tick."""
        context = self._context
        look_around(context)
        frame = robot_frame(context.snapshot)
        pose = planar_pose(context, frame)
        plan = self._present_plan(frame, pose)
        if plan is None:
            context.commands.drive = (0.0, 0.0)
            return Progress.NO_WAY if self._waited_s > self._settings.no_way_s else Progress.RUNNING
        if self._turning or self._has_arrived(plan.goal, pose):
            self._turning = True
            return self._turn(plan.goal, pose)
        return self._follow(plan, pose)

    def obstacle_ahead(self) -> Point2:
        """The obstacle point nearest to the way ahead, in the robot's frame; what to name when blocked."""
        pose = planar_pose(self._context, robot_frame(self._context.snapshot))
        points = self._context.surroundings.points()
        ahead = point_ahead(self._plan.path, pose.point, 0.5)[0] if self._plan is not None else pose.point
        if not len(points):
            return ahead
        nearest = points[int(np.argmin(np.hypot(*(points - ahead).T)))]
        return float(nearest[0]), float(nearest[1])

    @property
    def _waited_s(self) -> float:
        return self._context.stamp_s - self._advance.stamp_s

    def _present_plan(self, frame: str, pose: Pose2) -> Plan | None:
        """The plan to follow now: the last one while it is fresh, else a new one; ``None`` when there is no way."""
        now_s, plan = self._context.stamp_s, self._plan
        if plan is not None and plan.frame == frame:
            astray = deviation_m(plan.path, pose.point) > self._settings.stray_m
            fresh_s = self._settings.retry_s if astray else self._settings.replan_s
            if self._turning or now_s - plan.made_s < fresh_s:
                return plan
        elif plan is None and now_s - self._tried_s < self._settings.retry_s:
            return None
        last = plan.goal if plan is not None and plan.frame == frame else None
        self._tried_s = now_s
        self._turning = False
        self._plan = make_plan(self._context, frame, pose, self._goals, last=last, ignore=self._ignore)
        self._context.path_room = self._plan.path if self._plan is not None else ()
        return self._plan

    def _has_arrived(self, goal: Goal, pose: Pose2) -> bool:
        distance_m = pose.distance_m(goal.point)
        passed = abs(wrap_rad(pose.bearing_rad(goal.point) - pose.yaw_rad)) > self._settings.passed_rad
        return distance_m < self._settings.position_m or (distance_m < 2 * self._settings.position_m and passed)

    def _follow(self, plan: Plan, pose: Pose2) -> Progress:
        context = self._context
        clearance_m = float(plan.grid.clearance_at(np.array([pose.point]))[0])
        wanted = self._pursuit.velocity(pose, plan.path, clearance_m, context.body.linear_mps)
        safety = context.settings.navigation.safety
        near = context.surroundings.points_near(pose.point, safety.far_m)
        obstacles_base = pose.inverse_apply(plan.walls.explain(near))
        linear, angular = admissible(*wanted, obstacles_base, plan.radius_m, context.limits, safety)
        if linear == 0.0 < wanted[0]:
            linear = retreat(obstacles_base, plan.radius_m, context.limits, safety)
        context.commands.drive = (linear, angular if linear >= 0.0 else 0.0)
        return self._judge(plan, pose)

    def _judge(self, plan: Plan, pose: Pose2) -> Progress:
        """Whether the drive advances; when it does not for long, give up."""
        _, remaining_m = point_ahead(plan.path, pose.point, 0.0)
        self._advance.note(remaining_m, self._context.stamp_s, turning=self._pursuit.turning)
        stuck = self._waited_s > self._settings.patience_s or self._advance.astray
        return Progress.BLOCKED if stuck else Progress.RUNNING

    def _turn(self, goal: Goal, pose: Pose2) -> Progress:
        """Turn in place to the goal's heading and come to rest."""
        context = self._context
        error = 0.0 if goal.yaw_rad is None else wrap_rad(goal.yaw_rad - pose.yaw_rad)
        if abs(error) < self._settings.yaw_rad:
            context.commands.drive = (0.0, 0.0)
            still = abs(context.body.angular_radps) < 0.05 and abs(context.body.linear_mps) < 0.02
            return Progress.ARRIVED if still else Progress.RUNNING
        context.commands.drive = (0.0, turn_rate(error, context.limits))
        return Progress.RUNNING
