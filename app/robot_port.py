"""What the service needs of a robot beyond sensing and moving: its clock, and an end."""

from __future__ import annotations

from typing import Protocol

from perception.ports import SensorPort
from skills.ports import BodyPort


class Robot(SensorPort, BodyPort, Protocol):
    """Sensors and body of one robot, and the time that both live in."""

    @property
    def now_s(self) -> float:
        """Robot time in seconds."""
        ...

    @property
    def stopped(self) -> bool:
        """Whether the software stop is latched."""
        ...

    async def advance(self, duration_s: float) -> float:
        """Let simulated time pass (lockstep); the new time in seconds."""
        ...

    async def close(self) -> None:
        """Release the robot."""
        ...
