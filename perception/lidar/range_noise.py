"""How noisy the ranges of a LiDAR are, told from the scans themselves, and scans calmed to a usual level of noise."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class CalmingSettings:
    """From where on ranges are averaged, and over what."""

    usual_m: float = 0.015
    """Standard deviation of ranges that are taken as they are. Chosen: below the usual 20 mm (design, section 5); much
    more would fill doorways and floors with obstacles."""
    gate: float = 4.0
    """Standard deviations within which neighbors may be the same surface; about the usual ones of a sigma filter."""
    smaller: float = 0.6
    """Errors of averages go together: they are made smaller than usual ones by this factor. Chosen."""
    every_rings: int = 4
    """One of so many rings is asked how noisy it is. Chosen: the noise is the same in all."""
    widest: int = 6
    """Neighbors on either side at most. Chosen: 2.4 degrees of the usual LiDAR."""


def range_noise_m(ranges_m: Array) -> float:
    """Standard deviation of (..., N) ranges in meters, from second differences between neighboring directions.

    Surfaces are smooth, so what three neighbors do not share is noise, but for the few at corners and edges; the median
    is not moved by these. Zero where fewer than three directions in a row returned.
    """
    with np.errstate(invalid="ignore"):
        second = np.diff(ranges_m, n=2, axis=-1)
    second = second[np.isfinite(second)]
    return float(1.4826 * np.median(np.abs(second)) / np.sqrt(6.0)) if second.size else 0.0


def calmed(ranges_m: Array, settings: CalmingSettings = CalmingSettings()) -> Array:
    """(rings, azimuths) ranges in meters of a full turn, less noisy where they were noisier than usual.

    Each is averaged with neighbors of its ring, of those that may be the same surface (a sigma filter after Lee, 1983);
    a chair's leg before a wall stays. As the errors of averages go together, they are made smaller than usual ones.
    """
    noise_m = range_noise_m(ranges_m[:: settings.every_rings])
    if noise_m <= settings.usual_m:
        return ranges_m
    half = min(int(np.ceil(((noise_m / (settings.smaller * settings.usual_m)) ** 2 - 1.0) / 2.0)), settings.widest)
    total, count = np.zeros(ranges_m.shape), np.zeros(ranges_m.shape)
    for shift in range(-half, half + 1):
        neighbor = np.roll(ranges_m, shift, axis=-1)
        with np.errstate(invalid="ignore"):
            alike = np.abs(neighbor - ranges_m) < settings.gate * noise_m
        total += np.where(alike, neighbor, 0.0)
        count += alike
    return np.where(count > 0, total / np.maximum(count, 1), ranges_m)
