"""What the simulated sensors get wrong (design, section 5); every figure comes from the house's settings."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from simulation.houses.house import Noise


class NoisyOdometry:
    """Dead reckoning with a scale error that stays for the whole run and a random error that changes with the way.

    A run draws one scale error each for distance and angle, normal with the stated ratio; on top, every increment gets
    white noise whose standard deviation is the ratio times the square root of increment times ``correlation_m``,
    the way after which the random error is independent of what it was before; chosen: a few turns of the wheels.
    """

    def __init__(
        self,
        noise: Noise,
        rng: np.random.Generator,
        pose: tuple[float, float, float],
        *,
        correlation_m: float = 0.5,
    ) -> None:
        self._noise, self._rng, self._correlation_m = noise, rng, correlation_m
        self._distance_scale = 1.0 + noise.odometry_distance_ratio * float(rng.standard_normal())
        self._angle_scale = 1.0 + noise.odometry_angle_ratio * float(rng.standard_normal())
        self._true = pose
        self.pose = (0.0, 0.0, 0.0)

    def advance(self, pose: tuple[float, float, float]) -> None:
        """Integrate the true motion since the last call, with errors."""
        dx, dy = pose[0] - self._true[0], pose[1] - self._true[1]
        heading = self._true[2]
        forward = dx * math.cos(heading) + dy * math.sin(heading)
        sideways = -dx * math.sin(heading) + dy * math.cos(heading)
        turned = math.remainder(pose[2] - self._true[2], math.tau)
        self._true = pose
        forward = forward * self._distance_scale + self._white(self._noise.odometry_distance_ratio, forward)
        turned = turned * self._angle_scale + self._white(self._noise.odometry_angle_ratio, turned)
        x_m, y_m, yaw_rad = self.pose
        middle = yaw_rad + turned / 2
        self.pose = (
            x_m + forward * math.cos(middle) - sideways * math.sin(middle),
            y_m + forward * math.sin(middle) + sideways * math.cos(middle),
            math.remainder(yaw_rad + turned, math.tau),
        )

    def jump(self, pose: tuple[float, float, float]) -> None:
        """The robot was carried: its wheels did not turn."""
        self._true = pose

    def _white(self, ratio: float, increment: float) -> float:
        return ratio * math.sqrt(abs(increment) * self._correlation_m) * float(self._rng.standard_normal())


def noisy_ranges(ranges_m: NDArray[np.float32], std_m: float, rng: np.random.Generator) -> NDArray[np.float32]:
    """Ranges with normal noise; what did not return stays infinite."""
    noise_m = rng.standard_normal(ranges_m.shape, dtype=np.float32) * np.float32(std_m)
    return np.asarray(np.maximum(ranges_m + noise_m, np.float32(0.0)), dtype=np.float32)


def noisy_depth(depth_m: NDArray[np.float32], std_m_per_m2: float, rng: np.random.Generator) -> NDArray[np.float32]:
    """Depth with noise that grows with the square of depth; unknown (0) stays unknown."""
    noise = rng.standard_normal(depth_m.shape, dtype=np.float32)
    noisy = depth_m + noise * np.float32(std_m_per_m2) * depth_m**2
    return np.asarray(np.where(depth_m > 0, noisy, np.float32(0.0)), dtype=np.float32)
