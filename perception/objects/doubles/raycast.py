"""A tiny analytic world of boxes and cylinders that renders color, depth and masks: the double of a camera and its
network.

For tests and benchmarks of everything after the network. Exact up to the pixel; noise is added on purpose and seeded.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from perception.panoptic import Instance, PanopticScene
from perception.ports import Intrinsics, RgbdFrame
from scene_graph.geometry.se3 import SE3
from scene_graph.nodes import Point3

Array = NDArray[np.float64]
INTRINSICS = Intrinsics(fx=277.1, fy=277.1, cx=159.5, cy=119.5, width=320, height=240)
_LIGHT = np.array((0.3, 0.5, 0.81))
_NEAREST_M = 0.01
"""Nearer than that to the camera, a corner is not projected."""


@dataclass(frozen=True, kw_only=True)
class Solid:
    """A box, or a cylinder of diameter ``size_m[0]``; ``center`` is its middle, ``color`` RGB 0 to 255, ``confidence``
    with what probability it is recognized.
    """

    label: str
    center: Point3
    size_m: Point3
    yaw_rad: float = 0.0
    cylinder: bool = False
    color: Point3 = (200.0, 30.0, 30.0)
    confidence: float = 0.95

    def moved_to(self, center: Point3) -> Solid:
        """The same thing elsewhere."""
        return replace(self, center=center)

    def corners(self) -> Array:
        """(8, 3) of the upright box around it, in the room frame."""
        size_m = (self.size_m[0], self.size_m[0], self.size_m[2]) if self.cylinder else self.size_m
        signs = np.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
        return SE3.from_xyz_yaw(*self.center, self.yaw_rad).apply(signs * size_m)

    def intersect(self, origin: Array, rays: Array) -> tuple[Array, Array]:
        """Distance along each ray (N, 3), infinite for a miss, and the unit normal (N, 3) there."""
        T_object_room = SE3.from_xyz_yaw(*self.center, self.yaw_rad).inverse()
        start, directions = T_object_room.apply(origin), rays @ T_object_room.rotation().T
        distance, normal = (self._round if self.cylinder else self._flat)(start, directions)
        return distance, normal @ T_object_room.rotation()

    def _flat(self, start: Array, rays: Array) -> tuple[Array, Array]:
        half = np.array(self.size_m) / 2.0
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = (-half - start) / rays, (half - start) / rays
        near, far = np.fmin(a, b), np.fmax(a, b)
        axis = np.argmax(near, axis=1)
        entry, leave = near.max(axis=1), far.min(axis=1)
        normal = np.zeros_like(rays)
        index = np.arange(len(rays))
        normal[index, axis] = -np.sign(rays[index, axis])
        return np.where((entry < leave) & (entry > 0.0), entry, np.inf), normal

    def _round(self, start: Array, rays: Array) -> tuple[Array, Array]:
        radius, half = self.size_m[0] / 2.0, self.size_m[2] / 2.0
        a = np.maximum((rays[:, :2] ** 2).sum(axis=1), 1e-12)
        b = rays[:, :2] @ start[:2]
        root = b**2 - a * (start[:2] @ start[:2] - radius**2)
        side = np.where(root >= 0.0, (-b - np.sqrt(np.maximum(root, 0.0))) / a, np.inf)
        side_z = start[2] + np.where(np.isfinite(side), side, 0.0) * rays[:, 2]
        side = np.where((side > 0.0) & (np.abs(side_z) <= half), side, np.inf)
        with np.errstate(divide="ignore", invalid="ignore"):
            cap = (np.copysign(half, start[2]) - start[2]) / rays[:, 2]
        cap = np.where(np.isfinite(cap) & (cap > 0.0) & (abs(start[2]) > half), cap, np.inf)
        cap_xy = start[:2] + np.where(np.isfinite(cap), cap, 0.0)[:, None] * rays[:, :2]
        cap = np.where((cap_xy**2).sum(axis=1) <= radius**2, cap, np.inf)
        distance = np.minimum(side, cap)
        hit = start + np.where(np.isfinite(distance), distance, 0.0)[:, None] * rays
        normal = np.where(
            (cap <= side)[:, None],
            np.array((0.0, 0.0, np.sign(start[2]))),
            np.column_stack((hit[:, :2] / radius, np.zeros(len(rays)))),
        )
        return distance, normal


def look_at(eye: Point3, target: Point3) -> SE3:
    """``T_room_camera`` of a level camera at ``eye`` whose optical axis goes through ``target``."""
    forward = np.array(target) - np.array(eye)
    forward /= np.linalg.norm(forward)
    right = np.cross(forward, (0.0, 0.0, 1.0))
    right /= np.linalg.norm(right)
    return SE3.from_rotation(np.column_stack((right, np.cross(forward, right), forward)), np.array(eye))


@dataclass(frozen=True, kw_only=True, eq=False)
class Rendering:
    """Color, depth along the optical axis, and ``ids`` (H, W): index of the solid, -1 for floor and walls."""

    rgb: NDArray[np.uint8]
    depth_m: NDArray[np.float32]
    ids: NDArray[np.int32]


def render(solids: Sequence[Solid], T_room_camera: SE3, intrinsics: Intrinsics = INTRINSICS) -> Rendering:
    """What a camera sees of the solids, a floor at z = 0 and walls five meters around the origin."""
    v, u = np.mgrid[0 : intrinsics.height, 0 : intrinsics.width]
    x, y = (u - intrinsics.cx) / intrinsics.fx, (v - intrinsics.cy) / intrinsics.fy
    rays = np.stack((x, y, np.ones_like(x)), axis=-1) @ T_room_camera.rotation().T
    origin = T_room_camera.translation_m
    depth = _enclosure(origin, rays.reshape(-1, 3)).reshape(v.shape)
    ids, rgb = np.full(v.shape, -1, dtype=np.int32), np.full((*v.shape, 3), 150.0)
    for index, solid in enumerate(solids):
        window = _window(solid, T_room_camera, intrinsics)
        distance, normal = solid.intersect(origin, rays[window].reshape(-1, 3))
        nearer = distance < depth[window].reshape(-1)
        rows, columns = (places[window].reshape(-1)[nearer] for places in (v, u))
        depth[rows, columns], ids[rows, columns] = distance[nearer], index
        light = 0.45 + 0.55 * np.clip(normal[nearer] @ _LIGHT, 0.0, 1.0)
        rgb[rows, columns] = np.array(solid.color) * light[:, None]
    return Rendering(rgb=rgb.astype(np.uint8), depth_m=depth.astype(np.float32), ids=ids)


def _window(solid: Solid, T_room_camera: SE3, intrinsics: Intrinsics) -> tuple[slice, slice]:
    """Rows and columns of the image outside of which the solid is not seen: those of all where it reaches behind the
    camera.
    """
    corners = T_room_camera.inverse().apply(solid.corners())
    depth = corners[:, 2]
    if depth.min() < _NEAREST_M:
        everywhere = slice(0, None) if depth.max() > 0.0 else slice(0, 0)
        return everywhere, everywhere
    u = corners[:, 0] / depth * intrinsics.fx + intrinsics.cx
    v = corners[:, 1] / depth * intrinsics.fy + intrinsics.cy
    (top, bottom), (left, right) = ((max(0, int(each.min()) - 1), max(0, int(each.max()) + 2)) for each in (v, u))
    return slice(top, bottom), slice(left, right)


def rgbd_frame(
    rendering: Rendering,
    *,
    stamp_s: float,
    T_base_camera: SE3,
    random: Generator | None = None,
    noise_per_m: float = 1.5e-3,
) -> RgbdFrame:
    """A camera frame; ``random`` adds depth noise of sigma ``noise_per_m`` z squared."""
    depth_m = rendering.depth_m
    if random is not None:
        noise = random.standard_normal(depth_m.shape) * noise_per_m * depth_m.astype(np.float64) ** 2
        depth_m = (depth_m + noise).astype(np.float32)
    return RgbdFrame(
        stamp_s=stamp_s, rgb=rendering.rgb, depth_m=depth_m, intrinsics=INTRINSICS, T_base_camera=T_base_camera
    )


def panoptic_scene(
    rendering: Rendering,
    solids: Sequence[Solid],
    *,
    stamp_s: float,
    minimum_pixels: int = 25,
    blind: Sequence[int] = (),
) -> PanopticScene:
    """A perfect network's answer, except that it is ``blind`` to some solids."""
    instances = []
    for index, solid in enumerate(solids):
        mask = rendering.ids == index
        if index not in blind and int(mask.sum()) >= minimum_pixels:
            instances.append(
                Instance(
                    label=solid.label,
                    score=solid.confidence,
                    mask=mask,
                    label_distribution=((solid.label, solid.confidence),),
                )
            )
    return PanopticScene(stamp_s=stamp_s, instances=tuple(instances), relations=())


def _enclosure(origin: Array, rays: Array, half_m: float = 5.0) -> Array:
    with np.errstate(divide="ignore"):
        floor = np.where(rays[:, 2] < -1e-9, -origin[2] / rays[:, 2], np.inf)
        walls = [
            np.where(np.abs(rays[:, k]) > 1e-9, (np.copysign(half_m, rays[:, k]) - origin[k]) / rays[:, k], np.inf)
            for k in (0, 1)
        ]
    return np.asarray(np.minimum(floor, np.minimum(*walls)), dtype=np.float64)
