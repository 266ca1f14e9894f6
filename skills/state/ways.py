"""Shortest ways between nodes through the doors, in meters on the map; what the cost of a plan is made of."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from functools import cached_property
from math import hypot, inf, isfinite

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

Point2 = tuple[float, float]
Whereabouts = Callable[[str], tuple[str | None, Point2 | None]]


class Ways:
    """Shortest ways over a graph whose vertices are doors; two doors of one room are joined by a straight line.

    Lengths from a door are computed when they are first asked for: from the doors of the room that is asked about most,
    which in a search for the nearest is the robot's own.

    Args:
        whereabouts: room and position of a node.
        doors: (door, its two rooms, open).
        unknown_m: assumed distance between two nodes of one room when a position is not known.
    """

    def __init__(
        self, whereabouts: Whereabouts, doors: tuple[tuple[str, tuple[str, str], bool], ...], unknown_m: float = 3.0
    ) -> None:
        self._whereabouts, self._doors, self._unknown_m = whereabouts, doors, unknown_m
        self._by_room: dict[str, list[int]] = {}
        for index, (_, pair, _) in enumerate(doors):
            for room in dict.fromkeys(pair):
                self._by_room.setdefault(room, []).append(index)
        self._asked: Counter[str] = Counter()
        self._open_m: dict[int, list[float]] = {}
        self._known_m: dict[tuple[str, str], float | None] = {}

    def distance_m(self, a: str, b: str) -> float | None:
        """Length of the shortest way through open doors, ``None`` when there is none or a node is in no room."""
        key = (a, b) if a <= b else (b, a)
        if key not in self._known_m:
            self._known_m[key] = self._distance_m(*key)
        return self._known_m[key]

    def closed_doors(self, room_a: str, room_b: str) -> tuple[str, ...]:
        """Closed doors on the shortest way between two rooms when closed doors count as open."""
        starts, ends = self._by_room.get(room_a, []), self._by_room.get(room_b, [])
        if not starts or not ends:
            return ()
        lengths, previous = dijkstra(self._links(only_open=False), indices=starts, return_predecessors=True)
        length_m, row, index = min((lengths[i, j], i, j) for i in range(len(starts)) for j in ends)
        if not isfinite(length_m):
            return ()
        on_way = [index]
        while index != starts[row]:
            index = int(previous[row, index])
            on_way.append(index)
        return tuple(self._doors[i][0] for i in reversed(on_way) if not self._doors[i][2])

    def _distance_m(self, a: str, b: str) -> float | None:
        (room_a, _), (room_b, _) = self._whereabouts(a), self._whereabouts(b)
        if room_a is None or room_b is None:
            return None
        if room_a == room_b:
            return self._straight_m(a, b)
        self._asked.update((room_a, room_b))
        near, far = self._exits(a, room_a), self._exits(b, room_b)
        if (-self._asked[room_a], len(near)) > (-self._asked[room_b], len(far)):
            near, far = far, near
        from_near = ((to_m, self._from_door_m(i)) for i, to_m in near)
        best = min((to_m + row[j] + on_m for to_m, row in from_near for j, on_m in far), default=inf)
        return best if isfinite(best) else None

    def _exits(self, node_id: str, room: str) -> list[tuple[int, float]]:
        """Open doors of the node's room, each with the straight line to it."""
        doors = (i for i in self._by_room.get(room, []) if self._doors[i][2])
        return [(i, self._straight_m(node_id, self._doors[i][0])) for i in doors]

    def _from_door_m(self, index: int) -> list[float]:
        """Lengths from an open door to every door."""
        if index not in self._open_m:
            self._open_m[index] = dijkstra(self._open_links, indices=index).tolist()
        return self._open_m[index]

    def _straight_m(self, a: str, b: str) -> float:
        (_, at_a), (_, at_b) = self._whereabouts(a), self._whereabouts(b)
        if at_a is None or at_b is None:
            return 0.0 if a == b else self._unknown_m
        return hypot(at_a[0] - at_b[0], at_a[1] - at_b[1])

    @cached_property
    def _open_links(self) -> csr_array:
        return self._links(only_open=True)

    def _links(self, *, only_open: bool) -> csr_array:
        """(D, D) straight lines between the doors of each room."""
        count = len(self._doors)
        lengths_m = np.full((count, count), inf)
        points = np.array([self._whereabouts(door)[1] or (np.nan, np.nan) for door, _, _ in self._doors])
        for doors in self._by_room.values():
            members = [i for i in doors if self._doors[i][2] or not only_open]
            block = np.ix_(members, members)
            lengths_m[block] = np.minimum(lengths_m[block], _apart_m(points, members, self._unknown_m))
        np.fill_diagonal(lengths_m, inf)
        rows, columns = np.nonzero(np.isfinite(lengths_m))
        return csr_array((lengths_m[rows, columns], (rows, columns)), shape=(count, count))


def _apart_m(points: NDArray[np.float64], members: Sequence[int], unknown_m: float) -> NDArray[np.float64]:
    """(M, M) distances between (D, 2) ``points``; never 0, which the search would read as no link."""
    offsets = points[members][:, None, :] - points[members][None, :, :]
    apart_m = np.maximum(np.hypot(offsets[..., 0], offsets[..., 1]), 1e-6)
    return np.where(np.isnan(apart_m), unknown_m, apart_m)
