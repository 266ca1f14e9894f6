"""Which rooms are joined by doors, and where in their walls the doors are."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np

from simulation.generation.layouts import Plot, Site
from simulation.generation.tiles import Corner, Outline, Tile, inset, outline_of, sides


@dataclass(frozen=True, kw_only=True)
class Doorway:
    """A gap in the wall between two rooms, or of one room to the outside; millimeters.

    ``rooms``: two indices, or one. ``along_x``: the wall runs along x. ``at``: the middle of the wall, across it;
    ``middle``: of the gap, along it.
    """

    rooms: tuple[int, ...]
    along_x: bool
    at: int
    middle: int
    width: int

    @property
    def center(self) -> Corner:
        """The middle of the gap."""
        return (self.middle, self.at) if self.along_x else (self.at, self.middle)

    def gap(self, deep: int) -> Tile:
        """The ground of the gap and of what lies before it, ``deep`` across the wall in all."""
        x, y = (self.width, deep) if self.along_x else (deep, self.width)
        left, low = self.center[0] - x // 2, self.center[1] - y // 2
        return Tile(left, low, left + x, low + y)


@dataclass(frozen=True, kw_only=True)
class _Wall:
    """Where two rooms face each other across a wall, from ``start`` to ``end`` along it; or a wall of one room."""

    rooms: tuple[int, ...]
    along_x: bool
    at: int
    start: int
    end: int
    frame: int

    @property
    def room_for(self) -> int:
        """The widest door that fits between ``frame`` at either end."""
        return self.end - self.start - 2 * self.frame


def choose_doorways(site: Site, plots: Sequence[Plot], *, loops: bool) -> list[Doorway] | None:
    """Doors that join all rooms, in a tree or with loops, and now and then one to the outside; None if they cannot."""
    outlines = inner_outlines(plots, site.wall_mm)
    walls = list(_shared_walls(site, outlines))
    joined = _tree(site, plots, walls)
    if joined is None:
        return None
    doors: list[Doorway] = []
    for wall in joined + (_extra(site, plots, walls, joined) if loops else []):
        door = _placed(site, plots, wall, doors)
        if door is not None:
            doors.append(door)
    if loops and len(doors) < len(plots):
        return None
    if site.chance(0.5):
        doors += _front_door(site, plots, outlines)
    return doors


def inner_outlines(plots: Sequence[Plot], wall_mm: int) -> list[Outline]:
    """The inner faces of the rooms' walls."""
    outlines = (outline_of(plot.tiles) for plot in plots)
    return [inset(outline, wall_mm // 2) for outline in outlines if outline is not None]


def strangeness(plots: Sequence[Plot], doors: Iterable[Doorway]) -> int:
    """How much a plan makes people walk through rooms that are no passages; 0 in a good one."""
    ends = [room for door in doors if len(door.rooms) == 2 for room in door.rooms]
    return sum(plot.use.privacy * max(0, ends.count(index) - 1) for index, plot in enumerate(plots))


def _shared_walls(site: Site, outlines: Sequence[Outline]) -> Iterable[_Wall]:
    """All stretches of wall between two rooms that take a door."""
    faces = [list(_faces(outline)) for outline in outlines]
    for i, j in combinations(range(len(outlines)), 2):
        for along_x, outward, level, start, end in faces[i]:
            for other_along_x, _, other_level, other_start, other_end in faces[j]:
                if along_x == other_along_x and other_level - level == outward * site.wall_mm:
                    wall = _Wall(
                        rooms=(i, j),
                        along_x=along_x,
                        at=(level + other_level) // 2,
                        start=max(start, other_start),
                        end=min(end, other_end),
                        frame=site.settings.doorways.frame_mm,
                    )
                    if wall.room_for >= site.settings.doorways.narrowest_mm:
                        yield wall


def _faces(outline: Outline) -> Iterable[tuple[bool, int, int, int, int]]:
    """(runs along x, sign of the way out, level across, start, end) of each side."""
    for a, b in sides(outline):
        if a[1] == b[1]:
            yield True, -1 if b[0] > a[0] else 1, a[1], min(a[0], b[0]), max(a[0], b[0])
        else:
            yield False, 1 if b[1] > a[1] else -1, a[0], min(a[1], b[1]), max(a[1], b[1])


def _tree(site: Site, plots: Sequence[Plot], walls: Sequence[_Wall]) -> list[_Wall] | None:
    """Walls that join all rooms without a loop, through rooms that are passages rather than others.

    Kruskal's algorithm on privacy: a minimum spanning tree.
    """
    group = list(range(len(plots)))
    chosen = []
    for wall in _by_privacy(site, plots, walls):
        one, other = (group[room] for room in wall.rooms)
        if one != other:
            group = [one if number == other else number for number in group]
            chosen.append(wall)
    return chosen if len(chosen) == len(plots) - 1 else None


def _extra(site: Site, plots: Sequence[Plot], walls: Sequence[_Wall], joined: Sequence[_Wall]) -> list[_Wall]:
    """Walls for more doors: between rooms that have none in common, else a second one where there is one already."""
    pairs = {wall.rooms for wall in joined}
    count = 1 + int(site.generator.integers(0, 1 + len(plots) // 4))
    fresh: dict[tuple[int, ...], _Wall] = {}
    for wall in _by_privacy(site, plots, walls):
        if wall.rooms not in pairs:
            fresh.setdefault(wall.rooms, wall)
    for_two = 2 * site.settings.doorways.narrowest_mm + site.settings.doorways.between_doors_mm
    twice = [wall for wall in joined if wall.room_for >= for_two]
    twice.sort(key=lambda wall: -wall.room_for)
    if fresh and not site.chance(0.1):
        return list(fresh.values())[:count]
    return twice[:1] + list(fresh.values())[: count - 1]


def _by_privacy(site: Site, plots: Sequence[Plot], walls: Sequence[_Wall]) -> list[_Wall]:
    """The least private pairs of rooms first; dice decide between much the same, and long walls are better."""
    dice = site.generator.uniform(0.0, 1.5, size=len(walls))
    cost = [
        sum(plots[room].use.privacy for room in wall.rooms) + die - min(wall.room_for, 3000) / 2000
        for wall, die in zip(walls, dice, strict=True)
    ]
    return [walls[index] for index in np.argsort(cost, kind="stable")]


def _placed(site: Site, plots: Sequence[Plot], wall: _Wall, doors: Sequence[Doorway]) -> Doorway | None:
    """A door in that wall, beside those that are there; None when there is no place left."""
    public = len(wall.rooms) == 2 and all(plots[room].use.privacy <= 3 for room in wall.rooms)
    taken = [door for door in doors if door.rooms == wall.rooms]
    settings = site.settings.doorways
    for trial in range(settings.tries):
        width = _width(site, wall.room_for, wide=public and not taken and trial == 0)
        spare = wall.room_for - width
        share = site.generator.uniform()
        if site.chance(0.6):  # as architects do: just beside a corner, so that the wall stays free
            share = (0.0 if share < 0.5 else 1.0) + (0.5 - share) * min(1.0, 300 / max(spare, 1))
        start = wall.start + settings.frame_mm + round(float(np.clip(share, 0.0, 1.0)) * spare)
        middle = start + width // 2
        door = Doorway(rooms=wall.rooms, along_x=wall.along_x, at=wall.at, middle=middle, width=width)
        if not any(door.at == other.at and _near(door, other, settings.between_doors_mm) for other in taken):
            return door
    return None


def _width(site: Site, most: int, *, wide: bool) -> int:
    """A usual width in steps of a centimeter, now and then a wide opening."""
    usual = site.settings.doorways.narrowest_mm, site.settings.doorways.widest_mm
    opening = site.settings.doorways.widest_mm, site.settings.doorways.widest_opening_mm
    low, high = opening if wide and most > usual[1] and site.chance(0.3) else usual
    if high == usual[1] and site.chance(0.5):
        return min(900, most // 10 * 10)
    return int(site.generator.integers(low // 10, min(high, most) // 10 + 1)) * 10


def _near(door: Doorway, other: Doorway, between_mm: int) -> bool:
    return abs(door.middle - other.middle) < (door.width + other.width) / 2 + between_mm


def _front_door(site: Site, plots: Sequence[Plot], outlines: Sequence[Outline]) -> list[Doorway]:
    """One door from a passage or a public room into the open air, where there is a wall for it."""
    settings = site.settings.doorways
    rooms = sorted(range(len(plots)), key=lambda index: (plots[index].use.privacy, site.generator.random()))
    for index in rooms[:4]:
        for along_x, outward, level, start, end in _faces(outlines[index]):
            at = level + outward * (site.wall_mm // 2)
            wall = _Wall(rooms=(index,), along_x=along_x, at=at, start=start, end=end, frame=settings.frame_mm)
            door = _placed(site, plots, wall, []) if wall.room_for >= settings.narrowest_mm else None
            if door is not None and _leads_out(door, outward, plots, settings.porch_mm):
                return [door]
    return []


def _leads_out(door: Doorway, outward: int, plots: Sequence[Plot], porch_mm: int) -> bool:
    """Whether nothing is built before the door."""
    porch = replace(door, at=door.at + outward * (porch_mm // 2 + 1)).gap(porch_mm)
    return not any(porch.overlaps(tile) for plot in plots for tile in plot.tiles)
