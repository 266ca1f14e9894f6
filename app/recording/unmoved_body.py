"""The body of a robot that only plays back what was measured: it takes every command, and none moves it."""

from __future__ import annotations

from skills.ports import ArmGeometry, ArmTarget, BodyLimits


class UnmovedBody:
    """The commands of ``BodyPort``, without effect; a stop is remembered, and the recording goes on."""

    def __init__(self) -> None:
        self._stopped = False

    @property
    def limits(self) -> BodyLimits:
        """Those of the default body."""
        return BodyLimits()

    @property
    def geometry(self) -> ArmGeometry:
        """That of the default body."""
        return ArmGeometry()

    @property
    def stopped(self) -> bool:
        """Whether a stop was asked for."""
        return self._stopped

    async def drive(self, linear_mps: float, angular_radps: float) -> None:
        """Not done."""

    async def look(self, pan_rad: float, tilt_rad: float) -> None:
        """Not done."""

    async def move_arm(self, target: ArmTarget) -> None:
        """Not done."""

    async def grip(self, opening_m: float, effort_n: float = 15.0) -> None:
        """Not done."""

    def stop(self) -> None:
        """Remember the stop."""
        self._stopped = True

    def release_stop(self) -> None:
        """Forget the stop."""
        self._stopped = False

    async def close(self) -> None:
        """Nothing to release."""
