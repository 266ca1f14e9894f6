"""Choosing where to stand to reach something, and driving there."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import replace
from math import atan2, cos, hypot, inf, pi

import numpy as np
from numpy.typing import NDArray
from py_trees.common import Status

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode
from skills.action import RobotContext
from skills.anchor import AnchorSource, resolved
from skills.arm.arm_way import (
    nearest_to,
    passing_over,
    people_here,
    pushes_aside,
    routes_around,
    spared_nodes,
    underside_of_held_m,
)
from skills.arm.grasping import can_grasp, can_grasp_level
from skills.arm.hand import DOWN_RAD
from skills.arm.level_hand import level_hand_barred
from skills.arm.roof import roof_over_m
from skills.arm.way_in import is_before
from skills.failures import FailureCode
from skills.furniture.standing import stand_below
from skills.geometry import Point2, Points
from skills.navigation.driving import DriveTo
from skills.navigation.plan import Goal
from skills.navigation.pose import planar_pose, robot_frame
from skills.navigation.route import Routes
from skills.outline import disc

Price = Callable[[Points], Points]
"""What each of (N, 2) places costs in meters of way, (N,)."""


def _nothing(places: Points) -> Points:
    return np.zeros(len(places))


class ApproachForReach(DriveTo):
    """Drives to a place from which the arm, reaching straight ahead, gets to a point; tries a few before UNREACHABLE.

    Places lie on rings around the point. Their cost is the way there, the distance from the best reach, little room
    around the base, and things that the arm would have to pass over.
    """

    def __init__(self, context: RobotContext, target: str, where: AnchorSource, *, price: Price | None = None) -> None:
        """``price``: what places in the robot's frame cost beside all this, infinite where they will not do at all;
        nothing by default.
        """
        super().__init__(
            context,
            target,
            self._goals_around,
            settings=replace(context.settings.navigation.driver, position_m=context.settings.approach.position_m),
        )
        self.name = f"approach {target}"
        self._where, self._price_m, self._settings = where, price or _nothing, context.settings.approach
        self._failed: list[Point2] = []

    def begin(self) -> None:
        """No place has failed yet."""
        self._failed = []
        super().begin()

    def step(self) -> Status:
        """Stay when the arm already reaches from here without passing over anything, else drive on."""
        least_m = self.context.settings.reach.in_the_way_cost_m
        if self.context.stamp_s == self.started_s and self._reaches_from_here(least_m):
            return Status.SUCCESS
        return super().step()

    def blocked(self, obstacle: Point2, *, no_way: bool) -> Status:
        """Try another place unless there was none or enough were tried."""
        goal = self._driver.goal
        if not no_way and goal is not None and len(self._failed) + 1 < self._settings.tries:
            self._failed.append(goal.point)
            self._driver = self.new_driver()
            return Status.RUNNING
        if not no_way:
            return super().blocked(obstacle, no_way=no_way)
        if self._reaches_from_here(self.context.settings.reach.barred_cost_m):
            return Status.SUCCESS
        if (person := self._who_bars()) is not None:
            message = f"{person} stands where I would have to be, or to reach, to get at {self.target}."
            return self.fail(FailureCode.PERSON_IN_WAY, message, (person, self.target))
        x_m, y_m, _ = resolved(self._where).position(self.context.snapshot, robot_frame(self.context.snapshot))
        message = f"there is no free place from which the arm reaches {self.target}."
        tried = len(self._reaches_m()) * self._settings.angles
        where = f"point ({x_m:.2f}, {y_m:.2f}) m, {tried} places tried"
        return self.fail(FailureCode.UNREACHABLE, message, (self.target,), where)

    def _who_bars(self) -> str | None:
        """The person without whom there would be a place: one of those who were just seen here."""
        context, people = self.context, people_here(self.context)
        if not people:
            return None
        frame = robot_frame(context.snapshot)
        target = resolved(self._where).position(context.snapshot, frame)
        here = planar_pose(context, frame).point
        routes = routes_around(context, here, [(float(target[0]), float(target[1]))], spared=people)
        goals = self._goals_around(routes, spared=people)
        free = goals and np.isfinite(routes.cost_at(np.array([goal.point for goal in goals]))).any()
        return nearest_to(context.snapshot, people, target, frame) if free else None

    def _goals_around(self, routes: Routes | None, *, spared: Collection[str] = ()) -> list[Goal]:
        """Places to stand; ``spared``: people who are thought away."""
        snapshot, settings = self.context.snapshot, self._settings
        frame = robot_frame(snapshot)
        target = resolved(self._where).position(snapshot, frame)
        points, radii = ring(target[:2], self._reaches_m(), settings.angles)
        if routes is None:
            return [Goal(point=(float(target[0]), float(target[1])))]
        costs = settings.radius_weight * np.abs(radii - settings.best_m)
        costs += np.where(radii > settings.easy_m + 1e-6, settings.stretch_cost_m, 0.0)
        costs += settings.clearance_weight * np.clip(settings.ample_m - routes.grid.clearance_at(points), 0.0, None)
        low_m = self._underside_m(float(target[2]))
        spared_here = self._spared() | set(spared)
        costs += passing_over(self.context, target, low_m, points, spared_here)
        bearings = np.arctan2(points[:, 1] - target[1], points[:, 0] - target[0])
        costs += np.where(self._stopped_lately(bearings), settings.stopped_cost_m, 0.0)
        fits = self._fits(points, target)
        costs += np.where(fits if fits.any() or self._fits_anywhere(target) else True, 0.0, np.inf)
        costs += self._price_m(points) + self._hanging_m(frame, points)
        costs += np.where(self._brings_back(frame, points), 0.0, np.inf)
        costs += np.where(self._faces_board(frame, points), 0.0, self.context.settings.reach.barred_cost_m)
        for failed in self._failed:
            costs += np.where(np.hypot(*(points - failed).T) < settings.failed_m, np.inf, 0.0)
        yaws = np.arctan2(target[1] - points[:, 1], target[0] - points[:, 0])
        return [
            Goal(point=(float(x), float(y)), yaw_rad=float(yaw), cost_m=float(cost))
            for (x, y), yaw, cost in zip(points, yaws, costs, strict=True)
            if np.isfinite(cost)
        ]

    def _reaches_from_here(self, most_m: float) -> bool:
        """Whether the arm gets there from here, and what is on its way costs less than that."""
        anchor = resolved(self._where)
        if anchor.node_id not in self.context.snapshot:
            return False
        x_m, y_m, _ = anchor.in_base(self.context)
        nearest_m, *_, farthest_m, _ = self._reaches_m()
        frame = robot_frame(self.context.snapshot)
        here = np.array([planar_pose(self.context, frame).point])
        target = anchor.position(self.context.snapshot, frame)
        fits = self._fits(here, target)[0] and self._brings_back(frame, here)[0]
        stopped = self._stopped_lately(np.arctan2(here[:, 1] - target[1], here[:, 0] - target[0]))[0]
        low_m = self._underside_m(float(target[2]))
        over_m = passing_over(self.context, target, low_m, here, self._spared())[0]
        over_m += self._price_m(here)[0] + self._hanging_m(frame, here)[0]
        faces = over_m < most_m and self._faces_board(frame, here)[0]
        return bool(nearest_m < float(np.hypot(x_m, y_m)) < farthest_m and fits and faces and not stopped)

    def _stopped_lately(self, bearings_rad: Points) -> NDArray[np.bool_]:
        """From which of (N,) sides the arm was stopped as it reached for the target a while ago."""
        node_id = resolved(self._where).node_id
        stopped = np.zeros(len(bearings_rad), np.bool_)
        for (name, bearing), since_s in self.context.blocked_reaches.items():
            if name == node_id and self.context.is_lately(since_s):
                stopped |= np.abs(np.angle(np.exp(1j * (bearings_rad - bearing)))) < self._settings.stopped_rad
        return stopped

    def _reaches_m(self) -> tuple[float, ...]:
        """Level with what the hand holds and with what it will grasp around its middle, else from above."""
        context, node = self.context, self._to_grasp()
        if context.grip is not None:
            return reaches_m(context, context.body.arm.wrist_pitch_rad)
        return reaches_m(context, 0.0 if node is not None and context.hand.is_tall(node.size_m) else DOWN_RAD)

    def _to_grasp(self) -> ObjectNode | None:
        """What the empty hand is to take hold of."""
        node = self.context.snapshot.get(resolved(self._where).node_id)
        if self.context.grip is None and isinstance(node, ObjectNode) and node.graspable:
            return node
        return None

    def _fits(self, points: Points, target: Points) -> NDArray[np.bool_]:
        """Which of (N, 2) places the hand can take hold from: from above or level, as it is turned towards there."""
        context, node = self.context, self._to_grasp()
        if node is None:
            return np.ones(len(points), np.bool_)
        frame = robot_frame(context.snapshot)
        yaw_rad = context.snapshot.transform(frame, node.id).yaw_rad
        hand = context.hand
        barred = level_hand_barred(context.snapshot, node.id, frame, points, hand)
        grasps = (
            can_grasp(
                node.size_m,
                SE3.from_xyz_yaw(hypot(dx, dy), 0.0, float(target[2]), yaw_rad - atan2(dy, dx)),
                hand,
                level_too=level_too,
            )
            for (dx, dy), level_too in zip((target[:2] - points).tolist(), (~barred).tolist(), strict=True)
        )
        return np.fromiter(grasps, np.bool_, len(points))

    def _fits_anywhere(self, target: Points, *, level_too: bool = True) -> bool:
        """Whether the hand could take hold of what stands so high, if nothing were in its way."""
        context, node = self.context, self._to_grasp()
        pose = SE3.from_xyz_yaw(self._settings.best_m, 0.0, float(target[2]), 0.0)
        return node is None or can_grasp(node.size_m, pose, context.hand, level_too=level_too)

    def _hanging_m(self, frame: str, points: Points) -> Points:
        """What it costs, (N,), that a tall thing can only be taken from above from (N, 2) places."""
        context, node = self.context, self._to_grasp()
        if node is None:
            return np.zeros(len(points))
        height_m = float(context.snapshot.position(node.id, frame)[2])
        pose = SE3.from_xyz_yaw(self._settings.best_m, 0.0, height_m, 0.0)
        if not context.hand.is_tall(node.size_m) or not can_grasp_level(node.size_m, pose, context.hand):
            return np.zeros(len(points))
        barred = level_hand_barred(context.snapshot, node.id, frame, points, context.hand)
        return np.where(barred, self._settings.from_above_cost_m, 0.0)

    def _brings_back(self, frame: str, points: Points) -> NDArray[np.bool_]:
        """From which of (N, 2) places what is taken from above is brought back over all that stands on the way, however
        low the lift ends.
        """
        context, node = self.context, self._to_grasp()
        if node is None or roof_over_m(context.snapshot, node.id, context.hand) < inf:
            return np.ones(len(points), np.bool_)
        snapshot, target = context.snapshot, context.snapshot.position(node.id, frame)
        if not self._fits_anywhere(target, level_too=False):
            return np.ones(len(points), np.bool_)
        meets = pushes_aside(
            context,
            target,
            points,
            self._spared(),
            low_m=context.hand.highest_underside_m(node.size_m),
            wide_m=disc(node.size_m).radius_m,
            short_m=self._settings.lifted_from_m,
        )
        return ~meets | (
            context.hand.is_tall(node.size_m) & ~level_hand_barred(snapshot, node.id, frame, points, context.hand)
        )

    def _faces_board(self, frame: str, places: Points) -> NDArray[np.bool_]:
        """From which of (N, 2) places the hand gets straight to a thing that stands below a board; else from all."""
        snapshot, node_id = self.context.snapshot, resolved(self._where).node_id
        stand = stand_below(snapshot, node_id) if self.context.grip is None else None
        if stand is None:
            return np.ones(len(places), np.bool_)
        return is_before(snapshot, stand.on, stand.point_m, places, frame, self.context.hand)

    def _underside_m(self, z_m: float) -> float:
        """Height over which the arm passes on its way to the target."""
        node = self.context.snapshot.get(resolved(self._where).node_id)
        if isinstance(node, ObjectNode) and node.graspable:
            return self.context.hand.underside_m(node.size_m, z_m)
        return underside_of_held_m(self.context, z_m)

    def _spared(self) -> set[str]:
        return spared_nodes(self.context.snapshot, self.target, resolved(self._where).node_id)


def reaches_m(context: RobotContext, pitch_rad: float) -> tuple[float, ...]:
    """How far before the base a hand with that pitch can be, in steps and with a little to spare."""
    settings, hand_m = context.settings.approach, context.geometry.hand_length_m * cos(pitch_rad)
    farthest_m = context.geometry.wrist_x_m + context.limits.extension_m[1] + hand_m - settings.spare_m
    steps = int((farthest_m - settings.nearest_m) / settings.radius_step_m + 1e-6)
    return tuple(settings.nearest_m + settings.radius_step_m * i for i in range(steps + 1))


def ring(center: Points, radii_m: Sequence[float], angles: int) -> tuple[Points, Points]:
    """Points (N, 2) on rings around ``center`` (2,), and their radii (N,)."""
    radius, angle = np.meshgrid(np.array(radii_m), np.arange(angles) * 2 * pi / angles, indexing="ij")
    offsets = np.stack([radius.ravel() * np.cos(angle.ravel()), radius.ravel() * np.sin(angle.ravel())], axis=1)
    return center + offsets, radius.ravel()
