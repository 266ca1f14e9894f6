"""Driving within a room, and turning on the spot."""

from __future__ import annotations

from collections.abc import Collection
from math import atan2, hypot

import numpy as np
from py_trees.common import Status

from scene_graph.nodes import ObjectNode, PersonNode
from skills.action import Action, RobotContext
from skills.anchor import AnchorSource, resolved
from skills.failures import FailureCode
from skills.geometry import Point2, Points
from skills.navigation.driver import Driver, Progress
from skills.navigation.plan import GoalSource
from skills.navigation.pose import robot_frame
from skills.navigation.pursuit import turn_rate
from skills.navigation.settings import DriverSettings
from skills.obstacles.local_map import footprint


class DriveTo(Action):
    """Drives to the cheapest of several goals in the robot's room; ``navigation.goals`` makes goal sources.

    Fails with WAY_BLOCKED or PERSON_IN_WAY when no way leads there or something stays in the way.
    """

    def __init__(
        self,
        context: RobotContext,
        target: str,
        goals: GoalSource,
        *,
        ignore: Collection[str] = (),
        settings: DriverSettings | None = None,
    ) -> None:
        super().__init__(f"drive to {target}", context)
        self.target = target
        self._goals, self._ignore, self._drive_settings = goals, ignore, settings
        self._driver = self.new_driver()

    def begin(self) -> None:
        """Say where to, and start planning."""
        self.timeout_s = 60.0
        self.context.announce(f"driving to {self.target}")
        self._driver = self.new_driver()

    def step(self) -> Status:
        """Drive on."""
        if self.target not in self.context.snapshot:
            return self.fail(FailureCode.SUPPORT_GONE, f"{self.target} is no longer on my map.")
        progress = self._driver.step()
        expected_s = self._driver.length_m / (0.5 * self.context.limits.linear_mps)
        self.timeout_s = max(self.timeout_s, 30.0 + 4.0 * expected_s)
        if progress is Progress.RUNNING:
            return Status.RUNNING
        if progress is Progress.ARRIVED:
            return Status.SUCCESS
        return self.blocked(self._driver.obstacle_ahead(), no_way=progress is Progress.NO_WAY)

    def terminate(self, new_status: Status) -> None:
        """Stand still, show no path."""
        super().terminate(new_status)
        self.context.path_room = ()

    def new_driver(self) -> Driver:
        """A fresh drive to the goals."""
        return Driver(self.context, self._goals, ignore=self._ignore, settings=self._drive_settings)

    def blocked(self, obstacle: Point2, *, no_way: bool) -> Status:
        """Fail, naming what is in the way as far as the graph knows it."""
        names = nodes_at(self.context, obstacle)
        where = f"obstacle at ({obstacle[0]:.2f}, {obstacle[1]:.2f}) m in {robot_frame(self.context.snapshot)}"
        persons = [name for name in names if isinstance(self.context.snapshot.get(name), PersonNode)]
        if persons:
            message = f"{persons[0]} stands in the way to {self.target}."
            return self.fail(FailureCode.PERSON_IN_WAY, message, (persons[0], self.target), where)
        what = "no free way leads" if no_way else "something blocks the way"
        by = f" near {names[0]}" if names else ""
        return self.fail(FailureCode.WAY_BLOCKED, f"{what} to {self.target}{by}.", (*names, self.target), where)


class TurnTo(Action):
    """Turns on the spot until the base faces a point; the arm reaches in that direction."""

    timeout_s = 20.0

    def __init__(self, context: RobotContext, target: str, where: AnchorSource, *, tolerance_rad: float = 0.02) -> None:
        super().__init__(f"turn to {target}", context)
        self._where, self._tolerance_rad = where, tolerance_rad

    def step(self) -> Status:
        """Turn on."""
        anchor = resolved(self._where)
        if anchor.node_id not in self.context.snapshot:
            return self.fail(FailureCode.OBJECT_GONE, f"{anchor.node_id} is no longer on my map.")
        x_m, y_m, _ = anchor.in_base(self.context)
        if hypot(x_m, y_m) < 0.05:
            return Status.SUCCESS
        error = atan2(y_m, x_m)
        if abs(error) < self._tolerance_rad:
            self.context.commands.drive = (0.0, 0.0)
            return Status.SUCCESS if abs(self.context.body.angular_radps) < 0.02 else Status.RUNNING
        self.context.commands.drive = (0.0, turn_rate(error, self.context.limits))
        return Status.RUNNING


def nodes_at(context: RobotContext, point: Point2, within_m: float = 0.35) -> list[str]:
    """Persons, then objects on the floor, whose footprint is near ``point`` of the robot's frame; nearest first."""
    snapshot = context.snapshot
    frame = robot_frame(snapshot)
    found: list[tuple[bool, float, str]] = []
    near_m = context.settings.navigation.driver.person_near_m
    for person in snapshot.of_type(PersonNode):
        x_m, y_m, _ = snapshot.position(person.id, frame)
        if (distance_m := hypot(x_m - point[0], y_m - point[1])) < near_m:
            found.append((False, distance_m, person.id))
    for node in snapshot.of_type(ObjectNode):
        if snapshot.room_of(node.id) == frame and snapshot.support_of(node.id) is None:
            distance_m = float(footprint(snapshot, node, frame).distance_m(_row(point))[0])
            if distance_m < within_m:
                found.append((True, distance_m, node.id))
    return [name for _, _, name in sorted(found)]


def _row(point: Point2) -> Points:
    return np.array([point], dtype=np.float64)
