"""Things measured again and again, and what filters make of it: the arithmetic of ``evaluate tracking``.

A measurement reaches every filter as it does in the service: a shape in the frame of a camera that has moved on, taken
in by the ``CenterBelief`` that a track holds. Filters differ in nothing but their settings and first particles. All are
told the true covariance; the service has to estimate it.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from perception.objects.furniture.surface import Box
from perception.objects.seeing.shape import Shape
from perception.objects.tracking.center import CenterBelief, CenterSettings
from perception.objects.tracking.particle_filter import Likelihood, ParticleSettings
from scene_graph.geometry.se3 import SE3
from skills.ports import ArmGeometry

Array = NDArray[np.float64]
_SIZE_M = (0.1, 0.1, 0.1)
"""Made up: filters of the center do not look at it."""
_EXACT_POSE = np.zeros((3, 3))


@dataclass(frozen=True, kw_only=True)
class Contender:
    """A filter to compare. ``spread``: of its first particles, in standard deviations of a measurement."""

    name: str
    title: str
    settings: CenterSettings = field(default_factory=CenterSettings)
    spread: float = 1.0


def _as_paper(likelihood: Likelihood) -> CenterSettings:
    """The paper starts no belief anew, so no innovation is too large."""
    return CenterSettings(particles=ParticleSettings(likelihood=likelihood), jump_sigmas=math.inf)


PAPER = Contender(name="paper", title="paper's filter", settings=_as_paper(Likelihood.PAPER))
KINDEST = Contender(
    name="paper_resampled", title="same, resampled", settings=_as_paper(Likelihood.PAPER_RESAMPLED), spread=0.3
)
"""The paper names neither resampling nor the size of its noise. Of 0.1, 0.3, 1, 2 and 4 standard deviations of a
measurement, with and without resampling, this reading errs least in x and y after 30 measurements.
"""
OURS = Contender(name="ours", title="ours")
CONTENDERS = (PAPER, KINDEST, OURS)


def camera_pose(step: int) -> SE3:
    """T_room_camera at a measurement: the camera circles the room's origin and faces it."""
    bearing_rad, away_m = 0.2 * step, 2.0
    x_m, y_m = away_m * math.cos(bearing_rad), away_m * math.sin(bearing_rad)
    return SE3.from_xyz_yaw(x_m, y_m, ArmGeometry().camera_height_m, bearing_rad + math.pi)


def measure(places: Array, sigma_m: Array, random: np.random.Generator) -> Array:
    """(R, K, 3) measurements of true places of the same shape; independent noise along the room's axes."""
    return places + sigma_m * random.standard_normal(places.shape)


def follow(contender: Contender, measurements: Array, sigma_m: Array, random: np.random.Generator) -> Array:
    """(K, 3) estimates after each of the measurements (K, 3), all in meters in the frame of the room."""
    R = np.diag(sigma_m**2)
    first = Box(measurements[0], _SIZE_M, 0.0)
    belief = CenterBelief(first, contender.spread**2 * R, settings=contender.settings, random=random)
    estimates = [belief.box.center]
    for step, measurement in enumerate(measurements[1:], start=1):
        T_room_camera = camera_pose(step)
        belief.observe(_seen(measurement, R, T_room_camera.inverse()), T_room_camera, _EXACT_POSE)
        estimates.append(belief.box.center)
    return np.array(estimates)


def follow_all(contender: Contender, measurements: Iterable[Array], sigma_m: Array, seed: int) -> Array:
    """(R, K, 3) estimates of as many runs, each with a generator of its own."""
    # Counted from one: numpy takes (seed, 0) for seed, which the measurements are drawn from.
    runs = enumerate(measurements, start=1)
    return np.array([follow(contender, each, sigma_m, np.random.default_rng((seed, run))) for run, each in runs])


def _seen(place: Array, covariance: Array, T_camera_room: SE3) -> Shape:
    R = T_camera_room.rotation()
    return Shape(
        center=T_camera_room.apply(place),
        size_m=_SIZE_M,
        yaw_rad=0.0,
        oriented=False,
        covariance=R @ covariance @ R.T,
        complete=True,
    )


def bounds(sigma_m: Array, measurements: int) -> Mapping[str, Array]:
    """What no unbiased estimate from so many measurements betters, (3,) each: its standard deviation ``sigma/sqrt(n)``,
    and the mean absolute error of a normal distribution of that width, ``sigma*sqrt(2/(pi n))``, a fifth less.
    """
    root_mean_square = sigma_m / math.sqrt(measurements)
    return {"root_mean_square": root_mean_square, "mean_absolute": root_mean_square * math.sqrt(2.0 / math.pi)}


def moved(start: Array, *, before: int, after: int, distance_m: float, runs: int, random: np.random.Generator) -> Array:
    """(R, before + after, 3) true places of a thing that is moved once, level, each run another way."""
    heading_rad = random.uniform(-math.pi, math.pi, runs)
    way = distance_m * np.column_stack((np.cos(heading_rad), np.sin(heading_rad), np.zeros(runs)))
    places = np.tile(start, (runs, before + after, 1))
    places[:, before:] += way[:, None, :]
    return places


def running_mean(measurements: Array) -> Array:
    """(R, K, 3) means of the measurements so far."""
    counts = np.arange(1, measurements.shape[1] + 1)
    mean: Array = np.cumsum(measurements, axis=1) / counts[None, :, None]
    return mean


def recovered(median_m: Array, within_m: float) -> int | None:
    """After how many measurements the median error (K,) is within ``within_m`` for good; ``None``: not in so many."""
    outside = np.flatnonzero(median_m > within_m)
    last = int(outside[-1]) if len(outside) else -1
    return None if last == len(median_m) - 1 else last + 2
