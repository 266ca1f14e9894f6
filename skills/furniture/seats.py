"""Furniture that carries things lower than its top, with nothing over them: seats and beds."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, sin

import numpy as np
from numpy.typing import NDArray

from scene_graph.nodes import ObjectNode
from skills.geometry import Box2, Points, Pose2

SEAT_SHARES = {"chair": 0.5, "couch": 0.5, "sofa": 0.5, "bed": 0.55, "toilet": 0.5}
"""Height of the surface as a share of the whole, for furniture that rises above what things are put on."""
SEAT_RIMS_M = {"chair": (0.03, 0.03), "couch": (0.2, 0.22), "sofa": (0.2, 0.22), "bed": (0.06, 0.06)}
"""What arms and back take of the surface at the ends and at both of the long sides: which has the back is not known."""


ARM_SHARES = {"couch": 0.75, "sofa": 0.75}
"""Height of the arms as a share of the whole."""
STANDS_M, LEAST_M = 0.03, 0.01
"""Half of what a thing takes at least, and how thin a back or an arm is at least."""


@dataclass(frozen=True, kw_only=True)
class Rim:
    """What rises over a seat along one of its sides: its ``axis`` (0 or 1) and ``sign`` there, how far its outer face
    is from the middle of the seat's box, how thick it is, and how high over that middle.
    """

    axis: int
    sign: int
    half_m: float
    thick_m: float
    top_m: float

    def beyond(self, point: Points) -> Rim:
        """The same, no thicker than what stands at a point (2,) on the seat leaves room for."""
        left_m = self.half_m - self.sign * float(point[self.axis]) - STANDS_M
        return replace(self, thick_m=min(self.thick_m, max(left_m, LEAST_M)))

    def covers(self, points: Points, air_m: float) -> NDArray[np.bool_]:
        """Which points (..., 2) in the frame of the seat are in it, or no farther from it than ``air_m``."""
        return np.asarray(self.sign * points[..., self.axis] > self.half_m - self.thick_m - air_m)

    def outline(self, seat: ObjectNode, pose: Pose2) -> Box2:
        """The rectangle that it covers, where the seat has that pose."""
        sizes = [seat.size_m[0], seat.size_m[1]]
        middle = [0.0, 0.0]
        middle[self.axis] = self.sign * (sizes[self.axis] - self.thick_m) / 2
        sizes[self.axis] = self.thick_m
        ((x_m, y_m),) = pose.apply(np.array([middle]))
        return Box2(Pose2(float(x_m), float(y_m), pose.yaw_rad), *sizes)


def rims(seat: ObjectNode) -> tuple[Rim, ...]:
    """The back of a seat, if it is known where it is, and its arms, if its kind has any."""
    known, share = back(seat), ARM_SHARES.get(_plain(seat.label))
    arms = ends(seat, top_m=(share - 0.5) * seat.size_m[2]) if share is not None else ()
    return (*((known,) if known is not None else ()), *arms)


def ends(seat: ObjectNode, *, top_m: float) -> tuple[Rim, ...]:
    """What is, or may be, along both of the short sides of a seat, so high; nothing of what is no seat."""
    long, (along_m, _) = int(seat.size_m[1] > seat.size_m[0]), rims_m(seat.label)
    if along_m <= 0.0:
        return ()
    half_m = seat.size_m[long] / 2
    return tuple(Rim(axis=long, sign=sign, half_m=half_m, thick_m=along_m, top_m=top_m) for sign in (1, -1))


def back(seat: ObjectNode) -> Rim | None:
    """The back of a seat, ``None`` where it has none or nobody knows where it is."""
    if seat.back_rad is None:
        return None
    x, y = cos(seat.back_rad), sin(seat.back_rad)
    axis = int(abs(y) > abs(x))
    sign, half_m = 1 if (x, y)[axis] > 0.0 else -1, seat.size_m[axis] / 2
    usual_m = rims_m(seat.label)[1]
    thick_m = usual_m if seat.back_m is None else float(np.clip(half_m - seat.back_m, LEAST_M, half_m))
    return Rim(axis=axis, sign=sign, half_m=half_m, thick_m=thick_m, top_m=seat.size_m[2] / 2)


def is_seat(label: str) -> bool:
    """Whether furniture of that name carries things lower than its top, with nothing over them."""
    return _plain(label) in SEAT_SHARES


def seat_share(label: str) -> float:
    """Height of what things are put on, as a share of the whole; 1 for what is no seat."""
    return SEAT_SHARES.get(_plain(label), 1.0)


def rims_m(label: str) -> tuple[float, float]:
    """What arms and back take at the ends and at the long sides."""
    return SEAT_RIMS_M.get(_plain(label), (0.0, 0.0))


def _plain(label: str) -> str:
    return label.replace("_", " ")
