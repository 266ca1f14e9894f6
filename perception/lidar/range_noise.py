"""How noisy the ranges of a LiDAR are, told from the scans themselves, and scans calmed to a usual level of noise."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_GATE = 4.0  # standard deviations within which neighbors may be the same surface
_SMALLER = 0.6
_SAMPLED = 4  # every so many rings are asked how noisy they are
_WIDEST = 6  # neighbors on either side


def range_noise_m(ranges_m: Array) -> float:
    """Standard deviation of (..., N) ranges in meters, from second differences between neighboring directions.

    Surfaces are smooth, so what three neighbors do not share is noise, but for the few at corners and edges; the median
    is not moved by these. Zero where fewer than three directions in a row returned.
    """
    with np.errstate(invalid="ignore"):
        second = np.diff(ranges_m, n=2, axis=-1)
    second = second[np.isfinite(second)]
    return float(1.4826 * np.median(np.abs(second)) / np.sqrt(6.0)) if second.size else 0.0


def calmed(ranges_m: Array, usual_m: float) -> Array:
    """(rings, azimuths) ranges in meters of a full turn, less noisy where they were noisier than ``usual_m``.

    Each is averaged with neighbors of its ring, of those that may be the same surface (a sigma filter after Lee, 1983);
    a chair's leg before a wall stays. As the errors of averages go together, they are made smaller than usual ones.
    """
    noise_m = range_noise_m(ranges_m[::_SAMPLED])
    if noise_m <= usual_m:
        return ranges_m
    half = min(int(np.ceil(((noise_m / (_SMALLER * usual_m)) ** 2 - 1.0) / 2.0)), _WIDEST)
    total, count = np.zeros(ranges_m.shape), np.zeros(ranges_m.shape)
    for shift in range(-half, half + 1):
        neighbor = np.roll(ranges_m, shift, axis=-1)
        with np.errstate(invalid="ignore"):
            alike = np.abs(neighbor - ranges_m) < _GATE * noise_m
        total += np.where(alike, neighbor, 0.0)
        count += alike
    return np.where(count > 0, total / np.maximum(count, 1), ranges_m)
