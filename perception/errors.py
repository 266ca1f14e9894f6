"""What can go wrong in perception: each error is named for its condition and carries its data."""

from __future__ import annotations

import math


class PerceptionError(Exception):
    """Base of all errors of this package."""


class SensorSilent(PerceptionError):
    """A sensor gave nothing within its deadline; ``timeout_s``: infinite where what it gave is of no use."""

    def __init__(self, sensor: str, timeout_s: float) -> None:
        told = f"has been silent for {timeout_s:.2f} s" if math.isfinite(timeout_s) else "gives nothing that is of use"
        super().__init__(f"sensor '{sensor}' {told}")
        self.sensor = sensor
        self.timeout_s = timeout_s


class OdometryUnavailable(PerceptionError):
    """No odometry covers the asked time."""

    def __init__(self, stamp_s: float, span_s: tuple[float, float] | None) -> None:
        available = "none has arrived yet" if span_s is None else f"available: {span_s[0]:.2f} s to {span_s[1]:.2f} s"
        super().__init__(f"no odometry at {stamp_s:.2f} s; {available}")
        self.stamp_s = stamp_s
        self.span_s = span_s


class NoPicture(PerceptionError, ValueError):
    """Bytes that are no image file."""

    def __init__(self, size: int) -> None:
        self.size = size
        super().__init__(f"{size} bytes that are no image")
