"""Corner detector (Concepts, algorithm 1): Hough lines in the slice above furniture, crossing at right angles."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from itertools import combinations
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class CornerSettings:
    """How lines and corners are told."""

    shortest_line_m: float = 0.6
    """Shortest run of returns that counts as a wall (``L_min`` of the paper)."""
    hough_rho_m: float = 0.06
    """Cell of the Hough accumulator: three standard deviations of the usual range noise."""
    hough_theta_rad: float = float(np.deg2rad(1.5))
    """The other side of the cell: it turns a line of four meters by the first one. Chosen."""
    fewest_votes: int = 8
    """Returns that make a line. Chosen."""
    candidates: int = 30
    """Strongest cells that are tried in a pass. Chosen: rooms have fewer walls."""
    passes: int = 3
    """Most often that the returns left over vote anew. Chosen."""
    gate_m: float = 0.07
    """How far from a line its returns may be: three and a half standard deviations of the usual range noise."""
    widest_gap_m: float = 0.7
    """Of one wall, beyond what the spacing of rays explains. Chosen: narrower than a door."""
    reach_m: float = 0.35
    """How far from the end of a wall's returns its corner may be. Chosen: half of what a wardrobe hides."""
    right_angle_rad: float = float(np.deg2rad(2.5))
    """How far from square a corner may be: errors of both lines' directions. Chosen."""
    ray_step_rad: float = float(np.deg2rad(0.4))
    """Between neighboring rays: the coarsest horizontal resolution of the LiDAR (design, section 5)."""

    def for_noise(self, noise_m: float) -> CornerSettings:
        """Gates wide enough for ranges with this standard deviation."""
        gate_m = max(self.gate_m, 3.0 * noise_m)
        return replace(self, gate_m=gate_m, hough_rho_m=max(self.hough_rho_m, gate_m))


@dataclass(frozen=True, kw_only=True, eq=False)
class WallLine:
    """A straight run of wall returns: ``normal · p = offset_m`` between stations ``span_m`` along ``direction``.

    ``sigma_m``: spread of the returns about the line; ``offset_std_m`` and ``angle_std_rad``: of the fit.
    """

    normal: Array
    offset_m: float
    span_m: tuple[float, float]
    support: int
    sigma_m: float
    offset_std_m: float
    angle_std_rad: float

    @property
    def direction(self) -> Array:
        return np.array([-self.normal[1], self.normal[0]])

    @property
    def length_m(self) -> float:
        return self.span_m[1] - self.span_m[0]


@dataclass(frozen=True, kw_only=True, eq=False)
class CornerSighting:
    """Two walls crossing at a right angle: ``point`` (2,) in meters, ``std_m`` of each coordinate."""

    point: Array
    std_m: float


def detect_lines(points: Array, settings: CornerSettings = CornerSettings()) -> list[WallLine]:
    """Wall lines in (N, 2) ``points`` seen from the origin: Hough candidates, each refined by total least squares.

    A return belongs to the strongest line that explains it. Later passes find the weaker lines, whose votes drown
    beside a long wall.
    """
    free = np.ones(len(points), dtype=bool)
    lines: list[WallLine] = []
    for _ in range(settings.passes):
        known = len(lines)
        candidates = _hough(points[free], settings)
        near = _near(points, candidates, 2.0 * settings.gate_m)
        for (rho, theta), close in zip(candidates, near, strict=True):
            if np.count_nonzero(close & free) < settings.fewest_votes:
                continue
            normal = np.array([np.cos(theta), np.sin(theta)])
            line, claimed = _fit(points, free, normal, rho, settings, narrowing=(2.0, 1.0, 1.0))
            if line is not None:
                lines.append(line)
                free &= ~claimed
        if len(lines) == known:
            break
    return lines


def confirm_lines(
    points: Array, normals: Array, offsets: Array, settings: CornerSettings = CornerSettings()
) -> list[WallLine]:
    """Wall lines in (N, 2) ``points`` near those that are expected: ``normals`` (K, 2) and ``offsets`` (K,).

    What a known room predicts needs no search: each expected line is fitted to the returns near it.
    """
    free = np.ones(len(points), dtype=bool)
    lines: list[WallLine] = []
    for normal, offset in zip(normals, offsets, strict=True):
        line, claimed = _fit(points, free, normal, float(offset), settings, narrowing=(1.0, 1.0))
        if line is not None:
            lines.append(line)
            free &= ~claimed
    return lines


def _hough(points: Array, settings: CornerSettings) -> Array:
    """(K, 2) candidates (rho, theta), most votes first."""
    if len(points) < settings.fewest_votes:
        return np.empty((0, 2))
    farthest = float(np.linalg.norm(points, axis=1).max()) + settings.hough_rho_m
    found: Any = cv2.HoughLinesPointSet(  # None when no line has enough votes, whatever its stub says
        points.astype(np.float32).reshape(-1, 1, 2),
        settings.candidates,
        settings.fewest_votes,
        -farthest,
        farthest,
        settings.hough_rho_m,
        0.0,
        np.pi,
        settings.hough_theta_rad,
    )
    if found is None:
        return np.empty((0, 2))
    return np.asarray(found, dtype=np.float64).reshape(-1, 3)[:, 1:]


def _near(points: Array, candidates: Array, gate_m: float) -> NDArray[np.bool_]:
    """(K, N) which points are within the gate of which candidate (rho, theta)."""
    normals = np.stack([np.cos(candidates[:, 1]), np.sin(candidates[:, 1])])
    return np.asarray(gate_m > np.abs(points @ normals - candidates[:, 0]).T)


def _fit(
    points: Array,
    free: NDArray[np.bool_],
    normal: Array,
    offset: float,
    settings: CornerSettings,
    *,
    narrowing: tuple[float, ...],
) -> tuple[WallLine | None, NDArray[np.bool_]]:
    """Fit the returns near a candidate with gates of ``narrowing`` times the usual; keep its longest unbroken run."""
    claimed = np.zeros(len(points), dtype=bool)
    for factor in narrowing:
        inliers = np.flatnonzero(free & (np.abs(points @ normal - offset) < factor * settings.gate_m))
        if len(inliers) < settings.fewest_votes:
            return None, claimed
        normal, offset = fit_line(points[inliers])
    inliers = inliers[_longest_run(points[inliers], normal, offset, settings)]
    if len(inliers) < settings.fewest_votes:
        return None, claimed
    normal, offset = fit_line(points[inliers])
    line = _measured_line(points[inliers], normal, offset)
    claimed[inliers] = True
    return (line if line.length_m >= settings.shortest_line_m else None), claimed


def fit_line(points: Array) -> tuple[Array, float]:
    """Normal and offset of the line that minimizes squared perpendicular distances."""
    x, y = points.sum(axis=0) / len(points)
    dx, dy = points[:, 0] - x, points[:, 1] - y
    angle = 0.5 * math.atan2(2.0 * float(dx @ dy), float(dx @ dx) - float(dy @ dy))  # of the line
    normal = np.array([-math.sin(angle), math.cos(angle)])
    return normal, float(normal[0] * x + normal[1] * y)


def _longest_run(points: Array, normal: Array, offset: float, settings: CornerSettings) -> NDArray[np.intp]:
    """Which of a line's points are its longest run without a gap wider than the spacing of rays there explains."""
    stations = points @ np.array([-normal[1], normal[0]])
    order = np.argsort(stations, kind="stable")
    breaks = np.flatnonzero(np.diff(stations[order]) > _widest_gap(stations[order], offset, settings)) + 1
    runs = np.split(order, breaks)
    return max(runs, key=lambda run: float(stations[run[-1]] - stations[run[0]]))


def _widest_gap(stations: Array, offset: float, settings: CornerSettings) -> Array:
    """(N - 1,) gap allowed between neighbors: rays from the origin meet a far wall at a grazing angle, far apart."""
    nearer = np.minimum(np.abs(stations[1:]), np.abs(stations[:-1]))
    return settings.widest_gap_m + 2.0 * _ray_spacing(nearer, offset, settings.ray_step_rad)


def _ray_spacing(station: Array, offset: float, step_rad: float) -> Array:
    """Distance between neighboring rays of the origin on a line at ``offset``, at ``station`` along it."""
    return np.asarray(step_rad * (station**2 + offset**2) / max(abs(offset), 0.1))


def _measured_line(points: Array, normal: Array, offset: float) -> WallLine:
    stations = points @ np.array([-normal[1], normal[0]])
    residuals = points @ normal - offset
    sigma = float(max(1.4826 * np.median(np.abs(residuals)), 1e-3))
    spread = float(np.sqrt(((stations - stations.mean()) ** 2).sum()))
    return WallLine(
        normal=normal,
        offset_m=offset,
        span_m=(float(stations.min()), float(stations.max())),
        support=len(points),
        sigma_m=sigma,
        offset_std_m=sigma / np.sqrt(len(points)),
        angle_std_rad=sigma / max(spread, 1e-6),
    )


def corners_of(lines: list[WallLine], settings: CornerSettings = CornerSettings()) -> list[CornerSighting]:
    """Where two ``lines`` cross at a right angle close to the ends of both (algorithm 1, lines 8 to 10)."""
    sightings: list[CornerSighting] = []
    for first, second in combinations(lines, 2):
        if abs(float(first.normal @ second.normal)) > np.sin(settings.right_angle_rad):
            continue
        offsets = np.array([first.offset_m, second.offset_m])
        point: Array = np.asarray(np.linalg.solve(np.stack([first.normal, second.normal]), offsets), dtype=np.float64)
        if _ends_near(first, point, settings) and _ends_near(second, point, settings):
            sightings.append(
                CornerSighting(point=point, std_m=float(np.hypot(_std_at(first, point), _std_at(second, point))))
            )
    return sightings


def _ends_near(line: WallLine, point: Array, settings: CornerSettings) -> bool:
    station = float(line.direction @ point)
    reach_m = settings.reach_m + 1.5 * float(_ray_spacing(np.array(station), line.offset_m, settings.ray_step_rad))
    return min(abs(station - line.span_m[0]), abs(station - line.span_m[1])) < reach_m


def _std_at(line: WallLine, point: Array) -> float:
    """Standard deviation of the line's position where it passes ``point``."""
    lever_m = float(line.direction @ point) - sum(line.span_m) / 2.0
    return float(np.hypot(line.offset_std_m, lever_m * line.angle_std_rad))
