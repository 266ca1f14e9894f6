"""What lies on the way of the hand from where the robot may stand to what it reaches for: things, furniture, people."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ObjectNode, ObjectState, PersonNode
from scene_graph.snapshot import Snapshot
from skills.action import RobotContext
from skills.arm.barring import is_small_and_nameless
from skills.arm.grasping import HOVER_M
from skills.furniture.seats import rims
from skills.geometry import Point2, Points, Pose2
from skills.navigation.local_map import PERSON_FRESH_S, PERSON_RADIUS_M, draw_map, footprint
from skills.navigation.pose import footprint_radius_m, in_base, robot_frame
from skills.navigation.route import Routes, find_routes
from skills.navigation.walls import Walls

IN_THE_WAY_COST_M, MET_COST_M = 3.0, 12.0
"""What it costs that the arm just touches a small thing, and that it goes straight through the middle of one."""
BARRED_COST_M = 20.0
"""More than any other: the arm would meet furniture that is higher than the hand, or the end of a shelf."""
SAMPLE_M = 0.06
"""How finely the arm's way is looked at."""
ARM_HALF_WIDTH_M = 0.09
SURELY_MET_M = 0.06
"""So near to the middle of its way, the hand meets what is higher, however well that was measured."""
AT_TARGET_M, ALONG_M = 0.12, 0.01
AT_WALL_M = 0.04
"""What comes so near to the line of a wall, between two samples, may be beyond it with the next."""
HELD_MARGIN_M = 0.06
PERSON_CLEARANCE_M, DRIFT_M = 0.32, 0.04
"""So far from the middle of a person the middle of the arm keeps, from a place that is as far off as a drive may be."""
BESIDE_HELD_M = 0.02
LEAST_AIR_M = 0.01
"""Without so much air above a small thing, what is carried over it meets it."""
CLEARANCE_M = 0.04
"""Air between the finger tips, or what they hold, and what the hand passes over."""
AROUND_PERSON_M = PERSON_RADIUS_M + 0.1
"""What is hit so near to where somebody stands is taken for them."""


def underside_of_held_m(z_m: float) -> float:
    """Height over which the hand passes with what it holds on its way to a spot at ``z_m``."""
    return z_m + HOVER_M - HELD_MARGIN_M


def clear_over_m(context: RobotContext, x_m: float, *targets: str, held_radius_m: float = 0.0) -> float:
    """Height over the floor that the lowest part of the hand keeps on its way straight ahead to ``x_m``, so that it
    touches none of the small things there, nor does what it holds, which reaches ``held_radius_m`` to the sides; 0
    where there are none. ``targets``: as ``spared_nodes`` takes them.
    """
    snapshot, spared, highest_m = context.snapshot, spared_nodes(context.snapshot, *targets), 0.0
    wide_m = max(ARM_HALF_WIDTH_M, held_radius_m + BESIDE_HELD_M)
    for node in snapshot.of_type(ObjectNode):
        here = node.state is ObjectState.PRESENT and snapshot.room_of(node.id) == robot_frame(snapshot)
        if not (here and node.graspable) or node.id in spared:
            continue
        center_x_m, y_m, z_m = in_base(context, node.id).translation_m
        half_m = max(node.size_m[:2]) / 2
        if abs(y_m) < wide_m + half_m and 0.0 < center_x_m < x_m + wide_m + half_m:
            highest_m = max(highest_m, z_m + node.size_m[2] / 2 + CLEARANCE_M)
    return highest_m


def pushes_aside(
    snapshot: Snapshot,
    frame: str,
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
    met = np.zeros(len(places), np.bool_)
    way, farthest_m = _ways_straight(target, places, short_m)
    for node in snapshot.of_type(ObjectNode):
        here = node.state is ObjectState.PRESENT and snapshot.room_of(node.id) == frame
        if not (here and node.graspable) or node.id in spared or is_small_and_nameless(node):
            continue
        x_m, y_m, z_m = snapshot.position(node.id, frame)
        low = z_m + node.size_m[2] / 2 + LEAST_AIR_M < low_m or z_m + node.size_m[2] / 2 < target[2]
        if low or float(np.hypot(x_m - target[0], y_m - target[1])) > farthest_m + max(node.size_m[:2]) + wide_m:
            continue
        away_m = footprint(snapshot, node, frame).distance_m(way.reshape(-1, 2)).reshape(way.shape[:2])
        met |= away_m.min(axis=0) < wide_m + BESIDE_HELD_M
    return met


def spared_nodes(snapshot: Snapshot, *targets: str) -> set[str]:
    """Nodes that are no obstacle to the arm: the targets, what the first stands on, and what is held. A person is one
    even while something is handed to them.
    """
    support = snapshot.support_of(targets[0]) if isinstance(snapshot.get(targets[0]), ObjectNode) else None
    held = snapshot.robot.holding if snapshot.robot is not None else None
    things = (node_id for node_id in targets if not isinstance(snapshot.get(node_id), PersonNode))
    return {*things, *(node for node in (support, held) if node is not None)}


def passing_over(
    snapshot: Snapshot, frame: str, target: Points, low_m: float, points: Points, spared: set[str], *, stamp_s: float
) -> Points:
    """For each place, (N,), what it costs that things which reach up to ``low_m`` lie on the way of the hand from there
    straight to the target: small ones may be pushed, the less the better, furniture bars it, and so does a person who
    was there a while ago; no place will do from which the hand is sure to meet a wall or furniture, the back or the arm
    of the seat itself that it reaches for included, or comes near to a person who is there.
    """
    way, farthest_m = _ways_straight(target, points)
    costs = np.where(_meets_wall(snapshot, frame, target, way), np.inf, 0.0)
    for node in snapshot.of_type(ObjectNode):
        if node.state is not ObjectState.PRESENT or snapshot.room_of(node.id) != frame:
            continue
        if node.id in spared:
            costs += _rim_costs(snapshot, frame, node, target, low_m, way)
            continue
        x_m, y_m, z_m = snapshot.position(node.id, frame)
        reach_m = float(np.hypot(x_m - target[0], y_m - target[1]))
        if z_m + node.size_m[2] / 2 < low_m or reach_m > farthest_m + max(node.size_m[:2]):
            continue
        away_m = footprint(snapshot, node, frame).distance_m(way.reshape(-1, 2)).reshape(way.shape[:2])
        nearest_m = away_m.min(axis=0)
        bars = not (node.graspable or is_small_and_nameless(node))
        cost_m = (
            BARRED_COST_M if bars else np.interp(nearest_m, (0.0, ARM_HALF_WIDTH_M), (MET_COST_M, IN_THE_WAY_COST_M))
        )
        costs += np.where(nearest_m < ARM_HALF_WIDTH_M, cost_m, 0.0)
        if bars:
            costs += np.where(nearest_m < SURELY_MET_M, np.inf, 0.0)
    for person in snapshot.of_type(PersonNode):
        if person.id not in spared and snapshot.room_of(person.id) == frame:
            away_m = np.linalg.norm(way - snapshot.position(person.id, frame)[:2], axis=2)
            cost_m = np.inf if stamp_s - person.last_seen_s < PERSON_FRESH_S else BARRED_COST_M
            costs += np.where(away_m.min(axis=0) < PERSON_CLEARANCE_M, cost_m, 0.0)
    return costs


def _ways_straight(target: Points, places: Points, short_m: float = 0.0) -> tuple[Points, float]:
    """Points (S, N, 2) on the ways from ``short_m`` before the target straight to each of (N, 2) places, and how long
    the longest is.
    """
    away_m = np.hypot(*(places - target[:2]).T)
    farthest_m = float(away_m.max(initial=0.0))
    along = np.linspace(np.minimum(short_m / np.maximum(away_m, 1e-6), 1.0), 1.0, max(int(farthest_m / SAMPLE_M), 2))
    return target[:2] + along[:, :, None] * (places - target[:2]), farthest_m


def _meets_wall(snapshot: Snapshot, frame: str, target: Points, way: Points) -> NDArray[np.bool_]:
    """On which of the ways (S, N, 2) to a target a wall stands before the target; (N,)."""
    walls = Walls.of(snapshot, frame).tree
    if walls is None or not way.size:
        return np.zeros(way.shape[1], np.bool_)
    near_m, _ = walls.query(way.reshape(-1, 2), distance_upper_bound=AT_WALL_M)
    before = np.linalg.norm(way - target[:2], axis=2) > AT_TARGET_M
    return np.asarray((np.isfinite(near_m.reshape(way.shape[:2])) & before).any(axis=0))


def _rim_costs(snapshot: Snapshot, frame: str, seat: ObjectNode, target: Points, low_m: float, way: Points) -> Points:
    """(N,) what it costs that the hand, on its ways (S, N, 2) at ``low_m`` to a target on a seat, meets the seat's back
    or an arm of it. To what lies close to one of them it had better come from the open side; along that one only where
    nothing else is left, and never nearer than the thing itself is.
    """
    costs = np.zeros(way.shape[1])
    pose, z_m = Pose2.of(snapshot.transform(frame, seat.id)), float(snapshot.position(seat.id, frame)[2])
    before = np.linalg.norm(way - target[:2], axis=2) > AT_TARGET_M
    (goal,) = pose.inverse_apply(target[None, :2])
    for rim in rims(seat):
        if z_m + rim.top_m > low_m:
            outline = rim.beyond(goal).outline(seat, pose)
            along_m = float(outline.distance_m(target[None, :2])[0]) - ALONG_M
            away_m = outline.distance_m(way.reshape(-1, 2)).reshape(way.shape[:2])
            nearest_m = np.where(before, away_m, np.inf).min(axis=0)
            clear_m = ARM_HALF_WIDTH_M + DRIFT_M
            costs += np.where(
                nearest_m < min(clear_m, along_m), np.inf, np.where(nearest_m < clear_m, BARRED_COST_M, 0.0)
            )
    return costs


def people_here(context: RobotContext, fresh_s: float = PERSON_FRESH_S) -> list[str]:
    """Who was seen so short a time ago in the robot's room."""
    snapshot, frame = context.snapshot, robot_frame(context.snapshot)
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
    hit = context.surroundings.points()
    for person in spared:
        hit = hit[np.hypot(*(hit - snapshot.position(person, frame)[:2]).T) > AROUND_PERSON_M]
    walls = Walls.of(snapshot, frame)
    grid = draw_map(snapshot, frame, hit, [here, *spots], walls=walls, stamp_s=context.stamp_s, ignore=spared)
    return find_routes(grid, here, footprint_radius_m(context))
