"""The house as upright solids for the LiDAR: what stands still becomes arrays once, what moves at every scan."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Sequence

import pybullet as p

from simulation.furnishing.shapes import Part
from simulation.robot.raycast import Prism, Prisms
from simulation.world.blocks import Block

UPRIGHT = math.cos(math.radians(5.0))
"""A body whose axis leans more than this is taken as its bounding box."""


class Solids:
    """Fixed blocks and bodies made of parts, each with its body in the physics client."""

    def __init__(self, client: int) -> None:
        self._client = client
        self._blocks: dict[int, Block] = {}
        self._bodies: dict[int, tuple[tuple[Part, ...], float, bool]] = {}
        self._fixed: Prisms | None = None

    def add_block(self, body: int, block: Block) -> None:
        """A wall or door panel."""
        self._blocks[body] = block
        self._fixed = None

    def add_body(self, body: int, parts: Sequence[Part], height_m: float, *, fixed: bool) -> None:
        """A body of solid parts whose frame is at half its height."""
        self._bodies[body] = (tuple(part for part in parts if part.solid), height_m, fixed)
        self._fixed = None

    def remove(self, body: int) -> None:
        """Forget a body."""
        self._blocks.pop(body, None)
        self._bodies.pop(body, None)
        self._fixed = None

    def touch(self) -> None:
        """Something fixed was moved."""
        self._fixed = None

    def now(self, without: Collection[int]) -> tuple[Prisms, Prisms]:
        """What is fixed and what moves, as it is now, without some bodies."""
        if self._fixed is None:
            walls = [_block_prism(block) for block in self._blocks.values()]
            self._fixed = Prisms([*walls, *self._prisms(fixed=True, without=())])
        return self._fixed, Prisms(list(self._prisms(fixed=False, without=without)))

    def _prisms(self, *, fixed: bool, without: Collection[int]) -> Iterator[Prism]:
        for body, (parts, height_m, stays) in self._bodies.items():
            if stays is not fixed or body in without:
                continue
            position, quaternion = p.getBasePositionAndOrientation(body, physicsClientId=self._client)
            x, y, z, w = quaternion
            if 1.0 - 2.0 * (x * x + y * y) < UPRIGHT:
                yield _bounding_prism(body, self._client)
            else:
                yaw_rad = math.atan2(2.0 * (w * z + x * y), 1.0 - 2.0 * (y * y + z * z))
                yield from part_prisms(parts, position, yaw_rad, height_m)


def part_prisms(
    parts: Iterable[Part], center_m: tuple[float, float, float], yaw_rad: float, height_m: float
) -> Iterator[Prism]:
    """The parts of a body whose center is at ``center_m``."""
    cos, sin = math.cos(yaw_rad), math.sin(yaw_rad)
    for part in parts:
        x_m, y_m, z_m = part.center_m
        middle_m = center_m[2] - height_m / 2 + z_m
        yield Prism(
            center_m=(center_m[0] + cos * x_m - sin * y_m, center_m[1] + sin * x_m + cos * y_m),
            half_m=(part.size_m[0] / 2, part.size_m[1] / 2),
            bottom_m=middle_m - part.size_m[2] / 2,
            top_m=middle_m + part.size_m[2] / 2,
            yaw_rad=yaw_rad,
            round=part.kind != "box",
            ball=part.kind == "sphere",
        )


def _block_prism(block: Block) -> Prism:
    x_m, y_m, z_m = block.center_m
    length_m, depth_m, height_m = block.size_m
    return Prism(
        center_m=(x_m, y_m),
        half_m=(length_m / 2, depth_m / 2),
        bottom_m=z_m - height_m / 2,
        top_m=z_m + height_m / 2,
        yaw_rad=block.yaw_rad,
    )


def _bounding_prism(body: int, client: int) -> Prism:
    low, high = p.getAABB(body, physicsClientId=client)
    return Prism(
        center_m=((low[0] + high[0]) / 2, (low[1] + high[1]) / 2),
        half_m=((high[0] - low[0]) / 2, (high[1] - low[1]) / 2),
        bottom_m=low[2],
        top_m=high[2],
    )
