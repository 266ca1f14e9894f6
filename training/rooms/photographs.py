"""Pictures of random rooms with everything that is true in them."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pybullet as p
from numpy.typing import NDArray

from simulation.furnishing.shapes import box
from simulation.pictures.photographs import MOST_INSTANCES, NOTHING, Photograph, photograph
from simulation.robot.camera import BODY_MASK
from simulation.robot.description import RobotDescription
from training.rooms.scene import Item, Scene
from training.rooms.scenes import random_scene, visible_targets
from training.rooms.shapes import Generator, random_color

ROBOT = RobotDescription()
CAMERA = ROBOT.camera
VIEWS = 3
"""Of one room; chosen."""
_TRIES = 4
_SEEN_PX = 60
"""What fewer pixels show does not count among what makes a picture worth a look."""
_KINDS = {"box": p.GEOM_BOX, "cylinder": p.GEOM_CYLINDER, "sphere": p.GEOM_SPHERE}
_VOLUME = 32
"""Cells along each axis of the grain of surfaces, which repeats itself."""


@dataclass(frozen=True, kw_only=True)
class _Lens:
    eye_m: NDArray[np.float64]
    forward: NDArray[np.float64]
    up: NDArray[np.float64]
    focal_px: float


def photographs(rng: Generator) -> Iterator[Photograph]:
    """``VIEWS`` pictures of one new room."""
    scene = random_scene(rng)
    scene.items[MOST_INSTANCES:] = []
    client = p.connect(p.DIRECT)
    try:
        bodies = [_body(item, client) for item in scene.items]
        look = _Look(len(scene.items), rng)
        targets = list(visible_targets(scene))
        for _ in range(VIEWS):
            yield _worth_a_look(scene, bodies, targets, look, client, rng)
    finally:
        p.disconnect(physicsClientId=client)


def _worth_a_look(
    scene: Scene,
    bodies: list[list[int]],
    targets: list[tuple[Item, tuple[float, float, float]]],
    look: _Look,
    client: int,
    rng: Generator,
) -> Photograph:
    """A picture, now and then of anything, mostly one in which several things are seen and none fills it."""
    wanted = int(rng.choice((0, 2, 4, 6), p=(0.05, 0.15, 0.4, 0.4)))
    for _ in range(_TRIES):
        lens = _lens(scene, targets, rng)
        hand = _hand(lens, client, rng) if rng.random() < 0.06 else []
        picture = _photograph(scene, bodies, lens, look, client)
        for body in hand:
            p.removeBody(body, physicsClientId=client)
        pixels = picture.pixels()[2:]
        if (
            np.count_nonzero(pixels > _SEEN_PX) >= wanted
            and pixels.max(initial=0) < 0.6 * CAMERA.width_px * CAMERA.height_px
        ):
            break
    return picture


def _body(item: Item, client: int) -> list[int]:
    """The bodies of an item; at most sixteen primitives fit into one."""
    x, y, z = item.bottom_m
    turn = p.getQuaternionFromEuler([0.0, math.pi / 2 if item.toppled else 0.0, item.yaw_rad])
    if item.toppled:
        z += item.size_m[2] / 2
    made = []
    for start in range(0, len(item.parts), 16):
        parts = item.parts[start : start + 16]
        shape = p.createVisualShapeArray(
            shapeTypes=[_KINDS[part.kind] for part in parts],
            radii=[part.size_m[0] / 2 for part in parts],
            halfExtents=[[side / 2 for side in part.size_m] for part in parts],
            lengths=[part.size_m[2] for part in parts],
            rgbaColors=[[*part.color, 1.0] for part in parts],
            visualFramePositions=[list(part.center_m) for part in parts],
            physicsClientId=client,
        )
        made.append(p.createMultiBody(0.0, -1, shape, [x, y, z], turn, physicsClientId=client))
    return made


def _lens(scene: Scene, targets: list[tuple[Item, tuple[float, float, float]]], rng: Generator) -> _Lens:
    """Where the camera stands and what it looks at; the robot's own height and angle half of the time."""
    usual = rng.random() < 0.5
    height = ROBOT.geometry.camera_height_m + (
        float(rng.normal(0.0, 0.02)) if usual else float(rng.uniform(-0.45, 0.35))
    )
    width_rad = CAMERA.horizontal_fov_rad if usual else math.radians(float(rng.uniform(48.0, 74.0)))
    roll = 0.0 if usual else float(rng.normal(0.0, 0.03))
    for _ in range(60):
        aimed = targets and rng.random() < 0.85
        if aimed:
            item, spot = targets[int(rng.integers(len(targets)))]
            reach = max(item.size_m[:2]) / 2 if item.furniture else 0.0
            away = reach + float(rng.gamma(3.0, 0.36)) + 0.3
            angle = float(rng.uniform(-math.pi, math.pi))
            eye = np.array([spot[0] + away * math.cos(angle), spot[1] + away * math.sin(angle), height])
            goal = np.array(spot) + rng.normal(0.0, 0.12, 3)
        else:
            eye = np.array([*(float(rng.uniform(0.3, side - 0.3)) for side in scene.extent_m), height])
            angle, tilt = float(rng.uniform(-math.pi, math.pi)), float(rng.uniform(-0.8, 0.12))
            ahead = math.cos(angle) * math.cos(tilt), math.sin(angle) * math.cos(tilt), math.sin(tilt)
            goal = eye + np.array(ahead)
        if _free(scene, eye):
            break
    forward = (goal - eye) / np.linalg.norm(goal - eye)
    side = np.cross(forward, (0.0, 0.0, 1.0))
    side /= max(float(np.linalg.norm(side)), 1e-6)
    up = np.cross(side, forward)
    up = math.cos(roll) * up + math.sin(roll) * side
    return _Lens(eye_m=eye, forward=forward, up=up, focal_px=CAMERA.width_px / 2 / math.tan(width_rad / 2))


def _free(scene: Scene, eye: NDArray[np.float64]) -> bool:
    """Whether a robot could stand there: within the room and off the furniture."""
    if not all(0.28 < eye[k] < scene.extent_m[k] - 0.28 for k in (0, 1)):
        return False
    for item in scene.items[2:]:
        c, s = math.cos(item.yaw_rad), math.sin(item.yaw_rad)
        x, y = eye[0] - item.bottom_m[0], eye[1] - item.bottom_m[1]
        inside = abs(c * x + s * y) < item.size_m[0] / 2 + 0.22 and abs(c * y - s * x) < item.size_m[1] / 2 + 0.22
        if inside and item.bottom_m[2] < 1.8 and (item.furniture or item.category == "person"):
            return False
    return True


def _hand(lens: _Lens, client: int, rng: Generator) -> list[int]:
    """An arm with two fingers before the camera, with no name."""
    side = np.cross(lens.forward, lens.up)
    level = lens.forward * (1.0, 1.0, 0.0)
    level /= max(float(np.linalg.norm(level)), 1e-6)
    at = lens.eye_m + level * rng.uniform(0.4, 0.9) + side * rng.uniform(-0.1, 0.1) - (0.0, 0.0, rng.uniform(0.3, 0.7))
    yaw = math.atan2(level[1], level[0])
    gray, opening = float(rng.uniform(0.1, 0.8)), float(rng.uniform(0.02, 0.1))
    parts = (
        box((-0.42, 0.0, 0.0), (0.8, 0.05, 0.05), (gray, gray, gray)),
        box((0.0, 0.0, 0.0), (0.08, 0.16, 0.05), random_color(rng)),
        *(box((0.09, s * opening / 2, 0.0), (0.1, 0.012, 0.03), (0.15, 0.15, 0.15)) for s in (-1, 1)),
    )
    arm = Item(
        category="robot",
        parts=parts,
        bottom_m=(float(at[0]), float(at[1]), float(at[2])),
        size_m=(1.0, 0.2, 0.1),
        yaw_rad=yaw,
        furniture=False,
    )
    return _body(arm, client)


def _photograph(scene: Scene, bodies: list[list[int]], lens: _Lens, look: _Look, client: int) -> Photograph:
    view = p.computeViewMatrix(lens.eye_m.tolist(), (lens.eye_m + lens.forward).tolist(), lens.up.tolist())
    projection = p.computeProjectionMatrixFOV(
        math.degrees(2 * math.atan(CAMERA.height_px / 2 / lens.focal_px)),
        CAMERA.width_px / CAMERA.height_px,
        *CAMERA.clip_m,
    )
    _, _, rgba, buffer, segmentation = p.getCameraImage(
        CAMERA.width_px,
        CAMERA.height_px,
        view,
        projection,
        renderer=p.ER_TINY_RENDERER,
        physicsClientId=client,
        **look.light,
    )
    buffer = np.asarray(buffer, dtype=np.float64).reshape(CAMERA.height_px, CAMERA.width_px)
    near_m, far_m = CAMERA.clip_m
    depth_m = far_m * near_m / (far_m - (far_m - near_m) * buffer)
    of_body = np.full(max(max(made) for made in bodies) + 66, NOTHING, dtype=np.uint8)
    for index, made in enumerate(bodies):
        of_body[made] = index
    segmentation = np.asarray(segmentation, dtype=np.int64).reshape(CAMERA.height_px, CAMERA.width_px)
    body = np.where(segmentation >= 0, segmentation & BODY_MASK, len(of_body) - 1)
    ids = of_body[np.minimum(body, len(of_body) - 1)]
    rgb = np.asarray(rgba, dtype=np.uint8).reshape(CAMERA.height_px, CAMERA.width_px, 4)[:, :, :3]
    rgb = look.painted(rgb, ids, _points(depth_m, lens))
    return photograph(
        rgb, ids, depth_m, [item.category for item in scene.items], [item.solid() for item in scene.items]
    )


def _points(depth_m: NDArray[np.float64], lens: _Lens) -> NDArray[np.float32]:
    """(H, W, 3) where each pixel's ray ends, in the room."""
    rows, columns = np.mgrid[0 : CAMERA.height_px, 0 : CAMERA.width_px]
    right = np.cross(lens.forward, lens.up)
    x = (columns - (CAMERA.width_px - 1) / 2) / lens.focal_px * depth_m
    y = (rows - (CAMERA.height_px - 1) / 2) / lens.focal_px * depth_m
    points = lens.eye_m + depth_m[..., None] * lens.forward + x[..., None] * right - y[..., None] * lens.up
    return points.astype(np.float32)


class _Look:
    """Light and surfaces of one room: as the simulator has them half of the time, else anything."""

    def __init__(self, count: int, rng: Generator) -> None:
        plain = rng.random() < 0.5
        self.light: dict[str, object] = {"lightDirection": [0.4, 0.3, 1.0], "shadow": 0}
        self._pattern = np.zeros(count + 1, dtype=np.int64)
        if plain:
            return
        azimuth, height = rng.uniform(-math.pi, math.pi), rng.uniform(0.3, 2.0)
        self.light = {
            "lightDirection": [math.cos(azimuth), math.sin(azimuth), height],
            "shadow": int(rng.random() < 0.15),
            "lightAmbientCoeff": float(rng.uniform(0.35, 0.75)),
            "lightDiffuseCoeff": float(rng.uniform(0.15, 0.6)),
            "lightSpecularCoeff": float(rng.uniform(0.0, 0.3)),
            "lightColor": rng.uniform(0.8, 1.0, 3).tolist(),
        }
        self._pattern[:count] = rng.choice(4, size=count, p=(0.5, 0.2, 0.1, 0.2))
        self._scale = np.exp(rng.uniform(math.log(2.0), math.log(60.0), count + 1)).astype(np.float32)
        self._strength = rng.uniform(0.05, 0.4, count + 1).astype(np.float32)
        axis = rng.normal(size=(count + 1, 3))
        self._axis = (axis / np.linalg.norm(axis, axis=1, keepdims=True)).astype(np.float32)
        coarse = rng.normal(size=(_VOLUME, _VOLUME, _VOLUME)).astype(np.float32)
        self._volume = np.clip(coarse / 1.5, -1.0, 1.0)

    def painted(self, rgb: NDArray[np.uint8], ids: NDArray[np.uint8], points: NDArray[np.float32]) -> NDArray[np.uint8]:
        """The picture with stripes, checks and grain on what has them."""
        rows = np.minimum(ids, len(self._pattern) - 1)
        pattern = self._pattern[rows]
        where = np.nonzero(pattern > 0)
        if not len(where[0]):
            return rgb
        row, kind = rows[where], pattern[where]
        at = points[where] * self._scale[row][:, None]
        along = np.einsum("ij,ij->i", at, self._axis[row])
        checks = np.sign(np.sin(at[:, 0]) * np.sin(at[:, 1] + 0.7) * np.sin(at[:, 2] + 0.3))
        cell = np.floor(at).astype(np.int64) % _VOLUME
        grain = self._volume[cell[:, 0], cell[:, 1], cell[:, 2]]
        change = np.where(kind == 1, np.sign(np.sin(along)), np.where(kind == 2, checks, grain)) * self._strength[row]
        painted = rgb.copy()
        painted[where] = np.clip(rgb[where] * (1.0 + change[:, None]), 0, 255).astype(np.uint8)
        return painted
