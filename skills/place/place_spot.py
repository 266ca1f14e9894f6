"""Free spots for what the hand holds: on a support's top, on the boards of a shelf, in a container."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ObjectNode
from scene_graph.snapshot import Snapshot
from skills.anchor import Anchor
from skills.arm.hand import Hand, Size3
from skills.arm.way_in import BOTH_SIDES, bars_way_to, open_sides
from skills.furniture.furniture import Entry, Furniture, Surface
from skills.furniture.standing import extent_on, stands_at, surfaces_of
from skills.geometry import Points
from skills.outline import Outline, disc, turned
from skills.place.settings import SpotSettings


@dataclass(frozen=True, kw_only=True)
class Spot:
    """Where to put something down: a point on a surface, tied to what carries it, and how free it is there.

    ``room_m``: air to the nearest neighbor; ``edge_m``: what is left between the thing and the edge, of which nobody
    knows to the centimeter where it is. Below a board the hand comes in across one of the ``sides`` of the support.
    ``bars``: how many things on the board it would bar the hand's way to.
    ``turn_rad``: where the long side of the thing must point, in the frame of what carries it; ``None`` where any turn
    does.
    """

    anchor: Anchor
    room_m: float
    edge_m: float = np.inf
    turn_rad: float | None = None
    surface: Surface = field(default_factory=Surface)
    sides: tuple[int, ...] = BOTH_SIDES
    bars: int = 0

    @property
    def air_m(self) -> float:
        """What there is around the thing before it meets a neighbor or the edge."""
        return min(self.room_m, self.edge_m)

    @property
    def is_covered(self) -> bool:
        """Whether there is a board above."""
        return self.surface.is_covered

    @property
    def inside(self) -> bool:
        """Whether the thing is dropped into a container, from above its rim."""
        return self.surface.entry is Entry.RIM


def spots_on(
    snapshot: Snapshot,
    support_id: str,
    size_m: Size3,
    held: str | None,
    *,
    hand: Hand = Hand(),
    settings: SpotSettings = SpotSettings(),
    as_empty: bool = False,
) -> list[Spot]:
    """Free spots on ``support_id`` for an object of ``size_m``, the freest first; ``as_empty``: if nothing stood there.

    The object's outline is taken as the disc around its horizontal extent, so that any turn of it fits. Where nothing
    is free for that, an oblong one is laid along or across the support.
    """
    surfaces, spots = surfaces_of(snapshot, support_id, held), list[Spot]()
    for surface in surfaces:
        if surface.free_m > size_m[2]:
            others = [] if as_empty else stands_at(snapshot, support_id, surfaces, surface, held)
            spots += FreeSpace(snapshot, support_id, surface, others, hand, settings).spots(size_m)
    return sorted(spots, key=lambda spot: -min(spot.air_m, settings.ample_m))


@dataclass(frozen=True, eq=False)
class FreeSpace:
    """What ``others`` leave free of one surface of a support."""

    snapshot: Snapshot
    support_id: str
    surface: Surface
    others: Sequence[ObjectNode]
    hand: Hand
    settings: SpotSettings

    @cached_property
    def furniture(self) -> Furniture:
        """The support as the hand meets it."""
        return Furniture.of(self.snapshot.object(self.support_id))

    @cached_property
    def extents(self) -> list[tuple[Points, Points]]:
        """Middles (2,) and half extents (2,) of what stands there."""
        return [extent_on(self.snapshot, self.support_id, node) for node in self.others]

    def spots(self, size_m: Size3) -> list[Spot]:
        """Spots for a thing, in rows; the middle of what it is dropped into."""
        if self.surface.entry is Entry.RIM:
            anchor = Anchor(self.support_id, (0.0, 0.0, self.surface.height_m))
            return [Spot(anchor=anchor, room_m=0.0, surface=self.surface)]
        found = ([s for o in outlines for s in self._spots_for(o, step_m)] for outlines, step_m in self.laid(size_m))
        return next((spots for spots in found if spots), [])

    def laid(self, size_m: Size3) -> Iterator[tuple[tuple[Outline, ...], float]]:
        """The ways in which a thing may stand, and in steps of what length spots are looked for, the first choice
        first: turned anyhow before turned so that it fits, which the hand does to what it holds from above.
        """
        fitting: tuple[Outline, ...] = ()
        if not self.surface.is_covered and not self.hand.is_tall(size_m):
            fitting = tuple(turned(size_m, self.hand.geometry.finger_m))
        steps_m = (self.settings.step_m, self.settings.fine_step_m)
        both = ((disc(size_m),), fitting)
        yield from ((outlines, step_m) for outlines in both if outlines for step_m in steps_m)

    def _spots_for(self, outline: Outline, step_m: float) -> list[Spot]:
        points = self.lattice(outline, step_m)
        room, sides = self.room_m(points, outline), self.ways_in(points, outline)
        bars = np.zeros(len(points), np.int64)
        if self.surface.is_covered:
            bars = bars_way_to(self.furniture, points, outline.radius_m, self.extents, self.hand)
        edge = (self.furniture.half_m - np.abs(points) - outline.half_m).min(axis=1)
        return [
            Spot(
                anchor=Anchor(self.support_id, (float(points[i, 0]), float(points[i, 1]), self.surface.height_m)),
                room_m=float(room[i]),
                edge_m=float(edge[i]),
                turn_rad=outline.turn_rad,
                surface=self.surface,
                sides=tuple(side for side, is_open in zip(BOTH_SIDES, sides[i], strict=True) if is_open),
                bars=int(bars[i]),
            )
            for i in np.nonzero((room >= self.settings.gap_m) & sides.any(axis=1))[0]
        ]

    def ways_in(
        self, points: Points, outline: Outline, more: Sequence[tuple[Points, Points]] = ()
    ) -> NDArray[np.bool_]:
        """(N, 2): from which of the two sides the hand gets to the points (N, 2) on a board; from both, to a top.

        ``more``: middles (2,) and half extents (2,) of what is not there yet.
        """
        if not self.surface.is_covered:
            return np.ones((len(points), 2), dtype=bool)
        return open_sides(self.furniture, points, outline.radius_m, [*self.extents, *more], self.hand)

    def lattice(self, outline: Outline, step_m: float) -> Points:
        """Points (N, 2) about ``step_m`` apart, in rows, where a thing stands within the arm's reach, clear of arms and
        back, and below a board where the hand passes between the ends; none where it is too large.
        """
        furniture, settings, hand = self.furniture, self.settings, self.hand
        half = furniture.half_m - settings.edge_m - np.array(outline.half_m)
        if self.surface.is_covered:
            aside_m = hand.geometry.hand_half_width_m + hand.settings.beside_m
            half[furniture.long] = min(half[furniture.long], furniture.inner_half_m - aside_m)
        if (half < 0).any():
            return np.zeros((0, 2))
        half = np.maximum(half - furniture.rims_m, 0.0)
        low, high = self._before_backs(outline, -half, half)
        if (low > high).any():
            return np.zeros((0, 2))
        bounds = zip(low, high, strict=True)
        x, y = (np.linspace(a, b, int((b - a) / step_m) + 1) if b > a else np.array([a]) for a, b in bounds)
        points = np.stack([axis.ravel() for axis in np.meshgrid(x, y, indexing="ij")], axis=1)
        return np.asarray(points[(furniture.half_m - np.abs(points)).min(axis=1) <= settings.strip_m])

    def _before_backs(self, outline: Outline, low: Points, high: Points) -> tuple[Points, Points]:
        """Bounds (2,) of where a thing's middle may be, drawn in so that it stays clear of backs whose face was
        measured.
        """
        for rim in self.furniture.obstacles:
            if rim.is_measured:
                farthest_m = rim.half_m - rim.thick_m - self.settings.back_air_m - outline.half_m[rim.axis]
                along, toward = np.arange(2) == rim.axis, rim.sign > 0
                high = np.where(along & toward, np.minimum(high, farthest_m), high)
                low = np.where(along & (not toward), np.maximum(low, -farthest_m), low)
        return low, high

    def room_m(self, points: Points, outline: Outline) -> Points:
        """Air (N,) between a thing at points and the nearest of ``others``, at most 1 m."""
        room = np.full(len(points), 1.0)
        for node in self.others:
            T_support_node = self.snapshot.transform(self.support_id, node.id)
            middle, half_m = np.array(T_support_node.translation_m[:2]), np.array(node.size_m[:2]) / 2
            room = np.minimum(room, outline.gap_to_box_m(points, middle, half_m, T_support_node.yaw_rad))
        return room
