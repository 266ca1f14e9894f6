"""Is a thing still where it is said to be? Judged only where it should have been visible.

For each known thing, points on it are projected into the depth image. Something clearly nearer hides it: no evidence.
Depth that agrees speaks for it even when the network did not name it. Depth that goes on behind it speaks against it,
strongly. All evidence is scaled by how likely the network would have found a thing of that size in pixels.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.seeing.projection import ProjectionSettings, View, project

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class ExistenceSettings:
    """Log odds. ``hit`` is what one sighting adds; a frame takes at most ``through_limit`` (seen through) or
    ``miss_limit`` (depth cannot tell). ``part_hidden``: share of a thing that is hidden from which on the network may
    well miss the rest, however long one looks from there. ``missing_below``: probability under which a thing is
    missing.
    """

    hit: float = 1.5
    through_limit: float = 1.0
    miss_limit: float = 0.35
    bound: float = 4.6
    missing_below: float = 0.2
    range_limit_m: float = 4.5
    detect_max: float = 0.9
    detect_half_px: float = 11.0
    part_hidden: float = 0.2
    border_px: float = 4.0
    speed_limit_radps: float = 0.8
    depth_noise_per_m: float = ProjectionSettings.depth_noise_per_m
    """Depth sigma is this times z squared, in meters: the camera's."""
    least_telling: int = 6
    """Sample points behind which depth must differ: two rows of a thing."""


@dataclass(frozen=True, kw_only=True)
class Visibility:
    """How the place of a thing looks in one depth image; shares of its sample points, all of them together one at most.

    ``pixels``: side of the square that it would cover. ``depth_tells``: whether depth would differ somewhere if it were
    gone; ``gone``: share that is seen through of where it would. ``center_px``: (u, v) of its middle.
    """

    through: float = 0.0
    consistent: float = 0.0
    hidden: float = 0.0
    pixels: float = 0.0
    depth_tells: bool = False
    gone: float = 0.0
    center_px: tuple[float, float] = (0.0, 0.0)

    @property
    def visible(self) -> float:
        return self.through + self.consistent


def visibility(box: Box, view: View, settings: ExistenceSettings) -> Visibility:
    """How the place ``box`` (room frame of the view) looks now."""
    (center_px,), (center_m,) = project(view.T_camera_room.apply(box.center[None]), view.intrinsics)
    if center_m <= 0.2 or center_m > settings.range_limit_m:
        return Visibility()
    half_depth_m, samples = _samples(box, view.T_room_camera.translation_m)
    pixels, depth_m = project(view.T_camera_room.apply(samples), view.intrinsics)
    border = settings.border_px
    with np.errstate(invalid="ignore"):
        inside = (
            (pixels[:, 0] >= border)
            & (pixels[:, 0] < view.intrinsics.width - border)
            & (pixels[:, 1] >= border)
            & (pixels[:, 1] < view.intrinsics.height - border)
            & (depth_m > 0.2)
        )
    if not inside.any():
        return Visibility()
    tolerance_m = (
        0.02
        + 3.0 * settings.depth_noise_per_m * center_m**2
        + 2.0 * float(np.sqrt(np.trace(view.pose_covariance[:3, :3]) / 3.0))
    )
    measured_m = _measured(view, pixels, inside)
    known = measured_m > 0.0
    through = known & (measured_m > depth_m + half_depth_m + tolerance_m)
    hidden = known & (measured_m < depth_m - half_depth_m - tolerance_m)
    consistent = known & ~through & ~hidden
    telling = _telling(box, samples, view, half_depth_m + tolerance_m) & (through | consistent)
    return Visibility(
        through=float(through.mean()),
        consistent=float(consistent.mean()),
        hidden=float(hidden.mean()),
        pixels=float(np.sqrt(box.size_m[2] * max(box.size_m[:2])) * view.intrinsics.fx / center_m),
        depth_tells=int(np.count_nonzero(telling)) >= settings.least_telling,
        gone=float(through[telling].mean()) if telling.any() else 0.0,
        center_px=(float(center_px[0]), float(center_px[1])),
    )


def detection_probability(seen: Visibility, settings: ExistenceSettings) -> float:
    """Chance that the network finds a thing of that size of which that much shows."""
    logistic = 1.0 / (1.0 + np.exp(-(seen.pixels - settings.detect_half_px) / 2.0))
    return float(settings.detect_max * logistic * seen.visible)


def absence_evidence(seen: Visibility, *, replaced: bool, settings: ExistenceSettings) -> float:
    """Change of log odds, never positive, for a thing that was not detected this time.

    Bayes with p(through | there) = 0.05, p(through | gone) = 0.95 where depth can tell, and the network's miss
    otherwise. ``replaced``: another thing stands right there.
    """
    if seen.visible < 0.5:
        return 0.0
    p_detect = detection_probability(seen, settings)
    miss = float(np.log(max(1.0 - p_detect, 1e-3)))
    if replaced:
        return -settings.through_limit * p_detect
    if seen.depth_tells and seen.gone > 0.6:
        return max(miss + float(np.log(0.05 / 0.95)), -settings.through_limit) * min(1.0, p_detect / 0.5)
    if seen.depth_tells:
        return min(0.0, max(miss + float(np.log(0.95 / 0.05)), -settings.miss_limit))
    if seen.hidden >= settings.part_hidden:
        return 0.0
    return max(miss, -settings.miss_limit)


def surface_absent(points: Array, view: View, settings: ExistenceSettings) -> float:
    """Share of seen-through points among the visible ones of a remembered surface (V, 3); 0 where too little shows.

    Furniture is never taken for gone because the network missed it, only because one looks through where it stood.
    """
    if len(points) == 0:
        return 0.0
    samples = points[:: -(-len(points) // 80)]
    pixels, depth_m = project(view.T_camera_room.apply(samples), view.intrinsics)
    with np.errstate(invalid="ignore"):
        inside = (
            ((pixels >= settings.border_px).all(axis=1))
            & (pixels[:, 0] < view.intrinsics.width - settings.border_px)
            & (pixels[:, 1] < view.intrinsics.height - settings.border_px)
            & (depth_m > 0.3)
            & (depth_m < settings.range_limit_m)
        )
    measured_m = _measured(view, pixels, inside)
    slack_m = 0.15 + 3.0 * settings.depth_noise_per_m * depth_m**2
    visible = (measured_m > 0.0) & (measured_m > depth_m - slack_m)
    if np.count_nonzero(visible) < 12:
        return 0.0
    return float(np.mean(measured_m[visible] > (depth_m + slack_m)[visible]))


def bounded(log_odds: float, settings: ExistenceSettings) -> float:
    """Log odds kept where a belief can still be turned."""
    return float(np.clip(log_odds, -settings.bound, settings.bound))


def _samples(box: Box, camera: Array) -> tuple[float, Array]:
    """Half the extent along the view in meters, and 15 points in the plane that faces the camera."""
    direction = box.center - camera
    direction /= max(float(np.linalg.norm(direction)), 1e-9)
    left = np.array((-direction[1], direction[0], 0.0)) / max(float(np.hypot(direction[0], direction[1])), 1e-6)
    half_width_m, half_depth_m = min(box.size_m[:2]) / 2.0, float(np.hypot(*box.size_m[:2])) / 2.0
    across, up = np.meshgrid((-0.6, 0.0, 0.6), (-0.7, -0.35, 0.0, 0.35, 0.7))
    samples = (
        box.center
        + (across.ravel() * half_width_m)[:, None] * left
        + (up.ravel() * box.size_m[2] / 2.0)[:, None] * np.array((0.0, 0.0, 1.0))
    )
    return half_depth_m, samples


def _measured(view: View, pixels: Array, inside: NDArray[np.bool_]) -> Array:
    """Depth at the pixels, 0 outside the image."""
    safe = np.where(inside[:, None], pixels, 0.0)
    u, v = np.round(safe).astype(np.int64).T
    return np.where(inside, view.depth_m[v, u].astype(np.float64), 0.0)


def _telling(box: Box, samples: Array, view: View, slack_m: float) -> NDArray[np.bool_]:
    """Of ``samples`` (N, 3) on a thing, those behind which its support would clearly be farther if it were gone."""
    away = samples - view.T_room_camera.translation_m
    sine = np.maximum(-away[:, 2] / np.maximum(np.linalg.norm(away, axis=1), 1e-6), 0.05)
    over_m = samples[:, 2] - (box.center[2] - box.size_m[2] / 2.0)
    return np.asarray(over_m / sine > slack_m)
