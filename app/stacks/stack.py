"""What the runtime needs of what runs behind the interface, be it a robot or a stored graph."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Protocol

from app.events.event_log import EventLog
from app.persistence.node_history import NodeHistory
from app.scheduler import Agent
from app.settings import Settings
from perception.objects.seeing.look import Look
from perception.ports import RgbdFrame
from planner.models.protocol import LanguageModel
from planner.tasks.queue import TaskQueue
from scene_graph.memory import WorkingMemory


class Stack(Protocol):
    """What the runtime needs of either kind."""

    @property
    def memory(self) -> WorkingMemory:
        """The scene graph."""
        ...

    @property
    def history(self) -> NodeHistory:
        """What became of each node."""
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
    def network(self) -> str | None:
        """Name of the file of the network that the camera looks through."""
        ...

    @property
    def look(self) -> Look | None:
        """What the camera has shown last, and what was made of it."""
        ...

    @property
    def frame(self) -> RgbdFrame | None:
        """The newest frame of the camera."""
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


class BuildStack(Protocol):
    """Makes what runs behind the interface."""

    async def __call__(
        self, settings: Settings, queue: TaskQueue, model: LanguageModel | None, log: EventLog, *, anew: bool = False
    ) -> Stack:
        """``anew``: begin with an empty graph, whatever is remembered."""
        ...
