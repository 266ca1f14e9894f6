"""What the runtime needs of what runs behind the interface, be it a robot or a stored graph."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from majordomo.app.scheduler import Agent
from majordomo.scene_graph.memory import WorkingMemory


class Stack(Protocol):
    """What the runtime needs of either kind."""

    @property
    def memory(self) -> WorkingMemory:
        """The scene graph."""
        ...

    @property
    def agents(self) -> Sequence[Agent]:
        """In the order of their turns."""
        ...

    @property
    def path_room(self) -> tuple[tuple[float, float], ...]:
        """The path being followed, in the frame of the robot's parent."""
        ...

    @property
    def stopped(self) -> bool:
        """Whether the software stop is latched."""
        ...

    @property
    def exploring(self) -> bool:
        """Whether exploration is switched on."""
        ...

    @property
    def degraded(self) -> str | None:
        """What is wrong with perception, if anything."""
        ...

    @property
    def camera_on(self) -> bool:
        """Whether the camera has shown something."""
        ...

    def now(self) -> float:
        """Robot time in seconds."""
        ...

    def stop(self) -> None:
        """Latch the software stop; never waits."""
        ...

    def release_stop(self) -> None:
        """Lift the latched stop."""
        ...

    async def close(self) -> None:
        """Release everything."""
        ...
