"""Boxes all over a piece of furniture, so that nothing else finds room there; what stands there already stays."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from evaluations.missions.outcome import Scene
from simulation.furnishing.catalog import category_named
from simulation.houses.house import Furniture
from simulation.world.blocks import Block

Range = tuple[float, float]


@dataclass(frozen=True, kw_only=True)
class ClutterSettings:
    """How large the boxes are; chosen, so that the hand finds no room between them."""

    side_m: float = 0.3
    """About as wide is a box where there is room for it."""
    least_m: float = 0.1
    """No narrower is one that fits beside what stands there."""
    gap_m: float = 0.015
    """Around each, so that it touches nothing."""
    height_m: float = 0.25
    below_board_m: float = 0.06
    """As high is a box, and so far it ends below the next board."""


@dataclass(frozen=True, kw_only=True)
class _Cuboid:
    """What lies between lowest and highest x, y, z (m) in the furniture's own frame, over the middle of its foot."""

    x_m: Range
    y_m: Range
    z_m: Range

    def meets(self, other: _Cuboid) -> bool:
        """Whether the two share room."""
        pairs = ((self.x_m, other.x_m), (self.y_m, other.y_m), (self.z_m, other.z_m))
        return all(a[0] < b[1] and b[0] < a[1] for a, b in pairs)


def boxes_over(item: Furniture, scene: Scene, settings: ClutterSettings = ClutterSettings()) -> list[Block]:
    """Boxes, house coordinates, that fill every level of ``item`` as it now is, without touching anything."""
    kind = category_named(item.category, item.size, static=True)
    width_m, depth_m, height_m = item.size or kind.size_m
    parts = kind.parts((width_m, depth_m, height_m), (0.0, 0.0, 0.0))
    solid = [_around(part.center_m, part.size_m) for part in parts if part.solid]
    taken = [*solid, *_standing(item, scene)]
    levels_m = sorted({level * height_m for level in kind.levels})
    boxes: list[Block] = []
    for level_m, next_m in zip(levels_m, [*levels_m[1:], math.inf], strict=True):
        top_m = min(level_m + settings.height_m, next_m - settings.below_board_m)
        whole = _Cuboid(x_m=(-width_m / 2, width_m / 2), y_m=(-depth_m / 2, depth_m / 2), z_m=(level_m + 0.005, top_m))
        for room in _cells(_between(whole, solid), settings.side_m):
            boxes += (_block(item, box) for box in _free(room, taken, settings))
    return boxes


def _between(room: _Cuboid, solid: Sequence[_Cuboid]) -> _Cuboid:
    """What is left of a room between the sides, the arms and the back of the furniture."""
    for part in solid:
        if not part.meets(room):
            continue
        (low_x, high_x), (low_y, high_y) = room.x_m, room.y_m
        ways = (
            replace(room, x_m=(max(low_x, part.x_m[1]), high_x)),
            replace(room, x_m=(low_x, min(high_x, part.x_m[0]))),
            replace(room, y_m=(max(low_y, part.y_m[1]), high_y)),
            replace(room, y_m=(low_y, min(high_y, part.y_m[0]))),
        )
        largest = max(ways, key=lambda left: max(_length(left.x_m), 0.0) * max(_length(left.y_m), 0.0))
        if _length(largest.x_m) * _length(largest.y_m) > 0.5 * _length(room.x_m) * _length(room.y_m):
            room = largest
    return room


def _free(room: _Cuboid, taken: Sequence[_Cuboid], settings: ClutterSettings) -> Iterator[_Cuboid]:
    """One box in the room, or smaller ones where something stands."""
    if min(_length(room.x_m), _length(room.y_m)) < settings.least_m:
        return
    box = replace(room, x_m=_within(room.x_m, settings.gap_m), y_m=_within(room.y_m, settings.gap_m))
    if not any(box.meets(other) for other in taken):
        yield box
        return
    halves = list(_cells(room, max(_length(room.x_m), _length(room.y_m)) / 2))
    if len(halves) > 1:
        for half in halves:
            yield from _free(half, taken, settings)


def _cells(room: _Cuboid, side_m: float) -> Iterator[_Cuboid]:
    """Equal parts of a room, side by side, about as wide and as deep."""
    columns, rows = (max(1, round(_length(side) / side_m)) for side in (room.x_m, room.y_m))
    for i in range(columns):
        for j in range(rows):
            yield replace(room, x_m=_share(room.x_m, i, columns), y_m=_share(room.y_m, j, rows))


def _share(side: Range, number: int, count: int) -> Range:
    step_m = _length(side) / count
    return side[0] + number * step_m, side[0] + (number + 1) * step_m


def _standing(item: Furniture, scene: Scene) -> Iterator[_Cuboid]:
    """What stands there, however it is turned."""
    sizes = {thing.id: thing.size for thing in scene.house.objects}
    frame = _frame(item)
    for record in scene.truth["objects"]:
        if item.id not in (record["on"], record["in"]) or record["id"] == scene.holding:
            continue
        width_m, depth_m, height_m = sizes.get(record["id"]) or category_named(record["category"]).size_m
        across_m = math.hypot(width_m, depth_m)
        x_m, y_m, z_m = record["position_m"]
        yield _around((*frame.inward((x_m, y_m)), z_m), (across_m, across_m, max(across_m, height_m)))


def _around(center_m: tuple[float, float, float], size_m: tuple[float, float, float]) -> _Cuboid:
    x_m, y_m, z_m = ((at - side / 2, at + side / 2) for at, side in zip(center_m, size_m, strict=True))
    return _Cuboid(x_m=x_m, y_m=y_m, z_m=z_m)


def _block(item: Furniture, box: _Cuboid) -> Block:
    x_m, y_m = _frame(item).outward((sum(box.x_m) / 2, sum(box.y_m) / 2))
    size_m = (_length(box.x_m), _length(box.y_m), _length(box.z_m))
    return Block(center_m=(x_m, y_m, sum(box.z_m) / 2), size_m=size_m, yaw_rad=item.pose[2])


def _frame(item: Furniture) -> Block:
    """For points of the house in the furniture's frame, and back."""
    return Block(center_m=(*item.pose[:2], 0.0), size_m=(0.0, 0.0, 0.0), yaw_rad=item.pose[2])


def _within(side: Range, gap_m: float) -> Range:
    return side[0] + gap_m, side[1] - gap_m


def _length(side: Range) -> float:
    return side[1] - side[0]
