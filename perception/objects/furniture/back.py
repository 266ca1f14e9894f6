"""On which side of a seat its back is, and how far in it begins: what rises over the seat lies along one side."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box

Array = NDArray[np.float64]
_OVER = 0.8
"""From this share of the height on, of a seat there is nothing but the back: arms are lower."""
_POINTS = 8
_OFF_CENTER, _CLEARLY = 0.45, 0.15
"""Shares of half the width: how far from the middle the back is at least, and how much farther than along it."""
_NEAREST = 0.2
"""Of the points of a back, so many may be nearer to the middle than its face: noise, and what hangs over it."""


@dataclass(frozen=True, kw_only=True)
class SeatBack:
    """``toward_rad``: from the middle of the seat to its back, in the frame of its room. ``face_m``: how far from the
    middle is the face of it that one leans on; ``None`` where that was never measured.
    """

    toward_rad: float
    face_m: float | None = None


def back_of(points: Array, box: Box) -> SeatBack | None:
    """Where the back of a seat is; ``None`` where it does not show, or there is none.

    Args:
        points: (V, 3) of the seat's surface, room frame.
        box: of the whole seat, room frame.
    """
    local = box.local(points)
    high = local[local[:, 2] > (_OVER - 0.5) * box.size_m[2], :2]
    if len(high) < _POINTS:
        return None
    shares = high.mean(axis=0) / (np.array(box.size_m[:2]) / 2.0)
    side = int(np.argmax(np.abs(shares)))
    if abs(shares[side]) < _OFF_CENTER or abs(shares[side]) - abs(shares[1 - side]) < _CLEARLY:
        return None
    sign, half_m = math.copysign(1.0, shares[side]), box.size_m[side] / 2.0
    away_m = sign * high[:, side]
    face_m = float(np.quantile(away_m[away_m > _OFF_CENTER * half_m], _NEAREST))
    along = box.yaw_rad + side * math.pi / 2.0 + (0.0 if sign > 0.0 else math.pi)
    return SeatBack(toward_rad=math.remainder(along, 2.0 * math.pi), face_m=face_m)
