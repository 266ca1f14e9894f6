"""Shortest ways between nodes through the doors, in meters on the map; what the cost of a plan is made of."""

from __future__ import annotations

from collections.abc import Mapping
from math import hypot, inf, isfinite

import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

Point2 = tuple[float, float]
UNKNOWN_STEP_M = 3.0
"""Assumed distance between two nodes of one room when a position is not known."""


class Ways:
    """All shortest ways over a graph whose vertices are doors; two doors of one room are joined by a straight line.

    ``doors``: (door, its two rooms, open).
    """

    def __init__(
        self,
        rooms: Mapping[str, str | None],
        positions: Mapping[str, Point2 | None],
        doors: tuple[tuple[str, tuple[str, str], bool], ...],
    ) -> None:
        self._rooms, self._positions, self._doors = rooms, positions, doors
        self._by_room: dict[str, list[int]] = {}
        for index, (_, pair, _) in enumerate(doors):
            for room in pair:
                self._by_room.setdefault(room, []).append(index)
        self._open_m, _ = self._all_pairs(only_open=True)
        self._cache: dict[tuple[str, str], float | None] = {}

    def distance_m(self, a: str, b: str) -> float | None:
        """Length of the shortest way through open doors, ``None`` when there is none or a node is in no room."""
        key = (a, b) if a <= b else (b, a)
        if key not in self._cache:
            self._cache[key] = self._distance_m(*key)
        return self._cache[key]

    def closed_doors(self, room_a: str, room_b: str) -> tuple[str, ...]:
        """Closed doors on the shortest way between two rooms when closed doors count as open."""
        lengths, previous = self._all_pairs(only_open=False)
        ends = [(lengths[i, j], i, j) for i in self._by_room.get(room_a, []) for j in self._by_room.get(room_b, [])]
        if not ends or not isfinite(min(ends)[0]):
            return ()
        _, start, index = min(ends)
        on_way = [index]
        while index != start:
            index = int(previous[start, index])
            on_way.append(index)
        return tuple(self._doors[i][0] for i in reversed(on_way) if not self._doors[i][2])

    def _distance_m(self, a: str, b: str) -> float | None:
        room_a, room_b = self._rooms.get(a), self._rooms.get(b)
        if room_a is None or room_b is None:
            return None
        if room_a == room_b:
            return self._straight_m(a, b)
        best = inf
        for i in self._by_room.get(room_a, []):
            for j in self._by_room.get(room_b, []):
                if isfinite(self._open_m[i, j]):
                    to_door = self._straight_m(a, self._doors[i][0])
                    best = min(best, to_door + float(self._open_m[i, j]) + self._straight_m(self._doors[j][0], b))
        return best if isfinite(best) else None

    def _straight_m(self, a: str, b: str) -> float:
        at_a, at_b = self._positions.get(a), self._positions.get(b)
        if at_a is None or at_b is None:
            return 0.0 if a == b else UNKNOWN_STEP_M
        return hypot(at_a[0] - at_b[0], at_a[1] - at_b[1])

    def _all_pairs(self, *, only_open: bool) -> tuple[np.ndarray, np.ndarray]:
        """Lengths (D, D) and predecessors (D, D) between doors; closed doors are infinitely far when ``only_open``."""
        count = len(self._doors)
        weights = np.zeros((count, count))
        for members in self._by_room.values():
            for i in members:
                for j in members:
                    if i != j:
                        straight = max(self._straight_m(self._doors[i][0], self._doors[j][0]), 1e-6)
                        weights[i, j] = straight if weights[i, j] == 0 else min(weights[i, j], straight)
        closed = [i for i in range(count) if only_open and not self._doors[i][2]]
        weights[closed, :] = weights[:, closed] = 0.0
        lengths, previous = dijkstra(csr_array(weights), return_predecessors=True)
        lengths[closed, :] = lengths[:, closed] = inf
        return lengths, previous
