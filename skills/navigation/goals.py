"""Where the base may end: goals that are worked out anew at every replan, so they survive changes of the frame."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import ObjectNode
from scene_graph.snapshot import Snapshot
from skills.action import RobotContext
from skills.geometry import Box2, Points, Pose2
from skills.navigation.plan import Goal, GoalSource
from skills.navigation.pose import planar_pose, robot_frame
from skills.navigation.route import Routes
from skills.navigation.settings import GoalSettings
from skills.obstacles.sight import hidden_share


def at_poses(context: RobotContext, node_id: str, poses: Sequence[tuple[float, float, float | None]]) -> GoalSource:
    """Poses (x, y, yaw or ``None``) in the frame of ``node_id``, the first preferred."""

    def goals(routes: Routes | None) -> list[Goal]:
        del routes
        pose = _planar(context, node_id)
        found = []
        for rank, (x_m, y_m, yaw_rad) in enumerate(poses):
            point = pose.apply(np.array([[x_m, y_m]]))[0]
            yaw = None if yaw_rad is None else pose.yaw_rad + yaw_rad
            found.append(Goal(point=(float(point[0]), float(point[1])), yaw_rad=yaw, cost_m=0.5 * rank))
        return found

    return goals


def near_origin(context: RobotContext, node_id: str, radius_m: float = 1.2) -> GoalSource:
    """The origin of ``node_id``, or the free spot nearest to it within ``radius_m``; any heading."""
    spots: list[tuple[float, float]] = [(0.0, 0.0)]
    for ring_m in np.arange(0.3, radius_m + 1e-6, 0.3):
        spots += [(ring_m * cos(a), ring_m * sin(a)) for a in np.arange(0.0, 2 * pi, pi / 6)]

    def goals(routes: Routes | None) -> list[Goal]:
        del routes
        pose = _planar(context, node_id)
        points = pose.apply(np.array(spots))
        costs = 4.0 * np.hypot(*np.array(spots).T)
        return [Goal(point=(float(x), float(y)), cost_m=float(c)) for (x, y), c in zip(points, costs, strict=True)]

    return goals


def freest(context: RobotContext, reach_m: float = 2.5) -> GoalSource:
    """Spots within ``reach_m`` of where the robot is now, those farthest from everything preferred; needs no map."""
    steps = np.arange(-reach_m, reach_m + 1e-6, 2 * context.settings.navigation.goals.spacing_m)
    spots = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    points = spots + planar_pose(context, robot_frame(context.snapshot)).point

    def goals(routes: Routes | None) -> list[Goal]:
        clearance_m = np.zeros(len(points)) if routes is None else routes.grid.clearance_at(points)
        costs = 10.0 * (reach_m - np.minimum(clearance_m, reach_m))
        return [Goal(point=(float(x), float(y)), cost_m=float(c)) for (x, y), c in zip(points, costs, strict=True)]

    return goals


def around(context: RobotContext, node_id: str, standoff_m: float) -> GoalSource:
    """Places from which to face ``node_id``, its footprint ``standoff_m`` or a little more from the base's axis."""

    def goals(routes: Routes | None) -> list[Goal]:
        del routes
        settings = context.settings.navigation.goals
        return _facing(_footprint(context, node_id), standoff_m, settings.near_m, settings)

    return goals


def overlooking(
    context: RobotContext,
    node_id: str,
    standoff_m: float,
    *,
    side_rad: float | None = None,
    things: Sequence[str] = (),
) -> GoalSource:
    """The same, those preferred from which all of it can be seen, or else ``things`` there, and is near, and on the
    side ``side_rad``, a direction in its own frame; places farther away for what cannot be come near to.
    """
    of_revision: tuple[int, list[Goal]] = (-1, [])

    def goals(routes: Routes | None) -> list[Goal]:
        del routes
        nonlocal of_revision  # one plan asks several times
        if of_revision[0] != context.snapshot.revision:
            of_revision = context.snapshot.revision, _overlooking(context, node_id, standoff_m, side_rad, things)
        return of_revision[1]

    return goals


def _overlooking(
    context: RobotContext, node_id: str, standoff_m: float, side_rad: float | None, things: Sequence[str]
) -> list[Goal]:
    box, settings = _footprint(context, node_id), context.settings.navigation.goals
    afar = _facing(box, standoff_m, settings.far_m, settings)
    afar = [replace(goal, cost_m=goal.cost_m + settings.last_resort_m) for goal in afar]
    found = [*_facing(box, standoff_m, settings.near_m, settings), *afar]
    hidden = _hidden(context, node_id, np.array([goal.point for goal in found]), things)
    return [
        replace(goal, cost_m=goal.cost_m + askew_m + settings.hidden_m * share)
        for goal, share in zip(found, hidden.tolist(), strict=True)
        for askew_m in (_askew_m(box, goal.point, side_rad, settings.other_side_m),)
    ]


def _hidden(context: RobotContext, node_id: str, places: Points, things: Sequence[str]) -> NDArray[np.float64]:
    """Share of the top of a node, or of ``things``, that cannot be seen from each of (N, 2) places, (N,). What else is
    on the node hides only other things.
    """
    snapshot = context.snapshot
    frame = robot_frame(snapshot)
    things = [thing for thing in things if thing in snapshot]
    if things:
        targets, spared = np.array([snapshot.position(thing, frame) for thing in things]), {node_id, *things}
    else:
        targets = _top(context, node_id)
        spared = {node_id, *(node.id for node in snapshot.of_type(ObjectNode) if _is_on(snapshot, node.id, node_id))}
    height_m = context.geometry.camera_height_m
    return hidden_share(snapshot, frame, places, targets, camera_height_m=height_m, spared=spared)


def _is_on(snapshot: Snapshot, thing: str, node_id: str) -> bool:
    return snapshot.support_of(thing) == node_id


def _top(context: RobotContext, node_id: str) -> Points:
    """Points (9, 3) spread over the top of a node, in the robot's frame."""
    node, snapshot = context.snapshot.get(node_id), context.snapshot
    height_m = node.size_m[2] / 2.0 if isinstance(node, ObjectNode) else 0.0
    box = _footprint(context, node_id)
    across, along = np.meshgrid((-0.4, 0.0, 0.4), (-0.4, 0.0, 0.4))
    xy = box.pose.apply(np.stack((across.ravel() * box.size_x_m, along.ravel() * box.size_y_m), axis=1))
    top_m = snapshot.position(node_id, robot_frame(snapshot))[2] + height_m
    return np.column_stack((xy, np.full(len(xy), top_m)))


def _facing(box: Box2, standoff_m: float, extras_m: Sequence[float], settings: GoalSettings) -> list[Goal]:
    """Goals on curves around a rectangle, ``standoff_m`` and ``extras_m`` away, the nearer ones preferred."""
    found = []
    for extra_m in extras_m:
        for x_m, y_m in _outline(box, standoff_m + extra_m, settings.spacing_m):
            yaw = Pose2(x_m, y_m).bearing_rad(box.pose.point)
            found.append(Goal(point=(x_m, y_m), yaw_rad=yaw, cost_m=3.0 * extra_m))
    return found


def _askew_m(box: Box2, point: tuple[float, float], side_rad: float | None, other_side_m: float) -> float:
    """As how many meters of way it counts that a corner is far from ``point``, and that it lies on another side."""
    far_m = float(np.hypot(*(box.corners() - point).T).max())
    if side_rad is None:
        return far_m
    off_rad = box.pose.bearing_rad(point) - box.pose.yaw_rad - side_rad
    return far_m + other_side_m * (1.0 - cos(off_rad)) / 2.0


def _outline(box: Box2, distance_m: float, spacing_m: float) -> list[tuple[float, float]]:
    """Points on the curve at ``distance_m`` around a rectangle, about ``spacing_m`` apart."""
    half_x, half_y = box.size_x_m / 2, box.size_y_m / 2
    local: list[tuple[float, float]] = []
    for sign in (1.0, -1.0):
        local += [(x, sign * (half_y + distance_m)) for x in _spread(half_x, spacing_m)]
        local += [(sign * (half_x + distance_m), y) for y in _spread(half_y, spacing_m)]
        for other in (1.0, -1.0):
            for angle in (pi / 6, pi / 3):
                local.append((sign * (half_x + distance_m * cos(angle)), other * (half_y + distance_m * sin(angle))))
    return [(float(x), float(y)) for x, y in box.pose.apply(np.array(local))]


def _spread(half_m: float, spacing_m: float) -> list[float]:
    count = max(int(2 * half_m / spacing_m), 0)
    return [float(value) for value in np.linspace(-half_m, half_m, count + 1)] if count else [0.0]


def _footprint(context: RobotContext, node_id: str) -> Box2:
    node = context.snapshot.get(node_id)
    person_m = context.settings.navigation.goals.person_size_m
    size = node.size_m if isinstance(node, ObjectNode) else (person_m, person_m, 0.0)
    return Box2(_planar(context, node_id), size[0], size[1])


def _planar(context: RobotContext, node_id: str) -> Pose2:
    snapshot = context.snapshot
    pose: SE3 = snapshot.transform(robot_frame(snapshot), node_id)
    return Pose2.of(pose)
