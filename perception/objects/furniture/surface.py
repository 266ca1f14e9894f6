"""What has been seen of one piece of furniture, from all sides: a small voxel memory in the room frame.

Furniture seldom fits into one image. Its size is the box around everything seen of it so far.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from perception.objects.seeing.projection import View, project
from perception.objects.seeing.shape import Rectangle, bounding_rectangle
from perception.vocabulary import Category
from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]
_OFFSET = 1 << 20


@dataclass(frozen=True, kw_only=True)
class SurfaceSettings:
    """How furniture is put together from what is seen of it. Chosen on simulated houses, where nothing else is said."""

    voxel_m: float = 0.03
    """Side of a voxel: two sigmas of depth at three meters."""
    capacity: int = 6000
    """Voxels that are kept at most: a wardrobe from all sides."""
    sigma_m: float = 0.02
    """Standard deviation of the middle of a piece, besides that of the robot's pose."""
    denied: float = 1.0
    """Frames that saw a voxel as something else for each that saw it as this, from which on it is not believed."""
    agrees_m: float = 0.04
    """So near to a voxel is the surface that shows it."""
    long: float = 1.4
    """Share of the usual length from which on it is asked whether what was seen hangs together."""
    cluster_m: float = 0.12
    """Cells of this size that touch hang together: what is more than two of them away does not."""
    piece_share: float = 0.25
    """Share of all points that a part of a thing has at least, when something hides what joins it to the rest."""
    square: float = 1.3
    """Long over short side, up to which which is which may be an error of measurement."""
    shallow: float = 0.3
    """Share of the usual depth below which only a front has been seen."""
    shallow_tall: float = 0.6
    """The same where the top is above the camera, so that it cannot show the depth."""
    top: float = 0.985
    """Quantile of the heights of all points that is the top of a piece."""
    same_height_m: float = 0.05
    """Tops that differ by less are one."""
    ragged_m: float = 0.02
    """So far above its top a point of a piece may be."""
    sure_frames: int = 40
    """Frames that agree about how high a piece is, from which on it is not taken to have grown: what is higher stands
    on it, unless as many frames again say otherwise.
    """
    most_frames: int = 150
    """The most of them that count."""


class Box:
    """An upright box: center (3,), size along its own axes, yaw."""

    __slots__ = ("center", "size_m", "yaw_rad")

    def __init__(self, center: Array, size_m: tuple[float, float, float], yaw_rad: float) -> None:
        self.center = center
        self.size_m = size_m
        self.yaw_rad = yaw_rad

    def contains(self, points: Array, margin_m: float = 0.0) -> NDArray[np.bool_]:
        """Which of the points (N, 3) lie inside, with ``margin_m`` to spare."""
        half = np.array(self.size_m) / 2.0 + margin_m
        return np.asarray((np.abs(self.local(points)) <= half).all(axis=1))

    def local(self, points: Array) -> Array:
        """Points (N, 3) in the box's own axes, from its center."""
        cos, sin = np.cos(self.yaw_rad), np.sin(self.yaw_rad)
        x, y, z = (points - self.center).T
        return np.stack((cos * x + sin * y, cos * y - sin * x, z), axis=1)

    def seen_from(self, T_new_old: SE3) -> Box:
        """The same box in another frame."""
        return Box(T_new_old.apply(self.center), self.size_m, self.yaw_rad + T_new_old.yaw_rad)

    def place(self, local: Array) -> Array:
        """Inverse of ``local``."""
        cos, sin = np.cos(self.yaw_rad), np.sin(self.yaw_rad)
        x, y, z = local.T
        return np.stack((cos * x - sin * y, sin * x + cos * y, z), axis=1) + self.center


class SurfaceMemory:
    """Mean point and number of frames of each voxel.

    Attributes:
        points: (V, 3) mean of what fell into each voxel.
        hits: (V,) frames that saw it. misses: (V,) frames that saw something else there.
    """

    def __init__(self, settings: SurfaceSettings = SurfaceSettings()) -> None:
        self._settings = settings
        self._keys = np.zeros(0, dtype=np.int64)
        self.points = np.zeros((0, 3))
        self.hits = np.zeros(0)
        self.misses = np.zeros(0)

    def add(self, points: Array, *, frames: float = 1.0) -> None:
        """Points (N, 3) that count as ``frames`` frames."""
        if len(points) == 0:
            return
        cells = np.floor(points / self._settings.voxel_m).astype(np.int64) + _OFFSET
        keys = (cells[:, 0] << 42) | (cells[:, 1] << 21) | cells[:, 2]
        new_keys, inverse, counts = np.unique(keys, return_inverse=True, return_counts=True)
        sums = np.stack([np.bincount(inverse, points[:, axis]) for axis in range(3)], axis=1)
        means = sums / counts[:, None]
        place = np.atleast_1d(np.searchsorted(self._keys, new_keys))
        inside = place < len(self._keys)
        known = np.zeros(len(new_keys), dtype=bool)
        known[inside] = self._keys[place[inside]] == new_keys[inside]
        self._blend(place[known], means[known], frames)
        self._append(new_keys[~known], means[~known], frames)

    def _blend(self, index: NDArray[np.intp], means: Array, frames: float) -> None:
        self.hits[index] += frames
        gain = frames / np.minimum(self.hits[index], 30.0)
        self.points[index] += gain[:, None] * (means - self.points[index])

    def _append(self, keys: NDArray[np.int64], means: Array, frames: float) -> None:
        room = max(self._settings.capacity - len(self._keys), 0)
        all_keys = np.concatenate((self._keys, keys[:room]))
        order = np.argsort(all_keys, kind="stable")
        self._keys = all_keys[order]
        self.points = np.concatenate((self.points, means[:room]))[order]
        self.hits = np.concatenate((self.hits, np.full(len(keys[:room]), frames)))[order]
        self.misses = np.concatenate((self.misses, np.zeros(len(keys[:room]))))[order]

    def deny(self, which: NDArray[np.bool_]) -> None:
        """One more frame showed that ``which`` (V,) belong to something else."""
        self.misses[which] += 1.0

    @property
    def reliable(self) -> Array:
        """(V, 3) points seen in at least two frames and not denied by as many, or all while hardly any are."""
        often = (self.hits >= 2.0) & (self.misses <= self._settings.denied * self.hits)
        return self.points[often] if np.count_nonzero(often) >= 20 else self.points


def furniture_box(
    memory: SurfaceMemory, category: Category, camera: Array, settings: SurfaceSettings = SurfaceSettings()
) -> Box:
    """The box of a piece of furniture from its surface.

    What stands on the floor reaches down to it. Where only a front has shown, the depth is the usual one, away from
    ``camera`` (3,).
    """
    points = _of_a_piece(memory.reliable, category, settings)
    low_z, high_z = (float(z) for z in np.quantile(points[:, 2], (0.02, settings.top)))
    low_z = 0.0 if category.floor else low_z
    rectangle = bounding_rectangle(points[:, :2], align_to_room=True)
    rectangle = _deepened(rectangle, category, camera, settings, top_hidden=high_z > camera[2] - 0.05)
    rim_m = _rim_m(settings)
    center = np.array((rectangle.center_x_m, rectangle.center_y_m, (low_z + high_z) / 2.0))
    sides_m = (rectangle.x_m + rim_m, rectangle.y_m + rim_m, max(high_z - low_z, 0.01))
    return Box(center, sides_m, rectangle.yaw_rad)


def _rim_m(settings: SurfaceSettings) -> float:
    """How much farther a piece reaches than its outermost points, both sides of it together."""
    return 0.5 * settings.voxel_m


def _of_a_piece(points: Array, category: Category, settings: SurfaceSettings) -> Array:
    """Points (N, 3) without small clusters apart from the rest, where all together are too long for the kind of thing:
    masks now and then take in an edge of what stands beside it.
    """
    usual_m = max(category.size_m[:2])
    spread_m = np.ptp(points[:, :2], axis=0).max() if len(points) else 0.0
    if usual_m <= 0.0 or spread_m <= settings.long * usual_m:
        return points
    cells = np.floor((points[:, :2] - points[:, :2].min(axis=0)) / settings.cluster_m).astype(np.int64)
    taken = np.zeros(cells.max(axis=0) + 1, dtype=bool)
    taken[cells[:, 0], cells[:, 1]] = True
    clusters, _ = label(taken, structure=np.ones((3, 3)))
    cluster = clusters[cells[:, 0], cells[:, 1]]
    kept = np.bincount(cluster) >= settings.piece_share * len(points)
    return points[kept[cluster]] if kept.any() else points


def _deepened(
    rectangle: Rectangle, category: Category, camera: Array, settings: SurfaceSettings, *, top_hidden: bool
) -> Rectangle:
    usual_m = min(category.size_m[:2]) or min(rectangle.x_m, 0.4)
    if rectangle.y_m >= (settings.shallow_tall if top_hidden else settings.shallow) * usual_m:
        return rectangle
    missing_m = usual_m - rectangle.y_m
    normal = np.array((-np.sin(rectangle.yaw_rad), np.cos(rectangle.yaw_rad)))
    outward = np.array((rectangle.center_x_m, rectangle.center_y_m)) - camera[:2]
    shift = normal * (np.sign(normal @ outward) or 1.0) * missing_m / 2.0
    return Rectangle(
        center_x_m=float(rectangle.center_x_m + shift[0]),
        center_y_m=float(rectangle.center_y_m + shift[1]),
        x_m=max(rectangle.x_m, usual_m) if rectangle.x_m < usual_m else rectangle.x_m,
        y_m=usual_m,
        yaw_rad=rectangle.yaw_rad,
    )


def turned_like(box: Box, yaw_rad: float, settings: SurfaceSettings = SurfaceSettings()) -> Box:
    """A box about as deep as it is wide, with its axes by quarter turns as near to ``yaw_rad`` as may be: which of its
    sides is the longer one may change with every frame, and what is tied to its axes is not to jump about.
    """
    x_m, y_m, z_m = box.size_m
    if max(x_m, y_m) > settings.square * min(x_m, y_m):
        return box
    quarters = round((yaw_rad - box.yaw_rad) / (np.pi / 2.0))
    turned_rad = box.yaw_rad + quarters * np.pi / 2.0
    return Box(box.center, (y_m, x_m, z_m) if quarters % 2 else box.size_m, turned_rad)


class SurfaceBelief:
    """Belief about place and size of one piece of furniture, in the frame of its room.

    Attributes:
        memory: what has been seen of it.
        box: the box around it.
    """

    def __init__(self, settings: SurfaceSettings = SurfaceSettings()) -> None:
        self._settings = settings
        self.memory = SurfaceMemory(settings)
        self.box = Box(np.zeros(3), (0.1, 0.1, 0.1), 0.0)
        self._pose_covariance: Array | None = None
        self._category: Category | None = None
        self._first_camera: Array | None = None
        self._as_high = 0
        self._top_m = _top_of(self.box)

    @classmethod
    def of(cls, box: Box, settings: SurfaceSettings = SurfaceSettings(), *, frames: int = 0) -> SurfaceBelief:
        """A belief that starts from a remembered box, which ``frames`` frames have shown."""
        belief = cls(settings)
        belief._as_high = min(frames, settings.most_frames)
        rim_m = _rim_m(settings)
        inner_m = (max(box.size_m[0] - rim_m, 0.0), max(box.size_m[1] - rim_m, 0.0), box.size_m[2])
        belief.memory.add(_faces(Box(box.center, inner_m, box.yaw_rad), settings.cluster_m), frames=2.0)
        belief.box = box
        belief._top_m = _top_of(box)
        return belief

    @property
    def covariance(self) -> Array:
        """(3, 3) of the center."""
        pose = self._pose_covariance if self._pose_covariance is not None else np.zeros((3, 3))
        return pose + np.eye(3) * self._settings.sigma_m**2

    def observe(
        self, points: Array, pose_covariance: Array, category: Category, camera: Array, *, top_shown: bool = True
    ) -> None:
        """Take in the points (N, 3) of one frame, seen from ``camera`` (3,), which may have cut off the top."""
        if self._pose_covariance is None or np.trace(pose_covariance) < np.trace(self._pose_covariance):
            self._pose_covariance = pose_covariance
        self.memory.add(points[self._of_its_height(points, top_shown=top_shown)])
        self._first_camera = camera if self._first_camera is None else self._first_camera
        self._category = category
        self._refresh()

    def _of_its_height(self, points: Array, *, top_shown: bool) -> NDArray[np.bool_]:
        """Which of the points (N, 3) of one frame are not above a piece whose height is known by now."""
        if len(points) == 0 or len(self.memory.points) == 0:
            return np.ones(len(points), dtype=bool)
        above_m = float(np.quantile(points[:, 2], self._settings.top)) - self._top_m
        if abs(above_m) <= self._settings.same_height_m and top_shown:
            self._as_high = min(self._as_high + 1, self._settings.most_frames)
        elif above_m > self._settings.same_height_m:
            self._as_high = max(self._as_high - 1, 0)
        if not self._sure_of_height:
            return np.ones(len(points), dtype=bool)
        return np.asarray(points[:, 2] <= self._top_m + self._settings.ragged_m)

    @property
    def _sure_of_height(self) -> bool:
        return self._as_high >= self._settings.sure_frames

    def deny_outside(self, mask: NDArray[np.bool_], view: View, T_view_room: SE3) -> None:
        """Doubt what is in plain sight and yet outside ``mask`` (H, W), all that the network took for this piece."""
        pixels, depth_m = project((view.T_camera_room @ T_view_room).apply(self.memory.points), view.intrinsics)
        height, width = mask.shape
        with np.errstate(invalid="ignore"):
            cells = np.nan_to_num(np.round(pixels), nan=-1.0)
            inside = (cells >= 0.0).all(axis=1) & (cells[:, 0] < width) & (cells[:, 1] < height)
        u, v = np.where(inside[:, None], cells, 0.0).astype(np.int64).T
        plain = inside & (np.abs(view.depth_m[v, u] - depth_m) < self._settings.agrees_m)
        self.memory.deny(plain & ~mask[v, u])

    def yield_to(self, others: Sequence[Box]) -> None:
        """Doubt what lies in the boxes of other pieces: it was taken for this one before they were known."""
        for box in others:
            self.memory.deny(box.contains(self.memory.points))

    def _refresh(self) -> None:
        """The box around everything seen; what hides behind a lone front lies away from where that was first seen."""
        if self._category is not None and self._first_camera is not None:
            box = furniture_box(self.memory, self._category, self._first_camera, self._settings)
            self.box = turned_like(box, self.box.yaw_rad, self._settings)
            if not self._sure_of_height:
                self._top_m = _top_of(self.box)

    def absorb(self, part: SurfaceBelief) -> None:
        """Take in what was seen of a part of this piece; the larger box stands until the next sight."""
        self.memory.add(part.memory.reliable, frames=2.0)
        self._refresh()

    def put_at(self, position: Array, sigma_m: float, yaw_rad: float | None) -> None:
        """Place it where it must be now, other than by sight."""
        turned = self.box.yaw_rad if yaw_rad is None else yaw_rad
        self.box = Box(np.asarray(position), self.box.size_m, turned)
        self.memory = SurfaceBelief.of(self.box, self._settings).memory
        self._top_m = _top_of(self.box)
        self._pose_covariance = np.eye(3) * sigma_m**2

    def change_frame(self, T_new_old: SE3) -> None:
        """Express it in another room's frame."""
        seen, self.memory = self.memory, SurfaceMemory(self._settings)
        self.memory.add(T_new_old.apply(seen.reliable), frames=2.0)
        self._first_camera = T_new_old.apply(self._first_camera) if self._first_camera is not None else None
        self.box = self.box.seen_from(T_new_old)
        self._top_m += T_new_old.z_m


def _top_of(box: Box) -> float:
    return float(box.center[2]) + box.size_m[2] / 2.0


def _faces(box: Box, step_m: float) -> Array:
    """(M, 3) points on the faces of a box."""
    ticks = [np.linspace(-0.5, 0.5, max(9, int(side_m / step_m) + 2)) for side_m in box.size_m]
    grid = np.stack(np.meshgrid(*ticks, indexing="ij"), axis=-1).reshape(-1, 3)
    faces = grid[(np.abs(grid) == 0.5).any(axis=1)]
    return box.place(faces * np.array(box.size_m))
