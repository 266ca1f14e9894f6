"""A piece of furniture as the hand meets it: on what things stand, how the hand gets in there, and what is in its way.

All in the furniture's own frame: origin in the middle of its box, axes along its sides.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import Enum
from functools import lru_cache
from itertools import pairwise
from math import cos, inf, sin

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ObjectNode
from skills.furniture.kinds import Kind, kind_of
from skills.geometry import Box2, Points, Pose2


class Entry(Enum):
    """How the hand gets in to a surface."""

    ABOVE = "from above, or level over an edge that nothing rises at"
    LEVEL = "level-wise below the board above, across one of the long sides: which of them are open is not known"
    RIM = "from above its rim, where things are dropped"


@dataclass(frozen=True, kw_only=True)
class Surface:
    """What things stand on, or fall into. ``free_m``: from there to what is above it. ``is_guessed``: its height is
    known of the kind only; what stands there tells it better.
    """

    height_m: float = 0.0
    free_m: float = inf
    entry: Entry = Entry.ABOVE
    is_guessed: bool = False

    @property
    def is_covered(self) -> bool:
        """Whether there is another above."""
        return self.entry is Entry.LEVEL


@dataclass(frozen=True, kw_only=True)
class Rim:
    """What rises over a surface along one side, a back or an arm: its ``axis`` (0 or 1) and ``sign`` there, how far its
    outer face is from the middle, how thick it is, how high it reaches, and whether its inner face was measured.
    """

    axis: int
    sign: int
    half_m: float
    thick_m: float
    top_m: float
    is_measured: bool = False

    def covers(self, points: Points, air_m: float) -> NDArray[np.bool_]:
        """Which points (..., 2) are in it, or no farther from it than ``air_m``."""
        return np.asarray(self.sign * points[..., self.axis] > self.half_m - self.thick_m - air_m)


@dataclass(frozen=True, kw_only=True)
class Furniture:
    """``surfaces``: lowest first. ``obstacles``: what rises over a surface, as far as it is known where; ``suspects``:
    the same, and where nothing is known what may be at either end.
    """

    size_m: tuple[float, float, float]
    kind: Kind
    surfaces: tuple[Surface, ...]
    obstacles: tuple[Rim, ...] = ()
    suspects: tuple[Rim, ...] = field(default=(), repr=False)

    @classmethod
    def of(cls, node: ObjectNode) -> Furniture:
        """What a node of the graph is to the hand."""
        return _furniture(kind_of(node.label), node.size_m, node.surfaces_m, node.back_rad, node.back_m)

    @property
    def long(self) -> int:
        """Which of its own axes is along its long side."""
        return 0 if self.size_m[0] >= self.size_m[1] else 1

    @property
    def short(self) -> int:
        """Which of its own axes is across."""
        return 1 - self.long

    @property
    def half_m(self) -> Points:
        """Half of its sides, (2,)."""
        return np.array(self.size_m[:2]) / 2

    @property
    def inner_half_m(self) -> float:
        """From its middle to the panel at either end, along its long side."""
        return self.size_m[self.long] / 2 - self.kind.panel_m

    @property
    def rims_m(self) -> Points:
        """What arms and back may take along its own axes, at both sides of each, (2,)."""
        return np.array(self.kind.rims_m if self.long == 0 else self.kind.rims_m[::-1])

    @property
    def is_dropped_into(self) -> bool:
        """Whether things are dropped into it."""
        return self.surfaces[0].entry is Entry.RIM

    @property
    def walls_in(self) -> bool:
        """Whether something rises around what it carries and nobody knows where: its whole box is in the way then."""
        return self.is_dropped_into or (self.kind.is_seat and not self.obstacles)

    def roofs_m(self, *, carries: bool) -> tuple[float, ...]:
        """Heights at which it may be over a thing, one that it carries or another."""
        if carries and self.kind.is_seat:
            return ()
        return (self.size_m[2] / 2, *(surface.height_m for surface in self.surfaces))

    def surface_at(self, bottom_m: float) -> Surface:
        """The surface on which something stands whose bottom is there."""
        return nearest(self.surfaces, bottom_m)

    def met(self, points: Points, low_m: float, *, air_m: float = 0.0) -> NDArray[np.bool_]:
        """Which of the points (..., 2) are in an obstacle that rises over ``low_m``, or as near to it."""
        met = np.zeros(points.shape[:-1], np.bool_)
        for rim in self.obstacles:
            if rim.top_m > low_m:
                met |= rim.covers(points, air_m)
        return met

    def beside(self, rim: Rim, point: Points) -> Rim:
        """A rim no thicker than what stands at a point (2,) leaves room for."""
        left_m = rim.half_m - rim.sign * float(point[rim.axis]) - self.kind.stands_m
        return replace(rim, thick_m=min(rim.thick_m, max(left_m, self.kind.thin_m)))

    def outline_of(self, rim: Rim, pose: Pose2) -> Box2:
        """The rectangle that an obstacle covers, where the furniture has that pose."""
        sizes, middle = [self.size_m[0], self.size_m[1]], [0.0, 0.0]
        middle[rim.axis] = rim.sign * (sizes[rim.axis] - rim.thick_m) / 2
        sizes[rim.axis] = rim.thick_m
        ((x_m, y_m),) = pose.apply(np.array([middle]))
        return Box2(Pose2(float(x_m), float(y_m), pose.yaw_rad), *sizes)


def nearest(surfaces: Sequence[Surface], height_m: float) -> Surface:
    """The one of them whose height is nearest."""
    return min(surfaces, key=lambda surface: abs(surface.height_m - height_m))


@lru_cache(maxsize=4096)
def _furniture(
    kind: Kind,
    size_m: tuple[float, float, float],
    surfaces_m: tuple[float, ...],
    back_rad: float | None,
    back_m: float | None,
) -> Furniture:
    plain = Furniture(size_m=size_m, kind=kind, surfaces=_surfaces(kind, size_m[2], surfaces_m))
    back = () if back_rad is None else (_back(plain, back_rad, back_m),)
    arms = () if kind.arms_share is None else _ends(plain, (kind.arms_share - 0.5) * size_m[2])
    known = (*back, *arms)
    return replace(plain, obstacles=known, suspects=known or _ends(plain, size_m[2] / 2))


def _surfaces(kind: Kind, high_m: float, measured_m: Sequence[float]) -> tuple[Surface, ...]:
    """Where boards were measured below the top, those and the top; else what the kind suggests."""
    half_m = high_m / 2
    inner = [height_m - half_m for height_m in measured_m if height_m < high_m - kind.top_m]
    if kind.is_open:
        return (Surface(height_m=half_m, entry=Entry.RIM),)
    if kind.is_seat or not inner:
        return (Surface(height_m=(kind.surface_share - 0.5) * high_m, is_guessed=kind.is_seat),)
    tops = [height_m - half_m for height_m in measured_m if height_m >= high_m - kind.top_m]
    heights = [*inner, tops[-1] if tops else half_m]
    covered = (
        Surface(height_m=here, free_m=above - here - kind.board_m, entry=Entry.LEVEL)
        for here, above in pairwise(heights)
    )
    return (*covered, Surface(height_m=heights[-1]))


def _ends(furniture: Furniture, top_m: float) -> tuple[Rim, ...]:
    """What is, or may be, along both of the short sides, so high; nothing of a kind that has nothing there."""
    axis, thick_m = furniture.long, furniture.kind.rims_m[0]
    half_m = furniture.size_m[axis] / 2
    signs = (1, -1) if thick_m > 0.0 else ()
    return tuple(Rim(axis=axis, sign=sign, half_m=half_m, thick_m=thick_m, top_m=top_m) for sign in signs)


def _back(furniture: Furniture, back_rad: float, back_m: float | None) -> Rim:
    """The back in that direction from the middle; as thick as the kind's where its face was not measured."""
    toward = (cos(back_rad), sin(back_rad))
    axis = int(abs(toward[1]) > abs(toward[0]))
    half_m = furniture.size_m[axis] / 2
    usual_m = furniture.kind.rims_m[1]
    thick_m = usual_m if back_m is None else float(np.clip(half_m - back_m, furniture.kind.thin_m, half_m))
    return Rim(
        axis=axis,
        sign=1 if toward[axis] > 0.0 else -1,
        half_m=half_m,
        thick_m=thick_m,
        top_m=furniture.size_m[2] / 2,
        is_measured=back_m is not None,
    )
