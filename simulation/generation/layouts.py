"""Where the rooms lie: along a corridor, around a hall, on several corridors, or by splitting a rectangle.

A layout is drawn by dice and may not come out: then it is None, and another one is drawn.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from itertools import accumulate, pairwise

import numpy as np

from simulation.generation.programs import CORRIDOR, HALL, Use, Wish, draw_program
from simulation.generation.settings import PlanSettings
from simulation.generation.tiles import Tile, area, narrowest


@dataclass(frozen=True, kw_only=True)
class Plot:
    """The ground of one room, to the middle of its walls."""

    use: Use
    tiles: tuple[Tile, ...]


@dataclass(frozen=True, kw_only=True)
class Site:
    """What the layouts of one building share. ``wall_mm``: thickness of its walls. ``office``: people work there."""

    generator: np.random.Generator
    wall_mm: int
    office: bool
    settings: PlanSettings = field(default_factory=PlanSettings)

    def between(self, low_m: float, high_m: float) -> int:
        """A random clear width, with half a wall on either side, in millimeters."""
        return round(1000 * self.generator.uniform(low_m, high_m)) + self.wall_mm

    def chance(self, share: float) -> bool:
        """True that often."""
        return bool(self.generator.random() < share)

    def program(self, rooms: int) -> list[Wish]:
        """A mix of that many rooms, corridors not among them."""
        return draw_program(self.generator, rooms, office=self.office)

    def corridor_width(self) -> int:
        """As in homes or in offices."""
        return self.between(1.2, 2.4 if self.office else 1.6)


Layout = Callable[[Site, int], list[Plot] | None]
"""Draws that many rooms, those between rooms included."""


def fits(plot: Plot, site: Site) -> bool:
    """Whether the ground suits the use: wide enough, not too long, slim or large."""
    wall_mm, settings = site.wall_mm, site.settings.layout
    left, low = min(t.left for t in plot.tiles), min(t.low for t in plot.tiles)
    right, high = max(t.right for t in plot.tiles), max(t.high for t in plot.tiles)
    short_m, long_m = (extent / 1000 for extent in sorted((right - left - wall_mm, high - low - wall_mm)))
    if plot.use is CORRIDOR:
        return (narrowest(plot.tiles) - wall_mm) / 1000 >= CORRIDOR.width_m and long_m <= settings.longest_corridor_m
    fair = short_m >= plot.use.width_m and long_m <= min(settings.longest_m, settings.slimmest * short_m)
    return fair and area(plot.tiles) / 1e6 <= 1.7 * plot.use.area_m2[1]


def split_layout(site: Site, rooms: int) -> list[Plot] | None:
    """A rectangle, split again and again: a small apartment."""
    wishes = site.program(rooms)
    total_m2 = sum(wish.area_m2 for wish in wishes) * 1.1
    ratio = site.generator.uniform(1.0, 1.9)
    width, height = (round(1000 * (total_m2 * r) ** 0.5) + site.wall_mm for r in (ratio, 1 / ratio))
    return _split(site, Tile(0, 0, width, height), wishes)


def corridor_layout(site: Site, rooms: int) -> list[Plot] | None:
    """A corridor with rooms on one side or on both, now and then one at its end."""
    wishes = site.program(rooms - 1)
    wide = site.corridor_width()
    end = wishes.pop() if len(wishes) > 3 and wishes[-1].use.privacy < 8 and site.chance(0.4) else None
    one_sided = len(wishes) <= 3 and site.chance(0.4)
    south, north = (wishes, []) if one_sided else _dealt(wishes, 2)
    south_deep, north_deep = site.between(2.8, 5.2), site.between(2.8, 5.2)
    long = round((_wanted(south, south_deep) + _wanted(north, north_deep)) / (1 if one_sided else 2))
    corridor = Plot(use=CORRIDOR, tiles=(Tile(0, 0, long, wide),))
    rows = (
        _row(south, Tile(0, -south_deep, long, 0), site.wall_mm),
        _row(north, Tile(0, wide, long, wide + north_deep), site.wall_mm),
    )
    low = -south_deep if site.chance(0.6) else 0
    high = wide if one_sided or (low < 0 and site.chance(0.4)) else wide + north_deep
    at_end = [] if end is None else _row([end], Tile(long, low, long + _deep(end, high - low), high), site.wall_mm)
    return _together([corridor], (*rows, at_end))


def hall_layout(site: Site, rooms: int) -> list[Plot] | None:
    """Rooms on two to four sides of a hall."""
    wishes = site.program(rooms - 1)
    wide, high = site.between(3.5, min(9.0, 4.5 + rooms / 2)), site.between(2.8, min(6.5, 3.5 + rooms / 3))
    at_west = [wishes.pop() for _ in range(round(high / 3300)) if len(wishes) > 2 and site.chance(0.8)]
    at_east = [wishes.pop() for _ in range(round(high / 3300)) if len(wishes) > 2 and site.chance(0.8)]
    west = -site.between(2.6, 4.5) if at_west else 0
    east = wide + (site.between(2.6, 4.5) if at_east else 0)
    south, north = _dealt(wishes, 2)
    south_deep, north_deep = site.between(2.8, 5.0), site.between(2.8, 5.0)
    strips = (
        _row(south, Tile(west, -south_deep, east, 0), site.wall_mm),
        _row(north, Tile(west, high, east, high + north_deep), site.wall_mm),
        _column(at_west, Tile(west, 0, 0, high), site.wall_mm),
        _column(at_east, Tile(wide, 0, east, high), site.wall_mm),
    )
    return _together([Plot(use=HALL, tiles=(Tile(0, 0, wide, high),))], strips)


def wings_layout(site: Site, rooms: int) -> list[Plot] | None:
    """Two or three long corridors with rooms on both sides, joined by a short one at one end."""
    return _wings(site, rooms, long_ones=3 if rooms > 20 and site.chance(0.5) else 2, ring=False)


def ring_layout(site: Site, rooms: int) -> list[Plot] | None:
    """Corridors all around a block of rooms, with more rooms outside."""
    return _wings(site, rooms, long_ones=2, ring=True)


def _wings(site: Site, rooms: int, *, long_ones: int, ring: bool) -> list[Plot] | None:
    wishes = site.program(rooms - long_ones - (2 if ring else 1))
    between = [2 if len(wishes) >= 8 * long_ones or site.chance(0.4) else 1 for _ in range(long_ones - 1)]
    rows = _dealt(wishes, 2 + sum(between))
    depths = [site.between(2.8, 5.0) for _ in rows]
    cross = site.corridor_width()
    long = round(sum(map(_wanted, rows, depths)) / len(rows))
    east = long + cross if ring else long
    plots = []
    strips = [_row(rows[0], Tile(-cross, -depths[0], east, 0), site.wall_mm)]
    y, row = 0, 1
    for inner in (*between, 0):
        wide = site.corridor_width()
        plots.append(Plot(use=CORRIDOR, tiles=(Tile(0, y, long, y + wide),)))
        y += wide
        for _ in range(inner):
            strips.append(_row(rows[row], Tile(0, y, long, y + depths[row]), site.wall_mm))
            y, row = y + depths[row], row + 1
    strips.append(_row(rows[row], Tile(-cross, y, east, y + depths[row]), site.wall_mm))
    plots.append(Plot(use=CORRIDOR, tiles=(Tile(-cross, 0, 0, y),)))
    if ring:
        plots.append(Plot(use=CORRIDOR, tiles=(Tile(long, 0, east, y),)))
    return _together(plots, strips)


def _split(site: Site, ground: Tile, wishes: Sequence[Wish]) -> list[Plot] | None:
    """Shares of the ground in proportion to the areas, cut across its longer side more often than not."""
    if len(wishes) == 1:
        plot = Plot(use=wishes[0].use, tiles=(ground,))
        return [plot] if fits(plot, site) else None
    for _ in range(site.settings.layout.tries):
        parted = int(site.generator.integers(1, len(wishes)))
        share = _area_m2(wishes[:parted]) / _area_m2(wishes)
        if (ground.width > ground.height) == site.chance(0.85):
            cut = ground.left + round(share * ground.width)
            grounds = ground._replace(right=cut), ground._replace(left=cut)
        else:
            cut = ground.low + round(share * ground.height)
            grounds = ground._replace(high=cut), ground._replace(low=cut)
        first = _split(site, grounds[0], wishes[:parted])
        second = first and _split(site, grounds[1], wishes[parted:])
        if first and second:
            return first + second
    return None


def _together(plots: list[Plot], strips: Sequence[list[Plot] | None]) -> list[Plot] | None:
    """All of them, or None when a strip did not come out."""
    for strip in strips:
        if strip is None:
            return None
        plots = plots + strip
    return plots


def _dealt(wishes: Sequence[Wish], rows: int) -> list[list[Wish]]:
    """The rooms on rows of about the same total area, in their order."""
    dealt: list[list[Wish]] = [[] for _ in range(rows)]
    for wish in wishes:
        min(dealt, key=_area_m2).append(wish)
    return dealt


def _area_m2(wishes: Sequence[Wish]) -> float:
    return sum(wish.area_m2 for wish in wishes)


def _wanted(row: Sequence[Wish], deep: int) -> float:
    """Millimeters of a row in which every room has its area."""
    return _area_m2(row) * 1e6 / deep


def _deep(wish: Wish, wide: int) -> int:
    """Millimeters that give a room of that width its area."""
    return round(wish.area_m2 * 1e6 / wide)


def _row(wishes: Sequence[Wish], strip: Tile, wall_mm: int) -> list[Plot] | None:
    """Rooms side by side along x, filling the strip; none for no wishes."""
    cuts = _cuts(wishes, strip.left, strip.right, wall_mm)
    return _plots(wishes, None if cuts is None else [strip._replace(left=a, right=b) for a, b in pairwise(cuts)])


def _column(wishes: Sequence[Wish], strip: Tile, wall_mm: int) -> list[Plot] | None:
    """Rooms one above the other along y, filling the strip; none for no wishes."""
    cuts = _cuts(wishes, strip.low, strip.high, wall_mm)
    return _plots(wishes, None if cuts is None else [strip._replace(low=a, high=b) for a, b in pairwise(cuts)])


def _plots(wishes: Sequence[Wish], tiles: Sequence[Tile] | None) -> list[Plot] | None:
    if tiles is None:
        return None
    return [Plot(use=wish.use, tiles=(tile,)) for wish, tile in zip(wishes, tiles, strict=True)]


def _cuts(wishes: Sequence[Wish], start: int, end: int, wall_mm: int) -> list[int] | None:
    """Where the rooms begin and end: shares in proportion to the areas, but none below its use's width."""
    if not wishes:
        return []
    least = [round(1000 * wish.use.width_m) + wall_mm for wish in wishes]
    free, scale = set(range(len(wishes))), 0.0
    while free:
        taken = sum(least[i] for i in range(len(wishes)) if i not in free)
        scale = (end - start - taken) / sum(wishes[i].area_m2 for i in free)
        tight = {i for i in free if scale * wishes[i].area_m2 < least[i]}
        if not tight:
            break
        free -= tight
    if not free:
        return None
    lengths = [scale * wish.area_m2 if i in free else least[i] for i, wish in enumerate(wishes)]
    return [start, *(start + round(length) for length in accumulate(lengths[:-1])), end]
