"""Where something may be put down for a target: on a support, in a container, near a person, anywhere in a room."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist, hypot, pi

import numpy as np

from scene_graph.nodes import ROBOT_ID, UNKNOWN_LABEL, ObjectNode, ObjectState, PersonNode
from scene_graph.snapshot import Snapshot
from skills.action import RobotContext
from skills.anchor import Anchor
from skills.arm.held import held_size_m
from skills.furniture.furniture import Furniture
from skills.geometry import inside_polygon
from skills.navigation.plan import map_of
from skills.obstacles.walls import MIN_CORNERS, Walls, door_gaps
from skills.outline import disc
from skills.place.place_spot import Spot, spots_on


def free_spots(context: RobotContext, held: str, target: str, *, as_empty: bool = False) -> list[Spot]:
    """The best free spots at ``target`` for ``held`` as the graph is now; ``as_empty``: those of furniture if nothing
    stood on it.
    """
    node = context.snapshot.get(target)
    if as_empty and isinstance(node, ObjectNode):
        return _spots_on(context, target, held, as_empty=True)
    return next(ranked_spots(context, held, target), [])


def ranked_spots(context: RobotContext, held: str, target: str) -> Iterator[list[Spot]]:
    """Free spots at ``target`` for ``held`` as the graph is now, the better ones first: with a person or in a room, on
    what is surely furniture, on what is not known by name, on the floor.
    """
    snapshot, settings = context.snapshot, context.settings.place.spots
    node = snapshot.get(target)
    if node is None:
        return
    if isinstance(node, ObjectNode):
        if spots := _unblocked(context, _spots_on(context, target, held)):
            yield spots
        return
    near_m = settings.handover_m - settings.handover_spare_m if isinstance(node, PersonNode) else np.inf
    supports = _supports(context, snapshot.room_of(target), held)
    for nameless in (False, True):
        spots = [
            spot
            for support in supports
            if (snapshot.object(support).label == UNKNOWN_LABEL) == nameless
            for spot in _spots_on(context, support, held)
            if near_m == np.inf or _distance_m(snapshot, spot.anchor, target) < near_m
        ]
        if spots := _unblocked(context, spots):
            yield spots
    center = target if isinstance(node, PersonNode) else ROBOT_ID
    if spots := _unblocked(context, _floor_spots(context, center, held_size_m(context, held))):
        yield spots


def _spots_on(context: RobotContext, support: str, held: str, *, as_empty: bool = False) -> list[Spot]:
    size_m, settings = held_size_m(context, held), context.settings.place.spots
    return spots_on(context.snapshot, support, size_m, held, hand=context.hand, settings=settings, as_empty=as_empty)


def _unblocked(context: RobotContext, spots: Sequence[Spot]) -> list[Spot]:
    """Those not near a point over which the arm was stopped lately: something is there that is not in the graph."""
    settings = context.settings.place.spots
    lately = [at for at, since_s in context.blocked_spots.items() if context.is_lately(since_s)]
    return [
        spot
        for spot in spots
        if not any(
            spot.anchor.node_id == on and dist(spot.anchor.point_m, point) < settings.blocked_m for on, point in lately
        )
    ]


def _supports(context: RobotContext, room: str | None, held: str) -> list[str]:
    """Supports of ``room`` with a surface that the arm can reach down to, nearest to the robot first."""
    snapshot, found = context.snapshot, []
    for node in snapshot.of_type(ObjectNode):
        usable = node.support and node.state is ObjectState.PRESENT and node.id != held and not node.graspable
        furniture = Furniture.of(node)
        if not usable or furniture.is_dropped_into or snapshot.room_of(node.id) != room or room is None:
            continue
        center_m = float(snapshot.position(node.id, room)[2])
        if any(context.hand.reaches(surface, center_m) for surface in furniture.surfaces):
            x_m, y_m, _ = snapshot.position(node.id, ROBOT_ID)
            found.append((float(hypot(x_m, y_m)), node.id))
    return [node_id for _, node_id in sorted(found)]


def _floor_spots(context: RobotContext, center: str, size_m: tuple[float, float, float]) -> list[Spot]:
    """Free floor around a person, or around the robot, out of doorways."""
    snapshot, settings = context.snapshot, context.settings.place.spots
    room = snapshot.current_room
    if room is None:
        return []
    x_m, y_m, _ = snapshot.position(center, room)
    angles = np.arange(settings.floor_angles) * 2 * pi / settings.floor_angles
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([radius_m * directions for radius_m in settings.floor_radii_m]) + np.array([x_m, y_m])
    spots = [(float(x), float(y)) for x, y in points]
    robot = snapshot.position(ROBOT_ID, room)
    around = context.settings.obstacles.map
    here = (float(robot[0]), float(robot[1]))
    grid = map_of(context, room, [here, *spots], Walls.of(snapshot, room, around))
    room_m = grid.clearance_at(points) - disc(size_m).radius_m
    gaps = [gap.grown(settings.doorway_m) for gap in door_gaps(snapshot, room, around)]
    clear = [not any(gap.contains(points[i : i + 1])[0] for gap in gaps) for i in range(len(points))]
    outline = snapshot.room(room).polygon_m
    within = inside_polygon(outline, points) if len(outline) >= MIN_CORNERS else np.ones(len(points), np.bool_)
    return [
        Spot(anchor=Anchor(room, (*spot, 0.0)), room_m=float(free_m))
        for spot, free_m, is_clear, is_within in zip(spots, room_m, clear, within, strict=True)
        if free_m > settings.floor_gap_m and is_clear and is_within
    ]


def _distance_m(snapshot: Snapshot, anchor: Anchor, target: str) -> float:
    x_m, y_m, _ = anchor.position(snapshot, target)
    return float(hypot(x_m, y_m))
