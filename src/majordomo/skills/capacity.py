"""Whether one more thing fits on a support or into a container, from the sizes and places that the graph believes."""

from __future__ import annotations

from collections.abc import Collection, Sequence
from math import prod

import numpy as np

from majordomo.scene_graph.nodes import ObjectNode
from majordomo.scene_graph.snapshot import Snapshot
from majordomo.skills.geometry import Points
from majordomo.skills.place_spot import (
    FINE_STEP_M,
    GAP_M,
    STEP_M,
    lattice,
    outline_radius_m,
    room_m,
    stands_on,
)
from majordomo.skills.state import Thing


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
        here = [node for node in stands_on(self._snapshot, support, None) if self._stays(node, support, staying)]
        radii_m = sorted((outline_radius_m(self._size_m(thing)) for thing in coming), reverse=True)
        return any(self._in_rows(support, here, radii_m, step_m) for step_m in (STEP_M, FINE_STEP_M))

    def _in_rows(self, support: str, here: Sequence[ObjectNode], radii_m: Sequence[float], step_m: float) -> bool:
        """Whether discs of these radii fit beside what is ``here``, each set down at the first free point."""
        done: list[tuple[Points, float]] = []
        for radius_m in radii_m:
            points = lattice(self._snapshot.object(support), radius_m, step_m)
            air_m = room_m(self._snapshot, support, points, here) - radius_m
            for point, other_m in done:
                air_m = np.minimum(air_m, np.hypot(*(points - point).T) - other_m - radius_m)
            free = points[air_m >= GAP_M]
            if not len(free):
                return False
            done.append((free[0], radius_m))
        return True

    def _stays(self, node: ObjectNode, support: str, staying: frozenset[str]) -> bool:
        carried_off = node.graspable and self._snapshot.support_of(node.id) == support and node.id not in staying
        return not carried_off

    def _size_m(self, object_id: str) -> tuple[float, float, float]:
        node = self._snapshot.get(object_id)
        return node.size_m if isinstance(node, ObjectNode) else (0.0, 0.0, 0.0)
