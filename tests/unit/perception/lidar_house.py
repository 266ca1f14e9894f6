"""A house of vertical faces and an exact multi-ring LiDAR in it: the truth for tests of the LiDAR concepts."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.geometry.planar import Pose2
from perception.ports import LidarScan
from scene_graph.geometry.se3 import SE3

Array = NDArray[np.float64]

ELEVATIONS_RAD = np.deg2rad([-60, -48, -38, -29, -21, -14, -7, -1.5, 2, 4, 6.5, 10, 15, 22, 31, 42])
AZIMUTHS_RAD = np.deg2rad(np.arange(900) * 0.4 - 180.0)
LIDAR_HEIGHT_M = 1.6
MAX_RANGE_M = 30.0


@dataclass(frozen=True, kw_only=True)
class Door:
    """A gap through the wall between two rooms (or a room and ``"outside"``)."""

    rooms: tuple[str, str]
    center: tuple[float, float]
    width: float = 0.9
    height: float = 2.0
    open: bool = True


@dataclass(frozen=True, kw_only=True)
class Box:
    """Furniture: an upright box standing on the floor."""

    center: tuple[float, float]
    size: tuple[float, float, float]
    yaw_rad: float = 0.0


@dataclass(kw_only=True)
class House:
    """Rooms as inner outlines (counter-clockwise), doors, furniture."""

    rooms: dict[str, Array]
    doors: list[Door] = field(default_factory=list)
    boxes: list[Box] = field(default_factory=list)
    height: float = 2.5
    wall_thickness: float = 0.2

    def faces(self) -> Array:
        """(S, 6) vertical faces: x0, y0, x1, y1, bottom, top."""
        faces: list[tuple[float, ...]] = []
        for name, polygon in self.rooms.items():
            for start, end in zip(polygon, np.roll(polygon, -1, axis=0), strict=True):
                faces += self._wall_faces(name, start, end)
        for box in self.boxes:
            corners = _box_corners(box)
            faces += [
                (*start, *end, 0.0, box.size[2])
                for start, end in zip(corners, np.roll(corners, -1, axis=0), strict=True)
            ]
        return np.array(faces)

    def _wall_faces(self, name: str, start: Array, end: Array) -> list[tuple[float, ...]]:
        length = float(np.linalg.norm(end - start))
        along = (end - start) / length
        inward = np.array([-along[1], along[0]])
        faces: list[tuple[float, ...]] = []
        gaps = []
        for door in self.doors:
            offset = np.array(door.center) - start
            station, depth = float(offset @ along), float(-offset @ inward)
            if name in door.rooms and 0.0 <= depth <= self.wall_thickness and 0.0 < station < length:
                gaps.append((station - door.width / 2, station + door.width / 2, door, depth))
        cursor = 0.0
        for left, right, door, depth in sorted(gaps, key=lambda gap: gap[0]):
            faces.append((*(start + cursor * along), *(start + left * along), 0.0, self.height))
            faces.append((*(start + left * along), *(start + right * along), door.height, self.height))
            other_side = -2.0 * depth * inward
            for station in (left, right):
                post = start + station * along
                faces.append((*post, *(post + other_side), 0.0, door.height))
            if not door.open:
                middle = -depth * inward
                faces.append((*(start + left * along + middle), *(start + right * along + middle), 0.0, door.height))
            cursor = right
        faces.append((*(start + cursor * along), *end, 0.0, self.height))
        return faces


def _box_corners(box: Box) -> Array:
    half = np.array(box.size[:2]) / 2
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]) * half
    return Pose2(*box.center, box.yaw_rad).apply(corners)


def cast(
    house: House, pose: Pose2, rng: np.random.Generator, *, sigma_m: float = 0.02, stamp_s: float = 0.0
) -> LidarScan:
    """One revolution of the LiDAR at ``pose``, with Gaussian range noise."""
    faces = house.faces()
    angles = AZIMUTHS_RAD + pose.yaw_rad
    directions = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    start, edge = faces[:, 0:2] - pose.position_m, faces[:, 2:4] - faces[:, 0:2]
    cross = directions[:, None, 0] * edge[None, :, 1] - directions[:, None, 1] * edge[None, :, 0]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        distance = (start[:, 0] * edge[:, 1] - start[:, 1] * edge[:, 0])[None, :] / cross
        station = (start[None, :, 0] * directions[:, None, 1] - start[None, :, 1] * directions[:, None, 0]) / cross
    distance[~((station >= 0.0) & (station <= 1.0) & (distance > 1e-6))] = np.inf
    tangent = np.tan(ELEVATIONS_RAD)
    ranges = np.empty((len(tangent), len(angles)))
    for ring, slope in enumerate(tangent):
        height = LIDAR_HEIGHT_M + np.where(np.isfinite(distance), distance, 0.0) * slope
        visible = np.where((height >= faces[:, 4]) & (height <= faces[:, 5]), distance, np.inf)
        ranges[ring] = visible.min(axis=1)
        if slope < 0:
            ranges[ring] = np.minimum(ranges[ring], -LIDAR_HEIGHT_M / slope)
    ranges = ranges / np.cos(ELEVATIONS_RAD)[:, None]
    ranges[(ranges > MAX_RANGE_M) | (ranges < 0.15)] = np.inf
    noisy = ranges + rng.normal(0.0, sigma_m, ranges.shape)
    return LidarScan(
        stamp_s=stamp_s,
        ranges_m=np.where(np.isfinite(ranges), noisy, np.inf).astype(np.float32),
        elevations_rad=ELEVATIONS_RAD,
        azimuths_rad=AZIMUTHS_RAD,
        T_base_lidar=SE3.from_xyz_yaw(0.0, 0.0, LIDAR_HEIGHT_M, 0.0),
    )


def l_shape() -> Array:
    """(6, 2) an L of 6 m x 5 m with 3 m wide legs."""
    return np.array([[0.0, 0.0], [6.0, 0.0], [6.0, 2.5], [3.0, 2.5], [3.0, 5.0], [0.0, 5.0]])


def t_shape() -> Array:
    """(8, 2) a T of 8 m x 6 m with a 2 m wide stem."""
    return np.array([[0, 0], [8, 0], [8, 2], [5, 2], [5, 6], [3, 6], [3, 2], [0, 2]], dtype=np.float64)


def u_shape() -> Array:
    """(8, 2) a U of 8 m x 6 m with 2 m wide legs."""
    return np.array([[0, 0], [8, 0], [8, 6], [6, 6], [6, 2], [2, 2], [2, 6], [0, 6]], dtype=np.float64)


def rectangle(width: float, depth: float, *, x: float = 0.0, y: float = 0.0) -> Array:
    """(4, 2) outline with its lower left corner at (x, y), counter-clockwise."""
    return np.array([[x, y], [x + width, y], [x + width, y + depth], [x, y + depth]])


def turned(house: House, angle_rad: float) -> House:
    """The same house turned about the origin."""
    turn = Pose2(0.0, 0.0, angle_rad)
    return House(
        rooms={name: turn.apply(polygon) for name, polygon in house.rooms.items()},
        doors=[
            Door(
                rooms=d.rooms, center=tuple(turn.apply(np.array(d.center))), width=d.width, height=d.height, open=d.open
            )
            for d in house.doors
        ],
        boxes=[
            Box(center=tuple(turn.apply(np.array(b.center))), size=b.size, yaw_rad=b.yaw_rad + angle_rad)
            for b in house.boxes
        ],
        height=house.height,
        wall_thickness=house.wall_thickness,
    )
