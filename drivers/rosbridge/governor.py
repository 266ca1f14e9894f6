"""Speed and acceleration limits of a base, and the dead man's handle: what is asked becomes what may be sent."""

from __future__ import annotations

import math

from skills.ports import BodyLimits


class Governor:
    """Turns wanted speeds into speeds that may be commanded; ``step`` it at a steady rate."""

    def __init__(self, limits: BodyLimits) -> None:
        self._limits = limits
        self._wanted = self._speed = (0.0, 0.0)
        self._age_s = math.inf

    @property
    def speed(self) -> tuple[float, float]:
        """Speed as commanded last: meters and radians a second."""
        return self._speed

    def want(self, linear_mps: float, angular_radps: float) -> None:
        """Ask for a speed; it is clipped, and lapses after the dead-man timeout. What is no number counts as zero."""
        limits = self._limits
        self._wanted = _clip(linear_mps, limits.linear_mps), _clip(angular_radps, limits.angular_radps)
        self._age_s = 0.0

    def halt(self) -> None:
        """Stand at once, and forget what was wanted."""
        self._wanted = self._speed = (0.0, 0.0)
        self._age_s = math.inf

    def step(self, dt_s: float) -> tuple[float, float]:
        """The speed to command now, ``dt_s`` after the one before."""
        wanted = self._wanted if self._age_s <= self._limits.command_timeout_s else (0.0, 0.0)
        self._age_s += dt_s
        limits = self._limits
        self._speed = (
            _towards(self._speed[0], wanted[0], limits.linear_mps2 * dt_s),
            _towards(self._speed[1], wanted[1], limits.angular_radps2 * dt_s),
        )
        return self._speed


def _clip(value: float, limit: float) -> float:
    return min(max(value, -limit), limit) if math.isfinite(value) else 0.0


def _towards(value: float, target: float, step: float) -> float:
    return value + _clip(target - value, step)
