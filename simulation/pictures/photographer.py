"""Takes pictures of a house from where a robot could stand, with the truth about them: for scoring and training."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pybullet as p
from numpy.typing import NDArray

from scene_graph.geometry.se3 import SE3
from simulation.furnishing.catalog import category_named
from simulation.furnishing.shapes import Size3
from simulation.generation.stocking import is_free
from simulation.houses.house import House, Room
from simulation.pictures.photographs import FLOOR, MOST_INSTANCES, NOTHING, WALL, Photograph, photograph
from simulation.pictures.relations import Solid
from simulation.robot.camera import render
from simulation.robot.description import RobotDescription
from simulation.world.world import World


@dataclass(frozen=True, kw_only=True)
class PhotographerSettings:
    """From where pictures are taken, and of what."""

    robot_m: float = 0.3
    """Nothing stands nearer to where a picture is taken: the robot's own radius."""
    tries: int = 40
    """To find such a place."""
    on_floor_m: float = 0.03
    """What nothing bears and is lower than this lies on the floor."""
    upright: float = 0.95
    """Cosine of the lean up to which a thing has the box of its known size: 18 degrees."""
    aimed_share: float = 0.75
    """So many pictures are of something; chosen: the rest shows what a robot sees that looks about."""
    tilts_rad: tuple[float, float] = (-0.6, 0.05)
    """Of pictures of nothing in particular, as the robot tilts its camera when it drives."""
    aim_std_m: float = 0.15
    """How far what a picture is of lies from its middle."""
    near_m: float = 0.4
    away_shape: float = 3.0
    away_scale_m: float = 0.38
    """What a picture is of is this near at least, and a gamma-distributed way farther: 1.5 m in the mean."""


class Photographer:
    """A settled house and what is where in it."""

    def __init__(
        self,
        house: House,
        *,
        client: int,
        rng: np.random.Generator,
        robot: RobotDescription = RobotDescription(),
        settings: PhotographerSettings = PhotographerSettings(),
    ) -> None:
        self._house, self._client, self._rng, self._robot, self._settings = house, client, rng, robot, settings
        self._world = World(house, client=client, rng=rng)
        self.categories, self.solids, self._index_of_body = _inventory(self._world, client, settings)
        self._targets = [
            np.array(solid.center_m)
            for category, solid in zip(self.categories, self.solids, strict=True)
            if category not in ("wall", "floor", "door") and min(solid.size_m) > 0.0
        ]

    def pictures(self, count: int) -> Iterator[Photograph]:
        """``count`` pictures, most of them of something."""
        for _ in range(count):
            yield self.photograph(self._viewpoint())

    def photograph(self, T_world_camera: SE3) -> Photograph:
        """What a camera sees whose optical frame is there."""
        picture = render(T_world_camera, self._client, self._robot.camera)
        ids = self._index_of_body[np.where(picture.bodies >= 0, picture.bodies, len(self._index_of_body) - 1)]
        return photograph(picture.rgb, ids, picture.depth_m, self.categories, self.solids)

    def _viewpoint(self) -> SE3:
        """A free place in some room, and a look at something near, or anywhere."""
        rng, settings, height_m = self._rng, self._settings, self._robot.geometry.camera_height_m
        tilt_limits = self._robot.limits.tilt_rad
        aimed = bool(self._targets) and rng.random() < settings.aimed_share
        target = self._targets[rng.integers(len(self._targets))] if aimed else None
        x, y = self._standpoint(target)
        if target is None:
            yaw, tilt = float(rng.uniform(-math.pi, math.pi)), float(rng.uniform(*settings.tilts_rad))
        else:
            dx, dy, dz = target + rng.normal(0.0, settings.aim_std_m, 3) - (x, y, height_m)
            yaw, tilt = math.atan2(dy, dx), float(np.clip(math.atan2(dz, math.hypot(dx, dy)), *tilt_limits))
        return looking(np.array((x, y, height_m)), yaw, tilt)

    def _standpoint(self, target: NDArray[np.float64] | None) -> tuple[float, float]:
        rooms, settings = self._house.rooms, self._settings
        x, y = 0.0, 0.0
        for _ in range(settings.tries):
            if target is None:
                room = rooms[self._rng.integers(len(rooms))]
                corners = np.array(room.polygon)
                x, y = (float(c) for c in self._rng.uniform(corners.min(axis=0), corners.max(axis=0)))
            else:
                away = settings.near_m + self._rng.gamma(settings.away_shape, settings.away_scale_m)
                angle = self._rng.uniform(-math.pi, math.pi)
                x, y = float(target[0] + away * math.cos(angle)), float(target[1] + away * math.sin(angle))
            if any(self._stands_free(room, (x, y), target) for room in rooms):
                break
        return x, y

    def _stands_free(self, room: Room, point: tuple[float, float], target: NDArray[np.float64] | None) -> bool:
        together = target is None or is_free(room, (), (float(target[0]), float(target[1])), 0.0)
        return together and is_free(room, self._house.furniture, point, self._settings.robot_m)


@contextmanager
def photographer(house: House, *, seed: int) -> Iterator[Photographer]:
    """A photographer with a physics client of its own."""
    client = p.connect(p.DIRECT)
    try:
        yield Photographer(house, client=client, rng=np.random.default_rng(seed))
    finally:
        p.disconnect(physicsClientId=client)


def looking(eye_m: NDArray[np.float64], yaw_rad: float, tilt_rad: float) -> SE3:
    """The pose in the house of the optical frame of a level camera that looks along ``yaw_rad``, up by ``tilt_rad``."""
    c, s, ct, st = math.cos(yaw_rad), math.sin(yaw_rad), math.cos(tilt_rad), math.sin(tilt_rad)
    forward, right = np.array((c * ct, s * ct, st)), np.array((s, -c, 0.0))
    return SE3.from_rotation(np.stack((right, np.cross(forward, right), forward), axis=1), eye_m)


def _inventory(
    world: World, client: int, settings: PhotographerSettings
) -> tuple[list[str], list[Solid], NDArray[np.uint8]]:
    """What there is, where, and (bodies + 1,) the index of each body, ``NOTHING`` last."""
    nowhere = Solid(center_m=(0.0, 0.0, 0.0), size_m=(0.0, 0.0, 0.0), yaw_rad=0.0, furniture=True)
    categories, solids = ["wall", "floor"], [nowhere, nowhere]
    bodies = [p.getBodyUniqueId(n, physicsClientId=client) for n in range(p.getNumBodies(physicsClientId=client))]
    index_of_body = np.full(max(bodies, default=0) + 2, NOTHING, dtype=np.uint8)
    truth = world.truth(stamp_s=0.0, robot_pose=(0.0, 0.0, 0.0), holding=None, collisions=0)
    loose = {entry["id"]: entry for entry in truth["objects"]}
    sizes = _sizes(world.house)
    index_of: dict[str, int] = {}
    bodies.sort(key=lambda body: world.id_of(body) in loose)  # what carries comes before what is carried
    for body in bodies:
        category, name = world.category_of(body), world.id_of(body)
        if category in ("wall", "floor"):
            index_of_body[body] = WALL if category == "wall" else FLOOR
        elif category is not None and len(categories) < MOST_INSTANCES:
            index_of_body[body] = len(categories)
            stays = name not in loose and category != "person"
            solid = _solid(body, client, sizes.get(name or ""), settings.upright, furniture=stays)
            if name is not None:
                index_of[name] = len(categories)
            categories.append(category)
            solids.append(replace(solid, attached_to=WALL) if category == "door" else solid)
    for name, entry in loose.items():
        if name in index_of:
            solids[index_of[name]] = _carried(solids[index_of[name]], entry, index_of, settings.on_floor_m)
    return categories, solids, index_of_body


def _sizes(house: House) -> dict[str, Size3]:
    furniture = {item.id: item.size or category_named(item.category, static=True).size_m for item in house.furniture}
    return furniture | {item.id: item.size or category_named(item.category).size_m for item in house.objects}


def _solid(body: int, client: int, size_m: Size3 | None, least_upright: float, *, furniture: bool) -> Solid:
    """The upright box of a body: of its known size, or, for what lies on its side and for doors, around it."""
    position, quaternion = p.getBasePositionAndOrientation(body, physicsClientId=client)
    upright = p.getMatrixFromQuaternion(quaternion)[8] > least_upright
    if size_m is not None and upright:
        yaw_rad = p.getEulerFromQuaternion(quaternion)[2]
        return Solid(center_m=position, size_m=size_m, yaw_rad=yaw_rad, furniture=furniture)
    low, high = (np.array(corner) for corner in p.getAABB(body, physicsClientId=client))
    center, extent = (low + high) / 2, high - low
    return Solid(
        center_m=(float(center[0]), float(center[1]), float(center[2])),
        size_m=(float(extent[0]), float(extent[1]), float(extent[2])),
        yaw_rad=0.0,
        furniture=furniture,
    )


def _carried(solid: Solid, entry: dict[str, Any], index_of: dict[str, int], on_floor_m: float) -> Solid:
    """With what bears it, as truth has it; what nothing bears and is low lies on the floor."""
    on, inside = index_of.get(entry["on"] or ""), index_of.get(entry["in"] or "")
    if on is None and inside is None and solid.bottom_m < on_floor_m:
        on = FLOOR
    return replace(solid, on=on, inside=inside)
