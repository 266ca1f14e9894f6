"""From the visible surface of a thing to its center and size.

A camera sees the front only, so the mean of the points is not the middle of the thing. What is hidden follows from
symmetry: seen along a horizontal direction, a round or square thing is as deep as it is wide, and its middle lies half
that width behind its front. Where the top is in view, the back edge of the top says how deep it is.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from perception.objects.seeing.projection import Cloud, ProjectionSettings, View
from perception.vocabulary import Category

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class ShapeSettings:
    """How points become a shape. Chosen on rendered things, where nothing else is said."""

    depth_noise_per_m: float = ProjectionSettings.depth_noise_per_m
    """Depth sigma is this times z squared, in meters: the camera's."""
    trim: float = 0.02
    """Share of the points at either end of a side that are noise."""
    top_rows: float = 2.5
    """So many rows of pixels must show of a top to show its back edge."""
    contact: float = 0.15
    """The lowest part of a thing, as a share of its height, to which masks bleed from what it stands on."""
    square_aspect: float = 1.15
    """Long over short side, from which on a thing has a direction."""
    room_aligned_area: float = 1.12
    """So many times larger may be a rectangle along the room's axes than the smallest: furniture stands along walls."""
    depth_doubt: float = 0.08
    """Standard deviation of the middle along the view, as a share of the width, where the depth is known."""
    hidden_doubt: float = 0.3
    """The same where the depth is hidden."""
    lost_px: float = 4.0
    """So many rows of pixels a mask may lack below."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Shape:
    """Where a thing is and how large, in the room frame.

    ``center``: (3,). ``size_m``: extent along its own x, y, z. ``yaw_rad``: its x axis, in (-pi/2, pi/2]; meaningful
    where ``oriented``. ``covariance``: (3, 3) of the center. ``complete``: nothing of it was cut off or hidden.
    """

    center: Array
    size_m: tuple[float, float, float]
    yaw_rad: float
    oriented: bool
    covariance: Array
    complete: bool


@dataclass(frozen=True, kw_only=True)
class Rectangle:
    """A rectangle on the floor plane: ``x_m`` is the side along ``yaw_rad``."""

    center_x_m: float
    center_y_m: float
    x_m: float
    y_m: float
    yaw_rad: float


def measure_shape(cloud: Cloud, view: View, category: Category, settings: ShapeSettings = ShapeSettings()) -> Shape:
    """Center, size and covariance of a thing that can stand on furniture."""
    pixel_m = cloud.range_m / view.intrinsics.fx
    camera = view.T_room_camera.translation_m
    forward, left = _viewing_axes(cloud.points, camera)
    low_z, high_z = _span(cloud.points[:, 2], pixel_m, settings)
    if camera[2] > high_z:
        high_z = _inner(cloud.points[:, 2], settings.trim)[
            1
        ]  # many points lie on the top face: nothing was trimmed there
    body = _above_contact(cloud.points, low_z, high_z, settings.contact)
    along, across = (body - camera) @ forward, (body - camera) @ left
    low_across, high_across = _span(across, pixel_m, settings)
    front, back = _inner(along, settings.trim)
    width = high_across - low_across
    if category.ball and camera[2] > high_z:
        low_z = high_z - width  # from above, the lower part of a ball hides itself
    elif (
        cloud.foot_m is not None
        and low_z - _lost_below_m(camera, cloud.points, settings.lost_px * pixel_m) < cloud.foot_m < low_z
    ):
        low_z = cloud.foot_m
    height = high_z - low_z
    top_in_view = _sees_top(
        camera[2] - high_z, float(front), max(float(back - front), width / 2.0), settings.top_rows * pixel_m
    )
    doubt_m = (settings.depth_doubt if category.round or top_in_view else settings.hidden_doubt) * width
    yaw_rad, oriented = 0.0, False
    middle_across = (low_across + high_across) / 2.0
    if category.round or not top_in_view:
        depth = width if category.round else max(float(back - front), width)
        middle_along = float(front) + depth / 2.0
        size_m = (width, width if category.round else depth, height)
        yaw_rad = 0.0 if category.round else _half_turn(float(np.arctan2(left[1], left[0])))
        xy = camera[:2] + forward[:2] * middle_along + left[:2] * middle_across
    else:
        rectangle = bounding_rectangle(body[:, :2], align_to_room=False, settings=settings)
        size_m = (rectangle.x_m + pixel_m, rectangle.y_m + pixel_m, height)
        yaw_rad, oriented = rectangle.yaw_rad, rectangle.x_m > settings.square_aspect * rectangle.y_m
        xy = np.array((rectangle.center_x_m, rectangle.center_y_m))
    return Shape(
        center=np.array((xy[0], xy[1], (low_z + high_z) / 2.0)),
        size_m=size_m,
        yaw_rad=yaw_rad,
        oriented=oriented,
        covariance=_covariance(cloud, view, (forward, left), (doubt_m, width), settings.depth_noise_per_m),
        complete=not cloud.truncated and cloud.occluded < 0.15,
    )


def bounding_rectangle(
    points_xy: Array, *, align_to_room: bool, settings: ShapeSettings = ShapeSettings()
) -> Rectangle:
    """Smallest rectangle around the points (N, 2), without the outermost two percent.

    ``align_to_room`` prefers the room's axes where that costs little area: furniture stands along walls.
    """
    trimmed = _trimmed(points_xy, settings.trim)
    (center_x, center_y), (first, second), degrees = cv2.minAreaRect(trimmed.astype(np.float32))
    if align_to_room:
        low, high = trimmed.min(axis=0), trimmed.max(axis=0)
        if float(np.prod(high - low)) <= settings.room_aligned_area * first * second + 1e-4:
            (center_x, center_y), (first, second), degrees = (low + high) / 2.0, high - low, 0.0
    yaw_rad = np.deg2rad(degrees)
    if second > first:
        first, second, yaw_rad = second, first, yaw_rad + np.pi / 2.0
    return Rectangle(
        center_x_m=float(center_x),
        center_y_m=float(center_y),
        x_m=float(first),
        y_m=float(second),
        yaw_rad=_half_turn(float(yaw_rad)),
    )


def point_covariance(view: View, point_room: Array) -> Array:
    """(3, 3) covariance in the room of a point seen from a pose that is itself uncertain.

    With ``T_room_base Exp(xi)``, a base point p moves by ``R (rho - p x theta)``.
    """
    R = view.T_room_base.rotation()
    x, y, z = view.T_room_base.inverse().apply(point_room)
    skew = np.array(((0.0, -z, y), (z, 0.0, -x), (-y, x, 0.0)))
    J = np.hstack((R, -R @ skew))
    covariance: Array = J @ view.pose_covariance @ J.T
    return covariance


def _viewing_axes(points: Array, camera: Array) -> tuple[Array, Array]:
    """Horizontal unit vectors away from the camera and to its left."""
    direction = np.median(points[:, :2], axis=0) - camera[:2]
    length = float(np.hypot(*direction))
    x, y = direction / length if length > 1e-3 else (1.0, 0.0)
    return np.array((x, y, 0.0)), np.array((-y, x, 0.0))


def _span(values: Array, pixel_m: float, settings: ShapeSettings) -> tuple[float, float]:
    """Ends of the interval that evenly spread ``values`` fill: inner quantiles stretched back, plus half a pixel."""
    low, high = _inner(values, settings.trim)
    stretch = (high - low) * settings.trim / (1.0 - 2.0 * settings.trim) + pixel_m / 2.0
    return float(low - stretch), float(high + stretch)


def _lost_below_m(camera: Array, points: Array, lost_m: float) -> float:
    """How much of an upright side shows in ``lost_m`` of a plane across the view."""
    x, y, z = np.median(points, axis=0) - camera
    across = float(np.hypot(x, y))
    return lost_m * float(np.hypot(across, z)) / max(across, 1e-3)


def _above_contact(points: Array, low_z: float, high_z: float, contact: float) -> Array:
    """Points (M, 3) without the lowest part, where the mask likes to bleed onto what the thing stands on at equal
    depth.
    """
    kept = points[points[:, 2] > low_z + contact * (high_z - low_z)]
    return kept if high_z - low_z > 0.04 and len(kept) >= 8 else points


def _inner(values: Array, trim: float) -> tuple[float, float]:
    """The quantiles at ``trim`` from both ends."""
    ordered = np.sort(values)
    skipped = int(trim * (len(ordered) - 1))
    return float(ordered[skipped]), float(ordered[-1 - skipped])


def _sees_top(above_m: float, distance_m: float, depth_m: float, least_m: float) -> bool:
    """Whether the top face covers enough image rows to show its back edge."""
    return above_m > 0.0 and depth_m * above_m / max(distance_m, 0.1) > least_m


def _trimmed(points_xy: Array, trim: float) -> Array:
    low, high = np.quantile(points_xy, (trim / 2.0, 1.0 - trim / 2.0), axis=0)
    kept = points_xy[((points_xy >= low) & (points_xy <= high)).all(axis=1)]
    return kept if len(kept) >= 3 else points_xy


def _half_turn(angle_rad: float) -> float:
    """Wraps to (-pi/2, pi/2]: a rectangle looks the same after half a turn."""
    wrapped = (angle_rad + np.pi / 2.0) % np.pi - np.pi / 2.0
    return float(wrapped if wrapped > -np.pi / 2.0 + 1e-9 else np.pi / 2.0)


def _covariance(
    cloud: Cloud, view: View, axes_xy: tuple[Array, Array], scales_m: tuple[float, float], depth_noise_per_m: float
) -> Array:
    """Depth noise and doubt about the hidden half along the view, ragged mask edges across it, and the robot's pose."""
    doubt_m, width_m = scales_m
    pixel_m = cloud.range_m / view.intrinsics.fx
    hidden = 1.0 if not cloud.truncated and cloud.occluded < 0.15 else 4.0
    sigma_along = np.hypot(depth_noise_per_m * cloud.range_m**2, doubt_m) * hidden + 0.002
    sigma_across = (pixel_m + 0.03 * width_m) * hidden + 0.002
    axes = np.stack((*axes_xy, (0.0, 0.0, 1.0)), axis=1)
    sigmas = np.array((sigma_along, sigma_across, sigma_across))
    shape_covariance: Array = (axes * sigmas**2) @ axes.T
    return shape_covariance + point_covariance(view, np.median(cloud.points, axis=0))
