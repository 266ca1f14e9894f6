"""Where exactly a gap ends: the most probable station of a door post, given all rays near it.

A ray that crosses the wall's plane beside the post ends on the face, one that crosses it in the gap passes, and one
that crosses it in the gap toward the post ends on the reveal, the deeper the farther from the edge. Thresholding depth
would take the last for wall and make every door seen from the front too narrow; the model below does not.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from perception.doors.wall_evidence import Gap, WallEvidence
from perception.lidar.wall_rays import RaySettings, WallRays

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class PostSettings:
    """How a post is looked for, and what is made of it."""

    window_m: float = 0.25
    """Rays this near to a post count. Chosen: farther ones say nothing about it."""
    slack_m: float = 0.06
    """How far the bounds may be off: three parts of the wall's evidence."""
    shadow_m: float = 0.35
    """How far behind where wall was first seen the post may be, for the shallow end of a reveal looks like wall: a ray
    that just does not graze it (``wall_rays.RaySettings``) is deeper than ``face_m`` only this far from the post."""
    coarse_m: float = 0.006
    """Step of the first search. Chosen."""
    fine_m: float = 0.001
    """Step of the second. Chosen."""
    sigma_m: float = 0.02
    """Standard deviation of a ray's depth: range noise of the usual LiDAR (design, section 5)."""
    thinnest_wall_m: float = 0.05
    """A ray this deep in the gap may have passed the reveal and met whatever is behind: inner walls may be so thin."""
    through_m: float = RaySettings.through_m
    """How deep rays in the gap can end at most."""
    outlier: float = 9.0
    """Largest squared residual: of three standard deviations."""
    rays: int = 24
    """Least number near a post, a quarter of it on either side. Chosen."""
    rays_at_first: int = 1500
    """How many of them are asked in the first search. Chosen: for speed."""
    sharp_m: float = 0.008
    """Standard deviation below which a post counts as measured. Chosen."""
    rough_m: float = 0.05
    """Standard deviation of an end that could not be refined: two parts of the wall's evidence and the rays' noise."""
    corner_m: float = 0.04
    """A gap that ends so near to the wall's own end ends there: two parts of the evidence."""
    corner_std_m: float = 0.005
    """Standard deviation of a post that is the next wall. Chosen: how well walls are measured."""


@dataclass(frozen=True, kw_only=True)
class Post:
    """A door post: its station along the wall in meters, standard deviation, and how many rays were near it."""

    station_m: float
    std_m: float
    rays: int


def find_post(
    evidence: WallEvidence,
    open_m: float,
    wall_m: float,
    *,
    wall_follows: bool,
    settings: PostSettings = PostSettings(),
) -> Post | None:
    """The post between a station where the wall is open and one where it is wall.

    ``wall_follows``: the wall is at greater stations, the gap at smaller ones. ``None`` when too few rays were
    near, or none on one of its two sides, or when the post may just as well be beyond where it was looked for.
    """
    sign = 1.0 if wall_follows else -1.0
    low_m, high_m = sign * open_m - settings.slack_m, sign * wall_m + settings.shadow_m
    middle_m, half_m = (low_m + high_m) / 2.0, (high_m - low_m) / 2.0
    samples = evidence.samples(sign * middle_m, half_m + settings.window_m)
    if samples is None or len(samples.station_m) < settings.rays:
        return None
    mirrored = _Mirrored.of(samples, sign)
    every = 1 + len(samples.station_m) // settings.rays_at_first
    rough, half_rough_m = _minimum(
        mirrored.only(slice(None, None, every)), middle_m, half_m, settings.coarse_m, settings
    )
    if abs(rough - middle_m) + half_rough_m > half_m - settings.coarse_m:
        return None
    mirrored = mirrored.only(np.abs(mirrored.station - rough) < settings.window_m + 2.0 * settings.coarse_m)
    best, half_m = _minimum(mirrored, rough, 2.0 * settings.coarse_m, settings.fine_m, settings)
    sides = mirrored.station > best
    if min(int(sides.sum()), int((~sides).sum())) < settings.rays // 4:
        return None
    return Post(station_m=sign * best, std_m=float(np.hypot(half_m, 0.002)), rays=len(sides))


@dataclass(frozen=True, kw_only=True, eq=False)
class _Mirrored:
    """Rays near a post, turned so that the wall is at greater stations."""

    station: Array
    slope: Array
    depth: Array
    weight: Array

    @classmethod
    def of(cls, rays: WallRays, sign: float) -> _Mirrored:
        """``sign``: -1 where the wall is at smaller stations."""
        weight = 1.0 / np.maximum(rays.distance_m, 0.7) ** 2
        return cls(station=sign * rays.station_m, slope=sign * rays.slope, depth=rays.depth_m, weight=weight)

    def only(self, kept: slice | NDArray[np.bool_]) -> _Mirrored:
        """Some of the rays."""
        return _Mirrored(
            station=self.station[kept], slope=self.slope[kept], depth=self.depth[kept], weight=self.weight[kept]
        )


def _minimum(
    rays: _Mirrored, center: float, search_m: float, step_m: float, settings: PostSettings
) -> tuple[float, float]:
    """Middle and half width of the stretch of stations around ``center`` that explain the rays best."""
    candidates = center + np.arange(-search_m, search_m + step_m / 2.0, step_m)
    cost = _residuals(candidates, rays, settings) @ rays.weight
    plateau = candidates[cost <= cost.min() + 0.5 * float(rays.weight.mean())]
    return float(plateau.mean()), float(np.ptp(plateau)) / 2.0


def _residuals(candidates: Array, rays: _Mirrored, settings: PostSettings) -> Array:
    """(candidates, rays) squared normalized residual of depth, bounded for outliers."""
    inside = candidates[:, None] - rays.station[None, :]
    with np.errstate(divide="ignore", invalid="ignore"):
        reveal = np.where(rays.slope[None, :] > 1e-3, inside / rays.slope[None, :], np.inf)
    expected = np.where(inside <= 0.0, 0.0, np.minimum(reveal, settings.through_m))
    residual = (rays.depth[None, :] - expected) / settings.sigma_m
    beyond = (expected >= settings.thinnest_wall_m) & (rays.depth[None, :] >= settings.thinnest_wall_m)
    return np.asarray(np.where(beyond, 0.0, np.minimum(residual**2, settings.outlier)))


@dataclass(frozen=True, kw_only=True)
class MeasuredGap:
    """A gap between two posts, stations in meters; ``std_m`` of its center, ``start_std_m`` and ``end_std_m`` of the
    posts, infinite where nobody measured them. ``posts``: how many were measured well.
    """

    center_m: float
    width_m: float
    std_m: float
    posts: int
    start_std_m: float = math.inf
    end_std_m: float = math.inf


def measure_gap(evidence: WallEvidence, gap: Gap, settings: PostSettings = PostSettings()) -> MeasuredGap:
    """Refine both ends of ``gap``; an end that cannot be refined stays where it is, with a large uncertainty."""
    if gap.panel_m is not None:
        settings = replace(settings, through_m=gap.panel_m)
    start_m, start_std_m = _end(evidence, gap.start_m, gap.wall_before_m, settings, wall_follows=False)
    end_m, end_std_m = _end(evidence, gap.end_m, gap.wall_after_m, settings, wall_follows=True)
    return MeasuredGap(
        center_m=(start_m + end_m) / 2.0,
        width_m=max(end_m - start_m, 0.0),
        std_m=float(np.hypot(start_std_m, end_std_m)) / 2.0,
        posts=int(start_std_m < settings.sharp_m) + int(end_std_m < settings.sharp_m),
        start_std_m=start_std_m,
        end_std_m=end_std_m,
    )


def _end(
    evidence: WallEvidence, open_m: float, wall_m: float | None, settings: PostSettings, *, wall_follows: bool
) -> tuple[float, float]:
    """Station and standard deviation of one end; a gap that reaches the wall's end has the next wall for a post."""
    if wall_m is None:
        return open_m, settings.rough_m
    if wall_m in (0.0, evidence.length_m) and abs(open_m - wall_m) < settings.corner_m:
        return wall_m, settings.corner_std_m
    post = find_post(evidence, open_m, wall_m, wall_follows=wall_follows, settings=settings)
    return (post.station_m, post.std_m) if post is not None else (open_m, settings.rough_m)
