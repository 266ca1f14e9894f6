"""Pixel to camera to base to room: from a mask and a depth image to points (Filtering, section 3.1, step 4a).

Pixel centers have integer coordinates. Optical frame: x right, y down, z forward.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from perception.ports import Intrinsics, RgbdFrame
from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]
Building = Callable[[Array], NDArray[np.bool_]]
"""Which of the points (N, 3) in a view's room frame lie on the floor or on a wall."""
_SQUARE = np.ones((3, 3), dtype=np.uint8)
_TOUCHING = np.ones((3, 3, 3), dtype=np.uint8)


@dataclass(frozen=True, kw_only=True)
class ProjectionSettings:
    """How masks become points. ``depth_noise_per_m``: depth sigma is this times z squared, in meters.

    ``link_m``: points farther apart than once to twice this are two things under one mask, looked for among about
    ``piece_points`` of them. What has less than ``own_share`` of its points to itself is a part of the building.
    """

    depth_min_m: float = 0.2
    depth_max_m: float = 8.0
    depth_noise_per_m: float = 1.5e-3
    border_px: int = 2
    min_points: int = 12
    max_points: int = 500
    piece_points: int = 2000
    link_m: float = 0.08
    own_share: float = 0.15
    gap_m: tuple[float, float] = (0.05, 0.4)
    gap_of_width: float = 0.6
    edge_m: float = 0.05
    """Depths of neighbors that differ by more are of two things,"""
    edge_sigmas: float = 8.0
    """or by so many sigmas of depth."""
    foot_rows: tuple[int, ...] = (3, 4, 5)
    """So many rows below a mask its foot is looked for: what is nearer may still be the thing's."""
    foot_spread_m: float = 0.02
    """What is that level, there, is what it stands on: between quartiles."""


@dataclass(frozen=True, kw_only=True, eq=False)
class View:
    """A depth image and where it was taken from, in the frame of ``room``.

    ``depth_m``: (H, W) float32, 0 where unknown. ``pose_covariance``: (6, 6) of the base in the room, right
    perturbation.
    """

    stamp_s: float
    room: str
    intrinsics: Intrinsics
    depth_m: NDArray[np.float32]
    T_room_base: SE3
    T_base_camera: SE3
    pose_covariance: Array

    @cached_property
    def T_room_camera(self) -> SE3:
        return self.T_room_base @ self.T_base_camera

    @cached_property
    def T_camera_room(self) -> SE3:
        return self.T_room_camera.inverse()

    @classmethod
    def of(
        cls, frame: RgbdFrame, *, room: str, T_room_base: SE3, pose_covariance: Array, depth_max_m: float = 8.0
    ) -> View:
        """The view of ``frame``; depth that is not a number, negative or beyond range counts as unknown."""
        depth_m = np.nan_to_num(frame.depth_m, nan=0.0, posinf=0.0, neginf=0.0).astype(np.float32)
        depth_m[(depth_m < 0.0) | (depth_m > depth_max_m)] = 0.0
        return cls(
            stamp_s=frame.stamp_s,
            room=room,
            intrinsics=frame.intrinsics,
            depth_m=depth_m,
            T_room_base=T_room_base,
            T_base_camera=frame.T_base_camera,
            pose_covariance=pose_covariance,
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class Cloud:
    """The points of one mask after trimming, in the room frame of its view.

    ``points``: (N, 3). ``range_m``: median depth. ``pixels``: area of the mask. ``truncated``: cut by the image border.
    ``occluded``: part of the mask's rim, 0 to 1, where something nearer hides the rest. ``foot_m``: how high in the
    room lies what is seen right before the thing, ``None`` where that is not level or not known.
    """

    points: Array
    range_m: float
    pixels: int
    truncated: bool
    occluded: float
    foot_m: float | None = None


def back_project(u: Array, v: Array, depth_m: Array, intrinsics: Intrinsics) -> Array:
    """Pixels (N,) and depths (N,) to points (N, 3) in the optical frame."""
    x_m = (u - intrinsics.cx) * depth_m / intrinsics.fx
    y_m = (v - intrinsics.cy) * depth_m / intrinsics.fy
    return np.stack((x_m, y_m, depth_m), axis=-1)


def project(points_camera: Array, intrinsics: Intrinsics) -> tuple[Array, Array]:
    """Points (N, 3) in the optical frame to pixels (N, 2) and depths (N,); points behind the camera give NaN pixels."""
    depth_m = points_camera[:, 2]
    safe_m = np.where(depth_m > 1e-6, depth_m, np.nan)
    u = points_camera[:, 0] / safe_m * intrinsics.fx + intrinsics.cx
    v = points_camera[:, 1] / safe_m * intrinsics.fy + intrinsics.cy
    return np.stack((u, v), axis=-1), depth_m


def cloud_of(
    mask: NDArray[np.bool_], view: View, settings: ProjectionSettings, *, building: Building | None = None
) -> Cloud | None:
    """The points of ``mask`` without what bled in from the background, or ``None`` where too few pixels have depth.

    ``building`` tells which points are the building's, such as the floor between a chair's legs, and not the thing's.

    The depth of the eroded mask tells the depth of the thing; pixels of the whole mask that agree with it are kept.
    Of what is several pieces in space, such as two cupboards and the gap between them, the largest is kept.
    """
    x, y, width, height = cv2.boundingRect(mask.astype(np.uint8))
    if width == 0:
        return None
    rows, columns = slice(y, y + height), slice(x, x + width)
    inside = np.ascontiguousarray(mask[rows, columns]).view(np.uint8)
    depth_m = view.depth_m[rows, columns]
    interval = _depth_interval(inside, depth_m, view.intrinsics, settings)
    if interval is None:
        return None
    kept = inside.astype(bool) & (depth_m >= interval[0]) & (depth_m <= interval[1])
    v, u = np.nonzero(kept)
    if len(u) < settings.min_points:
        return None
    step = max(1, int(np.sqrt(len(u) / settings.piece_points)))
    v, u = (pixels * step for pixels in np.nonzero(kept[::step, ::step]))
    smooth_m = _smoothed(depth_m, kept, settings)[v, u]
    points = view.T_room_camera.apply(
        back_project(u.astype(np.float64) + x, v.astype(np.float64) + y, smooth_m, view.intrinsics)
    )
    own = ~building(points) if building is not None else np.ones(len(points), dtype=bool)
    if own.mean() < settings.own_share:
        return None
    own[own] = largest_piece(points[own], settings.link_m)
    piece = np.nonzero(own)[0]
    if len(piece) < settings.min_points:
        return None
    piece = piece[:: -(-len(piece) // settings.max_points)]
    return Cloud(
        points=points[piece],
        range_m=float(np.median(smooth_m[piece])),
        pixels=int(np.count_nonzero(inside)),
        truncated=_touches_border(x, y, width, height, view.intrinsics, settings.border_px),
        occluded=_occluded_rim(mask, view.depth_m, (x, y, width, height), interval[0]),
        foot_m=_foot(inside, (x, y), view, settings),
    )


def largest_piece(points: Array, link_m: float) -> NDArray[np.bool_]:
    """Which of the points (N, 3) belong to the largest cluster: cells of ``link_m`` that touch are one."""
    cells = np.floor((points - points.min(axis=0)) / link_m).astype(np.intp)
    if cells.max() <= 1:
        return np.ones(len(points), dtype=bool)
    taken = np.zeros(cells.max(axis=0) + 1, dtype=bool)
    taken[tuple(cells.T)] = True
    of_point = label(taken, structure=_TOUCHING)[0][tuple(cells.T)]
    return np.asarray(of_point == np.bincount(of_point).argmax())


def _depth_interval(
    inside: NDArray[np.uint8], depth_m: NDArray[np.float32], intrinsics: Intrinsics, settings: ProjectionSettings
) -> tuple[float, float] | None:
    """Depths (near, far) of the thing: the largest cluster between gaps that its own width cannot explain."""
    core = cv2.erode(inside, _SQUARE, borderType=cv2.BORDER_REPLICATE)
    core_m = depth_m[(core > 0) & (depth_m >= settings.depth_min_m)]
    if len(core_m) < max(settings.min_points, 0.2 * np.count_nonzero(inside)):
        core_m = depth_m[(inside > 0) & (depth_m >= settings.depth_min_m)]
    if len(core_m) < settings.min_points:
        return None
    ordered_m = np.sort(core_m)
    middle_m = float(ordered_m[len(ordered_m) // 2])
    width_m = inside.shape[1] * middle_m / intrinsics.fx
    gap_m = float(np.clip(settings.gap_of_width * width_m, *settings.gap_m))
    noise_m = settings.depth_noise_per_m * middle_m**2
    starts = np.concatenate(([0], np.nonzero(np.diff(ordered_m) > gap_m)[0] + 1, [len(ordered_m)]))
    largest = int(np.argmax(np.diff(starts)))
    near_m, far_m = float(ordered_m[starts[largest]]), float(ordered_m[starts[largest + 1] - 1])
    slack_m = max(2.0 * noise_m, 0.01)
    return near_m - slack_m, far_m + slack_m


def _smoothed(depth_m: NDArray[np.float32], kept: NDArray[np.bool_], settings: ProjectionSettings) -> Array:
    """Mean depth over kept pixels of each 3 x 3 neighborhood: a third of the noise, and slopes stay slopes.

    Not across an edge: means of what is before and behind it would lie where nothing is.
    """
    weights = kept.astype(np.float32)
    total = cv2.blur(depth_m * weights, (3, 3), borderType=cv2.BORDER_CONSTANT)
    count = cv2.blur(weights, (3, 3), borderType=cv2.BORDER_CONSTANT)
    nearest = cv2.erode(np.where(kept, depth_m, np.float32(np.inf)), _SQUARE)
    farthest = cv2.dilate(np.where(kept, depth_m, np.float32(0.0)), _SQUARE)
    edge = farthest - nearest > np.maximum(
        settings.edge_m, settings.edge_sigmas * settings.depth_noise_per_m * depth_m**2
    )
    return np.where(edge, depth_m, total / np.maximum(count, 1e-6)).astype(np.float64)


def _foot(inside: NDArray[np.uint8], corner: tuple[int, int], view: View, settings: ProjectionSettings) -> float | None:
    """The height of what is seen below the mask, in every column that it has; ``None`` where that is not level."""
    columns = np.flatnonzero(inside.any(axis=0))
    lowest = inside.shape[0] - 1 - np.argmax(inside[::-1, columns], axis=0)
    u = np.tile(columns + corner[0], len(settings.foot_rows))
    v = np.concatenate([lowest + corner[1] + rows for rows in settings.foot_rows])
    in_picture = v < view.depth_m.shape[0]
    u, v = u[in_picture], v[in_picture]
    depth_m = view.depth_m[v, u].astype(np.float64)
    u, v, depth_m = (values[depth_m > 0.0] for values in (u, v, depth_m))
    if len(depth_m) < len(columns):
        return None
    heights_m = view.T_room_camera.apply(back_project(u, v, depth_m, view.intrinsics))[:, 2]
    low_m, middle_m, high_m = np.quantile(heights_m, (0.25, 0.5, 0.75))
    return float(middle_m) if high_m - low_m < settings.foot_spread_m else None


def _touches_border(x: int, y: int, width: int, height: int, intrinsics: Intrinsics, border_px: int) -> bool:
    return (
        x < border_px
        or y < border_px
        or x + width > intrinsics.width - border_px
        or y + height > intrinsics.height - border_px
    )


def _occluded_rim(
    mask: NDArray[np.bool_], depth_m: NDArray[np.float32], box: tuple[int, int, int, int], near_m: float
) -> float:
    """Part of the ring two pixels around the mask that is clearly nearer than the thing itself."""
    x, y, width, height = box
    rows, columns = slice(max(y - 3, 0), y + height + 3), slice(max(x - 3, 0), x + width + 3)
    inside = np.ascontiguousarray(mask[rows, columns]).view(np.uint8)
    ring = (cv2.dilate(inside, _SQUARE, iterations=3) > 0) & (cv2.dilate(inside, _SQUARE) == 0)
    ring_m = depth_m[rows, columns][ring]
    return float(np.mean((ring_m > 0.0) & (ring_m < near_m - 0.04))) if len(ring_m) else 0.0
