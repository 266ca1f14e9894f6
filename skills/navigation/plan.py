"""One plan of a drive: the goal chosen among several, the path to it, and the grid it was found on."""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass

import numpy as np

from skills.action import RobotContext
from skills.geometry import Point2, Points, Pose2
from skills.navigation.pose import footprint_radius_m
from skills.navigation.route import Routes, find_routes
from skills.navigation.settings import PlanSettings
from skills.obstacles.grid import Grid
from skills.obstacles.local_map import draw_map
from skills.obstacles.walls import Walls


@dataclass(frozen=True, kw_only=True)
class Goal:
    """Where the base may end: a point of the robot's frame, perhaps a heading, and what choosing it costs extra."""

    point: Point2
    yaw_rad: float | None = None
    cost_m: float = 0.0


GoalSource = Callable[[Routes | None], Sequence[Goal]]
"""Gives the goals in the robot's present frame.

It is asked again at every replan: first with ``None``, for the extent of the map, then with the routes found on it.
"""


@dataclass(frozen=True, kw_only=True, eq=False)
class Plan:
    """Way points in ``frame`` from where the robot was at ``made_s`` to ``goal``, for a disc of ``radius_m``."""

    frame: str
    made_s: float
    goal: Goal
    path: tuple[Point2, ...]
    grid: Grid
    walls: Walls
    radius_m: float


def make_plan(
    context: RobotContext, frame: str, pose: Pose2, goals: GoalSource, *, last: Goal | None, ignore: Collection[str]
) -> Plan | None:
    """The cheapest goal and the way there.

    First with what the graph believes and with room for what the hand holds; then for the base alone, as most of what
    stands around is lower than the hand; then with raw points, and of the graph only what they would not show; at last
    with hardly any room to spare.
    """
    spots = [pose.point, *(goal.point for goal in goals(None))]
    settings = context.settings.navigation
    walls = Walls.of(context.snapshot, frame, context.settings.obstacles.map)
    carrying_m, base_m = footprint_radius_m(context), context.limits.footprint_radius_m
    bare_m = base_m - settings.plan.squeeze_m
    tries = dict.fromkeys([(True, carrying_m), (True, base_m), (False, base_m), (True, bare_m), (False, bare_m)])
    for believe_furniture, radius_m in tries:
        grid = map_of(context, frame, spots, walls, believe_furniture=believe_furniture, ignore=ignore)
        routes = find_routes(grid, pose.point, radius_m, settings.routes)
        goal = _cheapest(routes, goals(routes), last, settings.plan)
        if goal is not None and (path := routes.path_to(goal.point)):
            return Plan(
                frame=frame,
                made_s=context.stamp_s,
                goal=goal,
                path=path,
                grid=grid,
                walls=walls,
                radius_m=radius_m,
            )
    return None


def map_of(
    context: RobotContext,
    frame: str,
    spots: Sequence[Point2],
    walls: Walls,
    *,
    hit: Points | None = None,
    believe_furniture: bool = True,
    ignore: Collection[str] = (),
) -> Grid:
    """The map that holds all ``spots``, the robot first; ``hit``: what was hit lately, if not all of it counts."""
    return draw_map(
        context.snapshot,
        frame,
        context.surroundings.points() if hit is None else hit,
        spots,
        walls=walls,
        stamp_s=context.stamp_s,
        believe_furniture=believe_furniture,
        ignore=ignore,
        geometry=context.geometry,
        settings=context.settings.obstacles.map,
    )


def _cheapest(routes: Routes, goals: Sequence[Goal], last: Goal | None, settings: PlanSettings) -> Goal | None:
    if not goals:
        return None
    points = np.array([goal.point for goal in goals])
    costs = routes.cost_at(points) + [goal.cost_m for goal in goals]
    if last is not None:
        same = np.hypot(*(points - last.point).T) < settings.same_goal_m
        costs -= np.where(same, settings.keep_goal_m, 0.0)
    best = int(np.argmin(costs))
    return goals[best] if np.isfinite(costs[best]) else None
