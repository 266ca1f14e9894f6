"""Whether one more thing fits on a support or into a container, from the sizes and places that the graph believes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from math import prod

import numpy as np

from scene_graph.nodes import ObjectNode
from scene_graph.snapshot import Snapshot
from skills.arm.hand import Hand, Size3
from skills.arm.way_in import BOTH_SIDES
from skills.furniture.furniture import Surface
from skills.furniture.standing import stands_at, surfaces_of
from skills.geometry import Points
from skills.outline import Outline, disc
from skills.place.place_spot import FreeSpace
from skills.place.settings import SpotSettings
from skills.state.world import Thing

Laid = tuple[Points, Outline]
"""Where the middle of a thing is that was set there, and what it covers."""


class Capacity:
    """Free space of one snapshot's supports; what was asked once is remembered."""

    def __init__(self, snapshot: Snapshot, hand: Hand = Hand(), settings: SpotSettings = SpotSettings()) -> None:
        self._snapshot, self._hand, self._settings = snapshot, hand, settings
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
        sizes = sorted(map(self._size_m, coming), key=lambda size_m: disc(size_m).radius_m, reverse=True)
        spaces = self._spaces(support, staying)
        sides = range(len(BOTH_SIDES)) if len(spaces) > 1 else (0,)
        return any(self._in_rows(spaces, sizes, way, side) for way in range(self._settings.ways) for side in sides)

    def _in_rows(self, spaces: Sequence[FreeSpace], sizes: Sequence[Size3], way: int, side: int) -> bool:
        """Whether things of these sizes fit beside what stays, each laid in that way or an earlier one, if it has so
        many, at the first free point, on the lowest board that has one; below another board, all from one side.
        """
        taken: list[tuple[FreeSpace, list[Laid]]] = [(space, []) for space in spaces]
        return all(any(self._set_down(space, done, size_m, way, side) for space, done in taken) for size_m in sizes)

    def _set_down(self, space: FreeSpace, done: list[Laid], size_m: Size3, way: int, side: int) -> bool:
        """Whether one more fits on a surface beside what is there and ``done``, to which it is added."""
        if space.surface.free_m < self._hand.usual_headroom_m(size_m):
            return False
        ways = list(space.laid(size_m))
        outlines, step_m = ways[min(way, len(ways) - 1)]
        for outline in outlines:
            free = self._free(space, done, outline, step_m, side)
            if len(free):
                done.append((free[0], outline))
                return True
        return False

    def _free(self, space: FreeSpace, done: Sequence[Laid], outline: Outline, step_m: float, side: int) -> Points:
        """Points (N, 2) of a surface where a thing of that outline stands free."""
        points = space.lattice(outline, step_m)
        air_m = space.room_m(points, outline)
        for point, other in done:
            air_m = np.minimum(air_m, outline.gap_to_m(points, point, other))
        before = [(point, np.array(other.half_m)) for point, other in done]
        return np.asarray(points[(air_m >= self._settings.gap_m) & space.ways_in(points, outline, before)[:, side]])

    def _spaces(self, support: str, staying: frozenset[str]) -> list[FreeSpace]:
        """What stays leaves free of the surfaces that the arm reaches; of a single one, be it where it may."""
        surfaces, room = surfaces_of(self._snapshot, support, None), self._snapshot.room_of(support)
        reached: Sequence[Surface] = surfaces
        if len(surfaces) > 1 and room is not None:
            center_m = float(self._snapshot.position(support, room)[2])
            reached = [surface for surface in surfaces if self._hand.reaches(surface, center_m)]
        return [
            FreeSpace(
                self._snapshot,
                support,
                surface,
                [
                    node
                    for node in stands_at(self._snapshot, support, surfaces, surface, None)
                    if self._stays(node, support, staying)
                ],
                self._hand,
                self._settings,
            )
            for surface in reached
        ]

    def _stays(self, node: ObjectNode, support: str, staying: frozenset[str]) -> bool:
        carried_off = node.graspable and self._snapshot.support_of(node.id) == support and node.id not in staying
        return not carried_off

    def _size_m(self, object_id: str) -> tuple[float, float, float]:
        node = self._snapshot.get(object_id)
        return node.size_m if isinstance(node, ObjectNode) else (0.0, 0.0, 0.0)
