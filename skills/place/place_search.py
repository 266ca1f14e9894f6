"""Where something may be put down for a target: on a support, in a container, near a person, anywhere in a room."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import dist, hypot, pi

import numpy as np

from scene_graph.nodes import ROBOT_ID, UNKNOWN_LABEL, ObjectNode, ObjectState, PersonNode
from scene_graph.snapshot import Snapshot
from skills.action import RobotContext
from skills.anchor import Anchor
from skills.furniture.boards import HIGHEST_M, Board, boards_of
from skills.furniture.containers import is_open_container
from skills.navigation.local_map import draw_map
from skills.navigation.walls import Walls, door_gaps
from skills.outline import disc
from skills.place.place_spot import Spot, spots_on

HANDOVER_M = 1.8
"""Something is within a person's reach when it is at most this far from where they stand."""
FLOOR_RADII_M = (0.55, 0.75, 0.95)
FLOOR_ANGLES = 24
FLOOR_GAP_M = 0.10
DOORWAY_M = 0.6
LOWEST_M = 0.15
BLOCKED_M = 0.12
"""What stopped the arm may be so large."""
BLOCKED_S = 120.0
"""So long it is expected to be there."""


def free_spots(context: RobotContext, held: str, target: str, *, as_empty: bool = False) -> list[Spot]:
    """The best free spots at ``target`` for ``held`` as the graph is now; ``as_empty``: those of furniture if nothing
    stood on it.
    """
    node = context.snapshot.get(target)
    if as_empty and isinstance(node, ObjectNode):
        return spots_on(context.snapshot, target, held_size_m(context, held), held, as_empty=True)
    return next(ranked_spots(context, held, target), [])


def ranked_spots(context: RobotContext, held: str, target: str) -> Iterator[list[Spot]]:
    """Free spots at ``target`` for ``held`` as the graph is now, the better ones first: with a person or in a room, on
    what is surely furniture, on what is not known by name, on the floor.
    """
    snapshot = context.snapshot
    size_m = held_size_m(context, held)
    node = snapshot.get(target)
    if node is None:
        return
    if isinstance(node, ObjectNode):
        if spots := _unblocked(context, spots_on(snapshot, target, size_m, held)):
            yield spots
        return
    near_m = HANDOVER_M if isinstance(node, PersonNode) else np.inf
    supports = _supports(snapshot, snapshot.room_of(target), held)
    for nameless in (False, True):
        spots = [
            spot
            for support in supports
            if (snapshot.object(support).label == UNKNOWN_LABEL) == nameless
            for spot in spots_on(snapshot, support, size_m, held)
            if near_m == np.inf or _distance_m(snapshot, spot.anchor, target) < near_m - 0.3
        ]
        if spots := _unblocked(context, spots):
            yield spots
    if spots := _unblocked(
        context, _floor_spots(context, target if isinstance(node, PersonNode) else ROBOT_ID, size_m)
    ):
        yield spots


def _unblocked(context: RobotContext, spots: Sequence[Spot]) -> list[Spot]:
    """Those not near a point over which the arm was stopped lately: something is there that is not in the graph."""
    lately = [at for at, since_s in context.blocked_spots.items() if context.stamp_s - since_s < BLOCKED_S]
    return [
        spot
        for spot in spots
        if not any(spot.anchor.node_id == on and dist(spot.anchor.point_m, point) < BLOCKED_M for on, point in lately)
    ]


def held_size_m(context: RobotContext, held: str) -> tuple[float, float, float]:
    """Extent of what the hand holds."""
    if context.grip is not None and context.grip.object_id == held:
        return context.grip.size_m
    node = context.snapshot.get(held)
    return node.size_m if isinstance(node, ObjectNode) else (0.1, 0.1, 0.2)


def _supports(snapshot: Snapshot, room: str | None, held: str) -> list[str]:
    """Supports of ``room`` whose top the arm can reach down to, nearest to the robot first."""
    found = []
    for node in snapshot.of_type(ObjectNode):
        usable = node.support and node.state is ObjectState.PRESENT and node.id != held and not node.graspable
        if not usable or is_open_container(node.label) or snapshot.room_of(node.id) != room or room is None:
            continue
        center_m = float(snapshot.position(node.id, room)[2])
        boards = boards_of(node) or (Board(height_m=node.size_m[2] / 2),)
        if any(LOWEST_M <= center_m + board.height_m <= HIGHEST_M for board in boards):
            x_m, y_m, _ = snapshot.position(node.id, ROBOT_ID)
            found.append((float(hypot(x_m, y_m)), node.id))
    return [node_id for _, node_id in sorted(found)]


def _floor_spots(context: RobotContext, center: str, size_m: tuple[float, float, float]) -> list[Spot]:
    """Free floor around a person, or around the robot, out of doorways."""
    snapshot = context.snapshot
    room = snapshot.current_room
    if room is None:
        return []
    x_m, y_m, _ = snapshot.position(center, room)
    angles = np.arange(FLOOR_ANGLES) * 2 * pi / FLOOR_ANGLES
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    points = np.concatenate([radius_m * directions for radius_m in FLOOR_RADII_M]) + np.array([x_m, y_m])
    spots = [(float(x), float(y)) for x, y in points]
    robot = snapshot.position(ROBOT_ID, room)
    around = context.surroundings.points()
    grid = draw_map(
        snapshot,
        room,
        around,
        [(float(robot[0]), float(robot[1])), *spots],
        walls=Walls.of(snapshot, room),
        stamp_s=context.stamp_s,
    )
    room_m = grid.clearance_at(points) - disc(size_m).radius_m
    gaps = [gap.grown(DOORWAY_M) for gap in door_gaps(snapshot, room)]
    clear = [not any(gap.contains(points[i : i + 1])[0] for gap in gaps) for i in range(len(points))]
    return [
        Spot(anchor=Anchor(room, (*spot, 0.0)), room_m=float(free_m))
        for spot, free_m, is_clear in zip(spots, room_m, clear, strict=True)
        if free_m > FLOOR_GAP_M and is_clear
    ]


def _distance_m(snapshot: Snapshot, anchor: Anchor, target: str) -> float:
    x_m, y_m, _ = anchor.position(snapshot, target)
    return float(hypot(x_m, y_m))
