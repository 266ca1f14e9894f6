"""Whether one more thing fits on a support or into a container, from the sizes and places that the graph believes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from math import prod

import numpy as np

from scene_graph.nodes import ObjectNode
from scene_graph.snapshot import Snapshot
from skills.arm.grasping import DOWN_RAD, LEVEL_SHARE, PAD_DEPTH_M, TIP_M, Size3, is_tall
from skills.furniture.boards import BOTH_SIDES, Board, boards_of, headroom_m, is_in_reach
from skills.geometry import Points
from skills.outline import Outline, disc
from skills.place.place_spot import GAP_M, laid, lattice, room_m, stands_at, surface_m, ways_in
from skills.ports import ArmGeometry
from skills.state.state import Thing

WAYS = 4
"""In which a thing is laid at most: turned anyhow or so that it fits, in coarse or fine steps."""


class Capacity:
    """Free space of one snapshot's supports; what was asked once is remembered."""

    def __init__(self, snapshot: Snapshot) -> None:
        self._snapshot = snapshot
        self._known: dict[tuple[str, frozenset[str], tuple[str, ...]], bool] = {}

    def fits(self, place: Thing, staying: Collection[str], coming: Collection[str]) -> bool:
        """Whether the things ``coming`` fit on or in ``place`` beside those ``staying`` there.

        A place or thing of unknown size (0) is never too small or too big. On a surface, things are set in rows from
        its edge, where and as close as the robot would; a container holds as much volume as it has.
        """
        if not coming or 0.0 in place.size_m:
            return True
        key = (place.id, frozenset(staying), tuple(sorted(coming)))
        if key not in self._known:
            self._known[key] = self._poured(place, key[1] | set(coming)) if place.container else self._set(*key)
        return self._known[key]

    def _poured(self, place: Thing, things: Collection[str]) -> bool:
        sizes = [self._size_m(thing) for thing in things]
        narrow = min(place.size_m[:2])
        return sum(map(prod, sizes)) <= prod(place.size_m) and all(min(size_m[:2]) <= narrow for size_m in sizes)

    def _set(self, support: str, staying: frozenset[str], coming: tuple[str, ...]) -> bool:
        sizes = sorted(
            (self._size_m(thing) for thing in coming), key=lambda size_m: disc(size_m).radius_m, reverse=True
        )
        sides = range(len(BOTH_SIDES)) if len(self._boards(support)) > 1 else (0,)
        return any(self._in_rows(support, staying, sizes, way, side) for way in range(WAYS) for side in sides)

    def _in_rows(self, support: str, staying: frozenset[str], sizes: Sequence[Size3], way: int, side: int) -> bool:
        """Whether things of these sizes fit beside what stays, each laid in that way or an earlier one, if it has so
        many, at the first free point, on the lowest board that has one; below another board, all from one side.
        """
        boards = self._boards(support)
        heres = [
            [node for node in stands_at(self._snapshot, support, board, None) if self._stays(node, support, staying)]
            for board in boards
        ]
        done: list[list[tuple[Points, Outline]]] = [[] for _ in boards]
        return all(
            any(
                self._set_down(support, board, here, taken, size_m, way, side)
                for board, here, taken in zip(boards, heres, done, strict=True)
            )
            for size_m in sizes
        )

    def _set_down(
        self,
        support: str,
        board: Board,
        here: Sequence[ObjectNode],
        done: list[tuple[Points, Outline]],
        size_m: Size3,
        way: int,
        side: int,
    ) -> bool:
        """Whether one more fits on a board beside what is ``here`` and ``done``, to which it is added."""
        if board.free_m < _headroom_m(size_m):
            return False
        ways = list(laid(size_m, board))
        outlines, step_m = ways[min(way, len(ways) - 1)]
        for outline in outlines:
            free = self._free(support, board, here, done, outline, step_m, side)
            if len(free):
                done.append((free[0], outline))
                return True
        return False

    def _free(
        self,
        support: str,
        board: Board,
        here: Sequence[ObjectNode],
        done: Sequence[tuple[Points, Outline]],
        outline: Outline,
        step_m: float,
        side: int,
    ) -> Points:
        """Points (N, 2) of a board where a thing of that outline stands free."""
        node = self._snapshot.object(support)
        points = lattice(node, outline, step_m, covered=board.is_covered)
        air_m = room_m(self._snapshot, support, points, outline, here)
        for point, other in done:
            air_m = np.minimum(air_m, outline.gap_to_m(points, point, other))
        before = [(point, np.array(other.half_m)) for point, other in done]
        ways = ways_in(self._snapshot, node, board, points, outline, here, before)
        return np.asarray(points[(air_m >= GAP_M) & ways[:, side]])

    def _boards(self, support: str) -> list[Board]:
        """The surfaces that the arm reaches; of what has no boards that are known, the top, be it as it may."""
        node, room = self._snapshot.object(support), self._snapshot.room_of(support)
        boards = boards_of(node)
        if not boards or room is None:
            return [Board(height_m=surface_m(self._snapshot, support, None))]
        center_m = float(self._snapshot.position(support, room)[2])
        return [board for board in boards if is_in_reach(board, center_m)]

    def _stays(self, node: ObjectNode, support: str, staying: frozenset[str]) -> bool:
        carried_off = node.graspable and self._snapshot.support_of(node.id) == support and node.id not in staying
        return not carried_off

    def _size_m(self, object_id: str) -> tuple[float, float, float]:
        node = self._snapshot.get(object_id)
        return node.size_m if isinstance(node, ObjectNode) else (0.0, 0.0, 0.0)


def _headroom_m(size_m: Size3) -> float:
    """What must be free over a board for a thing that is held as such things are mostly."""
    if is_tall(size_m):
        return headroom_m(size_m[2], LEVEL_SHARE * size_m[2], 0.0, ArmGeometry())
    return headroom_m(size_m[2], max(size_m[2] - PAD_DEPTH_M, size_m[2] / 2, TIP_M), DOWN_RAD, ArmGeometry())
