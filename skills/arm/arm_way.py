"""What lies on the way of the hand from where the robot may stand to what it reaches for: things, furniture, people."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ObjectNode, ObjectState, PersonNode
from scene_graph.snapshot import Snapshot
from skills.action import RobotContext
from skills.arm.barring import is_small_and_nameless
from skills.arm.settings import ReachSettings
from skills.furniture.furniture import Furniture
from skills.geometry import Point2, Points, Pose2
from skills.navigation.plan import map_of
from skills.navigation.pose import footprint_radius_m, in_base, robot_frame
from skills.navigation.route import Routes, find_routes
from skills.obstacles.local_map import footprint
from skills.obstacles.walls import Walls


def underside_of_held_m(context: RobotContext, z_m: float) -> float:
    """Height over which the hand passes with what it holds on its way to a spot at ``z_m``."""
    return z_m + context.settings.hand.hover_m - context.settings.reach.held_margin_m


def clear_over_m(context: RobotContext, x_m: float, *targets: str, held_radius_m: float = 0.0) -> float:
    """Height over the floor that the lowest part of the hand keeps on its way straight ahead to ``x_m``, so that it
    touches none of the small things there, nor does what it holds, which reaches ``held_radius_m`` to the sides; 0
    where there are none. ``targets``: as ``spared_nodes`` takes them.
    """
    snapshot, spared, highest_m = context.snapshot, spared_nodes(context.snapshot, *targets), 0.0
    settings = context.settings.reach
    wide_m = max(context.geometry.hand_half_width_m, held_radius_m + settings.beside_held_m)
    for node in snapshot.of_type(ObjectNode):
        here = node.state is ObjectState.PRESENT and snapshot.room_of(node.id) == robot_frame(snapshot)
        if not (here and node.graspable) or node.id in spared:
            continue
        center_x_m, y_m, z_m = in_base(context, node.id).translation_m
        half_m = max(node.size_m[:2]) / 2
        if abs(y_m) < wide_m + half_m and 0.0 < center_x_m < x_m + wide_m + half_m:
            highest_m = max(highest_m, z_m + node.size_m[2] / 2 + settings.clearance_m)
    return highest_m


def pushes_aside(
    context: RobotContext,
    target: Points,
    places: Points,
    spared: set[str],
    *,
    low_m: float,
    wide_m: float,
    short_m: float = 0.0,
) -> NDArray[np.bool_]:
    """From which of (N, 2) places what reaches straight to ``short_m`` before ``target`` meets a small thing of known
    name on its way: its underside is ``low_m`` over the floor, and it reaches ``wide_m`` to the sides.
    """
    snapshot, frame, settings = context.snapshot, robot_frame(context.snapshot), context.settings.reach
    met = np.zeros(len(places), np.bool_)
    way, farthest_m = _ways_straight(target, places, settings, short_m)
    for node in snapshot.of_type(ObjectNode):
        here = node.state is ObjectState.PRESENT and snapshot.room_of(node.id) == frame
        if not (here and node.graspable) or node.id in spared or is_small_and_nameless(node, context.hand):
            continue
        x_m, y_m, z_m = snapshot.position(node.id, frame)
        low = z_m + node.size_m[2] / 2 + settings.least_air_m < low_m or z_m + node.size_m[2] / 2 < target[2]
        if low or float(np.hypot(x_m - target[0], y_m - target[1])) > farthest_m + max(node.size_m[:2]) + wide_m:
            continue
        away_m = footprint(snapshot, node, frame).distance_m(way.reshape(-1, 2)).reshape(way.shape[:2])
        met |= away_m.min(axis=0) < wide_m + settings.beside_held_m
    return met


def spared_nodes(snapshot: Snapshot, *targets: str) -> set[str]:
    """Nodes that are no obstacle to the arm: the targets, what the first stands on, and what is held. A person is one
    even while something is handed to them.
    """
    support = snapshot.support_of(targets[0]) if isinstance(snapshot.get(targets[0]), ObjectNode) else None
    held = snapshot.robot.holding if snapshot.robot is not None else None
    things = (node_id for node_id in targets if not isinstance(snapshot.get(node_id), PersonNode))
    return {*things, *(node for node in (support, held) if node is not None)}


def passing_over(context: RobotContext, target: Points, low_m: float, points: Points, spared: set[str]) -> Points:
    """For each place, (N,), what it costs that things which reach up to ``low_m`` lie on the way of the hand from there
    straight to the target: small ones may be pushed, the less the better, furniture bars it, and so does a person who
    was there a while ago; no place will do from which the hand is sure to meet a wall or furniture, the back or the arm
    of the seat itself that it reaches for included, or comes near to a person who is there.
    """
    snapshot, frame, settings = context.snapshot, robot_frame(context.snapshot), context.settings.reach
    half_m = context.geometry.hand_half_width_m
    way, farthest_m = _ways_straight(target, points, settings)
    costs = np.where(_meets_wall(context, target, way), np.inf, 0.0)
    for node in snapshot.of_type(ObjectNode):
        if node.state is not ObjectState.PRESENT or snapshot.room_of(node.id) != frame:
            continue
        if node.id in spared:
            costs += _rim_costs(context, node, target, low_m, way)
            continue
        x_m, y_m, z_m = snapshot.position(node.id, frame)
        reach_m = float(np.hypot(x_m - target[0], y_m - target[1]))
        if z_m + node.size_m[2] / 2 < low_m or reach_m > farthest_m + max(node.size_m[:2]):
            continue
        away_m = footprint(snapshot, node, frame).distance_m(way.reshape(-1, 2)).reshape(way.shape[:2])
        nearest_m = away_m.min(axis=0)
        bars = not (node.graspable or is_small_and_nameless(node, context.hand))
        pushed_m = np.interp(nearest_m, (0.0, half_m), (settings.met_cost_m, settings.in_the_way_cost_m))
        costs += np.where(nearest_m < half_m, settings.barred_cost_m if bars else pushed_m, 0.0)
        if bars:
            costs += np.where(nearest_m < settings.surely_met_m, np.inf, 0.0)
    for person in snapshot.of_type(PersonNode):
        if person.id not in spared and snapshot.room_of(person.id) == frame:
            away_m = np.linalg.norm(way - snapshot.position(person.id, frame)[:2], axis=2)
            cost_m = (
                np.inf
                if context.stamp_s - person.last_seen_s < context.settings.obstacles.map.person_fresh_s
                else settings.barred_cost_m
            )
            costs += np.where(away_m.min(axis=0) < settings.person_clearance_m, cost_m, 0.0)
    return costs


def _ways_straight(
    target: Points, places: Points, settings: ReachSettings, short_m: float = 0.0
) -> tuple[Points, float]:
    """Points (S, N, 2) on the ways from ``short_m`` before the target straight to each of (N, 2) places, and how long
    the longest is.
    """
    away_m = np.hypot(*(places - target[:2]).T)
    farthest_m = float(away_m.max(initial=0.0))
    steps = max(int(farthest_m / settings.sample_m), 2)
    along = np.linspace(np.minimum(short_m / np.maximum(away_m, 1e-6), 1.0), 1.0, steps)
    return target[:2] + along[:, :, None] * (places - target[:2]), farthest_m


def _meets_wall(context: RobotContext, target: Points, way: Points) -> NDArray[np.bool_]:
    """On which of the ways (S, N, 2) to a target a wall stands before the target; (N,)."""
    walls, settings = (
        Walls.known(context.snapshot, robot_frame(context.snapshot), context.settings.obstacles.map).tree,
        context.settings.reach,
    )
    if walls is None or not way.size:
        return np.zeros(way.shape[1], np.bool_)
    near_m, _ = walls.query(way.reshape(-1, 2), distance_upper_bound=settings.at_wall_m)
    before = np.linalg.norm(way - target[:2], axis=2) > settings.at_target_m
    return np.asarray((np.isfinite(near_m.reshape(way.shape[:2])) & before).any(axis=0))


def _rim_costs(context: RobotContext, node: ObjectNode, target: Points, low_m: float, way: Points) -> Points:
    """(N,) what it costs that the hand, on its ways (S, N, 2) at ``low_m`` to a target on furniture, meets the back or
    an arm of that. To what lies close to one of them it had better come from the open side; along that one only where
    nothing else is left, and never nearer than the thing itself is.
    """
    costs, furniture, settings = np.zeros(way.shape[1]), Furniture.of(node), context.settings.reach
    T_frame_node = context.snapshot.transform(robot_frame(context.snapshot), node.id)
    pose = Pose2.of(T_frame_node)
    clear_m = context.geometry.hand_half_width_m + context.settings.approach.position_m
    before = np.linalg.norm(way - target[:2], axis=2) > settings.at_target_m
    (goal,) = pose.inverse_apply(target[None, :2])
    for rim in furniture.obstacles:
        if T_frame_node.z_m + rim.top_m > low_m:
            outline = furniture.outline_of(furniture.beside(rim, goal), pose)
            along_m = float(outline.distance_m(target[None, :2])[0]) - settings.along_m
            away_m = outline.distance_m(way.reshape(-1, 2)).reshape(way.shape[:2])
            nearest_m = np.where(before, away_m, np.inf).min(axis=0)
            barred_m = np.where(nearest_m < clear_m, settings.barred_cost_m, 0.0)
            costs += np.where(nearest_m < min(clear_m, along_m), np.inf, barred_m)
    return costs


def people_here(context: RobotContext, fresh_s: float | None = None) -> list[str]:
    """Who was seen so short a time ago in the robot's room."""
    snapshot, frame = context.snapshot, robot_frame(context.snapshot)
    fresh_s = context.settings.obstacles.map.person_fresh_s if fresh_s is None else fresh_s
    return [
        person.id
        for person in snapshot.of_type(PersonNode)
        if snapshot.room_of(person.id) == frame and context.stamp_s - person.last_seen_s < fresh_s
    ]


def nearest_to(snapshot: Snapshot, people: Sequence[str], target: Points, frame: str) -> str:
    """The one of them who stands nearest to a target (3,)."""
    return min(people, key=lambda person: float(np.hypot(*(snapshot.position(person, frame) - target)[:2])))


def routes_around(
    context: RobotContext, here: Point2, spots: Sequence[Point2], *, spared: Collection[str] = ()
) -> Routes:
    """The ways from ``here`` on a map that shows all the spots; ``spared``: people who are thought away."""
    snapshot, frame = context.snapshot, robot_frame(context.snapshot)
    hit, settings = context.surroundings.points(), context.settings.obstacles.map
    around_m = settings.person_radius_m + context.settings.reach.around_person_m
    for person in spared:
        hit = hit[np.hypot(*(hit - snapshot.position(person, frame)[:2]).T) > around_m]
    walls = Walls.of(snapshot, frame, settings)
    grid = map_of(context, frame, [here, *spots], walls, hit=hit, ignore=spared)
    return find_routes(grid, here, footprint_radius_m(context), context.settings.navigation.routes)
