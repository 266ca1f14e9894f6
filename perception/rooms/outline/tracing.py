"""The boundary of the cells of a room: from an arrangement of lines to a polygon."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from perception.geometry.polygon import signed_area
from perception.rooms.outline.arrangement import Arrangement

Array = NDArray[np.float64]


def trace(arrangement: Arrangement) -> Array:
    """Outer boundary of the inside cells, (N, 2) counter-clockwise, without corners in straight walls."""
    following = _boundary_steps(arrangement.inside)
    loops: list[list[tuple[int, int]]] = []
    while following:
        start = min(following)
        loops.append(_walk(following, start))
    xs, ys = arrangement.xs, arrangement.ys
    polygons = [np.array([(xs[i], ys[j]) for i, j in _without_straight(loop)]) for loop in loops]
    return max(polygons, key=signed_area)


def _boundary_steps(inside: NDArray[np.bool_]) -> dict[tuple[int, int], list[tuple[int, int]]]:
    """Directed steps between grid vertices that keep inside cells on their left."""
    steps: dict[tuple[int, int], list[tuple[int, int]]] = {}
    padded = np.pad(inside, 1)
    for i, j in zip(*np.nonzero(inside), strict=True):
        a, b = int(i), int(j)
        if not padded[a + 1, b]:
            steps.setdefault((a, b), []).append((a + 1, b))
        if not padded[a + 2, b + 1]:
            steps.setdefault((a + 1, b), []).append((a + 1, b + 1))
        if not padded[a + 1, b + 2]:
            steps.setdefault((a + 1, b + 1), []).append((a, b + 1))
        if not padded[a, b + 1]:
            steps.setdefault((a, b + 1), []).append((a, b))
    return steps


def _walk(following: dict[tuple[int, int], list[tuple[int, int]]], start: tuple[int, int]) -> list[tuple[int, int]]:
    """Follow and use up steps from ``start`` until back; where two loops touch in a point, turn left."""
    loop, here, heading = [start], start, (0, 0)
    while True:
        choices = following[here]
        turns = [heading[0] * (c[1] - here[1]) - heading[1] * (c[0] - here[0]) for c in choices]
        step = choices.pop(turns.index(max(turns)))
        if not choices:
            del following[here]
        heading, here = (step[0] - here[0], step[1] - here[1]), step
        if here == start:
            return loop
        loop.append(here)


def _without_straight(loop: list[tuple[int, int]]) -> list[tuple[int, int]]:
    kept: list[tuple[int, int]] = []
    for before, here, after in zip(loop[-1:] + loop[:-1], loop, loop[1:] + loop[:1], strict=True):
        if (here[0] - before[0]) * (after[1] - here[1]) != (here[1] - before[1]) * (after[0] - here[0]):
            kept.append(here)
    return kept
