"""Openings as high as the walls: where one room ends and the next begins without a lintel to tell.

A slice above the doors sees straight through such an opening, and two rooms look like one. What gives it away is that
the wall is thin: right behind it, to the side of the opening, there is free space again. Behind the corner of an
L-shaped room there is none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.geometry.runs import runs
from perception.localization.doorways import DoorSizes
from perception.rooms.views.facets import Facets
from perception.rooms.views.line_profile import LineProfile, end_of_wall
from perception.rooms.views.view import View

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class PortalSettings:
    """Which gaps in walls are openings to other rooms."""

    behind_m: tuple[float, ...] = (0.5, 0.6, 0.7, 0.8)
    """Where behind a wall free space is looked for: behind walls up to 0.45 m thick."""
    beside_m: tuple[float, ...] = (0.06, 0.12, 0.2, 0.3, 0.4)
    """And how far beside the gap. Chosen: rays through the gap do not reach farther."""
    least_seen: int = 2
    """Of these places, seen to be free. Chosen: one may be chance."""
    narrowest_m: float = DoorSizes.narrowest_m
    """What is narrower leads nowhere."""
    vague: int = 4
    """Stations at the end of a wall in which normals are vague. Chosen."""
    corner_m: float = 0.15
    """So near to a gap's end a wall across comes up to it. Chosen: one and a half stations."""
    clear_m: float = 0.1
    """Returns of it nearer to the wall are of the wall's own end."""
    returns_of_wall: int = 5
    """That make a wall across. Chosen."""
    of_a_door_m: float = 1.4
    """Widest gap that is a door's: the widest door and a station."""
    at_a_corner_m: float = 1.0
    """The same for one that goes on to a wall across, as the way round a corner does."""
    firm: int = 3
    """Stations that make wall beside a gap sure. Chosen: fewer may be the end of one across."""
    of_the_wall: float = 0.8
    """Share of a wall that a wider gap, framed on both sides, may take. Chosen: some of the wall must be left."""


@dataclass(frozen=True, kw_only=True)
class Portal:
    """An opening in the wall at ``offset_m`` across ``axis``, from ``low_m`` to ``high_m`` along it."""

    axis: int
    offset_m: float
    low_m: float
    high_m: float

    def covers(self, start_m: float, end_m: float) -> bool:
        """Whether most of a stretch along the wall lies in the opening."""
        shared_m = min(self.high_m, end_m) - max(self.low_m, start_m)
        return shared_m > 0.6 * (end_m - start_m)


def find_portals(
    views: Sequence[View],
    profile: LineProfile,
    facets: Facets,
    crossing: Facets,
    *,
    blocked: float,
    gate_m: float,
    settings: PortalSettings = PortalSettings(),
) -> list[Portal]:
    """Gaps in walls behind which, beside the gap, free space was seen.

    ``facets`` face along the profile's axis, ``crossing`` the other.
    """
    told, ends, step_m = profile.told, profile.wall(blocked), profile.settings.station_step_m
    portals: list[Portal] = []
    for k, offset in enumerate(profile.lines):
        on_line = facets.near(float(offset), gate_m)
        across = crossing.between(float(offset) - gate_m, float(offset) + gate_m)
        crossing_returns = _returns(across.offset_m, profile.stations, step_m)
        wall = ends[k] & (_returns(on_line.station_m, profile.stations, step_m) > crossing_returns)
        crossed = crossing_returns >= settings.returns_of_wall
        for first, last in runs(told[k] & ~ends[k]):
            before = _stub(wall[:first], settings, wall_first=True)
            after = _stub(wall[last:], settings, wall_first=False)
            low, high = first - before.vague, last + after.vague
            low_m, high_m = profile.stations[[low, high - 1]] + np.array([-0.5, 0.5]) * step_m
            portal = Portal(
                axis=profile.axis,
                offset_m=float(offset),
                low_m=_end(on_line, float(low_m), profile.settings.end_m, wall_first=True),
                high_m=_end(on_line, float(high_m), profile.settings.end_m, wall_first=False),
            )
            opening = _Opening.of(first, last, before, after, wall=wall, crossed=crossed)
            if not opening.narrow(wall, step_m, settings):
                continue
            if any(
                _thin(views, portal, side, stub.count * step_m - step_m / 2.0, towards, gate_m, settings)
                for stub, towards, side in (
                    (before, profile.faces(k, slice(low - before.count, low)), -1.0),
                    (after, profile.faces(k, slice(high, high + after.count)), 1.0),
                )
                if not _at_corner(crossing, portal, side, towards, profile.settings.end_m, settings)
            ):
                portals.append(portal)
    return portals


def _at_corner(
    crossing: Facets, portal: Portal, side: float, towards: float, end_m: float, settings: PortalSettings
) -> bool:
    """Whether another wall comes up to the gap's end from where the gap is seen: then it is a corner, and what goes on
    behind it another room's wall.
    """
    edge_m = portal.low_m if side < 0.0 else portal.high_m
    before_m = (crossing.station_m - portal.offset_m) * towards
    near = np.abs(crossing.offset_m - edge_m) < settings.corner_m
    near &= (before_m > -end_m) & (before_m < -settings.clear_m)
    return bool(near.sum() >= settings.returns_of_wall)


def _leading(mask: Mask) -> int:
    """How many of the first entries are true."""
    return len(mask) if mask.all() else int(np.argmin(mask))


def _end(on_line: Facets, about_m: float, end_m: float, *, wall_first: bool) -> float:
    """Where the wall beside a gap ends: at its last return, else at the gap."""
    found_m = end_of_wall(on_line, about_m, wall_first=wall_first, end_m=end_m)
    return about_m if found_m is None else found_m


def _returns(at_m: Array, stations: Array, step_m: float) -> Array:
    """(S,) how many returns lie at each station."""
    edges = np.append(stations - step_m / 2.0, stations[-1] + step_m / 2.0)
    return np.histogram(at_m, edges)[0]


@dataclass(frozen=True, kw_only=True)
class _Stub:
    """Wall beside a gap, in stations: how many are ``vague`` between the two, and how many are wall.

    ``firm``: it is wall for sure, and not only the end of another one that comes up to the gap.
    """

    vague: int
    count: int
    firm: bool


def _stub(wall: Mask, settings: PortalSettings, *, wall_first: bool) -> _Stub:
    """The wall that ends, or else begins, at a gap. At its very end normals are vague, and rays that graze its line
    may as well have ended on the next wall behind it.
    """
    away = wall[::-1] if wall_first else wall
    begins = np.flatnonzero(away[: settings.vague])
    if len(begins) == 0:
        return _Stub(vague=0, count=0, firm=False)
    count = _leading(away[begins[0] :])
    return _Stub(vague=int(begins[0]), count=count, firm=count >= settings.firm)


@dataclass(frozen=True, kw_only=True)
class _Opening:
    """What a gap opens, seen or not, from wall to wall: stations ``first`` to ``last``.

    ``bend``: it goes on to a wall across, as the way round a corner does, which is hardly narrower than a corridor.
    ``framed``: there is wall on both its sides.
    """

    first: int
    last: int
    bend: bool
    framed: bool

    @classmethod
    def of(cls, first: int, last: int, before: _Stub, after: _Stub, *, wall: Mask, crossed: Mask) -> _Opening:
        """Of the gap from station ``first`` to ``last`` between two stubs, in a line that is ``wall`` and ``crossed``
        by walls at these stations (S,).
        """
        ends = wall | crossed
        least = first if before.firm else first - _leading(~ends[:first][::-1])
        most = last if after.firm else last + _leading(~ends[last:])
        bends_before = not before.firm and (least == 0 or not wall[least - 1])
        bends_after = not after.firm and (most == len(wall) or not wall[most])
        return cls(first=least, last=most, bend=bends_before or bends_after, framed=before.firm and after.firm)

    def narrow(self, wall: Mask, step_m: float, settings: PortalSettings) -> bool:
        """Whether it is no wider than a door, or is framed and leaves enough of the ``wall`` (S,)."""
        width_m = (self.last - self.first) * step_m
        if width_m < settings.narrowest_m:
            return False
        if width_m <= (settings.at_a_corner_m if self.bend else settings.of_a_door_m):
            return True
        beside_m = (wall[: self.first].sum() + wall[self.last :].sum()) * step_m
        return bool(self.framed and width_m <= settings.of_the_wall * (width_m + beside_m))


def _thin(
    views: Sequence[View],
    portal: Portal,
    side: float,
    stub_m: float,
    towards: float,
    margin_m: float,
    settings: PortalSettings,
) -> bool:
    """Whether the wall of ``stub_m`` at one end of a gap is so thin that free space was seen right behind it."""
    if towards == 0.0:
        return False
    edge = portal.low_m if side < 0.0 else portal.high_m
    beside_m = [one for one in settings.beside_m if one < stub_m]
    if not beside_m:
        return False
    behind, beside = (grid.ravel() for grid in np.meshgrid(settings.behind_m, beside_m, indexing="ij"))
    points = np.empty((len(behind), 2))
    points[:, portal.axis] = portal.offset_m + towards * behind
    points[:, 1 - portal.axis] = edge + side * beside
    seen = np.zeros(len(points))
    for view in views:
        with np.errstate(invalid="ignore"):
            seen += view.beyond(points)[0] > margin_m
    return bool((seen > 0).sum() >= settings.least_seen)
