"""The rectilinear outline of a room: its polygon, how well each wall was seen, and where it is still open."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.geometry.polygon import inward_normal, wall_lengths
from perception.ports import RobotShape
from perception.rooms.outline.arrangement import ArrangementSettings, arrange
from perception.rooms.outline.entrance import EntranceSettings, entrance
from perception.rooms.outline.portals import Portal
from perception.rooms.outline.tracing import trace
from perception.rooms.views.facets import Facets, FacetSettings, longest_gap, sort_by_axis
from perception.rooms.views.view import View, dominant_direction

Array = NDArray[np.float64]

_ON_WALL_M2 = 1e-9
_NO_WALL_M = 1e-6


@dataclass(frozen=True, kw_only=True)
class ClosureSettings:
    """When an outline counts as closed: walls were seen all around."""

    rectilinear: float = 0.9
    """Share of the seen wall length along the two axes. Chosen: a little may stand askew."""
    harmless_gap_m: float = 0.4
    """An unseen stretch that could not hide another part of the room: narrower than the robot."""
    seen: float = 0.5
    """Share of each wall that returned rays. Chosen: most of it."""


@dataclass(frozen=True, kw_only=True)
class OutlineSettings:
    """What becomes of the traced cells' boundary, and the stages before it."""

    corner_clearance_m: float = 0.10
    """At either end of a wall returns may be of the next one. Chosen: nearly two gates."""
    deepest_reveal_m: float = 0.45
    """Of an opening in a thick wall. Chosen."""
    level_m: float = 0.1
    """By how much the two sides of a reveal may differ. Chosen."""
    vague_back: float = 0.5
    """Share of a recess's back that hardly returns rays when it is an opening. Chosen: most of it."""
    mostly_seen: float = 0.75
    """Share of a wall that makes the entrance in it certain. Chosen."""
    closure: ClosureSettings = field(default_factory=ClosureSettings)
    facets: FacetSettings = field(default_factory=FacetSettings)
    arrangement: ArrangementSettings = field(default_factory=ArrangementSettings)
    entrance: EntranceSettings = field(default_factory=EntranceSettings)


@dataclass(frozen=True, kw_only=True, eq=False)
class Outline:
    """Rectilinear polygon of inner wall faces.

    ``polygon``: (N, 2) counter-clockwise, meters, frame of the views; wall k runs from corner k to k + 1.
    ``support``: (N,) share of each wall's length that returned rays. ``gap_m``: (N,) its longest stretch that did not,
    about ``gap_center``: (N, 2). ``sigma_m``: spread of returns about the walls; ``offset_std_m``: (N,) of each wall's
    position. ``direction_rad``: of the walls, modulo a quarter turn. ``rectilinear``: share of seen wall length along
    the two axes.
    """

    polygon: Array
    support: Array
    gap_m: Array
    gap_center: Array
    offset_std_m: Array
    sigma_m: float
    direction_rad: float
    rectilinear: float
    closure: ClosureSettings = ClosureSettings()

    @property
    def closed(self) -> bool:
        """Whether walls were seen all around, without a stretch that could hide another part of the room."""
        least = self.closure
        seen = (self.gap_m < least.harmless_gap_m).all() and (self.support > least.seen).all()
        return bool(self.rectilinear > least.rectilinear and seen)

    def frontiers(self) -> list[tuple[Array, Array]]:
        """Unseen stretches of wall, longest first: middle point and unit normal into the room."""
        starts, ends = self.polygon, np.roll(self.polygon, -1, axis=0)
        least_m = self.closure.harmless_gap_m
        order = [int(k) for k in np.argsort(-self.gap_m, kind="stable") if self.gap_m[k] >= least_m]
        return [(self.gap_center[k], inward_normal(starts[k], ends[k])) for k in order]


def find_outline(
    views: Sequence[View], settings: OutlineSettings = OutlineSettings(), shape: RobotShape = RobotShape()
) -> Outline | None:
    """The outline of the room in which the last view was taken, or ``None`` when too few walls are seen."""
    noise_m = float(np.median([view.scan.noise_m for view in views]))
    settings = replace(settings, arrangement=settings.arrangement.for_noise(noise_m))
    direction_rad, rectilinear = dominant_direction(views)
    x_facing, y_facing = sort_by_axis(views, direction_rad, settings.facets)
    arrangement = arrange(views, x_facing, y_facing, direction_rad, settings.arrangement)
    if arrangement is None:
        return None
    polygon, portals = trace(arrangement), list(arrangement.portals)
    passed = arrangement.passed
    walls = _refine(polygon, x_facing, y_facing, portals, passed, settings)
    while True:
        if (step := _false_step(polygon, walls, settings.arrangement.gate_m)) is not None:
            polygon = _straightened(polygon, step)
            if wall_lengths(polygon).min() < _NO_WALL_M:
                return None
        elif (reveal := _reveal(polygon, walls, settings)) is not None:
            polygon, portal = _cut(polygon, reveal)
            portals.append(portal)
        else:
            break
        walls = _refine(polygon, x_facing, y_facing, portals, passed, settings)
    path = Pose2(0.0, 0.0, -direction_rad).apply(np.array([view.T_frame_base.position_m for view in views]))
    came_in = entrance(polygon, path, settings.entrance, shape)
    if came_in is not None:
        opened = _refine(polygon, x_facing, y_facing, [*portals, came_in], passed, settings)
        walls = [new if old.support > settings.mostly_seen else old for old, new in zip(walls, opened, strict=True)]
    return _outline_of(polygon, walls, direction_rad, rectilinear, settings.closure)


def _outline_of(
    polygon: Array, walls: list[_MeasuredWall], direction_rad: float, rectilinear: float, closure: ClosureSettings
) -> Outline:
    """The traced polygon with its measured walls, turned back into the frame of the views."""
    turn = Pose2(0.0, 0.0, direction_rad)
    return Outline(
        polygon=turn.apply(_intersections(polygon, walls)),
        support=np.array([wall.support for wall in walls]),
        gap_m=np.array([wall.gap_m for wall in walls]),
        gap_center=turn.apply(np.array([wall.gap_center for wall in walls])),
        offset_std_m=np.array([wall.offset_std_m for wall in walls]),
        sigma_m=float(np.median([wall.sigma_m for wall in walls])),
        direction_rad=direction_rad,
        rectilinear=rectilinear,
        closure=closure,
    )


@dataclass(frozen=True, kw_only=True)
class _MeasuredWall:
    """One wall of the traced polygon: the axis it lies ``across``, its offset there, and how well it was seen."""

    across: int
    offset_m: float
    offset_std_m: float
    sigma_m: float
    support: float
    gap_m: float
    gap_center: tuple[float, float]


def _refine(
    polygon: Array,
    x_facing: Facets,
    y_facing: Facets,
    portals: Sequence[Portal],
    passed: Sequence[Portal],
    settings: OutlineSettings,
) -> list[_MeasuredWall]:
    """Put each wall at the mean of the returns along it."""
    return [
        _measure(start, end, (x_facing, y_facing), portals, passed, settings)
        for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True)
    ]


def _measure(
    start: Array,
    end: Array,
    facets_by_axis: tuple[Facets, Facets],
    portals: Sequence[Portal],
    passed: Sequence[Portal],
    settings: OutlineSettings,
) -> _MeasuredWall:
    """``passed`` stretches were not seen to be wall, however sparse the returns on a wall seen at a grazing angle are;
    those in ``portals`` are closed by what is known of the wall beside them.
    """
    arrangement, step_m = settings.arrangement, settings.arrangement.profile.station_step_m
    across = 0 if abs(start[0] - end[0]) < abs(start[1] - end[1]) else 1
    nominal = float(start[across])
    low, high = sorted((float(start[1 - across]), float(end[1 - across])))
    clearance = min(settings.corner_clearance_m, 0.3 * (high - low))
    low, high = low + clearance, high - clearance
    facets = facets_by_axis[across].near(nominal, 1.5 * arrangement.gate_m).between(low, high)
    seen = facets.seen(low, high)
    stations = low + (np.arange(len(seen)) + 0.5) * (high - low) / len(seen)
    for one in _on_line(passed, across, nominal, arrangement):
        seen &= (stations < one.low_m) | (stations > one.high_m)
    for portal in _on_line(portals, across, nominal, arrangement):
        seen |= (stations > portal.low_m - step_m) & (stations < portal.high_m + step_m)
    first, count = longest_gap(seen)
    bin_m = (high - low) / len(seen)
    gap_station = low + (first + count / 2.0) * bin_m
    offset_m, sigma_m = _center(facets.offset_m, nominal, arrangement.gate_m)
    return _MeasuredWall(
        across=across,
        offset_m=offset_m,
        offset_std_m=sigma_m / float(np.sqrt(max(len(facets.offset_m), 1))),
        sigma_m=sigma_m,
        support=float(seen.mean()),
        gap_m=count * bin_m,
        gap_center=(nominal, gap_station) if across == 0 else (gap_station, nominal),
    )


def _on_line(stretches: Sequence[Portal], axis: int, offset_m: float, settings: ArrangementSettings) -> list[Portal]:
    """Those of the stretches that lie on a line."""
    return [one for one in stretches if one.axis == axis and abs(one.offset_m - offset_m) < settings.separation_m]


def _intersections(polygon: Array, walls: list[_MeasuredWall]) -> Array:
    """Corners of the polygon where its refined walls meet."""
    refined = polygon.copy()
    for k, wall in enumerate(walls):
        refined[k, wall.across] = wall.offset_m
        refined[(k + 1) % len(polygon), wall.across] = wall.offset_m
    return refined


def _false_step(polygon: Array, walls: Sequence[_MeasuredWall], gate_m: float) -> int | None:
    """Index of a wall that is only a step between two others which, when measured, turn out to be one surface."""
    count = len(polygon)
    steps = np.roll(polygon, -1, axis=0) - polygon
    for k in range(count if count > 4 else 0):
        before, after = k - 1, (k + 1) % count
        onward = float(steps[before] @ steps[after]) > 0.0
        if onward and abs(walls[before].offset_m - walls[after].offset_m) < gate_m:
            return k
    return None


def _straightened(polygon: Array, step: int) -> Array:
    """The outline without the wall from corner ``step`` to the next: its neighbors are one, where the longer one is."""
    rolled = np.roll(polygon, -step, axis=0)
    axis = 0 if abs(rolled[-1][0] - rolled[0][0]) < abs(rolled[-1][1] - rolled[0][1]) else 1
    before_m, after_m = np.linalg.norm(rolled[0] - rolled[-1]), np.linalg.norm(rolled[2] - rolled[1])
    straight = rolled[2:].copy()
    straight[0][axis] = straight[-1][axis] = (rolled[0] if before_m > after_m else rolled[1])[axis]
    return _without_needless(straight)


def _without_needless(polygon: Array) -> Array:
    """The outline without corners that lie on a wall: those of a recess whose back came to lie beside its sides."""
    while True:
        before, after = polygon - np.roll(polygon, 1, axis=0), np.roll(polygon, -1, axis=0) - polygon
        turning = np.abs(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]) > _ON_WALL_M2
        if turning.all() or np.count_nonzero(turning) < 4:
            return polygon
        polygon = np.delete(polygon, int(np.argmin(turning)), axis=0)


def _reveal(polygon: Array, walls: Sequence[_MeasuredWall], settings: OutlineSettings) -> int | None:
    """Index of the first of four corners that are a shallow recess whose back hardly returns rays: no part of the room,
    but the reveal of an opening in a straight wall.
    """
    count = len(polygon)
    if count < 8:
        return None
    steps = np.roll(polygon, -1, axis=0) - polygon
    turns = np.sign(steps[:, 0] * np.roll(steps, -1, axis=0)[:, 1] - steps[:, 1] * np.roll(steps, -1, axis=0)[:, 0])
    lengths = wall_lengths(polygon)
    for k in range(count):
        before, out, back, home = k - 1, k, (k + 1) % count, (k + 2) % count
        recess = (turns[before], turns[out], turns[back], turns[home]) == (-1.0, 1.0, 1.0, -1.0)
        shallow = max(lengths[out], lengths[home]) < settings.deepest_reveal_m
        level = abs(lengths[out] - lengths[home]) < settings.level_m
        share = settings.vague_back
        vague = walls[back].support < share or walls[back].gap_m > share * lengths[back]
        if recess and shallow and level and vague:
            return k
    return None


def _cut(polygon: Array, first: int) -> tuple[Array, Portal]:
    """The outline without the recess that begins at corner ``first``, and the opening that it was."""
    rolled = np.roll(polygon, -first, axis=0)
    start, end, kept = rolled[0], rolled[3], rolled[4:]
    axis = 0 if abs(rolled[1][0] - rolled[2][0]) < abs(rolled[1][1] - rolled[2][1]) else 1
    low_m, high_m = sorted((float(start[1 - axis]), float(end[1 - axis])))
    straight = kept.copy()
    straight[0][axis] = straight[-1][axis]
    return straight, Portal(axis=axis, offset_m=float(straight[-1][axis]), low_m=low_m, high_m=high_m)


def _center(offsets: Array, nominal: float, gate_m: float) -> tuple[float, float]:
    """Mean and spread of the offsets about their median, outliers left out."""
    if len(offsets) < 5:
        return nominal, gate_m
    center = float(np.median(offsets))
    near = offsets[np.abs(offsets - center) < gate_m]
    if not len(near):  # of two surfaces as large as each other the median is neither
        return nominal, gate_m
    return float(near.mean()), float(near.std())
