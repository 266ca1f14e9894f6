"""What is true between the things of a picture, from geometry: for scoring networks, and for training them.

Predicates: on, in, beside, in front of, over, under, attached to, holding. A pair has at most one; what carries, holds
or contains says more than where something merely is, and comes first. *In front of* is meant from the viewer's place,
as in the PSG dataset; the others hold from everywhere.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

PREDICATES = ("on", "in", "beside", "in front of", "over", "under", "attached to", "holding")


@dataclass(frozen=True, kw_only=True)
class RelationSettings:
    """What is called how; chosen, as people label pictures."""

    beside_m: float = 0.3
    """Between things that stand beside each other."""
    beside_furniture_m: float = 0.5
    level_m: float = 0.12
    """And their bottoms are no farther apart."""
    before_m: tuple[float, float] = (0.15, 1.2)
    """How much nearer to the viewer something is that stands in front of something else."""
    before_share: float = 0.5
    """And it hides so much of the width of the narrower of both."""
    covered: float = 0.5
    """Share of a footprint that lies over or under something."""
    hangs_at_most_m: float = 1.5
    """So far above something what hangs is still over it."""
    clear_m: float = 0.02
    """What is closer touches."""


@dataclass(frozen=True, kw_only=True)
class Solid:
    """A thing with its box in house coordinates: center (3,), full size (3,), turned by ``yaw_rad``.

    ``on``, ``inside``, ``held_by``, ``attached_to``: index of what carries, contains, holds or bears it.
    ``furniture``: it stands where it is.
    """

    center_m: tuple[float, float, float]
    size_m: tuple[float, float, float]
    yaw_rad: float
    furniture: bool
    on: int | None = None
    inside: int | None = None
    held_by: int | None = None
    attached_to: int | None = None

    @property
    def bottom_m(self) -> float:
        return self.center_m[2] - self.size_m[2] / 2

    @property
    def top_m(self) -> float:
        return self.center_m[2] + self.size_m[2] / 2


@dataclass(frozen=True, kw_only=True)
class Seen:
    """Where a thing is in the picture: its box (left, top, right, bottom) in pixels, and its distance in meters."""

    box_px: tuple[float, float, float, float]
    distance_m: float


Relation = tuple[int, str, int]


def true_relations(
    solids: Sequence[Solid], seen: Sequence[Seen | None], settings: RelationSettings = RelationSettings()
) -> tuple[Relation, ...]:
    """(subject, predicate, object) by index, for what is seen; ``beside`` is given once, its left thing first."""
    found = list(_contacts(solids, seen))
    related = {frozenset((subject, other)) for subject, _, other in found}
    geometry = _Geometry(solids, seen, settings)
    visible = [index for index, place in enumerate(seen) if place is not None]
    for number, a in enumerate(visible):
        for b in visible[number + 1 :]:
            if frozenset((a, b)) not in related:
                relation = geometry.between(a, b) or geometry.between(b, a) or geometry.beside(a, b)
                found += [relation] if relation else []
    return tuple(found)


def _contacts(solids: Sequence[Solid], seen: Sequence[Seen | None]) -> Iterator[Relation]:
    for index, solid in enumerate(solids):
        bearers = (
            ("holding", solid.held_by),
            ("in", solid.inside),
            ("on", solid.on),
            ("attached to", solid.attached_to),
        )
        for predicate, other in bearers:
            if other is not None and seen[index] is not None and seen[other] is not None:
                yield (other, predicate, index) if predicate == "holding" else (index, predicate, other)
                break


class _Geometry:
    """How things lie to each other, where nothing carries them."""

    def __init__(self, solids: Sequence[Solid], seen: Sequence[Seen | None], settings: RelationSettings) -> None:
        self._solids, self._seen, self._settings = solids, seen, settings

    def between(self, a: int, b: int) -> Relation | None:
        """How ``a`` lies to ``b``, where that is not the same seen from ``b``."""
        one, two, settings = self._solids[a], self._solids[b], self._settings
        if _share_below(one, two) >= settings.covered:
            hangs = one.attached_to is not None or one.held_by is not None
            if hangs and 0.0 < one.bottom_m - two.top_m + settings.clear_m <= settings.hangs_at_most_m:
                return (a, "over", b)
            low = one.bottom_m < settings.clear_m and one.center_m[2] < two.top_m - settings.clear_m
            if two.furniture and low:
                return (a, "under", b)
        hides = self._hides(self._seen[a], self._seen[b])
        return (a, "in front of", b) if hides and not self._stacked(one, two) else None

    def beside(self, a: int, b: int) -> Relation | None:
        """The left one beside the other, on the same level."""
        one, two, settings = self._solids[a], self._solids[b], self._settings
        if (one.on, one.inside, one.held_by) != (two.on, two.inside, two.held_by) or one.furniture != two.furniture:
            return None
        if one.held_by is not None or one.attached_to is not None or two.attached_to is not None:
            return None
        limit_m = settings.beside_furniture_m if one.furniture else settings.beside_m
        if abs(one.bottom_m - two.bottom_m) > settings.level_m or _gap_m(one, two) > limit_m:
            return None
        left_a, left_b = self._seen[a], self._seen[b]
        assert left_a is not None
        assert left_b is not None
        first_a = left_a.box_px[0] + left_a.box_px[2] <= left_b.box_px[0] + left_b.box_px[2]
        return (a, "beside", b) if first_a else (b, "beside", a)

    def _stacked(self, one: Solid, two: Solid) -> bool:
        """Whether the two are on different levels, so that neither stands before the other."""
        clear_m = self._settings.clear_m
        return one.bottom_m > two.top_m - clear_m or two.bottom_m > one.top_m - clear_m

    def _hides(self, near: Seen | None, far: Seen | None) -> bool:
        """Whether the picture shows ``near`` before ``far``: boxes touch, much of the narrower before the other."""
        low_m, high_m = self._settings.before_m
        if near is None or far is None or not low_m <= far.distance_m - near.distance_m <= high_m:
            return False
        (left, top, right, bottom), (left_2, top_2, right_2, bottom_2) = near.box_px, far.box_px
        shared = min(right, right_2) - max(left, left_2)
        least = self._settings.before_share * min(right - left, right_2 - left_2)
        return shared >= least and min(bottom, bottom_2) >= max(top, top_2)


def _share_below(one: Solid, two: Solid) -> float:
    """Share of the footprint of ``one`` that lies within the footprint of ``two``, on a grid of 5 x 5 points."""
    steps = np.linspace(-0.4, 0.4, 5)
    x, y = np.meshgrid(steps * one.size_m[0], steps * one.size_m[1])
    points = _turned(np.stack((x.ravel(), y.ravel()), axis=1), one.yaw_rad)
    points += np.subtract(one.center_m[:2], two.center_m[:2])
    inside = np.abs(_turned(points, -two.yaw_rad)) <= np.asarray(two.size_m[:2]) / 2
    return float(inside.all(axis=1).mean())


def _gap_m(one: Solid, two: Solid) -> float:
    """Between two upright boxes seen from above: the widest of the four directions of their sides."""
    offset = np.subtract(two.center_m[:2], one.center_m[:2])
    widest = -math.inf
    for yaw_rad in (one.yaw_rad, one.yaw_rad + math.pi / 2, two.yaw_rad, two.yaw_rad + math.pi / 2):
        axis = np.array([math.cos(yaw_rad), math.sin(yaw_rad)])
        widest = max(widest, abs(float(offset @ axis)) - _half_along(one, axis) - _half_along(two, axis))
    return widest


def _half_along(solid: Solid, axis: NDArray[np.float64]) -> float:
    turn_rad = math.atan2(axis[1], axis[0]) - solid.yaw_rad
    return (abs(math.cos(turn_rad)) * solid.size_m[0] + abs(math.sin(turn_rad)) * solid.size_m[1]) / 2


def _turned(points: NDArray[np.float64], yaw_rad: float) -> NDArray[np.float64]:
    cos, sin = math.cos(yaw_rad), math.sin(yaw_rad)
    turned: NDArray[np.float64] = points @ np.array([[cos, sin], [-sin, cos]])
    return turned
