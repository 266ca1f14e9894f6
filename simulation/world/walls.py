"""Walls from room polygons: boxes outside the inner faces, open at the doors, closed at the corners."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from simulation.houses.house import OUTSIDE, Door, House, Room
from simulation.houses.polygons import Point2, contains, cross, distance_to_segment, edges, ray_to_segment
from simulation.world.blocks import Block, without

PANEL_M = 0.05
_THIN_M = 0.005
_EVEN_M = 0.002
_SHORT_M = 0.04
_REACH_M = 1e-4

Segment = tuple[Point2, Point2]


@dataclass(frozen=True, kw_only=True)
class Opening:
    """The gap of a door: its width along the wall's ``yaw_rad``, ``depth_m`` through all between its rooms."""

    door: Door
    center: Point2
    yaw_rad: float
    depth_m: float

    def block(self, bottom_m: float, top_m: float, depth_m: float) -> Block:
        """A box filling the gap's width between two heights."""
        size = (self.door.width, depth_m, top_m - bottom_m)
        return Block(center_m=(*self.center, (bottom_m + top_m) / 2), size_m=size, yaw_rad=self.yaw_rad)


def openings(house: House) -> tuple[Opening, ...]:
    """The gaps of the house's doors, in their order."""
    rooms = {room.id: room for room in house.rooms}
    return tuple(_opening(door, rooms, house.wall_thickness) for door in house.doors)


def wall_blocks(house: House) -> tuple[Block, ...]:
    """All walls and lintels, and the reveals of doors whose rooms' walls do not touch."""
    gaps = openings(house)
    blocks: list[Block] = []
    for room in house.rooms:
        sides = list(edges(room.polygon))
        for index in range(len(sides)):
            blocks += _side(house, sides, index)
    for gap in gaps:
        hole = gap.block(0.0, house.wall_height, gap.depth_m + 2e-3)
        blocks = [rest for block in blocks for rest in without(block, hole)]
    for gap in gaps:
        if gap.door.height < house.wall_height:
            blocks.append(gap.block(gap.door.height, house.wall_height, gap.depth_m))
        blocks += _reveals(gap, house)
    return tuple(blocks)


def panel(gap: Opening) -> Block:
    """The leaf of a closed door, in the middle of its gap."""
    return gap.block(0.0, gap.door.height, min(PANEL_M, gap.depth_m))


def _opening(door: Door, rooms: dict[str, Room], thickness_m: float) -> Opening:
    """From the inner face of one room to that of the other, or to the outer face of the one room's wall."""
    known = [rooms[name] for name in door.rooms if name != OUTSIDE]
    a, b = _nearest_side(known[0], door.center)
    along = _unit(a, b)
    outward = (along[1], -along[0])
    own_m = _across(door.center, a, outward)
    far_m = thickness_m
    if len(known) == 2:
        far_m = _across(_foot(door.center, _nearest_side(known[1], door.center)), a, outward)
        far_m = max(far_m, _THIN_M)
    middle_m = far_m / 2 - own_m
    center = (door.center[0] + middle_m * outward[0], door.center[1] + middle_m * outward[1])
    return Opening(door=door, center=center, yaw_rad=math.atan2(along[1], along[0]), depth_m=far_m)


def _side(house: House, sides: Sequence[Segment], index: int) -> Iterator[Block]:
    """The wall along one side of a room, with the corners at its ends."""
    a, b = sides[index]
    along = _unit(a, b)
    yield from _pieces(house, sides[index], 0.0, math.dist(a, b))
    for end, outer, sign in ((b, sides[(index + 1) % len(sides)], 1.0), (a, sides[index - 1], -1.0)):
        turn = cross(*((a, b, outer[1]) if sign > 0 else (outer[0], a, b)))
        if turn > 0.0:
            yield from _corner(house, end, (sign * along[0], sign * along[1]), along)


def _pieces(house: House, side: Segment, start_m: float, end_m: float) -> Iterator[Block]:
    """Boxes along a side from ``start_m`` to ``end_m``, thinner where another room is closer than the wall is thick."""
    length_m = end_m - start_m
    if length_m <= 1e-6:
        return
    shares = (0.0, 0.25, 0.5, 0.75, 1.0)
    inset = min(1e-6, length_m / 10)
    depths = [_room_behind(house, side, start_m + inset + share * (length_m - 2 * inset)) for share in shares]
    if max(depths) - min(depths) > _EVEN_M and length_m > _SHORT_M:
        middle_m = (start_m + end_m) / 2
        yield from _pieces(house, side, start_m, middle_m)
        yield from _pieces(house, side, middle_m, end_m)
        return
    yield _block(side[0], _unit(*side), start_m, end_m, max(min(depths), _THIN_M), house.wall_height)


def _corner(house: House, end: Point2, away: Point2, along: Point2) -> Iterator[Block]:
    """The wall goes on past a corner that points outward, so that nothing is seen between two walls."""
    outward = (along[1], -along[0])
    beside = (end[0] + 1e-6 * outward[0], end[1] + 1e-6 * outward[1])
    reach_m = _free(house, beside, away, house.wall_thickness)
    far = (end[0] + _REACH_M * away[0], end[1] + _REACH_M * away[1])
    near_end = (end[0] + 0.999 * reach_m * away[0], end[1] + 0.999 * reach_m * away[1])
    depth_m = min(_free(house, point, outward, house.wall_thickness) for point in (far, near_end))
    if reach_m > _THIN_M and depth_m > _THIN_M:
        flip = away[0] * along[0] + away[1] * along[1] < 0.0
        yield _block(end, along, -reach_m if flip else 0.0, 0.0 if flip else reach_m, depth_m, house.wall_height)


def _room_behind(house: House, side: Segment, at_m: float) -> float:
    """Meters of wall that fit behind the point ``at_m`` along the side."""
    along = _unit(*side)
    outward = (along[1], -along[0])
    point = (side[0][0] + at_m * along[0], side[0][1] + at_m * along[1])
    return _free(house, point, outward, house.wall_thickness)


def _free(house: House, origin: Point2, direction: Point2, limit_m: float) -> float:
    """Meters to the first inner face of any room, at most ``limit_m``; 0 from inside a room."""
    start = (origin[0] + _REACH_M / 10 * direction[0], origin[1] + _REACH_M / 10 * direction[1])
    best_m = limit_m
    for room in house.rooms:
        if contains(room.polygon, start):
            return 0.0
        for a, b in edges(room.polygon):
            best_m = min(best_m, ray_to_segment(start, direction, a, b))
    return best_m


def _reveals(gap: Opening, house: House) -> Iterator[Block]:
    """Sides of a gap that is deeper than the two walls, so that nothing is seen between them."""
    hollow_m = gap.depth_m - 2 * house.wall_thickness
    if hollow_m <= 1e-6:
        return
    along = (math.cos(gap.yaw_rad), math.sin(gap.yaw_rad))
    for sign in (-1.0, 1.0):
        at_m = sign * (gap.door.width + house.wall_thickness) / 2
        center = (gap.center[0] + at_m * along[0], gap.center[1] + at_m * along[1], house.wall_height / 2)
        size = (house.wall_thickness, hollow_m + _THIN_M, house.wall_height)
        yield Block(center_m=center, size_m=size, yaw_rad=gap.yaw_rad)


def _block(origin: Point2, along: Point2, start_m: float, end_m: float, depth_m: float, height_m: float) -> Block:
    """A box whose inner face runs along the line from the origin, to its left; it stands to the right."""
    middle_m = (start_m + end_m) / 2
    x_m = origin[0] + middle_m * along[0] + depth_m / 2 * along[1]
    y_m = origin[1] + middle_m * along[1] - depth_m / 2 * along[0]
    size = (end_m - start_m, depth_m, height_m)
    return Block(center_m=(x_m, y_m, height_m / 2), size_m=size, yaw_rad=math.atan2(along[1], along[0]))


def _nearest_side(room: Room, point: Point2) -> Segment:
    return min(edges(room.polygon), key=lambda side: distance_to_segment(point, *side))


def _across(point: Point2, origin: Point2, outward: Point2) -> float:
    """Meters of ``point`` beyond the line through ``origin``."""
    return (point[0] - origin[0]) * outward[0] + (point[1] - origin[1]) * outward[1]


def _foot(point: Point2, side: Segment) -> Point2:
    """The nearest point on the side's line."""
    along = _unit(*side)
    at_m = (point[0] - side[0][0]) * along[0] + (point[1] - side[0][1]) * along[1]
    return side[0][0] + at_m * along[0], side[0][1] + at_m * along[1]


def _unit(a: Point2, b: Point2) -> Point2:
    length_m = math.dist(a, b)
    return (b[0] - a[0]) / length_m, (b[1] - a[1]) / length_m
