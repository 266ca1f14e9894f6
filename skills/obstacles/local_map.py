"""The occupancy grid around the robot, made on demand from what the graph says and what the LiDAR hit lately."""

from __future__ import annotations

from collections.abc import Collection, Sequence

import numpy as np

from scene_graph.nodes import ObjectNode, ObjectState, PersonNode, RoomNode
from scene_graph.snapshot import Snapshot
from skills.geometry import Box2, Point2, Points, Pose2, inside_polygon
from skills.obstacles.grid import Canvas, Grid
from skills.obstacles.settings import MapSettings
from skills.obstacles.walls import Walls, door_gaps, whole_room
from skills.ports import ArmGeometry


def draw_map(
    snapshot: Snapshot,
    frame: str,
    obstacles: Points,
    spots: Sequence[Point2],
    *,
    walls: Walls,
    stamp_s: float,
    believe_furniture: bool = True,
    ignore: Collection[str] = (),
    geometry: ArmGeometry = ArmGeometry(),
    settings: MapSettings = MapSettings(),
) -> Grid:
    """The grid in ``frame`` that holds all ``spots`` (the robot first, then goals).

    The walls of a room count when it was seen all around and all spots lie within it; else only ``obstacles``, (N, 2),
    do. A known room that holds neither the robot nor the first goal is then no way: its walls, out of view, would look
    open. Without ``believe_furniture`` the graph's word counts only for small things on the floor, which the LiDAR may
    look over. ``ignore``: nodes whose footprint is left out.
    """
    polygon = _walls_around(snapshot, frame, spots, settings)
    outline = np.array(polygon or spots)
    margin = settings.around_room_m if polygon else settings.around_spots_m
    low, high = outline.min(axis=0) - margin, outline.max(axis=0) + margin
    canvas = Canvas.covering((float(low[0]), float(low[1])), (float(high[0]), float(high[1])))
    if polygon:
        _draw_walls(canvas, snapshot, frame, polygon, settings)
    else:
        _draw_rooms_elsewhere(canvas, snapshot, frame, spots, settings)
    canvas.block_points(walls.explain(obstacles) if polygon else obstacles)
    small_only = not believe_furniture
    for box in standing(snapshot, frame, ignore, small_only=small_only, height_m=geometry.height_m, settings=settings):
        canvas.block_box(box)
    if believe_furniture:
        for person in snapshot.of_type(PersonNode):
            if person.id not in ignore and stamp_s - person.last_seen_s < settings.person_fresh_s:
                canvas.block_disc(_position(snapshot, person.id, frame), settings.person_radius_m)
    return canvas.finish()


def standing(
    snapshot: Snapshot,
    frame: str,
    ignore: Collection[str] = (),
    *,
    small_only: bool = False,
    rooms: Collection[str] = (),
    height_m: float = ArmGeometry.height_m,
    settings: MapSettings = MapSettings(),
) -> list[Box2]:
    """Footprints in ``frame`` of what stands on the floor of this room, or of ``rooms``, as the graph believes;
    ``small_only``: of what a hand could pick up. What begins over ``height_m``, the robot's, is in no way.
    """
    return [
        footprint(snapshot, node, frame)
        for node in snapshot.of_type(ObjectNode)
        if node.id not in ignore
        and (node.graspable or not small_only)
        and snapshot.room_of(node.id) in (rooms or (frame,))
        and _stands_in_way(snapshot, node, frame, height_m, settings)
    ]


def footprint(snapshot: Snapshot, node: ObjectNode, frame: str) -> Box2:
    """The rectangle that an object covers on the floor of ``frame``."""
    return Box2(Pose2.of(snapshot.transform(frame, node.id)), node.size_m[0], node.size_m[1])


def _walls_around(snapshot: Snapshot, frame: str, spots: Sequence[Point2], settings: MapSettings) -> tuple[Point2, ...]:
    room = whole_room(snapshot, frame)
    if room is None:
        return ()
    points = np.array(spots)
    within = inside_polygon(room.polygon_m, points)
    for gap in door_gaps(snapshot, frame, settings):
        within |= gap.contains(points)
    return room.polygon_m if within[0] and within.any() and _any_goal(within) else ()


def _any_goal(within: np.ndarray) -> bool:
    """Whether at least one goal lies within the room; the first spot is the robot."""
    return bool(within[1:].any()) if len(within) > 1 else True


def _draw_walls(
    canvas: Canvas, snapshot: Snapshot, frame: str, polygon: Sequence[Point2], settings: MapSettings
) -> None:
    centers = canvas.centers()
    free = inside_polygon(polygon, centers)
    for gap in door_gaps(snapshot, frame, settings):
        free |= gap.contains(centers)
    canvas.block(~free)


def _draw_rooms_elsewhere(
    canvas: Canvas, snapshot: Snapshot, frame: str, spots: Sequence[Point2], settings: MapSettings
) -> None:
    """Block rooms that were seen all around, but for their door gaps, where neither the robot nor its first goal is."""
    if snapshot.robot is None or not snapshot.robot.localized or len(spots) < 2:
        return
    for room in snapshot.of_type(RoomNode):
        T_frame_room = Pose2.of(snapshot.transform(frame, room.id))
        ends = T_frame_room.inverse_apply(np.array(spots[:2]))
        if whole_room(snapshot, room.id) is None or inside_polygon(room.polygon_m, ends).any():
            continue
        centers = T_frame_room.inverse_apply(canvas.centers())
        behind = inside_polygon(room.polygon_m, centers)
        for gap in door_gaps(snapshot, room.id, settings):
            behind &= ~gap.contains(centers)
        canvas.block(behind)


def _stands_in_way(snapshot: Snapshot, node: ObjectNode, frame: str, height_m: float, settings: MapSettings) -> bool:
    if (
        node.state is not ObjectState.PRESENT
        or node.size_m[2] < settings.flat_m
        or snapshot.support_of(node.id) is not None
    ):
        return False
    bottom_m = snapshot.position(node.id, frame)[2] - node.size_m[2] / 2
    return bool(bottom_m < (settings.low_m if node.graspable else height_m))


def _position(snapshot: Snapshot, node_id: str, frame: str) -> Point2:
    x_m, y_m, _ = snapshot.position(node_id, frame)
    return float(x_m), float(y_m)
