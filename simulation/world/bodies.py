"""Bodies in the physics client, made from blocks and parts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence

import pybullet as p

from simulation.furnishing.shapes import Part, Size3
from simulation.houses.colors import Rgb
from simulation.world.blocks import Block, Point2
from simulation.world.physics import PhysicsSettings

_KINDS = {"box": p.GEOM_BOX, "cylinder": p.GEOM_CYLINDER, "sphere": p.GEOM_SPHERE}

Quaternion = tuple[float, float, float, float]
"""x, y, z, w, as PyBullet has it."""


def yaw_quaternion(yaw_rad: float) -> Quaternion:
    """A turn about the vertical."""
    return 0.0, 0.0, math.sin(yaw_rad / 2), math.cos(yaw_rad / 2)


def make_floor(client: int, low: Point2, high: Point2, color: Rgb, physics: PhysicsSettings) -> int:
    """An endless plane at height 0, seen between two corners."""
    half = [(high[0] - low[0]) / 2, (high[1] - low[1]) / 2, 0.01]
    center = [(high[0] + low[0]) / 2, (high[1] + low[1]) / 2, -0.01]
    body: int = p.createMultiBody(
        0.0,
        p.createCollisionShape(p.GEOM_PLANE, planeNormal=[0, 0, 1], physicsClientId=client),
        p.createVisualShape(
            p.GEOM_BOX, halfExtents=half, rgbaColor=[*color, 1.0], visualFramePosition=center, physicsClientId=client
        ),
        physicsClientId=client,
    )
    p.changeDynamics(body, -1, lateralFriction=physics.lateral_friction, physicsClientId=client)
    return body


def make_block(client: int, block: Block, color: Rgb) -> int:
    """A static box."""
    half = [side / 2 for side in block.size_m]
    body: int = p.createMultiBody(
        0.0,
        p.createCollisionShape(p.GEOM_BOX, halfExtents=half, physicsClientId=client),
        p.createVisualShape(p.GEOM_BOX, halfExtents=half, rgbaColor=[*color, 1.0], physicsClientId=client),
        block.center_m,
        yaw_quaternion(block.yaw_rad),
        physicsClientId=client,
    )
    return body


def make_body(client: int, parts: Sequence[Part], mass_kg: float, height_m: float, physics: PhysicsSettings) -> int:
    """One body of several parts at the origin. Its frame is at half of ``height_m`` above the parts' origin.

    At rest it falls asleep, and costs nothing until something touches it or ``wake_bodies`` is called.
    """
    solid = [part for part in parts if part.solid]
    body: int = p.createMultiBody(
        mass_kg,
        _collision(client, solid, height_m / 2),
        _visual(client, parts, height_m / 2),
        physicsClientId=client,
    )
    p.changeDynamics(
        body,
        -1,
        lateralFriction=physics.lateral_friction,
        spinningFriction=physics.spinning_friction,
        rollingFriction=physics.rolling_friction,
        restitution=0.0,
        linearDamping=physics.linear_damping,
        angularDamping=physics.angular_damping,
        activationState=p.ACTIVATION_STATE_ENABLE_SLEEPING,
        physicsClientId=client,
    )
    return body


def place_body(client: int, body: int, bottom: Size3, yaw_rad: float, height_m: float) -> None:
    """Put a body of ``make_body`` upright, at rest, its bottom's center at ``bottom``."""
    center = (bottom[0], bottom[1], bottom[2] + height_m / 2)
    p.resetBasePositionAndOrientation(body, center, yaw_quaternion(yaw_rad), physicsClientId=client)
    p.resetBaseVelocity(body, [0, 0, 0], [0, 0, 0], physicsClientId=client)


def carry_along(client: int, body: int, before: Size3, after: Size3) -> None:
    """Move a body, at rest, as something moved that it is fixed to. Poses: x, y (m), yaw (rad)."""
    turn = yaw_quaternion(after[2] - before[2])
    away, attitude = p.getBasePositionAndOrientation(body, physicsClientId=client)
    from_it = (away[0] - before[0], away[1] - before[1], away[2])
    (x, y, z), turned = p.multiplyTransforms((after[0], after[1], 0.0), turn, from_it, attitude)
    p.resetBasePositionAndOrientation(body, (x, y, z), turned, physicsClientId=client)
    p.resetBaseVelocity(body, [0, 0, 0], [0, 0, 0], physicsClientId=client)


def wake_bodies(client: int, bodies: Iterable[int]) -> None:
    """Let sleeping bodies fall, after what they stood on may have gone."""
    for body in bodies:
        p.changeDynamics(body, -1, activationState=p.ACTIVATION_STATE_WAKE_UP, physicsClientId=client)


def _collision(client: int, parts: Sequence[Part], lift_m: float) -> int:
    shape: int = p.createCollisionShapeArray(
        shapeTypes=[_KINDS[part.kind] for part in parts],
        radii=[part.size_m[0] / 2 for part in parts],
        halfExtents=[[side / 2 for side in part.size_m] for part in parts],
        lengths=[part.size_m[2] for part in parts],
        collisionFramePositions=[_lowered(part, lift_m) for part in parts],
        physicsClientId=client,
    )
    return shape


def _visual(client: int, parts: Sequence[Part], lift_m: float) -> int:
    shape: int = p.createVisualShapeArray(
        shapeTypes=[_KINDS[part.kind] for part in parts],
        radii=[part.size_m[0] / 2 for part in parts],
        halfExtents=[[side / 2 for side in part.size_m] for part in parts],
        lengths=[part.size_m[2] for part in parts],
        rgbaColors=[[*part.color, 1.0] for part in parts],
        visualFramePositions=[_lowered(part, lift_m) for part in parts],
        physicsClientId=client,
    )
    return shape


def _lowered(part: Part, lift_m: float) -> list[float]:
    return [part.center_m[0], part.center_m[1], part.center_m[2] - lift_m]
