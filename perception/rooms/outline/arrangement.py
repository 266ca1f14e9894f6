"""Arrangement of wall lines into cells, and which cells are the room (extends Concepts beyond rectangles).

All wall lines of a rectilinear room, taken across the whole plane, cut it into cells. A cell belongs to the room when
rays have passed through most of it, and when it can be reached from where the robot stands without passing a stretch
of line that more rays end on than pass: the lintel above an open door is one, which keeps the next room out. Openings
as high as the walls are told by ``portals``.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.runs import runs
from perception.rooms.outline.cells import cell_of, flood, slits, thin, without_crannies
from perception.rooms.outline.portals import Portal, PortalSettings, find_portals
from perception.rooms.views.facets import Facets
from perception.rooms.views.line_profile import LineProfile, LineProfileSettings, end_of_wall
from perception.rooms.views.view import View

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


@dataclass(frozen=True, kw_only=True)
class ArrangementSettings:
    """Which lines and cells there are, and which of them are walls and room."""

    gate_m: float = 0.06
    """Returns this near to a line support it: three standard deviations of the usual range noise."""
    shortest_wall_m: float = 0.2
    """Least supported length of a line. Chosen: that of a narrow nook's back."""
    separation_m: float = 0.09
    """Nearer parallel lines are one: one and a half gates."""
    blocked: float = 0.2
    """Share of rays ending at a place on a line that make it wall there; low, as most rays pass below a low lintel."""
    wall: float = 0.5
    """Share of a stretch that must be wall to block it. Chosen: most of it."""
    free: float = 0.5
    """Share of a cell that must have been seen through. Chosen: most of it."""
    free_thin: float = 0.2
    """The same of a thin one, as tall furniture then hides most of it."""
    thin_m: float = 1.0
    """What is thinner is thin. Chosen: less than twice a wardrobe."""
    free_margin_m: float = 0.06
    """How far beyond a place a ray must go to have seen through it: a gate."""
    views: int = 24
    """How many of the views are asked. Chosen: for speed."""
    narrowest_m: float = 0.4
    """What is narrower is no part of the room, but a door's reveal, or the room behind half seen under its lintel."""
    run: int = 4
    """Stations of wall, and of opening beside it, that make an end of a wall. Chosen: less may be chance."""
    corner_gates: float = 4.0
    """Gates from which on a stretch is longer than its corners, so that rays that end in these tell nothing of it."""
    profile: LineProfileSettings = field(default_factory=LineProfileSettings)
    portals: PortalSettings = field(default_factory=PortalSettings)

    def for_noise(self, noise_m: float) -> ArrangementSettings:
        """Gates wide enough for ranges with this standard deviation."""
        gate_m = max(self.gate_m, 3.0 * noise_m)
        return replace(
            self,
            gate_m=gate_m,
            separation_m=max(self.separation_m, 1.5 * gate_m),
            free_margin_m=max(self.free_margin_m, gate_m),
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Arrangement:
    """Cells between the lines ``xs`` and ``ys`` (sorted, meters, axis-aligned frame).

    ``inside``: (len(xs) - 1, len(ys) - 1), the cells of the room. ``portals``: openings without a lintel.
    ``passed``: stretches of lines that most rays go beyond, whatever they are.
    """

    xs: Array
    ys: Array
    inside: Mask
    portals: tuple[Portal, ...] = ()
    passed: tuple[Portal, ...] = ()


def wall_offsets(facets: Facets, settings: ArrangementSettings) -> list[float]:
    """Sorted offsets of the lines on which returns lie, each at the mean of its returns."""
    if len(facets.offset_m) == 0:
        return []
    bin_m = settings.gate_m / 4.0
    covered = _covered_length(facets, bin_m)
    lowest = float(facets.offset_m.min())
    offsets: list[float] = []
    for index in np.argsort(-covered, kind="stable"):
        if covered[index] < settings.shortest_wall_m:
            break
        offset = lowest + (index + 0.5) * bin_m
        for gate_m in (settings.gate_m, 0.75 * settings.gate_m):
            near = facets.offset_m[np.abs(facets.offset_m - offset) < gate_m]
            offset = float(near.mean()) if len(near) else offset
        if all(abs(offset - other) > settings.separation_m for other in offsets):
            offsets.append(offset)
    return sorted(offsets)


def _covered_length(facets: Facets, bin_m: float, *, station_bin_m: float = 0.05) -> Array:
    """Per offset bin, the length along the line with a return within two bins of it."""
    row = ((facets.offset_m - facets.offset_m.min()) / bin_m).astype(np.int64)
    column = ((facets.station_m - facets.station_m.min()) / station_bin_m).astype(np.int64)
    hits = np.zeros((int(row.max()) + 5, int(column.max()) + 1), dtype=np.int32)
    np.add.at(hits, (row + 2, column), 1)
    padded = np.concatenate([np.zeros((1, hits.shape[1]), dtype=np.int64), np.cumsum(hits, axis=0)])
    window = padded[5:] - padded[:-5]
    return np.asarray((window > 0).sum(axis=1) * station_bin_m, dtype=np.float64)


def arrange(
    views: Sequence[View],
    x_facing: Facets,
    y_facing: Facets,
    direction_rad: float,
    settings: ArrangementSettings = ArrangementSettings(),
) -> Arrangement | None:
    """The arrangement of all wall lines, with the cells of the room that the last view was taken in.

    ``None`` when fewer than two lines across each axis were seen.
    """
    xs = np.array(wall_offsets(x_facing, settings))
    ys = np.array(wall_offsets(y_facing, settings))
    if len(xs) < 2 or len(ys) < 2:
        return None
    turn = Pose2(0.0, 0.0, direction_rad)
    turned = [view.moved(turn.inverse() @ view.T_frame_base) for view in _spread(views, settings.views)]
    step_m = settings.profile.station_step_m
    across_x = LineProfile.of(turned, xs, _stations(ys, step_m), 0, settings.gate_m, settings=settings.profile)
    across_y = LineProfile.of(turned, ys, _stations(xs, step_m), 1, settings.gate_m, settings=settings.profile)
    portals = [
        portal
        for profile, facets, crossing in ((across_x, x_facing, y_facing), (across_y, y_facing, x_facing))
        for portal in find_portals(
            turned,
            profile,
            facets,
            crossing,
            blocked=settings.blocked,
            gate_m=settings.gate_m,
            settings=settings.portals,
        )
    ]
    xs, ys = (
        _with_edges(xs, _edges(across_y, y_facing, portals, settings), settings),
        _with_edges(ys, _edges(across_x, x_facing, portals, settings), settings),
    )
    free = _free_share(turned, xs, ys, settings.free_margin_m)
    blocked_x = _blocked_share(turned, xs, ys, 0, settings) > settings.wall
    blocked_y = settings.wall < _blocked_share(turned, ys, xs, 1, settings).T
    blocked_x |= _portal_mask(portals, xs, ys, 0)
    blocked_y |= _portal_mask(portals, ys, xs, 1).T
    robot = turned[-1].T_frame_base.position_m
    seen = free > np.where(thin(xs, ys, settings.thin_m), settings.free_thin, settings.free)
    blocked_x |= slits(seen, blocked_x, ys, settings.narrowest_m)
    blocked_y |= slits(seen.T, blocked_y.T, xs, settings.narrowest_m).T
    inside = flood(seen, blocked_x, blocked_y, cell_of(xs, ys, robot))
    inside = without_crannies(inside, xs, ys, settings.narrowest_m)
    passed = (*_passed(across_x, settings), *_passed(across_y, settings))
    return Arrangement(xs=xs, ys=ys, inside=inside, portals=tuple(portals), passed=passed)


def _passed(profile: LineProfile, settings: ArrangementSettings) -> list[Portal]:
    """Stretches of the profile's lines, long enough to matter, that most rays go beyond."""
    through, half_m = profile.told & ~profile.wall(settings.blocked), profile.settings.station_step_m / 2.0
    return [
        Portal(
            axis=profile.axis,
            offset_m=float(offset),
            low_m=float(profile.stations[first]) - half_m,
            high_m=float(profile.stations[last - 1]) + half_m,
        )
        for offset, row in zip(profile.lines, through, strict=True)
        for first, last in runs(row)
        if last - first > settings.run
    ]


def _stations(crossing: Array, step_m: float) -> Array:
    return np.arange(crossing[0] + step_m / 2.0, crossing[-1], step_m)


def _portal_mask(portals: Sequence[Portal], lines: Array, crossing: Array, axis: int) -> Mask:
    """(len(lines), len(crossing) - 1) stretches that lie in a portal."""
    mask = np.zeros((len(lines), len(crossing) - 1), dtype=bool)
    for portal in (one for one in portals if one.axis == axis):
        line = int(np.argmin(np.abs(lines - portal.offset_m)))
        for stretch, (start, end) in enumerate(_pairs(crossing)):
            mask[line, stretch] |= portal.covers(start, end)
    return mask


def _pairs(values: Array) -> list[tuple[float, float]]:
    return list(pairwise(values.tolist()))


def _spread(views: Sequence[View], count: int) -> list[View]:
    """At most ``count`` of the views, evenly spread, the last one among them."""
    index = np.unique(np.linspace(0, len(views) - 1, min(count, len(views))).astype(np.int64))
    return [views[int(i)] for i in index]


def _free_share(views: Sequence[View], xs: Array, ys: Array, margin_m: float) -> Array:
    """Share of each cell that any view saw through, on a grid of sample points per cell."""
    x_samples, y_samples = _samples(xs), _samples(ys)
    x_all = np.concatenate(x_samples)
    y_all = np.concatenate(y_samples)
    points = np.stack(np.meshgrid(x_all, y_all, indexing="ij"), axis=-1).reshape(-1, 2)
    seen = np.zeros(len(points), dtype=bool)
    for view in views:
        seen |= view.beyond(points)[0] > margin_m
    share = seen.reshape(len(x_all), len(y_all)).astype(np.float64)
    x_starts = np.cumsum([0] + [len(part) for part in x_samples[:-1]])
    y_starts = np.cumsum([0] + [len(part) for part in y_samples[:-1]])
    sums = np.add.reduceat(np.add.reduceat(share, x_starts, axis=0), y_starts, axis=1)
    counts = np.outer([len(part) for part in x_samples], [len(part) for part in y_samples])
    return np.asarray(sums / counts)


def _blocked_share(
    views: Sequence[View], lines: Array, crossing: Array, axis: int, settings: ArrangementSettings
) -> Array:
    """(len(lines), len(crossing) - 1) share of a stretch of a line that is wall, of what was seen of it.

    ``lines`` are offsets along ``axis``; ``crossing`` cuts them into stretches. Rays that end in their corners
    tell nothing about a stretch that is longer than these.
    """
    vague, sure = (_wall_share(views, lines, crossing, axis, settings, corners=corners) for corners in (True, False))
    return np.where(np.diff(crossing) > settings.corner_gates * settings.gate_m, sure, vague)


def _wall_share(
    views: Sequence[View], lines: Array, crossing: Array, axis: int, settings: ArrangementSettings, *, corners: bool
) -> Array:
    """``_blocked_share``, from all rays or from those that do not end on a ``crossing`` line, in the ``corners``."""
    stations = _samples(crossing)
    apart = None if corners else crossing
    profile = LineProfile.of(views, lines, np.concatenate(stations), axis, settings.gate_m, apart)
    starts = np.cumsum([0] + [len(part) for part in stations[:-1]])
    wall = np.add.reduceat(profile.wall(settings.blocked).astype(np.float64), starts, axis=1)
    told = np.add.reduceat(profile.told.astype(np.float64), starts, axis=1)
    return np.asarray(wall / np.maximum(told, 1.0))


def _edges(
    profile: LineProfile, facets: Facets, portals: Sequence[Portal], settings: ArrangementSettings
) -> list[float]:
    """Stations at which a wall on one of the profile's lines ends and a wide opening begins.

    Another wall goes off there, though nobody may have stood where its face can be seen: the corner of a nook.
    ``facets`` lie along the lines.
    """
    edges: list[float] = []
    wall, told = profile.wall(settings.blocked), profile.told
    for k, line in enumerate(profile.lines):
        on_line = facets.near(float(line), 1.5 * settings.gate_m)
        for index, wall_first in _changes(wall[k], told[k] & ~wall[k], settings.run):
            middle_m = float(profile.stations[index]) - settings.profile.station_step_m / 2.0
            edge_m = end_of_wall(on_line, middle_m, wall_first=wall_first, end_m=settings.profile.end_m)
            if edge_m is not None:
                edges.append(edge_m)
    return edges + [end for one in portals if one.axis == profile.axis for end in (one.low_m, one.high_m)]


def _changes(wall: Mask, opened: Mask, run: int) -> list[tuple[int, bool]]:
    """Indices at which a long enough run of wall meets a long enough run of opening, and whether wall came first."""
    found: list[tuple[int, bool]] = []
    for index in range(run, len(wall) - run + 1):
        before, after = slice(index - run, index), slice(index, index + run)
        if wall[before].all() and opened[after].all():
            found.append((index, True))
        elif opened[before].all() and wall[after].all():
            found.append((index, False))
    return found


def _with_edges(offsets: Array, edges: Sequence[float], settings: ArrangementSettings) -> Array:
    """Wall lines, and the edges that are not near one."""
    merged = offsets.tolist()
    for edge in sorted(edges):
        if all(abs(edge - other) > 2.0 * settings.separation_m for other in merged):
            merged.append(edge)
    return np.array(sorted(merged))


def _samples(lines: Array) -> list[Array]:
    """Sample coordinates within each interval, denser in narrow ones, clear of its ends."""
    parts: list[Array] = []
    for start, end in _pairs(lines):
        count = int(np.clip(np.ceil((end - start) / 0.25), 3, 16))
        margin = min(0.08, 0.3 * (end - start))
        parts.append(np.linspace(start + margin, end - margin, count))
    return parts
