"""On which side of a seat its back is: what rises over the seat lies along one side."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from majordomo.perception.objects.surface import Box

Array = NDArray[np.float64]
_OVER = 0.8
"""From this share of the height on, of a seat there is nothing but the back: arms are lower."""
_POINTS = 8
_OFF_CENTER, _CLEARLY = 0.45, 0.15
"""Shares of half the width: how far from the middle the back is at least, and how much farther than along it."""


def back_of(points: Array, box: Box) -> float | None:
    """Direction of the back from the middle of a seat, in radians in the frame of its room; ``None`` where it does not
    show, or there is none.

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
    along = box.yaw_rad + side * math.pi / 2.0 + (0.0 if shares[side] > 0.0 else math.pi)
    return math.remainder(along, 2.0 * math.pi)
