"""On which side of a seat its back is, and how far in it begins: what rises over the seat lies along one side."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class BackSettings:
    """Shares of a seat, as seats are built."""

    over: float = 0.8
    """From this share of the height on, of a seat there is nothing but the back: arms are lower."""
    points: int = 8
    """Fewer points up there are noise, or what hangs over a back."""
    off_center: float = 0.45
    """How far from the middle the back is at least, as a share of half the width."""
    clearly: float = 0.15
    """How much farther it is than along it, as such a share."""
    nearest: float = 0.2
    """Of the points of a back, so many may be nearer to the middle than its face: noise, and what hangs over it."""


@dataclass(frozen=True, kw_only=True)
class SeatBack:
    """``toward_rad``: from the middle of the seat to its back, in the frame of its room. ``face_m``: how far from the
    middle is the face of it that one leans on; ``None`` where that was never measured.
    """

    toward_rad: float
    face_m: float | None = None


def back_of(points: Array, box: Box, settings: BackSettings = BackSettings()) -> SeatBack | None:
    """Where the back of a seat is; ``None`` where it does not show, or there is none.

    Args:
        points: (V, 3) of the seat's surface, room frame.
        box: of the whole seat, room frame.
        settings: how backs are built.
    """
    local = box.local(points)
    high = local[local[:, 2] > (settings.over - 0.5) * box.size_m[2], :2]
    if len(high) < settings.points:
        return None
    shares = high.mean(axis=0) / (np.array(box.size_m[:2]) / 2.0)
    side = int(np.argmax(np.abs(shares)))
    if abs(shares[side]) < settings.off_center or abs(shares[side]) - abs(shares[1 - side]) < settings.clearly:
        return None
    sign, half_m = math.copysign(1.0, shares[side]), box.size_m[side] / 2.0
    away_m = sign * high[:, side]
    face_m = float(np.quantile(away_m[away_m > settings.off_center * half_m], settings.nearest))
    along = box.yaw_rad + side * math.pi / 2.0 + (0.0 if sign > 0.0 else math.pi)
    return SeatBack(toward_rad=math.remainder(along, 2.0 * math.pi), face_m=face_m)
